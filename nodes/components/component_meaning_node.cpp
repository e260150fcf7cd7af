#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/components/component_meaning.h"
#include "nodes/motion/metric_name.h"
#include "nodes/motion/metrics.h"

namespace kinegraph {
namespace {

void explain(Compute& node) {
  const auto& components = node.input<Components>("components");
  const Params& params = node.params();
  MeaningParams settings;
  for (const Json& pair : params.json("pairs").array())
    settings.pairs.emplace_back(static_cast<std::int64_t>(pair.array()[0].number()),
                                static_cast<std::int64_t>(pair.array()[1].number()));
  if (settings.pairs.empty() && components.segments.size() > 1) settings.pairs = {{0, 1}};
  settings.align = params.texts("align");
  settings.emotion = component_refs(params.json("emotion"));
  for (const auto& [name, pattern] : params.json("regions").object())
    settings.regions.emplace_back(name, pattern.string());
  const ComponentMeaning meaning = component_meaning(components, settings, node.work());

  Metrics out;
  const char* unit = components.space.representation == Representation::points ? "m" : "rad";
  const auto cadences = cadences_of(components);
  for (std::size_t i = 0; i < components.count(); ++i) {
    const std::string u = "u" + std::to_string(i + 1) + ".";
    out.all.push_back({u + "d_emotion", meaning.d_emotion[i], ""});
    for (std::size_t r = 0; r < settings.regions.size(); ++r)
      out.all.push_back(
          {joint_metric_name(u + "d_region", settings.regions[r].first), meaning.d_region[r][i], "m"});
    out.all.push_back({u + "variance", components.shares[i], ""});
    std::optional<double> hertz, segment;
    if (cadences[i]) {
      hertz = cadences[i]->hertz;
      segment = static_cast<double>(cadences[i]->segment);
    }
    out.all.push_back({u + "cadence", hertz, "Hz"});
    if (components.segments.size() > 1) out.all.push_back({u + "cadence_segment", segment, ""});
    const auto moved = moved_by(components, i);
    for (std::size_t m = 0; m < moved.size() && m < 3; ++m)
      out.all.push_back({joint_metric_name(u + "moves", moved[m].label), moved[m].amount, unit});
  }
  node.output("metrics", std::move(out));
}

}  // namespace

NodeType component_meaning_node() {
  NodeType type;
  type.name = "ComponentMeaning";
  type.category = "components";
  type.help =
      "Says what each component does: how well it tells clips of different emotion apart, which parts of the "
      "body "
      "it moves, how fast it swings.";
  type.source = "Cao et al. 2003 §4.3";
  type.keywords = {"emotion", "style", "region", "caption", "semantic"};
  type.input("components", {"Components"}, "What ICA found.");
  type.output(
      "metrics", "Metrics",
      "u1.d_emotion, u1.d_region.NAME, u1.variance, u1.cadence (of u1.cadence_segment, the same one for all "
      "that have a beat in it), u1.moves.JOINT, …");
  type.param("pairs", list(tuple({integer(0).between(0, 10000), integer(1).between(0, 10000)})),
             "Segments with the same action and different emotion, from 0. Empty: the first two.");
  type.param(
      "align", list(text("joint:*")),
      "What the time warp of a pair goes by: u1, group:NAME, joint:PATTERN, dof:JOINT.x. Empty: all joints.");
  ParamType emotion = list(either({integer(1).between(1, 100000), text("u1")}));
  type.param("emotion", std::move(emotion),
             "The components that carry the emotion. Empty: the one with the largest d_emotion.");
  type.param("regions", table(pattern("*")), "Parts of the body: a name and a pattern of joints each.");
  type.code_version = 5;
  type.compute = explain;
  return type;
}

}  // namespace kinegraph
