#include "headless/draws/skin_figure.h"

#include <algorithm>
#include <array>
#include <map>

#include "headless/draws/theme.h"

namespace kinegraph {

Color clay() {
  return rgb(0xded8cf);
}

SkinFigure::SkinFigure(const Character& character) : character_(character) {
  std::map<std::array<float, 6>, std::uint32_t> seen;
  std::uint32_t first = 0;
  for (const MeshPart& part : character.parts) {
    seen.clear();
    const bool has_normals = part.normals.size() == part.positions.size();
    for (std::size_t v = 0; v < part.vertices(); ++v) {
      std::array<float, 6> place{};
      std::copy_n(part.positions.begin() + static_cast<std::ptrdiff_t>(3 * v), 3, place.begin());
      if (has_normals)
        std::copy_n(part.normals.begin() + static_cast<std::ptrdiff_t>(3 * v), 3, place.begin() + 3);
      const auto self = first + static_cast<std::uint32_t>(v);
      smooth_.push_back(seen.emplace(place, self).first->second);
    }
    first += static_cast<std::uint32_t>(part.vertices());
  }
}

SolidMesh SkinFigure::posed(const Pose& pose, std::optional<std::size_t> morph_frame) const {
  SolidMesh mesh;
  const std::vector<std::vector<double>> weights = morph_weights_at(character_, morph_frame);
  for (std::size_t p = 0; p < character_.parts.size(); ++p) {
    const MeshPart& part = character_.parts[p];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (Vec3 at : posed_vertices(character_, part, pose, weights[p])) mesh.positions.push_back(at);
    for (std::uint32_t vertex : part.triangles) mesh.triangles.push_back(first + vertex);
  }
  mesh.colors.assign(mesh.positions.size(), clay());
  // The sum of the triangles' normals, large ones counting more.
  std::vector<Vec3> sums(mesh.positions.size());
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const std::uint32_t* v = mesh.triangles.data() + i;
    const Vec3 normal =
        cross(mesh.positions[v[1]] - mesh.positions[v[0]], mesh.positions[v[2]] - mesh.positions[v[0]]);
    for (int corner = 0; corner < 3; ++corner) sums[smooth_[v[corner]]] += normal;
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.normals.push_back(normalized(sums[smooth_[v]]));
  return mesh;
}

void SkinFigure::color(SolidMesh& mesh, const JointColor& of_joint) const {
  std::size_t at = 0;
  for (const MeshPart& part : character_.parts) {
    if (part.skin < 0) {
      std::fill_n(mesh.colors.begin() + static_cast<std::ptrdiff_t>(at), part.vertices(),
                  of_joint(part.joint));
      at += part.vertices();
      continue;
    }
    const Skin& skin = character_.skins[static_cast<std::size_t>(part.skin)];
    std::vector<Color> colors;
    for (int joint : skin.joints) colors.push_back(of_joint(joint));
    for (std::size_t v = 0; v < part.vertices(); ++v, ++at) {
      Color sum{0, 0, 0, 1};
      double whole = 0;
      for (int k = 0; k < part.influences; ++k) {
        const std::size_t entry = v * static_cast<std::size_t>(part.influences) + static_cast<std::size_t>(k);
        const double weight = part.weights[entry];
        if (!(weight > 0)) continue;
        const Color& one = colors[part.joints[entry]];
        sum.r += weight * one.r, sum.g += weight * one.g, sum.b += weight * one.b;
        whole += weight;
      }
      mesh.colors[at] = whole > 0 ? Color{sum.r / whole, sum.g / whole, sum.b / whole, 1} : clay();
    }
  }
}

void draw_mesh_shadow(Canvas& canvas, const Camera& camera, const SolidMesh& mesh, Vec3 origin, Spot at,
                      double floor) {
  SolidMesh flat = mesh;
  for (Vec3& p : flat.positions) p.y = floor;
  draw_mesh_flat(canvas, camera, flat, origin, at, faded(theme::ink, 0.14));
}

}  // namespace kinegraph
