// The explosion that rises higher after one component is scaled [Cao §7.3, Fig. 12].
#include <algorithm>

#include "nodes/motion/points.h"
#include "tests/main_job/exported.h"

namespace kinegraph {
namespace {

double height_at_end(const Points& points, bool top) {
  double sum = 0, most = 0;
  for (int i = 0; i < static_cast<int>(points.labels.size()); ++i) {
    const double y = points.track(i)[points.frames - 1].y;
    sum += y / static_cast<double>(points.labels.size());
    most = std::max(most, y);
  }
  return top ? most : sum;
}
double width_at_end(const Points& points) {
  double most = 0;
  for (int i = 0; i < static_cast<int>(points.labels.size()); ++i) {
    const Vec3 p = points.track(i)[points.frames - 1];
    most = std::max(most, std::sqrt(p.x * p.x + p.z * p.z));
  }
  return most;
}

TEST(Explosion, RisesHigherAfterOneComponentIsScaled) {
  const Exported files("graphs/explosion.kg.json", "explosion", "");
  ASSERT_TRUE(files.ran());
  const auto burst = files.read<Points>("explosion.csv"), higher = files.read<Points>("explosion_higher.csv");
  ASSERT_EQ(burst->labels, higher->labels);
  ASSERT_EQ(burst->frames, higher->frames);
  // The cloud's mean height grows by an eighth and more, its top too; it stays as wide within a quarter.
  EXPECT_GT(height_at_end(*higher, false), 1.125 * height_at_end(*burst, false));
  EXPECT_GT(height_at_end(*higher, true), 1.125 * height_at_end(*burst, true));
  EXPECT_NEAR(width_at_end(*higher), width_at_end(*burst), 0.25 * width_at_end(*burst));
  // And nothing goes through the ground.
  double lowest = 0;
  for (int i = 0; i < static_cast<int>(higher->labels.size()); ++i)
    for (std::size_t t = 0; t < higher->frames; ++t) lowest = std::min(lowest, higher->track(i)[t].y);
  EXPECT_GT(lowest, -0.005);
  RecordProperty("mean",
                 fmt::format("{:.2f} {:.2f}", height_at_end(*burst, false), height_at_end(*higher, false)));
  RecordProperty("top",
                 fmt::format("{:.2f} {:.2f}", height_at_end(*burst, true), height_at_end(*higher, true)));
}

}  // namespace
}  // namespace kinegraph
