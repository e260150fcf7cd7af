#include "nodes/cartoon/rubber_skin.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "nodes/cartoon/rubber_joints.h"
#include "nodes/cartoon/skin_places.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {
namespace {

struct Influence {
  std::uint32_t slot;  // of the new skin's joints
  double weight;
};

// What one joint of the old skin gives a vertex: the nearer of two neighbouring sub-joints, and the other
// one.
struct Share {
  Influence near, other;
};

// Where there are more than `most`, the others give way to their nearer ones: the smallest whole, larger ones
// by as much, so that weights go to zero before they are dropped.
void keep_few(std::vector<Share>& shares, std::size_t most) {
  std::vector<double> others;
  for (const Share& share : shares)
    if (share.other.weight > 0) others.push_back(share.other.weight);
  const std::size_t room = most > shares.size() ? most - shares.size() : 0;
  if (others.size() <= room) return;
  std::sort(others.begin(), others.end(), std::greater<>());
  const double least = others[room];
  for (Share& share : shares) {
    const double given = std::min(least, share.other.weight);
    share.near.weight += given;
    share.other.weight -= given;
  }
}

class Rebinding {
 public:
  Rebinding(const Character& old, const SubJoints& sub, const SubSkeleton& rubber)
      : old_(old), sub_(sub), rubber_(rubber), rest_(rest_pose_of(*old.skeleton)) {}

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
    const std::vector<double> places = places_of(old_skin, part, at, work);
    std::vector<std::vector<Influence>> all(part.vertices());
    std::vector<Share> shares;
    std::size_t most = 1;
    for (std::size_t v = 0; v < all.size(); ++v) {
      if (v % 1024 == 0) work.check();
      shares.clear();
      for (int i = 0; i < part.influences; ++i) {
        const std::size_t entry = v * static_cast<std::size_t>(part.influences) + static_cast<std::size_t>(i);
        if (part.weights[entry] != 0)
          shares.push_back(share(old_skin, first, part.joints[entry], part.weights[entry], places[entry]));
      }
      keep_few(shares, usual_influences);
      for (const Share& one : shares)
        for (const Influence& influence : {one.near, one.other})
          if (influence.weight > 0) all[v].push_back(influence);
      std::stable_sort(all[v].begin(), all[v].end(),
                       [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
      most = std::max(most, all[v].size());
    }
    part.influences = static_cast<int>(most);
    part.joints.assign(all.size() * most, 0);
    part.weights.assign(part.joints.size(), 0.0f);
    for (std::size_t v = 0; v < all.size(); ++v)
      for (std::size_t i = 0; i < all[v].size(); ++i) {
        part.joints[v * most + i] = all[v][i].slot;
        part.weights[v * most + i] = static_cast<float>(all[v][i].weight);
      }
  }

 private:
  // Of each influence, where its vertex lies along the joint's link, in sub-links.
  std::vector<double> places_of(const Skin& skin, const MeshPart& part, const std::vector<Vec3>& at,
                                Work& work) const {
    const auto influences = static_cast<std::size_t>(part.influences);
    std::vector<double> places(part.weights.size());
    std::vector<std::vector<std::size_t>> of_slot(skin.joints.size());  // influences on joints that are cut
    std::vector<char> tight(at.size());
    bool any = false;
    for (std::size_t v = 0; v < at.size(); ++v) {
      int joints = 0;
      for (std::size_t entry = v * influences; entry < (v + 1) * influences; ++entry) {
        if (part.weights[entry] == 0) continue;
        ++joints;
        const int k = skin.joints[part.joints[entry]];
        if (sub_.all[sub_.first[k]].count == 1) continue;
        places[entry] = place(k, at[v]);
        of_slot[part.joints[entry]].push_back(entry);
      }
      tight[v] = joints >= static_cast<int>(usual_influences);
      any = any || tight[v];
    }
    if (!any) return places;
    const auto beside = mesh_neighbours(at, part.triangles);
    for (std::size_t slot = 0; slot < of_slot.size(); ++slot) {
      const int k = skin.joints[slot];
      const SubJoint& one = sub_.all[sub_.first[k]];
      JointSkin joint{at, beside, 0, {}, {}};
      std::vector<double> own;
      for (std::size_t entry : of_slot[slot]) {
        joint.vertices.push_back(static_cast<int>(entry / influences));
        joint.tight.push_back(tight[entry / influences] != 0);
        own.push_back(places[entry]);
      }
      if (std::find(joint.tight.begin(), joint.tight.end(), true) == joint.tight.end()) continue;
      joint.sub_link = norm(rest_.positions[one.next] - rest_.positions[k]) / one.count;
      settle_places(joint, own, work);
      for (std::size_t i = 0; i < own.size(); ++i) places[of_slot[slot][i]] = own[i];
    }
    return places;
  }

  double place(int k, Vec3 v) const {
    const SubJoint& one = sub_.all[sub_.first[k]];
    const Vec3 start = rest_.positions[k], link = rest_.positions[one.next] - start;
    const double size = dot(link, link);
    return std::clamp(size > 0 ? one.count * dot(v - start, link) / size : 0, 0.0, one.count - 1.0);
  }

  Share share(const Skin& skin, const std::vector<std::uint32_t>& first, std::uint32_t slot, double weight,
              double place) const {
    if (sub_.all[sub_.first[skin.joints[slot]]].count == 1) return {{first[slot], weight}, {}};
    const auto nearest = static_cast<std::uint32_t>(std::floor(place + 0.5));
    const auto above = static_cast<std::uint32_t>(std::floor(place));
    const double part = std::fabs(place - nearest);
    return {{first[slot] + nearest, weight * (1 - part)},
            {first[slot] + (nearest == above ? above + 1 : above), weight * part}};
  }

  const Character& old_;
  const SubJoints& sub_;
  const SubSkeleton& rubber_;
  Pose rest_;
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
