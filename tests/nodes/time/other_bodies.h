// Bodies that differ from Gait's in names, proportions, rest pose, local axes and facing, made from places.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nodes/motion/elementary.h"
#include "nodes/motion/motion.h"
#include "tests/nodes/time/retarget_measures.h"

namespace kinegraph {

struct BodyShape {
  double legs = 1, arms = 1, trunk = 1;                    // times Gait's
  double arms_down = 0, elbows = 0, splay = 0, knees = 0;  // rad, at rest
  double facing = 0;                                       // rad, 0 = +z
  int spines = 3;
  bool clavicles = true, toes = true;
  bool bones_along_y = false;  // local axes as modelling programs have them; else the world's
  double scale_above = 1;      // of what stands above the root, with Z up in it where it isn't 1
};

struct OtherBody {
  std::string name;
  Skeleton skeleton;
  JointRoles roles;
  Motion motion() const {  // without frames
    auto facts = std::make_shared<SourceFacts>();
    return Motion(std::make_shared<const Skeleton>(skeleton), facts, 30, 0, {});
  }
};

namespace made_bodies {

struct Place {
  std::string role, parent;
  Vec3 at;
};

inline std::vector<Place> places(const BodyShape& shape) {
  std::vector<Place> out;
  const double hip = 0.075 + shape.legs * 0.84;
  const auto above = [&](double y, double z) { return Vec3{0, hip + 0.03 + shape.trunk * y, z}; };
  out.push_back({"pelvis", "", above(0, 0)});
  out.push_back({"spine.1", "pelvis", above(0.10, -0.01)});
  if (shape.spines > 2) out.push_back({"spine.2", "spine.1", above(0.21, -0.018)});
  out.push_back({"spine.3", shape.spines > 2 ? "spine.2" : "spine.1", above(0.32, -0.02)});
  out.push_back({"neck.1", "spine.3", above(0.50, -0.01)});
  out.push_back({"head", "neck.1", above(0.60, 0.01)});
  out.push_back({"crown", "head", above(0.78, 0.01)});
  for (const double side : {1.0, -1.0}) {
    const std::string s = side > 0 ? ".l" : ".r";
    const auto mirror = [&](Vec3 v) { return Vec3{side * v.x, v.y, v.z}; };
    Vec3 shoulder = above(0.46, -0.01) + Vec3{0.18, 0, 0};
    if (shape.clavicles)
      out.push_back({"clavicle" + s, "spine.3", mirror(above(0.45, 0) + Vec3{0.03, 0, 0})});
    out.push_back({"arm" + s, shape.clavicles ? "clavicle" + s : "spine.3", mirror(shoulder)});
    const Vec3 upper{cosine(shape.arms_down), -sine(shape.arms_down), 0};
    const Vec3 lower = cosine(shape.elbows) * upper + sine(shape.elbows) * Vec3{0, 0, 1};
    Vec3 at = shoulder + shape.arms * 0.29 * upper;
    out.push_back({"forearm" + s, "arm" + s, mirror(at)});
    at += shape.arms * 0.25 * lower;
    out.push_back({"hand" + s, "forearm" + s, mirror(at)});
    out.push_back({"finger" + s, "hand" + s, mirror(at + shape.arms * 0.1 * lower)});
    const Vec3 down{sine(shape.splay), -cosine(shape.splay), 0};
    const auto bent = [&](double angle) { return cosine(angle) * down + sine(angle) * Vec3{0, 0, 1}; };
    at = {0.09, hip, 0};
    out.push_back({"thigh" + s, "pelvis", mirror(at)});
    at += shape.legs * 0.42 * bent(0.5 * shape.knees);
    out.push_back({"shin" + s, "thigh" + s, mirror(at)});
    at += shape.legs * 0.42 * bent(-0.5 * shape.knees);
    out.push_back({"foot" + s, "shin" + s, mirror(at)});
    if (shape.toes) out.push_back({"toe" + s, "foot" + s, mirror({at.x, at.y - 0.055, at.z + 0.13})});
    out.push_back({"tip" + s, shape.toes ? "toe" + s : "foot" + s, mirror({at.x, at.y - 0.065, at.z + 0.2})});
  }
  return out;
}

}  // namespace made_bodies

// `name_of`: a joint's name for its role; roles "crown" and "tip" become End Sites.
inline OtherBody make_body(std::string name, const BodyShape& shape,
                           const std::function<std::string(const std::string&)>& name_of) {
  OtherBody body;
  body.name = std::move(name);
  const std::vector<made_bodies::Place> places = made_bodies::places(shape);
  const Quat facing = about_y(shape.facing);
  Skeleton& s = body.skeleton;
  if (shape.scale_above != 1) {
    s.above = axis_angle({1, 0, 0}, -pi / 2);
    s.above_scale = shape.scale_above;
  }
  std::vector<Quat> world;
  std::vector<Vec3> at;
  for (const auto& place : places) {
    const Vec3 here = rotate(facing, place.at);
    const int parent = place.parent.empty() ? -1 : s.find(name_of(place.parent));
    const Quat above = parent < 0 ? s.above : world[static_cast<std::size_t>(parent)];
    const Vec3 from = parent < 0 ? Vec3{} : at[static_cast<std::size_t>(parent)];
    const Vec3 offset = rotate(inverse(above), here - from) / s.above_scale;
    if (place.role == "crown" || place.role.starts_with("tip")) {
      s.ends.push_back({parent, offset, ""});
      continue;
    }
    Quat turned = facing;
    if (shape.bones_along_y) {
      for (const auto& below : places)
        if (below.parent == place.role) {
          turned = smallest_turn({0, 1, 0}, rotate(facing, below.at) - here) * facing;
          break;
        }
    } else {
      turned = s.above == Quat{} ? Quat{} : s.above;
    }
    s.joints.push_back({name_of(place.role), parent, offset, normalized(inverse(above) * turned)});
    body.roles[place.role] = s.joints.back().name;
    world.push_back(turned);
    at.push_back(here);
  }
  return body;
}

inline std::string named(const std::string& role, const std::map<std::string, std::string>& names,
                         const char* left, const char* right) {
  const auto dot = role.find('.');
  const std::string side = role.substr(dot == role.npos ? role.size() : dot);
  const bool sided = side == ".l" || side == ".r";
  std::string name = names.count(role) ? names.at(role) : names.at(sided ? role.substr(0, dot) : role);
  if (const auto at = name.find('@'); at != name.npos) name.replace(at, 1, side == ".l" ? left : right);
  return name;
}

// T-pose facing z, names as CMU's AMC files, longer legs, legs splayed by 20°.
inline OtherBody amc_like() {
  BodyShape shape;
  shape.legs = 1.15;
  shape.arms = 0.95;
  shape.splay = 0.35;
  return make_body("AMC-like", shape, [](const std::string& role) {
    return named(role,
                 {{"pelvis", "root"},
                  {"spine.1", "lowerback"},
                  {"spine.2", "upperback"},
                  {"spine.3", "thorax"},
                  {"neck.1", "lowerneck"},
                  {"head", "head"},
                  {"clavicle", "@clavicle"},
                  {"arm", "@humerus"},
                  {"forearm", "@radius"},
                  {"hand", "@wrist"},
                  {"finger", "@fingers"},
                  {"thigh", "@femur"},
                  {"shin", "@tibia"},
                  {"foot", "@foot"},
                  {"toe", "@toes"}},
                 "l", "r");
  });
}
// A-pose with a namespace, centimetres under a turned armature, bones along their own y; short legs.
inline OtherBody mixamo_like() {
  BodyShape shape;
  shape.legs = 0.85;
  shape.arms = 1.1;
  shape.arms_down = 0.8;
  shape.bones_along_y = true;
  shape.scale_above = 0.01;
  return make_body("Mixamo-like", shape, [](const std::string& role) {
    return "mixamorig:" + named(role,
                                {{"pelvis", "Hips"},
                                 {"spine.1", "Spine"},
                                 {"spine.2", "Spine1"},
                                 {"spine.3", "Spine2"},
                                 {"neck.1", "Neck"},
                                 {"head", "Head"},
                                 {"clavicle", "@Shoulder"},
                                 {"arm", "@Arm"},
                                 {"forearm", "@ForeArm"},
                                 {"hand", "@Hand"},
                                 {"finger", "@HandMiddle1"},
                                 {"thigh", "@UpLeg"},
                                 {"shin", "@Leg"},
                                 {"foot", "@Foot"},
                                 {"toe", "@ToeBase"}},
                                "Left", "Right");
  });
}
// Without names, facing +x, elbows and knees bent, arms hanging; no collar bones.
inline OtherBody nameless() {
  BodyShape shape;
  shape.legs = 0.65;
  shape.arms = 0.8;
  shape.trunk = 0.8;
  shape.arms_down = 0.5;
  shape.elbows = 0.5;
  shape.knees = 0.4;
  shape.facing = pi / 2;
  shape.spines = 2;
  shape.clavicles = false;
  shape.bones_along_y = true;
  const auto places = made_bodies::places(shape);
  return make_body("nameless", shape, [places](const std::string& role) {
    for (std::size_t k = 0; k < places.size(); ++k)
      if (places[k].role == role) return "node" + std::to_string(k + 2);
    return std::string();
  });
}

}  // namespace kinegraph
