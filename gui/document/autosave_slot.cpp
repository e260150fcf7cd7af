#include "gui/document/autosave_slot.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>

namespace kinegraph {
namespace {

constexpr int most_slots = 16, most_aside = 9;
constexpr auto aside = ".autosave.found";

QString folder_in(QStandardPaths::StandardLocation location) {
  const QString folder = QStandardPaths::writableLocation(location);
  QDir().mkpath(folder);
  return folder;
}

QString hidden_name(const QString& path) {
  return "." + (path.isEmpty() ? QString("untitled.kg.json") : QFileInfo(path).fileName()) + ".autosave";
}

// An autosave that is newer than its graph.
bool is_unsaved_work(const QString& autosave, const QString& graph) {
  const QFileInfo file(autosave);
  if (!file.exists() || file.size() == 0) return false;
  return graph.isEmpty() || file.lastModified() >= QFileInfo(graph).lastModified();
}

QString numbered_aside(const QString& autosave, int number) {
  return autosave + ".found" + (number > 1 ? QString::number(number) : QString());
}

}  // namespace

QString AutosaveSlot::aside_of(const QString& autosave) {
  if (autosave.contains(aside)) return autosave;
  int number = 1;
  while (number < most_aside && QFile::exists(numbered_aside(autosave, number))) ++number;
  return numbered_aside(autosave, number);
}

AutosaveSlot::AutosaveSlot(const QString& path, const QString& folder) : path_(path), folder_(folder) {
  for (number_ = 0; number_ + 1 < most_slots; ++number_) {
    lock_ = lock_of(number_);
    // Where no lock can be made at all there is nobody to keep away.
    if (lock_->tryLock(0) || lock_->error() != QLockFile::LockFailedError) return;
  }
  lock_.reset();
}

QString AutosaveSlot::file_of(int slot) const {
  if (slot == 0 && !path_.isEmpty() && QFileInfo(folder_).isWritable())
    return QDir(folder_).filePath(hidden_name(path_));
  return in_state_folder(slot);
}

QString AutosaveSlot::in_state_folder(int slot) const {
  // Files of one name in several folders must not share an autosave.
  const QString number = slot ? "." + QString::number(slot + 1) : QString();
  return QDir(folder_in(QStandardPaths::AppLocalDataLocation))
      .filePath(QString::number(qHash(folder_), 16) + number + hidden_name(path_));
}

std::unique_ptr<QLockFile> AutosaveSlot::lock_of(int slot) const {
  const QString whose = path_.isEmpty() ? folder_ + "/" : QDir::cleanPath(path_);
  auto lock = std::make_unique<QLockFile>(
      QDir(folder_in(QStandardPaths::RuntimeLocation))
          .filePath(QString("kinegraph-%1-%2.lock").arg(QString::number(qHash(whose), 16)).arg(slot)));
  lock->setStaleLockTime(0);  // a session may last for days; one whose program ended holds nothing
  return lock;
}

QStringList AutosaveSlot::left_behind() const {
  QStringList found;
  for (int slot = 0; slot < most_slots; ++slot) {
    QStringList here;
    QStringList places{file_of(slot)};
    if (const QString other = in_state_folder(slot); other != places.front()) places << other;
    for (const QString& fresh : places) {
      // Of another editor's work it says nothing that this one saved the graph since.
      if (is_unsaved_work(fresh, slot == 0 ? path_ : QString())) here << fresh;
      // What was put aside was never answered: that the graph was saved since says nothing about it either.
      for (int number = most_aside; number > 0; --number)
        if (const QString kept = numbered_aside(fresh, number); is_unsaved_work(kept, {})) here << kept;
    }
    if (!here.isEmpty() && (slot == number_ || lock_of(slot)->tryLock(0))) found << here;
  }
  return found;
}

}  // namespace kinegraph
