// Writing files: where a run may write, that no two nodes write one file, and that a file is there whole or
// not at all.
#pragma once
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/evaluate/run_log.h"

namespace kinegraph {

// The run's rules. Failures: "write-outside", "shared-file", "writes-onto-input", "writes-onto-graph".
class WriteRules {
 public:
  explicit WriteRules(const RunOptions& options);

  void reads(const std::string& path);     // a file that this run reads
  void is_graph(const std::string& path);  // a graph file; whatever ends .kg.json is one too
  // The file that `path` leads to, links resolved, taken for `node`. Throws Failure where that may not be
  // written. `of`: the save_file path it belongs to (itself, or for a companion the file it stands beside).
  // Thread-safe.
  std::string take(const std::string& node, const std::string& path, const std::string& of);

 private:
  bool inside(const std::string& real, const std::string& path, const std::string& of) const;

  bool allow_outside_;
  std::string out_;                        // links resolved
  std::set<std::string> outside_allowed_;  // as given, and links resolved
  std::mutex mutex_;
  std::set<std::string> reads_, graphs_;
  std::map<std::string, std::string> taken_;  // file -> node
};
bool is_refusal(const Diagnostic& diagnostic);  // one of the above

// Files of one node, written aside as they come and put in place together; what was not put in place is
// removed. Failures: "cannot-write", and "write-outside" where a folder turns out to be a link.
class StagedFiles {
 public:
  StagedFiles() = default;
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  // `file` is what WriteRules::take gave. Makes missing folders. `check` is called once a megabyte, and
  // throws to stop.
  void add(const std::string& file, std::string_view bytes, const std::function<void()>& check);
  void put_in_place();
  struct Staged {
    int folder;         // open descriptor
    std::string aside;  // name in it
    std::string name;
    std::string path;
    std::string content;
    bool placed;
  };
  std::vector<Staged>& files() { return files_; }

 private:
  std::vector<Staged> files_;
};

}  // namespace kinegraph
