// Work of unknown length, on a thread of its own: the window's thread waits for it a moment at most, or goes
// on with other things until it is done.
#pragma once
#include <functional>
#include <memory>
#include <thread>

#include "graph/evaluate/stop.h"

namespace kinegraph {

class Aside {
 public:
  // Starts at once. `work` looks at the token now and then, owns or outlives all it uses, and throws nothing
  // but Cancelled; `done` (may be empty) is called on the same thread once it ended, stopped or not.
  Aside(std::function<void(const StopToken&)> work, std::function<void()> done);
  ~Aside();  // stops it and waits for its end
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

  bool wait(int ms) const;  // true: it has ended
  void stop();

 private:
  struct State;
  std::shared_ptr<State> state_;
  std::thread thread_;
};

}  // namespace kinegraph
