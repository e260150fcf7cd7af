#include "graph/evaluate/stop.h"

#include "graph/diagnostic.h"

namespace kinegraph {

Halt::Halt(const StopToken* token, double timeout, std::chrono::steady_clock::time_point since)
    : token_(token) {
  using std::chrono::steady_clock;
  constexpr double longest = 1e9;  // seconds; a deadline further off than the clock reaches is none
  if (timeout > 0 && timeout <= longest)
    deadline_ =
        since + std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(timeout));
}

bool Halt::asked() const {
  if (late() || (token_ && token_->stopped())) return true;
  if (deadline_ == std::chrono::steady_clock::time_point::max()) return false;
  if (std::chrono::steady_clock::now() < deadline_) return false;
  late_.store(true, std::memory_order_relaxed);
  return true;
}

void Halt::check() const {
  if (asked()) throw Cancelled();
}

}  // namespace kinegraph
