#include "headless/html_report.h"

#include <algorithm>
#include <set>

#include "headless/html_motion.h"
#include "headless/html_page.h"
#include "headless/metrics_table.h"

namespace kinegraph {

namespace {

const PlannedNode& node_of(const Plan& plan, const Source& source) {
  return plan.nodes[static_cast<std::size_t>(source.node)];
}

std::string type_of(const Plan& plan, const Source& source) {
  if (source.node < 0) return {};
  const NodeType* type = node_of(plan, source).type;
  const OutputPort* port = type ? type->find_output(source.port) : nullptr;
  return port ? port->type : std::string();
}

// The links of the plan: [from node, port, to node, port, type].
Json links_of(const Plan& plan) {
  Json::Array links;
  for (const PlannedNode& node : plan.nodes)
    for (const auto& [port, sources] : node.inputs)
      for (const Source& source : sources)
        if (source.node >= 0)
          links.push_back(
              Json::Array{node_of(plan, source).name, source.port, node.name, port, type_of(plan, source)});
  return links;
}

bool can_play(const Plan& plan, const Source& source) {
  const std::string type = type_of(plan, source);
  return type == "Motion" || type == "Points";
}

// The first link of a port.
std::optional<Source> linked(const PlannedNode& node, const std::string& port) {
  const auto sources = node.inputs.find(port);
  if (sources == node.inputs.end() || sources->second.empty() || sources->second.front().node < 0) return {};
  return sources->second.front();
}

// What a node makes its output from: its first input that can be played.
std::optional<Source> main_input(const Plan& plan, int node) {
  const PlannedNode& planned = plan.nodes[static_cast<std::size_t>(node)];
  if (!planned.type) return {};
  for (const InputPort& port : planned.type->inputs)
    if (const auto source = linked(planned, port.name); source && can_play(plan, *source)) return source;
  return {};
}

// The motion whose metrics come in at a port of a Check.
std::optional<Source> measured(const Plan& plan, int check, const std::string& port) {
  const auto metrics = linked(plan.nodes[static_cast<std::size_t>(check)], port);
  return metrics ? main_input(plan, metrics->node) : std::nullopt;
}

}  // namespace

std::vector<BeforeAfter> motions_to_show(const Session& session, const std::vector<Target>& targets) {
  const Plan& plan = session.plan();
  std::vector<BeforeAfter> shown;
  std::set<std::string> known;
  const auto named = [&](const Source& source) { return Target{node_of(plan, source).name, source.port}; };
  const auto show = [&](const std::string& name, const Source& after, std::optional<Source> otherwise) {
    if (!known.insert(named(after).node + "." + named(after).port).second) return;
    BeforeAfter one{name, {}, named(after)};
    std::optional<Source> at = after;
    while (const auto earlier = main_input(plan, at->node)) at = earlier;
    if (at->node == after.node) at = otherwise;
    if (at && at->node != after.node) one.before = named(*at);
    shown.push_back(std::move(one));
  };
  for (const Target& target : targets) {
    if (!target.port.empty()) {
      const auto after = plan.find_output(target.node, target.port);
      if (after && can_play(plan, *after)) show(target.node + "." + target.port, *after, {});
      continue;
    }
    const auto found = plan.by_name.find(target.node);
    if (found == plan.by_name.end()) continue;
    const NodeType* type = plan.nodes[static_cast<std::size_t>(found->second)].type;
    if (type && type->effect == Effect::writes)
      if (const auto after = main_input(plan, found->second)) show(target.node, *after, {});
  }
  // A Check shows what it judges, where no Export does.
  for (const Target& target : targets) {
    const auto found = plan.by_name.find(target.node);
    if (!target.port.empty() || found == plan.by_name.end()) continue;
    const NodeType* type = plan.nodes[static_cast<std::size_t>(found->second)].type;
    if (!type || type->effect != Effect::checks) continue;
    if (const auto after = measured(plan, found->second, "metrics"))
      show(target.node, *after, measured(plan, found->second, "baseline"));
  }
  return shown;
}

std::string html_of(const Outcome& outcome, const Program& program, Session& session,
                    const std::vector<BeforeAfter>& shown) {
  Json::Array players, order;
  for (const BeforeAfter& one : shown) {
    Json::Array motions;
    for (const Target& target : {one.before, one.after}) {
      if (target.node.empty()) continue;
      const auto value = session.evaluator().value(session.plan(), target.node, target.port);
      Json motion = value ? motion_for_page(*value, target.node + "." + target.port) : Json();
      if (!motion.is_null()) motions.push_back(std::move(motion));
    }
    if (!motions.empty())
      players.push_back(Json::Object{{"name", one.name}, {"motions", std::move(motions)}});
  }
  Json::Object units;
  for (const auto& [node, metrics] : outcome.metrics)
    if (metrics)
      for (const Metric& metric : metrics->all) units[metric.name] = metric.unit;
  for (const std::string& node : metrics_columns(session.plan(), outcome)) order.push_back(node);
  return html_page(
      Json::Object{{"report", report_of(outcome, program, session.opened(), session.options().out)},
                   {"links", links_of(session.plan())},
                   {"players", std::move(players)},
                   {"metrics_order", std::move(order)},
                   {"units", std::move(units)}});
}

}  // namespace kinegraph
