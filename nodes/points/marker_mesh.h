// Markers that move a mesh [Cao §7.1].
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/character.h"
#include "nodes/motion/points.h"

namespace kinegraph {

struct MarkerMeshParams {
  std::vector<std::string> pairs;  // "MARKER=VERTEX"; a vertex counts through all parts. Others: the nearest
  std::int64_t rest_frame = 0;     // where the face of the markers is the mesh's
};

// The markers at the rest frame are put onto their vertices by the similarity that fits them best; from then
// on the displacement of the mesh is u(x) = Σ_m w_m ‖x − x_m‖ + affine, exact at the markers. u is linear in
// the markers' displacements, so each marker gives three morph targets, one an axis, whose weights are its
// displacement in metres: exact in every frame. Markers that miss samples, share a vertex, or a mesh without
// vertices: Failure ("missing-samples", "same-vertex", "no-mesh", "unknown-marker", "bad-pair", "bad-frame").
// Markers that lie far from their vertices are warned about ("far-markers").
Character marker_mesh(const Points& points, const Character& character, const MarkerMeshParams& params,
                      Work& work);

}  // namespace kinegraph
