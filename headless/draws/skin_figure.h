// A character's meshes as a figure of a picture, posed by its skeleton and its morph targets.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "headless/draws/camera.h"
#include "headless/draws/canvas.h"
#include "headless/draws/mesh_raster.h"
#include "nodes/motion/character.h"

namespace kinegraph {

class SkinFigure {
 public:
  explicit SkinFigure(const Character& character);  // which must outlive it

  // World positions and normals of all parts, in clay. `morph_frame`: of the character's own morph tracks,
  // which hold their last value; none: without them. Vertices that stand on one spot in the file with one
  // normal share it here, so that seams of textures don't show and hard edges stay hard.
  SolidMesh posed(const Pose& pose, std::optional<std::size_t> morph_frame = {}) const;
  using JointColor = std::function<Color(int joint)>;  // joints of the character's skeleton; -1: none
  // Each vertex in the mixture of its joints' colours.
  void color(SolidMesh& mesh, const JointColor& of_joint) const;

 private:
  const Character& character_;
  std::vector<std::uint32_t> smooth_;  // per vertex: the first vertex that it shares its normal with
};

// What meshes are made of.
Color clay();
// The mesh's shadow straight down onto the floor at a world height.
void draw_mesh_shadow(Canvas& canvas, const Camera& camera, const SolidMesh& mesh, Vec3 origin, Spot at,
                      double floor);

}  // namespace kinegraph
