// Compute for a node in a run: gives it what it declared and nothing else, and looks at what comes out.
#pragma once
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "graph/compute.h"
#include "graph/evaluate/file_store.h"
#include "graph/evaluate/memory_ledger.h"
#include "graph/evaluate/node_key.h"
#include "graph/evaluate/run_log.h"
#include "graph/evaluate/writes.h"
#include "graph/plan.h"

namespace kinegraph {

// What a node read differs from the digest in its key. A node can't keep it from the evaluator:
// `file_changed` stays.
class FileChanged : public std::exception {
 public:
  const char* what() const noexcept override { return "a file changed while it was read"; }
};

class NodeCompute final : public Compute, private FileAccess {
 public:
  struct World {
    const PlannedNode& node;
    const std::vector<NodeFile>& files;  // that it may read, with the digests in its key
    Work& work;
    FileStore& store;
    MemoryLedger& ledger;
    WriteRules& rules;
  };
  NodeCompute(World world, std::map<std::string, std::vector<ValuePtr>> inputs, std::set<std::string> wanted);

  const Params& params() const override { return params_; }
  Work& work() override { return world_.work; }
  FileAccess& files() override { return *this; }
  std::span<const ValuePtr> values(std::string_view port) const override;
  bool wanted(std::string_view output) const override;
  void set_output(std::string_view port, ValuePtr value) override;
  void write_file(std::string_view param, std::string_view bytes, std::string_view companion) override;
  void rule(std::string_view text, double value, double limit, bool passed) override;

  // After the node's function returned:
  std::map<std::string, ValuePtr>& outputs() { return outputs_; }
  std::vector<RuleRun>& rules() { return rules_; }
  StagedFiles& staged() { return staged_; }
  const NodeFile* file_changed() const { return changed_; }
  const std::string& undeclared() const {
    return undeclared_;
  }  // a path that it read although its key has none

 private:
  FileBytes read(const std::string& absolute_path) override;
  bool exists(const std::string& absolute_path) override;
  std::vector<std::string> list(const std::string& absolute_folder) override;

  World world_;
  Params params_;
  std::map<std::string, std::vector<ValuePtr>, std::less<>> inputs_;
  std::set<std::string, std::less<>> wanted_;
  std::map<std::string, ValuePtr> outputs_;
  std::vector<RuleRun> rules_;
  StagedFiles staged_;
  const NodeFile* changed_ = nullptr;
  std::string undeclared_;
};

}  // namespace kinegraph
