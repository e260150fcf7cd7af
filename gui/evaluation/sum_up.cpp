#include "gui/evaluation/sum_up.h"

namespace kinegraph {
namespace {

int rank(NodeStatus::State state) {
  using State = NodeStatus::State;
  switch (state) {
    case State::failed:
      return 5;
    case State::running:
      return 4;
    case State::missing:
    case State::incomplete:
    case State::blocked:
      return 3;
    case State::waiting:
      return 2;
    case State::done:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

void sum_up(std::map<std::string, NodeStatus>& statuses, const std::string& graph) {
  const std::string inside = graph + "/";
  auto at = statuses.lower_bound(inside);
  if (at == statuses.end() || !at->first.starts_with(inside)) return;
  NodeStatus sum = at->second;
  for (++at; at != statuses.end() && at->first.starts_with(inside); ++at) {
    const NodeStatus& status = at->second;
    if (rank(status.state) > rank(sum.state)) {
      sum.state = status.state;
      sum.progress = status.progress;
      sum.blocked_by = status.blocked_by;
    }
    sum.seconds += status.seconds;
    if (status.cached == "no") sum.cached = "no";
    sum.diagnostics.insert(sum.diagnostics.end(), status.diagnostics.begin(), status.diagnostics.end());
  }
  NodeStatus& own = statuses[graph];
  sum.still = own.still;
  own = std::move(sum);
}

}  // namespace kinegraph
