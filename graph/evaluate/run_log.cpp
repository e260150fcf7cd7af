#include "graph/evaluate/run_log.h"

namespace kinegraph {

const char* name_of(NodeState state) {
  switch (state) {
    case NodeState::done:
      return "done";
    case NodeState::failed:
      return "failed";
    case NodeState::blocked:
      return "blocked";
    case NodeState::cancelled:
      return "cancelled";
    case NodeState::skipped:
      return "skipped";
    case NodeState::disabled:
      return "disabled";
    case NodeState::missing:
      return "missing";
  }
  return "";
}

const char* name_of(Forecast forecast) {
  switch (forecast) {
    case Forecast::none:
      return "";
    case Forecast::hit:
      return "hit";
    case Forecast::run:
      return "run";
  }
  return "";
}

}  // namespace kinegraph
