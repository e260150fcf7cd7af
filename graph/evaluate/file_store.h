// Files as the evaluator sees them: only regular files, hashed as read, inside the sandbox when there is one.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "graph/compute.h"
#include "graph/key.h"

namespace kinegraph {

// Thread-safe. Paths are absolute.
class FileStore : public FileAccess {
 public:
  // `roots`: with a sandbox, the folders that may be read, links resolved; empty = everything.
  // `named`: files (or folders) set on the command line, allowed whatever the roots.
  explicit FileStore(std::vector<std::string> roots = {}, std::vector<std::string> named = {});
  ~FileStore() override;
  void allow(std::string absolute_path);  // one more named file

  FileBytes read(const std::string& absolute_path) override;
  bool exists(const std::string& absolute_path) override;  // and may be read
  std::vector<std::string> list(
      const std::string& absolute_folder) override;  // none where it may not be read

  struct Content {
    FileBytes bytes;
    Key digest;  // of these very bytes
  };
  // How a reading that belongs to a node tells of itself. All may be empty.
  struct Reading {
    std::string shown;            // how messages name the path
    std::function<void()> check;  // called every few megabytes; throws to stop
    std::function<std::shared_ptr<void>(std::size_t)>
        reserve;  // memory for that many bytes, kept with the content
  };
  Content read_hashed(const std::string& absolute_path, const Reading& reading);

  // Digest of the content; remembered by size, times and inode, which isn't trusted for a file younger than 2
  // s. Throws as read().
  Key digest_of(const std::string& absolute_path, const Reading& reading = {});
  // How many digests were computed by reading a file, ever. What is remembered costs none.
  std::uint64_t digests_made() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
