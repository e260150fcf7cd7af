#include "gui/document/aside.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "graph/diagnostic.h"

namespace kinegraph {

struct Aside::State {
  StopToken token;
  std::mutex mutex;
  std::condition_variable ended;
  bool over = false;
};

Aside::Aside(std::function<void(const StopToken&)> work, std::function<void()> done)
    : state_(std::make_shared<State>()),
      thread_([state = state_, work = std::move(work), done = std::move(done)] {
        try {
          work(state->token);
        } catch (const Cancelled&) {
        }
        {
          std::lock_guard lock(state->mutex);
          state->over = true;
        }
        state->ended.notify_all();
        if (done) done();
      }) {}

Aside::~Aside() {
  stop();
  thread_.join();
}

bool Aside::wait(int ms) const {
  std::unique_lock lock(state_->mutex);
  return state_->ended.wait_for(lock, std::chrono::milliseconds(ms), [this] { return state_->over; });
}

void Aside::stop() {
  state_->token.stop();
}

}  // namespace kinegraph
