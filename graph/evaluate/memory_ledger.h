// Keeps values and working memory together under one limit (--memory). Values count while anyone holds them:
// the run, the memory cache, or whoever asked for them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>

#include "graph/cache/memory_cache.h"

namespace kinegraph {

class MemoryLedger {
 public:
  // `cache` may be null; where room is needed, what only the cache holds goes first.
  explicit MemoryLedger(MemoryCache* cache);

  void limit_to(std::uint64_t bytes);  // 0 = half of the machine's memory
  // The value, counted until its last holder lets go. Throws Failure ("out-of-memory") where it has no room.
  ValuePtr hold(ValuePtr value);
  // Room for working memory, given back when the handle goes. Throws as hold().
  std::shared_ptr<void> reserve(std::size_t bytes);
  std::uint64_t used() const;

 private:
  struct Account;
  std::shared_ptr<Account> account_;  // shared with every value held, which may outlive the ledger
  void admit(std::size_t bytes, const char* what);
  MemoryCache* cache_;
};

}  // namespace kinegraph
