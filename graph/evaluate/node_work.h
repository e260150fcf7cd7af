// Work for a node in a run: stops when the run does, tells progress now and then, and has the run's threads.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "graph/evaluate/memory_ledger.h"
#include "graph/evaluate/stop.h"
#include "graph/work.h"

namespace kinegraph {

// Which of the run's threads did some of its work.
class ThreadsUsed {
 public:
  explicit ThreadsUsed(int allowed) : slots_(static_cast<std::size_t>(allowed)) {}
  void mark();  // the calling thread
  int count() const;

 private:
  std::vector<std::atomic<bool>> slots_;  // by the thread's place in the run's arena
};

class NodeWork : public Work {
 public:
  // `show` gets the progress at most 20 times a second, from any thread; may be empty.
  NodeWork(const Halt& halt, MemoryLedger& ledger, ThreadsUsed& used, std::function<void(double)> show);

  void check() override { halt_.check(); }
  void progress(double fraction) override;
  void report(Diagnostic diagnostic) override;
  void parallel(std::size_t count, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& body) override;
  std::shared_ptr<void> reserve(std::size_t bytes) override { return ledger_.reserve(bytes); }

  // What was reported, in an order that doesn't depend on threads.
  Diagnostics reported() const;

 private:
  const Halt& halt_;
  MemoryLedger& ledger_;
  ThreadsUsed& used_;
  std::function<void(double)> show_;
  std::atomic<std::int64_t> shown_at_;  // steady clock, ns
  mutable std::mutex mutex_;
  Diagnostics reported_;
};

bool same(const Diagnostic& a, const Diagnostic& b);    // in everything but the node
bool before(const Diagnostic& a, const Diagnostic& b);  // a total order, for lists that threads fill

}  // namespace kinegraph
