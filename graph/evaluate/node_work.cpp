#include "graph/evaluate/node_work.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <tuple>

namespace kinegraph {

namespace {

constexpr std::int64_t show_every = 50'000'000;  // ns

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

auto everything(const Diagnostic& d) {
  return std::tie(d.file, d.place.line, d.place.column, d.port, d.param, d.code, d.joint, d.frame, d.message,
                  d.hint, d.severity);
}

}  // namespace

bool same(const Diagnostic& a, const Diagnostic& b) {
  return everything(a) == everything(b);
}
bool before(const Diagnostic& a, const Diagnostic& b) {
  return everything(a) < everything(b);
}

void ThreadsUsed::mark() {
  const int slot = tbb::this_task_arena::current_thread_index();
  if (slot >= 0 && static_cast<std::size_t>(slot) < slots_.size()) {
    slots_[static_cast<std::size_t>(slot)].store(true, std::memory_order_relaxed);
  }
}

int ThreadsUsed::count() const {
  return static_cast<int>(
      std::count_if(slots_.begin(), slots_.end(), [](const auto& slot) { return slot.load(); }));
}

NodeWork::NodeWork(const Halt& halt, MemoryLedger& ledger, ThreadsUsed& used,
                   std::function<void(double)> show)
    : halt_(halt), ledger_(ledger), used_(used), show_(std::move(show)), shown_at_(now()) {}

void NodeWork::progress(double fraction) {
  check();
  if (!show_) return;
  auto last = shown_at_.load(std::memory_order_relaxed);
  const auto time = now();
  if (time - last < show_every || !shown_at_.compare_exchange_strong(last, time)) return;
  show_(std::clamp(fraction, 0.0, 1.0));
}

void NodeWork::report(Diagnostic diagnostic) {
  std::lock_guard lock(mutex_);
  reported_.push_back(std::move(diagnostic));
}

Diagnostics NodeWork::reported() const {
  std::lock_guard lock(mutex_);
  auto sorted = reported_;
  std::stable_sort(sorted.begin(), sorted.end(), before);
  return sorted;
}

// Pieces have the same bounds whatever the threads, and of several exceptions the one of the first piece is
// thrown: all pieces before it have been tried. So a failure says the same for any number of threads.
void NodeWork::parallel(std::size_t count, std::size_t grain,
                        const std::function<void(std::size_t, std::size_t)>& body) {
  check();
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t pieces = count / grain + (count % grain != 0);
  std::atomic<std::size_t> first_bad{std::numeric_limits<std::size_t>::max()};
  std::exception_ptr bad;
  std::mutex bad_mutex;
  const auto run = [&](std::size_t piece) {
    if (piece > first_bad.load(std::memory_order_relaxed)) return;
    try {
      check();
      const std::size_t begin = piece * grain;
      body(begin, begin + std::min(grain, count - begin));
    } catch (...) {
      std::lock_guard lock(bad_mutex);
      if (piece < first_bad.load()) {
        first_bad = piece;
        bad = std::current_exception();
      }
    }
  };
  if (pieces <= 1) {
    if (pieces == 1) run(0);
  } else {
    // Isolated: a thread that waits here for the last pieces must not begin another node on top of this one.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pieces), [&](const auto& range) {
        used_.mark();
        for (std::size_t piece = range.begin(); piece != range.end(); ++piece) run(piece);
      });
    });
  }
  if (bad) std::rethrow_exception(bad);
}

}  // namespace kinegraph
