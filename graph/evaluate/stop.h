// Asking a run to stop: from outside, by the clock, or because something in it failed.
#pragma once
#include <atomic>
#include <chrono>

namespace kinegraph {

// Asks a run to stop, from any thread or a signal handler.
class StopToken {
 public:
  void stop() { stopped_.store(true, std::memory_order_relaxed); }
  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> stopped_{false};
};

// One run's view of it: the token, if there is one, and the time-out. Asking is two atomic loads, and a look
// at the clock where there is a time-out: a thread that sleeps until then wakes too late on a busy machine.
class Halt {
 public:
  // `timeout` in seconds from `since`, 0 = none.
  Halt(const StopToken* token, double timeout,
       std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now());
  Halt(const Halt&) = delete;
  Halt& operator=(const Halt&) = delete;

  bool asked() const;
  bool late() const { return late_.load(std::memory_order_relaxed); }  // as of when it was last asked
  void check() const;                                                  // throws Cancelled

 private:
  const StopToken* token_;
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  mutable std::atomic<bool> late_{false};
};

}  // namespace kinegraph
