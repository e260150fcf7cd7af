#include "nodes/gait/gait_skeleton.h"

namespace kinegraph {

std::shared_ptr<const Skeleton> gait_skeleton(const GaitBody& body) {
  auto skeleton = std::make_shared<Skeleton>();
  auto add = [&](std::string name, int parent, Vec3 offset) {
    skeleton->joints.push_back({std::move(name), parent, offset, Quat{}});
  };
  // The root's own OFFSET stays zero: programs that add it to the position channels then agree with those
  // that don't.
  add("Hips", -1, {});
  for (int side = 0; side < 2; ++side) {
    const std::string name = side == 0 ? "Left" : "Right";
    const double sign = side == 0 ? 1 : -1;
    const int first = side == 0 ? left_up_leg : right_up_leg;
    add(name + "UpLeg", hips, {sign * body.hip_half_width, -body.hip_drop, 0});
    add(name + "Leg", first, {0, -body.thigh, 0});
    add(name + "Foot", first + 1, {0, -body.shank, 0});
    add(name + "ToeBase", first + 2, {0, body.ball_height - body.ankle_height, body.ball_ahead});
    skeleton->ends.push_back({first + 3, {0, -body.ball_height / 2, body.toe_length}, ""});
  }
  add("Spine", hips, {0, 0.115, -0.01});
  add("Spine1", spine, {0, 0.16, 0});
  add("Neck", spine1, {0, 0.24, 0});
  add("Head", neck, {0, 0.09, 0.015});
  skeleton->ends.push_back({head, {0, 0.2, 0.005}, ""});
  for (int side = 0; side < 2; ++side) {
    const std::string name = side == 0 ? "Left" : "Right";
    const double sign = side == 0 ? 1 : -1;
    const int first = side == 0 ? left_shoulder : right_shoulder;
    add(name + "Shoulder", spine1, {sign * 0.03, 0.19, 0.01});
    add(name + "Arm", first, {sign * 0.15, 0, -0.015});
    add(name + "ForeArm", first + 1, {sign * 0.285, 0, 0});
    add(name + "Hand", first + 2, {sign * 0.25, 0, 0});
    add(name + "HandIndex1", first + 3, {sign * 0.085, 0, 0});
    skeleton->ends.push_back({first + 4, {sign * 0.085, 0, 0}, ""});
  }
  return skeleton;
}

std::shared_ptr<const SourceFacts> gait_source_facts(const Skeleton& skeleton, double fps) {
  auto facts = std::make_shared<SourceFacts>();
  facts->unit = 0.01;
  facts->unit_name = "cm";
  facts->frame_time = 1 / fps;
  const double per_metre = 100;
  for (const Joint& joint : skeleton.joints) {
    BvhJoint bvh;
    if (joint.parent < 0) bvh.channels = {"Xposition", "Yposition", "Zposition"};
    bvh.channels.insert(bvh.channels.end(), {"Zrotation", "Yrotation", "Xrotation"});
    bvh.offset = per_metre * joint.offset;
    facts->bvh.push_back(std::move(bvh));
  }
  for (const EndSite& end : skeleton.ends) facts->bvh_ends.push_back(per_metre * end.offset);
  return facts;
}

}  // namespace kinegraph
