#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/components/component_ref.h"
#include "nodes/components/rebuild.h"

namespace kinegraph {
namespace {

void show(Compute& node) {
  const auto& components = node.input<Components>("components");
  const auto entries = entries_of(component_refs(node.params().json("component")), components, "component");
  const ComponentSegment& segment = segment_of(components, node.params().integer("segment"), "segment");
  const Rows x = channels_from_signals(components, signals_of(components, segment), entries);
  if (node.wanted("motion")) node.output("motion", motion_of(components, x, segment, {}, node.work()));
  if (node.wanted("points")) node.output("points", points_of(components, x, segment, {}, node.work()));
}

}  // namespace

NodeType component_motion_node() {
  NodeType type;
  type.name = "ComponentMotion";
  type.category = "components";
  type.code_version = 3;
  type.help = "Shows what one component does, or several together, as a motion about the mean pose.";
  type.source = "Shapiro et al. 2006 eq. 3; Cao et al. 2003 eq. 8";
  type.keywords = {"ica", "look", "preview"};
  type.input("components", {"Components"}, "What ICA found.");
  type.output("motion", "Motion", "The component's motion, on its clip's path.");
  type.output("points", "Points", "The component's points.");
  ParamType which = either({component_type(), list(component_type())});
  which.fallback = Json(1);
  type.param("component", std::move(which),
             "Its number from 1, a group's name, or a list of them; an empty list: all, which gives the clip "
             "but for what the "
             "components leave out.");
  type.param("segment", integer(0).between(0, 10000), "The clip whose signals are shown, from 0.");
  type.compute = show;
  return type;
}

}  // namespace kinegraph
