// What the editor remembers of the files that its graphs read: size and content's digest, so that one that
// was moved or renamed is found again. Kept per user, the 5,000 met last; learned on a thread of the pool.
#pragma once
#include <QByteArray>
#include <QString>
#include <QStringList>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace kinegraph {

class KnownFiles {
 public:
  struct File {
    qint64 size = 0, time = 0;  // bytes; ms since 1970
    QByteArray digest;          // of the content, hex
    qint64 met = 0;             // larger for files met later
  };
  KnownFiles();
  // Reads files that are there and changed since they were last learned. Returns at once.
  void learn(const QStringList& paths);
  std::optional<File> find(const QString& path) const;
  // Of a file's content; empty where it can't be read.
  static QByteArray digest_of(const QString& path);

 private:
  // Shared with the threads that learn.
  struct Store {
    mutable std::mutex mutex;
    std::map<QString, File> files;
    qint64 last_met = 0;
    QString path;
    void load();
    void save();
  };
  std::shared_ptr<Store> store_;
};

}  // namespace kinegraph
