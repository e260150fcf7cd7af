// The single edits: nodes, parameters, links.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "graph/edit.h"
#include "graph/edit_draft.h"
#include "graph/links.h"
#include "graph/nested.h"
#include "graph/variables.h"

namespace kinegraph {

namespace {

void check_new_name(const Document& document, const std::string& name) {
  if (!is_node_name(name))
    throw Failure(error("bad-name", fmt::format("{} is no name of a node", in_quotes(name)))
                      .hinting("a letter or _, then letters, digits, _ and -, at most 64 characters"));
  if (document.nodes.count(name))
    throw Failure(error("name-taken", fmt::format("there is a node \"{}\" already", name)).at_node(name));
}

Json links_as_json(const std::vector<Link>& links, bool list) {
  if (!list) return to_text(links.front());
  Json::Array all;
  for (const Link& link : links) all.push_back(to_text(link));
  return all;
}

// The links of a port with one more, or, on a port that takes one, that one instead.
Json links_with(const Document& document, const InputPort& port, const std::string& node, const Link& more) {
  std::vector<Link> links;
  if (const auto found = document.nodes.at(node).inputs.find(port.name);
      port.list && found != document.nodes.at(node).inputs.end())
    links = found->second.links;
  links.push_back(more);
  return links_as_json(links, port.list);
}

const std::vector<Link>& links_or_fail(const Document& document, const std::string& node,
                                       const std::string& port, std::size_t index) {
  const Node& found = node_or_fail(document, node);
  const auto inputs = found.inputs.find(port);
  if (inputs == found.inputs.end() || index >= inputs->second.links.size())
    throw Failure(error("unknown-port", "there is no such link").at_node(node).at_port(port));
  return inputs->second.links;
}

void check_fits(const Document& document, const Registry& registry, const Link& from, const std::string& node,
                const std::string& port) {
  if (auto objection = objection_to_link(document, registry, from, node, port))
    throw Failure(std::move(*objection));
}

bool fits(const Document& document, const Registry& registry, const Link& from, const std::string& node,
          const std::string& port) {
  return !objection_to_link(document, registry, from, node, port);
}

}  // namespace

Edit add_node(const Document& document, const Registry& registry, const std::string& name,
              const std::string& type) {
  check_new_name(document, name);
  const NodeType* known = registry.find(type);
  if (!known)
    throw Failure(error("unknown-type", fmt::format("there is no node type {}", in_quotes(type)))
                      .hinting(suggestion(type, registry.names())));
  Node node;
  node.type = type;
  node.version = known->version;
  EditDraft draft(document, fmt::format("Add {}", type));
  draft.add_node(name, node);
  return draft.take();
}

Edit remove_nodes(const Document& document, const Registry& registry, const std::vector<std::string>& names,
                  bool reconnect) {
  for (const std::string& name : names) node_or_fail(document, name);
  const std::set<std::string> gone(names.begin(), names.end());
  const auto is_gone = [&](const std::string& name) { return gone.count(name) > 0; };
  const auto past = [&](const Link& link) {
    return reconnect ? link_past(document, registry, link, is_gone) : std::optional<Link>();
  };
  EditDraft draft(document, names.size() == 1 ? fmt::format("Delete {}", names.front())
                                              : fmt::format("Delete {} nodes", names.size()));
  draft.change_links(
      [&](const std::string& node, const std::string& port, const Link& link) -> std::optional<Link> {
        if (!is_gone(link.node)) return link;
        if (is_gone(node)) return link;  // goes with its node
        auto instead = past(link);
        if (instead && !document.nodes.at(node).missing && !fits(document, registry, *instead, node, port))
          return {};
        return instead;
      });
  draft.change_published([&](Unit::Kind kind, const Link& link) -> std::optional<Link> {
    if (!is_gone(link.node)) return link;
    return kind == Unit::Kind::publish_output ? past(link) : std::nullopt;
  });
  for (const std::string& name : gone) {
    draft.change_in_ui(name, std::nullopt);
    draft.remove_node(name);
  }
  return draft.take();
}

Edit rename_node(const Document& document, const std::string& from, const std::string& to) {
  const Node& node = node_or_fail(document, from);
  if (from == to) return {};
  check_new_name(document, to);
  EditDraft draft(document, fmt::format("Rename {} to {}", from, to));
  draft.add_node(to, node);
  draft.remove_node(from);
  const auto renamed = [&](const Link& link) -> std::optional<Link> {
    return link.node == from ? Link{to, link.port, {}} : link;
  };
  draft.change_links([&](const std::string&, const std::string&, const Link& link) { return renamed(link); });
  draft.change_published([&](Unit::Kind, const Link& link) { return renamed(link); });
  draft.change_in_ui(from, to);
  return draft.take();
}

Edit set_param(const Document& document, const Registry& registry, const std::string& node,
               const std::string& param, const Json& value) {
  // A Graph node whose file can't be used still has the parameter that names another.
  const Node& stored = node_or_fail(document, node);
  const bool unusable = !stored.missing && stored.nested && !stored.nested->type;
  const NodeType* own = unusable ? registry.find(stored.type) : nullptr;
  const NodeType& type = own ? *own : type_or_fail(document, registry, node);
  const Param* known = type.find_param(param);
  if (!known && type.role != Role::graph)
    throw Failure(error("unknown-param", fmt::format("{} has no parameter \"{}\"", type.name, param))
                      .at_node(node)
                      .at_param(param)
                      .hinting(suggestion(param, type.param_names())));
  if (known) {
    // A variable that isn't defined yet may be written: the graph is what has a problem then, and not the
    // edit.
    Variables variables;
    variables.files = {&document.variables};
    Diagnostics open;
    const Json meant = substituted(value, *known, variables, param, open);
    if (!has_error(open))
      for (Diagnostic& problem : check(*known, meant, param)) throw Failure(std::move(problem).at_node(node));
  }
  EditDraft draft(document, fmt::format("Set {}.{}", node, param));
  const bool left_out = known && is_default(*known, value);
  draft.set({Unit::Kind::node_param, node, param}, left_out ? std::nullopt : std::optional<Json>(value));
  return draft.take();
}

Edit reset_param(const Document& document, const std::string& node, const std::string& param) {
  node_or_fail(document, node);
  return set_unit(document, {Unit::Kind::node_param, node, param}, std::nullopt,
                  fmt::format("Reset {}.{}", node, param));
}

Edit connect(const Document& document, const Registry& registry, const Link& from, const std::string& node,
             const std::string& port) {
  check_fits(document, registry, from, node, port);
  EditDraft draft(document, fmt::format("Link {} to {}.{}", to_text(from), node, port));
  const InputPort* input = type_or_fail(document, registry, node).find_input(port);
  draft.set({Unit::Kind::node_input, node, port}, links_with(document, *input, node, from));
  return draft.take();
}

Edit disconnect(const Document& document, const Registry&, const std::string& node, const std::string& port,
                std::size_t index) {
  links_or_fail(document, node, port, index);
  EditDraft draft(document, fmt::format("Cut {}.{}", node, port));
  std::size_t at = 0;
  draft.change_links(node, port, [&](const Link& link) -> std::optional<Link> {
    if (at++ == index) return {};
    return link;
  });
  return draft.take();
}

Edit set_enabled(const Document& document, const std::string& node, bool enabled) {
  node_or_fail(document, node);
  return set_unit(document, {Unit::Kind::node_enabled, node, {}},
                  enabled ? std::nullopt : std::optional<Json>(false),
                  fmt::format("{} {}", enabled ? "Enable" : "Disable", node));
}

Edit set_note(const Document& document, const std::string& node, const std::string& note) {
  node_or_fail(document, node);
  return set_unit(document, {Unit::Kind::node_note, node, {}},
                  note.empty() ? std::nullopt : std::optional<Json>(note), fmt::format("Note on {}", node));
}

Edit set_unit(const Document& document, const Unit& unit, std::optional<Json> value, std::string title) {
  EditDraft draft(document, std::move(title));
  draft.set(unit, std::move(value));
  return draft.take();
}

Edit insert_on_link(const Document& document, const Registry& registry, const std::string& middle,
                    const std::string& node, const std::string& port, std::size_t index) {
  const Link source = links_or_fail(document, node, port, index)[index];
  const NodeType& type = type_or_fail(document, registry, middle);
  EditDraft draft(document, fmt::format("Insert {} before {}.{}", middle, node, port));
  // The link is cut first, so that it doesn't stand in the way of itself.
  const Edit cut = disconnect(document, registry, node, port, index);
  Document without = document;
  apply(without, cut);
  const auto input = std::find_if(type.inputs.begin(), type.inputs.end(), [&](const InputPort& one) {
    return fits(without, registry, source, middle, one.name);
  });
  if (input == type.inputs.end()) {
    if (!type.inputs.empty()) check_fits(without, registry, source, middle, type.inputs.front().name);
    throw Failure(error("type-mismatch", fmt::format("{} has no input", middle)).at_node(middle));
  }
  draft.set({Unit::Kind::node_input, middle, input->name}, links_with(document, *input, middle, source));
  Document with = draft.document();
  apply(with, cut);
  const auto output = std::find_if(type.outputs.begin(), type.outputs.end(), [&](const OutputPort& one) {
    return fits(with, registry, {middle, one.name, {}}, node, port);
  });
  if (output == type.outputs.end()) {
    if (!type.outputs.empty())
      check_fits(with, registry, {middle, type.outputs.front().name, {}}, node, port);
    throw Failure(error("type-mismatch", fmt::format("{} has no output", middle)).at_node(middle));
  }
  std::size_t at = 0;
  draft.change_links(node, port, [&](const Link& link) -> std::optional<Link> {
    if (at++ == index) return Link{middle, output->name, {}};
    return link;
  });
  return draft.take();
}

Edit take_out(const Document& document, const Registry& registry, const std::string& node) {
  const Node& found = node_or_fail(document, node);
  EditDraft draft(document, fmt::format("Take out {}", node));
  const auto is_gone = [&](const std::string& name) { return name == node; };
  draft.change_links(
      [&](const std::string& taker, const std::string& port, const Link& link) -> std::optional<Link> {
        if (link.node != node || taker == node) return link;
        auto instead = link_past(document, registry, link, is_gone);
        if (instead && !document.nodes.at(taker).missing && !fits(document, registry, *instead, taker, port))
          return {};
        return instead;
      });
  for (const auto& [port, inputs] : found.inputs)
    draft.change_links(node, port, [](const Link&) { return std::optional<Link>(); });
  return draft.take();
}

}  // namespace kinegraph
