#include "graph/registry.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace kinegraph {

namespace {

// The name shape of types, ports and parameters: they stand in links, paths and command lines.
bool is_plain_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !name.empty() && letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw std::logic_error(what + ": " + why);
}

// What check() and completed() take for granted of a description.
void check_form(const ParamType& type, const std::string& what) {
  using Kind = ParamType::Kind;
  const std::size_t parts = type.parts.size();
  if ((type.kind == Kind::list || type.kind == Kind::table) && parts != 1) refuse(what, "takes one part");
  if ((type.kind == Kind::tuple || type.kind == Kind::object || type.kind == Kind::either) && parts == 0)
    refuse(what, "has no parts");
  if ((type.kind == Kind::choice || type.kind == Kind::unit) && type.choices.empty())
    refuse(what, "has no choices");
  if (!(type.min <= type.max)) refuse(what, "its least value is above its largest");
  if (type.soft_min < type.min || type.soft_max > type.max) refuse(what, "its slider leaves its range");
  std::set<std::string> names;
  for (const ParamType& part : type.parts) {
    if (type.kind == Kind::object) {
      if (!is_plain_name(part.name)) refuse(what, "has a field without a proper name");
      if (!names.insert(part.name).second) refuse(what, "has two fields " + part.name);
      if (part.fallback && !part.fallback->is_null())
        for (const Diagnostic& problem : check(part, *part.fallback, part.name))
          refuse(what, "the default of its field: " + to_text(problem));
    }
    check_form(part, what + (part.name.empty() ? "[]" : "." + part.name));
  }
}

}  // namespace

void Registry::add(ValueType type) {
  if (!is_plain_name(type.name))
    refuse("port type \"" + type.name + "\"", "its name isn't letters, digits and _");
  if (values_.count(type.name)) refuse("port type " + type.name, "added twice");
  if (type.convert_from.empty() == (type.convert != nullptr))
    refuse("port type " + type.name, "convert and convert_from go together");
  std::string name = type.name;
  values_.emplace(std::move(name), std::move(type));
}

void Registry::add(NodeType type) {
  const std::string what = "node type " + type.name;
  if (!is_plain_name(type.name)) refuse(what, "its name isn't letters, digits and _");
  if (nodes_.count(type.name)) refuse(what, "added twice");
  if (type.help.empty()) refuse(what, "has no help");

  std::set<std::string> names;
  for (const InputPort& port : type.inputs) {
    if (!is_plain_name(port.name) || !names.insert(port.name).second)
      refuse(what, "bad input \"" + port.name + "\"");
    if (port.types.empty() && type.role == Role::compute)
      refuse(what, "input " + port.name + " takes no type");
    for (const std::string& accepted : port.types)
      if (!find_value(accepted)) refuse(what, "input " + port.name + " has the unknown type " + accepted);
  }
  names.clear();
  for (const OutputPort& port : type.outputs) {
    if (!is_plain_name(port.name) || !names.insert(port.name).second)
      refuse(what, "bad output \"" + port.name + "\"");
    if (port.type.empty() ? type.role == Role::compute : !find_value(port.type))
      refuse(what, "output " + port.name + " has the unknown type \"" + port.type + "\"");
    if (!port.passes.empty() && !type.find_input(port.passes))
      refuse(what, "output " + port.name + " passes on " + port.passes + ", which is no input");
    if (!port.passes.empty() && port.constant)
      refuse(what, "output " + port.name + " passes on and is a constant");
  }
  names.clear();
  for (const Param& param : type.params) {
    if (!is_plain_name(param.name) || !names.insert(param.name).second)
      refuse(what, "bad parameter \"" + param.name + "\"");
    if (type.find_input(param.name) && type.role == Role::compute)
      refuse(what, param.name + " is an input and a parameter");
    if (param.help.empty()) refuse(what, "parameter " + param.name + " has no help");
    if (!param.fallback) refuse(what, "parameter " + param.name + " has no default");
    check_form(param, what + ", parameter " + param.name);
    for (const Diagnostic& problem : check(param, *param.fallback, param.name))
      refuse(what, "the default of a parameter: " + to_text(problem));
  }
  if (type.version < 1 || type.code_version < 1) refuse(what, "versions count from 1");
  for (int from = 1; from < type.version; ++from) {
    const auto steps = std::count_if(type.migrations.begin(), type.migrations.end(),
                                     [&](const Migration& step) { return step.from == from && step.apply; });
    if (steps != 1) refuse(what, "needs one migration from version " + std::to_string(from));
  }
  if (type.migrations.size() != static_cast<std::size_t>(type.version - 1))
    refuse(what, "has a migration too many");
  if (type.role == Role::compute && !type.compute) refuse(what, "has no compute function");
  std::string name = type.name;
  nodes_.emplace(std::move(name), std::move(type));
}

const NodeType* Registry::find(std::string_view name) const {
  const auto found = nodes_.find(name);
  return found == nodes_.end() ? nullptr : &found->second;
}
const ValueType* Registry::find_value(std::string_view name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

namespace {
template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> all;
  for (const auto& [key, value] : map) all.push_back(key);
  return all;
}
}  // namespace

std::vector<std::string> Registry::names() const {
  return keys(nodes_);
}
std::vector<std::string> Registry::value_names() const {
  return keys(values_);
}

std::string Registry::arrives_as(std::string_view from, const InputPort& port) const {
  if (port.types.empty()) return std::string(from);
  for (const std::string& accepted : port.types)
    if (accepted == from) return accepted;
  for (const std::string& accepted : port.types)
    if (const ValueType* type = find_value(accepted); type && type->convert_from == from) return accepted;
  return "";
}

}  // namespace kinegraph
