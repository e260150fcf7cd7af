#include <filesystem>
#include <functional>

#include "headless/session.h"

namespace kinegraph {

namespace {

using Kind = ParamType::Kind;

// Every path of the kind inside a parameter's value.
void each_path(const ParamType& type, const Json& value, Kind kind,
               const std::function<void(const std::string&)>& found) {
  if (type.kind == kind) {
    if (value.is_string() && !value.string().empty()) found(value.string());
  } else if (type.kind == Kind::list && value.is_array()) {
    for (const auto& element : value.array()) each_path(type.parts[0], element, kind, found);
  } else if (type.kind == Kind::tuple && value.is_array()) {
    for (std::size_t i = 0; i < value.array().size() && i < type.parts.size(); ++i)
      each_path(type.parts[i], value.array()[i], kind, found);
  } else if (type.kind == Kind::object) {
    for (const auto& field : type.parts)
      if (const Json* member = value.find(field.name)) each_path(field, *member, kind, found);
  } else if (type.kind == Kind::table && value.is_object()) {
    for (const auto& [name, member] : value.object()) each_path(type.parts[0], member, kind, found);
  }
}

}  // namespace

std::vector<Session::FileUse> Session::files_read() const {
  std::vector<FileUse> uses;
  for (const auto& node : plan_.nodes) {
    if (!node.type || !node.enabled) continue;
    auto add = [&](const std::string& param, const std::string& path, bool companion) {
      uses.push_back({node.name, param, path, false, files_->exists(path), companion});
    };
    for (const auto& param : node.type->params)
      if (auto value = node.params.find(param.name); value != node.params.end())
        each_path(param, value->second, Kind::open_file,
                  [&](const std::string& path) { add(param.name, path, false); });
    if (!node.type->companions) continue;
    try {
      for (const auto& path : node.type->companions(Params(node.params), *files_)) add("", path, true);
    } catch (const Failure&) {
      // The node will say so itself when it runs; a list of files has nothing to add.
    }
  }
  return uses;
}

std::vector<Session::FileUse> Session::files_written() const {
  std::vector<FileUse> uses;
  for (const auto& name : plan_.effects) {
    const auto& node = plan_.nodes[static_cast<std::size_t>(plan_.by_name.at(name))];
    auto add = [&](const std::string& param, const std::string& path, bool companion) {
      uses.push_back({node.name, param, path, true, std::filesystem::exists(path), companion});
    };
    for (const auto& param : node.type->params)
      if (auto value = node.params.find(param.name); value != node.params.end())
        each_path(param, value->second, Kind::save_file,
                  [&](const std::string& path) { add(param.name, path, false); });
    if (node.type->also_writes)
      for (const auto& path : node.type->also_writes(Params(node.params))) add("", path, true);
  }
  return uses;
}

}  // namespace kinegraph
