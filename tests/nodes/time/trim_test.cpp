#include "nodes/time/trim.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
namespace {

NodeInMemory trim() {
  return NodeInMemory(*all_nodes().find("Trim"));
}

TEST(Trim, keeps_the_frames_of_its_range_as_they_are) {
  Motion motion = sample_motion(20);
  auto node = trim();
  node.link("motion", motion).set("range", Json::Array{5, 12}).run();
  const auto& out = node.out<Motion>("motion");
  ASSERT_EQ(out.frames(), 7u);
  EXPECT_EQ(out.fps(), motion.fps());
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < 7; ++t) {
      EXPECT_EQ(out.rotation(j)[t], motion.rotation(j)[t + 5]);
      EXPECT_EQ(out.local_offset(j, t), motion.local_offset(j, t + 5));
    }
}

TEST(Trim, to_the_end_is_what_null_says_and_everything_the_default) {
  auto node = trim();
  node.link("motion", sample_motion(20)).set("range", Json::Array{5, nullptr}).run();
  EXPECT_EQ(node.out<Motion>("motion").frames(), 15u);
  auto all = trim();
  Motion motion = sample_motion(20);
  all.link("motion", motion).run();
  EXPECT_EQ(encoded(all.out<Motion>("motion")), encoded(motion));
}

TEST(Trim, keeps_the_angles_as_read_beside_their_frames) {
  Motion motion = sample_motion(20);
  SourceFacts source;
  source.read = std::make_shared<const std::vector<double>>(std::vector<double>(60));
  source.read_frames = 20;
  motion.set_source(std::make_shared<const SourceFacts>(source));
  Motion twice = trimmed(trimmed(motion, {3, 18}), {2, 7});
  EXPECT_EQ(twice.source().first_read, 5u);
  EXPECT_EQ(twice.source().read_frames, 5u);
  EXPECT_EQ(twice.source().read, source.read);
}

TEST(Trim, refuses_a_range_outside_the_motion) {
  for (Json range : {Json(Json::Array{20, nullptr}), Json(Json::Array{0, 21}), Json(Json::Array{4, 4})}) {
    Diagnostic d = trim().link("motion", sample_motion(20)).set("range", range).refusal();
    EXPECT_EQ(d.param, "range");
    EXPECT_EQ(d.severity, Severity::error);
  }
}

}  // namespace
}  // namespace kinegraph
