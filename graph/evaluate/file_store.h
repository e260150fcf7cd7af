// Files as the evaluator sees them: only regular files, hashed as read, inside the sandbox when there is one.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "graph/compute.h"
#include "graph/key.h"

namespace kinegraph {

class FileStore : public FileAccess {
 public:
  // `roots`: with a sandbox, the folders (absolute) that may be read, links resolved; empty = everything.
  // `named`: files set on the command line, allowed whatever the roots.
  FileStore(std::vector<std::string> roots = {}, std::vector<std::string> named = {});
  ~FileStore() override;
  FileBytes read(const std::string& absolute_path) override;
  bool exists(const std::string& absolute_path) override;
  std::vector<std::string> list(const std::string& absolute_folder) override;
  // Digest of the content; remembered by size, time and inode, which isn't trusted for a file younger than 2 s.
  Key digest_of(const std::string& absolute_path);
  void allow(std::string absolute_path);  // one more named file

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
