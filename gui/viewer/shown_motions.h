// Makes ShownMotions on a thread of its own, at lower priority, and keeps the newest: the window asks what is
// there and is told when more is.
#pragma once
#include <QObject>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "gui/viewer/shown_motion.h"

namespace kinegraph {

class ShownMotions : public QObject {
  Q_OBJECT

 public:
  explicit ShownMotions(QObject* parent = nullptr);
  ~ShownMotions() override;

  // What was made of a value, or null while it is being made; asking starts it. Values that nobody asked for
  // in a while are forgotten.
  std::shared_ptr<const ShownMotion> find(const ValuePtr& value);
  bool is_busy() const;

 signals:
  void made();  // some find() now succeeds

 private:
  struct Known {
    std::shared_ptr<const ShownMotion> motion;
    ValuePtr value;
    bool waiting = true;
    std::uint64_t asked = 0;
  };
  void work();
  void forget_old();

  std::map<const Value*, Known> known_;  // GUI thread only
  std::uint64_t asks_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<ValuePtr> waiting_;
  std::atomic<bool> quitting_ = false;
  std::atomic<bool> busy_ = false;
  std::thread thread_;
};

}  // namespace kinegraph
