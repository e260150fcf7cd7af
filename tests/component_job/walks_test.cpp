// What the components of a normal, an old and a proud walk mean [Cao §4.3, Fig. 2].
#include <algorithm>
#include <cmath>

#include "nodes/components/components.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/metrics.h"
#include "nodes/motion/moving_root.h"
#include "nodes/motion/points.h"
#include "tests/main_job/exported.h"

namespace kinegraph {
namespace {

double value(const Metrics& metrics, const std::string& name) {
  const Metric* metric = metrics.find(name);
  EXPECT_TRUE(metric && metric->value) << name;
  return metric && metric->value ? *metric->value : 0;
}

// Mean of a signal over a segment.
double level(const Components& components, std::size_t entry, std::size_t segment) {
  const ComponentSegment& one = components.segments[segment];
  double sum = 0;
  for (std::size_t t = one.start; t < one.end; ++t) sum += components.signals(entry, t);
  return sum / static_cast<double>(one.frames());
}

// How far the head is in front of the hips, along the way they go, mean over the clip, m.
double stoop(const Motion& motion) {
  const WorldMotion world = world_motion(motion);
  const int head = motion.skeleton().find("Head"), hips = motion.skeleton().find("Hips");
  const std::size_t last = motion.frames() - 1;
  Vec3 way = world.position(hips)[last] - world.position(hips)[0];
  way.y = 0;
  double sum = 0;
  for (std::size_t t = 0; t <= last; ++t)
    sum += dot(normalized(way), world.position(head)[t] - world.position(hips)[t]);
  return sum / static_cast<double>(last + 1);
}

TEST(Walks, HaveComponentsOfLegsOfArmsAndOfTheStoop) {
  KINEGRAPH_NEEDS_MOCAP();
  const Exported files("tests/component_job/walks.kg.json", "walks", "");
  ASSERT_TRUE(files.ran());
  const auto metrics = files.read<Metrics>("meaning.json");
  const auto parts = files.read<Components>("components.json");
  const auto gain = [&](int u, const char* region) {
    return -value(*metrics, fmt::format("u{}.d_region.{}", u, region));
  };
  // u1 steps: the legs above all, the feet farthest.
  EXPECT_GT(gain(1, "legs"), 2 * gain(1, "arms"));
  EXPECT_GT(gain(1, "legs"), 10 * gain(1, "trunk"));
  EXPECT_NEAR(value(*metrics, "u1.cadence"), 0.9, 0.2);
  EXPECT_TRUE(metrics->find("u1.moves.Toes_L"));
  // u2 swings the arms.
  EXPECT_GT(gain(2, "arms"), 1.3 * gain(2, "legs"));
  EXPECT_TRUE(metrics->find("u2.moves.Hand_L") || metrics->find("u2.moves.Hand_R"));
  // u3 is the stoop of the old one: the trunk, the head farthest, and there all the time.
  EXPECT_GT(gain(3, "trunk"), 2 * gain(3, "arms"));
  EXPECT_GT(gain(3, "trunk"), 5 * gain(3, "legs"));
  EXPECT_TRUE(metrics->find("u3.moves.Head"));
  EXPECT_GT(std::abs(level(*parts, 2, 1)), 1.0);
  EXPECT_LT(level(*parts, 2, 0) * level(*parts, 2, 1), 0);
  EXPECT_LT(level(*parts, 2, 2) * level(*parts, 2, 1), 0);
  for (int other : {1, 2, 4})
    EXPECT_GT(value(*metrics, "u3.d_emotion"), value(*metrics, fmt::format("u{}.d_emotion", other)));

  // And so the stoop, carried over alone, stoops the normal walk.
  const auto normal = files.motion("normal.bvh"), old = files.motion("old.bvh"),
             hunched = files.motion("hunched.bvh");
  ASSERT_TRUE(normal && old && hunched);
  EXPECT_GT(stoop(*hunched), stoop(*normal) + 0.5 * (stoop(*old) - stoop(*normal)));
  RecordProperty("stoop", fmt::format("{:.3f} {:.3f} {:.3f}", stoop(*normal), stoop(*old), stoop(*hunched)));
  // Every link points where the components say; where several hang on one joint (chest, hips), that turns by
  // the best rotation of them.
  const auto loose = files.read<Points>("loose.csv");
  const WorldMotion bones = world_motion(*hunched);
  double single = 0, several = 0;
  for (int j = 1; j < hunched->joints(); ++j) {
    const Skeleton& skeleton = hunched->skeleton();
    const int parent = skeleton.joints[static_cast<std::size_t>(j)].parent;
    const auto label = [&](int joint) {
      const auto& name = skeleton.joints[static_cast<std::size_t>(joint)].name;
      return static_cast<int>(std::find(loose->labels.begin(), loose->labels.end(), name) -
                              loose->labels.begin());
    };
    if (skeleton.link_length(j) < 1e-6 || parent == 0) continue;
    const auto links = skeleton.children(parent).size();
    for (std::size_t t = 0; t < hunched->frames(); ++t) {
      const Vec3 bone = bones.position(j)[t] - bones.position(parent)[t],
                 said = loose->track(label(j))[t] - loose->track(label(parent))[t];
      const double off = std::atan2(norm(cross(bone, said)), dot(bone, said)) * 180 / M_PI;
      (links > 1 ? several : single) = std::max(links > 1 ? several : single, off);
    }
  }
  EXPECT_LT(single, 0.01) << "degrees";
  EXPECT_LT(several, 1.5) << "degrees";
  RecordProperty("several", fmt::format("{:.2f}", several));
  // On the path of the normal walk.
  const WorldMotion was = world_motion(*normal), is = world_motion(*hunched);
  const int hips = normal->skeleton().find("Hips");
  for (std::size_t t = 0; t < normal->frames(); t += 10)
    EXPECT_LT(norm(is.position(hips)[t] - was.position(hips)[t]), 1e-4) << t;
}

}  // namespace
}  // namespace kinegraph
