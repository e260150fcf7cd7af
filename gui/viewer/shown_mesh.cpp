#include "gui/viewer/shown_mesh.h"

#include <cmath>

namespace kinegraph {
namespace {

// Each vertex's normal is the sum of its triangles', so that large ones count more.
void find_normals(PosedMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), 0.0f);
  const auto at = [&](std::uint32_t vertex) {
    return Vec3{mesh.positions[3 * vertex], mesh.positions[3 * vertex + 1], mesh.positions[3 * vertex + 2]};
  };
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const Vec3 a = at(mesh.triangles[i]);
    const Vec3 n = cross(at(mesh.triangles[i + 1]) - a, at(mesh.triangles[i + 2]) - a);
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        mesh.normals[3 * mesh.triangles[i + corner] + static_cast<std::size_t>(axis)] +=
            static_cast<float>(n[axis]);
  }
  for (std::size_t i = 0; i < mesh.normals.size(); i += 3) {
    const float x = mesh.normals[i], y = mesh.normals[i + 1], z = mesh.normals[i + 2];
    const float length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) mesh.normals[i + axis] /= length;
  }
}

}  // namespace

std::shared_ptr<const PosedMesh> posed_mesh(const Character& character, const Motion* motion,
                                            std::size_t frame) {
  auto mesh = std::make_shared<PosedMesh>();
  try {
    const Pose pose = motion ? pose_for(character, *motion, frame) : rest_pose_of(*character.skeleton);
    const double seconds = motion ? static_cast<double>(frame) / motion->fps() : 0;
    const std::vector<std::vector<double>> morphs =
        morph_weights_at(character, static_cast<std::size_t>(seconds * character.morph_fps));
    for (std::size_t part = 0; part < character.parts.size(); ++part) {
      const MeshPart& one = character.parts[part];
      const auto first = static_cast<std::uint32_t>(mesh->positions.size() / 3);
      for (const Vec3& v : posed_vertices(character, one, pose, morphs[part]))
        for (int axis = 0; axis < 3; ++axis) mesh->positions.push_back(static_cast<float>(v[axis]));
      for (std::uint32_t vertex : one.triangles) mesh->triangles.push_back(first + vertex);
    }
  } catch (const Failure&) {
    return nullptr;
  }
  if (mesh->triangles.empty()) return nullptr;
  find_normals(*mesh);
  return mesh;
}

}  // namespace kinegraph
