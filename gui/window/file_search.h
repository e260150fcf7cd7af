// Looks through folders for files that are missing, on a thread of its own: by name, and by content where
// that is known.
#pragma once
#include <QStringList>
#include <QThread>
#include <atomic>
#include <vector>

#include "gui/document/known_files.h"

namespace kinegraph {

class FileSearch : public QThread {
  Q_OBJECT

 public:
  struct Wanted {
    QString path;  // absolute, where it should be
    std::optional<KnownFiles::File> known;
  };
  FileSearch(std::vector<Wanted> wanted, QStringList folders, QObject* parent = nullptr);
  ~FileSearch() override;
  void stop() { stopped_ = true; }

 signals:
  // `same`: its content is that of the missing file.
  void found(int wanted, const QString& path, bool same);
  void looked_at(int files);

 protected:
  void run() override;

 private:
  std::vector<Wanted> wanted_;
  QStringList folders_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace kinegraph
