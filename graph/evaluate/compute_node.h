// One attempt at computing one node, whatever it throws.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "graph/evaluate/node_compute.h"
#include "graph/evaluate/node_work.h"

namespace kinegraph {

struct Attempt {
  enum class End { done, failed, cancelled, file_changed };
  End end = End::done;
  std::map<std::string, ValuePtr> outputs;  // every wanted one is there, null where the node has none
  Diagnostics notes;                        // without paths and node names, as they are kept
  std::optional<Diagnostic> failure;        // where it failed, or which file changed
  std::vector<RuleRun> rules;
  std::vector<WrittenFile> files;
  double seconds = 0;
};

Attempt compute_node(const NodeCompute::World& world, NodeWork& work, const Halt& halt,
                     std::map<std::string, std::vector<ValuePtr>> inputs,
                     const std::set<std::string>& wanted);

}  // namespace kinegraph
