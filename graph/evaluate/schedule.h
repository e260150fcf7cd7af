// The order in which a run's nodes are looked up and computed, on the run's threads.
//
// A node that is needed is first looked up in the caches; on a miss it asks for its inputs, and the last of
// them to come starts it. No thread ever waits for a node: what waits is a number that counts down. Nodes of
// one key are computed once; the others of that key take what the first one made, and so do other runs of the
// same evaluator.
#pragma once
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "graph/evaluate/compute_node.h"
#include "graph/evaluate/demand.h"
#include "graph/evaluate/run.h"

namespace kinegraph {

class Schedule {
 public:
  Schedule(const RunWorld& world, const Plan& plan, NodeKeys& keys, Demands& demands, WriteRules& rules,
           const Halt& halt, const RunOptions& options, const RunCallbacks& callbacks, int threads);

  // Runs what is needed, until all of it is finished or something stops it.
  void go();
  // A node that is known to fail before anything runs.
  void fail(int node, Diagnostic why);
  // Names the state of everything that was needed and did not finish.
  void close();

  struct Outcome {
    NodeState state = NodeState::skipped;
    double seconds = 0;
    std::map<std::string, OutputRun> outputs;
    Diagnostics diagnostics;
    std::vector<RuleRun> rules;
    std::vector<WrittenFile> files;
  };
  Outcome& outcome(int node) { return at(node).outcome; }
  const std::map<std::string, Given>& outputs(int node) { return at(node).outputs; }
  int threads_used() const { return used_.count(); }
  Diagnostics& problems() { return problems_; }  // of the machinery itself

 private:
  enum class Phase { idle, looking, waiting, computing, finished };
  struct Task {
    Phase phase = Phase::idle;
    int waiting_for = 0;          // inputs that haven't come
    std::vector<int> dependents;  // whose waiting_for this one lowers
    int users = 0;                // links from tasks that haven't finished; at 0 its values are let go
    bool uses_inputs = false;     // counted among the users of its inputs
    std::optional<Key> twin;      // the key under which it is counted in twins_
    std::map<std::string, Given> outputs;
    Diagnostics notes;
    bool restarted = false;  // because a file changed
    bool alone = false;      // because memory was short while others ran
    Outcome outcome;
  };
  // All tasks of one key: what the first of them made is kept until the last has taken it.
  struct Twins {
    int left = 0;
    bool running = false;
    std::vector<int> waiting;
    std::set<std::string> wanted;
    std::map<std::string, Given> outputs;
    Diagnostics notes;
    std::optional<Diagnostic> failure;
  };
  using Step = void (Schedule::*)(int);

  Task& at(int node) { return tasks_[static_cast<std::size_t>(node)]; }
  Demand& demand_of(int node) { return demands_.nodes[static_cast<std::size_t>(node)]; }
  const PlannedNode& planned(int node) const { return plan_.nodes[static_cast<std::size_t>(node)]; }
  bool stopping() const { return halt_.asked() || stop_new_.load(std::memory_order_relaxed); }

  void spawn(Step step, int node);
  std::function<void()> come_back_to(int node);
  void run_step(Step step, int node);
  void look(int node);
  void compute(int node);
  void compute_effect(int node, std::map<std::string, std::vector<ValuePtr>> inputs);
  void compute_claimed(int node, const Key& key, std::map<std::string, std::vector<ValuePtr>> inputs,
                       std::set<std::string> wanted);
  Attempt attempt(int node, const Halt& halt, std::map<std::string, std::vector<ValuePtr>> inputs,
                  const std::set<std::string>& wanted);
  bool find_cached(int node);
  bool made_elsewhere(int node, const Key& key, const std::set<std::string>& wanted);
  bool find_one(int node, const Key& node_key, const std::string& port);
  bool try_later(Step step, int node, const Diagnostic& failure, int finished_before);
  // Nothing where the node can't be computed and has been finished.
  std::optional<std::map<std::string, std::vector<ValuePtr>>> gather_inputs(int node);
  ValuePtr arriving(int node, const InputPort& port, const Source& source);
  std::optional<Diagnostic> blocked_by(int node);

  void complete(int node);  // its outputs are there
  void finish(int node, NodeState state, std::optional<Diagnostic> why = {});
  void tell(int node, const char* state, double progress);

  // With the lock held:
  void ask(int source, const std::string& port, int for_node);
  void use_inputs(int node);
  void let_go(int node);  // of its inputs, and of those that nobody then needs
  void join_twins(int node, const Key& key);
  void leave_twins(int node);

  const RunWorld& world_;
  const Plan& plan_;
  NodeKeys& keys_;
  Demands& demands_;
  WriteRules& rules_;
  const Halt& halt_;
  const RunOptions& options_;
  const RunCallbacks& callbacks_;
  const int threads_;
  ThreadsUsed used_;

  std::mutex mutex_;
  std::vector<Task> tasks_;
  std::map<Key, Twins> twins_;
  std::vector<std::pair<Step, int>> starved_;  // to be tried again when nothing else runs
  int finished_ = 0;
  Diagnostics problems_;
  std::atomic<int> active_{0};
  std::atomic<bool> stop_new_{false};
  std::atomic<bool> rekeyed_{false};  // a file changed, so keys after it have to be made again
  tbb::task_arena* arena_ = nullptr;
  tbb::task_group* group_ = nullptr;
};

}  // namespace kinegraph
