// Several graphs open at once, and the graph files inside the one that is shown.
#include <QDir>
#include <QFileInfo>
#include <atomic>

#include "graph/nested.h"
#include "gui/document/aside.h"
#include "gui/document/autosave_slot.h"
#include "gui/document/session.h"

namespace kinegraph {
namespace {

constexpr int a_moment_ms = 25;  // that the window's thread may wait for files inside

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

bool Session::show_page_of(const QString& path) {
  const QString wanted = QDir::cleanPath(QFileInfo(path).absoluteFilePath());
  for (int i = 0; i < pages(); ++i)
    if (!page_path(i).isEmpty() && QDir::cleanPath(page_path(i)) == wanted) {
      show_page(i);
      return true;
    }
  return false;
}

Diagnostics Session::open_page(const QString& path) {
  if (show_page_of(path)) return {};
  return open_page(read_graph_file(path, registry_, modified_pages(), StopToken()));
}

Diagnostics Session::open_page(GraphFile file) {
  if (!file.opens()) {
    refuse(file);
    return file.problems;
  }
  if (autosave_.isActive()) write_autosave();
  end_gesture();
  pages_.insert(pages_.begin() + page() + 1, std::make_unique<Page>());
  page_ = pages_[std::size_t(page() + 1)].get();
  return open(std::move(file));
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

void Session::tell_of_page(bool inside_too) {
  if (!inside_too) end_reading();  // of another graph
  check_meaning(inside_too);
  emit page_changed();
  emit file_changed();
  emit selection_changed();
  emit changed();
  emit meaning_changed();
}

OpenGraphs Session::modified_pages() const {
  OpenGraphs open;
  for (int i = 0; i < pages(); ++i)
    if (!page_path(i).isEmpty() && is_page_modified(i))
      open[QDir::cleanPath(page_path(i)).toStdString()] =
          std::make_shared<const Document>(pages_[std::size_t(i)]->document);
  return open;
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

// A reading that is on its way to its end is left to it: nobody waits.
void Session::end_reading() {
  ++readings_;
  std::erase_if(stopped_, [](const auto& one) { return one->wait(0); });
  if (!reading_) return;
  reading_->stop();
  if (!reading_->wait(0)) stopped_.push_back(std::move(reading_));
  reading_.reset();
  emit reading_changed();
}

void Session::stop_reading_inside() {
  end_reading();
}

void Session::read_inside() {
  end_reading();
  if (!has_graphs_inside(document(), registry_)) return;
  const int number = readings_;
  auto read = std::make_shared<Document>(graph_nodes_of(document(), registry_));
  auto whole = std::make_shared<std::atomic<bool>>(false);
  reading_ = std::make_unique<Aside>(
      [read, whole, open = modified_pages(), path = path(), folder = folder(),
       &registry = registry_](const StopToken& stop) {
        open_graphs_inside(*read, registry, path, folder, open, stop);
        *whole = true;
      },
      [this, read, whole, number] {
        QMetaObject::invokeMethod(
            this,
            [this, read, whole, number] {
              if (number != readings_ || !reading_) return;
              reading_.reset();
              if (*whole) take_inside(*read);
              check_structure();
              emit reading_changed();
              emit changed();
              emit meaning_changed();
            },
            Qt::QueuedConnection);
      });
  if (reading_->wait(a_moment_ms)) {
    reading_.reset();
    ++readings_;
    if (*whole) take_inside(*read);
    return;
  }
  emit reading_changed();
}

// Nodes that came, went or were given another file since are read anew anyway.
void Session::take_inside(const Document& read) {
  for (const auto& [name, node] : read.nodes) {
    const auto own = page_->document.nodes.find(name);
    if (own != page_->document.nodes.end()) own->second.nested = node.nested;
  }
}

}  // namespace kinegraph
