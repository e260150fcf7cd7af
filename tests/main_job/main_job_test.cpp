// The main job, from saved graphs through the real program: the four pairs of [Wu] Table 1 as far as the
// clips are to be had. Judged on the files it wrote, by measures of its own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "exported.h"
#include "independent_measures.h"

namespace kinegraph {
namespace {

class MainJob : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    KINEGRAPH_NEEDS_MOCAP();
    const std::string name = GetParam();
    out_.emplace("tests/main_job/" + name + ".kg.json", "main_job_" + name, "");
    ASSERT_TRUE(out_->ran());
    source_ = out_->motion(name + "_source.bvh");
    warped_ = out_->motion(name + "_warped.bvh");
    transferred_ = out_->motion(name + "_transferred.bvh");
    unwarped_ = out_->motion(name + "_unwarped.bvh");
    reference_ = out_->motion(name + "_reference.bvh");
    result_ = out_->motion(name + ".bvh");
    stats_ = std::dynamic_pointer_cast<const Stats>(out_->value(name + "_style.json", "stats"));
    contacts_ = std::dynamic_pointer_cast<const Contacts>(out_->value(name + "_plants.json", "contacts"));
    ASSERT_TRUE(stats_ && contacts_);
    // Partners: the result's joints by the names that the Stats use.
    for (const JointStats& joint : stats_->joints) wanted_.push_back(joint);
    Skeleton from;
    for (const JointStats& joint : stats_->joints) from.joints.push_back({joint.joint, -1, {}, {}});
    const std::vector<int> of = partners(from, source_->skeleton(), {});
    std::vector<JointStats> named;
    for (int j = 0; j < source_->joints(); ++j) {
      if (of[j] < 0) continue;
      named.push_back(stats_->joints[of[j]]);
      named.back().joint = source_->skeleton().joints[j].name;
    }
    wanted_ = named;
    ASSERT_GT(wanted_.size(), 10u);
  }

  std::optional<Exported> out_;
  std::shared_ptr<const Motion> source_, warped_, transferred_, unwarped_, reference_, result_;
  std::shared_ptr<const Stats> stats_;
  std::shared_ptr<const Contacts> contacts_;
  std::vector<JointStats> wanted_;
};

TEST_P(MainJob, TakesOnTheStyle) {
  const double at_first = independent::mean_of(independent::style_distances(*warped_, wanted_));
  const auto before = independent::style_distances(*warped_, wanted_);
  const auto transferred = independent::style_distances(*transferred_, wanted_);
  const auto result = independent::style_distances(*result_, wanted_);
  EXPECT_LT(independent::mean_of(transferred), 0.05 * at_first)
      << "style distance before UnwarpTime, of " << at_first;
  EXPECT_LT(independent::mean_of(result), 0.30 * at_first)
      << "style distance of the exported file, of " << at_first;
  std::string worse;
  for (const auto& [joint, distance] : result)
    if (before.count(joint) && distance > before.at(joint))
      worse += fmt::format(" {} {:.2f}->{:.2f}°", joint, before.at(joint), distance);
  fmt::print("{}: style distance {:.2f}° -> {:.3f}° before UnwarpTime -> {:.3f}° exported; worse joints:{}\n",
             GetParam(), at_first, independent::mean_of(transferred), independent::mean_of(result),
             worse.empty() ? " none" : worse);
}

TEST_P(MainJob, KeepsStepsAndCadence) {
  const std::vector<Leg> legs = find_legs(source_->skeleton());
  ASSERT_EQ(legs.size(), 2u);
  const auto name = [&](int leg) { return source_->skeleton().joints[legs[leg].ankle].name; };
  const independent::Steps was = independent::steps_of(*source_, name(0), name(1));
  const independent::Steps is = independent::steps_of(*result_, name(0), name(1));
  EXPECT_GT(was.count, 1);
  EXPECT_EQ(is.count, was.count);
  EXPECT_NEAR(is.cadence, was.cadence, 0.02 * was.cadence) << "steps a second";
  fmt::print("{}: {} steps at {:.3f} a second -> {} at {:.3f}\n", GetParam(), was.count, was.cadence,
             is.count, is.cadence);
}

TEST_P(MainJob, KeepsTheHeading) {
  const auto was = independent::heading_of(*source_), is = independent::heading_of(*result_);
  ASSERT_EQ(was.psi.size(), is.psi.size());
  for (std::size_t t = 0; t < was.psi.size(); ++t)
    ASSERT_NEAR(std::remainder(is.psi[t] - was.psi[t], 2 * M_PI) * 180 / M_PI, 0, 0.5) << "frame " << t;
  const auto direction = [](const Motion& motion) {
    const auto positions = independent::positions_of(motion)[0];
    const Vec3 d = positions.back() - positions.front();
    return std::atan2(d.x, d.z);
  };
  EXPECT_NEAR(std::remainder(direction(*result_) - direction(*source_), 2 * M_PI) * 180 / M_PI, 0, 3);
}

TEST_P(MainJob, HoldsPlantedPoints) {
  std::size_t plants = 0, frames = 0;
  for (const FootPoint& point : contacts_->points) {
    for (const auto& run : runs_of(point.planted)) {
      ++plants;
      frames += run.end - run.start;
    }
  }
  ASSERT_GE(plants, 3u) << "nothing to hold";
  const double farthest = independent::farthest_from_plants(*result_, *contacts_);
  EXPECT_LT(farthest, 1e-3) << "m, largest distance of a planted point from where it is planted";
  fmt::print("{}: {} plants of {} frames in all, held within {:.4f} mm\n", GetParam(), plants, frames,
             1000 * farthest);
}

TEST_P(MainJob, KeepsTheSourcesLengths) {
  const auto length = [](const Motion& motion, const auto& positions, int joint, std::size_t frame) {
    const Vec3 link = positions[joint][frame] - positions[motion.skeleton().joints[joint].parent][frame];
    return std::sqrt(dot(link, link));
  };
  const auto from = independent::positions_of(*source_);
  const std::vector<Leg> legs = find_legs(source_->skeleton());
  double stretched = 0;
  for (const Motion* motion : {transferred_.get(), result_.get()}) {
    ASSERT_EQ(motion->joints(), source_->joints());
    const auto to = independent::positions_of(*motion);
    for (int joint = 1; joint < motion->joints(); ++joint) {
      const std::string& name = source_->skeleton().joints[joint].name;
      ASSERT_EQ(motion->skeleton().joints[joint].name, name);
      const double own = length(*source_, from, joint, 0);
      // Only Footskate changes lengths, and only those of thigh and shank.
      const bool of_leg = std::any_of(legs.begin(), legs.end(), [&](const Leg& leg) {
        return joint != leg.hip && source_->skeleton().is_below(joint, leg.hip) &&
               source_->skeleton().is_below(leg.ankle, joint);
      });
      double worst = 0;
      for (std::size_t t = 0; t < motion->frames(); ++t)
        worst = std::max(worst, std::abs(length(*motion, to, joint, t) - own));
      if (motion == result_.get() && of_leg) {
        EXPECT_LT(worst, 0.05 * own) << name << ": Footskate's default stretch";
        stretched = std::max(stretched, worst / own);
      } else {
        EXPECT_LT(worst, 1e-6) << name << ", m";
      }
    }
  }
  fmt::print("{}: legs stretch by up to {:.1f} %\n", GetParam(), 100 * stretched);
}

// Against the clips as they were captured: the graph may calm or warp them first.
TEST_P(MainJob, StaysSmooth) {
  EXPECT_EQ(independent::joints_that_jerk(*result_, *source_, *reference_), "");
}

// The moves of feet and root are smooth, but a link that they turn repeats a part of the clip's own jumps,
// which in these clips are of up to 900 m/s² from one frame to the next.
TEST_P(MainJob, IsMovedSmoothlyBetweenPlants) {
  const independent::Added added = independent::most_added(*unwarped_, *result_, *contacts_);
  EXPECT_GT(added.calm, 0);
  EXPECT_LT(added.calm, 50) << "m/s² after a 15 Hz low-pass";
  EXPECT_LT(added.own, 70) << "m/s² of the frames as they are, but for what turned links repeat";
  fmt::print("{}: Footskate adds {:.0f} m/s² between plants ({:.0f} after a low-pass), {:.0f} of its own\n",
             GetParam(), added.raw, added.calm, added.own);
}

INSTANTIATE_TEST_SUITE_P(Wu, MainJob, testing::Values("stealthy", "stride_run", "happy", "old"),
                         [](const auto& pair) { return std::string(pair.param); });

}  // namespace
}  // namespace kinegraph
