// Values by key, limited in bytes, least recently used out first. Thread-safe.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>

#include "graph/diagnostic.h"
#include "graph/key.h"
#include "graph/value.h"

namespace kinegraph {

// What is kept under a node's key: one output's value and the warnings of the run that made it (they belong to the key).
struct Cached {
  ValuePtr value;  // null: the node has no such output (an analysis that can't give it)
  Diagnostics notes;
};

class MemoryCache {
 public:
  explicit MemoryCache(std::size_t limit_bytes);
  ~MemoryCache();
  std::optional<Cached> find(const Key& key);
  void put(const Key& key, Cached entry);
  std::size_t bytes() const;
  void shrink_to(std::size_t bytes);
  void clear();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
