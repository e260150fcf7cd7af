#include "gui/document/session.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/validate.h"

namespace kinegraph {
namespace {

constexpr int autosave_after_ms = 2000;

bool only_for_the_eye(const Edit& edit) {
  for (const Change& change : edit.changes) {
    switch (change.unit.kind) {
      case Unit::Kind::ui_node:
      case Unit::Kind::ui_frame:
      case Unit::Kind::ui_note:
      case Unit::Kind::ui_extra:
      case Unit::Kind::node_note:
        break;
      default:
        return false;
    }
  }
  return true;
}

Diagnostics unreadable(const QString& path, const QString& why) {
  return {error("unreadable-file", "can't be read: " + why.toStdString())
              .in_file(path.toStdString())
              .hinting("check that the file is there and may be read")};
}

}  // namespace

Session::Session(const Registry& registry, QObject* parent) : QObject(parent), registry_(registry) {
  autosave_.setSingleShot(true);
  autosave_.setInterval(autosave_after_ms);
  connect(&autosave_, &QTimer::timeout, this, &Session::write_autosave);
}

Session::~Session() = default;

QString Session::folder() const {
  return path_.isEmpty() ? QDir::currentPath() : QFileInfo(path_).absolutePath();
}

QString Session::title() const {
  return path_.isEmpty() ? tr("untitled") : QFileInfo(path_).fileName();
}

QString Session::written_path(const QString& absolute) const {
  const QString relative = QDir(folder()).relativeFilePath(absolute);
  return path_.isEmpty() || relative.startsWith("../../../../") ? absolute : relative;
}

Diagnostics Session::open(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return unreadable(path, file.errorString());
  const QByteArray bytes = file.readAll();
  return open_text(std::string(bytes.constData(), static_cast<std::size_t>(bytes.size())),
                   QFileInfo(path).absoluteFilePath());
}

Diagnostics Session::open_text(const std::string& text, const QString& path) {
  ReadResult read = read_document(text, path.isEmpty() ? "untitled" : path.toStdString(), registry_);
  if (has_error(read.problems)) return read.problems;
  document_ = std::move(read.document);
  history_ = History();
  recovered_ = false;
  path_ = path;
  selected_.clear();
  current_.clear();
  autosave_.stop();
  check_meaning();
  emit file_changed();
  emit selection_changed();
  emit changed();
  emit meaning_changed();
  return read.problems;
}

void Session::clear() {
  document_ = Document();
  history_ = History();
  recovered_ = false;
  path_.clear();
  selected_.clear();
  current_.clear();
  autosave_.stop();
  check_meaning();
  emit file_changed();
  emit selection_changed();
  emit changed();
  emit meaning_changed();
}

std::string Session::text() const {
  return write_document(document_, registry_);
}

void Session::save() {
  save_as(path_);
}

void Session::save_as(const QString& path) {
  if (is_read_only())
    throw Failure(error("read-only", "the graph was made by a newer Kinegraph and is open for reading only")
                      .in_file(path_.toStdString())
                      .hinting("update Kinegraph to edit it"));
  write_file_atomically(path.toStdString(), text());
  const bool moved = path != path_;
  discard_autosave();
  path_ = QFileInfo(path).absoluteFilePath();
  history_.mark_saved();
  recovered_ = false;
  if (moved) check_meaning();  // relative paths start elsewhere now
  emit file_changed();
  if (moved) emit meaning_changed();
}

QString Session::autosave_path() const {
  const QString name =
      "." + (path_.isEmpty() ? QString("untitled.kg.json") : QFileInfo(path_).fileName()) + ".autosave";
  const QFileInfo beside(folder());
  if (!path_.isEmpty() && beside.isWritable()) return QDir(folder()).filePath(name);
  const QString state = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation);
  QDir().mkpath(state);
  // Files of one name in several folders must not share an autosave.
  return QDir(state).filePath(QString::number(qHash(folder()), 16) + name);
}

bool Session::autosave_found() const {
  const QFileInfo autosave(autosave_path());
  if (!autosave.exists() || autosave.size() == 0) return false;
  return path_.isEmpty() || autosave.lastModified() >= QFileInfo(path_).lastModified();
}

Diagnostics Session::recover() {
  QFile file(autosave_path());
  if (!file.open(QIODevice::ReadOnly)) return unreadable(file.fileName(), file.errorString());
  const QString path = path_;
  const QByteArray bytes = file.readAll();
  Diagnostics problems =
      open_text(std::string(bytes.constData(), static_cast<std::size_t>(bytes.size())), path);
  if (!has_error(problems)) {
    recovered_ = true;
    emit file_changed();
  }
  return problems;
}

void Session::discard_autosave() {
  autosave_.stop();
  QFile::remove(autosave_path());
}

void Session::write_autosave() {
  if (!is_modified() || is_read_only()) return;
  try {
    write_file_atomically(autosave_path().toStdString(), text());
  } catch (const Failure&) {
    // The next edit tries again; a full disk must not stop anyone from working.
  }
}

bool Session::perform(const std::function<Edit(const Document&, const Registry&)>& make) {
  if (is_read_only()) {
    emit refused(tr("This graph was made by a newer Kinegraph and can only be looked at."),
                 tr("Update Kinegraph to edit it."));
    return false;
  }
  Edit edit;
  try {
    edit = make(document_, registry_);
  } catch (const Failure& failure) {
    emit refused(QString::fromStdString(failure.diagnostic().message),
                 QString::fromStdString(failure.diagnostic().hint));
    return false;
  }
  if (edit.empty()) return true;
  apply(document_, edit);
  if (gesture_ && gesture_started_)
    history_.extend(edit);
  else
    history_.push(edit);
  gesture_started_ = gesture_;
  after(edit);
  return true;
}

void Session::begin_gesture() {
  gesture_ = true;
  gesture_started_ = false;
}

void Session::end_gesture() {
  gesture_ = false;
  gesture_started_ = false;
}

void Session::undo() {
  if (!can_undo()) return;
  end_gesture();
  after(history_.undo(document_));
}

void Session::redo() {
  if (!can_redo()) return;
  end_gesture();
  after(history_.redo(document_));
}

void Session::after(const Edit& edit) {
  const bool meaning = !only_for_the_eye(edit);
  keep_selection_valid();
  if (meaning) check_meaning();
  autosave_.start();
  emit changed();
  emit file_changed();
  if (meaning) emit meaning_changed();
}

void Session::check_meaning() {
  ValidateOptions options;
  options.file = title().toStdString();
  options.folder = folder().toStdString();
  problems_ = document_.read_only ? Diagnostics{} : validate(document_, registry_, options);
  emit problems_changed();
}

void Session::keep_selection_valid() {
  std::set<std::string> still;
  for (const std::string& name : selected_)
    if (document_.nodes.count(name)) still.insert(name);
  const std::string current = document_.nodes.count(current_) ? current_ : std::string();
  if (still != selected_ || current != current_) select(std::move(still), current);
}

void Session::select(std::set<std::string> nodes, std::string current) {
  if (current.empty() && nodes.size() == 1) current = *nodes.begin();
  if (nodes == selected_ && current == current_) return;
  selected_ = std::move(nodes);
  current_ = std::move(current);
  emit selection_changed();
}

}  // namespace kinegraph
