// The editor's window: the canvas in the middle, docks around it, menus, toolbar, status bar; opening and
// saving. It tells Evaluation what is looked at, and holds no logic of graphs.
#pragma once
#include <QFileSystemWatcher>
#include <QMainWindow>
#include <functional>
#include <vector>

#include "gui/canvas/graph_canvas.h"
#include "gui/document/known_files.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/icons.h"
#include "gui/look/theme.h"
#include "gui/viewing/playback.h"
#include "gui/window/notice_bar.h"
#include "gui/window/state_line.h"

class QDockWidget;
class QLabel;
class QProgressBar;
class QTabBar;

namespace kinegraph {

struct ActionRow;
struct Merge;
class Welcome;

class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  struct Options {
    bool remember = true;      // layout, theme and recent files, per user
    bool ask = true;           // dialogs may open (not for a screenshot)
    std::string cache_folder;  // "" = none
  };
  MainWindow(const Registry& registry, const Options& options);
  ~MainWindow() override;

  Session& session() { return session_; }
  Evaluation& evaluation() { return evaluation_; }
  Playback& playback() { return playback_; }
  GraphCanvas& canvas() { return *canvas_; }
  const Theme& theme() const { return *theme_; }

  bool open(const QString& path);  // false: it can't be opened, and the person was told
  void offer_autosave();           // of the shown graph, where there is one
  void set_theme(const Theme& theme);
  void show_dock(const QString& name);  // "Parameters"
  QStringList dock_names() const;
  QAction* action(const QString& name) const;  // "undo": all have one
  bool is_evaluating() const { return evaluation_due_ || evaluation_.is_busy(); }

  // Looks at what the docks and the selection want to see.
  void evaluate();

 signals:
  void theme_changed();

 protected:
  void closeEvent(QCloseEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  // A dock with a widget, which may have set_theme(const Theme&), wanted() and wanted_changed.
  template <class Room>
  QDockWidget* add_room(Room* room, const QString& title, Qt::DockWidgetArea area);
  QDockWidget* add_dock(QWidget* widget, const QString& title, Qt::DockWidgetArea area);
  QDockWidget* dock(const QString& name) const;
  void make_docks();
  void make_actions();
  void make_menus();
  void make_action(const ActionRow& row, std::function<void()> act);
  void update_actions();
  void finish_typing();  // what stands in a line is taken as if Enter were pressed
  void update_title();
  void update_progress();
  void update_icons();
  void update_pages();
  void update_dock_titles();
  void usual_layout();
  void size_docks();
  void go_to_dock(const QString& name);

  bool open_page_of(const QString& path);  // false: it can't be, and the person was told, or cancelled it
  void cancel_work();
  void new_graph();
  void choose_and_open();
  bool save();
  bool save_as();
  bool may_discard();  // asks about unsaved changes of the shown graph
  bool may_discard_all();
  void close_page(int page);
  void open_inside(const std::string& node);  // a Graph node's file, in a page
  void collapse_selected();
  void relink();  // looks for files that are missing
  void offer_missing_files();
  bool save_what_is_inside();  // false: the person would rather not run
  void look_at_changed_files();
  void look_at_own_file();
  void offer_merge(const std::string& now);
  void offer_what_is_there(const std::string& now);
  void say_conflicts(const Merge& merged, const Document& theirs);
  // The file isn't what was read or saved here: offers to merge rather than to write over it.
  bool changed_by_others();
  void run_effects();
  void ran_effects();
  void remember_recent(const QString& path);
  QStringList recent() const;  // graphs that were open and are there, the last one first
  void fill_recent(QMenu* menu);
  void tell(const Diagnostics& problems, const QString& title, const QString& advice = {});
  // Why it couldn't be saved; true: it was saved elsewhere.
  bool tell_unsaved(const Failure& failure, const QString& name);
  void watch_files();
  void watch_other_files();  // where an edit names others
  QStringList files_behind(const Document& document, const QString& folder);
  void file_changed_on_disk(const QString& path);
  void about();
  void show_keys();

  const Registry& registry_;
  Options options_;
  Session session_;
  Evaluation evaluation_;
  Playback playback_;
  const Theme* theme_;
  GraphCanvas* canvas_;
  QTabBar* page_tabs_;
  Welcome* welcome_;
  NoticeBar* notice_;
  StateLine* state_;
  QLabel* hover_text_;
  QProgressBar* progress_;
  std::map<QString, QAction*> actions_;
  std::vector<QDockWidget*> docks_;
  std::vector<std::function<void(const Theme&)>> themed_;
  std::vector<std::function<std::vector<Target>()>> wants_;
  QFileSystemWatcher watcher_;
  QTimer reload_, slow_;
  KnownFiles known_files_;
  QStringList watched_for_;  // by what is open
  std::map<const Document*, std::pair<std::weak_ptr<const Document>, QStringList>> read_inside_;
  bool laid_out_ = false;  // the docks have their sizes
  bool is_slow_ = false;   // what is evaluated takes long enough to be shown
  bool evaluation_due_ = false, progress_due_ = false, inside_changed_ = false;
  bool own_changed_ = false, clip_changed_ = false;  // on disk, since it was looked at
};

}  // namespace kinegraph
