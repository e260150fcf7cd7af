#include "graph/file/diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "graph/file/merge_lists.h"
#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/version_of_graph.h"

namespace kinegraph {

namespace {

using Kind = Unit::Kind;

// A diff as a person reads it: a heading a node, a line a unit.
class Telling {
 public:
  Telling(const Terminal& terminal, const Diff& diff, const Document& after)
      : terminal_(terminal), diff_(diff), after_(after) {}

  void tell() {
    for (const auto& [from, to] : diff_.renames) {
      renamed_to_[to] = from;
      const bool alone =
          std::none_of(diff_.changes.begin(), diff_.changes.end(),
                       [&, &name = to](const Change& c) { return of_node(c.unit) && c.unit.name == name; });
      if (alone) heading_of_node(to);
    }
    for (const Change& change : diff_.changes) tell(change);
    if (diff_.layout) line(Tint::faint, "the layout differs, which has no meaning");
  }

 private:
  static bool of_node(const Unit& unit) {
    switch (unit.kind) {
      case Kind::node:
      case Kind::missing_node:
      case Kind::node_type:
      case Kind::node_enabled:
      case Kind::node_note:
      case Kind::node_param:
      case Kind::node_input:
      case Kind::node_extra:
        return true;
      default:
        return false;
    }
  }
  void line(Tint tint, const std::string& text) { terminal_.result(terminal_.tinted(text, tint) + "\n"); }

  void heading(const std::string& text) {
    if (text != heading_) line(Tint::bold, text);
    heading_ = text;
  }
  void heading_of_node(const std::string& name) {
    const auto node = after_.nodes.find(name);
    const std::string type = node == after_.nodes.end() ? "" : fmt::format(" ({})", node->second.type);
    const auto from = renamed_to_.find(name);
    heading(from == renamed_to_.end() ? fmt::format("~ {}{}", name, type)
                                      : fmt::format("~ {} → {}{}  renamed", from->second, name, type));
  }

  void tell(const Change& change) {
    const Unit& unit = change.unit;
    if (unit.kind == Kind::node || unit.kind == Kind::missing_node) return tell_whole(change);
    if (of_node(unit))
      heading_of_node(unit.name);
    else
      heading(unit.kind == Kind::variable ? "variables"
              : unit.kind == Kind::extra  ? "the file's own data"
                                          : "publish");
    std::string label = of_node(unit) ? unit.key : unit.name;
    if (unit.kind == Kind::node_enabled) label = "enabled";
    if (unit.kind == Kind::node_note) label = "note";
    if (unit.kind == Kind::node_type) label = "type";
    if (unit.kind == Kind::publish_input) label = "input " + label;
    if (unit.kind == Kind::publish_output) label = "output " + label;
    if (unit.kind == Kind::publish_param) label = "param " + label;
    if (unit.kind == Kind::node_input)
      label += " ←";
    else
      label += ":";
    const bool lists = change.before && change.after && change.before->is_array() && change.after->is_array();
    if (lists) return tell_elements(label, change.before->array(), change.after->array());
    terminal_.result(fmt::format("    {} {} → {}\n", label,
                                 terminal_.tinted(shown(unit, change.before), Tint::red),
                                 terminal_.tinted(shown(unit, change.after), Tint::green)));
  }

  static std::string shown(const Unit& unit, const std::optional<Json>& value) {
    if (value) return unit.kind == Kind::node_input && value->is_string() ? value->string() : compact(*value);
    if (unit.kind == Kind::node_enabled) return "true";
    return unit.kind == Kind::node_param ? "default" : unit.kind == Kind::node_input ? "open" : "nothing";
  }

  void tell_elements(const std::string& label, const Json::Array& before, const Json::Array& after) {
    terminal_.result(fmt::format("    {}\n", label));
    std::size_t i = 0, j = 0;
    const auto until = [&](std::size_t end_i, std::size_t end_j) {
      for (; i < end_i; ++i) line(Tint::red, "      - " + compact(before[i]));
      for (; j < end_j; ++j) line(Tint::green, "      + " + compact(after[j]));
    };
    for (const auto& [at_before, at_after] : common_elements(before, after)) {
      until(at_before, at_after);
      ++i, ++j;
    }
    until(before.size(), after.size());
  }

  void tell_whole(const Change& change) {
    const bool added = change.after.has_value();
    const Tint tint = added ? Tint::green : Tint::red;
    const Json& whole = added ? *change.after : *change.before;
    const Json* type = whole.find("type");
    const char sign = added ? '+' : '-';
    heading_.clear();
    line(tint,
         fmt::format("{} {} ({})", sign, change.unit.name, type && type->is_string() ? type->string() : "?"));
    for (const char* part : {"enabled", "note"})
      if (const Json* value = whole.find(part))
        line(tint, fmt::format("{}   {}: {}", sign, part, compact(*value)));
    for (const char* part : {"params", "inputs"}) {
      const Json* members = whole.find(part);
      if (!members || !members->is_object()) continue;
      for (const auto& [key, value] : members->object())
        line(tint, fmt::format("{}   {} {}", sign, key,
                               *part == 'p'        ? "= " + compact(value)
                               : value.is_string() ? "← " + value.string()
                                                   : "← " + compact(value)));
    }
  }

  const Terminal& terminal_;
  const Diff& diff_;
  const Document& after_;
  Renames renamed_to_;
  std::string heading_;
};

}  // namespace

int diff_command(const Program& program, const DiffArguments& arguments) {
  if (arguments.textconv) {
    Opened opened = version_of_graph(arguments.a, program.registry);
    if (has_error(opened.problems) || opened.document.read_only) {
      // git shows what is there, whatever it is.
      std::ifstream in(arguments.a, std::ios::binary);
      program.terminal.result(std::string(std::istreambuf_iterator<char>(in), {}));
      return exit_code::done;
    }
    program.terminal.result(unit_lines(opened.document));
    return exit_code::done;
  }
  if (arguments.b.empty())
    throw UsageError(error("bad-option", "diff compares two graphs: kinegraph diff A B"));
  Opened a = version_of_graph(arguments.a, program.registry),
         b = version_of_graph(arguments.b, program.registry);
  bool good = true;
  for (Opened* side : {&a, &b}) good = usable_version(program, *side) && good;
  if (!good) return exit_code::invalid;
  const Diff changes = diff(a.document, b.document);
  if (arguments.json)
    program.terminal.result(indented(to_json(changes)));
  else
    Telling(program.terminal, changes, b.document).tell();
  return arguments.check && !changes.empty() ? exit_code::failed : exit_code::done;
}

}  // namespace kinegraph
