// What a long algorithm may ask of whoever runs it: whether to stop, where to report progress and warnings, memory, and
// the other cores. Algorithms take a Work& and nothing else of the evaluator, so they are plain functions in a test.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>

#include "graph/diagnostic.h"

namespace kinegraph {

class Work {
 public:
  virtual ~Work() = default;

  // Throws Cancelled when the work was asked to stop. An atomic load: call it at least every few milliseconds.
  virtual void check() = 0;
  // As check(), and tells how far this work is, 0 to 1. Cheap; shown at most some 20 times a second.
  virtual void progress(double fraction) = 0;
  // A warning or info for the person; thread-safe. Errors are thrown as Failure.
  virtual void report(Diagnostic diagnostic) = 0;

  // Calls body(begin, end) over pieces that cover [0, count), on several threads where there are some. Every index
  // writes its own result, so that the answer does not depend on the pieces. `grain`: least indices worth a piece.
  // An exception from a piece stops the others and is rethrown here.
  virtual void parallel(std::size_t count, std::size_t grain,
                        const std::function<void(std::size_t begin, std::size_t end)>& body) = 0;

  // Announces working memory (over some 16 MiB) before it is allocated; released when the handle goes.
  // Throws Failure ("out-of-memory") when --memory doesn't allow it.
  virtual std::shared_ptr<void> reserve(std::size_t bytes) = 0;
};

// Runs everything in the calling thread, is never cancelled, and keeps what is reported. For tests and plain callers.
class Alone : public Work {
 public:
  void check() override {}
  void progress(double) override {}
  void report(Diagnostic diagnostic) override { reported.push_back(std::move(diagnostic)); }
  void parallel(std::size_t count, std::size_t,
                const std::function<void(std::size_t, std::size_t)>& body) override {
    if (count) body(0, count);
  }
  std::shared_ptr<void> reserve(std::size_t) override { return {}; }
  Diagnostics reported;
};

}  // namespace kinegraph
