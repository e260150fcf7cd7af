// Asking a run to stop: from outside, by the clock, or because something in it failed.
#pragma once
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>

#include "graph/key.h"

namespace kinegraph {

// Asks a run to stop, from any thread; stop() from a signal handler too.
class StopToken {
 public:
  void stop() { asked_.store(everything, std::memory_order_relaxed); }
  // Nothing begins any more, and of the nodes that are being computed those of these keys go on to their end.
  // May be said again, of fewer; stop() still stops all.
  void stop_all_but(std::set<Key> kept);
  bool stopped() const { return asked_.load(std::memory_order_relaxed) != nothing; }
  bool stopped(const Key& key) const;  // the node of that key

 private:
  enum Asked { nothing, all_but_kept, everything };
  std::atomic<int> asked_{nothing};
  mutable std::mutex mutex_;
  std::set<Key> kept_;
};

// One run's view of it: the token, if there is one, and the time-out. Asking is two atomic loads, and a look
// at the clock where there is a time-out: a thread that sleeps until then wakes too late on a busy machine.
class Halt {
 public:
  // `timeout` in seconds from `since`, 0 = none.
  Halt(const StopToken* token, double timeout,
       std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now());
  // The view of a node of the run, which may go on where the run doesn't. The run's outlives it.
  Halt(const Halt& run, const Key& node);
  Halt(const Halt&) = delete;
  Halt& operator=(const Halt&) = delete;

  bool asked() const;
  // As of when it was last asked, or a node's was.
  bool late() const { return (run_ ? run_->late_ : late_).load(std::memory_order_relaxed); }
  void check() const;  // throws Cancelled

 private:
  const StopToken* token_;
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  const Halt* run_ = nullptr;
  std::optional<Key> node_;
  mutable std::atomic<bool> late_{false};
};

}  // namespace kinegraph
