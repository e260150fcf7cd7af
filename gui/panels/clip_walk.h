// Looks through folders for clips, on a thread of its own: a folder may hold a hundred thousand files, or lie
// on a slow disk.
#pragma once
#include <QStringList>
#include <QThread>
#include <atomic>

namespace kinegraph {

class ClipWalk : public QThread {
  Q_OBJECT

 public:
  explicit ClipWalk(QObject* parent = nullptr) : QThread(parent) {}
  ~ClipWalk() override;

  // Looks through the folders one after the other; what was still going on is given up.
  void look_through(const QStringList& folders);

 signals:
  void found(const QString& folder, const QStringList& clips);  // absolute paths, sorted

 protected:
  void run() override;

 private:
  void give_up();
  QStringList folders_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace kinegraph
