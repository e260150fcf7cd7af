// Retarget between real skeletons: CMU's AMC and BVH, a game rig with twist bones, and glTF characters.
#include <gtest/gtest.h>

#include <memory>

#include "nodes/feet/carried_contacts.h"
#include "nodes/feet/footskate.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/character.h"
#include "nodes/time/retarget.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/time/retarget_measures.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

JointRoles both_sides(JointRoles middle, const JointRoles& left, const std::string& l, const std::string& r) {
  for (const auto& [role, name] : left) {
    const auto at = name.find("@");
    for (bool is_left : {true, false}) {
      std::string own = name;
      own.replace(at, 1, is_left ? l : r);
      middle[role + (is_left ? ".l" : ".r")] = own;
    }
  }
  return middle;
}

struct NamedBody {
  std::string name;
  Motion motion;
  std::shared_ptr<const Character> character;
  JointRoles roles;
};

NamedBody read_body(std::string name, const std::string& path, ReadOptions options, JointRoles roles) {
  PlainFiles files;
  Alone work;
  const MotionFile file = read_motion_file(mocap(path), options, files, work);
  NamedBody body{std::move(name), {}, {}, std::move(roles)};
  body.motion = dynamic_cast<const Motion&>(*file.find("motion"));
  if (const auto* character = file.find("character"))
    body.character = std::make_shared<const Character>(dynamic_cast<const Character&>(*character));
  return body;
}

JointRoles amc_roles() {
  return both_sides({{"pelvis", "root"},
                     {"spine.1", "lowerback"},
                     {"spine.2", "upperback"},
                     {"spine.3", "thorax"},
                     {"neck.1", "lowerneck"},
                     {"neck.2", "upperneck"},
                     {"head", "head"}},
                    {{"clavicle", "@clavicle"},
                     {"arm", "@humerus"},
                     {"forearm", "@radius"},
                     {"hand", "@wrist"},
                     {"thigh", "@femur"},
                     {"shin", "@tibia"},
                     {"foot", "@foot"},
                     {"toe", "@toes"}},
                    "l", "r");
}
JointRoles bvh_roles() {
  return both_sides({{"pelvis", "Hips"},
                     {"spine.1", "LowerBack"},
                     {"spine.2", "Spine"},
                     {"spine.3", "Spine1"},
                     {"neck.1", "Neck"},
                     {"neck.2", "Neck1"},
                     {"head", "Head"}},
                    {{"clavicle", "@Shoulder"},
                     {"arm", "@Arm"},
                     {"forearm", "@ForeArm"},
                     {"hand", "@Hand"},
                     {"thigh", "@UpLeg"},
                     {"shin", "@Leg"},
                     {"foot", "@Foot"},
                     {"toe", "@ToeBase"}},
                    "Left", "Right");
}
JointRoles game_roles() {
  return both_sides({{"pelvis", "CC_Base_Pelvis"},
                     {"spine.1", "CC_Base_Waist"},
                     {"spine.2", "CC_Base_Spine01"},
                     {"spine.3", "CC_Base_Spine02"},
                     {"neck.1", "CC_Base_NeckTwist01"},
                     {"neck.2", "CC_Base_NeckTwist02"},
                     {"head", "CC_Base_Head"}},
                    {{"clavicle", "CC_Base_@_Clavicle"},
                     {"arm", "CC_Base_@_Upperarm"},
                     {"forearm", "CC_Base_@_Forearm"},
                     {"hand", "CC_Base_@_Hand"},
                     {"thigh", "CC_Base_@_Thigh"},
                     {"shin", "CC_Base_@_Calf"},
                     {"foot", "CC_Base_@_Foot"},
                     {"toe", "CC_Base_@_ToeBase"}},
                    "L", "R");
}
// CesiumMan has no names; its nodes by number.
JointRoles cesium_roles() {
  return {{"pelvis", "node2"},     {"toe.l", "node10"},  {"toe.r", "node6"},  {"spine.1", "node11"},
          {"spine.3", "node12"},   {"neck.1", "node19"}, {"head", "node20"},  {"arm.l", "node16"},
          {"forearm.l", "node17"}, {"hand.l", "node18"}, {"arm.r", "node13"}, {"forearm.r", "node14"},
          {"hand.r", "node15"},    {"thigh.l", "node7"}, {"shin.l", "node8"}, {"foot.l", "node9"},
          {"thigh.r", "node3"},    {"shin.r", "node4"},  {"foot.r", "node5"}};
}
JointRoles knight_roles() {
  return both_sides({{"pelvis", "hips"}, {"spine.1", "spine"}, {"spine.3", "chest"}, {"head", "head"}},
                    {{"arm", "upperarm.@"},
                     {"forearm", "lowerarm.@"},
                     {"hand", "wrist.@"},
                     {"thigh", "upperleg.@"},
                     {"shin", "lowerleg.@"},
                     {"foot", "foot.@"},
                     {"toe", "toes.@"}},
                    "l", "r");
}

NamedBody amc(const std::string& clip = "16_31") {
  return read_body("AMC", "cmu/asfamc/" + clip + ".amc", {}, amc_roles());
}
NamedBody bvh(const std::string& clip = "08_01") {
  ReadOptions drop;
  drop.drop_rest_frame = true;
  return read_body("BVH", "cmu/bvh/" + clip + ".bvh", drop, bvh_roles());
}
NamedBody game_rig() {
  return read_body("game rig", "cmu/bvh_other/007_01_iclone.bvh", {}, game_roles());
}
NamedBody cesium_man() {
  return read_body("CesiumMan", "gltf/CesiumMan.glb", {}, cesium_roles());
}
NamedBody knight() {
  ReadOptions walking;
  walking.clip = "Walking_A";
  return read_body("Knight", "gltf/KayKit_Knight.glb", walking, knight_roles());
}

// With the names, armature and axes of a Mixamo download, at rest.
NamedBody mannequin() {
  PlainFiles files;
  Alone work;
  const MotionFile file =
      read_motion_file(source_folder() + "/graphs/characters/mannequin.glb", {}, files, work);
  JointRoles roles = both_sides({{"pelvis", "mixamorig:Hips"},
                                 {"spine.1", "mixamorig:Spine"},
                                 {"spine.2", "mixamorig:Spine1"},
                                 {"spine.3", "mixamorig:Spine2"},
                                 {"neck.1", "mixamorig:Neck"},
                                 {"head", "mixamorig:Head"}},
                                {{"clavicle", "mixamorig:@Shoulder"},
                                 {"arm", "mixamorig:@Arm"},
                                 {"forearm", "mixamorig:@ForeArm"},
                                 {"hand", "mixamorig:@Hand"},
                                 {"thigh", "mixamorig:@UpLeg"},
                                 {"shin", "mixamorig:@Leg"},
                                 {"foot", "mixamorig:@Foot"},
                                 {"toe", "mixamorig:@ToeBase"}},
                                "Left", "Right");
  return {"Mixamo-like", *file.motion(), nullptr, std::move(roles)};
}

Motion put(const Motion& motion, const Motion& target) {
  Alone work;
  return retarget(motion, {&target, {}}, {}, work).motion;
}
Motion with_clean_feet(const Motion& motion, const Contacts& contacts) {
  Alone work;
  return clean_footskate(motion, carried_contacts(contacts, motion, work), {},
                         std::vector<double>(motion.frames(), 1), work)
      .motion;
}

// What the sentences ask for, with much to spare: 5°, 10° and 2 cm/s.
void expect_follows(const NamedBody& from, const Contacts& contacts, const NamedBody& to, bool walks) {
  SCOPED_TRACE(from.name + " to " + to.name);
  const Motion made = put(from.motion, to.motion);
  const LinkErrors links = link_errors(from.motion, from.roles, made, to.roles);
  EXPECT_GE(links.links, 9);
  EXPECT_LT(links.direction, 0.01) << links.worst_direction;
  EXPECT_LT(links.twist, 1) << links.worst_twist;
  EXPECT_GE(links.held, 6);
  // Where one has no neck (the knight), the chest turns with the other's neck to aim at the head, and with it
  // the arms.
  const bool necks = from.roles.count("neck.1") && to.roles.count("neck.1");
  EXPECT_LT(links.held_direction, necks ? 0.01 : 6) << links.worst_held;
  const FootErrors source = foot_errors(from.motion, contacts);
  const FootErrors feet = foot_errors(with_clean_feet(made, contacts), contacts);
  EXPECT_GE(feet.plants, walks ? 9 : 0);
  EXPECT_LT(feet.skate, 0.001);
  EXPECT_LT(feet.largest, 0.02);
  const double larger = std::max(1.0, leg_length(to.motion.skeleton()) / leg_length(from.motion.skeleton()));
  EXPECT_LT(feet.off_ground, std::max(0.03, 1.3 * larger * source.off_ground));
}

TEST(RetargetOnClips, keeps_directions_turns_and_plants_from_each_body_to_each_other) {
  KINEGRAPH_NEEDS_MOCAP();
  // CesiumMan and the knight walk on the spot, where no foot is planted, and the Mixamo-like figure stands:
  // they go with a real walk.
  std::vector<NamedBody> all = {amc(), bvh(), game_rig(), cesium_man(), knight()};
  for (const NamedBody& walking : {cesium_man(), knight(), mannequin()}) {
    Alone work;
    const NamedBody of = amc("02_01");
    const Contacts contacts = detect_contacts(of.motion, {}, work);
    all.push_back(walking);
    all.back().name += " as 02_01";
    all.back().motion = with_clean_feet(put(of.motion, walking.motion), contacts);
  }
  for (const NamedBody& from : all) {
    Alone work;
    const Contacts contacts = detect_contacts(from.motion, {}, work);
    const bool in_place = from.name == "CesiumMan" || from.name == "Knight";
    for (const NamedBody& to : all)
      if (&from != &to) expect_follows(from, contacts, to, !in_place);
  }
}

// Soles then tilt where one body has its ankles higher, CesiumMan's by 50°; ankles stay about as high as over
// flat ones.
TEST(RetargetOnClips, feet_by_direction_point_from_ankle_to_toes_as_the_sources_do) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  RetargetParams params;
  params.feet_by = FeetBy::direction;
  std::vector<NamedBody> all = {amc(), bvh(), game_rig(), cesium_man(), knight(), mannequin()};
  all.back().motion = put(all.front().motion, all.back().motion);
  double largest = 0;
  for (const NamedBody& from : all)
    for (const NamedBody& to : all) {
      if (&from == &to) continue;
      SCOPED_TRACE(from.name + " to " + to.name);
      const Motion made = retarget(from.motion, {&to.motion, {}, {}}, params, work).motion;
      const LinkErrors links = link_errors(from.motion, from.roles, made, to.roles);
      EXPECT_LT(links.direction, 0.01) << links.worst_direction;
      EXPECT_LT(links.twist, 1) << links.worst_twist;
      const WorldMotion a = world_motion(from.motion), b = world_motion(made),
                        by_soles = world_motion(put(from.motion, to.motion));
      for (const char* side : {".l", ".r"}) {
        const std::string foot = std::string("foot") + side, toe = std::string("toe") + side;
        const auto joint = [](const NamedBody& of, const std::string& role) {
          return of.motion.skeleton().find(of.roles.at(role));
        };
        for (std::size_t t = 0; t < made.frames(); ++t) {
          const Vec3 u = a.position(joint(from, toe))[t] - a.position(joint(from, foot))[t];
          const Vec3 v = b.position(joint(to, toe))[t] - b.position(joint(to, foot))[t];
          ASSERT_LT(turn(smallest_turn(u, v)) * degrees_per_radian, 0.01) << toe << " " << t;
          largest = std::max(
              largest, std::fabs(b.position(joint(to, foot))[t].y - by_soles.position(joint(to, foot))[t].y));
        }
      }
    }
  EXPECT_LT(largest, 0.06);  // m
}

// CMU's BVH and CesiumMan hold both thighs at angles that a small turn of the pelvis makes alike; with the
// Mixamo-like figure no turn does, and the pelvis keeps how it stands.
TEST(RetargetOnClips, the_pelvis_turns_a_little_where_that_makes_its_links_alike) {
  KINEGRAPH_NEEDS_MOCAP();
  const auto apart = [](const NamedBody& from, const NamedBody& to) {
    const Motion made = put(from.motion, to.motion);
    const WorldMotion a = world_motion(from.motion), b = world_motion(made);
    double most = 0;
    for (const char* side : {"thigh.l", "thigh.r"})
      for (std::size_t t = 0; t < made.frames(); t += 5) {
        const auto link = [&](const WorldMotion& world, const NamedBody& of) {
          const Skeleton& s = of.motion.skeleton();
          return world.position(s.find(of.roles.at(side)))[t] -
                 world.position(s.find(of.roles.at("pelvis")))[t];
        };
        most = std::max(most, turn(smallest_turn(link(a, from), link(b, to))) * degrees_per_radian);
      }
    return most;
  };
  EXPECT_LT(apart(bvh(), cesium_man()), 5);
  EXPECT_LT(apart(amc("02_01"), cesium_man()), 5);
  EXPECT_LT(apart(bvh(), amc("02_01")), 5);
  EXPECT_GT(apart(bvh(), mannequin()), 25);
}

// Joints that hold several links hold them at fixed angles. Two links that the source has at another angle to
// each other can't both point as its do: whatever turns the joint, one is off by half the difference. So each
// link is within 5°, or such a pair is at its joint.
TEST(RetargetOnClips, links_at_one_joint_point_as_the_sources_unless_no_turn_could_make_them) {
  KINEGRAPH_NEEDS_MOCAP();
  std::vector<NamedBody> bodies = {amc("02_01"), bvh("08_01"), mannequin(), cesium_man()};
  bodies[2].motion = put(bodies[0].motion, bodies[2].motion);
  const auto degrees = [](Vec3 u, Vec3 v) { return turn(smallest_turn(u, v)) * degrees_per_radian; };
  int alike = 0, impossible = 0;
  for (const NamedBody& from : bodies)
    for (const NamedBody& to : bodies) {
      if (&from == &to) continue;
      SCOPED_TRACE(from.name + " to " + to.name);
      const Motion made = put(from.motion, to.motion);
      const WorldMotion a = world_motion(from.motion), b = world_motion(made);
      for (const auto& [joint, ends] : std::map<std::string, std::vector<std::string>>{
               {"pelvis", {"spine.1", "thigh.l", "thigh.r"}},
               {"spine.3", {"neck.1", "clavicle.l", "clavicle.r", "arm.l", "arm.r"}}}) {
        std::vector<std::pair<Vec3, Vec3>> links;
        const auto way = [](const NamedBody& of, const WorldMotion& world, const std::string& start,
                            const std::string& end) {
          if (!of.roles.count(start) || !of.roles.count(end)) return Vec3{};
          const Skeleton& s = of.motion.skeleton();
          return world.position(s.find(of.roles.at(end)))[0] - world.position(s.find(of.roles.at(start)))[0];
        };
        for (const std::string& end : ends) {
          const std::string clavicle = "clavicle" + end.substr(end.find('.'));
          if (end.starts_with("arm") && from.roles.count(clavicle) && to.roles.count(clavicle)) continue;
          const Vec3 u = way(from, a, joint, end), v = way(to, b, joint, end);
          if (norm(u) > 1e-4 && norm(v) > 1e-4) links.emplace_back(u, v);
        }
        double off = 0, least = 0;
        for (const auto& [u, v] : links) {
          off = std::max(off, degrees(u, v));
          for (const auto& [u2, v2] : links)
            least = std::max(least, 0.5 * std::fabs(degrees(u, u2) - degrees(v, v2)));
        }
        EXPECT_TRUE(off < 5 || least > 5) << joint << " " << off << " " << least;
        ++(off < 5 ? alike : impossible);
      }
    }
  EXPECT_GE(alike, 6);
  EXPECT_LE(impossible, 18);
}

// By how much Footskate turned a foot, degrees.
double largest_turn_of_feet(const Motion& made, const Motion& clean) {
  const WorldMotion a = world_motion(made), b = world_motion(clean);
  double most = 0;
  for (const Leg& leg : find_legs(made.skeleton()))
    for (std::size_t t = 0; t < made.frames(); ++t)
      most =
          std::max(most, turn(a.orientation(leg.ankle)[t], b.orientation(leg.ankle)[t]) * degrees_per_radian);
  return most;
}

// Walks of every family of files, a run, a dance and a boxer: where the source's feet are planted, the
// target's are.
TEST(RetargetOnClips, plants_of_every_family_of_clips_hold_still_after_footskate) {
  KINEGRAPH_NEEDS_MOCAP();
  ReadOptions drop;
  drop.drop_rest_frame = true;
  ReadOptions z_up;
  z_up.up = "z";
  const std::vector<std::pair<std::string, ReadOptions>> clips = {{"cmu/asfamc/07_05.amc", {}},
                                                                  {"cmu/asfamc/17_03.amc", {}},
                                                                  {"cmu/asfamc/16_45.amc", {}},
                                                                  {"cmu/asfamc/35_01.amc", {}},
                                                                  {"cmu/bvh/08_07.bvh", drop},
                                                                  {"cmu/bvh/05_03.bvh", drop},
                                                                  {"cmu/bvh/104_HappyStartWalk_3.bvh", drop},
                                                                  {"cmu/bvh_max/131_01.bvh", drop},
                                                                  {"cmu/bvh_other/007_01_iclone.bvh", {}},
                                                                  {"accad/Male1_B3_Walk.bvh", {}},
                                                                  {"bandai/dataset-1_walk_old_001.bvh", {}},
                                                                  {"bandai/dataset-1_walk_proud_001.bvh", {}},
                                                                  {"m21/OLD-1.bvh", {}},
                                                                  {"m21/HAPPY.bvh", {}},
                                                                  {"xia/strutting_01_000.bvh", {}},
                                                                  {"odd/MS2_8Walk_M.bvh", {}},
                                                                  {"fair/dab.bvh", z_up}};
  const std::vector<NamedBody> targets = {amc("02_01"), bvh("08_01"), mannequin(), cesium_man()};
  int plants = 0;
  for (const auto& [path, options] : clips) {
    Alone work;
    const NamedBody from = read_body(path, path, options, {});
    const Contacts contacts = detect_contacts(from.motion, {}, work);
    for (const NamedBody& to : targets) {
      SCOPED_TRACE(path + " to " + to.name);
      const Motion made = put(from.motion, to.motion), clean = with_clean_feet(made, contacts);
      const FootErrors feet = foot_errors(clean, contacts);
      EXPECT_LT(feet.skate, 0.002);
      EXPECT_LT(feet.largest, 0.02);
      EXPECT_LT(largest_turn_of_feet(made, clean), 35);
      plants += feet.plants;
    }
  }
  EXPECT_GT(plants, 600);
}

TEST(RetargetOnClips, of_one_trial_the_amc_on_the_bvhs_skeleton_is_the_bvh) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* clip : {"02_01", "09_06", "05_03"}) {
    SCOPED_TRACE(clip);
    const Motion truth = bvh(clip).motion;
    const Motion made = put(amc(clip).motion, truth);
    ASSERT_EQ(made.frames(), truth.frames());
    const WorldMotion a = world_motion(made), b = world_motion(truth);
    for (const char* name : {"Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg",
                             "RightFoot", "LowerBack", "Spine", "Spine1", "LeftArm", "LeftForeArm",
                             "LeftHand", "RightArm", "RightForeArm", "RightHand", "Head"}) {
      const int j = truth.skeleton().find(name);
      for (std::size_t t = 0; t < truth.frames(); t += 5) {
        EXPECT_LT(turn(a.orientation(j)[t], b.orientation(j)[t]) * degrees_per_radian, 0.1) << name << t;
        const Vec3 off = a.position(j)[t] - b.position(j)[t];
        EXPECT_LT(norm(off), 0.005) << name << " " << t;
      }
    }
  }
}

TEST(RetargetOnClips, any_clip_goes_onto_any_character) {
  KINEGRAPH_NEEDS_MOCAP();
  ReadOptions drop;
  drop.drop_rest_frame = true;
  ReadOptions z_up;
  z_up.up = "z";
  const std::vector<std::pair<std::string, ReadOptions>> clips = {{"cmu/bvh_daz/141_01.bvh", drop},
                                                                  {"cmu/bvh_max/131_01.bvh", drop},
                                                                  {"accad/Male1_B3_Walk.bvh", {}},
                                                                  {"bandai/dataset-1_walk_old_001.bvh", {}},
                                                                  {"m21/OLD-1.bvh", {}},
                                                                  {"xia/strutting_01_000.bvh", {}},
                                                                  {"odd/Boxing_Toes.bvh", {}},
                                                                  {"odd/MS2_8Walk_M.bvh", {}},
                                                                  {"odd/mixed_orders_test3.bvh", {}},
                                                                  {"gltf/RiggedFigure.glb", {}},
                                                                  {"gltf/rig_transfer_from_bvh.glb", {}},
                                                                  {"fair/dab.bvh", z_up}};
  const NamedBody to = cesium_man();
  for (const auto& [path, options] : clips) {
    SCOPED_TRACE(path);
    const NamedBody from = read_body(path, path, options, {});
    Alone work;
    const RetargetResult made = retarget(from.motion, {&to.motion, {}}, {}, work);
    EXPECT_FALSE(made.motion.non_finite());
    // All of CesiumMan but its neck and lower back finds a partner.
    const auto& of = made.pairs.source_of;
    EXPECT_GE(std::count_if(of.begin(), of.end(), [](int i) { return i >= 0; }), 17);
    for (const Diagnostic& one : work.reported) EXPECT_NE(one.code, "not-upright") << one.message;
    // And the other way round.
    const Motion back = put(to.motion, from.motion);
    EXPECT_FALSE(back.non_finite());
    const WorldMotion world = world_motion(back);
    const Body body = find_body(back.skeleton());
    ASSERT_GE(body.head, 0);
    for (std::size_t t = 0; t < back.frames(); t += 7) {
      const Vec3 up = world.position(body.head)[t] - world.position(body.pelvis)[t];
      EXPECT_GT(up.y, 0.9 * norm(up));
    }
  }
}

// Height of the lowest and highest point of what is bound to joints.
std::pair<double, double> extent(const Character& character, const Pose& pose) {
  std::pair<double, double> out{1e9, -1e9};
  for (const MeshPart& part : character.parts) {
    if (part.skin < 0) continue;
    for (Vec3 v : posed_vertices(character, part, pose))
      out = {std::min(out.first, v.y), std::max(out.second, v.y)};
  }
  return out;
}

TEST(RetargetOnClips, the_skin_follows_upright_and_on_the_ground) {
  KINEGRAPH_NEEDS_MOCAP();
  const NamedBody rigged = read_body("RiggedFigure", "gltf/RiggedFigure.glb", {}, {});
  for (const NamedBody& walk : {bvh("02_01"), amc("17_03")}) {
    Alone work;
    const Contacts contacts = detect_contacts(walk.motion, {}, work);
    for (const NamedBody& to : {cesium_man(), knight(), rigged}) {
      SCOPED_TRACE(walk.name + " to " + to.name);
      ASSERT_TRUE(to.character);
      const auto rest = extent(*to.character, rest_pose_of(*to.character->skeleton));
      const double height = rest.second - rest.first;
      const Motion target(to.character->skeleton, to.motion.shared_source(), 30, 0, {});
      const Motion made =
          retarget(walk.motion, {&target, rest.first, sole_points(*to.character)}, {}, work).motion;
      const Motion clean = with_clean_feet(made, contacts);
      std::vector<double> lows, clean_lows;
      for (std::size_t t = 0; t < made.frames(); t += 6) {
        lows.push_back(extent(*to.character, pose_for(*to.character, made, t)).first);
        const auto now = extent(*to.character, pose_for(*to.character, clean, t));
        clean_lows.push_back(now.first);
        EXPECT_LT(now.second, 1.1 * height);
        EXPECT_GT(now.second, 0.75 * height);
      }
      for (auto* all : {&lows, &clean_lows}) {
        std::sort(all->begin(), all->end());
        EXPECT_LT(std::fabs((*all)[all->size() / 2]), 0.02);
        EXPECT_LT(all->back(), 0.03);
      }
      EXPECT_GT(lows.front(), -0.035);
      EXPECT_GT(clean_lows.front(), -0.045);
    }
  }
}

}  // namespace
}  // namespace kinegraph
