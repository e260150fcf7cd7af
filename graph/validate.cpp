#include "graph/validate.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <tuple>

#include "graph/links.h"
#include "graph/missing_file.h"
#include "graph/nested.h"

namespace kinegraph {

namespace {

namespace fs = std::filesystem;
using Kind = ParamType::Kind;

class Validator {
 public:
  Validator(const Document& document, const Registry& registry, const ValidateOptions& options)
      : document_(document), registry_(registry), options_(options), types_(document, registry) {
    variables_.given = options.variables;
    variables_.files = options.outer_variables;
    variables_.files.push_back(&document.variables);
    variables_.batch_fills_in = true;
    for (const auto& [name, node] : document.nodes) names_.push_back(name);
    const auto add_targets = [](const auto& published, auto& targets) {
      for (const auto& [name, links] : published)
        for (const Link& link : links) targets.insert({link.node, link.port});
    };
    add_targets(document.publish.inputs, published_inputs_);
    add_targets(document.publish.params, published_params_);
  }

  Diagnostics validate() {
    if (document_.read_only) return {};
    for (const auto& [name, node] : document_.nodes) {
      if (node.nested && !node.nested->type) check_file_of_graph(name, node);
      const NodeType* type = known_type(registry_, node);
      if (!type) {  // reading has spoken of it
        check_links_of_missing(name, node);
        continue;
      }
      check_params(name, node, *type);
      check_inputs(name, node, *type);
      if (type->role == Role::select) check_choice(name, node, *type);
      if (type->misfits && node.enabled) check_misfits(name, node, *type);
    }
    check_cycles();
    check_publish();
    check_shared_files();
    std::stable_sort(problems_.begin(), problems_.end(), stands_before);
    return std::move(problems_);
  }

 private:
  void add(Diagnostic diagnostic, Place place, const std::string& node = {}) {
    diagnostic.node = node;
    problems_.push_back(std::move(diagnostic).in_file(options_.file, place));
  }

  // Of the first unknown names; comparing thousands with thousands would take minutes.
  std::string node_meant(const std::string& name) {
    constexpr int most_suggested = 200;
    return suggested_++ < most_suggested ? suggestion(name, names_) : "";
  }

  // A stored parameter, or its default, with variables replaced; nothing where that failed.
  std::optional<Json> value_of(const Node& node, const Param& param, Diagnostics& found) const {
    const auto stored = node.params.find(param.name);
    if (stored == node.params.end()) return param.fallback;
    Json value = substituted(stored->second, param, variables_, param.name, found);
    if (has_error(found)) return {};
    Diagnostics wrong = check(param, value, param.name);
    const bool fits = wrong.empty();
    for (Diagnostic& problem : wrong) {
      // A variable's value stands elsewhere; the message points to where it is used.
      if (!whole_variable(stored->second.is_string() ? stored->second.string() : "").empty())
        problem.place = stored->second.place;
      found.push_back(std::move(problem));
    }
    if (!fits) return {};
    return value;
  }

  void check_params(const std::string& name, const Node& node, const NodeType& type) {
    for (const auto& [key, stored] : node.params) {
      const Param* param = type.find_param(key);
      if (!param && node.nested)
        add(error("unknown-param", fmt::format("{} publishes no parameter {}", file_of(node), in_quotes(key)))
                .at_param(key)
                .hinting(suggestion(key, type.param_names())),
            stored.key_place, name);
      if (!param) continue;
      Diagnostics found;
      const auto value = value_of(node, *param, found);
      for (Diagnostic& problem : found) {
        const Place place = problem.place.line > 0 ? problem.place : stored.place;
        add(std::move(problem), place, name);
      }
      if (value) check_paths(name, node, *param, *value, key);
    }
    // A type that begins with a path is about that file.
    if (!options_.check_files || !node.enabled || type.role != Role::compute || type.params.empty()) return;
    const Param& subject = type.params.front();
    if (subject.kind != Kind::open_file && subject.kind != Kind::save_file) return;
    const auto stored = node.params.find(subject.name);
    const bool named =
        stored != node.params.end() && !(stored->second.is_string() && stored->second.string().empty());
    if (!named && !is_published_param(name, subject.name))
      add(error("no-file", "no file is named").at_param(subject.name).hinting("set " + subject.name),
          stored == node.params.end() ? node.place : stored->second.place, name);
  }

  void check_paths(const std::string& name, const Node& node, const ParamType& type, const Json& value,
                   const std::string& where) {
    switch (type.kind) {
      case Kind::open_file:
      case Kind::save_file:
        if (value.is_string() && !value.string().empty()) check_path(name, node, type, value, where);
        return;
      case Kind::list:
      case Kind::tuple:
        for (std::size_t i = 0; i < value.array().size(); ++i)
          check_paths(name, node, type.parts[type.kind == Kind::list ? 0 : i], value.array()[i],
                      fmt::format("{}[{}]", where, i));
        return;
      case Kind::object:
        for (const ParamType& field : type.parts)
          if (const Json* member = value.find(field.name); member && !member->is_null())
            check_paths(name, node, field, *member, where + "." + field.name);
        return;
      case Kind::table:
        for (const auto& [key, member] : value.object())
          check_paths(name, node, type.parts[0], member, where + "." + key);
        return;
      case Kind::either:
        for (const ParamType& part : type.parts)
          if (check(part, value, where).empty()) return check_paths(name, node, part, value, where);
        return;
      default:
        return;
    }
  }

  void check_path(const std::string& name, const Node& node, const ParamType& type, const Json& value,
                  const std::string& where) {
    const std::string& path = value.string();
    const bool drive = path.size() > 2 && path[1] == ':' && (path[2] == '/' || path[2] == '\\');
    const bool absolute = path.front() == '/' || drive;
    const auto problem = [&](Diagnostic diagnostic) {
      add(std::move(diagnostic).at_param(where), value.place, name);
    };
    if (path.find('\\') != std::string::npos)
      problem(warning("backslash-path", fmt::format("{} has a backslash", in_quotes(path)))
                  .hinting("paths use forward slashes"));
    if (type.kind == Kind::save_file) {
      const std::string normal = fs::path(path).lexically_normal().generic_string();
      if (!options_.allow_outside && (absolute || normal == ".." || normal.starts_with("../")))
        problem(error("leads-outside",
                      fmt::format("{} leads out of the folder that is written to", in_quotes(path)))
                    .hinting("a path below --out; --allow-outside lets it be"));
      else if (absolute)
        problem(absolute_path(path));
      return;
    }
    if (absolute && !is_given_outside(node, where)) problem(absolute_path(path));
    if (!options_.check_files || !node.enabled || drive) return;
    const fs::path file = fs::path(options_.folder) / path;
    std::error_code ignored;
    const fs::file_status status = fs::status(file, ignored);
    if (!fs::exists(status))
      problem(error("missing-file", fmt::format("there is no file {}", in_quotes(path)))
                  .hinting(file_hint(file)));
    else if (!fs::is_regular_file(status))
      problem(error("not-a-regular-file", fmt::format("{} is no regular file", in_quotes(path)))
                  .hinting("it is a folder or a device; name a file"));
    else if (::access(file.c_str(), R_OK) != 0)
      problem(
          error("unreadable-file", fmt::format("{} can't be read: {}", in_quotes(path), std::strerror(errno)))
              .hinting("check its permissions"));
  }

  // Whether what the path starts with comes with --var: then it is not the file's to be the same on every
  // machine.
  bool is_given_outside(const Node& node, const std::string& where) const {
    const auto stored = node.params.find(where);
    if (stored == node.params.end() || !stored->second.is_string()) return false;
    const std::string_view text = stored->second.string();
    const std::size_t end = text.find('}');
    const std::string_view name = end == text.npos ? "" : whole_variable(text.substr(0, end + 1));
    return !name.empty() && variables_.given.contains(std::string(name));
  }

  static Diagnostic absolute_path(const std::string& path) {
    return warning("absolute-path", fmt::format("{} is an absolute path", in_quotes(path)))
        .hinting("a path relative to the graph file works on every machine");
  }

  static std::string file_hint(const fs::path& file) {
    const std::string instead = what_is_instead_of(file);
    return instead.empty() ? "paths are relative to the graph file" : instead;
  }

  void check_inputs(const std::string& name, const Node& node, const NodeType& type) {
    for (const auto& [key, inputs] : node.inputs) {
      if (const InputPort* port = type.find_input(key)) {
        if (node.nested) check_list(name, *port, inputs);
        for (const Link& link : inputs.links) check_link(name, *port, link);
      } else if (node.nested) {
        add(error("unknown-port", fmt::format("{} publishes no input {}", file_of(node), in_quotes(key)))
                .at_port(key)
                .hinting(suggestion(key, type.input_names())),
            inputs.place, name);
      }
    }
    if (!node.enabled || (type.role != Role::compute && !node.nested)) return;
    for (const InputPort& port : type.inputs)
      if (!port.optional && !node.inputs.count(port.name) && !is_published_input(name, port.name))
        open_input(
            name, node,
            error("open-input", fmt::format("{} needs a link to its input \"{}\"", type.name, port.name))
                .at_port(port.name)
                .hinting(fmt::format("link a {} to it: {}", fmt::join(port.types, " or a "), port.help)));
    const bool linked = std::any_of(type.inputs.begin(), type.inputs.end(), [&](const InputPort& port) {
      return node.inputs.count(port.name) || is_published_input(name, port.name);
    });
    if (type.effect == Effect::writes && !type.inputs.empty() && !linked)
      open_input(name, node,
                 error("open-input", fmt::format("no input of this {} is linked", type.name))
                     .hinting(fmt::format("link what is to be written to one of {}",
                                          fmt::join(type.input_names(), ", "))));
  }
  void open_input(const std::string& name, const Node& node, Diagnostic problem) {
    if (options_.allow_presets && document_.nodes.size() == 1) problem.severity = Severity::info;
    add(std::move(problem), node.place, name);
  }

  void check_misfits(const std::string& name, const Node& node, const NodeType& type) {
    Diagnostics wrong;  // each has been told
    Json::Object params;
    for (const Param& param : type.params) {
      auto value = value_of(node, param, wrong);
      if (!value || has_error(wrong)) return;
      params[param.name] = std::move(*value);
    }
    std::vector<std::string> linked;
    for (const InputPort& port : type.inputs)
      if (const auto inputs = node.inputs.find(port.name);
          inputs != node.inputs.end() && gives(inputs->second))
        linked.push_back(port.name);
    for (Diagnostic& problem : type.misfits(Params(std::move(params)), linked)) {
      Place place = node.place;
      if (const auto stored = node.params.find(problem.param); stored != node.params.end())
        place = stored->second.place;
      if (const auto inputs = node.inputs.find(problem.port); inputs != node.inputs.end())
        place = inputs->second.place;
      add(std::move(problem), place, name);
    }
  }

  // Whether anything may come of the links: an output of a disabled node can be absent.
  bool gives(const Inputs& inputs) const {
    return std::any_of(inputs.links.begin(), inputs.links.end(), [&](const Link& link) {
      const auto from = document_.nodes.find(link.node);
      return from == document_.nodes.end() || from->second.enabled;
    });
  }

  static std::string file_of(const Node& node) {
    return in_quotes(fs::path(node.nested->path).filename().string());
  }

  // Of a Graph node whose file can't be used: it is a missing node, and the rest can still run.
  void check_file_of_graph(const std::string& name, const Node& node) {
    Diagnostic why = node.nested->why;
    const auto stored = node.params.find("file");
    const NodeType* type = registry_.find(node.type);
    const Param* param = type ? type->find_param("file") : nullptr;
    Diagnostics found;
    if (param && stored != node.params.end() && !value_of(node, *param, found)) {
      for (Diagnostic& problem : found) add(std::move(problem), stored->second.place, name);
      return;
    }
    std::error_code ignored;
    if (options_.check_files && !node.nested->path.empty() && !fs::exists(node.nested->path, ignored))
      why.hint = file_hint(node.nested->path);
    const bool fatal = why.code == "graph-cycle" || why.code == "too-many-graphs";
    if (!fatal && !(options_.check_files && node.enabled)) why.severity = Severity::warning;
    why.param = "file";
    add(std::move(why), stored == node.params.end() ? node.place : stored->second.place, name);
  }

  void check_list(const std::string& name, const InputPort& port, const Inputs& inputs) {
    if (port.list && !inputs.list)
      add(error("needs-list", fmt::format("{} takes several links", port.name))
              .at_port(port.name)
              .hinting("write them as a list: [\"node.port\"]"),
          inputs.place, name);
    if (!port.list && inputs.list)
      add(error("one-link", fmt::format("{} takes one link", port.name))
              .at_port(port.name)
              .hinting("\"node.port\", not a list"),
          inputs.place, name);
  }

  // Its ports are not known, but what it names is here or isn't. It can't run anyway, so the rest may.
  void check_links_of_missing(const std::string& name, const Node& node) {
    for (const auto& [port, inputs] : node.inputs)
      for (const Link& link : inputs.links)
        if (!document_.nodes.contains(link.node))
          add(warning("unknown-node", fmt::format("there is no node \"{}\"", link.node))
                  .at_port(port)
                  .hinting(node_meant(link.node)),
              link.place, name);
  }

  void check_link(const std::string& name, const InputPort& port, const Link& link) {
    const auto from = document_.nodes.find(link.node);
    if (from == document_.nodes.end())
      return add(error("unknown-node", fmt::format("there is no node \"{}\"", link.node))
                     .at_port(port.name)
                     .hinting(node_meant(link.node)),
                 link.place, name);
    const NodeType* type = known_type(registry_, from->second);
    if (!type) return;
    if (!type->find_output(link.port) && !is_unopened(*type, from->second))
      return add(error("unknown-port", fmt::format("{} has no output \"{}\"", link.node, link.port))
                     .at_port(port.name)
                     .hinting(suggestion(link.port, type->output_names())),
                 link.place, name);
    const auto arriving = types_.of(link);
    if (arriving && registry_.arrives_as(*arriving, port).empty())
      add(error("type-mismatch", fmt::format("{} gives {}, and {} takes {}", to_text(link), *arriving,
                                             port.name, fmt::join(port.types, " or ")))
              .at_port(port.name)
              .hinting(outputs_that_fit(*type, port)),
          link.place, name);
  }

  std::string outputs_that_fit(const NodeType& type, const InputPort& port) const {
    for (const OutputPort& output : type.outputs)
      if (!output.type.empty() && !registry_.arrives_as(output.type, port).empty())
        return fmt::format("its output \"{}\" would fit", output.name);
    return fmt::format("link {}", fmt::join(port.types, " or "));
  }

  bool is_published_input(std::string_view node, std::string_view port) const {
    return published_inputs_.contains({node, port});
  }
  bool is_published_param(std::string_view node, std::string_view param) const {
    return published_params_.contains({node, param});
  }

  // A Switch: its index, and that its links are of one type.
  void check_choice(const std::string& name, const Node& node, const NodeType& type) {
    const InputPort& port = type.inputs.front();
    const auto inputs = node.inputs.find(port.name);
    const std::size_t count = inputs == node.inputs.end() ? 0 : inputs->second.links.size();
    const bool misspelled = inputs != node.inputs.end() && count == 0;  // reading has spoken of it
    const Param* param = type.find_param("index");
    Diagnostics ignored;
    const auto index = param ? value_of(node, *param, ignored) : std::nullopt;
    const auto stored = node.params.find("index");
    if (node.enabled && !misspelled && index && index->is_number() &&
        !(index->number() < static_cast<double>(count)))
      add(error("index-out-of-range",
                fmt::format("index {} of {} links", shortest_number(index->number()), count))
              .at_param("index")
              .hinting("links count from 0"),
          stored == node.params.end() ? node.place : stored->second.place, name);
    std::optional<std::string> first;
    for (std::size_t i = 0; i < count; ++i) {
      const Link& link = inputs->second.links[i];
      const auto there = types_.of(link);
      if (there && first && *there != *first)
        add(error("type-mismatch",
                  fmt::format("{} gives {}, the link before it {}", to_text(link), *there, *first))
                .at_port(port.name)
                .hinting("links of one type"),
            link.place, name);
      if (there && !first) first = there;
    }
  }

  static std::string shown_way(const std::vector<std::string>& nodes) {
    constexpr std::size_t most_shown = 12;
    if (nodes.size() <= most_shown) return fmt::format("{}", fmt::join(nodes, " → "));
    return fmt::format("{} → … ({} more) → {}",
                       fmt::join(nodes.begin(), nodes.begin() + most_shown - 1, " → "),
                       nodes.size() - most_shown, nodes.back());
  }

  void check_cycles() {
    for (const auto& cycle : cycles(document_)) {
      // Where it can be cut: the link by which the last node leads back to the first.
      const Node& first = document_.nodes.at(cycle.front());
      Place place = first.place;
      std::string port;
      for (const auto& [key, inputs] : first.inputs)
        for (const Link& link : inputs.links)
          if (link.node == cycle.back()) {
            place = link.place;
            port = key;
          }
      add(error("cycle",
                fmt::format("{} → {} depend on each other in a circle", shown_way(cycle), cycle.front()))
              .at_port(port)
              .hinting("remove one of these links"),
          place, cycle.front());
    }
  }

  const NodeType* published_type(const Link& target, const std::string& where) {
    const auto node = document_.nodes.find(target.node);
    if (node == document_.nodes.end()) {
      add(error("unknown-node", fmt::format("there is no node \"{}\"", target.node))
              .at_param(where)
              .hinting(node_meant(target.node)),
          target.place);
      return nullptr;
    }
    return known_type(registry_, node->second);
  }
  void unknown_published(const char* code, const Link& target, const char* what,
                         const std::vector<std::string>& known, const std::string& where) {
    add(error(code, fmt::format("{} has no {} \"{}\"", target.node, what, target.port))
            .at_param(where)
            .hinting(suggestion(target.port, known)),
        target.place);
  }

  static bool same_form(const ParamType& a, const ParamType& b) {
    const auto same_choice = [](const auto& x, const auto& y) { return x.key == y.key; };
    const auto same_part = [](const ParamType& x, const ParamType& y) {
      return x.name == y.name && same_form(x, y);
    };
    return a.kind == b.kind &&
           std::equal(a.choices.begin(), a.choices.end(), b.choices.begin(), b.choices.end(), same_choice) &&
           std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), same_part);
  }

  void check_publish() {
    for (const auto& [name, targets] : document_.publish.params) {
      const std::string where = "publish.params." + name;
      const Param* first = nullptr;
      for (const Link& target : targets) {
        const NodeType* type = published_type(target, where);
        if (!type || is_unopened(*type, document_.nodes.at(target.node))) continue;
        const Param* param = type->find_param(target.port);
        if (!param) {
          unknown_published("unknown-param", target, "parameter", type->param_names(), where);
        } else if (first && !same_form(*first, *param)) {
          add(error("type-mismatch", fmt::format("{} is {}, and what is published with it {}",
                                                 to_text(target), described(*param), described(*first)))
                  .at_param(where)
                  .hinting("one name sets parameters of one type"),
              target.place);
        } else if (!first) {
          first = param;
        }
      }
    }
    for (const auto& [name, targets] : document_.publish.inputs) {
      const std::string where = "publish.inputs." + name;
      const InputPort* first = nullptr;
      for (const Link& target : targets) {
        const NodeType* type = published_type(target, where);
        if (!type || is_unopened(*type, document_.nodes.at(target.node))) continue;
        const InputPort* port = type->find_input(target.port);
        if (!port) {
          unknown_published("unknown-port", target, "input", type->input_names(), where);
          continue;
        }
        if (!first) first = port;
        const bool shared =
            first->types.empty() || port->types.empty() ||
            std::any_of(first->types.begin(), first->types.end(),
                        [&](const std::string& one) { return !registry_.arrives_as(one, *port).empty(); });
        if (!shared)
          add(error("type-mismatch",
                    fmt::format("{} takes {}, and what is published with it {}", to_text(target),
                                fmt::join(port->types, " or "), fmt::join(first->types, " or ")))
                  .at_param(where)
                  .hinting("one name stands for ports of one type"),
              target.place);
      }
    }
    for (const auto& [name, targets] : document_.publish.outputs) {
      const std::string where = "publish.outputs." + name;
      for (const Link& target : targets) {
        const NodeType* type = published_type(target, where);
        if (type && !is_unopened(*type, document_.nodes.at(target.node)) && !type->find_output(target.port))
          unknown_published("unknown-port", target, "output", type->output_names(), where);
      }
    }
  }

  // Two enabled nodes that write one file. Companions are found out later, when it is known what is written.
  void check_shared_files() {
    std::map<std::string, std::string> writers;
    for (const auto& [name, node] : document_.nodes) {
      const NodeType* type = node.missing || !node.enabled ? nullptr : registry_.find(node.type);
      if (!type || type->effect != Effect::writes) continue;
      for (const Param& param : type->params) {
        if (param.kind != Kind::save_file) continue;
        Diagnostics ignored;
        const auto value = value_of(node, param, ignored);
        if (!value || !value->is_string() || value->string().empty()) continue;
        const std::string path = fs::path(value->string()).lexically_normal().generic_string();
        const auto [other, fresh] = writers.emplace(path, name);
        const auto stored = node.params.find(param.name);
        if (!fresh)
          add(error("same-file",
                    fmt::format("{} writes {} as well", other->second, in_quotes(value->string())))
                  .at_param(param.name)
                  .hinting("give each a file of its own"),
              stored == node.params.end() ? node.place : stored->second.place, name);
      }
    }
  }

  const Document& document_;
  const Registry& registry_;
  const ValidateOptions& options_;
  Variables variables_;
  OutputTypes types_;
  std::vector<std::string> names_;
  int suggested_ = 0;
  std::set<std::pair<std::string_view, std::string_view>> published_inputs_, published_params_;
  Diagnostics problems_;
};

}  // namespace

Diagnostics validate(const Document& document, const Registry& registry, const ValidateOptions& options) {
  return Validator(document, registry, options).validate();
}

namespace {
// The graphs inside a document's Graph nodes, for the same nodes of another.
Document as_opened(Document document, const Document& other) {
  for (auto& [name, node] : document.nodes)
    if (const auto same = other.nodes.find(name); same != other.nodes.end())
      node.nested = same->second.nested;
  return document;
}
}  // namespace

Diagnostics all_problems(const Document& document, Diagnostics found_by_reading, const Doubt& doubt,
                         const Registry& registry, const ValidateOptions& options) {
  Diagnostics all = std::move(found_by_reading);
  if (document.read_only || (has_error(all) && document.nodes.empty())) return all;
  Diagnostics found = validate(document, registry, options);
  if (doubt.other_side || doubt.torn_at > 0) {
    const Diagnostics of_other = doubt.other_side
                                     ? validate(as_opened(*doubt.other_side, document), registry, options)
                                     : Diagnostics();
    drop_other_side(found, of_other, doubt);
  }
  std::set<std::tuple<int, int, std::string, std::string>> told;
  for (const Diagnostic& problem : all)
    told.insert({problem.place.line, problem.place.column, problem.code, problem.message});
  for (Diagnostic& problem : found)
    if (!told.contains({problem.place.line, problem.place.column, problem.code, problem.message}))
      all.push_back(std::move(problem));
  drop_consequences(all, doubt);
  std::stable_sort(all.begin(), all.end(), stands_before);
  return all;
}

ReadResult read_and_validate(std::string_view text, const Registry& registry,
                             const ValidateOptions& options) {
  ReadResult result = read_document(text, options.file, registry);
  result.problems =
      all_problems(result.document, std::move(result.problems), result.doubt, registry, options);
  return result;
}

}  // namespace kinegraph
