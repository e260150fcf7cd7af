// Asking a run to stop: from outside, by the clock, or because something in it failed.
#pragma once
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace kinegraph {

// Asks a run to stop, from any thread or a signal handler.
class StopToken {
 public:
  void stop() { stopped_.store(true, std::memory_order_relaxed); }
  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> stopped_{false};
};

// One run's view of it: the token, if there is one, and the time-out. Asking is two atomic loads.
class Halt {
 public:
  // `timeout` in seconds, 0 = none.
  Halt(const StopToken* token, double timeout);
  ~Halt();
  Halt(const Halt&) = delete;
  Halt& operator=(const Halt&) = delete;

  bool asked() const { return late_.load(std::memory_order_relaxed) || (token_ && token_->stopped()); }
  bool late() const { return late_.load(std::memory_order_relaxed); }
  void check() const;  // throws Cancelled

 private:
  const StopToken* token_;
  std::atomic<bool> late_{false};
  std::mutex mutex_;
  std::condition_variable finished_;
  bool over_ = false;
  std::thread watch_;
};

}  // namespace kinegraph
