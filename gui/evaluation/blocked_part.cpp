#include "gui/evaluation/blocked_part.h"

#include <optional>
#include <vector>

namespace kinegraph {
namespace {

class Search {
 public:
  Search(const Plan& plan, const std::set<std::string>& failed)
      : plan_(plan), failed_(failed), roots_(plan.nodes.size()) {}

  // The node that keeps this one from giving anything, itself where it is that; -1: nothing does. A plan has
  // no cycles, and is gone through without recursion: a graph may be one long chain.
  int root(int node) {
    std::vector<int> way{node};
    while (!way.empty()) {
      const int here = way.back();
      const PlannedNode& planned = plan_.nodes[std::size_t(here)];
      if (roots_[std::size_t(here)]) {
        way.pop_back();
        continue;
      }
      int found = planned.type ? -1 : here, open = -1;
      for (const auto& [port, sources] : planned.inputs)
        for (const Source& source : sources) {
          if (source.node < 0 || found >= 0 || open >= 0) continue;
          if (const auto& known = roots_[std::size_t(source.node)])
            found = *known;
          else
            open = source.node;
        }
      if (found < 0 && open >= 0) {
        way.push_back(open);
        continue;
      }
      const bool itself = found < 0 && (failed_.count(planned.name) || !planned.blocked.empty());
      roots_[std::size_t(here)] = itself ? here : found;
      way.pop_back();
    }
    return *roots_[std::size_t(node)];
  }

 private:
  const Plan& plan_;
  const std::set<std::string>& failed_;
  std::vector<std::optional<int>> roots_;
};

std::string seen_from(const std::string& node, const std::string& other) {
  const std::string graph = other.substr(0, other.find('/'));
  return node.starts_with(graph + "/") ? other : graph;
}

}  // namespace

std::map<std::string, std::string> blocked_part(const Plan& plan, const std::set<std::string>& failed) {
  Search search(plan, failed);
  std::map<std::string, std::string> blocked;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const PlannedNode& node = plan.nodes[i];
    if (!node.type || !node.enabled) continue;
    const int root = search.root(int(i));
    if (root >= 0 && root != int(i))
      blocked[node.name] = seen_from(node.name, plan.nodes[std::size_t(root)].name);
    else if (root == int(i) && !node.blocked.empty())
      blocked[node.name] = {};
  }
  return blocked;
}

}  // namespace kinegraph
