// Values by key, limited in bytes, least recently used out first. Thread-safe.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>

#include "graph/diagnostic.h"
#include "graph/key.h"
#include "graph/value.h"

namespace kinegraph {

// What is kept under an output's key: its value and the warnings of the run that made it (they belong to the
// key, so they name no node and no path).
struct Cached {
  ValuePtr value;  // null: the node has no such output (an analysis that can't give it)
  Diagnostics notes;
};

class MemoryCache {
 public:
  explicit MemoryCache(std::size_t limit_bytes);
  ~MemoryCache();
  std::optional<Cached> find(const Key& key);
  bool contains(const Key& key) const;  // without counting as a use
  // A value larger than the whole limit is not kept.
  void put(const Key& key, Cached entry);
  std::size_t bytes() const;
  void shrink_to(std::size_t bytes);
  // Drops values that nobody else holds, oldest use first, until `bytes` are free. Returns how many that
  // were.
  std::size_t free_up(std::size_t bytes);
  void clear();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
