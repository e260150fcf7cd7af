#include "gui/document/known_files.h"

#include <QCryptographicHash>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSaveFile>
#include <QStandardPaths>
#include <QThreadPool>
#include <algorithm>
#include <vector>

namespace kinegraph {
namespace {

constexpr std::size_t most_files = 5000;
constexpr qint64 largest = qint64(1) << 30;

}  // namespace

KnownFiles::KnownFiles() : store_(std::make_shared<Store>()) {
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation);
  QDir().mkpath(folder);
  store_->path = QDir(folder).filePath("known_files");
  store_->load();
}

// A line a file: size, time, digest, path; those met last at the end.
void KnownFiles::Store::load() {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return;
  while (!file.atEnd()) {
    const QString line = QString::fromUtf8(file.readLine()).chopped(1);
    const QStringList parts = line.split(' ');
    if (parts.size() < 4) continue;
    files.insert({line.section(' ', 3),
                  {parts[0].toLongLong(), parts[1].toLongLong(), parts[2].toLatin1(), ++last_met}});
  }
}

void KnownFiles::Store::save() {
  std::vector<std::pair<QString, File>> ordered(files.begin(), files.end());
  std::sort(ordered.begin(), ordered.end(),
            [](const auto& a, const auto& b) { return a.second.met < b.second.met; });
  while (ordered.size() > most_files) {
    files.erase(ordered.front().first);
    ordered.erase(ordered.begin());
  }
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return;
  for (const auto& [name, known] : ordered)
    file.write(QString("%1 %2 %3 %4\n")
                   .arg(known.size)
                   .arg(known.time)
                   .arg(QString::fromLatin1(known.digest), name)
                   .toUtf8());
  file.commit();
}

QByteArray KnownFiles::digest_of(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  QCryptographicHash hash(QCryptographicHash::Sha256);
  return hash.addData(&file) ? hash.result().toHex() : QByteArray();
}

void KnownFiles::learn(const QStringList& paths) {
  QThreadPool::globalInstance()->start([store = store_, paths] {
    bool any = false;
    for (const QString& path : paths) {
      const QFileInfo info(path);
      if (!info.isFile() || info.size() > largest) continue;
      const qint64 time = info.lastModified().toMSecsSinceEpoch();
      {
        std::lock_guard lock(store->mutex);
        const auto known = store->files.find(path);
        if (known != store->files.end() && known->second.size == info.size() && known->second.time == time) {
          known->second.met = ++store->last_met;
          continue;
        }
      }
      const QByteArray digest = digest_of(path);
      if (digest.isEmpty()) continue;
      std::lock_guard lock(store->mutex);
      store->files[path] = {info.size(), time, digest, ++store->last_met};
      any = true;
    }
    std::lock_guard lock(store->mutex);
    if (any) store->save();
  });
}

std::optional<KnownFiles::File> KnownFiles::find(const QString& path) const {
  std::lock_guard lock(store_->mutex);
  const auto known = store_->files.find(path);
  if (known == store_->files.end()) return {};
  return known->second;
}

}  // namespace kinegraph
