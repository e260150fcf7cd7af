// One run of the evaluator, from targets to log.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "graph/evaluate/evaluator.h"
#include "graph/evaluate/memory_ledger.h"
#include "graph/evaluate/under_way.h"

namespace kinegraph {

// What outlives a run and belongs to the evaluator.
struct RunWorld {
  const Registry& registry;
  FileStore& files;
  MemoryCache* memory;
  DiskCache* disk;
  MemoryLedger& ledger;
  UnderWay& under_way;
  std::string cpu_path;
};

// `kept` receives the values that targets asked for, by the key of the output.
RunLog run_plan(const RunWorld& world, const Plan& plan, const std::vector<Target>& targets,
                const RunOptions& options, const RunCallbacks& callbacks, const StopToken* stop,
                std::map<Key, ValuePtr>& kept);

}  // namespace kinegraph
