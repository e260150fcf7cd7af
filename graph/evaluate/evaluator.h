// Runs a plan: lazily, each key once, independent nodes in parallel, with caches, progress, cancel and
// time-out.
#pragma once
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
#include "graph/evaluate/node_key.h"
#include "graph/evaluate/run_log.h"
#include "graph/evaluate/stop.h"
#include "graph/plan.h"

namespace kinegraph {

struct RunCallbacks {
  // From any thread, several at once: at most some 20 times a second a node ("running"), and at every change
  // of state
  // ("running" at 0, then the name of the state it ended in).
  std::function<void(const std::string& node, std::string_view state, double progress)> progress;
  // Once, before anything is computed: the nodes that are to be, as far as the caches tell.
  std::function<void(const std::vector<std::string>& nodes)> waiting = {};
};

class Evaluator {
 public:
  // The caches may be null (none). They, the files and the registry outlive the evaluator.
  Evaluator(const Registry& registry, FileStore& files, MemoryCache* memory, DiskCache* disk);
  ~Evaluator();

  // Blocking; call it from a thread that may wait. Each call may use its own plan; caches carry over. Of
  // several runs at once none computes what another is at: it waits and takes that from the memory cache, and
  // a run that is stopped while it waits sees so at wake(). Throws nothing that a node did: it is all in the
  // log. Targets that aren't there are errors in the log's diagnostics.
  RunLog run(const Plan& plan, const std::vector<Target>& targets, const RunOptions& options,
             const RunCallbacks& callbacks = {}, StopToken* stop = nullptr);

  // A value that the run begun last made and that a target asked for ("node.port"), or that the memory cache
  // still has; null where there is none.
  ValuePtr value(const Plan& plan, const std::string& node, const std::string& port) const;

  // The same for who asks about many nodes of a plan, of which the keys are made once, when it is made; and
  // whether the caches know a value at all. `check` is called now and then while files are hashed, and throws
  // to stop. The plan and the evaluator outlive it.
  class Known {
   public:
    Known(const Evaluator& evaluator, const Plan& plan, const std::vector<std::string>& nodes,
          std::function<void()> check = {});
    ValuePtr value(const std::string& node, const std::string& port) const;
    std::string cached(const std::string& node, const std::string& port) const;  // "memory", "disk", "no"

   private:
    std::optional<Key> key_of(const std::string& node, const std::string& port) const;

    const Evaluator& evaluator_;
    const Plan& plan_;
    NodeKeys keys_;
  };

  // What these targets will ask for that a run is computing just now, by the node's name in this plan: what
  // StopToken::stop_all_but() is to keep for them. `check` is called now and then, and throws to stop.
  std::map<std::string, Key> wanted_under_way(const Plan& plan, const std::vector<Target>& targets,
                                              const std::function<void()>& check) const;
  bool is_computing() const;
  void wake();

  struct Explained {
    Key key;
    bool has_key = false;
    std::vector<KeyPart> parts;
    std::string cached;  // "memory", "disk", "no"
    std::string why;     // in words
  };
  // `port` "" = the node's first output. Runs nothing; reads files only to hash them. Throws Failure
  // ("unknown-target", "absent-output").
  Explained explain(const Plan& plan, const std::string& node, const std::string& port);

  // The name of the CPU's code path that enters keys of node types that aren't the same on every CPU. By
  // default what the machine has.
  void set_cpu_path(std::string name);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
