#include "graph/file/diff.h"

#include <algorithm>
#include <set>

#include "graph/edit_draft.h"
#include "graph/file/units.h"

namespace kinegraph {

namespace {

using Kind = Unit::Kind;

Unit whole_node(const Document& document, const std::string& name) {
  const bool missing = document.nodes.at(name).missing.has_value();
  return {missing ? Kind::missing_node : Kind::node, name, {}};
}

// Units of either, each once, in order.
template <class Units>
std::vector<Unit> united(const Units& units, const Document& before, const Document& after) {
  std::set<Unit> all;
  for (const Document* document : {&before, &after})
    for (Unit& unit : units(*document)) all.insert(std::move(unit));
  return {all.begin(), all.end()};
}

void add_if_changed(std::vector<Change>& changes, const Document& before, const Document& after,
                    const Unit& unit) {
  auto was = get(before, unit), is = get(after, unit);
  if (was != is) changes.push_back({unit, std::move(was), std::move(is)});
}

}  // namespace

Edit edit_between(const Document& before, const Document& after, std::string title) {
  const Diff step = diff(before, after);
  Document renamed = before;
  Edit renames{title, {}};
  for (const auto& [from, to] : step.renames) {
    const Edit one = rename_node(renamed, from, to);
    apply(renamed, one);
    renames = combined(std::move(renames), one);
  }
  EditDraft draft(renamed, title);
  for (const Change& change : step.changes) draft.set(change.unit, change.after);
  for (const Document* side : {static_cast<const Document*>(&renamed), &after})
    for (const Unit& unit : units_of_ui(*side)) draft.set(unit, get(after, unit));
  Edit edit = combined(std::move(renames), draft.take());
  edit.title = std::move(title);
  return edit;
}

Diff diff(const Document& old, const Document& after) {
  Diff result;
  result.renames = renames(old, after);
  Document under_new_names;
  if (!result.renames.empty()) under_new_names = renamed(old, result.renames);
  const Document& before = result.renames.empty() ? old : under_new_names;
  in_step(before.nodes, after.nodes, {},
          [&](const std::string& name, const Node* was, const Node* is, const Node*) {
            if (!was || !is) {
              add_if_changed(result.changes, before, after, whole_node(was ? before : after, name));
            } else if (was->type != is->type || was->missing.has_value() != is->missing.has_value()) {
              result.changes.push_back({whole_node(before, name), to_json(*was), std::nullopt});
              result.changes.push_back({whole_node(after, name), std::nullopt, to_json(*is)});
            } else if (!same(*was, *is)) {
              const auto of_node = [&](const Document& document) { return units_of_node(document, name); };
              for (const Unit& unit : united(of_node, before, after))
                add_if_changed(result.changes, before, after, unit);
            }
          });
  for (const Unit& unit : united(units_of_file, before, after))
    add_if_changed(result.changes, before, after, unit);
  result.layout = before.ui.nodes != after.ui.nodes || before.ui.frames != after.ui.frames ||
                  before.ui.notes != after.ui.notes || before.ui.extras != after.ui.extras;
  return result;
}

const char* name_of(Unit::Kind kind) {
  switch (kind) {
    case Kind::node:
    case Kind::missing_node:
      return "node";
    case Kind::node_type:
      return "type";
    case Kind::node_enabled:
      return "enabled";
    case Kind::node_note:
      return "note";
    case Kind::node_param:
      return "param";
    case Kind::node_input:
      return "input";
    case Kind::variable:
      return "variable";
    case Kind::publish_param:
      return "publish-param";
    case Kind::publish_input:
      return "publish-input";
    case Kind::publish_output:
      return "publish-output";
    case Kind::ui_node:
    case Kind::ui_frame:
    case Kind::ui_note:
    case Kind::ui_extra:
      return "ui";
    case Kind::node_extra:
    case Kind::publish_extra:
    case Kind::extra:
      return "extra";
  }
  return "";
}

Json to_json(const Diff& diff) {
  Json::Object renamed;
  for (const auto& [from, to] : diff.renames) renamed[from] = to;
  Json::Array changes;
  for (const Change& change : diff.changes) {
    Json::Object one{{"kind", name_of(change.unit.kind)}, {"name", change.unit.name}};
    if (!change.unit.key.empty()) one["key"] = change.unit.key;
    if (change.before) one["before"] = *change.before;
    if (change.after) one["after"] = *change.after;
    changes.push_back(std::move(one));
  }
  return Json::Object{
      {"renamed", std::move(renamed)}, {"changes", std::move(changes)}, {"layout", diff.layout}};
}

namespace {
// Which reads as one value; other lists grow and shrink by their elements.
bool is_range_or_vector(const Json& list) {
  return std::all_of(list.array().begin(), list.array().end(),
                     [](const Json& element) { return element.is_number() || element.is_null(); });
}
}  // namespace

std::string unit_lines(const Document& document) {
  std::string text;
  const auto add = [&](const Unit& unit) {
    const auto value = get(document, unit);
    if (!value) return;
    const std::string name = to_text(unit);
    if (unit.kind == Kind::node_type) {
      const Json& type = *value->find("type");
      const Json& version = *value->find("version");
      text += unit.name + ": " + type.string();
      if (!(version == Json(1))) text += " version " + compact(version);
      text += '\n';
    } else if (value->is_array() && !value->array().empty() && !is_range_or_vector(*value)) {
      for (const Json& element : value->array()) text += name + ": " + compact(element) + '\n';
    } else if (unit.kind == Kind::node_input && value->is_string()) {
      text += name + " <- " + value->string() + '\n';
    } else {
      text += name + " = " + compact(*value) + '\n';
    }
  };
  for (const auto& [name, node] : document.nodes)
    for (const Unit& unit : units_of_node(document, name)) add(unit);
  for (const Unit& unit : units_of_file(document)) add(unit);
  return text;
}

}  // namespace kinegraph
