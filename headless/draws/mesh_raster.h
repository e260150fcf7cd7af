// A mesh drawn as a solid: hidden surfaces hidden, lit from above left, edges smooth.
#pragma once
#include <cstdint>
#include <vector>

#include "headless/draws/camera.h"
#include "headless/draws/canvas.h"

namespace kinegraph {

struct SolidMesh {
  std::vector<Vec3> positions, normals;  // world; as many of each; a normal of length 0 takes its triangle's
  std::vector<Color> colors;             // one a vertex
  std::vector<std::uint32_t> triangles;  // three vertices each
};

// Draws it with the world point `origin` put at `at`, with a thin rim of paper so that it stands off from
// what is behind. Seen from its back a triangle is lit as its front would be, but darker. Vertices that are
// not finite take their triangles with them.
void draw_mesh(Canvas& canvas, const Camera& camera, const SolidMesh& mesh, Vec3 origin, Spot at);
// All of it in one colour, unlit: a shadow's shape.
void draw_mesh_flat(Canvas& canvas, const Camera& camera, const SolidMesh& mesh, Vec3 origin, Spot at,
                    Color color);

}  // namespace kinegraph
