// What is asked of a run, and what it tells of itself afterwards.
#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "graph/diagnostic.h"

namespace kinegraph {

struct Target {
  std::string node;
  std::string port;  // "" = the whole node: an Export, a Check, or all outputs
};

struct RunOptions {
  int threads = 0;           // 0 = as many as the machine has
  std::uint64_t memory = 0;  // bytes for values and working memory together; 0 = half of the machine's
  double timeout = 0;        // seconds from `since`; 0 = none
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
  bool keep_going = false;                   // what does not depend on a failure still runs
  bool dry_run = false;                      // compute no values, write nothing: tell hit or run
  bool allow_outside = false;                // writes outside `out`
  std::string out;                           // absolute folder that writes must stay in
  std::vector<std::string> outside_allowed;  // absolute paths given by --set: may lie outside
};

enum class NodeState {
  done,
  failed,
  blocked,    // something it needs failed, is missing or absent
  cancelled,  // needed, but stopped, timed out, or not begun when another failed
  skipped,    // nothing asked for it
  disabled,
  missing,  // of an unknown type or newer version
};
const char* name_of(NodeState state);

struct OutputRun {
  std::string key;     // 32 hex digits; "" where it could not be made
  std::string cached;  // "memory", "disk" or "no"
  std::size_t bytes = 0;
  bool computed = false;  // asked for and there
};

enum class Forecast { none, hit, run };  // of a dry run
const char* name_of(Forecast forecast);  // "", "hit", "run"

struct NodeRun {
  std::string type;
  NodeState state = NodeState::skipped;
  Forecast forecast = Forecast::none;
  double seconds = 0;  // of its own computing
  std::string key;     // of the node as a whole, also where it has no outputs; "" where it could not be made
  std::map<std::string, OutputRun> outputs;  // those that were asked for
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
  std::string content;  // shared with nobody; for the report's SHA-256, cleared by the caller
};

// What a run did, complete whatever happened.
struct RunLog {
  std::map<std::string, NodeRun> nodes;    // every node of the plan
  std::vector<RuleRun> rules;              // in the plan's order of nodes
  std::vector<WrittenFile> files;          // likewise
  std::vector<std::string> planned_files;  // absolute paths that enabled Exports in the targets were to write
  Diagnostics diagnostics;                 // of no node: caches, two Exports on one file
  double seconds = 0;
  int threads_allowed = 1;
  int threads_used = 1;       // that ran a node or a piece of a node's loop
  bool timed_out = false;     // before everything was done
  bool stopped = false;       // likewise
  bool refused = false;       // a write is against the rules
  bool write_failed = false;  // a write was allowed and failed
  bool missing = false;       // a missing node stood in a target's way
};

}  // namespace kinegraph
