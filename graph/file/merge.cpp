#include "graph/file/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "graph/file/conflict_text.h"
#include "graph/file/merge_lists.h"
#include "graph/file/renames.h"
#include "graph/file/units.h"
#include "graph/file/write.h"
#include "graph/nested.h"
#include "graph/validate.h"

namespace kinegraph {

namespace {

using Kind = Unit::Kind;
using Value = std::optional<Json>;

std::string shown(const Value& value) {
  if (!value) return "nothing";
  std::string text = compact(*value);
  if (text.size() <= 60) return text;
  std::size_t end = 57;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

class Merger {
 public:
  Merger(Document base, Document ours, Document theirs, const Registry& registry,
         const OpenInside& open_inside)
      : registry_(registry), open_inside_(open_inside) {
    align(std::move(base), std::move(ours), std::move(theirs));
    for (Document* side : {&ours_, &theirs_}) open_inside_of(*side);
  }

  Merge run(const std::string& our_label, const std::string& their_label) {
    result_.schema = ours_.schema;
    in_step(base_.nodes, ours_.nodes, theirs_.nodes,
            [&](const std::string& name, const Node* was, const Node* our, const Node* their) {
              merge_node(name, was, our, their);
            });
    for (const Unit& unit : united(units_of_file)) merge_unit(unit);
    merge_ui();
    check_result();
    Merge result;
    result.conflicts = std::move(conflicts_);
    result.text = write_document(result_, registry_);
    if (!result.conflicts.empty()) {
      std::string their_text = write_document(with_theirs(), registry_);
      std::string our_text = result.text;
      if (our_text == their_text) {  // nothing in one place is at odds: the whole of both is
        our_text = write_document(ours_, registry_);
        their_text = write_document(theirs_, registry_);
      }
      result.text = conflict_text(our_text, their_text, our_label, their_label);
    }
    result.document = std::move(result_);
    return result;
  }

 private:
  void conflict(std::string what, std::optional<Unit> unit) {
    conflicts_.push_back({std::move(what), std::move(unit)});
  }

  // Brings all three under one set of names: a node renamed on one side is so on the other and in the base.
  void align(Document base, Document ours, Document theirs) {
    const Renames here = renames(base, ours), there = renames(base, theirs);
    Renames for_base = here, for_ours, for_theirs;
    std::set<std::string, std::less<>> taken;  // by a rename of this merge
    for (const auto& [from, to] : here) taken.insert(to);
    for (const auto& [from, to] : here) {
      const auto other = there.find(from);
      if (other == there.end()) {
        // The other side still calls it `from`; a node of its own under the new name stands in the way.
        if (theirs.nodes.contains(from) && !theirs.nodes.contains(to)) for_theirs[from] = to;
      } else if (other->second != to) {
        conflict(fmt::format("{} is renamed to {} here and to {} there", from, to, other->second),
                 Unit{Kind::node, to, {}});
        if (!theirs.nodes.contains(to)) for_theirs[other->second] = to;
      }
    }
    for (const auto& [from, to] : there) {
      if (here.contains(from)) continue;
      if (taken.contains(to) || ours.nodes.contains(to) || base.nodes.contains(to)) continue;
      for_base[from] = to;
      if (ours.nodes.contains(from)) for_ours[from] = to;
    }
    base_ = renamed(std::move(base), for_base);
    ours_ = renamed(std::move(ours), for_ours);
    theirs_ = renamed(std::move(theirs), for_theirs);
  }

  template <class Units>
  std::vector<Unit> united(const Units& units) const {
    std::set<Unit> all;
    for (const Document* document : {&base_, &ours_, &theirs_})
      for (Unit& unit : units(*document)) all.insert(std::move(unit));
    return {all.begin(), all.end()};
  }

  static const Node* find(const Document& document, const std::string& name) {
    const auto found = document.nodes.find(name);
    return found == document.nodes.end() ? nullptr : &found->second;
  }
  static Value whole(const Node* node) { return node ? Value(to_json(*node)) : Value(); }
  static void put(Document& document, const std::string& name, const Node* node) {
    if (node)
      document.nodes[name] = *node;
    else
      document.nodes.erase(name);
  }
  // Names come in order, so the end is where most belong.
  void put_in_result(const std::string& name, const Node* node) {
    if (node) result_.nodes.emplace_hint(result_.nodes.end(), name, *node);
  }
  // With theirs wherever the sides conflict.
  Document with_theirs() const {
    Document document = result_;
    for (const auto& [unit, value, whole_node] : their_way_) {
      if (whole_node)
        put(document, unit.name, *whole_node);
      else
        set(document, unit, value);
    }
    return document;
  }
  static bool equal(const Node* a, const Node* b) { return a && b ? same(*a, *b) : a == b; }
  // One type, and known or not on all sides that have it: then its parts can be told apart.
  static bool alike(const Node* a, const Node* b) {
    return !a || !b || (a->type == b->type && a->missing.has_value() == b->missing.has_value());
  }

  void merge_node(const std::string& name, const Node* was, const Node* our, const Node* their) {
    // Most nodes are as one side left them.
    if (const bool as_ours = equal(our, their) || equal(was, their); as_ours || equal(was, our))
      return put_in_result(name, as_ours ? our : their);
    if (our && their && alike(our, their)) return merge_parts(name, *our, alike(was, our));
    const Value before = whole(was), here = whole(our), there = whole(their);
    const bool changed_here = here != before, changed_there = there != before;
    put_in_result(name, changed_here ? our : their);
    if (!changed_here || !changed_there || here == there) return;
    const Unit unit{Kind::node, name, {}};
    their_way_.push_back({unit, {}, their});
    if (our && their)
      conflict(fmt::format("{} is a {} here and a {} there", name, our->type, their->type), unit);
    else
      conflict(fmt::format("{} is removed {} and changed {}", name, our ? "there" : "here",
                           our ? "here" : "there"),
               unit);
  }

  void merge_parts(const std::string& name, const Node& our, bool with_base) {
    put_in_result(name, &our);
    // The type stands first, so that its version is there before the rest.
    std::set<Unit> units;
    const std::vector<const Document*> sides = with_base
                                                   ? std::vector<const Document*>{&base_, &ours_, &theirs_}
                                                   : std::vector<const Document*>{&ours_, &theirs_};
    for (const Document* document : sides)
      for (Unit& unit : units_of_node(*document, name)) units.insert(std::move(unit));
    for (const Unit& unit : units) merge_unit(unit, with_base);
  }

  void merge_unit(const Unit& unit, bool with_base = true) {
    const Value was = with_base ? get(base_, unit) : Value(), here = get(ours_, unit),
                there = get(theirs_, unit);
    if (here == there || there == was) return set(result_, unit, here);
    if (here == was) return set(result_, unit, there);
    bool list_conflict = false;
    if (const auto merged = merged_inside(unit, was, here, there, list_conflict); merged && !list_conflict)
      return set(result_, unit, *merged);
    set(result_, unit, here);
    their_way_.push_back({unit, there, {}});
    conflict(fmt::format("{}: {} here, {} there", to_text(unit), shown(here), shown(there)), unit);
  }

  // Lists merged by element, tables by key; nothing for a value that is one.
  std::optional<Value> merged_inside(const Unit& unit, const Value& was, const Value& here,
                                     const Value& there, bool& in_conflict) const {
    const Param* param = nullptr;
    if (unit.kind == Kind::node_param) {
      const Node* node = find(ours_, unit.name);
      const NodeType* type = node ? known_type(registry_, *node) : nullptr;
      param = type ? type->find_param(unit.key) : nullptr;
      if (!param) return {};
    }
    const Value otherwise = param ? param->fallback : Value();  // what a value that is left out means
    const Value &before = was ? was : otherwise, &our = here ? here : otherwise,
                &their = there ? there : otherwise;
    const auto all = [&](auto has_kind) {
      return (!before || has_kind(*before)) && (!our || has_kind(*our)) && (!their || has_kind(*their));
    };
    const bool links =
        unit.kind == Kind::node_input || unit.kind == Kind::publish_input || unit.kind == Kind::publish_param;
    if (links || (param && takes(*param, ParamType::Kind::list)))
      if (all([](const Json& value) { return value.is_array(); })) {
        const auto elements = [](const Value& value) { return value ? value->array() : Json::Array(); };
        MergedList merged = merge_lists(elements(before), elements(our), elements(their));
        in_conflict = merged.conflict;
        return merged.elements.empty() && !param ? Value() : Value(Json(std::move(merged.elements)));
      }
    if (param && takes(*param, ParamType::Kind::table))
      if (all([](const Json& value) { return value.is_object(); }))
        return merged_table(before, our, their, in_conflict);
    return {};
  }

  static bool takes(const ParamType& type, ParamType::Kind kind) {
    if (type.kind == kind) return true;
    return type.kind == ParamType::Kind::either &&
           std::any_of(type.parts.begin(), type.parts.end(),
                       [&](const auto& part) { return part.kind == kind; });
  }

  static Value merged_table(const Value& before, const Value& our, const Value& their, bool& in_conflict) {
    const auto member = [](const Value& table, const std::string& key) -> Value {
      const Json* found = table ? table->find(key) : nullptr;
      return found ? Value(*found) : Value();
    };
    std::set<std::string> keys;
    for (const Value* table : {&before, &our, &their})
      if (*table)
        for (const auto& [key, value] : (*table)->object()) keys.insert(key);
    Json::Object merged;
    for (const std::string& key : keys) {
      const Value was = member(before, key), here = member(our, key), there = member(their, key);
      if (here != was && there != was && here != there) in_conflict = true;
      if (const Value& now = here != was ? here : there) merged[key] = *now;
    }
    return Value(Json(std::move(merged)));
  }

  // Never a conflict: ours, unless only they moved it.
  void merge_ui() {
    using Entries = std::map<std::string, Json, std::less<>>;
    const auto merge_part = [&](Entries Ui::*part, bool of_nodes) {
      Entries& merged = result_.ui.*part;
      in_step(base_.ui.*part, ours_.ui.*part, theirs_.ui.*part,
              [&](const std::string& name, const Json* was, const Json* here, const Json* there) {
                const bool gone = of_nodes && !result_.nodes.contains(name) &&
                                  (base_.nodes.contains(name) || theirs_.nodes.contains(name));
                const bool untouched = here && was ? *here == *was : here == was;
                const Json* now = untouched ? there : here;
                if (now && !gone) merged.emplace_hint(merged.end(), name, *now);
              });
    };
    merge_part(&Ui::nodes, true);
    merge_part(&Ui::frames, false);
    merge_part(&Ui::notes, false);
    merge_part(&Ui::extras, false);
  }

  void open_inside_of(Document& document) const {
    const auto is_graph = [&](const auto& entry) {
      const NodeType* type = entry.second.missing ? nullptr : registry_.find(entry.second.type);
      return type && type->role == Role::graph;
    };
    if (open_inside_ && std::any_of(document.nodes.begin(), document.nodes.end(), is_graph))
      open_inside_(document);
  }

  // What is wrong with the result and was on neither side.
  void check_result() {
    open_inside_of(result_);
    std::set<std::string> known;
    const auto text = [](const Diagnostic& problem) {
      return problem.code + '\n' + problem.node + '\n' + problem.port + '\n' + problem.param + '\n' +
             problem.message;
    };
    const ValidateOptions options{.check_files = false, .allow_outside = true};
    const auto errors = [&](const Document& document, auto what) {
      for (const Diagnostic& problem : validate(document, registry_, options))
        if (problem.severity == Severity::error) what(problem);
    };
    Diagnostics found;
    errors(result_, [&](const Diagnostic& problem) { found.push_back(problem); });
    if (found.empty()) return;
    for (const Document* side : {&ours_, &theirs_})
      errors(*side, [&](const Diagnostic& problem) { known.insert(text(problem)); });
    for (const Diagnostic& problem : found) {
      if (known.contains(text(problem))) continue;
      const std::string where = problem.node.empty()   ? problem.param
                                : problem.port.empty() ? problem.node
                                                       : problem.node + "." + problem.port;
      conflict(fmt::format("{}: {} (by both sides together)", where, problem.message),
               problem.node.empty() ? std::nullopt : std::optional<Unit>(Unit{Kind::node, problem.node, {}}));
      take_sides(problem);
    }
  }

  // In the text such a problem shows where the two sides differ: at its node, else at the nodes that it is
  // linked with, else at every node of which one side knows nothing.
  void take_sides(const Diagnostic& problem) {
    if (problem.node.empty() || take_side(problem.node)) return;
    std::vector<std::string> near;
    if (const Node* node = find(result_, problem.node))
      for (const auto& [port, inputs] : node->inputs)
        for (const Link& link : inputs.links) near.push_back(link.node);
    for (const auto& [name, node] : result_.nodes)
      for (const auto& [port, inputs] : node.inputs)
        for (const Link& link : inputs.links)
          if (link.node == problem.node) near.push_back(name);
    bool any = false;
    for (const std::string& name : near) any = take_side(name) || any;
    if (any) return;
    std::set<std::string> names;
    for (const Document* side : {&ours_, &theirs_})
      for (const auto& [name, node] : side->nodes) names.insert(name);
    for (const std::string& name : names)
      if (!find(ours_, name) || !find(theirs_, name)) take_side(name);
  }
  bool take_side(const std::string& name) {
    const Node *here = find(ours_, name), *there = find(theirs_, name);
    if (whole(here) == whole(there)) return false;
    put(result_, name, here);
    their_way_.push_back({{Kind::node, name, {}}, {}, there});
    return true;
  }

  // Where theirs is not the result: a unit's value, or a whole node (null: none).
  struct TheirWay {
    Unit unit;
    Value value;
    std::optional<const Node*> whole_node;
  };

  const Registry& registry_;
  const OpenInside& open_inside_;
  Document base_, ours_, theirs_;  // under one set of names
  Document result_;                // with ours where they conflict
  std::vector<TheirWay> their_way_;
  std::vector<MergeConflict> conflicts_;
};

}  // namespace

Merge merge(Document base, Document ours, Document theirs, const Registry& registry,
            const std::string& our_label, const std::string& their_label, const OpenInside& open_inside) {
  return Merger(std::move(base), std::move(ours), std::move(theirs), registry, open_inside)
      .run(our_label, their_label);
}

}  // namespace kinegraph
