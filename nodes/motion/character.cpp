#include "nodes/motion/character.h"

#include <algorithm>
#include <cmath>

#include "graph/diagnostic.h"

namespace kinegraph {

namespace {

bool all_finite(const std::vector<float>& values) {
  for (float value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

bool is_finite(const Affine& a) {
  for (const auto& row : a.rows)
    for (double value : row)
      if (!std::isfinite(value)) return false;
  return true;
}

std::size_t bytes_of(const std::vector<float>& values) {
  return sizeof(float) * values.capacity();
}

}  // namespace

std::size_t Character::bytes() const {
  std::size_t total = sizeof(Character) + 128 * skeleton->joints.size();
  for (const Skin& skin : skins)
    total += sizeof(Skin) + skin.joints.size() * sizeof(int) + skin.inverse_bind.size() * sizeof(Affine);
  for (const MeshPart& part : parts) {
    total += sizeof(MeshPart) + bytes_of(part.positions) + bytes_of(part.normals) + bytes_of(part.texcoords) +
             bytes_of(part.weights) + 4 * (part.triangles.capacity() + part.joints.capacity());
    for (const MorphTarget& morph : part.morphs) total += bytes_of(morph.positions) + bytes_of(morph.normals);
  }
  for (const MorphTrack& track : morph_tracks) total += sizeof(double) * track.weights.capacity();
  if (source) {
    total += source->json.size();
    for (const std::string& buffer : source->buffers) total += buffer.size();
    for (const auto& [name, content] : source->files) total += content.size();
  }
  return total;
}

std::optional<NonFinite> Character::non_finite() const {
  if (!std::isfinite(unit) || !std::isfinite(morph_fps)) return NonFinite{"unit or rate", "", {}};
  for (const Skin& skin : skins)
    for (std::size_t k = 0; k < skin.inverse_bind.size(); ++k)
      if (!is_finite(skin.inverse_bind[k]))
        return NonFinite{"inverse bind matrix", skeleton->joints[skin.joints[k]].name, {}};
  for (const MeshPart& part : parts) {
    if (!all_finite(part.positions) || !all_finite(part.normals) || !all_finite(part.texcoords))
      return NonFinite{"vertex of mesh " + part.name, "", {}};
    if (!all_finite(part.weights)) return NonFinite{"weight of mesh " + part.name, "", {}};
    if (!is_finite(part.placed)) return NonFinite{"place of mesh " + part.name, "", {}};
    for (const MorphTarget& morph : part.morphs)
      if (!all_finite(morph.positions) || !all_finite(morph.normals))
        return NonFinite{"morph target " + morph.name, "", {}};
  }
  for (const MorphTrack& track : morph_tracks)
    for (std::size_t t = 0; t < track.weights.size(); ++t)
      if (!std::isfinite(track.weights[t]))
        return NonFinite{"morph weight", "", static_cast<std::int64_t>(t)};
  return {};
}

Affine skinning_map(const MeshPart& part, std::size_t vertex, const std::vector<Affine>& of_joint) {
  const std::size_t first = vertex * static_cast<std::size_t>(part.influences);
  double whole = 0;
  for (int k = 0; k < part.influences; ++k) whole += part.weights[first + k];
  if (!(whole > 0)) return part.influences > 0 ? of_joint[part.joints[first]] : Affine();
  Affine map;
  for (auto& row : map.rows) row.fill(0);
  for (int k = 0; k < part.influences; ++k) {
    const double share = part.weights[first + k] / whole;
    if (share == 0) continue;
    const Affine& one = of_joint[part.joints[first + k]];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) map.rows[i][j] += share * one.rows[i][j];
  }
  return map;
}

std::vector<Vec3> posed_vertices(const Character& character, const MeshPart& part, const Pose& pose,
                                 const std::vector<double>& morph_weights) {
  std::vector<Vec3> out(part.vertices());
  std::vector<Affine> maps;  // of the skin's joints
  if (part.skin >= 0) {
    const Skin& skin = character.skins[part.skin];
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      const int joint = skin.joints[k];
      maps.push_back(affine(pose.positions[joint], pose.orientations[joint]) * skin.inverse_bind[k]);
    }
  }
  Affine rigid = part.placed;
  if (part.skin < 0 && part.joint >= 0)
    rigid = affine(pose.positions[part.joint], pose.orientations[part.joint]) * part.placed;
  for (std::size_t v = 0; v < out.size(); ++v) {
    Vec3 p = part.position(v);
    for (std::size_t m = 0; m < morph_weights.size() && m < part.morphs.size(); ++m) {
      const float* moved = part.morphs[m].positions.data() + 3 * v;
      p += morph_weights[m] * Vec3{moved[0], moved[1], moved[2]};
    }
    if (part.skin < 0) {
      out[v] = point(rigid, p);
      continue;
    }
    out[v] = point(skinning_map(part, v, maps), p);
  }
  return out;
}

std::vector<std::vector<double>> morph_weights_at(const Character& character,
                                                  std::optional<std::size_t> frame) {
  std::vector<std::vector<double>> weights;
  for (const MeshPart& part : character.parts) weights.emplace_back(part.morphs.size());
  for (const MorphTrack& track : character.morph_tracks)
    if (frame && !track.weights.empty() && static_cast<std::size_t>(track.part) < weights.size() &&
        static_cast<std::size_t>(track.target) < weights[static_cast<std::size_t>(track.part)].size())
      weights[static_cast<std::size_t>(track.part)][static_cast<std::size_t>(track.target)] =
          track.weights[std::min(*frame, track.weights.size() - 1)];
  return weights;
}

Pose rest_pose_of(const Skeleton& skeleton) {
  RestPose rest = rest_pose(skeleton);
  return {std::move(rest.positions), std::move(rest.orientations)};
}

Pose pose_for(const Character& character, const Motion& motion, std::size_t frame) {
  const Skeleton& skeleton = *character.skeleton;
  const bool same = motion.shared_skeleton() == character.skeleton;
  if (same) return pose_at(motion, frame);
  Pose pose = rest_pose_of(skeleton);
  bool common = false;
  for (int j = 0; j < skeleton.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const int from = motion.skeleton().find(joint.name);
    common |= from >= 0;
    const Quat above = joint.parent < 0 ? skeleton.above : pose.orientations[joint.parent];
    const Vec3 base = joint.parent < 0 ? skeleton.above_offset : pose.positions[joint.parent];
    const bool moves = from >= 0 && (joint.parent < 0 || motion.translates(from));
    const Vec3 offset = moves ? motion.local_offset(from, frame) : joint.offset;
    pose.orientations[j] = above * (from >= 0 ? motion.rotation(from)[frame] : joint.rest);
    pose.positions[j] = base + rotate(above, skeleton.above_scale * offset);
  }
  if (!common)
    throw Failure(error("no-common-joint", "the motion and the character have no joint of the same name")
                      .hinting("put the motion on the character's skeleton with Retarget"));
  return pose;
}

}  // namespace kinegraph
