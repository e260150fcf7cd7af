// A request on its way through the evaluation, and what it gave. Known to evaluation*.cpp alone.
#pragma once
#include "graph/plan.h"
#include "gui/evaluation/evaluation.h"

namespace kinegraph {

struct Evaluation::Result {
  RunLog log;
  Diagnostics problems;
  std::map<std::string, ValuePtr> values;
  std::map<std::string, std::shared_ptr<const Still>> stills;
  std::map<std::string, Diagnostics> left_out;  // nodes with problems that keep them from running
  std::vector<std::string> outdated;            // failed before, changed since, and not run now
  bool effects = false;
  std::uint64_t generation = 0, graph = 0;
};

// A request on its way.
struct Evaluation::Run {
  EvaluationRequest request;
  Document whole;  // before nodes with problems are set aside
  Plan plan;
  std::vector<Target> targets;
  std::shared_ptr<Result> result = std::make_shared<Result>();
  StopToken stop;
  std::thread thread;
  std::set<std::string> joins;  // nodes that an older run is at

  // With the lock held:
  std::uint64_t generation = 0;      // for which it speaks
  bool aside = false;                // a newer run took its place
  std::set<std::string> speaks_for;  // then: nodes of the newer one that it is at
  bool over = false;
};

// What is known of nodes that nothing asked for.
struct Evaluation::Unasked {
  std::map<std::string, Diagnostics> lost;       // their file isn't there
  std::vector<std::string> found;                // it is there again
  std::set<std::string> able;                    // neither disabled nor of an unknown type
  std::map<std::string, std::string> blocked;    // see blocked_part.h
  std::map<std::string, std::string> stands_as;  // a Switch or a Dot, and the node whose value it passes on
};

// "running", "done", … as the evaluator calls them; what it doesn't name waits.
NodeStatus::State state_named(std::string_view name);

}  // namespace kinegraph
