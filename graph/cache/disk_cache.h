// Values by key in a folder that many processes share: content-addressed, checksummed, written aside and renamed.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "graph/cache/memory_cache.h"
#include "graph/registry.h"

namespace kinegraph {

class DiskCache {
 public:
  // limit_bytes 0 = none. The folder is made on the first write. Warnings ("cache-damaged", "cache-full",
  // "cache-unwritable") go to `warn`, each once a run; nothing here ever fails a run.
  DiskCache(std::string folder, std::uint64_t limit_bytes, const Registry& registry,
            std::function<void(Diagnostic)> warn);
  std::optional<Cached> find(const Key& key);  // a damaged or unreadable entry is a miss with a warning
  bool contains(const Key& key) const;         // by existence only, for --dry-run and explain
  void put(const Key& key, const Cached& entry);

  struct Stat { std::uint64_t entries = 0, bytes = 0, damaged = 0, leftovers = 0; };
  static Stat stat(const std::string& folder);
  static Stat verify(const std::string& folder, const std::function<void(std::string)>& damaged);  // reads every entry
  static Stat collect(const std::string& folder, std::uint64_t limit_bytes);  // oldest use out first; removes leftovers of killed writers
  static Stat clear(const std::string& folder);

 private:
  std::string folder_;
  std::uint64_t limit_;
  const Registry& registry_;
  std::function<void(Diagnostic)> warn_;
};

}  // namespace kinegraph
