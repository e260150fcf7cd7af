// What a joint's name says in the conventions that are about: "mixamorig:LeftUpLeg", "lfemur", "lThigh",
// "UpperLeg_L", "CC_Base_L_Thigh", "LEFT_HIP#", "upperleg01.L", "Bip01 L Thigh".
#pragma once
#include <string>
#include <string_view>

namespace kinegraph {

enum class Side { middle, left, right };

// `shoulder` is the collar bone in some conventions and the upper arm in others; `wrist` the hand, or what
// stands before it.
enum class BodyPart {
  none,
  pelvis,
  spine,
  neck,
  head,
  clavicle,
  shoulder,
  upper_arm,
  forearm,
  wrist,
  hand,
  thigh,
  shin,
  foot,
  toe
};

struct JointName {
  Side side = Side::middle;
  BodyPart part = BodyPart::none;
  // Lower-case letters and digits, without namespace, prefixes of rigs and side: "upleg", "index1".
  std::string word;
};
JointName read_joint_name(std::string_view name);

}  // namespace kinegraph
