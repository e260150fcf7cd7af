#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/points/marker_mesh.h"

namespace kinegraph {

NodeType marker_mesh_node() {
  NodeType type;
  type.name = "MarkerMesh";
  type.category = "components";
  type.help = "Carries the motion of markers, such as a face's, to a mesh, as morph targets.";
  type.source = "Cao et al., §7.1";
  type.keywords = {"face", "rbf", "deform", "blendshape", "morph"};
  type.input("points", {"Points"}, "The markers.");
  type.input("character", {"Character"}, "The mesh.");
  type.output("character", "Character", "The mesh that moves with the markers.", "character");
  type.param("pairs", list(text("")),
             "MARKER=VERTEX: the vertex a marker sits on. Others take the nearest; three or more tell how "
             "the markers "
             "lie to the mesh.");
  type.param("rest_frame", integer(0).between(0, 1e9).in("frame"),
             "The frame of the markers in which the face is the mesh's.");
  type.compute = [](Compute& compute) {
    MarkerMeshParams params;
    for (const Json& pair : compute.params().json("pairs").array()) params.pairs.push_back(pair.string());
    params.rest_frame = compute.params().integer("rest_frame");
    compute.output("character", marker_mesh(compute.input<Points>("points"),
                                            compute.input<Character>("character"), params, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
