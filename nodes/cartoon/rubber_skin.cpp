#include "nodes/cartoon/rubber_skin.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/cartoon/rubber_joints.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {
namespace {

constexpr double least_distance = 1e-6;  // of the height

double distance(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 link = b - a;
  const double size = dot(link, link);
  const double along = size > 0 ? std::clamp(dot(p - a, link) / size, 0.0, 1.0) : 0;
  return norm(p - (a + along * link));
}

struct Influence {
  int joint;           // of the old skeleton
  std::uint32_t slot;  // of the new skin's joints
  double weight;
};

// Keeps the largest and at least one of every joint, gives what the others had to the largest kept one of the
// same joint.
void keep_largest(std::vector<Influence>& all, std::size_t most) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  if (all.size() <= most) return;
  std::vector<bool> kept(all.size());
  const auto largest_kept = [&](int joint) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (kept[i] && all[i].joint == joint) return i;
    return all.size();
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (largest_kept(all[i].joint) == all.size()) {
      kept[i] = true;
      ++count;
    }
  for (std::size_t i = 0; i < all.size() && count < most; ++i)
    if (!kept[i]) {
      kept[i] = true;
      ++count;
    }
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!kept[i]) all[largest_kept(all[i].joint)].weight += all[i].weight;
  std::vector<Influence> left;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (kept[i]) left.push_back(all[i]);
  all = std::move(left);
}

class Rebinding {
 public:
  Rebinding(const Character& old, const SubJoints& sub, const SubSkeleton& rubber)
      : old_(old),
        sub_(sub),
        rubber_(rubber),
        rest_(rest_pose_of(*old.skeleton)),
        least_(least_distance * std::max(rest_height(*old.skeleton), 1e-9)) {}

  Affine seen_from(int sub_joint) const {
    const int k = sub_.all[sub_joint].joint;
    return inverse(affine(rubber_.rest.positions[sub_joint], rubber_.rest.orientations[sub_joint])) *
           affine(rest_.positions[k], rest_.orientations[k]);
  }

  // New skin, and where each old slot's sub-joints start in it.
  Skin skin(const Skin& old, std::vector<std::uint32_t>& first) const {
    Skin out{old.name, {}, {}};
    for (std::size_t i = 0; i < old.joints.size(); ++i) {
      first.push_back(static_cast<std::uint32_t>(out.joints.size()));
      const int own = sub_.first[old.joints[i]];
      for (int l = 0; l < sub_.all[own].count; ++l) {
        out.joints.push_back(own + l);
        out.inverse_bind.push_back(seen_from(own + l) * old.inverse_bind[i]);
      }
    }
    return out;
  }

  void part(const Skin& old_skin, const std::vector<std::uint32_t>& first, MeshPart& part, Work& work) const {
    const std::vector<Vec3> at = posed_vertices(old_, part, rest_);
    std::vector<std::vector<Influence>> all(part.vertices());
    int most = 1;
    for (std::size_t v = 0; v < all.size(); ++v) {
      if (v % 1024 == 0) work.check();
      for (int i = 0; i < part.influences; ++i) {
        const std::size_t entry = v * static_cast<std::size_t>(part.influences) + static_cast<std::size_t>(i);
        if (part.weights[entry] != 0)
          spread(old_skin, first, part.joints[entry], part.weights[entry], at[v], all[v]);
      }
      keep_largest(all[v], usual_influences);
      most = std::max(most, static_cast<int>(all[v].size()));
    }
    part.influences = most;
    part.joints.assign(all.size() * static_cast<std::size_t>(most), 0);
    part.weights.assign(part.joints.size(), 0.0f);
    for (std::size_t v = 0; v < all.size(); ++v)
      for (std::size_t i = 0; i < all[v].size(); ++i) {
        part.joints[v * static_cast<std::size_t>(most) + i] = all[v][i].slot;
        part.weights[v * static_cast<std::size_t>(most) + i] = static_cast<float>(all[v][i].weight);
      }
  }

 private:
  void spread(const Skin& skin, const std::vector<std::uint32_t>& first, std::uint32_t slot, double weight,
              Vec3 v, std::vector<Influence>& out) const {
    const int k = skin.joints[slot], own = sub_.first[k];
    const SubJoint& one = sub_.all[own];
    std::vector<double> near;
    double total = 0;
    for (int l = 0; l < one.count; ++l) {
      const int next = l + 1 < one.count ? own + l + 1 : one.next >= 0 ? sub_.first[one.next] : own + l;
      near.push_back(
          1 / std::max(distance(v, rubber_.rest.positions[own + l], rubber_.rest.positions[next]), least_));
      total += near.back();
    }
    for (int l = 0; l < one.count; ++l)
      out.push_back({k, first[slot] + static_cast<std::uint32_t>(l), weight * near[l] / total});
  }

  const Character& old_;
  const SubJoints& sub_;
  const SubSkeleton& rubber_;
  Pose rest_;
  double least_;
};

std::shared_ptr<const CharacterSource> source_of(const Character& character, const SubJoints& sub) {
  if (!character.source) return nullptr;
  auto source = std::make_shared<CharacterSource>(*character.source);
  source->node_of_joint.clear();
  source->scale_of_parent.clear();
  for (const SubJoint& one : sub.all) {
    const auto k = static_cast<std::size_t>(one.joint);
    const auto& old = *character.source;
    source->node_of_joint.push_back(one.step == 0 && k < old.node_of_joint.size() ? old.node_of_joint[k]
                                                                                  : -1);
    source->scale_of_parent.push_back(k < old.scale_of_parent.size() ? old.scale_of_parent[k] : 1);
  }
  return source;
}

}  // namespace

Character rubber_character(const Character& character, const Motion& motion, const SubJoints& of_motion,
                           const SubJointParams& params, Work& work) {
  const Skeleton& skeleton = *character.skeleton;
  SubJointParams same = params;
  same.of_each.assign(skeleton.joints.size(), 1);
  for (int j = 0; j < skeleton.size(); ++j)
    if (const int k = motion.skeleton().find(skeleton.joints[j].name); k >= 0)
      same.of_each[j] = of_motion.all[of_motion.first[k]].count;
  const Motion at_rest(character.skeleton, std::make_shared<SourceFacts>(), 30, 1,
                       std::vector<bool>(skeleton.joints.size(), false));
  const SubJoints sub = lay_sub_joints(at_rest, same, work);
  const SubSkeleton rubber = sub_skeleton(at_rest, sub, work);
  const Rebinding rebinding(character, sub, rubber);

  Character out = character;
  out.skeleton = rubber.skeleton;
  out.rebound = true;
  out.source = source_of(character, sub);
  std::vector<std::vector<std::uint32_t>> first(character.skins.size());
  for (std::size_t s = 0; s < character.skins.size(); ++s)
    out.skins[s] = rebinding.skin(character.skins[s], first[s]);
  for (MeshPart& part : out.parts) {
    if (part.skin >= 0) {
      rebinding.part(character.skins[part.skin], first[part.skin], part, work);
    } else if (part.joint >= 0) {
      part.joint = sub.first[part.joint];
      part.placed = rebinding.seen_from(part.joint) * part.placed;
    }
  }
  return out;
}

}  // namespace kinegraph
