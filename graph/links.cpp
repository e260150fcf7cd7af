#include "graph/links.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "graph/nested.h"

namespace kinegraph {

namespace {

const Node* find_node(const Document& document, const std::string& name) {
  const auto found = document.nodes.find(name);
  return found == document.nodes.end() ? nullptr : &found->second;
}

bool passes_on(const NodeType& type) {
  return type.role == Role::select || type.role == Role::pass;
}

// The first port behind `node`, which passes on what it gets, that doesn't take `type`.
std::optional<Diagnostic> objection_behind(const Document& document, const Registry& registry,
                                           const std::string& node, const std::string& type) {
  std::map<std::string_view, std::vector<std::pair<const std::string*, const std::string*>>> consumers;
  for (const auto& [name, consumer] : document.nodes)
    for (const auto& [port, inputs] : consumer.inputs)
      for (const Link& link : inputs.links) consumers[link.node].emplace_back(&name, &port);
  std::set<std::string_view> visited{node};
  std::vector<std::string_view> next{node};
  while (!next.empty()) {
    const std::string_view at = next.back();
    next.pop_back();
    for (const auto& [name, port] : consumers[at]) {
      const NodeType* consumer = known_type(registry, document.nodes.at(*name));
      const InputPort* input = consumer ? consumer->find_input(*port) : nullptr;
      if (!input) continue;
      if (registry.arrives_as(type, *input).empty())
        return error("type-mismatch", fmt::format("{} goes on to {}.{}, which takes {}", type, *name, *port,
                                                  fmt::join(input->types, " or ")))
            .at_node(std::string(at));
      if (passes_on(*consumer) && visited.insert(*name).second) next.push_back(*name);
    }
  }
  return {};
}

}  // namespace

std::optional<std::string> OutputTypes::of(const Link& link) {
  // What flows on is what the first of the links gives that gives anything: depth first, with an own stack,
  // so that a chain of any length is no matter.
  struct Step {
    std::string_view node;
    std::vector<const Link*> sources;
    std::size_t next = 0;
  };
  std::vector<Step> way;
  std::optional<std::string> found;
  const auto step_into = [&](const Link& at) {
    found.reset();
    const Node* node = find_node(document_, at.node);
    const NodeType* type = node && !node->missing ? known_type(registry_, *node) : nullptr;
    const OutputPort* output = type ? type->find_output(at.port) : nullptr;
    if (!output) return;
    if (!output->type.empty()) {
      found = output->type;
      return;
    }
    const auto [known, fresh] = passed_.try_emplace(at.node);
    found = known->second;  // nothing yet where it is further back on the way: a cycle
    if (!fresh) return;
    Step step{known->first, {}, 0};
    for (const auto& [port, inputs] : node->inputs)
      for (const Link& from : inputs.links) step.sources.push_back(&from);
    way.push_back(std::move(step));
  };
  step_into(link);
  while (!way.empty()) {
    Step& step = way.back();
    if (!found && step.next < step.sources.size()) {
      step_into(*step.sources[step.next++]);
      continue;
    }
    passed_.find(step.node)->second = found;
    way.pop_back();
  }
  return found;
}

std::optional<std::string> type_of_output(const Document& document, const Registry& registry,
                                          const Link& link) {
  return OutputTypes(document, registry).of(link);
}

bool depends_on(const Document& document, const std::string& node, const std::string& on) {
  std::set<std::string> visited;
  std::vector<std::string> open{node};
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    if (name == on) return true;
    const Node* found = find_node(document, name);
    if (!found || !visited.insert(name).second) continue;
    for (const auto& [port, inputs] : found->inputs)
      for (const Link& link : inputs.links) open.push_back(link.node);
  }
  return false;
}

std::optional<Diagnostic> objection_to_link(const Document& document, const Registry& registry,
                                            const Link& from, const std::string& node,
                                            const std::string& port) {
  const auto names = [&] {
    std::vector<std::string> all;
    for (const auto& [name, other] : document.nodes) all.push_back(name);
    return all;
  };
  const auto type_at = [&](const std::string& name) -> std::pair<const NodeType*, std::optional<Diagnostic>> {
    const Node* found = find_node(document, name);
    if (!found)
      return {nullptr, error("unknown-node", fmt::format("there is no node \"{}\"", name))
                           .hinting(suggestion(name, names()))};
    const NodeType* type = known_type(registry, *found);
    if (!type)
      return {
          nullptr,
          error("missing-node", fmt::format("{} is missing: its ports are not known", name)).at_node(name)};
    return {type, std::nullopt};
  };
  const auto [giver, no_giver] = type_at(from.node);
  if (no_giver) return no_giver;
  const auto [taker, no_taker] = type_at(node);
  if (no_taker) return no_taker;
  if (!giver->find_output(from.port))
    return error("unknown-port", fmt::format("{} has no output \"{}\"", from.node, from.port))
        .at_node(from.node)
        .at_port(from.port)
        .hinting(suggestion(from.port, giver->output_names()));
  const InputPort* input = taker->find_input(port);
  if (!input)
    return error("unknown-port", fmt::format("{} has no input \"{}\"", node, port))
        .at_node(node)
        .at_port(port)
        .hinting(suggestion(port, taker->input_names()));
  if (depends_on(document, from.node, node))
    return error("cycle", fmt::format("{} already depends on {}", from.node, node))
        .at_node(node)
        .at_port(port);
  OutputTypes types(document, registry);
  const auto type = types.of(from);
  if (!type) return {};
  if (registry.arrives_as(*type, *input).empty())
    return error("type-mismatch", fmt::format("{} gives {}, and {}.{} takes {}", to_text(from), *type, node,
                                              port, fmt::join(input->types, " or ")))
        .at_node(node)
        .at_port(port);
  if (!passes_on(*taker)) return {};
  if (taker->role == Role::select)
    if (const auto found = document.nodes.at(node).inputs.find(port);
        found != document.nodes.at(node).inputs.end())
      for (const Link& other : found->second.links)
        if (const auto there = types.of(other); there && *there != *type)
          return error("type-mismatch",
                       fmt::format("{} gives {}, and {} gives {}: a {} takes links of one type",
                                   to_text(from), *type, to_text(other), *there, taker->name))
              .at_node(node)
              .at_port(port);
  return objection_behind(document, registry, node, *type);
}

std::vector<std::vector<std::string>> cycles(const Document& document) {
  // Depth first with an own stack, so that a chain of any length is no matter; a link back into the path
  // closes a cycle. Nodes that are done are not walked again: each cycle shows once.
  enum class Mark { fresh, open, done };
  struct Step {
    const std::string* name;
    std::vector<const std::string*> sources;
    std::size_t next = 0;
  };
  std::map<std::string_view, Mark> marks;
  std::vector<std::vector<std::string>> found;
  const auto step_of = [](const std::string& name, const Node& node) {
    Step step{&name, {}, 0};
    for (const auto& [port, inputs] : node.inputs)
      for (const Link& link : inputs.links) step.sources.push_back(&link.node);
    return step;
  };
  for (const auto& [start, start_node] : document.nodes) {
    if (marks[start] != Mark::fresh) continue;
    std::vector<Step> path{step_of(start, start_node)};
    marks[start] = Mark::open;
    while (!path.empty()) {
      if (path.back().next == path.back().sources.size()) {
        marks[*path.back().name] = Mark::done;
        path.pop_back();
        continue;
      }
      const auto next = document.nodes.find(*path.back().sources[path.back().next++]);
      if (next == document.nodes.end()) continue;
      if (marks[next->first] == Mark::fresh) {
        marks[next->first] = Mark::open;
        path.push_back(step_of(next->first, next->second));
      } else if (marks[next->first] == Mark::open) {
        std::vector<std::string> cycle;
        for (auto step = path.rbegin(); step != path.rend(); ++step) {
          cycle.push_back(*step->name);
          if (*step->name == next->first) break;
        }
        std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
        found.push_back(std::move(cycle));
      }
    }
  }
  return found;
}

}  // namespace kinegraph
