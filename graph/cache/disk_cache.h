// Values by key in a folder that many processes share: content-addressed, checksummed, written aside and
// renamed.
//
// FOLDER/ab/abcdef….kgv holds one output: magic, format version, a checksum of all that follows, the key
// itself, the value's type, the notes, and the encoded value compressed with zstd. A use renews the file's
// time, so that the oldest use goes out first. FOLDER/ab/….tmp is being written, or was left by a killed
// writer. FOLDER/claims is empty and carries locks (see claim.h).
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "graph/cache/claim.h"
#include "graph/cache/memory_cache.h"
#include "graph/registry.h"

namespace kinegraph {

class DiskCache {
 public:
  // limit_bytes 0 = none. The folder is made on the first write. Nothing here ever fails a run: what goes
  // wrong is kept as a warning ("cache-damaged", "cache-full", "cache-unwritable", "cache-unreadable") for
  // `take_warnings`. The registry outlives the cache. Thread-safe.
  DiskCache(std::string folder, std::uint64_t limit_bytes, const Registry& registry);
  ~DiskCache();

  // Asked every few megabytes: true gives up, as a miss or without writing, and without a warning.
  using GiveUp = std::function<bool()>;
  std::optional<Cached> find(const Key& key, const GiveUp& give_up = {});  // damaged or unreadable: a miss
  bool contains(const Key& key) const;  // by existence only, for --dry-run and explain
  void put(const Key& key, const Cached& entry, const GiveUp& give_up = {});
  // Before a node's outputs are computed: waits until nobody else is at work on them. They may be there then.
  std::unique_ptr<Claim> claim(const Key& node_key, const GiveUp& give_up);
  Diagnostics take_warnings();  // one of each code since the last call
  const std::string& folder() const;

  struct Stat {
    std::uint64_t entries = 0;
    std::uint64_t bytes = 0;  // of entries and leftovers
    std::uint64_t damaged = 0;
    std::uint64_t leftovers = 0;  // of killed writers, and of those at work
  };
  static Stat stat(const std::string& folder);
  // Reads every entry and checks its checksum; `damaged` gets the path of each that fails.
  static Stat verify(const std::string& folder, const std::function<void(std::string)>& damaged);
  // Removes entries, oldest use first, until limit_bytes hold (0 = any size), and leftovers older than
  // `leftover_age` seconds. Returns what is left.
  static Stat collect(const std::string& folder, std::uint64_t limit_bytes, double leftover_age = 3600);
  // Removes entries and leftovers; files that aren't the cache's own stay. Returns what was removed.
  static Stat clear(const std::string& folder);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
