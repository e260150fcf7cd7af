#include "nodes/cartoon/exaggerate.h"

#include <gmock/gmock.h>

#include <cmath>

#include "nodes/all_nodes.h"
#include "nodes/cartoon/link_turns.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/resample.h"
#include "tests/nodes/cartoon/cartoon_clips.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {

NodeType exaggerate_node();

namespace {

// Position i of a series continued at both ends by 2 p₀ − p_k.
Vec3 continued(const ConstVec3Track& track, std::ptrdiff_t i) {
  const auto last = static_cast<std::ptrdiff_t>(track.x.size()) - 1;
  if (i < 0) return 2 * track[0] - track[static_cast<std::size_t>(-i)];
  if (i > last)
    return 2 * track[static_cast<std::size_t>(last)] - track[static_cast<std::size_t>(2 * last - i)];
  return track[static_cast<std::size_t>(i)];
}

// [Kwon §4] as it stands: e = ω j + (1 − ω) (j ∗ gσ), the sum taken directly.
Vec3 exaggerated(const ConstVec3Track& track, double omega, double sigma, double fps, std::size_t frame) {
  const auto radius = std::min(static_cast<std::ptrdiff_t>(std::ceil(6 * sigma * fps)),
                               static_cast<std::ptrdiff_t>(track.x.size()) - 1);
  Vec3 sum;
  double weights = 0;
  for (std::ptrdiff_t k = -radius; k <= radius; ++k) {
    const double s = static_cast<double>(k) / fps;
    const double g = std::exp(-s * s / (2 * sigma * sigma));
    sum += g * continued(track, static_cast<std::ptrdiff_t>(frame) + k);
    weights += g;
  }
  return omega * track[frame] + (1 - omega) * (sum / weights);
}

ExaggerateParams uncorrected(double omega, double sigma) {
  ExaggerateParams params;
  params.omega = omega;
  params.sigma = sigma;
  params.correct = false;
  return params;
}

double positions_differ(const Motion& a, const Motion& b) {
  const WorldMotion p = world_motion(a), q = world_motion(b);
  double worst = 0;
  for (int j = 0; j < a.joints(); ++j)
    for (std::size_t t = 0; t < a.frames(); ++t)
      worst = std::max(worst, norm(p.position(j)[t] - q.position(j)[t]));
  return worst;
}

bool same_bits(const Motion& a, const Motion& b) {
  Encoder first, second;
  a.encode(first);
  b.encode(second);
  return first.take() == second.take();
}

TEST(Exaggerate, IsTheFormulaAtEveryFrameAndJoint) {
  Alone work;
  const Motion run = gait("run", 2, 60);
  for (const auto& [omega, sigma] : {std::pair{5.0, 0.12}, {0.3, 0.05}, {2.0, 0.6}}) {
    const Motion out = exaggerate(run, uncorrected(omega, sigma), work).motion;
    const WorldMotion before = world_motion(run), after = world_motion(out);
    double worst = 0;
    for (int j = 0; j < run.joints(); ++j)
      for (std::size_t t = 0; t < run.frames(); ++t)
        worst = std::max(
            worst, norm(after.position(j)[t] - exaggerated(before.position(j), omega, sigma, run.fps(), t)));
    EXPECT_LT(worst, 1e-9) << "omega " << omega << ", sigma " << sigma;
  }
}

TEST(Exaggerate, LeavesUniformMotionUntouchedUpToBothEnds) {
  Alone work;
  Motion glide = gait("walk", 2).empty_like(90);
  for (std::size_t t = 0; t < glide.frames(); ++t)
    glide.translation(0).set(t, Vec3{0.3, 1, 0.1} + static_cast<double>(t) * Vec3{0.01, 0.002, 0.03});
  const Motion out = exaggerate(glide, uncorrected(8, 0.2), work).motion;
  EXPECT_LT(positions_differ(glide, out), 1e-9);
  EXPECT_LT(difference(glide, out).turn, 1e-9);
}

TEST(Exaggerate, WithOmegaOneReturnsTheInputBitForBit) {
  Alone work;
  const Motion walk = gait("walk", 2);
  EXPECT_TRUE(same_bits(walk, exaggerate(walk, uncorrected(1, 0.2), work).motion));
  ExaggerateParams params;
  params.omega = 1;
  EXPECT_TRUE(same_bits(walk, exaggerate(walk, params, work).motion));
}

TEST(Exaggerate, SmoothsWithOmegaZero) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const WorldMotion before = world_motion(walk),
                    after = world_motion(exaggerate(walk, uncorrected(0, 0.3), work).motion);
  const int hand = walk.skeleton().find("LeftHand"), root = 0;
  const auto swing = [&](const WorldMotion& world) {
    double low = 1e9, high = -1e9;
    for (std::size_t t = 0; t < world.frames(); ++t) {
      low = std::min(low, world.position(hand)[t].z - world.position(root)[t].z);
      high = std::max(high, world.position(hand)[t].z - world.position(root)[t].z);
    }
    return high - low;
  };
  EXPECT_LT(swing(after), 0.6 * swing(before));
}

TEST(Exaggerate, GivesOneLimbAlone) {
  Alone work;
  const Motion walk = gait("walk", 2);
  ExaggerateParams params = uncorrected(5, 0.15);
  const int arm = walk.skeleton().find("LeftArm");
  params.weights.assign(walk.skeleton().joints.size(), 0.0);
  for (int j = 0; j < walk.joints(); ++j)
    if (walk.skeleton().is_below(j, arm)) params.weights[j] = j == arm ? 1 : 0.5;
  const Motion out = exaggerate(walk, params, work).motion;
  const WorldMotion before = world_motion(walk), after = world_motion(out);
  for (int j = 0; j < walk.joints(); ++j) {
    double worst = 0, moved = 0;
    for (std::size_t t = 0; t < walk.frames(); ++t) {
      const double omega = 1 + params.weights[j] * 4;  // ω_k = 1 + weight_k (ω − 1)
      worst = std::max(
          worst, norm(after.position(j)[t] - exaggerated(before.position(j), omega, 0.15, walk.fps(), t)));
      moved = std::max(moved, norm(after.position(j)[t] - before.position(j)[t]));
    }
    EXPECT_LT(worst, 1e-9) << walk.skeleton().joints[j].name;
    EXPECT_EQ(moved > 0.01, walk.skeleton().is_below(j, arm)) << walk.skeleton().joints[j].name;
  }
}

TEST(Exaggerate, KeepsTheRootWhereWished) {
  Alone work;
  const Motion run = gait("run", 2);
  ExaggerateParams params = uncorrected(5, 0.15);
  params.keep_root = true;
  const WorldMotion before = world_motion(run), after = world_motion(exaggerate(run, params, work).motion);
  const int hand = run.skeleton().find("RightHand");
  std::vector<double> about_root(3 * run.frames());
  const Vec3Track relative{{about_root.data(), run.frames()},
                           {about_root.data() + run.frames(), run.frames()},
                           {about_root.data() + 2 * run.frames(), run.frames()}};
  for (std::size_t t = 0; t < run.frames(); ++t)
    relative.set(t, before.position(hand)[t] - before.position(0)[t]);
  for (std::size_t t = 0; t < run.frames(); ++t) {
    EXPECT_LT(norm(after.position(0)[t] - before.position(0)[t]), 1e-12);
    const Vec3 wanted =
        before.position(0)[t] + exaggerated({relative.x, relative.y, relative.z}, 5, 0.15, run.fps(), t);
    ASSERT_LT(norm(after.position(hand)[t] - wanted), 1e-9);
  }
}

TEST(Exaggerate, AimsLinksByTheSmallestTurnAndKeepsTwist) {
  Alone work;
  const Motion run = gait("run", 2);
  const Motion out = exaggerate(run, {}, work).motion;
  const WorldMotion before = world_motion(run), after = world_motion(out);
  const int arm = run.skeleton().find("LeftArm"), elbow = run.skeleton().find("LeftForeArm");
  for (std::size_t t = 0; t < run.frames(); ++t) {
    const Vec3 old_link = before.position(elbow)[t] - before.position(arm)[t];
    const Vec3 new_link = after.position(elbow)[t] - after.position(arm)[t];
    const Quat turned = after.orientation(arm)[t] * inverse(before.orientation(arm)[t]);
    EXPECT_LT(norm(normalized(rotate(turned, old_link)) - normalized(new_link)), 1e-9);
    EXPECT_NEAR(turn(turned), turn(smallest_turn(old_link, new_link)), 1e-7);
  }
}

TEST(Exaggerate, FollowsParentsAtZeroDistanceAndCarriesEndSitesRigidly) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Motion walk = cartoon_clip("cmu/bvh/08_01.bvh");
  const Motion out = exaggerate(walk, {}, work).motion;
  const WorldMotion after = world_motion(out);
  const int hip = walk.skeleton().find("LHipJoint"), head = walk.skeleton().find("Head");
  ASSERT_EQ(walk.skeleton().link_length(hip), 0);
  EXPECT_FALSE(out.translates(hip));
  for (std::size_t t = 0; t < walk.frames(); ++t)
    ASSERT_LT(norm(after.position(hip)[t] - after.position(0)[t]), 1e-12);
  ASSERT_EQ(out.skeleton().ends.size(), walk.skeleton().ends.size());
  for (const EndSite& end : out.skeleton().ends) {
    if (end.joint != head) continue;
    EXPECT_NEAR(norm(point_at(after, head, end.offset, 40) - after.position(head)[40]), norm(end.offset),
                1e-12);
  }
}

TEST(Exaggerate, LandsOnAWishedStretch) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion clip = cartoon_clip(file);
    for (double wish : {1.3, 2.0}) {
      ExaggerateParams params;
      params.wished_stretch = wish;
      const ExaggerateResult result = exaggerate(clip, params, work);
      std::vector<double> ratios;
      const WorldMotion before = world_motion(clip), after = world_motion(result.motion);
      for (int j = 1; j < clip.joints(); ++j) {
        const int p = clip.skeleton().joints[j].parent;
        if (clip.skeleton().link_length(j) < 1e-6) continue;
        for (std::size_t t = 0; t < clip.frames(); ++t)
          ratios.push_back(norm(after.position(j)[t] - after.position(p)[t]) /
                           norm(before.position(j)[t] - before.position(p)[t]));
      }
      std::sort(ratios.begin(), ratios.end());
      EXPECT_NEAR(ratios[ratios.size() * 99 / 100], wish, 0.02 * wish)
          << file << ", omega " << result.omega << ", sigma " << result.sigma;
    }
  }
}

TEST(Exaggerate, SaysWhenNothingMovesThatCouldStretch) {
  Alone work;
  const Motion still = gait("walk", 2).empty_like(50);
  ExaggerateParams params;
  params.wished_stretch = 1.5;
  EXPECT_TRUE(same_bits(still, exaggerate(still, params, work).motion));
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "wish-unreached");
}

TEST(DominantPeriod, OfAWalkIsItsStride) {
  const Motion walk = gait("walk", 6, 60);
  GaitParams params;
  const double period = dominant_period(world_motion(walk), walk.fps());
  EXPECT_GT(period, 0.8);
  EXPECT_LT(period, 1.4);
}

TEST(ExaggerateNode, BlendsByAmountRangeAndJoints) {
  const Motion walk = gait("walk", 2);
  const Motion none =
      NodeInMemory(exaggerate_node()).link("motion", walk).set("amount", 0).run().out<Motion>("motion");
  EXPECT_LT(difference(none, walk).turn, 1e-12);
  EXPECT_LT(difference(none, walk).position, 1e-12);
  const Motion some = NodeInMemory(exaggerate_node())
                          .link("motion", walk)
                          .set("range", Json(Json::Array{Json(30), Json(60)}))
                          .set("joints", "LeftArm>")
                          .run()
                          .out<Motion>("motion");
  const int arm = walk.skeleton().find("LeftArm"), leg = walk.skeleton().find("LeftLeg");
  EXPECT_GT(turn(some.rotation(arm)[45], walk.rotation(arm)[45]), 0.01);
  EXPECT_EQ(some.rotation(arm)[20], walk.rotation(arm)[20]);
  EXPECT_EQ(some.rotation(leg)[45], walk.rotation(leg)[45]);
}

TEST(ExaggerateNode, WarnsOfLinksThatComeOutStretchedOnly) {
  const Motion run = gait("run", 2);
  const auto told = [&](const std::string& param, Json value) {
    NodeInMemory node(exaggerate_node());
    node.link("motion", run).set("correct", false).set("omega", 12);
    if (!param.empty()) node.set(param, std::move(value));
    node.run();
    std::vector<std::pair<std::string, std::int64_t>> all;
    for (const Diagnostic& d : node.reported())
      if (!d.joint.empty()) all.emplace_back(d.joint, d.frame.value_or(-1));
    return all;
  };
  using namespace testing;
  ASSERT_THAT(told("", {}), Contains(Pair(Not("LeftForeArm"), Not(AllOf(Ge(30), Lt(60))))));
  EXPECT_THAT(told("amount", 0), IsEmpty());
  EXPECT_THAT(told("fade", 0), Not(IsEmpty()));
  EXPECT_THAT(told("joints", "LeftForeArm"), Each(Pair("LeftForeArm", _)));
  EXPECT_THAT(told("range", Json(Json::Array{Json(30), Json(60)})),
              AllOf(Not(IsEmpty()), Each(Pair(_, AllOf(Ge(0), Lt(100))))));
}

TEST(ExaggerateNode, TellsWhatItDidAndRefusesWhatCannotBe) {
  const Motion run = gait("run", 2);
  NodeInMemory node(exaggerate_node());
  node.link("motion", run).run();
  ASSERT_FALSE(node.reported().empty());
  EXPECT_EQ(node.reported()[0].code, "exaggerated");
  EXPECT_THAT(node.reported()[0].message, testing::HasSubstr("iterations"));
  EXPECT_EQ(NodeInMemory(exaggerate_node()).link("motion", run).set("auto", 0.5).refusal().param, "auto");
  EXPECT_EQ(NodeInMemory(exaggerate_node()).link("motion", run).set("max_link", 0.9).refusal().param,
            "max_link");
  EXPECT_ANY_THROW(NodeInMemory(exaggerate_node()).link("motion", run).set("delta", 0.6).run());
}

}  // namespace
}  // namespace kinegraph
