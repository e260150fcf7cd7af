#include "graph/evaluate/stop.h"

#include <chrono>

#include "graph/diagnostic.h"

namespace kinegraph {

Halt::Halt(const StopToken* token, double timeout) : token_(token) {
  constexpr double longest = 1e9;  // seconds; a deadline further off than the clock reaches is none
  if (!(timeout > 0) || timeout > longest) return;
  const auto deadline =
      std::chrono::steady_clock::now() +
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(timeout));
  watch_ = std::thread([this, deadline] {
    std::unique_lock lock(mutex_);
    if (!finished_.wait_until(lock, deadline, [this] { return over_; })) {
      late_.store(true, std::memory_order_relaxed);
    }
  });
}

Halt::~Halt() {
  if (!watch_.joinable()) return;
  {
    std::lock_guard lock(mutex_);
    over_ = true;
  }
  finished_.notify_all();
  watch_.join();
}

void Halt::check() const {
  if (asked()) throw Cancelled();
}

}  // namespace kinegraph
