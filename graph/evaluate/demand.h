// What a run needs: from its targets back through the plan, stopping where a cache already has the answer.
#pragma once
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "graph/cache/disk_cache.h"
#include "graph/cache/memory_cache.h"
#include "graph/evaluate/node_key.h"
#include "graph/evaluate/run_log.h"
#include "graph/plan.h"

namespace kinegraph {

// A node's output as the run has it.
struct Given {
  Key key;
  ValuePtr value;  // null: the node has no such output
  const char* cached = "no";
  std::map<std::string, ValuePtr> converted;  // by type, made when first asked for
};

struct Demand {
  bool reached = false;                // a target depends on it, whatever the caches hold
  bool needed = false;                 // something will ask for it
  bool target = false;                 // a target itself: the whole node, or the ports asked for
  bool hit = false;                    // every output wanted is in a cache
  bool runs = false;                   // needed, no hit, and nothing known stands in its way
  std::set<std::string> wanted;        // outputs that someone needs
  std::set<std::string> asked;         // those that targets name, which must be there
  int users = 0;                       // links from nodes that will run
  std::map<std::string, Given> found;  // already in memory
  Diagnostics notes;                   // of those
};

struct Demands {
  std::vector<Demand> nodes;                  // as Plan::nodes
  std::vector<int> order;                     // those reached, each after what it depends on
  Diagnostics problems;                       // of targets: "unknown-target", "absent-output", "nested-effect"
  std::map<std::string, ValuePtr> constants;  // targets that a constant stands for: "node.port"
};

// Which nodes the targets are, and what they depend on.
Demands reached_by(const Plan& plan, const std::vector<Target>& targets);
// Fills in `needed`, `wanted`, `hit`, `found` and `users`; keys are made. The caches may be null.
void demand(const Plan& plan, const NodeKeys& keys, MemoryCache* memory, const DiskCache* disk,
            Demands& demands);

// Adds the notes that aren't among them yet.
void merge_notes(Diagnostics& into, const Diagnostics& notes);

}  // namespace kinegraph
