#include "gui/viewer/shown_motions.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QMetaObject>
#include <algorithm>

namespace kinegraph {
namespace {

constexpr std::size_t most_kept = 48;

// Stops in the middle of a long motion when the window closes.
class Stoppable : public Alone {
 public:
  explicit Stoppable(const std::atomic<bool>& stop) : stop_(stop) {}
  void check() override {
    if (stop_) throw Cancelled();
  }
  void progress(double) override { check(); }

 private:
  const std::atomic<bool>& stop_;
};

}  // namespace

ShownMotions::ShownMotions(QObject* parent) : QObject(parent), thread_([this] { work(); }) {}

ShownMotions::~ShownMotions() {
  {
    std::lock_guard lock(mutex_);
    quitting_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

std::shared_ptr<const ShownMotion> ShownMotions::find(const ValuePtr& value) {
  if (!value) return nullptr;
  auto [found, is_new] = known_.try_emplace(value.get());
  found->second.asked = ++asks_;
  if (is_new) {
    found->second.value = value;  // an address is only a name while its value lives
    {
      std::lock_guard lock(mutex_);
      waiting_.push_back(value);
      busy_ = true;
    }
    wake_.notify_all();
    forget_old();
  }
  return found->second.motion;
}

bool ShownMotions::is_busy() const {
  return busy_;
}

void ShownMotions::forget_old() {
  if (known_.size() <= most_kept) return;
  auto oldest = known_.end();
  for (auto at = known_.begin(); at != known_.end(); ++at)
    if (!at->second.waiting && (oldest == known_.end() || at->second.asked < oldest->second.asked))
      oldest = at;
  if (oldest != known_.end()) known_.erase(oldest);
}

void ShownMotions::work() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), 8);
  for (;;) {
    ValuePtr value;
    {
      std::unique_lock lock(mutex_);
      busy_ = !waiting_.empty();
      wake_.wait(lock, [this] { return quitting_ || !waiting_.empty(); });
      if (quitting_) return;
      // The newest first: during a drag the older ones are past.
      value = std::move(waiting_.back());
      waiting_.pop_back();
    }
    std::shared_ptr<const ShownMotion> motion;
    try {
      Stoppable work(quitting_);
      motion = make_shown_motion(value, work);
    } catch (const Cancelled&) {
      return;
    } catch (const std::exception&) {
      motion = nullptr;  // a value that can't be drawn shows nothing; its node tells what is wrong
    }
    QMetaObject::invokeMethod(
        this,
        [this, value, motion] {
          auto found = known_.find(value.get());
          if (found != known_.end()) {
            found->second.motion = motion;
            found->second.waiting = false;
          }
          emit made();
        },
        Qt::QueuedConnection);
  }
}

}  // namespace kinegraph
