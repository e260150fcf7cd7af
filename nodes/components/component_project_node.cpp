#include <map>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/components/rebuild.h"
#include "nodes/motion/moving_root.h"

namespace kinegraph {
namespace {

void project(Compute& node) {
  const auto& components = node.input<Components>("components");
  ComponentSegment segment;
  segment.motion = node.shared_input<Motion>("motion");
  segment.points = node.shared_input<Points>("motion");
  if (components.space.of_motions != (segment.motion != nullptr))
    throw Failure(error("wrong-kind", components.space.of_motions
                                          ? "the components are of motions, the clip is of points"
                                          : "the components are of points, the clip is a motion")
                      .at_port("motion")
                      .hinting("link a clip of the kind that ICA was given"));
  if (segment.motion) segment.motion = with_moving_root(segment.motion, node.work());
  Components out = components;
  out.fps = segment.motion ? segment.motion->fps() : segment.points->fps;
  out.segments.clear();
  const Rows x = segment.motion ? channels_of(out.space, *segment.motion, out.mean, node.work())
                                : channels_of(out.space, *segment.points, node.work());
  out.signals = signals_from_channels(out, x);
  std::map<int, double>
      factors;  // a group made of groups holds their factors multiplied, and stands after them
  for (const ComponentGroup& group : out.groups)
    for (const auto& [component, factor] : group.terms) factors[component] = factor;
  for (const auto& [component, factor] : factors)
    for (std::size_t t = 0; t < x.columns; ++t)
      out.signals(static_cast<std::size_t>(component) - 1, t) *= factor;
  segment.end = x.columns;
  out.segments.push_back(std::move(segment));
  node.output("components", std::move(out));
}

}  // namespace

NodeType component_project_node() {
  NodeType type;
  type.name = "ComponentProject";
  type.category = "components";
  type.code_version = 2;
  type.help = "Finds the signals of a clip that was not among those the components were made from.";
  type.source = "u = (P A)⁺ (x - E{x}); Cao et al. 2003 §6";
  type.keywords = {"ica", "apply", "unseen"};
  type.input("components", {"Components"}, "What ICA found.");
  type.input("motion", {"Motion", "Points"}, "The clip to express by them.");
  type.output("components", "Components", "The same components with this clip's signals.", "components");
  type.compute = project;
  return type;
}

}  // namespace kinegraph
