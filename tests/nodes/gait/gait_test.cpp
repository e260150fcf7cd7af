#include "nodes/gait/gait.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "graph/diagnostic.h"
#include "nodes/gait/gait_foot.h"
#include "nodes/gait/gait_skeleton.h"
#include "nodes/gait/gait_styles.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {
namespace {

Motion made(GaitParams params) {
  Alone work;
  return make_gait(params, work);
}
GaitParams named(std::string_view gait) {
  GaitParams params;
  params.gait = gait;
  return params;
}
std::string code_of(const GaitParams& params) {
  try {
    made(params);
  } catch (const Failure& failure) {
    EXPECT_FALSE(failure.diagnostic().hint.empty());
    return failure.diagnostic().code;
  }
  return "";
}

class EveryGait : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Gait, EveryGait,
                         testing::Values("walk", "run", "sneak", "hobble", "strut", "stealthy", "jaunty",
                                         "stride"),
                         [](const auto& each) { return std::string(each.param); });

// Of a point of the foot, the longest run of frames in which it does not leave its first place.
struct Rest {
  double seconds = 0, moved = 0;
};
Rest longest_rest(const Motion& motion, int joint, Vec3 local, double near) {
  const WorldMotion world = world_motion(motion);
  Rest best;
  for (std::size_t start = 0; start < motion.frames();) {
    const Vec3 home = point_at(world, joint, local, start);
    std::size_t end = start + 1;
    double moved = 0;
    while (end < motion.frames()) {
      const double gone = norm(point_at(world, joint, local, end) - home);
      if (gone > near) break;
      moved = std::max(moved, gone);
      ++end;
    }
    const double seconds = static_cast<double>(end - start) / motion.fps();
    if (seconds > best.seconds) best = {seconds, moved};
    start = end;
  }
  return best;
}

TEST_P(EveryGait, HasFeetThatRestExactlyWhereTheyStand) {
  const Motion motion = made(named(GetParam()));
  const GaitStyle& style = gait_style(GetParam());
  const double cycle = 2 / style.cadence;
  for (int ball : {left_toe_base, right_toe_base}) {
    const Rest rest = longest_rest(motion, ball, {}, 1e-9);
    // The ball is down from the flat foot to toe-off.
    EXPECT_GT(rest.seconds, 0.8 * (style.duty - style.flat_from - 0.07) * cycle);
  }
}

TEST_P(EveryGait, RollsOverHeelAndBallWithoutSliding) {
  const GaitStyle& style = gait_style(GetParam());
  const GaitBody body;
  const GaitFoot foot(style, body, true, {2 / style.cadence, style.cadence * style.stride, 0, 0.2, 0});
  std::optional<Vec3> heel_home, ball_home;
  int heel_frames = 0, ball_frames = 0;
  for (double t = 0; t < style.duty * 2 / style.cadence; t += 0.001) {
    const FootState state = foot.at(t);
    const Quat sole = foot.orientation(state);
    const Vec3 heel = state.ankle + rotate(sole, {0, -body.ankle_height, -body.heel_behind});
    const Vec3 ball = state.ankle + rotate(sole, {0, body.ball_height - body.ankle_height, body.ball_ahead});
    if (state.heel_down) {
      if (!heel_home) heel_home = heel;
      EXPECT_NEAR(norm(heel - *heel_home), 0, 1e-9);
      ++heel_frames;
    }
    if (state.ball_down) {
      if (!ball_home) ball_home = ball;
      EXPECT_NEAR(norm(ball - *ball_home), 0, 1e-9);
      ++ball_frames;
    }
    EXPECT_TRUE(state.heel_down || state.ball_down) << t;
  }
  EXPECT_GT(heel_frames, 50);
  EXPECT_GT(ball_frames, 100);
}

TEST_P(EveryGait, NeverPutsAFootThroughTheFloor) {
  const Motion motion = made(named(GetParam()));
  const GaitBody body;
  const WorldMotion world = world_motion(motion);
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    for (int foot : {left_foot, right_foot}) {
      EXPECT_GT(point_at(world, foot, {0, -body.ankle_height, -body.heel_behind}, t).y, -1e-9) << t;
      EXPECT_GT(world.position(foot + 1)[t].y, body.ball_height - 1e-9) << t;
      EXPECT_GT(point_at(world, foot + 1, {0, -body.ball_height, body.toe_length}, t).y, -0.001) << t;
    }
  }
}

TEST_P(EveryGait, MovesSmoothly) {
  GaitParams params = named(GetParam());
  params.fps = 960;
  params.seconds = 3;
  const Motion motion = made(params);
  const WorldMotion world = world_motion(motion);
  const double dt = 1 / params.fps;
  for (int joint = 0; joint < motion.joints(); ++joint) {
    const ConstVec3Track at = world.position(joint);
    for (std::size_t t = 2; t + 2 < motion.frames(); ++t) {
      const Vec3 before = (at[t - 2] - 2 * at[t - 1] + at[t]) / (dt * dt);
      const Vec3 after = (at[t] - 2 * at[t + 1] + at[t + 2]) / (dt * dt);
      // 200 m/s² is a hard kick. A jump of acceleration, over 2 ms, would be a jerk without bound.
      ASSERT_LT(norm(before), 200) << motion.skeleton().joints[joint].name << " at " << t;
      ASSERT_LT(norm(after - before), 40) << motion.skeleton().joints[joint].name << " at " << t;
    }
  }
}

TEST_P(EveryGait, NeverStretchesALegNorLocksAKnee) {
  const Motion motion = made(named(GetParam()));
  for (int knee : {left_leg, right_leg}) {
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      const double bend = turn(motion.rotation(knee)[t]) * 180 / 3.14159265;
      EXPECT_GT(bend, 10) << t;
      EXPECT_LT(bend, 145) << t;
      EXPECT_NEAR(motion.rotation(knee)[t].y, 0, 1e-9) << "a knee is a hinge";
      EXPECT_NEAR(motion.rotation(knee)[t].z, 0, 1e-9) << "a knee is a hinge";
    }
  }
}

TEST_P(EveryGait, GoesStraightAheadAtItsSpeed) {
  GaitParams params = named(GetParam());
  const Pace pace = resolved_pace(params);
  params.seconds = 4 / pace.cadence + 0.5 / params.fps;
  const Motion motion = made(params);
  const ConstVec3Track root = motion.translation(hips);
  const std::size_t last = motion.frames() - 1;
  const double cycles = static_cast<double>(last) / params.fps * pace.cadence / 2;
  EXPECT_NEAR((root[last].z - root[0].z) / cycles, 2 * pace.stride, 0.02);
  EXPECT_NEAR(root[last].x, root[0].x, 0.01);
}

TEST_P(EveryGait, TakesSeeds) {
  GaitParams params = named(GetParam());
  const Motion plain = made(params), again = made(params);
  params.seed = 7;
  const Motion seeded = made(params), seeded_again = made(params);
  params.seed = 8;
  const Motion other = made(params);
  double change = 0;
  for (std::size_t t = 0; t < plain.frames(); ++t) {
    EXPECT_EQ(plain.rotation(left_arm)[t], again.rotation(left_arm)[t]);
    EXPECT_EQ(seeded.rotation(left_arm)[t], seeded_again.rotation(left_arm)[t]);
    change = std::max(change, turn(seeded.rotation(left_up_leg)[t], other.rotation(left_up_leg)[t]));
  }
  EXPECT_GT(change, 0.005);
  EXPECT_LT(change, 0.4);
}

TEST(Gait, RunsWithBothFeetInTheAirAndWalksWithout) {
  for (auto [gait, flies] : {std::pair{"walk", false}, std::pair{"run", true}}) {
    const Motion motion = made(named(gait));
    const WorldMotion world = world_motion(motion);
    const GaitBody body;
    int aloft = 0;
    for (std::size_t t = 0; t < motion.frames(); ++t) {
      bool down = false;
      for (int foot : {left_foot, right_foot}) {
        down |= world.position(foot + 1)[t].y < body.ball_height + 1e-6;
        down |= point_at(world, foot, {0, -body.ankle_height, -body.heel_behind}, t).y < 1e-6;
      }
      aloft += !down;
    }
    EXPECT_EQ(aloft > static_cast<int>(motion.frames()) / 10, flies) << gait << ' ' << aloft;
    if (!flies) {
      EXPECT_EQ(aloft, 0);
    }
  }
}

TEST(Gait, HobblesUnevenly) {
  const Motion motion = made(named("hobble"));
  const Rest left = longest_rest(motion, left_toe_base, {}, 1e-9),
             right = longest_rest(motion, right_toe_base, {}, 1e-9);
  EXPECT_GT(left.seconds, right.seconds + 0.08);
}

TEST(Gait, CompletesSpeedCadenceAndStride) {
  GaitParams params;
  const Pace own = resolved_pace(params);
  EXPECT_NEAR(own.speed, own.cadence * own.stride, 1e-12);
  params.speed = 1.5;
  EXPECT_NEAR(resolved_pace(params).speed, 1.5, 1e-12);
  EXPECT_NEAR(resolved_pace(params).stride / resolved_pace(params).cadence, own.stride / own.cadence, 1e-12);
  params.cadence = 2.2;
  EXPECT_NEAR(resolved_pace(params).stride, 1.5 / 2.2, 1e-12);
  params.cadence = 0;
  params.stride = 0.8;
  EXPECT_NEAR(resolved_pace(params).cadence, 1.5 / 0.8, 1e-12);
}

TEST(Gait, RefusesWhatCannotBe) {
  GaitParams all;
  all.speed = 1;
  all.cadence = 2;
  all.stride = 0.5;
  EXPECT_EQ(code_of(all), "gait-overdetermined");
  GaitParams giant;
  giant.stride = 1.6;
  EXPECT_EQ(code_of(giant), "gait-out-of-reach");
  EXPECT_EQ(code_of(named("gallop")), "unknown-gait");
}

TEST(Gait, FollowsItsDials) {
  GaitParams params;
  params.seconds = 2;
  const Motion plain = made(params);
  auto mean_height = [](const Motion& motion) {
    double sum = 0;
    for (double y : motion.translation(hips).y) sum += y;
    return sum / static_cast<double>(motion.frames());
  };
  auto range_of_arm = [](const Motion& motion) {
    double widest = 0;
    for (std::size_t t = 0; t < motion.frames(); ++t)
      widest = std::max(widest, turn(motion.rotation(left_arm)[0], motion.rotation(left_arm)[t]));
    return widest;
  };
  params.crouch = 0.1;
  EXPECT_NEAR(mean_height(made(params)), mean_height(plain) - 0.1 * GaitBody().leg(), 0.002);
  params.crouch = 0;
  params.arm_swing = 2;
  EXPECT_GT(range_of_arm(made(params)), 1.6 * range_of_arm(plain));
  params.arm_swing = 1;
  params.lean = 20;
  const WorldMotion leaning = world_motion(made(params)), upright = world_motion(plain);
  EXPECT_GT(leaning.position(neck)[0].z - leaning.position(hips)[0].z,
            upright.position(neck)[0].z - upright.position(hips)[0].z + 0.08);
}

TEST(Gait, IsA175CentimetreTPoseAndWritesCentimetres) {
  const Motion motion = made({});
  EXPECT_EQ(motion.joints(), 23);
  EXPECT_NEAR(rest_height(motion.skeleton()), 1.75, 0.02);
  EXPECT_EQ(motion.source().unit, 0.01);
  EXPECT_EQ(motion.source().bvh.size(), 23u);
  EXPECT_EQ(motion.source().bvh[0].channels.size(), 6u);
  EXPECT_EQ(motion.source().bvh_ends.size(), motion.skeleton().ends.size());
  EXPECT_FALSE(motion.non_finite());
}

}  // namespace
}  // namespace kinegraph
