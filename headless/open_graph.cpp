#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "graph/file/parse_json.h"
#include "graph/file/read.h"
#include "graph/missing_file.h"
#include "graph/nested.h"
#include "headless/session.h"

namespace kinegraph {

namespace fs = std::filesystem;

std::string absolute_path(const std::string& path) {
  return path.empty() ? "" : fs::absolute(path).lexically_normal().string();
}

namespace {

// The bytes of a regular file, or an error that says why there are none.
std::string bytes_of(const std::string& path, Diagnostics& problems) {
  std::error_code problem;
  auto status = fs::status(path, problem);
  if (!fs::exists(status)) {
    const std::string instead = path.empty() ? "name a graph file" : what_is_instead_of(absolute_path(path));
    problems.push_back(
        error("missing-file", fmt::format("'{}' does not exist", path))
            .in_file(path)
            .hinting(instead.empty() ? "check the path: it starts at the current folder" : instead));
    return {};
  }
  if (!fs::is_regular_file(status)) {
    problems.push_back(error("not-a-regular-file", fmt::format("'{}' is not a regular file", path))
                           .in_file(path)
                           .hinting("name a graph file, *.kg.json"));
    return {};
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(fs::file_size(path, problem)) + 1);
  for (char block[1 << 16]; in.read(block, sizeof block), in.gcount() > 0;)
    bytes.append(block, static_cast<std::size_t>(in.gcount()));
  if (!in.is_open() || in.bad())
    problems.push_back(
        error("unreadable-file", fmt::format("'{}' can't be read: {}", path, std::strerror(errno)))
            .in_file(path));
  return bytes;
}

}  // namespace

Opened open_graph(const std::string& argument, const Registry& registry, bool migrate) {
  Opened opened;
  opened.shown = argument;
  opened.path = absolute_path(argument);
  opened.folder = fs::path(opened.path).parent_path().string();
  std::string text = bytes_of(argument, opened.problems);
  if (has_error(opened.problems)) return opened;
  auto read = read_document(text, argument, registry, migrate);
  opened.document = std::move(read.document);
  opened.problems = std::move(read.problems);
  opened.migrated = read.migrated;
  opened.doubt = std::move(read.doubt);
  return opened;
}

Diagnostics all_problems(const Opened& opened, const Registry& registry, const ValidateOptions& options) {
  return all_problems(opened.document, opened.problems, opened.doubt, registry, options);
}

void open_graphs_inside(Opened& opened, const Registry& registry,
                        const std::map<std::string, Json>& variables,
                        const std::vector<std::pair<std::string, std::string>>& sets, FileStore& files) {
  const Document& document = opened.document;
  NestedOptions options{.path = opened.path,
                        .folder = opened.folder,
                        .set_folder = fs::current_path().string(),
                        .variables = variables};
  for (const auto& [name, value] : sets) {
    const auto published = document.publish.params.find(name);
    auto targets = published == document.publish.params.end() ? std::vector<Link>() : published->second;
    if (const auto link = link_from_text(name)) targets.push_back(*link);
    for (const Link& target : targets) {
      const auto node = document.nodes.find(target.node);
      const NodeType* type = node == document.nodes.end() ? nullptr : registry.find(node->second.type);
      if (!type || type->role != Role::graph || target.port != "file") continue;
      options.files[target.node] = value;
      files.allow(absolute_path(value));
    }
  }
  options.read = [&](const std::string& path) { return *files.read(path); };
  open_nested(opened.document, registry, options);
}

std::map<std::string, Json> parsed_variables(const std::vector<std::string>& vars) {
  std::map<std::string, Json> variables;
  for (const auto& text : vars) {
    auto equals = text.find('=');
    auto name = text.substr(0, equals);
    if (equals == std::string::npos || !is_node_name(name))
      throw UsageError(error("bad-option", fmt::format("--var {} is not NAME=VALUE", text)));
    variables[name] = Json(text.substr(equals + 1));  // read as the parameter that uses it asks
  }
  return variables;
}

namespace {

// Adds each name that stands as ${name} in a text of `value`.
void add_variables_in(const Json& value, std::set<std::string>& names) {
  if (value.is_array())
    for (const Json& element : value.array()) add_variables_in(element, names);
  if (value.is_object())
    for (const auto& [key, member] : value.object()) add_variables_in(member, names);
  if (!value.is_string()) return;
  const std::string& text = value.string();
  for (std::size_t at = text.find("${"); at != text.npos; at = text.find("${", at + 2))
    names.insert(text.substr(at + 2, text.find('}', at) - at - 2));
}

void add_variables_of(const Document& document, std::set<std::string>& names) {
  for (const auto& [name, value] : document.variables) names.insert(name);
  for (const auto& [name, node] : document.nodes) {
    for (const auto& [key, value] : node.params) add_variables_in(value, names);
    if (node.missing) add_variables_in(*node.missing, names);
    if (node.nested && node.nested->document) add_variables_of(*node.nested->document, names);
  }
}

}  // namespace

Diagnostics unused_variables(const Opened& opened, const std::map<std::string, Json>& variables,
                             const std::vector<std::string>& sets) {
  std::set<std::string> used;
  add_variables_of(opened.document, used);
  for (const std::string& text : sets) add_variables_in(Json(text), used);
  Diagnostics unused;
  for (const auto& [name, value] : variables)
    if (!used.contains(name))
      unused.push_back(
          warning("unused-variable", fmt::format("--var {}: the graph has no ${{{}}}", name, name))
              .hinting(suggestion(name, {used.begin(), used.end()}))
              .in_file(opened.shown));
  return unused;
}

bool is_graph_file(const std::string& path) {
  if (path.ends_with(".kg.json")) return true;
  if (!path.ends_with(".json")) return false;
  Diagnostics problems;
  Json json = parse_json(bytes_of(path, problems), path, problems);
  const Json* format = json.find("format");
  return format && format->is_string() && format->string() == "kinegraph";
}

}  // namespace kinegraph
