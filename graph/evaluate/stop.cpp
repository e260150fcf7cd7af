#include "graph/evaluate/stop.h"

#include <utility>

#include "graph/diagnostic.h"

namespace kinegraph {

void StopToken::stop_all_but(std::set<Key> kept) {
  std::lock_guard lock(mutex_);
  kept_ = std::move(kept);
  int none = nothing;
  asked_.compare_exchange_strong(none, all_but_kept, std::memory_order_relaxed);
}

bool StopToken::stopped(const Key& key) const {
  const int asked = asked_.load(std::memory_order_relaxed);
  if (asked != all_but_kept) return asked == everything;
  std::lock_guard lock(mutex_);
  return !kept_.contains(key);
}

Halt::Halt(const StopToken* token, double timeout, std::chrono::steady_clock::time_point since)
    : token_(token) {
  using std::chrono::steady_clock;
  constexpr double longest = 1e9;  // seconds; a deadline further off than the clock reaches is none
  if (timeout > 0 && timeout <= longest)
    deadline_ =
        since + std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(timeout));
}

Halt::Halt(const Halt& run, const Key& node)
    : token_(run.token_), deadline_(run.deadline_), run_(&run), node_(node) {}

bool Halt::asked() const {
  if (late() || (token_ && (node_ ? token_->stopped(*node_) : token_->stopped()))) return true;
  if (deadline_ == std::chrono::steady_clock::time_point::max()) return false;
  if (std::chrono::steady_clock::now() < deadline_) return false;
  (run_ ? run_->late_ : late_).store(true, std::memory_order_relaxed);
  return true;
}

void Halt::check() const {
  if (asked()) throw Cancelled();
}

}  // namespace kinegraph
