#include "graph/collapse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "graph/edit_draft.h"
#include "graph/links.h"
#include "graph/move_paths.h"
#include "graph/nested.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

Diagnostic refusal(std::string message, std::string hint) {
  return error("cannot-collapse", std::move(message)).hinting(std::move(hint));
}

Json as_json(const std::vector<Link>& links, bool list) {
  if (!list) return to_text(links.front());
  Json::Array all;
  for (const Link& link : links) all.push_back(to_text(link));
  return all;
}

class Collapse {
 public:
  Collapse(const Document& document, const Registry& registry, const std::vector<std::string>& names,
           const CollapseOptions& options)
      : document_(document),
        registry_(registry),
        options_(options),
        chosen_(names.begin(), names.end()),
        draft_(document, fmt::format("Collapse into {}", fs::path(options.file).filename().string())) {}

  Collapsed make() {
    check_choice();
    made_.inside = copied(document_, registry_, {chosen_.begin(), chosen_.end()});
    if (options_.folder != options_.inner_folder)
      move_paths(made_.inside, registry_, {options_.folder, options_.inner_folder});
    made_.node = fresh_name(document_, "graph");
    publish_params();
    publish_inputs();
    publish_outputs();
    Node graph;
    graph.type = graph_type();
    graph.params["file"] = options_.file;
    draft_.add_node(made_.node, graph);
    for (const auto& [port, links] : graph_inputs_)
      draft_.set({Unit::Kind::node_input, made_.node, port}, as_json(links.links, links.list));
    relink();
    place();
    made_.edit = draft_.take();
    return std::move(made_);
  }

 private:
  void check_choice() {
    if (chosen_.empty()) throw Failure(refusal("no node is chosen", "choose the nodes to collapse first"));
    for (const std::string& name : chosen_) {
      const NodeType* type = known_type(registry_, node_or_fail(document_, name));
      if (type && type->effect != Effect::none)
        throw Failure(refusal(fmt::format("{} writes or checks, and inside another graph it would not run",
                                          in_quotes(name)),
                              "leave it outside")
                          .at_node(name));
    }
    for (const auto& [name, node] : document_.nodes) {
      if (chosen_.count(name)) continue;
      const bool after = std::any_of(chosen_.begin(), chosen_.end(), [&](const std::string& inner) {
        return depends_on(document_, name, inner);
      });
      const bool before = std::any_of(chosen_.begin(), chosen_.end(), [&](const std::string& inner) {
        return depends_on(document_, inner, name);
      });
      if (after && before)
        throw Failure(
            refusal(fmt::format("{} lies between two of the chosen nodes", in_quotes(name)), "choose it too")
                .at_node(name));
    }
  }

  std::string graph_type() const {
    for (const std::string& name : registry_.names())
      if (registry_.find(name)->role == Role::graph) return name;
    throw Failure(refusal("there is no node type that runs graphs", ""));
  }

  static std::string fresh(const std::string& wanted, const std::string& node, std::set<std::string>& taken) {
    std::string name = wanted == "file" || taken.count(wanted) ? node + "_" + wanted : wanted;
    name.resize(std::min<std::size_t>(name.size(), 60));
    for (int i = 2; name == "file" || taken.count(name); ++i) name = fmt::format("{}_{}", wanted, i);
    taken.insert(name);
    return name;
  }

  void publish_params() {
    for (const auto& [name, targets] : document_.publish.params)
      for (const Link& target : targets)
        if (chosen_.count(target.node)) {
          names_in_.insert(name);
          made_.inside.publish.params[name].push_back({target.node, target.port, {}});
        }
  }

  // Ports that take the same output from outside share a published name, unless this file publishes one of
  // them by itself.
  void publish_inputs() {
    const auto published_outside = [&](const std::string& node, const std::string& port) {
      std::vector<std::string> found;
      for (const auto& [name, targets] : document_.publish.inputs)
        if (std::find(targets.begin(), targets.end(), Link{node, port, {}}) != targets.end())
          found.push_back(name);
      return found;
    };
    std::map<std::string, std::pair<std::string, std::vector<std::string>>> shared;  // source -> name, types
    for (const std::string& name : chosen_) {
      const Node& node = document_.nodes.at(name);
      const NodeType* type = known_type(registry_, node);
      for (const auto& [port, inputs] : node.inputs) {
        const auto outside = [&](const Link& link) { return !chosen_.count(link.node); };
        const auto count = std::count_if(inputs.links.begin(), inputs.links.end(), outside);
        if (count == 0) continue;
        if (std::size_t(count) != inputs.links.size())
          throw Failure(refusal(fmt::format("the list {}.{} takes links both of chosen nodes and of others",
                                            name, port),
                                "choose all that it takes, or none")
                            .at_node(name));
        made_.inside.nodes.at(name).inputs.erase(port);
        const InputPort* described = type ? type->find_input(port) : nullptr;
        const auto types = described ? described->types : std::vector<std::string>();
        const std::string source = to_text(inputs.links.front());
        const bool alone = inputs.list || !published_outside(name, port).empty();
        const auto known = alone ? shared.end() : shared.find(source);
        std::string published;
        if (known != shared.end() && known->second.second == types) {
          published = known->second.first;
        } else {
          published = fresh(port, name, names_in_);
          graph_inputs_[published] = inputs;
          if (!alone) shared.emplace(source, std::pair(published, types));
        }
        made_.inside.publish.inputs[published].push_back({name, port, {}});
        input_of_[{name, port}] = published;
      }
    }
    for (const auto& [name, targets] : document_.publish.inputs)
      for (const Link& target : targets)
        if (chosen_.count(target.node) && !input_of_.count({target.node, target.port})) {
          const std::string inner = fresh(target.port, target.node, names_in_);
          made_.inside.publish.inputs[inner].push_back({target.node, target.port, {}});
          input_of_[{target.node, target.port}] = inner;
        }
  }

  std::string output_for(const Link& link) {
    auto& name = output_of_[{link.node, link.port}];
    if (name.empty()) {
      name = fresh(link.port, link.node, names_out_);
      made_.inside.publish.outputs[name] = {{link.node, link.port, {}}};
    }
    return name;
  }

  void publish_outputs() {
    for (const auto& [name, node] : document_.nodes)
      if (!chosen_.count(name))
        for (const auto& [port, inputs] : node.inputs)
          for (const Link& link : inputs.links)
            if (chosen_.count(link.node)) output_for(link);
    for (const auto& [name, targets] : document_.publish.outputs)
      for (const Link& link : targets)
        if (chosen_.count(link.node)) output_for(link);
  }

  void relink() {
    draft_.change_links(
        [&](const std::string& taker, const std::string&, const Link& link) -> std::optional<Link> {
          if (!chosen_.count(link.node) || chosen_.count(taker)) return link;
          return Link{made_.node, output_of_.at({link.node, link.port}), {}};
        });
    std::set<std::pair<Unit::Kind, std::string>> said;
    draft_.change_published([&](Unit::Kind kind, const Link& link) -> std::optional<Link> {
      if (!chosen_.count(link.node)) return link;
      std::string port;
      if (kind == Unit::Kind::publish_output) port = output_of_.at({link.node, link.port});
      if (kind == Unit::Kind::publish_input) port = input_of_.at({link.node, link.port});
      if (kind == Unit::Kind::publish_param)
        for (const auto& [name, targets] : made_.inside.publish.params)
          if (std::find(targets.begin(), targets.end(), Link{link.node, link.port, {}}) != targets.end() &&
              said.insert({kind, name}).second) {
            port = name;
            break;
          }
      if (port.empty()) return {};
      return Link{made_.node, port, {}};
    });
    for (const std::string& name : chosen_) draft_.remove_node(name);
  }

  // In the middle of where the nodes were; what was in a frame with all of them is in it still.
  void place() {
    double x = 0, y = 0;
    int placed = 0;
    for (const auto& [name, entry] : made_.inside.ui.nodes) {
      const Json* pos = entry.find("pos");
      if (!pos || !pos->is_array() || pos->array().size() != 2) continue;
      x += pos->array()[0].number();
      y += pos->array()[1].number();
      ++placed;
    }
    for (const std::string& name : chosen_) draft_.change_in_ui(name, std::nullopt);
    if (placed == 0) return;
    const auto snapped = [&](double sum) { return std::round(sum / placed / 10) * 10; };
    draft_.set({Unit::Kind::ui_node, made_.node, {}},
               Json(Json::Object{{"pos", Json::Array{snapped(x), snapped(y)}}}));
  }

  const Document& document_;
  const Registry& registry_;
  const CollapseOptions& options_;
  std::set<std::string> chosen_;
  EditDraft draft_;
  Collapsed made_;
  std::set<std::string> names_in_, names_out_;
  std::map<std::string, Inputs> graph_inputs_;                            // by published name
  std::map<std::pair<std::string, std::string>, std::string> input_of_;   // node, port -> published name
  std::map<std::pair<std::string, std::string>, std::string> output_of_;  // likewise
};

}  // namespace

Collapsed collapse(const Document& document, const Registry& registry, const std::vector<std::string>& names,
                   const CollapseOptions& options) {
  return Collapse(document, registry, names, options).make();
}

}  // namespace kinegraph
