// What happens to files behind the editor's back: watching, merging, finding what is missing.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <utility>

#include "graph/file/diff.h"
#include "graph/file/merge.h"
#include "graph/file/read.h"
#include "graph/nested.h"
#include "gui/document/problem_text.h"
#include "gui/window/changes_dialog.h"
#include "gui/window/conflicts_dialog.h"
#include "gui/window/main_window.h"
#include "gui/window/relink_dialog.h"

namespace kinegraph {
namespace {

constexpr int gone_after_ms = 300;
constexpr auto on_disk = "disk";  // what notices of the graph's file are about

std::string bytes_of(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  return file.readAll().toStdString();
}

// Files that nodes of a graph read, those of graphs inside it left out.
QStringList files_read(const Document& document, const Registry& registry, const QString& folder) {
  QStringList files;
  for (const auto& [name, node] : document.nodes) {
    if (node.params.empty()) continue;
    const NodeType* type = known_type(registry, node);
    if (!type) continue;
    for (const auto& [key, value] : node.params) {
      if (!value.is_string() || value.string().empty()) continue;
      const Param* param = type->find_param(key);
      if (param && param->kind == ParamType::Kind::open_file)
        files << QDir(folder).absoluteFilePath(QString::fromStdString(value.string()));
    }
  }
  return files;
}

}  // namespace

// Graphs inside are the same until they are read anew, and may be large: each is walked through once.
QStringList MainWindow::files_behind(const Document& document, const QString& folder) {
  QStringList files = files_read(document, registry_, folder);
  std::set<const Document*> met;
  for (const auto& [name, node] : document.nodes) {
    if (!node.nested) continue;
    const auto& inside = node.nested->document;
    if (!node.nested->path.empty()) files << QString::fromStdString(node.nested->path);
    if (!inside || !met.insert(inside.get()).second) continue;
    auto& known = read_inside_[inside.get()];
    if (known.first.lock() != inside)
      known = {inside, files_behind(*inside, QString::fromStdString(node.nested->folder))};
    files << known.second;
  }
  return files;
}

void MainWindow::watch_files() {
  watched_for_.clear();
  watch_other_files();
}

// Which files an edit leaves as they are needn't be looked for: that can take long where they lie far away.
void MainWindow::watch_other_files() {
  std::erase_if(read_inside_, [](const auto& one) { return one.second.first.expired(); });
  QStringList wanted;
  if (!session_.path().isEmpty()) wanted << session_.path();
  wanted << files_behind(session_.document(), session_.folder());
  wanted.removeDuplicates();
  if (!wanted.isEmpty() && wanted == watched_for_) return;
  watched_for_ = wanted;
  const QStringList watched = watcher_.files() + watcher_.directories();
  QStringList gone, fresh;
  // Of a file that isn't there the folder is watched, where it may appear.
  for (QString& path : wanted)
    if (!QFile::exists(path)) path = QFileInfo(path).absolutePath();
  for (const QString& path : watched)
    if (!wanted.contains(path)) gone << path;
  for (const QString& path : wanted)
    if (!watched.contains(path) && !fresh.contains(path) && QFile::exists(path)) fresh << path;
  if (!gone.isEmpty()) watcher_.removePaths(gone);
  if (!fresh.isEmpty()) watcher_.addPaths(fresh);
  known_files_.learn(wanted);
}

void MainWindow::file_changed_on_disk(const QString& path) {
  const QString own = session_.path();
  if (path == own)
    own_changed_ = true;
  else if (!QFileInfo(path).isDir())
    (session_.files_inside().contains(path) ? inside_changed_ : clip_changed_) = true;
  else {
    inside_changed_ = true;
    // It was gone, and is there again.
    own_changed_ |=
        QFileInfo(own).absolutePath() == path && QFile::exists(own) && !watcher_.files().contains(own);
  }
  reload_.start();  // once nothing more happens to them
}

// A file that is written aside and renamed is a new one to the watcher: it is watched before it is looked at,
// so that nothing that happens in between goes by.
void MainWindow::look_at_changed_files() {
  watch_files();
  if (std::exchange(own_changed_, false)) look_at_own_file();
  const bool inside = std::exchange(inside_changed_, false), clip = std::exchange(clip_changed_, false);
  if (inside) session_.reopen_inside();
  if (inside || clip) evaluate();
}

void MainWindow::look_at_own_file() {
  const QString path = session_.path();
  const bool there = QFile::exists(path);
  const std::string now = bytes_of(path);
  if (now.empty()) {
    // Who writes it anew may be between the old and the new one.
    QTimer::singleShot(gone_after_ms, this, [this, path, there] {
      if (path != session_.path()) return;
      if (QFile::exists(path) != there || !bytes_of(path).empty()) return look_at_own_file();
      if (there) return offer_merge({});
      notice_->say(NoticeBar::Kind::warning,
                   tr("%1 is not on the disk any more. What is open here is kept.").arg(session_.title()),
                   {{tr("Save it again"), [this] { save(); }}});
      notice_->set_topic(on_disk);
    });
    return;
  }
  if (now == session_.text_on_disk() || now == session_.text()) {
    notice_->done_with(on_disk);
    if (session_.refused_file().path == path) session_.forget_refused();  // it was mended
    return;
  }
  offer_merge(now);
}

void MainWindow::offer_merge(const std::string& now) {
  offer_what_is_there(now);
  notice_->set_topic(on_disk);
}

void MainWindow::offer_what_is_there(const std::string& now) {
  const std::string path = session_.path().toStdString();
  const ReadResult theirs = read_document(now, path, registry_);
  if (has_error(theirs.problems)) {
    session_.refuse(read_graph_text(now, session_.path(), registry_, session_.modified_pages(), StopToken()));
    notice_->say(NoticeBar::Kind::warning,
                 tr("%1 changed on disk and can't be read there any more. What is open here is kept; save it "
                    "to replace what is on disk.")
                     .arg(session_.title()),
                 {{tr("Show problems"), [this] { show_dock("Problems"); }}});
    return;
  }
  if (theirs.document.read_only) {
    notice_->say(NoticeBar::Kind::warning,
                 tr("%1 was saved by a newer Kinegraph. Save what is open here under another name, or update "
                    "Kinegraph to merge it.")
                     .arg(session_.title()),
                 {{tr("Save as…"), [this] { save_as(); }}});
    return;
  }
  if (session_.refused_file().path == session_.path()) session_.forget_refused();
  const ReadResult base = read_document(session_.text_on_disk(), path, registry_);
  const Diff changed = diff(base.document, theirs.document);
  const QStringList what = changes_in_words(changed);
  const QString list = what.isEmpty()
                           ? tr("only its layout")
                           : QStringList(what.mid(0, 4)).join(", ") + (what.size() > 4 ? ", …" : "");
  const auto merge_in = [this, now, base, theirs, list] {
    const Merge merged =
        merge(base.document, session_.document(), theirs.document, registry_, "here", "on disk");
    const Document before = session_.document();
    session_.perform([&](const Document& document, const Registry&) {
      return edit_between(document, merged.document, "Merge what changed on disk");
    });
    session_.set_text_on_disk(now);
    watch_files();
    if (merged.conflicts.empty()) {
      notice_->say(NoticeBar::Kind::good, tr("Merged in: %1. Undo takes it back; save to keep it.").arg(list),
                   {}, 8);
      return;
    }
    const Merge other = merge(base.document, theirs.document, before, registry_, "on disk", "here");
    say_conflicts(merged, other.document);
  };
  notice_->say(NoticeBar::Kind::info, tr("%1 changed on disk: %2.").arg(session_.title(), list),
               {{tr("Merge it in"), merge_in},
                {tr("Show what changed"),
                 [this, changed, merge_in, now] {
                   ChangesDialog dialog(tr("%1 changed on disk").arg(session_.title()), changed, this);
                   if (dialog.exec() == QDialog::Accepted)
                     merge_in();
                   else
                     offer_merge(now);
                 }},
                {tr("Keep what is open"), [this, now] { session_.set_text_on_disk(now); }}});
}

// Yours stands in the graph; of each a colleague's can be taken instead.
void MainWindow::say_conflicts(const Merge& merged, const Document& theirs) {
  QStringList where;
  for (const MergeConflict& one : merged.conflicts) {
    if (!one.unit) {
      where << with_quotes(QString::fromStdString(one.what));
      continue;
    }
    const auto [node, what] = unit_words(*one.unit);
    where << (node.isEmpty() ? what : tr("%1 of %2").arg(what, node));
  }
  const QString list = QStringList(where.mid(0, 3)).join(", ") + (where.size() > 3 ? ", …" : "");
  notice_->say(
      NoticeBar::Kind::warning, tr("Merged in, but both sides changed: %1. Yours was kept.").arg(list),
      {{tr("Choose…"), [this, merged, theirs] {
          ConflictsDialog dialog(tr("Both sides changed %1").arg(session_.title()), merged.conflicts,
                                 merged.document, theirs, this);
          if (dialog.exec() != QDialog::Accepted) return say_conflicts(merged, theirs);
          session_.perform([&](const Document& document, const Registry&) {
            Document chosen = document;
            for (const Unit& unit : dialog.chosen()) {
              // Of a node that was taken away since, nothing can be kept.
              const bool whole = unit.kind == Unit::Kind::node || unit.kind == Unit::Kind::missing_node;
              if (whole || unit_words(unit).node.isEmpty() || chosen.nodes.count(unit.name))
                set(chosen, unit, get(theirs, unit));
            }
            return edit_between(document, chosen, "Take what is on disk");
          });
        }}});
}

bool MainWindow::changed_by_others() {
  const std::string now = bytes_of(session_.path());
  if (now.empty() || now == session_.text_on_disk() || now == session_.text()) return false;
  if (has_error(read_document(now, session_.path().toStdString(), registry_).problems)) return false;
  offer_merge(now);
  return true;
}

void MainWindow::offer_missing_files() {
  const auto missing = missing_files(session_);
  if (missing.empty()) return;
  const QString first = QString::fromStdString(missing.front().node);
  notice_->say(NoticeBar::Kind::warning,
               missing.size() == 1 ? tr("A file that %1 reads is missing.").arg(first)
                                   : tr("%1 files that the graph reads are missing.").arg(missing.size()),
               {{missing.size() == 1 ? tr("Find it…") : tr("Find them…"), [this] { relink(); }}});
}

void MainWindow::relink() {
  const auto missing = missing_files(session_);
  if (missing.empty()) {
    notice_->say(NoticeBar::Kind::good, tr("No file is missing."), {}, 5);
    return;
  }
  RelinkDialog dialog(session_, known_files_, missing, this);
  dialog.exec();
}

}  // namespace kinegraph
