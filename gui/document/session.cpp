#include "gui/document/session.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include "graph/file/diff.h"
#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/file/write_atomically.h"
#include "graph/missing.h"
#include "graph/move_paths.h"
#include "graph/nested.h"
#include "graph/validate.h"
#include "gui/document/aside.h"
#include "gui/document/autosave_slot.h"

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

// Whether graph files inside may be others now, or be given otherwise. All else leaves what was read of them.
bool touches_inside(const Edit& edit, const Document& document, const Registry& registry) {
  const auto is_graph = [&](const std::string& name) {
    const NodeType* type = registry.find(name);
    return type && type->role == Role::graph;
  };
  const auto of_graph = [&](const std::optional<Json>& node) {
    const Json* type = node ? node->find("type") : nullptr;
    return type && type->is_string() && is_graph(type->string());
  };
  for (const Change& change : edit.changes) {
    switch (change.unit.kind) {
      case Unit::Kind::node:
      case Unit::Kind::missing_node:
        if (of_graph(change.before) || of_graph(change.after)) return true;
        break;
      case Unit::Kind::node_type:
      case Unit::Kind::node_param: {
        const auto node = document.nodes.find(change.unit.name);
        if (node == document.nodes.end() || !is_graph(node->second.type)) break;
        const NodeType* type = known_type(registry, node->second);
        const Param* param = type ? type->find_param(change.unit.key) : nullptr;
        if (!param || param->kind == ParamType::Kind::open_file) return true;
        break;
      }
      case Unit::Kind::variable:
        return true;
      default:
        break;
    }
  }
  return false;
}

Diagnostics unreadable(const QString& path, const QString& why) {
  return {error("unreadable-file", "can't be read: " + why.toStdString())
              .in_file(path.toStdString())
              .hinting("check that the file is there and may be read")};
}

}  // namespace

Session::Session(const Registry& registry, QObject* parent) : QObject(parent), registry_(registry) {
  pages_.push_back(std::make_unique<Page>());
  page_ = pages_.front().get();
  autosave_.setSingleShot(true);
  autosave_.setInterval(autosave_after_ms);
  connect(&autosave_, &QTimer::timeout, this, &Session::write_autosave);
}

Session::~Session() = default;

QString Session::folder() const {
  return page_->path.isEmpty() ? QDir::currentPath() : QFileInfo(page_->path).absolutePath();
}

QString Session::title() const {
  return page_->path.isEmpty() ? tr("untitled") : QFileInfo(page_->path).fileName();
}

QString Session::written_path(const QString& absolute) const {
  const QString relative = QDir(folder()).relativeFilePath(absolute);
  return page_->path.isEmpty() || relative.startsWith("../../../../") ? absolute : relative;
}

Diagnostics Session::open(const QString& path) {
  return open(read_graph_file(path, registry_, modified_pages(), StopToken()));
}

Diagnostics Session::open_text(const std::string& text, const QString& path) {
  return open(read_graph_text(text, path, registry_, modified_pages(), StopToken()));
}

Diagnostics Session::open(GraphFile file) {
  if (!file.opens()) {
    refuse(file);
    return file.problems;
  }
  refused_file_ = {};
  auto page = std::make_unique<Page>();
  page->document = std::move(file.document);
  page->path = file.path;
  page->text_on_disk = std::move(file.text);
  show(std::move(page));
  return file.problems;
}

void Session::refuse(const GraphFile& file) {
  refused_file_ = {file.path, file.problems};
  emit problems_changed();
}

void Session::clear() {
  show(std::make_unique<Page>());
}

void Session::show(std::unique_ptr<Page> page) {
  for (auto& one : pages_)
    if (one.get() == page_) {
      page_ = page.get();
      one = std::move(page);
      break;
    }
  autosave_.stop();
  tell_of_page(false);
}

void Session::forget_refused() {
  if (refused_file_.path.isEmpty()) return;
  refused_file_ = {};
  emit problems_changed();
}

std::string Session::text() const {
  return write_document(page_->document, registry_);
}

void Session::save() {
  save_as(page_->path);
}

void Session::save_as(const QString& path) {
  if (is_read_only())
    throw Failure(error("read-only", "the graph was made by a newer Kinegraph and is open for reading only")
                      .in_file(page_->path.toStdString())
                      .hinting("update Kinegraph to edit it"));
  const bool moved = path != page_->path;
  const Move move{folder().toStdString(), QFileInfo(path).absolutePath().toStdString()};
  const bool elsewhere = moved && (page_->path.isEmpty() || move.from != move.to);
  Document document = page_->document;
  if (elsewhere) move_paths(document, registry_, move);
  const std::string saved = write_document(document, registry_);
  write_file_atomically(path.toStdString(), saved);
  page_->text_on_disk = saved;
  discard_autosave();
  page_->path = QFileInfo(path).absoluteFilePath();
  if (moved) page_->slot.reset();
  if (elsewhere) {
    move_paths(page_->history, page_->document, registry_, move);
    page_->document = std::move(document);
  }
  page_->history.mark_saved();
  if (moved) check_meaning();  // relative paths start elsewhere now
  if (elsewhere) emit changed();
  emit file_changed();
  if (moved) emit meaning_changed();
}

Session::Page::Page() = default;
Session::Page::~Page() = default;

AutosaveSlot& Session::slot() const {
  if (!page_->slot) page_->slot = std::make_unique<AutosaveSlot>(page_->path, folder());
  return *page_->slot;
}

QString Session::autosave_path() const {
  return slot().file();
}

bool Session::is_open_elsewhere() const {
  return !page_->path.isEmpty() && !slot().is_first();
}

bool Session::autosave_found() const {
  return !slot().left_behind().isEmpty();
}

void Session::keep_found() {
  const QStringList left = slot().left_behind();
  if (left.isEmpty()) return;
  page_->found = AutosaveSlot::aside_of(left.front());
  if (page_->found == left.front()) return;
  QFile::remove(page_->found);
  QFile::rename(left.front(), page_->found);
}

Diagnostics Session::recover() {
  QFile file(page_->found);
  if (!file.open(QIODevice::ReadOnly)) return unreadable(file.fileName(), file.errorString());
  ReadResult found = read_document(file.readAll().toStdString(), file.fileName().toStdString(), registry_);
  if (has_error(found.problems)) return found.problems;
  perform([&](const Document& document, const Registry&) {
    return edit_between(document, found.document, "Take up unsaved work");
  });
  // Before what was found goes, it has to be kept as this session's own work.
  if (!is_modified() || write_autosave()) discard_found();
  return found.problems;
}

void Session::discard_found() {
  if (!page_->found.isEmpty()) QFile::remove(page_->found);
  page_->found.clear();
}

void Session::discard_autosave() {
  autosave_.stop();
  QFile::remove(autosave_path());
  QFile::remove(slot().other_file());
}

bool Session::write_autosave() {
  if (!is_modified() || is_read_only()) return false;
  const std::string work = text();
  for (const QString& file : {autosave_path(), slot().other_file()}) {
    try {
      write_file_atomically(file.toStdString(), work);
      return true;
    } catch (const Failure&) {  // a full disk must not stop anyone from working
    }
  }
  return false;  // the next edit tries again
}

bool Session::perform(const std::function<Edit(const Document&, const Registry&)>& make) {
  if (is_read_only()) {
    emit refused(tr("This graph was made by a newer Kinegraph and can only be looked at."),
                 tr("Update Kinegraph to edit it."));
    return false;
  }
  Edit edit;
  try {
    edit = make(page_->document, registry_);
  } catch (const Failure& failure) {
    emit refused(QString::fromStdString(failure.diagnostic().message),
                 QString::fromStdString(failure.diagnostic().hint));
    return false;
  }
  if (edit.empty()) return true;
  apply(page_->document, edit);
  if (gesture_ && gesture_started_)
    page_->history.extend(edit);
  else
    page_->history.push(edit);
  gesture_started_ = gesture_;
  after(edit);
  return true;
}

void Session::begin_gesture() {
  gesture_ = true;
  gesture_started_ = false;
}

void Session::continue_gesture() {
  gesture_ = true;
  gesture_started_ = can_undo();
}

void Session::end_gesture() {
  gesture_ = false;
  gesture_started_ = false;
}

void Session::undo() {
  if (!can_undo()) return;
  gesture_started_ = false;  // what a drag still does is a step of its own
  after(page_->history.undo(page_->document));
}

void Session::redo() {
  if (!can_redo()) return;
  gesture_started_ = false;
  after(page_->history.redo(page_->document));
}

void Session::after(const Edit& edit) {
  const bool meaning = !only_for_the_eye(edit);
  keep_selection_valid();
  if (meaning) check_meaning(touches_inside(edit, page_->document, registry_));
  if (!is_modified())
    discard_autosave();
  else if (!autosave_.isActive())  // not put off by each edit: work without a pause is kept too
    autosave_.start();
  emit changed();
  emit file_changed();
  if (meaning) emit meaning_changed();
}

void Session::check_meaning(bool inside_too) {
  if (inside_too) read_inside();
  check_structure();
}

void Session::check_structure() {
  ValidateOptions options;
  options.file = title().toStdString();
  options.folder = folder().toStdString();
  page_->problems = page_->document.read_only ? Diagnostics{} : validate(page_->document, registry_, options);
  if (!page_->document.read_only)
    for (const auto& [name, node] : page_->document.nodes)
      if (auto problem = why_missing(registry_, node))
        page_->problems.push_back(std::move(*problem).at_node(name).in_file(options.file, node.place));
  emit problems_changed();
}

void Session::keep_selection_valid() {
  std::set<std::string> still;
  for (const std::string& name : page_->selected)
    if (page_->document.nodes.count(name)) still.insert(name);
  const std::string current = page_->document.nodes.count(page_->current) ? page_->current : std::string();
  if (still != page_->selected || current != page_->current) select(std::move(still), current);
}

void Session::select(std::set<std::string> nodes, std::string current) {
  if (current.empty() && nodes.size() == 1) current = *nodes.begin();
  if (nodes == page_->selected && current == page_->current) return;
  page_->selected = std::move(nodes);
  page_->current = std::move(current);
  emit selection_changed();
}

}  // namespace kinegraph
