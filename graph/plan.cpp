#include "graph/plan.h"

#include <fmt/format.h>

#include <set>

#include "graph/variables.h"

namespace kinegraph {

namespace {

using Kind = ParamType::Kind;

// The folder that a parameter's paths start from.
struct Folders {
  std::string read, write;
};

std::string in_folder(const std::string& folder, std::string path) {
  while (path.starts_with("./")) path.erase(0, 2);
  if (path.starts_with('/') || folder.empty()) return path;
  return folder.ends_with('/') ? folder + path : folder + "/" + path;
}

// Calls what(path, type, where) for every path in a checked value, to be changed in place.
template <class What>
void for_each_path(const ParamType& type, Json& value, const std::string& where, const What& what) {
  switch (type.kind) {
    case Kind::open_file:
    case Kind::save_file:
      if (value.is_string() && !value.string().empty()) what(value, type, where);
      return;
    case Kind::list:
    case Kind::tuple:
      for (std::size_t i = 0; value.is_array() && i < value.array().size(); ++i)
        for_each_path(type.parts[type.kind == Kind::list ? 0 : i], value.array()[i],
                      fmt::format("{}[{}]", where, i), what);
      return;
    case Kind::object:
      for (const ParamType& field : type.parts)
        if (value.find(field.name))
          for_each_path(field, value.object()[field.name], where + "." + field.name, what);
      return;
    case Kind::table:
      for (auto& [key, member] : value.object())
        for_each_path(type.parts[0], member, where + "." + key, what);
      return;
    case Kind::either:
      for (const ParamType& part : type.parts)
        if (check(part, value, where).empty()) return for_each_path(part, value, where, what);
      return;
    default:
      return;
  }
}

// One graph file's nodes on their way into the plan. A nested file is a scope of its own: its nodes get the
// Graph node's name and a slash before theirs, its paths start in its own folder, its variables come after
// the outer ones, and its published inputs stand for what is linked to the Graph node.
struct Scope {
  const Document& document;
  std::string prefix;
  Folders folders;
  Variables variables;
};

class Planner {
 public:
  Planner(const Document& document, const Registry& registry, const PlanOptions& options,
          Diagnostics& problems)
      : registry_(registry),
        options_(options),
        problems_(problems),
        root_{document, "", {options.folder, options.out.empty() ? options.folder : options.out}, {}} {
    root_.variables.given = options.variables;
    root_.variables.files = {&document.variables};
    plan_.file = options.file;
    plan_.folder = options.folder;
  }

  Plan make() {
    read_sets();
    add_nodes(root_);
    connect(root_);
    for (const auto& [name, targets] : root_.document.publish.outputs)
      if (!targets.empty())
        if (auto source = source_of(root_, targets.front())) plan_.published[name] = *source;
    return std::move(plan_);
  }

 private:
  void complain(Diagnostic diagnostic, const std::string& node, bool usage) {
    diagnostic.node = node;
    if (usage)
      diagnostic.code = "usage:" + diagnostic.code;
    else
      diagnostic.file = options_.file;
    problems_.push_back(std::move(diagnostic));
  }

  // --set NODE.PARAM=VALUE, where NODE.PARAM may be a published name.
  void read_sets() {
    const Document& document = root_.document;
    for (const auto& [name, text] : options_.sets) {
      std::vector<Link> targets;
      if (const auto published = document.publish.params.find(name);
          published != document.publish.params.end()) {
        targets = published->second;
      } else if (const std::size_t dot = name.find('.'); dot != std::string::npos) {
        targets.push_back({name.substr(0, dot), name.substr(dot + 1), {}});
      } else {
        std::vector<std::string> names;
        for (const auto& [other, links] : document.publish.params) names.push_back(other);
        complain(error("unknown-param", fmt::format("--set {}: the graph publishes no such parameter", name))
                     .hinting(names.empty() ? "write NODE.PARAM=VALUE" : suggestion(name, names)),
                 "", true);
      }
      for (const Link& target : targets) read_set(target, text);
    }
  }

  void read_set(const Link& target, const std::string& text) {
    const Document& document = root_.document;
    const auto node = document.nodes.find(target.node);
    if (node == document.nodes.end()) {
      std::vector<std::string> names;
      for (const auto& [name, other] : document.nodes) names.push_back(name);
      return complain(error("unknown-node",
                            fmt::format("--set {}: there is no node \"{}\"", to_text(target), target.node))
                          .hinting(suggestion(target.node, names)),
                      "", true);
    }
    const NodeType* type = node->second.missing ? nullptr : registry_.find(node->second.type);
    const Param* param = type ? type->find_param(target.port) : nullptr;
    if (!param)
      return complain(
          error("unknown-param", fmt::format("--set {}: {} has no parameter \"{}\"", to_text(target),
                                             target.node, target.port))
              .hinting(type ? suggestion(target.port, type->param_names()) : "the node is missing"),
          target.node, true);
    try {
      Json value = whole_variable(text).empty() ? parse_value(*param, text) : Json(text);
      sets_[{target.node, target.port}] = std::move(value);
    } catch (const Failure& failure) {
      complain(Diagnostic(failure.diagnostic()).at_param(target.port), target.node, true);
    }
  }

  void add_nodes(const Scope& scope) {
    for (const auto& [name, node] : scope.document.nodes) {
      PlannedNode planned;
      planned.name = scope.prefix + name;
      planned.type = node.missing ? nullptr : registry_.find(node.type);
      planned.type_name = node.type;
      planned.enabled = node.enabled;
      if (planned.type) set_params(scope, name, node, planned);
      if (planned.type && planned.type->role == Role::select) {
        const Json& index = planned.params.at("index");
        if (index.is_number()) chosen_[planned.name] = index.number();
      }
      if (!node.enabled || (planned.type && planned.type->role != Role::compute)) plan_.passed[planned.name];
      if (planned.type && planned.type->role != Role::compute) continue;
      if (node.enabled && planned.type && planned.type->effect != Effect::none && scope.prefix.empty())
        plan_.effects.push_back(planned.name);
      plan_.by_name[planned.name] = static_cast<int>(plan_.nodes.size());
      plan_.nodes.push_back(std::move(planned));
    }
  }

  void set_params(const Scope& scope, const std::string& name, const Node& node, PlannedNode& planned) {
    for (const Param& param : planned.type->params) {
      const auto given = scope.prefix.empty() ? sets_.find({name, param.name}) : sets_.end();
      const bool is_set = given != sets_.end();
      const auto stored = node.params.find(param.name);
      const Json& written = is_set                        ? given->second
                            : stored != node.params.end() ? stored->second
                                                          : *param.fallback;
      Diagnostics found;
      Json value = substituted(written, param, scope.variables, param.name, found);
      if (!has_error(found))
        for (Diagnostic& problem : check(param, value, param.name)) found.push_back(std::move(problem));
      const bool fits = !has_error(found);
      // Warnings about what the file holds are validate's to give.
      for (Diagnostic& problem : found)
        if (is_set || problem.severity == Severity::error) complain(std::move(problem), planned.name, is_set);
      value = fits ? completed(param, value) : *param.fallback;
      make_absolute(scope, param, value, is_set, planned);
      planned.params[param.name] = std::move(value);
    }
    if (planned.type->resolve) planned.type->resolve(planned.params);
  }

  void make_absolute(const Scope& scope, const Param& param, Json& value, bool is_set, PlannedNode& planned) {
    for_each_path(param, value, param.name, [&](Json& path, const ParamType& type, const std::string& where) {
      planned.shown_paths[where] = path.string();
      const bool written = type.kind == Kind::save_file;
      const std::string& folder = written  ? scope.folders.write
                                  : is_set ? options_.set_folder
                                           : scope.folders.read;
      path = Json(in_folder(folder, path.string()));
      if (is_set) plan_.set_paths.push_back(path.string());
    });
  }

  void connect(const Scope& scope) {
    for (const auto& [name, node] : scope.document.nodes) {
      const std::string full = scope.prefix + name;
      if (const auto passed = plan_.passed.find(full); passed != plan_.passed.end())
        if (const NodeType* type = node.missing ? nullptr : registry_.find(node.type))
          for (const OutputPort& output : type->outputs)
            if (auto source = source_of(scope, {name, output.name, {}}))
              passed->second[output.name] = *source;
      const auto index = plan_.by_name.find(full);
      if (index == plan_.by_name.end()) continue;
      PlannedNode& planned = plan_.nodes[static_cast<std::size_t>(index->second)];
      for (const auto& [port, inputs] : node.inputs)
        for (const Link& link : inputs.links)
          if (auto source = source_of(scope, link)) planned.inputs[port].push_back(*source);
      if (planned.type && planned.enabled) planned.blocked = why_blocked(node, planned);
    }
  }

  static std::string why_blocked(const Node& node, const PlannedNode& planned) {
    for (const InputPort& port : planned.type->inputs) {
      if (port.optional || planned.inputs.count(port.name)) continue;
      const auto linked = node.inputs.find(port.name);
      if (linked == node.inputs.end() || linked->second.links.empty())
        return fmt::format("its input \"{}\" is open", port.name);
      return fmt::format(
          "its input \"{}\" is open: {} gives nothing while nodes before it are disabled or open", port.name,
          to_text(linked->second.links.front()));
    }
    return "";
  }

  // What a link stands for: an output with a key, a constant, or nothing.
  std::optional<Source> source_of(const Scope& scope, const Link& link) {
    const std::string key = scope.prefix + to_text(link);
    if (const auto known = sources_.find(key); known != sources_.end()) return known->second;
    // Only nodes without a key lead on to others; validate() has refused cycles, this keeps one from hanging
    // the rest.
    if (!open_.insert(key).second) return {};
    auto source = found_source(scope, link);
    open_.erase(key);
    sources_[key] = source;
    return source;
  }

  std::optional<Source> found_source(const Scope& scope, const Link& link) {
    const auto found = scope.document.nodes.find(link.node);
    if (found == scope.document.nodes.end()) return {};
    const Node& node = found->second;
    const std::string full = scope.prefix + link.node;
    if (!node.enabled) return source_past(scope, node, link);
    const NodeType* type = node.missing ? nullptr : registry_.find(node.type);
    if (!type || type->role == Role::compute) return Source{plan_.by_name.at(full), link.port, nullptr, ""};
    if (type->role == Role::select) return chosen_source(scope, node, link);
    if (type->role == Role::pass) return source_past(scope, node, link);
    return {};
  }

  // Of a disabled node or a Dot: what the registry says the output passes on.
  std::optional<Source> source_past(const Scope& scope, const Node& node, const Link& link) {
    const NodeType* type = node.missing ? nullptr : registry_.find(node.type);
    const OutputPort* output = type ? type->find_output(link.port) : nullptr;
    if (!output) return {};
    if (output->constant) {
      const std::string id = type->name + "." + output->name;
      ValuePtr& value = constants_[id];
      if (!value) value = output->constant();
      return Source{-1, output->name, value, id};
    }
    const auto inputs = node.inputs.find(output->passes);
    if (inputs == node.inputs.end() || inputs->second.links.empty()) return {};
    return source_of(scope, inputs->second.links.front());
  }

  std::optional<Source> chosen_source(const Scope& scope, const Node& node, const Link& link) {
    const std::string full = scope.prefix + link.node;
    const NodeType* type = registry_.find(node.type);
    const auto chosen = chosen_.find(full);
    if (type->inputs.empty() || chosen == chosen_.end()) return {};
    const auto inputs = node.inputs.find(type->inputs.front().name);
    const std::size_t count = inputs == node.inputs.end() ? 0 : inputs->second.links.size();
    if (!(chosen->second < static_cast<double>(count))) {
      if (complained_.insert(full).second) {
        complain(error("index-out-of-range",
                       fmt::format("index {} of {} links", shortest_number(chosen->second), count))
                     .hinting("links count from 0")
                     .at_param("index"),
                 full, false);
      }
      return {};
    }
    return source_of(scope, inputs->second.links[static_cast<std::size_t>(chosen->second)]);
  }

  const Registry& registry_;
  const PlanOptions& options_;
  Diagnostics& problems_;
  Scope root_;
  Plan plan_;
  std::map<std::pair<std::string, std::string>, Json> sets_;  // node, param -> value
  std::map<std::string, double> chosen_;                      // of a Switch, by full name: its index
  std::map<std::string, std::optional<Source>> sources_;      // by full "node.port"
  std::map<std::string, ValuePtr> constants_;
  std::set<std::string> open_, complained_;
};

}  // namespace

Plan make_plan(const Document& document, const Registry& registry, const PlanOptions& options,
               Diagnostics& problems) {
  return Planner(document, registry, options, problems).make();
}

std::optional<Source> Plan::find_output(const std::string& node, const std::string& port) const {
  if (const auto instead = passed.find(node); instead != passed.end()) {
    const auto found = instead->second.find(port);
    if (found == instead->second.end()) return {};
    return found->second;
  }
  const auto index = by_name.find(node);
  if (index == by_name.end()) return {};
  return Source{index->second, port, nullptr, ""};
}

}  // namespace kinegraph
