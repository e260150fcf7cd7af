// Work of a part whose warnings and progress are not of the whole's concern.
#pragma once
#include "graph/work.h"

namespace kinegraph {

class QuietWork : public Work {
 public:
  explicit QuietWork(Work& work) : work_(work) {}
  void check() override { work_.check(); }
  void progress(double) override { work_.check(); }
  void report(Diagnostic) override {}
  void parallel(std::size_t count, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& body) override {
    work_.parallel(count, grain, body);
  }
  std::shared_ptr<void> reserve(std::size_t bytes) override { return work_.reserve(bytes); }

 private:
  Work& work_;
};

}  // namespace kinegraph
