#include "graph/evaluate/under_way.h"

#include <utility>

namespace kinegraph {

bool UnderWay::begin(const Key& key, const std::function<std::function<void()>()>& later) {
  std::lock_guard lock(mutex_);
  const auto [at, fresh] = waiting_.try_emplace(key);
  if (!fresh)
    if (auto call = later()) at->second.push_back(std::move(call));
  return fresh;
}

void UnderWay::end(const Key& key) {
  std::vector<std::function<void()>> calls;
  {
    std::lock_guard lock(mutex_);
    const auto at = waiting_.find(key);
    if (at == waiting_.end()) return;
    calls = std::move(at->second);
    waiting_.erase(at);
  }
  for (const auto& call : calls) call();
}

void UnderWay::wake() {
  std::vector<std::function<void()>> calls;
  {
    std::lock_guard lock(mutex_);
    for (auto& [key, waiting] : waiting_)
      for (auto& call : std::exchange(waiting, {})) calls.push_back(std::move(call));
  }
  for (const auto& call : calls) call();
}

std::set<Key> UnderWay::keys() const {
  std::lock_guard lock(mutex_);
  std::set<Key> keys;
  for (const auto& [key, waiting] : waiting_) keys.insert(key);
  return keys;
}

}  // namespace kinegraph
