// Where a graph's autosave lies, and whose it is. A graph can be open in several editors at once, and graphs
// that were never saved have no name to tell them apart: each has a slot of its own, held by a lock that ends
// with its program. The first slot of a saved graph is beside its file, as .NAME.kg.json.autosave; the others
// are in the user's state folder.
#pragma once
#include <QLockFile>
#include <QString>
#include <QStringList>
#include <memory>

namespace kinegraph {

class AutosaveSlot {
 public:
  // Takes the first that nobody holds. `path`: of the graph, absolute; "" for one that was never saved.
  AutosaveSlot(const QString& path, const QString& folder);

  QString file() const { return file_of(number_); }
  // Where the work is kept when there is no room beside the graph; the same where it isn't kept there.
  QString other_file() const { return in_state_folder(number_); }
  bool is_first() const { return number_ == 0; }
  // What ended sessions left, the freshest of each slot first: files of slots that nobody holds any more, and
  // its own.
  QStringList left_behind() const;
  // An autosave is put aside, because a session goes on in its slot: under a name that is free, as several
  // may wait for an answer. Its name where it lies aside already.
  static QString aside_of(const QString& autosave);

 private:
  QString file_of(int slot) const;
  QString in_state_folder(int slot) const;
  std::unique_ptr<QLockFile> lock_of(int slot) const;

  QString path_, folder_;
  int number_ = 0;
  std::unique_ptr<QLockFile> lock_;
};

}  // namespace kinegraph
