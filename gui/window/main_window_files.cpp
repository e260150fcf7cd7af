// Opening, saving, running.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>

#include "graph/nested.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/document/problem_text.h"
#include "gui/look/ask_file.h"
#include "gui/look/settings.h"
#include "gui/look/words.h"
#include "gui/window/main_window.h"
#include "gui/window/wait_aside.h"

namespace kinegraph {
namespace {

constexpr int recent_files = 12;
constexpr std::size_t most_listed = 12;  // problems in a dialog

QString graph_filter() {
  return QObject::tr("Kinegraph graphs (*.kg.json);;All files (*)");
}

QString with_capital(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

// Where each is, what it is and what to do; the file they are in goes without saying.
QString listed(const Diagnostics& problems) {
  QString text;
  for (std::size_t i = 0; i < problems.size() && i < most_listed; ++i) {
    const QString where = place_of(problems[i]), advice = advice_on(problems[i]);
    text += (where.isEmpty() ? "" : (problems[i].node.empty() ? with_capital(where) : where) + ": ") +
            problem_text(problems[i]) + (advice.isEmpty() ? "" : " " + advice) + "\n";
  }
  if (problems.size() > most_listed)
    text +=
        QObject::tr("… and %1 more; the Problems dock lists them all.").arg(problems.size() - most_listed);
  return text.trimmed();
}

// A person's own folder is "~".
QString short_folder(const QString& folder) {
  const QString home = QDir::homePath();
  return folder == home || folder.startsWith(home + "/") ? "~" + folder.mid(home.size())
                                                         : QDir::toNativeSeparators(folder);
}

}  // namespace

void MainWindow::tell(const Diagnostics& problems, const QString& title, const QString& advice) {
  if (problems.empty()) return;
  if (!options_.ask || !isVisible()) {
    notice_->say(NoticeBar::Kind::error, title + "\n" + listed(problems));
    return;
  }
  QMessageBox box(QMessageBox::Warning, tr("Kinegraph"), title, QMessageBox::Close, this);
  box.setInformativeText(listed(problems) + (advice.isEmpty() ? QString() : "\n\n" + advice));
  const QString file = QString::fromStdString(problems.front().file);
  for (QLabel* label : box.findChildren<QLabel*>()) label->setToolTip(QDir::toNativeSeparators(file));
  ask(box);
}

bool MainWindow::tell_unsaved(const Failure& failure, const QString& name) {
  const Diagnostic& problem = failure.diagnostic();
  const QString title = tr("%1 can't be saved.").arg(name);
  if (!options_.ask || !isVisible() || session_.is_read_only()) {
    tell({problem}, title);
    return false;
  }
  QMessageBox box(QMessageBox::Warning, tr("Kinegraph"), title, QMessageBox::Save | QMessageBox::Close, this);
  box.setInformativeText(problem_text(problem) + " " + advice_on(problem) + " " +
                         tr("What is open here is kept."));
  box.button(QMessageBox::Save)->setText(tr("Save elsewhere…"));
  return ask(box) == QMessageBox::Save && save_as();
}

bool MainWindow::open_page_of(const QString& path) {
  if (session_.show_page_of(path)) return true;
  const QString name = QFileInfo(path).fileName();
  GraphFile file;
  if (!wait_aside(options_.ask && isVisible() ? this : nullptr, tr("Opening %1").arg(name),
                  [&, open = session_.modified_pages()](const StopToken& stop) {
                    file = read_graph_file(path, registry_, open, stop);
                  }))
    return false;
  // In a page of its own, unless nothing was begun in the shown one.
  const bool untouched =
      session_.path().isEmpty() && session_.document().nodes.empty() && !session_.is_modified();
  const Diagnostics problems =
      untouched ? session_.open(std::move(file)) : session_.open_page(std::move(file));
  if (!has_error(problems)) return true;
  tell(problems, tr("%1 can't be opened.").arg(name),
       QFileInfo(path).isFile()
           ? tr("The file is left as it is: mend it in a text editor, or take an earlier copy.")
           : QString());
  show_dock("Problems");
  return false;
}

bool MainWindow::open(const QString& path) {
  if (!open_page_of(path)) return false;
  watch_files();
  remember_recent(session_.path());
  canvas_->frame_all();
  notice_->hide();
  if (session_.is_read_only())
    notice_->say(NoticeBar::Kind::warning,
                 tr("%1 was made by a newer Kinegraph and can only be looked at. Update Kinegraph to work on "
                    "it.")
                     .arg(session_.title()));
  if (session_.is_open_elsewhere())
    notice_->say(NoticeBar::Kind::warning,
                 tr("%1 is open in another editor as well. What is saved there can be merged in here.")
                     .arg(session_.title()));
  offer_missing_files();
  offer_autosave();
  return true;
}

void MainWindow::offer_autosave() {
  if (!session_.autosave_found() || session_.is_read_only()) return;
  session_.keep_found();
  notice_->say(
      NoticeBar::Kind::info,
      tr("Unsaved work on %1 was found, of a session that ended unexpectedly.").arg(session_.title()),
      {{tr("Take it up"),
        [this] {
          tell(session_.recover(), tr("The work that was found can't be read."));
          canvas_->frame_all();
        }},
       {tr("Throw it away"), [this] {
          session_.discard_found();
          if (!session_.is_modified()) offer_autosave();  // several sessions may have left theirs
        }}});
}

void MainWindow::new_graph() {
  session_.new_page();
  watch_files();
  canvas_->frame_all();
  canvas_->setFocus();
}

void MainWindow::choose_and_open() {
  const QString path = ask_to_open(this, tr("Open a graph"), session_.folder(), graph_filter());
  if (!path.isEmpty()) open(path);
}

bool MainWindow::save() {
  if (session_.path().isEmpty()) return save_as();
  if (changed_by_others()) return false;
  try {
    session_.save();
    notice_->done_with("disk");
    watch_files();
    statusBar()->showMessage(tr("Saved"), 2000);
    return true;
  } catch (const Failure& failure) {
    return tell_unsaved(failure, session_.title());
  }
}

bool MainWindow::save_as() {
  QString path = ask_where_to_save(
      this, tr("Save the graph"),
      session_.path().isEmpty() ? session_.folder() + "/untitled.kg.json" : session_.path(), graph_filter());
  if (path.isEmpty()) return false;
  if (!path.endsWith(".kg.json")) path += path.endsWith(".kg") ? ".json" : ".kg.json";
  try {
    session_.save_as(path);
    notice_->done_with("disk");
    watch_files();
    remember_recent(session_.path());
    return true;
  } catch (const Failure& failure) {
    return tell_unsaved(failure, QFileInfo(path).fileName());
  }
}

bool MainWindow::may_discard() {
  const bool gone = !session_.path().isEmpty() && !QFile::exists(session_.path());
  if ((!session_.is_modified() && !gone) || session_.is_read_only() || !options_.ask) return true;
  QMessageBox box(QMessageBox::Question, tr("Kinegraph"),
                  gone ? tr("Save %1 again? It is not on the disk any more.").arg(session_.title())
                       : tr("Save the changes to %1?").arg(session_.title()),
                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
  box.setInformativeText(tr("Without saving they are lost."));
  box.setDefaultButton(QMessageBox::Save);
  switch (ask(box)) {
    case QMessageBox::Save:
      return save();
    case QMessageBox::Discard:
      session_.discard_autosave();
      return true;
    default:
      return false;
  }
}

void MainWindow::remember_recent(const QString& path) {
  if (!options_.remember) return;
  const auto settings = user_settings();
  QStringList recent = settings->value("recent").toStringList();
  recent.removeAll(path);
  recent.prepend(path);
  settings->setValue("recent", QStringList(recent.mid(0, recent_files)));
}

QStringList MainWindow::recent() const {
  QStringList there;
  if (!options_.remember) return there;
  for (const QString& path : user_settings()->value("recent").toStringList())
    if (QFile::exists(path)) there << path;
  return there;
}

// Names first, folders beside them, as keys stand beside actions.
void MainWindow::fill_recent(QMenu* menu) {
  menu->clear();
  for (const QString& path : recent()) {
    const QFileInfo file(path);
    const QString folder =
        menu->fontMetrics().elidedText(short_folder(file.absolutePath()), Qt::ElideMiddle, 320);
    menu->addAction(file.fileName().replace("&", "&&") + "\t" + folder, this, [this, path] { open(path); });
  }
  if (menu->isEmpty()) {
    menu->addAction(tr("No graph was opened yet"))->setEnabled(false);
    return;
  }
  menu->addSeparator();
  menu->addAction(tr("&Clear this list"), this, [] { user_settings()->remove("recent"); });
}

void MainWindow::run_effects() {
  if (has_error(session_.problems())) {
    show_dock("Problems");
    notice_->say(NoticeBar::Kind::error,
                 tr("The graph has problems that keep it from running; the Problems dock lists them."), {},
                 8);
    return;
  }
  if (!save_what_is_inside()) return;
  if (session_.is_reading_inside()) {
    notice_->say(NoticeBar::Kind::info,
                 tr("The graph files inside are still being read; run once they are there."), {}, 8);
    return;
  }
  EvaluationRequest request;
  request.document = session_.document();
  request.file = session_.title().toStdString();
  request.folder = session_.folder().toStdString();
  request.effects = true;
  bool any = false;
  for (const auto& [name, node] : session_.document().nodes) {
    const NodeType* type = known_type(registry_, node);
    any |= type && type->effect != Effect::none && node.enabled;
  }
  if (!any) {
    notice_->say(
        NoticeBar::Kind::info,
        tr("There is nothing to run: Run does the Export and Check nodes. Add an Export to write a file."),
        {}, 8);
    return;
  }
  evaluation_.request(std::move(request));
}

void MainWindow::cancel_work() {
  evaluation_.cancel();
  if (!session_.is_reading_inside()) return;
  session_.stop_reading_inside();
  notice_->say(NoticeBar::Kind::warning,
               tr("Reading the graph files inside was cancelled: what needs them can't run yet."),
               {{tr("Read them"), [this] { session_.reopen_inside(); }}});
}

void MainWindow::ran_effects() {
  const RunLog& log = evaluation_.log();
  int passed = 0, failed_nodes = 0;
  QString text;
  for (const WrittenFile& file : log.files)
    text += tr("Wrote %1. ").arg(QDir(session_.folder()).relativeFilePath(QString::fromStdString(file.path)));
  for (const RuleRun& rule : log.rules) {
    if (rule.passed)
      ++passed;
    else
      text += tr("Check failed: %1 (measured %2). ")
                  .arg(QString::fromStdString(rule.rule))
                  .arg(rule.value, 0, 'g', 4);
  }
  if (passed) text += passed == 1 ? tr("1 check passed. ") : tr("%1 checks passed. ").arg(passed);
  for (const auto& [name, node] : log.nodes)
    failed_nodes += node.state == NodeState::failed || node.state == NodeState::blocked;
  for (const Diagnostic& problem : evaluation_.problems()) text += problem_text(problem) + " ";
  if (log.stopped) text = tr("The run was cancelled. ") + text;
  if (failed_nodes)
    text += failed_nodes == 1 ? tr("1 node failed or was blocked.")
                              : tr("%1 nodes failed or were blocked.").arg(failed_nodes);
  const bool wrong = failed_nodes || static_cast<std::size_t>(passed) < log.rules.size();
  notice_->say(log.stopped      ? NoticeBar::Kind::warning
               : wrong          ? NoticeBar::Kind::error
               : text.isEmpty() ? NoticeBar::Kind::info
                                : NoticeBar::Kind::good,
               text.isEmpty() ? tr("Nothing was written.") : text.trimmed(),
               failed_nodes
                   ? std::vector<NoticeBar::Answer>{{tr("Show problems"), [this] { show_dock("Problems"); }}}
                   : std::vector<NoticeBar::Answer>{});
}

}  // namespace kinegraph
