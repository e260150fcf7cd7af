#include "graph/evaluate/demand.h"

#include <algorithm>

#include "graph/evaluate/node_work.h"

namespace kinegraph {

namespace {

class Reach {
 public:
  Reach(const Plan& plan, Demands& demands) : plan_(plan), demands_(demands) {}

  void target(const Target& target) {
    const auto passed = plan_.passed.find(target.node);
    const auto planned = plan_.by_name.find(target.node);
    if (passed == plan_.passed.end() && planned == plan_.by_name.end()) {
      std::vector<std::string> names;
      for (const auto& [name, index] : plan_.by_name) names.push_back(name);
      for (const auto& [name, ports] : plan_.passed) names.push_back(name);
      return complain(error("unknown-target", "there is no node '" + target.node + "'")
                          .hinting(suggestion(target.node, names)));
    }
    if (!target.port.empty()) return output(target);
    if (passed != plan_.passed.end()) {
      for (const auto& [port, source] : passed->second) give(source, target.node + "." + port, false);
      return;
    }
    const auto* type = node(planned->second).type;
    if (type && type->effect != Effect::none && target.node.find('/') != std::string::npos) {
      return complain(error("nested-effect", "'" + target.node + "' lies inside a nested file, where " +
                                                 type->name + " doesn't run")
                          .at_node(target.node)
                          .hinting("put it beside the Graph node, or run the nested file itself"));
    }
    auto& demand = at(planned->second);
    demand.target = true;
    roots_.push_back(planned->second);
    if (type)
      for (const auto& port : type->outputs) demand.wanted.insert(port.name);
  }

  const std::vector<int>& roots() const { return roots_; }

 private:
  Demand& at(int index) { return demands_.nodes[static_cast<std::size_t>(index)]; }
  const PlannedNode& node(int index) const { return plan_.nodes[static_cast<std::size_t>(index)]; }
  void complain(Diagnostic problem) { demands_.problems.push_back(std::move(problem)); }

  void output(const Target& target) {
    const auto source = plan_.find_output(target.node, target.port);
    const std::string name = target.node + "." + target.port;
    if (!source) {
      return complain(error("absent-output", "nothing comes out of '" + name + "'")
                          .at_node(target.node)
                          .at_port(target.port)
                          .hinting("it stands for nothing while nodes before it are disabled or open"));
    }
    if (source->node >= 0) {
      const auto* type = node(source->node).type;
      if (type && !type->find_output(source->port)) {
        return complain(error("unknown-target", "'" + target.node + "' has no output '" + target.port + "'")
                            .at_node(target.node)
                            .hinting(suggestion(source->port, type->output_names())));
      }
    }
    give(*source, name, true);
  }

  void give(const Source& source, const std::string& name, bool must) {
    if (source.node < 0) {
      demands_.constants[name] = source.constant;
      return;
    }
    auto& demand = at(source.node);
    demand.target = true;
    demand.wanted.insert(source.port);
    if (must) demand.asked.insert(source.port);
    roots_.push_back(source.node);
  }

  const Plan& plan_;
  Demands& demands_;
  std::vector<int> roots_;
};

}  // namespace

void merge_notes(Diagnostics& into, const Diagnostics& notes) {
  for (const auto& note : notes) {
    const bool known =
        std::any_of(into.begin(), into.end(), [&](const auto& other) { return same(other, note); });
    if (!known) into.push_back(note);
  }
}

Demands reached_by(const Plan& plan, const std::vector<Target>& targets) {
  Demands demands;
  demands.nodes.resize(plan.nodes.size());
  Reach reach(plan, demands);
  for (const auto& target : targets) reach.target(target);
  demands.order = in_order(plan, reach.roots());
  for (int index : demands.order) demands.nodes[static_cast<std::size_t>(index)].reached = true;
  return demands;
}

void demand(const Plan& plan, const NodeKeys& keys, MemoryCache* memory, const DiskCache* disk,
            Demands& demands) {
  // Against the order every node is looked at after all that could want something of it.
  for (auto at = demands.order.rbegin(); at != demands.order.rend(); ++at) {
    const auto& node = plan.nodes[static_cast<std::size_t>(*at)];
    auto& here = demands.nodes[static_cast<std::size_t>(*at)];
    here.needed = here.target || here.users > 0;
    if (!here.needed || !node.type || !node.enabled || !node.blocked.empty()) continue;
    const auto& key = keys.of(*at).key;
    if (key && node.type->effect == Effect::none) {
      here.hit = true;
      for (const auto& port : here.wanted) {
        const Key output = output_key(*key, port);
        auto cached = memory ? memory->find(output) : std::nullopt;
        if (cached) {
          here.found[port] = {output, std::move(cached->value), "memory", {}};
          merge_notes(here.notes, cached->notes);
        } else if (!disk || !disk->contains(output)) {
          here.hit = false;
        }
      }
    }
    here.runs = !here.hit;
    if (here.hit) continue;
    for (const auto& [port, sources] : node.inputs) {
      for (const auto& source : sources) {
        if (source.node < 0) continue;
        auto& before = demands.nodes[static_cast<std::size_t>(source.node)];
        before.wanted.insert(source.port);
        ++before.users;
      }
    }
  }
}

}  // namespace kinegraph
