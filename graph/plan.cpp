#include "graph/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>

#include "graph/nested.h"
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
  const Scope* outer = nullptr;
  std::string graph;  // the Graph node's name in the outer scope
  struct Given {      // by the Graph node, through what is published: complete, paths absolute
    Json value;
    std::map<std::string, std::string> shown_paths;
  };
  using Spot = std::pair<std::string, std::string>;
  std::map<Spot, Given> given = {};  // node, param
  std::map<Spot, std::string> published_inputs =
      {};  // node, port -> the published name that is linked outside
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
    for (const Scope& inner : inner_scopes_) connect(inner);
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

  // For "outer/inner": what of the inside can be set, and how.
  std::optional<std::string> suggestion_inside(const std::string& name) const {
    const auto outer = root_.document.nodes.find(name.substr(0, name.find('/')));
    if (name.find('/') == std::string::npos || outer == root_.document.nodes.end() || !outer->second.nested)
      return {};
    std::string names;
    if (const NodeType* type = known_type(registry_, outer->second))
      for (const Param& param : type->params)
        if (param.name != "file") names += (names.empty() ? " " : ", ") + outer->first + "." + param.name;
    return "of a nested graph only what it publishes can be set:" + (names.empty() ? " nothing" : names);
  }
  void read_set(const Link& target, const std::string& text) {
    const Document& document = root_.document;
    const auto node = document.nodes.find(target.node);
    if (node == document.nodes.end()) {
      std::vector<std::string> names;
      for (const auto& [name, other] : document.nodes) names.push_back(name);
      return complain(error("unknown-node",
                            fmt::format("--set {}: there is no node \"{}\"", to_text(target), target.node))
                          .hinting(suggestion_inside(target.node).value_or(suggestion(target.node, names))),
                      "", true);
    }
    const NodeType* type = known_type(registry_, node->second);
    const Param* param = type ? type->find_param(target.port) : nullptr;
    // A graph file that can't be opened makes its node a missing one, which tells what is wrong with it.
    if (!type && node->second.nested && target.port == "file") return;
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
      planned.type = known_type(registry_, node);
      if (planned.type && is_unopened(*planned.type, node)) planned.type = nullptr;
      if (node.nested && !node.nested->type) planned.missing_because = node.nested->why.message;
      planned.type_name = node.type;
      planned.enabled = node.enabled;
      if (planned.type) set_params(scope, name, node, planned);
      if (planned.type && planned.type->role == Role::select) {
        const Json& index = planned.params.at("index");
        if (index.is_number()) chosen_[planned.name] = index.number();
      }
      if (planned.type && planned.type->role == Role::graph && node.enabled)
        open_graph(scope, name, node, planned);
      if (!node.enabled || (planned.type && planned.type->role != Role::compute)) plan_.passed[planned.name];
      if (planned.type && planned.type->role != Role::compute) continue;
      if (node.enabled && planned.type && planned.type->effect != Effect::none && scope.prefix.empty())
        plan_.effects.push_back(planned.name);
      plan_.by_name[planned.name] = static_cast<int>(plan_.nodes.size());
      plan_.nodes.push_back(std::move(planned));
    }
  }

  // The nodes of a Graph node's file, with what is set and linked from outside.
  void open_graph(const Scope& scope, const std::string& name, const Node& node, const PlannedNode& planned) {
    const Nested& nested = *node.nested;
    if (std::find(plan_.graph_files.begin(), plan_.graph_files.end(), nested.path) == plan_.graph_files.end())
      plan_.graph_files.push_back(nested.path);
    Scope& inner = inner_scopes_.emplace_back(
        Scope{*nested.document, planned.name + "/", {nested.folder, scope.folders.write}, scope.variables});
    inner.variables.files.push_back(&nested.document->variables);
    inner.outer = &scope;
    inner.graph = name;
    for (const auto& [published, targets] : nested.document->publish.params) {
      const bool is_given = scope.given.contains({name, published}) || node.params.contains(published) ||
                            (scope.prefix.empty() && sets_.contains({name, published}));
      const auto value = planned.params.find(published);
      if (!is_given || value == planned.params.end()) continue;
      Scope::Given passed{value->second, {}};
      for (const auto& [where, path] : planned.shown_paths)
        if (where == published || where.starts_with(published + ".") || where.starts_with(published + "["))
          passed.shown_paths[where.substr(published.size())] = path;
      for (const Link& target : targets) inner.given[{target.node, target.port}] = passed;
    }
    for (const auto& [published, targets] : nested.document->publish.inputs)
      if (!links_of(scope, name, published).links.empty())
        for (const Link& target : targets) inner.published_inputs[{target.node, target.port}] = published;
    inner_[planned.name] = &inner;
    add_nodes(inner);
  }

  // What is linked to a port, and in whose names: that of a published port that is linked outside, else the
  // file's own.
  struct Linked {
    const Scope* scope;
    std::vector<Link> links;
  };
  Linked links_of(const Scope& scope, const std::string& name, const std::string& port) const {
    if (const auto published = scope.published_inputs.find({name, port});
        published != scope.published_inputs.end())
      return links_of(*scope.outer, scope.graph, published->second);
    const Node& node = scope.document.nodes.at(name);
    const auto inputs = node.inputs.find(port);
    return {&scope, inputs == node.inputs.end() ? std::vector<Link>() : inputs->second.links};
  }

  void set_params(const Scope& scope, const std::string& name, const Node& node, PlannedNode& planned) {
    for (const Param& param : planned.type->params) {
      if (const auto passed = scope.given.find({name, param.name}); passed != scope.given.end()) {
        planned.params[param.name] = passed->second.value;
        for (const auto& [where, path] : passed->second.shown_paths)
          planned.shown_paths[param.name + where] = path;
        continue;
      }
      const auto given = scope.prefix.empty() ? sets_.find({name, param.name}) : sets_.end();
      const bool is_set = given != sets_.end();
      const auto stored = node.params.find(param.name);
      // What a Graph node doesn't set stays as its file has it.
      const bool published = planned.type->role == Role::graph && param.name != "file";
      if (published && !is_set && stored == node.params.end()) continue;
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
      make_absolute(scope, param, written, value, is_set, planned);
      planned.params[param.name] = std::move(value);
    }
    if (planned.type->resolve) planned.type->resolve(planned.params);
  }

  void make_absolute(const Scope& scope, const Param& param, const Json& as_written, Json& value, bool is_set,
                     PlannedNode& planned) {
    const std::string text = compact(as_written);
    const bool own_name =
        text.find("${item}") != std::string::npos || text.find("${index}") != std::string::npos;
    for_each_path(param, value, param.name, [&](Json& path, const ParamType& type, const std::string& where) {
      planned.shown_paths[where] = path.string();
      const bool written = type.kind == Kind::save_file;
      std::string folder = written ? scope.folders.write : is_set ? options_.set_folder : scope.folders.read;
      if (written && !own_name && !options_.item.empty()) folder = in_folder(folder, options_.item);
      path = Json(in_folder(folder, path.string()));
      if (is_set) plan_.set_paths.push_back(path.string());
    });
  }

  void connect(const Scope& scope) {
    for (const auto& [name, node] : scope.document.nodes) {
      const std::string full = scope.prefix + name;
      if (const auto passed = plan_.passed.find(full); passed != plan_.passed.end())
        if (const NodeType* type = known_type(registry_, node))
          for (const OutputPort& output : type->outputs)
            if (auto source = source_of(scope, {name, output.name, {}}))
              passed->second[output.name] = *source;
      const auto index = plan_.by_name.find(full);
      if (index == plan_.by_name.end()) continue;
      PlannedNode& planned = plan_.nodes[static_cast<std::size_t>(index->second)];
      std::set<std::string> ports;
      for (const auto& [port, inputs] : node.inputs) ports.insert(port);
      for (auto spot = scope.published_inputs.lower_bound({name, ""});
           spot != scope.published_inputs.end() && spot->first.first == name; ++spot)
        ports.insert(spot->first.second);
      for (const std::string& port : ports) {
        const Linked linked = links_of(scope, name, port);
        for (const Link& link : linked.links)
          if (auto source = source_of(*linked.scope, link)) planned.inputs[port].push_back(*source);
      }
      if (planned.type && planned.enabled) planned.blocked = why_blocked(scope, name, planned);
    }
  }

  std::string why_blocked(const Scope& scope, const std::string& name, const PlannedNode& planned) const {
    for (const InputPort& port : planned.type->inputs) {
      if (port.optional || planned.inputs.count(port.name)) continue;
      const Linked linked = links_of(scope, name, port.name);
      if (linked.links.empty()) return fmt::format("its input \"{}\" is open", port.name);
      return fmt::format(
          "its input \"{}\" is open: {} gives nothing while nodes before it are disabled or open", port.name,
          linked.scope->prefix + to_text(linked.links.front()));
    }
    return "";
  }

  // A link, and in whose names; without a link: there is none.
  struct Way {
    const Scope* scope = nullptr;
    std::optional<Link> link;
  };

  // What a link stands for: an output with a key, a constant, or nothing. Only nodes without a key lead on to
  // others, each to one, however long the way is.
  std::optional<Source> source_of(const Scope& scope, const Link& link) {
    std::vector<std::string> passed;  // on the way
    std::set<std::string> seen;
    std::optional<Source> source;
    for (Way way{&scope, link}; way.link;) {
      std::string key = way.scope->prefix + to_text(*way.link);
      if (const auto known = sources_.find(key); known != sources_.end()) {
        source = known->second;
        break;
      }
      // validate() has refused cycles; this keeps one from hanging the rest.
      if (!seen.insert(key).second) break;
      passed.push_back(std::move(key));
      way = follow(*way.scope, *way.link, source);
    }
    for (const std::string& key : passed) sources_[key] = source;
    return source;
  }

  // Where the way goes on. It ends with what `source` then is, or, without, with nothing.
  Way follow(const Scope& scope, const Link& link, std::optional<Source>& source) {
    const auto found = scope.document.nodes.find(link.node);
    if (found == scope.document.nodes.end()) return {};
    const Node& node = found->second;
    const std::string full = scope.prefix + link.node;
    if (!node.enabled) return follow_past(scope, link, source);
    const NodeType* type = known_type(registry_, node);
    if (!type || type->role == Role::compute || is_unopened(*type, node)) {
      source = Source{plan_.by_name.at(full), link.port, nullptr, ""};
      return {};
    }
    if (type->role == Role::select) return follow_chosen(scope, node, link);
    if (type->role == Role::pass) return follow_past(scope, link, source);
    const auto inner = inner_.find(full);
    if (inner == inner_.end()) return {};
    const auto& outputs = inner->second->document.publish.outputs;
    const auto published = outputs.find(link.port);
    if (published == outputs.end() || published->second.empty()) return {};
    return {inner->second, published->second.front()};
  }

  // Of a disabled node or a Dot: what the registry says the output passes on.
  Way follow_past(const Scope& scope, const Link& link, std::optional<Source>& source) {
    const NodeType* type = known_type(registry_, scope.document.nodes.at(link.node));
    const OutputPort* output = type ? type->find_output(link.port) : nullptr;
    if (!output) return {};
    if (output->constant) {
      const std::string id = type->name + "." + output->name;
      ValuePtr& value = constants_[id];
      if (!value) value = output->constant();
      source = Source{-1, output->name, value, id};
      return {};
    }
    if (output->passes.empty()) return {};
    const Linked linked = links_of(scope, link.node, output->passes);
    if (linked.links.empty()) return {};
    return {linked.scope, linked.links.front()};
  }

  Way follow_chosen(const Scope& scope, const Node& node, const Link& link) {
    const std::string full = scope.prefix + link.node;
    const NodeType* type = registry_.find(node.type);
    const auto chosen = chosen_.find(full);
    if (type->inputs.empty() || chosen == chosen_.end()) return {};
    const Linked linked = links_of(scope, link.node, type->inputs.front().name);
    const std::size_t count = linked.links.size();
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
    return {linked.scope, linked.links[static_cast<std::size_t>(chosen->second)]};
  }

  const Registry& registry_;
  const PlanOptions& options_;
  Diagnostics& problems_;
  Scope root_;
  std::deque<Scope> inner_scopes_;             // of the nested files; they stay where they are
  std::map<std::string, const Scope*> inner_;  // by the Graph node's full name
  Plan plan_;
  std::map<std::pair<std::string, std::string>, Json> sets_;  // node, param -> value
  std::map<std::string, double> chosen_;                      // of a Switch, by full name: its index
  std::map<std::string, std::optional<Source>> sources_;      // by full "node.port"
  std::map<std::string, ValuePtr> constants_;
  std::set<std::string> complained_;
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
