#include "gui/window/file_search.h"

#include <QDirIterator>
#include <QElapsedTimer>
#include <QFileInfo>
#include <set>

namespace kinegraph {
namespace {

constexpr int most_files = 500000;
constexpr int tell_every_ms = 100;

}  // namespace

FileSearch::FileSearch(std::vector<Wanted> wanted, QStringList folders, QObject* parent)
    : QThread(parent), wanted_(std::move(wanted)), folders_(std::move(folders)) {}

FileSearch::~FileSearch() {
  stop();
  wait();
}

void FileSearch::run() {
  int count = 0;
  QElapsedTimer told;
  told.start();
  std::set<QString> seen;
  for (const QString& folder : folders_) {
    QDirIterator files(folder, QDir::Files | QDir::Readable,
                       QDirIterator::Subdirectories | QDirIterator::FollowSymlinks);
    while (files.hasNext() && !stopped_ && count < most_files) {
      const QString path = files.next();
      if (!seen.insert(path).second) continue;
      ++count;
      if (told.elapsed() > tell_every_ms) {
        emit looked_at(count);
        told.restart();
      }
      const QFileInfo info = files.fileInfo();
      for (std::size_t i = 0; i < wanted_.size(); ++i) {
        const Wanted& one = wanted_[i];
        const bool named = info.fileName().compare(QFileInfo(one.path).fileName(), Qt::CaseInsensitive) == 0;
        const bool sized = one.known && one.known->size == info.size();
        if (!named && !sized) continue;
        const bool same = sized && KnownFiles::digest_of(path) == one.known->digest;
        if (named || same) emit found(int(i), path, same);
      }
    }
  }
  emit looked_at(count);
}

}  // namespace kinegraph
