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

struct Body4 {
  std::string name;
  Motion motion;
  std::shared_ptr<const Character> character;
  JointRoles roles;
};

Body4 read_body(std::string name, const std::string& path, ReadOptions options, JointRoles roles) {
  PlainFiles files;
  Alone work;
  const MotionFile file = read_motion_file(mocap(path), options, files, work);
  Body4 body{std::move(name), {}, {}, std::move(roles)};
  body.motion = dynamic_cast<const Motion&>(*file.find("motion"));
  if (const auto* character = file.find("character"))
    body.character = std::make_shared<const Character>(dynamic_cast<const Character&>(*character));
  return body;
}

JointRoles amc_roles() {
  return both_sides({{"spine.1", "lowerback"},
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
                     {"foot", "@foot"}},
                    "l", "r");
}
JointRoles bvh_roles() {
  return both_sides({{"spine.1", "LowerBack"},
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
                     {"foot", "@Foot"}},
                    "Left", "Right");
}
JointRoles game_roles() {
  return both_sides({{"spine.1", "CC_Base_Waist"},
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
                     {"foot", "CC_Base_@_Foot"}},
                    "L", "R");
}
// CesiumMan has no names; its nodes by number.
JointRoles cesium_roles() {
  return {{"spine.1", "node11"}, {"spine.3", "node12"}, {"neck.1", "node19"}, {"head", "node20"},
          {"arm.l", "node16"},   {"forearm.l", "node17"}, {"hand.l", "node18"},
          {"arm.r", "node13"},   {"forearm.r", "node14"}, {"hand.r", "node15"},
          {"thigh.l", "node7"},  {"shin.l", "node8"},     {"foot.l", "node9"},
          {"thigh.r", "node3"},  {"shin.r", "node4"},     {"foot.r", "node5"}};
}
JointRoles knight_roles() {
  return both_sides({{"spine.1", "spine"}, {"spine.3", "chest"}, {"head", "head"}},
                    {{"arm", "upperarm.@"},
                     {"forearm", "lowerarm.@"},
                     {"hand", "wrist.@"},
                     {"thigh", "upperleg.@"},
                     {"shin", "lowerleg.@"},
                     {"foot", "foot.@"}},
                    "l", "r");
}

std::vector<Body4> bodies() {
  ReadOptions drop;
  drop.drop_rest_frame = true;
  ReadOptions walking;
  walking.clip = "Walking_A";
  std::vector<Body4> out;
  out.push_back(read_body("AMC", "cmu/asfamc/16_31.amc", {}, amc_roles()));
  out.push_back(read_body("BVH", "cmu/bvh/08_01.bvh", drop, bvh_roles()));
  out.push_back(read_body("game", "cmu/bvh_other/007_01_iclone.bvh", {}, game_roles()));
  out.push_back(read_body("CesiumMan", "gltf/CesiumMan.glb", {}, cesium_roles()));
  out.push_back(read_body("Knight", "gltf/KayKit_Knight.glb", walking, knight_roles()));
  return out;
}

TEST(RetargetOnClips, from_each_body_to_each_other) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::vector<Body4> all = bodies();
  for (const Body4& from : all) {
    Alone quiet;
    const Contacts contacts = detect_contacts(from.motion, {}, quiet);
    for (const Body4& to : all) {
      if (&from == &to) continue;
      Alone work;
      const Motion made = retarget(from.motion, {&to.motion, {}}, {}, work).motion;
      const LinkErrors links = link_errors(from.motion, from.roles, made, to.roles);
      const Contacts carried = carried_contacts(contacts, made, work);
      const std::vector<double> whole(made.frames(), 1);
      const FootErrors before = foot_errors(made, contacts);
      const FootskateResult cleaned = clean_footskate(made, carried, {}, whole, work);
      const FootErrors feet = foot_errors(cleaned.motion, contacts);
      const FootErrors own = foot_errors(from.motion, contacts);
      printf("%-9s -> %-9s links %2d direction %6.2f (%s) twist %6.2f (%s) skate %.4f (%.4f before, %.4f source) worst %.4f height %.4f (%.4f source) plants %d residual %.4f stretch %.4f root %.3f\n",
             from.name.c_str(), to.name.c_str(), links.links, links.direction, links.worst_direction.c_str(),
             links.twist, links.worst_twist.c_str(), feet.skate, before.skate, own.skate, feet.largest,
             feet.off_ground, own.off_ground, feet.plants, cleaned.largest_residual, cleaned.largest_stretch, cleaned.largest_root_move);
      for (auto& d : work.reported) if (d.severity != Severity::info) printf("    %s\n", to_text(d).c_str());
    }
  }
}

}  // namespace
}  // namespace kinegraph
