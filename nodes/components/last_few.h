// What was found before and may be asked for again, by all that it depends on.
#pragma once
#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "graph/work.h"

namespace kinegraph {

// Passes everything on, and keeps what is reported.
class ListeningWork : public Work {
 public:
  explicit ListeningWork(Work& work) : work_(work) {}
  void check() override { work_.check(); }
  void progress(double fraction) override { work_.progress(fraction); }
  void report(Diagnostic diagnostic) override {
    const std::lock_guard lock(mutex_);
    heard_.push_back(diagnostic);
    work_.report(std::move(diagnostic));
  }
  void parallel(std::size_t count, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& body) override {
    work_.parallel(count, grain, body);
  }
  std::shared_ptr<void> reserve(std::size_t bytes) override { return work_.reserve(bytes); }
  const Diagnostics& heard() const { return heard_; }

 private:
  Work& work_;
  std::mutex mutex_;
  Diagnostics heard_;
};

// Holds the `most` that were asked for last. As a key says all that its answer depends on, results are the
// same with it and without. Thread-safe.
template <class Key, class Found, std::size_t most>
class LastFew {
 public:
  // The remembered answer, or what `find` gives; what that reported is reported again each time.
  std::shared_ptr<const Found> get(const Key& key, const std::function<Found(Work&)>& find, Work& work) {
    {
      const std::lock_guard lock(mutex_);
      const auto known = std::find_if(entries_.begin(), entries_.end(),
                                      [&](const Entry& entry) { return entry.key == key; });
      if (known != entries_.end()) {
        std::rotate(entries_.begin(), known, known + 1);
        for (const Diagnostic& one : entries_.front().told) work.report(one);
        return entries_.front().found;
      }
    }
    ListeningWork listening(work);
    auto found = std::make_shared<const Found>(find(listening));
    const std::lock_guard lock(mutex_);
    entries_.insert(entries_.begin(), {key, found, listening.heard()});
    if (entries_.size() > most) entries_.pop_back();
    return found;
  }

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const Found> found;
    Diagnostics told;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;  // the latest first
};

}  // namespace kinegraph
