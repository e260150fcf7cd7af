#include "nodes/time/retarget.h"

#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/feet/carried_contacts.h"
#include "nodes/feet/footskate.h"
#include "nodes/files/motion_file.h"
#include "nodes/gait/gait.h"
#include "nodes/motion/character.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/time/other_bodies.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

class Retarget : public ::testing::Test {
 protected:
  Alone work;

  static Motion gait(const std::string& kind, double seconds = 3) {
    GaitParams params;
    params.gait = kind;
    params.seconds = seconds;
    Alone quiet;
    return make_gait(params, quiet);
  }
  static JointRoles gait_roles() {
    JointRoles roles = {{"spine.1", "Spine"}, {"spine.3", "Spine1"}, {"neck.1", "Neck"}, {"head", "Head"}};
    for (const char* side : {"Left", "Right"}) {
      const std::string s = side[0] == 'L' ? ".l" : ".r", n = side;
      for (auto [role, name] : {std::pair{"clavicle", "Shoulder"},
                                {"arm", "Arm"},
                                {"forearm", "ForeArm"},
                                {"hand", "Hand"},
                                {"thigh", "UpLeg"},
                                {"shin", "Leg"},
                                {"foot", "Foot"}})
        roles[role + s] = n + name;
    }
    return roles;
  }
  Motion on(const Motion& motion, const Motion& target, std::vector<std::string> map = {}) {
    return retarget(motion, {&target, {}}, {std::move(map), 0}, work).motion;
  }
  Motion with_clean_feet(const Motion& motion, const Contacts& contacts) {
    return clean_footskate(motion, carried_contacts(contacts, motion, work), {},
                           std::vector<double>(motion.frames(), 1), work)
        .motion;
  }
  Diagnostic refusal(const Motion& motion, const Motion& target, std::vector<std::string> map = {}) {
    try {
      on(motion, target, std::move(map));
    } catch (const Failure& failure) {
      return failure.diagnostic();
    }
    ADD_FAILURE() << "was not refused";
    return {};
  }
  const Diagnostic* told(const std::string& code) const {
    for (const Diagnostic& one : work.reported)
      if (one.code == code) return &one;
    return nullptr;
  }
  static std::shared_ptr<const Character> mannequin() {
    PlainFiles files;
    Alone quiet;
    const std::string path = source_folder() + "/graphs/characters/mannequin.glb";
    return std::make_shared<const Character>(
        dynamic_cast<const Character&>(*read_motion_file(path, {}, files, quiet).find("character")));
  }
  static double lowest(const Character& character, const Pose& pose) {
    double low = 1e9;
    for (const MeshPart& part : character.parts)
      for (Vec3 v : posed_vertices(character, part, pose)) low = std::min(low, v.y);
    return low;
  }
  static double largest_turn(const Motion& a, const Motion& b) {
    double largest = 0;
    for (int j = 0; j < a.joints(); ++j)
      for (std::size_t t = 0; t < a.frames(); ++t)
        largest = std::max(largest, turn(a.rotation(j)[t], b.rotation(j)[t]));
    return largest;
  }
};

TEST_F(Retarget, keeps_directions_turns_and_plants_between_four_bodies) {
  const Motion walk = gait("walk");
  const Contacts contacts = detect_contacts(walk, {}, work);
  struct Body {
    std::string name;
    Motion motion;
    JointRoles roles;
  };
  std::vector<Body> bodies = {{"Gait", walk, gait_roles()}};
  for (const OtherBody& other : {amc_like(), mixamo_like(), nameless()})
    bodies.push_back({other.name, with_clean_feet(on(walk, other.motion()), contacts), other.roles});
  for (const Body& from : bodies) {
    const Contacts own = carried_contacts(contacts, from.motion, work);
    for (const Body& to : bodies) {
      if (&from == &to) continue;
      SCOPED_TRACE(from.name + " to " + to.name);
      const Motion made = on(from.motion, to.motion);
      EXPECT_EQ(made.frames(), from.motion.frames());
      EXPECT_EQ(made.fps(), from.motion.fps());
      const LinkErrors links = link_errors(from.motion, from.roles, made, to.roles);
      EXPECT_GE(links.links, 10);
      EXPECT_LT(links.direction, 0.01) << links.worst_direction;
      EXPECT_LT(links.twist, 1) << links.worst_twist;
      const FootErrors feet = foot_errors(with_clean_feet(made, own), own);
      EXPECT_GT(feet.plants, 10);
      EXPECT_LT(feet.skate, 0.001);
      EXPECT_LT(feet.off_ground, 0.005);
    }
  }
  EXPECT_EQ(told("no-common-joint"), nullptr);
}

TEST_F(Retarget, there_and_back_is_the_motion_itself) {
  const Motion walk = gait("jaunty");
  for (const OtherBody& other : {amc_like(), mixamo_like()}) {
    SCOPED_TRACE(other.name);
    const Motion back = on(on(walk, other.motion()), walk);
    for (int j = 0; j < walk.joints(); ++j)
      for (std::size_t t = 0; t < walk.frames(); ++t)
        EXPECT_LT(turn(back.rotation(j)[t], walk.rotation(j)[t]), 1e-6) << walk.skeleton().joints[j].name;
    for (std::size_t t = 0; t < walk.frames(); ++t)
      EXPECT_LT(norm(back.translation(0)[t] - walk.translation(0)[t]), 0.01) << t;
  }
}

TEST_F(Retarget, onto_its_own_skeleton_changes_nothing) {
  const Motion walk = gait("walk", 1);
  const Motion same = on(walk, walk);
  EXPECT_LT(largest_turn(walk, same), 1e-9);
  for (std::size_t t = 0; t < walk.frames(); ++t)
    EXPECT_LT(norm(same.translation(0)[t] - walk.translation(0)[t]), 0.002);
}

TEST_F(Retarget, scales_the_path_by_the_legs_and_keeps_its_heading) {
  Motion walk = gait("walk");
  const double ratio = leg_length(nameless().skeleton) / leg_length(walk.skeleton());
  const Motion made = on(walk, nameless().motion());
  const auto way = [](const Motion& motion) {
    const WorldMotion world = world_motion(motion);
    return world.position(0)[motion.frames() - 1] - world.position(0)[0];
  };
  EXPECT_NEAR(way(made).z, ratio * way(walk).z, 0.01 * way(walk).z);
  EXPECT_NEAR(way(made).x, ratio * way(walk).x, 0.01);
  const Motion twice = retarget(walk, {&walk, {}}, {{}, 2}, work).motion;
  EXPECT_NEAR(way(twice).z, 2 * way(walk).z, 0.01);
}

TEST_F(Retarget, a_motion_that_turns_turns_the_same_way_on_a_body_that_rests_facing_elsewhere) {
  Motion walk = gait("walk", 1);
  const Quat turned = about_y(1.1);
  for (std::size_t t = 0; t < walk.frames(); ++t) {
    walk.rotation(0).set(t, turned * walk.rotation(0)[t]);
    walk.translation(0).set(t, rotate(turned, walk.translation(0)[t]));
  }
  const Motion made = on(walk, nameless().motion());
  EXPECT_LT(link_errors(walk, gait_roles(), made, nameless().roles).direction, 0.01);
}

TEST_F(Retarget, feet_stand_on_the_ground_whatever_the_legs) {
  const Motion walk = gait("sneak");
  const Contacts contacts = detect_contacts(walk, {}, work);
  for (const OtherBody& other : {amc_like(), mixamo_like(), nameless()}) {
    const Motion made = on(walk, other.motion());
    const WorldMotion world = world_motion(made);
    // As they stand, ankles are 75 mm over the sole of every body; Gait's toe joints 20 mm.
    for (const Leg& leg : find_legs(made.skeleton())) {
      for (const FootPoint& point : contacts.points) {
        if (point.left != leg.left || point.part != "heel") continue;
        for (const auto& run : runs_of(point.planted))
          for (std::size_t t = run.start; t < run.end; ++t)
            EXPECT_NEAR(world.position(leg.ankle)[t].y, 0.075, 0.015) << other.name << " " << t;
      }
    }
  }
}

TEST_F(Retarget, bends_toes_of_a_skin_that_would_go_below_the_ground) {
  const auto character = mannequin();
  const Motion target(character->skeleton, std::make_shared<SourceFacts>(), 30, 0, {});
  const double sole = lowest(*character, rest_pose_of(*character->skeleton));
  // Toes that point down all the time.
  Motion walk = gait("walk");
  for (const Leg& leg : find_legs(walk.skeleton()))
    for (std::size_t t = 0; t < walk.frames(); ++t)
      walk.rotation(leg.toe).set(t, walk.rotation(leg.toe)[t] * axis_angle({1, 0, 0}, 0.7));
  const Motion plain = retarget(walk, {&target, sole, {}}, {}, work).motion;
  const Motion bent = retarget(walk, {&target, sole, sole_points(*character)}, {}, work).motion;
  double plain_low = 0, bent_low = 0;
  for (std::size_t t = 0; t < walk.frames(); ++t) {
    plain_low = std::min(plain_low, lowest(*character, pose_for(*character, plain, t)));
    bent_low = std::min(bent_low, lowest(*character, pose_for(*character, bent, t)));
  }
  EXPECT_LT(plain_low, -0.04);
  EXPECT_GT(bent_low, -0.012);
  // Nothing but feet and toes is changed, and they don't jump.
  const std::vector<Leg> legs = find_legs(*character->skeleton);
  for (int j = 0; j < bent.joints(); ++j) {
    const bool foot =
        std::any_of(legs.begin(), legs.end(), [&](const Leg& leg) { return j == leg.ankle || j == leg.toe; });
    for (std::size_t t = 0; t < walk.frames(); ++t) {
      if (!foot) {
        EXPECT_EQ(bent.rotation(j)[t], plain.rotation(j)[t]);
      }
      if (t > 0) {
        EXPECT_LT(turn(bent.rotation(j)[t], bent.rotation(j)[t - 1]), 0.2) << t;
      }
    }
  }
}

TEST_F(Retarget, a_root_below_the_body_goes_along_on_the_ground) {
  OtherBody other = mixamo_like();
  Skeleton s;
  s.above = other.skeleton.above;
  s.above_scale = other.skeleton.above_scale;
  s.joints.push_back({"armature", -1, {}, {}});
  for (Joint joint : other.skeleton.joints) {
    ++joint.parent;
    s.joints.push_back(joint);
  }
  s.ends = other.skeleton.ends;
  for (EndSite& end : s.ends) ++end.joint;
  other.skeleton = s;
  const Motion walk = gait("walk");
  const Motion made = on(walk, other.motion());
  EXPECT_LT(link_errors(walk, gait_roles(), made, other.roles).direction, 0.01);
  const WorldMotion world = world_motion(made), source = world_motion(walk);
  const double ratio = leg_length(s) / leg_length(walk.skeleton());
  for (std::size_t t = 0; t < made.frames(); ++t) {
    EXPECT_NEAR(world.position(0)[t].y, world.position(0)[0].y, 1e-9);
    EXPECT_NEAR(world.position(0)[t].z - world.position(0)[0].z,
                ratio * (source.position(0)[t].z - source.position(0)[0].z), 0.03);
  }
}

TEST_F(Retarget, shares_the_back_out_over_more_spine_joints) {
  OtherBody other = amc_like();
  const Motion strut = gait("strut", 1);
  const Motion made = on(strut, other.motion());
  // Gait's spine has two joints: upperback, between, stands between lowerback and thorax.
  const WorldMotion world = world_motion(made);
  const auto of = [&](const char* name, std::size_t t) {
    return world.orientation(made.skeleton().find(name))[t];
  };
  double bend = 0;
  for (std::size_t t = 0; t < made.frames(); t += 10) {
    const double whole = turn(of("lowerback", t), of("thorax", t));
    const double low = turn(of("lowerback", t), of("upperback", t));
    const double high = turn(of("upperback", t), of("thorax", t));
    EXPECT_NEAR(low + high, whole, 0.05);
    EXPECT_GT(low, 0.3 * whole);
    EXPECT_GT(high, 0.3 * whole);
    bend = std::max(bend, whole);
  }
  EXPECT_GT(bend, 0.1);
}

TEST_F(Retarget, a_map_overrides_what_was_found) {
  const Motion walk = gait("walk", 0.5);
  const Motion target = mixamo_like().motion();
  const auto pairs = [&](std::vector<std::string> map) {
    return pair_joints(walk.skeleton(), target.skeleton(), map, work).source_of;
  };
  const auto of = [&](const char* name) { return target.skeleton().find(std::string("mixamorig:") + name); };
  EXPECT_EQ(pairs({})[of("LeftArm")], walk.skeleton().find("LeftArm"));
  EXPECT_EQ(pairs({"RightArm=mixamorig:LeftArm"})[of("LeftArm")], walk.skeleton().find("RightArm"));
  EXPECT_EQ(pairs({"=mixamorig:LeftArm"})[of("LeftArm")], -1);
  EXPECT_EQ(pairs({"LeftArm="})[of("LeftArm")], -1);
  // One joint may lead two.
  const auto both = pairs({"LeftArm=mixamorig:LeftArm", "LeftArm=mixamorig:RightArm"});
  EXPECT_EQ(both[of("LeftArm")], both[of("RightArm")]);
  on(walk, target, {"LeftArm=mixamorig:LeftArm", "LeftArm=mixamorig:RightArm"});
}

TEST_F(Retarget, refuses_maps_by_their_entry_and_says_what_to_do) {
  const Motion walk = gait("walk", 0.5);
  const Motion target = mixamo_like().motion();
  Diagnostic d = refusal(walk, target, {"LeftArm=mixamorig:LeftArm", "LeftAm=mixamorig:Neck"});
  EXPECT_EQ(d.code, "unknown-joint");
  EXPECT_EQ(d.param, "map[1]");
  EXPECT_EQ(d.joint, "LeftAm");
  EXPECT_NE(d.hint.find("LeftArm"), std::string::npos);
  d = refusal(walk, target, {"mixamorig:LeftArm=LeftArm"});
  EXPECT_NE(d.hint.find("is a joint of the other side"), std::string::npos) << d.hint;
  d = refusal(walk, target, {"LeftArm=mixamorig:Neck", "RightArm=mixamorig:Neck"});
  EXPECT_EQ(d.code, "bad-map");
  EXPECT_EQ(d.joint, "mixamorig:Neck");
  EXPECT_NE(d.message.find("LeftArm=mixamorig:Neck"), std::string::npos);
  EXPECT_EQ(refusal(walk, target, {"LeftArm"}).code, "bad-map");
}

TEST_F(Retarget, refuses_cameras_and_props) {
  Skeleton prop;
  prop.joints.push_back({"Camera", -1, {0, 1, 0}, {}});
  const Motion camera(std::make_shared<const Skeleton>(prop), std::make_shared<SourceFacts>(), 30, 0, {});
  const Motion walk = gait("walk", 0.5);
  Diagnostic d = refusal(walk, camera);
  EXPECT_EQ(d.code, "no-body");
  EXPECT_EQ(d.port, "target");
  EXPECT_NE(d.message.find("1 joint (Camera)"), std::string::npos) << d.message;
  EXPECT_NE(d.hint.find("FROM=TO"), std::string::npos);
  EXPECT_EQ(refusal(sample_motion(3, 30, 1, prop), walk).port, "motion");
  // With a map a prop can go where the hips do.
  const Motion made = on(walk, camera, {"Hips=Camera"});
  EXPECT_EQ(made.frames(), walk.frames());
  EXPECT_FALSE(made.non_finite());
}

TEST_F(Retarget, links_without_length_and_single_frames_are_no_trouble) {
  OtherBody other = amc_like();
  for (const char* joint : {"lfingers", "lowerneck", "upperback"})
    other.skeleton.joints[other.skeleton.find(joint)].offset = {};
  const Motion walk = gait("walk", 0.5);
  EXPECT_FALSE(on(walk, other.motion()).non_finite());
  Skeleton flat = other.skeleton;
  for (Joint& joint : flat.joints) joint.offset = {};
  flat.ends.clear();
  const Motion point(std::make_shared<const Skeleton>(flat), std::make_shared<SourceFacts>(), 30, 0, {});
  EXPECT_FALSE(on(walk, point).non_finite());
  EXPECT_NE(told("not-upright"), nullptr);
  Motion one = walk.empty_like(1);
  EXPECT_EQ(on(one, nameless().motion()).frames(), 1u);
  EXPECT_EQ(on(walk.empty_like(0), nameless().motion()).frames(), 0u);
}

TEST_F(Retarget, names_the_joints_that_stay_at_rest) {
  on(gait("walk", 0.5), mixamo_like().motion(), {"=mixamorig:LeftArm"});
  ASSERT_NE(told("no-partner"), nullptr);
  EXPECT_NE(told("no-partner")->message.find("mixamorig:LeftArm"), std::string::npos);
}

TEST_F(Retarget, takes_the_targets_layout_and_the_motions_rate) {
  const Motion walk = gait("walk", 0.5);
  const Motion made = on(sample_motion(10, 60, 3), walk);
  EXPECT_EQ(made.source().format, walk.source().format);
  EXPECT_EQ(made.source().bvh.size(), walk.source().bvh.size());
  EXPECT_EQ(made.fps(), 60);
  EXPECT_EQ(made.shared_skeleton(), walk.shared_skeleton());
}

TEST_F(Retarget, a_rest_pose_that_shows_no_body_is_read_from_its_most_upright_frame) {
  // As some exporters write it: every bone along x of its own axes, nothing at rest.
  const OtherBody other = amc_like();
  const Motion walk = on(gait("walk", 1), other.motion());
  Skeleton s = other.skeleton;
  std::vector<Quat> own;  // local axes: bones along x
  for (int j = 0; j < s.size(); ++j) {
    Vec3 way{1, 0, 0};
    for (int child : s.children(j)) way = s.joints[child].offset;
    own.push_back(smallest_turn({1, 0, 0}, way));
  }
  for (int j = 1; j < s.size(); ++j)
    s.joints[j].offset = rotate(inverse(own[s.joints[j].parent]), s.joints[j].offset);
  for (EndSite& end : s.ends) end.offset = rotate(inverse(own[end.joint]), end.offset);
  Motion odd(std::make_shared<const Skeleton>(s), walk.shared_source(), walk.fps(), walk.frames(),
             walk.translating());
  for (int j = 0; j < s.size(); ++j) {
    const int parent = s.joints[j].parent;
    for (std::size_t t = 0; t < walk.frames(); ++t)
      odd.rotation(j).set(t, (parent < 0 ? Quat{} : inverse(own[parent])) * walk.rotation(j)[t] * own[j]);
  }
  for (std::size_t t = 0; t < walk.frames(); ++t) odd.translation(0).set(t, walk.translation(0)[t]);
  const Motion plain = gait("walk", 0.1), made = on(odd, plain);
  EXPECT_LT(link_errors(walk, other.roles, made, gait_roles()).direction, 0.01);
  EXPECT_LT(link_errors(walk, other.roles, made, gait_roles()).twist, 1);
}

TEST_F(Retarget, as_a_node_takes_a_character_too) {
  auto character = std::make_shared<Character>();
  character->skeleton = std::make_shared<const Skeleton>(mixamo_like().skeleton);
  NodeInMemory node(*all_nodes().find("Retarget"));
  node.link("motion", gait("walk", 0.5)).link("target", ValuePtr(character)).run();
  EXPECT_EQ(&node.out<Motion>("motion").skeleton(), character->skeleton.get());
}

TEST_F(Retarget, contacts_of_another_body_are_carried_over_by_footskate) {
  const Motion walk = gait("walk");
  const Contacts contacts = detect_contacts(walk, {}, work);
  const Motion made = on(walk, nameless().motion());
  NodeInMemory node(*all_nodes().find("Footskate"));
  node.link("motion", made).link("contacts", contacts).run();
  const auto& held = node.out<Contacts>("contacts");
  EXPECT_EQ(held.points.size(), 4u);
  EXPECT_EQ(held.points[0].foot, made.skeleton().joints[find_legs(made.skeleton())[0].ankle].name);
  EXPECT_EQ(held.points[0].planted, contacts.points[0].planted);
  EXPECT_LT(foot_errors(node.out<Motion>("motion"), contacts).skate, 0.001);
  // On its own body nothing is carried.
  EXPECT_EQ(encoded(carried_contacts(contacts, walk, work)), encoded(contacts));
}

}  // namespace
}  // namespace kinegraph
