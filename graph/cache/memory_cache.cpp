#include "graph/cache/memory_cache.h"

#include <list>
#include <map>
#include <mutex>
#include <vector>

namespace kinegraph {

namespace {

std::size_t size_of(const Cached& entry) {
  std::size_t bytes = 128;  // the entry's own nodes
  if (entry.value) bytes += entry.value->bytes();
  for (const auto& note : entry.notes) bytes += sizeof(note) + note.message.size() + note.hint.size();
  return bytes;
}

}  // namespace

struct MemoryCache::State {
  struct Entry {
    Key key;
    Cached cached;
    std::size_t bytes;
  };
  using Entries = std::list<Entry>;

  mutable std::mutex mutex;
  std::size_t limit = 0;
  std::size_t bytes = 0;
  Entries by_use;  // newest first
  std::map<Key, Entries::iterator> by_key;

  // Values are destroyed after the lock is released: `dropped` outlives it.
  void drop(Entries::iterator entry, Entries& dropped) {
    bytes -= entry->bytes;
    by_key.erase(entry->key);
    dropped.splice(dropped.end(), by_use, entry);
  }
  void shrink(std::size_t to, Entries& dropped) {
    while (bytes > to && !by_use.empty()) drop(std::prev(by_use.end()), dropped);
  }
};

MemoryCache::MemoryCache(std::size_t limit_bytes) : state_(std::make_unique<State>()) {
  state_->limit = limit_bytes;
}
MemoryCache::~MemoryCache() = default;

std::optional<Cached> MemoryCache::find(const Key& key) {
  std::lock_guard lock(state_->mutex);
  auto found = state_->by_key.find(key);
  if (found == state_->by_key.end()) return std::nullopt;
  state_->by_use.splice(state_->by_use.begin(), state_->by_use, found->second);
  return found->second->cached;
}

bool MemoryCache::contains(const Key& key) const {
  std::lock_guard lock(state_->mutex);
  return state_->by_key.contains(key);
}

void MemoryCache::put(const Key& key, Cached entry) {
  const std::size_t bytes = size_of(entry);
  State::Entries dropped;
  std::lock_guard lock(state_->mutex);
  if (auto old = state_->by_key.find(key); old != state_->by_key.end()) state_->drop(old->second, dropped);
  if (bytes > state_->limit) return;
  state_->by_use.push_front({key, std::move(entry), bytes});
  state_->by_key[key] = state_->by_use.begin();
  state_->bytes += bytes;
  state_->shrink(state_->limit, dropped);
}

std::size_t MemoryCache::bytes() const {
  std::lock_guard lock(state_->mutex);
  return state_->bytes;
}

void MemoryCache::shrink_to(std::size_t bytes) {
  State::Entries dropped;
  std::lock_guard lock(state_->mutex);
  state_->shrink(bytes, dropped);
}

std::size_t MemoryCache::free_up(std::size_t bytes) {
  std::size_t freed = 0;
  State::Entries dropped;
  std::lock_guard lock(state_->mutex);
  auto entry = state_->by_use.end();
  while (freed < bytes && entry != state_->by_use.begin()) {
    auto candidate = std::prev(entry);
    if (candidate->cached.value && candidate->cached.value.use_count() == 1) {
      freed += candidate->bytes;
      state_->drop(candidate, dropped);
    } else {
      entry = candidate;
    }
  }
  return freed;
}

void MemoryCache::clear() {
  shrink_to(0);
}

}  // namespace kinegraph
