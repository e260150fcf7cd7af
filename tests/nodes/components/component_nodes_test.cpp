// ComponentEdit, ComponentMotion and ComponentProject as nodes, on clips of Gait.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/rebuild.h"
#include "nodes/motion/kinematics.h"
#include "nodes/time/motion_warp.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/components/small_components.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
NodeType component_edit_node();
NodeType component_motion_node();
NodeType component_project_node();
namespace {

using testing::HasSubstr;

Components walk_and_sneak(int components = 4) {
  Alone work;
  return analysed({shared(turning(gait("walk", 2.4), 0.6)), shared(gait("sneak", 2.8))},
                  Representation::points, components, work);
}
double farthest(const Points& a, const Points& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) worst = std::max(worst, std::fabs(a.data[i] - b.data[i]));
  return worst;
}
NodeInMemory editing(const Components& components, Json edits) {
  NodeInMemory node(component_edit_node());
  node.link("components", components);
  node.set("edits", Json::Array{std::move(edits)});
  return node;
}

TEST(ComponentEditNode, ChecksEachOpsFields) {
  const auto refused = [](const char* text) {
    NodeInMemory node(component_edit_node());
    Json::Array list{parse_value(component_edit_node().find_param("edits")->parts[0], text)};
    return check(*component_edit_node().find_param("edits"), list, "edits").front();
  };
  EXPECT_THAT(refused(R"({"op":"merge","name":"g"})").message, HasSubstr("\"terms\" is missing"));
  EXPECT_THAT(refused(R"({"op":"translate","component":1,"factor":2})").message, HasSubstr("no \"factor\""));
  EXPECT_EQ(refused(R"({"op":"transfer","components":1,"from":1,"to":0,"amount":"x"})").param,
            "edits[0].amount");
}

TEST(ComponentEditNode, ScalesOnTheBasesPath) {
  const Components c = walk_and_sneak();
  Json::Object scale{{"op", "scale"}, {"component", "u1"}, {"factor", 1.6}};
  NodeInMemory node = editing(c, scale);
  node.run();
  const Motion& walk = *c.segments[0].motion;
  const auto& motion = node.out<Motion>("motion");
  EXPECT_EQ(difference(motion, walk).position, 0);
  Alone work;
  const EncodedRoot before = encode_root(walk, work), after = encode_root(motion, work);
  for (std::size_t t = 0; t < walk.frames(); ++t) EXPECT_NEAR(before.heading[t], after.heading[t], 0.01);
  EXPECT_GT(difference(motion, walk).turn, 0.05);
}

TEST(ComponentEditNode, KeepsBonesAndDirectionsWithLimbs) {
  Alone work;
  const Components c = walk_and_sneak();
  Json::Object scale{{"op", "scale"}, {"component", 1}, {"factor", 1.8}};
  NodeInMemory node = editing(c, scale), loose = editing(c, scale);
  node.run();
  loose.set("limbs", false).run();
  const auto &points = node.out<Points>("points"), &raw = loose.out<Points>("points");
  const Skeleton& skeleton = *c.space.skeleton;
  double stretched = 0;
  for (int j = 1; j < skeleton.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    for (std::size_t t = 0; t < points.frames; ++t) {
      const Vec3 link = points.track(j)[t] - points.track(parent)[t],
                 free = raw.track(j)[t] - raw.track(parent)[t];
      ASSERT_NEAR(norm(link), skeleton.link_length(j), 1e-6);
      ASSERT_LT(norm(cross(normalized(link), normalized(free))), 1e-9);
      stretched = std::max(stretched, std::fabs(norm(free) / skeleton.link_length(j) - 1));
    }
  }
  EXPECT_GT(stretched, 0.01) << "or the test shows nothing";
  // Without limbs the motion's joints lie on the points, by varying translations.
  const WorldMotion world = world_motion(loose.out<Motion>("motion"));
  for (int j = 0; j < skeleton.size(); ++j)
    for (std::size_t t = 0; t < raw.frames; ++t)
      ASSERT_LT(norm(world.position(j)[t] - raw.track(j)[t]), 1e-9);
}

TEST(ComponentEditNode, TransferOfAllWithTheOthersTimingGivesThatMotionOnTheBasesPath) {
  Alone work;
  const Components c = walk_and_sneak();
  Json::Object transfer{{"op", "transfer"},
                        {"components", Json::Array{1, 2, 3, 4}},
                        {"from", 1},
                        {"to", 0},
                        {"keep_timing_of", "from"}};
  NodeInMemory node = editing(c, transfer);
  node.set("limbs", false).run();
  const auto& result = node.out<Components>("components");
  ASSERT_EQ(result.segments[0].frames(), c.segments[1].frames());
  const Rows kept = channels_from_signals(c, signals_of(c, c.segments[1]));
  const Points expected =
      points_from_channels(c.space, kept, *result.segments[0].motion, {false, true}, work);
  EXPECT_LT(farthest(node.out<Points>("points"), expected), 1e-12);
  // The path is the walk's: it ends where the walk does.
  const Motion& walk = *c.segments[0].motion;
  const Motion& moved = node.out<Motion>("motion");
  EXPECT_LT(
      norm(pose_at(walk, walk.frames() - 1).positions[0] - pose_at(moved, moved.frames() - 1).positions[0]),
      0.1);
}

TEST(ComponentEditNode, GoesOnFromItsOwnComponents) {
  const Components c = walk_and_sneak();
  const Json::Object first{{"op", "scale"}, {"component", 1}, {"factor", 1.5}},
      second{{"op", "translate"}, {"component", 2}, {"value", 0.4}};
  NodeInMemory one = editing(c, first);
  one.run();
  NodeInMemory two = editing(one.out<Components>("components"), second);
  two.run();
  NodeInMemory both(component_edit_node());
  both.link("components", c).set("edits", Json::Array{first, second}).run();
  EXPECT_LT(farthest(two.out<Points>("points"), both.out<Points>("points")), 1e-12);
}

TEST(ComponentEditNode, SubstitutesAMotionWarpedComponent) {
  Alone work;
  const Components c = walk_and_sneak();
  NodeInMemory shown(component_motion_node());
  shown.link("components", c).set("component", 1).run();
  const Motion& component = shown.out<Motion>("motion");
  NodeInMemory plain(component_edit_node()),
      same = editing(c, Json::Object{{"op", "substitute"}, {"component", 1}}), warped = same;
  plain.link("components", c).run();
  same.link("edited", component).run();
  EXPECT_LT(farthest(plain.out<Points>("points"), same.out<Points>("points")), 1e-9);
  const std::string arm = "LeftArm";
  const int joint = component.skeleton().find(arm);
  const Motion bent_motion = motion_warp(
      component, {{60, arm, component.rotation(joint)[60] * axis_angle({1, 0, 0}, 0.8), {}}}, work);
  warped.link("edited", bent_motion).run();
  EXPECT_GT(farthest(plain.out<Points>("points"), warped.out<Points>("points")), 0.02);
}

TEST(ComponentEditNode, WithAllComponentsAndNoEditsReturnsTheMotion) {
  for (Representation representation : {Representation::points, Representation::quaternions,
                                        Representation::euler, Representation::logarithm}) {
    Alone work;
    const Clips clips = {shared(turning(gait("walk", 2.4), 0.6)), shared(gait("sneak", 2.8))};
    IcaParams params;
    params.variance = 1;
    params.rotate = false;
    const std::vector<bool> all(clips.front()->joints(), true);
    Components c = components_of_motions(space_of_motions(representation, clips, all, true, {}, work), clips,
                                         params, work);
    NodeInMemory node(component_edit_node());
    node.link("components", std::move(c)).set("segment", 1).set("residual", true).run();
    const WorldMotion a = world_motion(node.out<Motion>("motion")), b = world_motion(*clips[1]);
    double apart = 0;
    for (int j = 0; j < a.joints(); ++j)
      for (std::size_t t = 0; t < a.frames(); ++t)
        apart = std::max(apart, norm(a.position(j)[t] - b.position(j)[t]));
    EXPECT_LT(apart, 1e-9) << name_of(representation);
  }
}

TEST(ComponentEditNode, StaysOnTheSpotWithoutRoot) {
  const Components c = walk_and_sneak();
  NodeInMemory node(component_edit_node());
  node.link("components", c).set("root", false).run();
  const auto& motion = node.out<Motion>("motion");
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    EXPECT_NEAR(motion.translation(0)[t].x, 0, 1e-9);
    EXPECT_NEAR(motion.translation(0)[t].z, 0, 1e-9);
  }
  const WorldMotion world = world_motion(motion);
  const auto& points = node.out<Points>("points");
  const int hand = motion.joints() - 1;
  EXPECT_LT(norm(world.position(hand)[50] - points.track(hand)[50]), 0.05);
}

TEST(ComponentMotionNode, SumsToTheRankKApproximation) {
  const Components c = walk_and_sneak(3);
  const auto shown = [&](Json which) {
    NodeInMemory node(component_motion_node());
    node.link("components", c).set("component", std::move(which)).set("segment", 1).run();
    return node;
  };
  NodeInMemory all = shown(Json::Array{}), listed = shown(Json::Array{1, "u2", 3}), first = shown(1),
               second = shown(2), third = shown(3), plain(component_edit_node());
  plain.link("components", c).set("segment", 1).set("limbs", false).run();
  EXPECT_EQ(all.out<Points>("points").data, listed.out<Points>("points").data);
  Alone work;
  NodeInMemory node(component_motion_node());
  Rows sum(c.space.channels(), c.segments[1].frames());
  for (std::size_t i = 0; i < 3; ++i) {
    const Rows x = channels_from_signals(c, signals_of(c, c.segments[1]), {i});
    for (std::size_t d = 0; d < x.rows; ++d)
      for (std::size_t t = 0; t < x.columns; ++t) sum(d, t) += x(d, t) - c.mean[d];
  }
  for (std::size_t d = 0; d < sum.rows; ++d)
    for (std::size_t t = 0; t < sum.columns; ++t) sum(d, t) += c.mean[d];
  const Points expected = points_of(c, sum, c.segments[1], {}, work);
  EXPECT_LT(farthest(all.out<Points>("points"), expected), 1e-9);
}

TEST(ComponentMotionNode, SaysThatPointsGiveNoMotion) {
  NodeInMemory node(component_motion_node());
  const Diagnostic d = node.link("components", small()).refusal();
  EXPECT_EQ(d.code, "no-motion");
  EXPECT_EQ(d.port, "motion");
}

TEST(ComponentProjectNode, FindsTheSignalsOfItsOwnClips) {
  const Components c = walk_and_sneak();
  NodeInMemory node(component_project_node());
  node.link("components", c).link("motion", ValuePtr(c.segments[1].motion)).run();
  const auto& projected = node.out<Components>("components");
  ASSERT_EQ(projected.segments.size(), 1u);
  for (std::size_t i = 0; i < c.count(); ++i)
    for (std::size_t t = 0; t < projected.frames(); ++t)
      ASSERT_NEAR(projected.signals(i, t), c.signals(i, c.segments[1].start + t), 1e-9);
}

}  // namespace
}  // namespace kinegraph
