#include "graph/nested.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "graph/file/read.h"
#include "graph/links.h"
#include "graph/validate.h"

namespace kinegraph {

namespace {

namespace fs = std::filesystem;

// More than any graph needs; files that use each other twice, level by level, would grow without end.
constexpr int most_files = 16384;
constexpr std::size_t most_levels = 64;

std::string absolute(const std::string& folder, const std::string& path) {
  return (fs::path(folder) / path).lexically_normal().string();
}

// One name for each file: by way of links a file has many, and could lie inside itself without end.
std::string without_links(const std::string& path) {
  std::error_code failed;
  const fs::path real = fs::weakly_canonical(path, failed);
  return failed ? path : real.string();
}

// The node type that a file makes of a Graph node.
class Face {
 public:
  Face(const Document& document, const Registry& registry, const NodeType& graph)
      : document_(document), registry_(registry), graph_(graph) {}

  NodeType make() {
    NodeType type = graph_;
    for (const auto& [name, targets] : document_.publish.inputs)
      if (auto port = input(targets)) {
        port->name = name;
        type.inputs.push_back(std::move(*port));
      }
    for (const auto& [name, targets] : document_.publish.outputs) {
      if (targets.empty()) continue;
      OutputPort port;
      port.name = name;
      port.type = type_of_output(document_, registry_, targets.front()).value_or("");
      if (const OutputPort* inner = output_of(targets.front())) port.help = inner->help;
      port.passes = passed_by(targets.front());
      type.outputs.push_back(std::move(port));
    }
    for (const auto& [name, targets] : document_.publish.params)
      if (auto param = this->param(targets)) {
        param->name = name;
        type.params.push_back(std::move(*param));
      }
    return type;
  }

 private:
  const NodeType* type_of(const std::string& name) const {
    const auto node = document_.nodes.find(name);
    return node == document_.nodes.end() ? nullptr : known_type(registry_, node->second);
  }
  const OutputPort* output_of(const Link& target) const {
    const NodeType* type = type_of(target.node);
    return type ? type->find_output(target.port) : nullptr;
  }

  std::optional<InputPort> input(const std::vector<Link>& targets) const {
    std::optional<InputPort> port;
    for (const Link& target : targets) {
      const NodeType* type = type_of(target.node);
      const InputPort* inner = type ? type->find_input(target.port) : nullptr;
      if (!inner) continue;
      const auto& inputs = document_.nodes.at(target.node).inputs;
      const auto sample = inputs.find(target.port);
      const bool open = !inner->optional && (sample == inputs.end() || sample->second.links.empty());
      if (!port) {
        port = *inner;
        port->optional = !open;
        continue;
      }
      port->optional = port->optional && !open;
      if (port->types.empty()) port->types = inner->types;
      if (!inner->types.empty())
        std::erase_if(port->types,
                      [&](const std::string& one) { return registry_.arrives_as(one, *inner).empty(); });
    }
    return port;
  }

  std::optional<Param> param(const std::vector<Link>& targets) const {
    for (const Link& target : targets) {
      const NodeType* type = type_of(target.node);
      const Param* inner = type ? type->find_param(target.port) : nullptr;
      if (!inner) continue;
      Param param = *inner;
      const auto& stored = document_.nodes.at(target.node).params;
      // What the file says is what stands when nothing is set.
      if (const auto value = stored.find(target.port);
          value != stored.end() && check(param, value->second, target.port).empty())
        param.fallback = value->second;
      return param;
    }
    return {};
  }

  // The published input that comes out here when every node on the way is out of it.
  std::string passed_by(Link at) const {
    for (std::size_t step = 0; step <= document_.nodes.size(); ++step) {
      const OutputPort* output = output_of(at);
      if (!output || output->passes.empty()) return "";
      const Link port{at.node, output->passes, {}};
      for (const auto& [name, targets] : document_.publish.inputs)
        if (std::find(targets.begin(), targets.end(), port) != targets.end()) return name;
      const auto& inputs = document_.nodes.at(at.node).inputs;
      const auto links = inputs.find(output->passes);
      if (links == inputs.end() || links->second.links.empty()) return "";
      at = links->second.links.front();
    }
    return "";
  }

  const Document& document_;
  const Registry& registry_;
  const NodeType& graph_;
};

class Opener {
 public:
  Opener(const Registry& registry, const NestedOptions& options) : registry_(registry), options_(options) {
    variables_.given = options.variables;
    if (!options.path.empty())
      open_.push_back(without_links(fs::path(options.path).lexically_normal().string()));
  }

  // `given`: Graph nodes whose file comes from outside (absolute).
  void open(Document& document, const std::string& folder, const std::map<std::string, std::string>& given) {
    variables_.files.push_back(&document.variables);
    std::map<Asked, Answer> known;
    for (auto& [name, node] : document.nodes) {
      node.nested.reset();
      const NodeType* type = node.missing ? nullptr : registry_.find(node.type);
      if (!type || type->role != Role::graph) continue;
      const auto from_outside = given.find(name);
      Asked asked{from_outside != given.end() ? from_outside->second : path_of(node, *type, folder), {}};
      asked.second = given_inside(node, asked.first, folder);
      Answer& answer = known[asked];
      // Nodes of one file share what it is; they count as if each had opened it, for each will be expanded.
      count_ = std::min(count_ + answer.count, most_files + 1);  // twice as many at each level would overflow
      if (!answer.nested || count_ > most_files) {
        const int before = count_;
        answer.nested = std::make_shared<const Nested>(opened(asked.first, asked.second, *type));
        answer.count = count_ - before;
      }
      node.nested = answer.nested;
    }
    variables_.files.pop_back();
  }

 private:
  // A file, and what is given to Graph nodes inside it: among the nodes of one document that is all there is.
  using Asked = std::pair<std::string, std::map<std::string, std::string>>;
  struct Answer {
    std::shared_ptr<const Nested> nested;
    int count = 0;  // of files opened for it
  };

  // "" where none is named.
  std::string path_of(const Node& node, const NodeType& type, const std::string& folder) {
    const Param* param = type.find_param("file");
    const auto stored = node.params.find("file");
    if (!param || stored == node.params.end()) return "";
    Diagnostics problems;
    const Json value = substituted(stored->second, *param, variables_, "file", problems);
    if (has_error(problems) || !value.is_string() || value.string().empty()) return "";
    return absolute(folder, value.string());
  }

  // Files that the Graph node names for Graph nodes inside, by what is published.
  std::map<std::string, std::string> given_inside(const Node& node, const std::string& path,
                                                  const std::string& folder) {
    std::map<std::string, std::string> given;
    if (path.empty() || node.params.size() < 2) return given;  // "file" alone gives nothing
    const Document* inside = &found_in(path).read.document;
    for (const auto& [published, targets] : inside->publish.params) {
      const auto stored = node.params.find(published);
      if (stored == node.params.end()) continue;
      for (const Link& target : targets) {
        const auto inner = inside->nodes.find(target.node);
        const NodeType* type = inner == inside->nodes.end() || inner->second.missing
                                   ? nullptr
                                   : registry_.find(inner->second.type);
        if (!type || type->role != Role::graph || target.port != "file") continue;
        Diagnostics problems;
        const Json value =
            substituted(stored->second, *type->find_param("file"), variables_, published, problems);
        if (value.is_string() && !has_error(problems)) given[target.node] = absolute(folder, value.string());
      }
    }
    return given;
  }

  Nested opened(const std::string& path, const std::map<std::string, std::string>& given,
                const NodeType& type) {
    Nested nested;
    nested.path = path;
    nested.folder = fs::path(path).parent_path().string();
    const fs::path named(path.ends_with('/') ? path.substr(0, path.size() - 1) : path);
    const std::string shown = in_quotes(named.filename().string());
    const auto refuse = [&](const char* code, std::string message, std::string hint) {
      nested.why = error(code, std::move(message)).hinting(std::move(hint));
      nested.document.reset();
      nested.type.reset();
      return nested;
    };
    if (path.empty()) return refuse("missing-file", "no graph file is named", "set its parameter \"file\"");
    const std::string real = without_links(path);
    if (const auto at = std::find(open_.begin(), open_.end(), real); at != open_.end()) {
      std::string way;
      for (auto file = at; file != open_.end(); ++file) way += fs::path(*file).filename().string() + " → ";
      return refuse("graph-cycle",
                    fmt::format("graph files use each other in a circle: {}{}", way,
                                fs::path(path).filename().string()),
                    "a file can't be inside itself");
    }
    if (open_.size() > most_levels || ++count_ > most_files)
      return refuse("too-many-graphs", "graph files lie too deep or too many inside one another", "");
    const Found& found_there = found_in(path);
    if (found_there.failure)
      return refuse("missing-file",
                    fmt::format("the graph file {} can't be read: {}", shown, found_there.failure->message),
                    is_set(path) ? "a path on the command line starts at the current folder"
                                 : "paths are relative to the graph file");
    for (const Diagnostic& problem : found_there.read.problems)
      if (problem.severity == Severity::error)
        return refuse("broken-graph", fmt::format("{} can't be used: {}", shown, in_short(problem)),
                      "`kinegraph validate` tells all that is wrong with it");
    if (found_there.read.document.read_only)
      return refuse("broken-graph", fmt::format("{} is of a newer schema", shown),
                    "a newer Kinegraph can run it");
    auto document = std::make_shared<Document>(found_there.read.document);
    open_.push_back(real);
    open(*document, nested.folder, given);
    open_.pop_back();
    ValidateOptions options{.file = path,
                            .folder = nested.folder,
                            .check_files = false,
                            .allow_outside = true,
                            .variables = options_.variables};
    options.outer_variables = variables_.files;
    const Diagnostics found = validate(*document, registry_, options);
    for (const Diagnostic& problem : found)
      if (problem.code == "graph-cycle") return refuse("graph-cycle", problem.message, problem.hint);
    for (const Diagnostic& problem : found)
      if (problem.severity == Severity::error)
        return refuse("broken-graph", fmt::format("{} can't be used: {}", shown, in_short(problem)),
                      "`kinegraph validate` tells all that is wrong with it");
    nested.type = std::make_shared<const NodeType>(Face(*document, registry_, type).make());
    nested.document = std::move(document);
    return nested;
  }

  static std::string in_short(const Diagnostic& problem) {
    const std::string where = problem.node.empty() ? "" : problem.node + ": ";
    return fmt::format("line {}: {}{}", problem.place.line, where, problem.message);
  }

  bool is_set(const std::string& path) const {
    return open_.size() <= 1 &&
           std::any_of(options_.files.begin(), options_.files.end(),
                       [&](const auto& file) { return absolute(options_.set_folder, file.second) == path; });
  }

  // What a file holds, or why it can't be read; each is read once.
  struct Found {
    ReadResult read;
    std::optional<Diagnostic> failure;
  };
  const Found& found_in(const std::string& path) {
    const auto [at, fresh] = found_.try_emplace(path);
    if (!fresh) return at->second;
    try {
      at->second.read = read_document(options_.read(path), path, registry_);
    } catch (const Failure& failure) {
      at->second.failure = failure.diagnostic();
    }
    return at->second;
  }

  const Registry& registry_;
  const NestedOptions& options_;
  Variables variables_;
  std::vector<std::string> open_;  // files without links, outermost first
  std::map<std::string, Found> found_;
  int count_ = 0;
};

}  // namespace

void open_nested(Document& document, const Registry& registry, const NestedOptions& options) {
  std::map<std::string, std::string> given;
  for (const auto& [node, file] : options.files) given[node] = absolute(options.set_folder, file);
  Opener(registry, options).open(document, options.folder, given);
}

const NodeType* known_type(const Registry& registry, const Node& node) {
  if (node.missing) return nullptr;
  if (node.nested) return node.nested->type.get();
  return registry.find(node.type);
}

bool is_unopened(const NodeType& type, const Node& node) {
  return type.role == Role::graph && !node.nested;
}

}  // namespace kinegraph
