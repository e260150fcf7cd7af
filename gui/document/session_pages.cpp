// Several graphs open at once, and the graph files inside the one that is shown.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <algorithm>

#include "graph/file/write.h"
#include "graph/nested.h"
#include "gui/document/session.h"

namespace kinegraph {
namespace {

void collect_files(const Document& document, QStringList& files) {
  for (const auto& [name, node] : document.nodes) {
    if (!node.nested || node.nested->path.empty()) continue;
    const QString path = QString::fromStdString(node.nested->path);
    if (files.contains(path)) continue;
    files << path;
    if (node.nested->document) collect_files(*node.nested->document, files);
  }
}

}  // namespace

int Session::page() const {
  for (std::size_t i = 0; i < pages_.size(); ++i)
    if (pages_[i].get() == page_) return int(i);
  return 0;
}

QString Session::page_title(int page) const {
  const QString path = page_path(page);
  return path.isEmpty() ? tr("untitled") : QFileInfo(path).fileName();
}

bool Session::is_page_modified(int page) const {
  return !pages_[std::size_t(page)]->history.is_saved();
}

Diagnostics Session::open_page(const QString& path) {
  const QString wanted = QDir::cleanPath(QFileInfo(path).absoluteFilePath());
  for (int i = 0; i < pages(); ++i)
    if (!page_path(i).isEmpty() && QDir::cleanPath(page_path(i)) == wanted) {
      show_page(i);
      return {};
    }
  const int before = page();
  pages_.insert(pages_.begin() + before + 1, std::make_unique<Page>());
  show_page(before + 1);
  const Diagnostics problems = open(path);
  if (has_error(problems)) {
    close_page(before + 1);
    show_page(before);
  }
  return problems;
}

void Session::new_page() {
  if (path().isEmpty() && document().nodes.empty() && !is_modified()) return clear();
  pages_.insert(pages_.begin() + page() + 1, std::make_unique<Page>());
  show_page(page() + 1);
}

void Session::show_page(int page) {
  if (page < 0 || page >= pages() || page == this->page()) return;
  if (autosave_.isActive()) write_autosave();
  autosave_.stop();
  end_gesture();
  page_ = pages_[std::size_t(page)].get();
  tell_of_page();
}

void Session::close_page(int page) {
  if (page < 0 || page >= pages()) return;
  if (pages() == 1) return clear();
  const bool shown = page == this->page();
  if (shown) {
    autosave_.stop();
    end_gesture();
    page_ = pages_[std::size_t(page > 0 ? page - 1 : 1)].get();
  }
  pages_.erase(pages_.begin() + page);
  if (shown)
    tell_of_page();
  else
    emit file_changed();
}

void Session::tell_of_page() {
  check_meaning();
  emit page_changed();
  emit file_changed();
  emit selection_changed();
  emit changed();
  emit meaning_changed();
}

std::vector<int> Session::modified_inside() const {
  std::vector<int> found;
  const QStringList inside = files_inside();
  for (int i = 0; i < pages(); ++i)
    if (i != page() && is_page_modified(i) && inside.contains(QDir::cleanPath(page_path(i))))
      found.push_back(i);
  return found;
}

QStringList Session::files_inside() const {
  QStringList files;
  collect_files(document(), files);
  return files;
}

void Session::reopen_inside() {
  check_meaning();
  emit changed();
  emit meaning_changed();
}

std::string Session::text_inside(const std::string& path) const {
  const QString wanted = QString::fromStdString(path);
  for (const auto& one : pages_)
    if (one.get() != page_ && !one->path.isEmpty() && QDir::cleanPath(one->path) == wanted)
      return write_document(one->document, registry_);
  QFile file(wanted);
  if (!file.open(QIODevice::ReadOnly))
    throw Failure(error("missing-file", file.errorString().toStdString()).in_file(path));
  return file.readAll().toStdString();
}

void Session::open_inside(Document& document, const QString& path) const {
  const bool any = std::any_of(document.nodes.begin(), document.nodes.end(), [&](const auto& entry) {
    const NodeType* type = entry.second.missing ? nullptr : registry_.find(entry.second.type);
    return type && type->role == Role::graph;
  });
  if (!any) return;
  NestedOptions options;
  options.path = path.toStdString();
  options.folder = options.set_folder = folder().toStdString();
  options.read = [this](const std::string& file) { return text_inside(file); };
  open_nested(document, registry_, options);
}

}  // namespace kinegraph
