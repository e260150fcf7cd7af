// What the runs of one evaluator are computing just now, by key: a run that needs what another is at waits
// for that rather than begin it anew.
#pragma once
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "graph/key.h"

namespace kinegraph {

// Thread-safe.
class UnderWay {
 public:
  // True: nobody is at it. The caller is from now on, and says end(). False: somebody is; what `later` gives
  // is called once, from some thread, when that ended or at wake(). `later` itself is called here and now,
  // with the lock held.
  bool begin(const Key& key, const std::function<std::function<void()>()>& later);
  void end(const Key& key);
  // So that a run that was stopped sees it while it waits.
  void wake();
  std::set<Key> keys() const;

 private:
  mutable std::mutex mutex_;
  std::map<Key, std::vector<std::function<void()>>> waiting_;
};

}  // namespace kinegraph
