#include "graph/move_paths.h"

#include <filesystem>
#include <map>
#include <set>

#include "graph/nested.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using Kind = ParamType::Kind;

constexpr auto far_away = "../../../../";

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

// Calls `with` for every path in a value of the type.
template <class With>
void for_each_path(const ParamType& type, Json& value, const With& with) {
  switch (type.kind) {
    case Kind::open_file:
    case Kind::save_file:
      if (value.is_string() && !value.string().empty()) with(value, type.kind);
      return;
    case Kind::list:
    case Kind::tuple:
      if (value.is_array())
        for (std::size_t i = 0; i < value.array().size(); ++i)
          if (type.kind == Kind::list || i < type.parts.size())
            for_each_path(type.parts[type.kind == Kind::list ? 0 : i], value.array()[i], with);
      return;
    case Kind::object:
      if (value.is_object())
        for (const ParamType& field : type.parts)
          if (auto member = value.object().find(field.name); member != value.object().end())
            for_each_path(field, member->second, with);
      return;
    case Kind::table:
      if (value.is_object())
        for (auto& [key, member] : value.object()) for_each_path(type.parts[0], member, with);
      return;
    case Kind::either:
      for (const ParamType& part : type.parts)
        if (check(part, value, "").empty()) return for_each_path(part, value, with);
      return;
    default:
      return;
  }
}

// The types that the nodes of a name have had: what is undone may be of a node that is no more.
using TypesOfNames = std::multimap<std::string, const NodeType*>;

// The variables that paths of files to read begin with.
void find_variables(const NodeType& type, const std::map<std::string, Json, std::less<>>& params,
                    std::set<std::string>& variables) {
  for (const auto& [key, value] : params)
    if (const Param* param = type.find_param(key)) {
      Json copy = value;
      for_each_path(*param, copy, [&](const Json& path, Kind kind) {
        if (kind != Kind::open_file || !path.string().starts_with("${")) return;
        const std::size_t end = path.string().find('}');
        if (end != std::string::npos) variables.insert(path.string().substr(2, end - 2));
      });
    }
}

void move_variable(Json& value, const Move& move) {
  if (value.is_string() && !value.string().empty()) value = moved_path(value.string(), Kind::open_file, move);
}

void move_in(std::optional<Json>& value, const Unit& unit, const TypesOfNames& types,
             const std::set<std::string>& variables, const Registry& registry, const Move& move) {
  if (!value) return;
  switch (unit.kind) {
    case Unit::Kind::variable:
      if (variables.count(unit.name)) move_variable(*value, move);
      return;
    case Unit::Kind::node_param:
      for (auto [type, end] = types.equal_range(unit.name); type != end; ++type)
        if (const Param* param = type->second->find_param(unit.key)) {
          value = moved_paths(*param, *value, move);
          return;
        }
      return;
    case Unit::Kind::node: {
      Node node = node_from_json(*value);
      const NodeType* type = registry.find(node.type);
      if (!type) return;
      for (auto& [key, param_value] : node.params)
        if (const Param* param = type->find_param(key)) param_value = moved_paths(*param, param_value, move);
      value = to_json(node);
      return;
    }
    default:
      return;
  }
}

}  // namespace

std::string moved_path(const std::string& path, ParamType::Kind kind, const Move& move) {
  if (path.empty() || path.starts_with("${")) return path;
  const fs::path written(path), to(move.to);
  if (kind == Kind::save_file) {
    if (!written.is_absolute()) return path;
    const std::string inside = written.lexically_relative(to).generic_string();
    return inside.empty() || inside == "." || inside.starts_with("..") ? path : inside;
  }
  if (!written.is_absolute() && move.from.empty()) return path;
  const fs::path file = (fs::path(move.from) / written).lexically_normal();
  if (!written.is_absolute() && path.find("${") == std::string::npos && !is_there(file) &&
      is_there(to / written))
    return path;
  const std::string relative = file.lexically_relative(to).generic_string();
  return relative.empty() || relative.starts_with(far_away) ? file.generic_string() : relative;
}

Json moved_paths(const ParamType& type, const Json& value, const Move& move) {
  Json moved = value;
  for_each_path(type, moved, [&](Json& path, Kind kind) {
    const std::string after = moved_path(path.string(), kind, move);
    if (after != path.string()) path = after;
  });
  return moved;
}

void move_paths(Document& document, const Registry& registry, const Move& move) {
  std::set<std::string> variables;
  for (auto& [name, node] : document.nodes) {
    const NodeType* type = known_type(registry, node);
    if (!type) continue;
    find_variables(*type, node.params, variables);
    for (auto& [key, value] : node.params)
      if (const Param* param = type->find_param(key)) value = moved_paths(*param, value, move);
  }
  for (const std::string& name : variables)
    if (auto variable = document.variables.find(name); variable != document.variables.end())
      move_variable(variable->second, move);
}

void move_paths(History& history, const Document& document, const Registry& registry, const Move& move) {
  TypesOfNames types;
  std::set<std::string> variables;
  for (const auto& [name, node] : document.nodes)
    if (const NodeType* type = known_type(registry, node)) {
      types.emplace(name, type);
      find_variables(*type, node.params, variables);
    }
  for (const Edit& step : history.steps())
    for (const Change& change : step.changes)
      for (const auto& value : {change.before, change.after})
        if (value && change.unit.kind == Unit::Kind::node) {
          const Node node = node_from_json(*value);
          if (const NodeType* type = registry.find(node.type)) {
            types.emplace(change.unit.name, type);
            find_variables(*type, node.params, variables);
          }
        }
  history.rewrite([&](Change& change) {
    move_in(change.before, change.unit, types, variables, registry, move);
    move_in(change.after, change.unit, types, variables, registry, move);
  });
}

}  // namespace kinegraph
