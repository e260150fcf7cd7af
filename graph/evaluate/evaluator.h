// Runs a plan: lazily, each key once, independent nodes in parallel, with caches, progress, cancel and time-out.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/cache/disk_cache.h"
#include "graph/cache/memory_cache.h"
#include "graph/evaluate/file_store.h"
#include "graph/plan.h"

namespace kinegraph {

// Asks a run to stop, from any thread or a signal handler.
class StopToken {
 public:
  void stop() { stopped_.store(true, std::memory_order_relaxed); }
  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> stopped_{false};
};

struct RunOptions {
  int threads = 0;              // 0 = as many as the machine has
  std::uint64_t memory = 0;     // bytes for values and working memory together; 0 = half of the machine's
  double timeout = 0;           // seconds; 0 = none
  bool keep_going = false;
  bool dry_run = false;         // compute no values, write nothing: tell hit or run
  bool allow_outside = false;   // writes outside `out`
  std::string out;              // absolute folder that writes must stay in
  std::vector<std::string> outside_allowed;  // absolute paths given by --set: may lie outside
};

enum class NodeState { done, failed, blocked, cancelled, skipped, disabled, missing };
const char* name_of(NodeState state);

struct OutputRun {
  std::string key;     // 32 hex digits; "" where it could not be made
  std::string cached;  // "memory", "disk" or "no"
  std::size_t bytes = 0;
  bool computed = false;  // asked for and there
};
struct NodeRun {
  std::string type;
  NodeState state = NodeState::skipped;  // skipped: nothing asked for it
  double seconds = 0;
  std::map<std::string, OutputRun> outputs;
  Diagnostics diagnostics;
};
struct RuleRun {
  std::string node, rule;
  double value, limit;  // NaN: could not be measured
  bool passed;
};
struct WrittenFile {
  std::string node, path;  // absolute
  std::uint64_t bytes;
  std::string content;     // shared with nobody; for the report's SHA-256, cleared by the caller
};
// What a run did, complete whatever happened. Names and order are the plan's.
struct RunLog {
  std::map<std::string, NodeRun> nodes;
  std::vector<RuleRun> rules;
  std::vector<WrittenFile> files;
  std::vector<std::string> planned_files;  // absolute paths that enabled Exports in the targets were to write
  Diagnostics diagnostics;                 // of no node: caches, two Exports on one file
  double seconds = 0;
  int threads_allowed = 1, threads_used = 1;
  bool timed_out = false, stopped = false, refused = false, write_failed = false;
};

struct Target {
  std::string node;
  std::string port;  // "" = the whole node (an Export, a Check, or all outputs)
};

struct RunCallbacks {
  // From any thread, at most some 20 times a second a node and at every change of state.
  std::function<void(const std::string& node, std::string_view state, double progress)> progress;
};

// What a key is made of, for `explain`.
struct KeyPart {
  std::string what;   // "type", "code version", "param omega", "input motion", "file"
  std::string value;
};

class Evaluator {
 public:
  // The caches may be null (none). They and the registry outlive the evaluator.
  Evaluator(const Registry& registry, FileStore& files, MemoryCache* memory, DiskCache* disk);
  ~Evaluator();

  // Blocking; call it from a thread that may wait. Each call may use its own plan; caches carry over.
  RunLog run(const Plan& plan, const std::vector<Target>& targets, const RunOptions& options,
             const RunCallbacks& callbacks = {}, StopToken* stop = nullptr);

  // Values that the last runs made and that a target asked for ("node.port"); null where there is none.
  ValuePtr value(const Plan& plan, const std::string& node, const std::string& port) const;

  struct Explained {
    Key key;
    std::vector<KeyPart> parts;
    std::string cached;  // "memory", "disk", "no"
    std::string why;     // in words
  };
  Explained explain(const Plan& plan, const std::string& node, const std::string& port);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
