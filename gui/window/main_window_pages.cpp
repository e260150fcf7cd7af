// Several graphs in one window: their tabs, graphs inside graphs.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QTabBar>
#include <algorithm>

#include "graph/collapse.h"
#include "graph/file/write.h"
#include "graph/nested.h"
#include "gui/look/ask_file.h"
#include "gui/look/words.h"
#include "gui/window/main_window.h"

namespace kinegraph {
namespace {

constexpr int widest_title = 180;      // pixels of a tab
constexpr qsizetype most_listed = 10;  // graphs in a question

}  // namespace

void MainWindow::update_pages() {
  const QSignalBlocker quiet(page_tabs_);
  while (page_tabs_->count() > session_.pages()) page_tabs_->removeTab(page_tabs_->count() - 1);
  while (page_tabs_->count() < session_.pages()) page_tabs_->addTab(QString());
  for (int i = 0; i < session_.pages(); ++i) {
    QString title = session_.page_title(i);
    if (title.endsWith(".kg.json")) title.chop(8);
    title = page_tabs_->fontMetrics().elidedText(title, Qt::ElideMiddle, widest_title);
    title.replace("&", "&&");
    page_tabs_->setTabText(i, session_.is_page_modified(i) ? title + " •" : title);
    page_tabs_->setTabToolTip(i, QDir::toNativeSeparators(session_.page_path(i)));
  }
  page_tabs_->setCurrentIndex(session_.page());
  page_tabs_->setVisible(session_.pages() > 1);
}

void MainWindow::close_page(int page) {
  finish_typing();
  const int before = session_.page();
  session_.show_page(page);
  if (!may_discard()) {
    session_.show_page(before);
    return;
  }
  session_.close_page(page);
  watch_files();
}

bool MainWindow::may_discard_all() {
  std::vector<int> unsaved;
  QStringList names;
  for (int i = 0; i < session_.pages(); ++i) {
    const QString path = session_.page_path(i);
    if (!session_.is_page_modified(i) && (path.isEmpty() || QFile::exists(path))) continue;
    unsaved.push_back(i);
    names << session_.page_title(i);
  }
  if (!options_.ask) return true;
  const auto all = [&](auto&& of_shown) {
    return std::all_of(unsaved.begin(), unsaved.end(), [&](int page) {
      session_.show_page(page);
      return of_shown();
    });
  };
  if (unsaved.size() < 2) return all([this] { return may_discard(); });
  QMessageBox box(QMessageBox::Question, tr("Kinegraph"),
                  tr("Save the changes to %1 graphs?").arg(unsaved.size()),
                  QMessageBox::SaveAll | QMessageBox::Discard | QMessageBox::Cancel, this);
  QStringList listed = names.mid(0, most_listed);
  if (names.size() > most_listed) listed << tr("… and %1 more").arg(names.size() - most_listed);
  box.setInformativeText(listed.join('\n') + "\n\n" + tr("Without saving their changes are lost."));
  box.button(QMessageBox::SaveAll)->setText(tr("Save all"));
  box.button(QMessageBox::Discard)->setText(tr("Discard all"));
  box.setDefaultButton(QMessageBox::SaveAll);
  const int answer = ask(box);
  if (answer == QMessageBox::SaveAll) return all([this] { return session_.is_read_only() || save(); });
  return answer == QMessageBox::Discard && all([this] {
           session_.discard_autosave();
           return true;
         });
}

void MainWindow::open_inside(const std::string& name) {
  const auto node = session_.document().nodes.find(name);
  if (node == session_.document().nodes.end() || !node->second.nested) return;
  const QString path = QString::fromStdString(node->second.nested->path);
  if (path.isEmpty() || !QFile::exists(path)) {
    notice_->say(NoticeBar::Kind::warning,
                 tr("%1 names no graph file that is there; choose one among its parameters.")
                     .arg(QString::fromStdString(name)),
                 {}, 8);
    return;
  }
  if (!open_page_of(path)) return;
  canvas_->frame_all();
  canvas_->setFocus();
}

void MainWindow::collapse_selected() {
  if (session_.selected().empty() || session_.is_read_only()) return;
  const std::vector<std::string> names(session_.selected().begin(), session_.selected().end());
  // What can't be collapsed is said before a file is asked for.
  CollapseOptions options{"part.kg.json", session_.folder().toStdString(), session_.folder().toStdString()};
  if (!session_.perform([&](const Document& document, const Registry& registry) {
        collapse(document, registry, names, options);
        return Edit{};
      }))
    return;
  QString path =
      ask_where_to_save(this, tr("The new graph file"), QDir(session_.folder()).filePath("part.kg.json"),
                        tr("Kinegraph graphs (*.kg.json)"));
  if (path.isEmpty()) return;
  if (!path.endsWith(".kg.json")) path += ".kg.json";
  options.file = session_.written_path(path).toStdString();
  options.inner_folder = QFileInfo(path).absolutePath().toStdString();
  std::string made;
  session_.perform([&](const Document& document, const Registry& registry) {
    Collapsed collapsed = collapse(document, registry, names, options);
    write_file_atomically(path.toStdString(), write_document(collapsed.inside, registry));
    made = collapsed.node;
    return collapsed.edit;
  });
  if (!made.empty()) session_.select({made}, made);
}

bool MainWindow::save_what_is_inside() {
  const std::vector<int> pages = session_.modified_inside();
  if (pages.empty() || !options_.ask) return true;
  QStringList names;
  for (int page : pages) names << session_.page_title(page);
  QMessageBox box(QMessageBox::Question, tr("Kinegraph"), tr("Save %1 before running?").arg(names.join(", ")),
                  QMessageBox::Save | QMessageBox::Ignore | QMessageBox::Cancel, this);
  box.button(QMessageBox::Ignore)->setText(tr("Run unsaved"));
  box.setInformativeText(
      tr("It lies inside this graph and has changes that are not saved: what runs here "
         "would differ from what “kinegraph run” gives."));
  box.setDefaultButton(QMessageBox::Save);
  const int answer = ask(box);
  if (answer == QMessageBox::Cancel) return false;
  if (answer == QMessageBox::Ignore) return true;
  const int shown = session_.page();
  bool saved = true;
  for (int page : pages) {
    session_.show_page(page);
    saved = save() && saved;
  }
  session_.show_page(shown);
  return saved;
}

}  // namespace kinegraph
