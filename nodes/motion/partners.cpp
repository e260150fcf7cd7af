// Which joints of two skeletons belong together.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "graph/diagnostic.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

namespace {

// A bone of CMU's ASF, which is a joint at the bone's start, and the joint of the cgspeed BVH that turns the
// same bone.
constexpr std::array<std::pair<std::string_view, std::string_view>, 31> cmu = {{
    {"root", "Hips"},
    {"lhipjoint", "LHipJoint"},
    {"lfemur", "LeftUpLeg"},
    {"ltibia", "LeftLeg"},
    {"lfoot", "LeftFoot"},
    {"ltoes", "LeftToeBase"},
    {"rhipjoint", "RHipJoint"},
    {"rfemur", "RightUpLeg"},
    {"rtibia", "RightLeg"},
    {"rfoot", "RightFoot"},
    {"rtoes", "RightToeBase"},
    {"lowerback", "LowerBack"},
    {"upperback", "Spine"},
    {"thorax", "Spine1"},
    {"lowerneck", "Neck"},
    {"upperneck", "Neck1"},
    {"head", "Head"},
    {"lclavicle", "LeftShoulder"},
    {"lhumerus", "LeftArm"},
    {"lradius", "LeftForeArm"},
    {"lwrist", "LeftHand"},
    {"lhand", "LeftFingerBase"},
    {"lfingers", "LeftHandIndex1"},
    {"lthumb", "LThumb"},
    {"rclavicle", "RightShoulder"},
    {"rhumerus", "RightArm"},
    {"rradius", "RightForeArm"},
    {"rwrist", "RightHand"},
    {"rhand", "RightFingerBase"},
    {"rfingers", "RightHandIndex1"},
    {"rthumb", "RThumb"},
}};

std::string_view other_name(std::string_view name) {
  for (auto [asf, bvh] : cmu) {
    if (name == asf) return bvh;
    if (name == bvh) return asf;
  }
  return {};
}

std::vector<std::string> names_of(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

int mapped_joint(const Skeleton& skeleton, std::string_view name, const std::string& entry, std::size_t index,
                 const char* which) {
  int joint = skeleton.find(name);
  if (joint >= 0) return joint;
  throw Failure(
      error("unknown-joint", fmt::format("\"{}\": the {} motion has no joint \"{}\"", entry, which, name))
          .at_param(fmt::format("map[{}]", index))
          .at_joint(std::string(name))
          .hinting(suggestion(name, names_of(skeleton))));
}

}  // namespace

std::vector<int> partners(const Skeleton& from, const Skeleton& to, const std::vector<std::string>& map) {
  std::vector<int> partner(to.joints.size(), -1);
  if (map.empty()) {
    std::vector<bool> taken(from.joints.size());
    for (int j = 0; j < to.size(); ++j) {
      partner[j] = from.find(to.joints[j].name);
      if (partner[j] >= 0) taken[partner[j]] = true;
    }
    for (int j = 0; j < to.size(); ++j) {
      if (partner[j] >= 0) continue;
      std::string_view name = other_name(to.joints[j].name);
      int found = name.empty() ? -1 : from.find(name);
      if (found >= 0 && !taken[found]) partner[j] = found;
    }
    return partner;
  }
  for (std::size_t i = 0; i < map.size(); ++i) {
    const std::string& entry = map[i];
    auto equals = entry.find('=');
    if (equals == entry.npos || equals == 0 || equals + 1 == entry.size()) {
      throw Failure(error("bad-map", fmt::format("\"{}\" is not of the form FROM=TO", entry))
                        .at_param(fmt::format("map[{}]", i))
                        .hinting("write a joint of the second input, =, and a joint of the main input"));
    }
    int a = mapped_joint(from, std::string_view(entry).substr(0, equals), entry, i, "second");
    int b = mapped_joint(to, std::string_view(entry).substr(equals + 1), entry, i, "main");
    if (partner[b] >= 0 && partner[b] != a) {
      throw Failure(
          error("bad-map", fmt::format("\"{}\" gives \"{}\" a second partner; it already has \"{}\"", entry,
                                       to.joints[b].name, from.joints[partner[b]].name))
              .at_param(fmt::format("map[{}]", i))
              .at_joint(to.joints[b].name)
              .hinting("name each joint of the main input once"));
    }
    partner[b] = a;
  }
  return partner;
}

}  // namespace kinegraph
