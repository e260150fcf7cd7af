// The actions of the table, bound to what does them; menus and toolbar.
#include <QApplication>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPointer>
#include <QToolBar>
#include <QToolButton>

#include "gui/look/actions.h"
#include "gui/look/words.h"
#include "gui/window/keys_dialog.h"
#include "gui/window/main_window.h"

namespace kinegraph {

void MainWindow::make_action(const ActionRow& row, std::function<void()> act) {
  auto* made = new QAction(tr(row.text), this);
  made->setObjectName(QString("action_") + row.name);
  const QKeySequence keys(row.keys);
  made->setShortcut(keys);
  made->setToolTip(QString("%1 (%2)").arg(tr(row.what), keys.toString(QKeySequence::NativeText)));
  made->setStatusTip(tr(row.what));
  // Saving, running or another page come after what was typed, which is in a line until it loses the
  // keyboard.
  connect(made, &QAction::triggered, this, [this, act = std::move(act)] {
    finish_typing();
    act();
  });
  if (row.where == ActionRow::Where::graph) {
    // Keys of one letter belong to the canvas alone.
    made->setShortcutContext(Qt::WidgetShortcut);
    canvas_->addAction(made);
  } else {
    addAction(made);
  }
  actions_[row.name] = made;
}

void MainWindow::finish_typing() {
  const QPointer<QWidget> line = QApplication::focusWidget();
  if (!line || !isAncestorOf(line)) return;
  if (!qobject_cast<QLineEdit*>(line) && !qobject_cast<QPlainTextEdit*>(line)) return;
  line->clearFocus();
  if (line && line->isVisible()) line->setFocus(Qt::OtherFocusReason);
}

QAction* MainWindow::action(const QString& name) const {
  auto found = actions_.find(name);
  return found == actions_.end() ? nullptr : found->second;
}

void MainWindow::make_actions() {
  GraphCanvas* c = canvas_;
  const auto go = [this](const char* dock) { return [this, dock] { go_to_dock(dock); }; };
  const std::map<std::string, std::function<void()>> acts = {
      {"new", [this] { new_graph(); }},
      {"open", [this] { choose_and_open(); }},
      {"save", [this] { save(); }},
      {"save_as", [this] { save_as(); }},
      {"relink", [this] { relink(); }},
      {"close_page", [this] { close_page(session_.page()); }},
      {"quit", [this] { close(); }},
      {"undo", [this] { canvas_->give_up_gesture() ? void() : session_.undo(); }},
      {"redo", [this] { canvas_->give_up_gesture() ? void() : session_.redo(); }},
      {"cut", [c] { c->cut_selected(); }},
      {"copy", [c] { c->copy_selected(); }},
      {"paste", [c] { c->paste(); }},
      {"duplicate", [c] { c->duplicate(); }},
      {"delete", [c] { c->remove_selected(); }},
      {"select_all", [c] { c->select_all(); }},
      {"find", [c] { c->find_node(); }},
      {"add", [c] { c->add_by_search(); }},
      {"link", [c] { c->link_by_search(); }},
      {"take_out", [c] { c->take_out_selected(); }},
      {"rename", [c] { c->rename_selected(); }},
      {"enable", [c] { c->toggle_enabled(); }},
      {"color", [c] { c->choose_color(); }},
      {"note", [c] { c->add_note(); }},
      {"group", [c] { c->group_in_frame(); }},
      {"collapse", [this] { collapse_selected(); }},
      {"open_inside", [this] { open_inside(session_.current()); }},
      {"arrange", [c] { c->arrange(); }},
      {"run", [this] { run_effects(); }},
      {"cancel", [this] { cancel_work(); }},
      {"frame", [c] { c->frame_selected(); }},
      {"frame_all", [c] { c->frame_all(); }},
      {"zoom_in", [c] { c->zoom_at(QRectF(c->rect()).center(), 1); }},
      {"zoom_out", [c] { c->zoom_at(QRectF(c->rect()).center(), -1); }},
      {"next_page", [this] { session_.show_page((session_.page() + 1) % session_.pages()); }},
      {"previous_page",
       [this] { session_.show_page((session_.page() + session_.pages() - 1) % session_.pages()); }},
      {"go_graph", [c] { c->setFocus(Qt::ShortcutFocusReason); }},
      {"go_viewer", go("Viewer")},
      {"go_timeline", go("Timeline")},
      {"go_parameters", go("Parameters")},
      {"go_components", go("Components")},
      {"go_curves", go("Curves")},
      {"go_problems", go("Problems")},
      {"go_files", go("Files")},
      {"play", [this] { playback_.toggle(); }},
      {"theme", [this] { set_theme(theme_->dark ? light_theme() : dark_theme()); }},
      {"reset_layout", [this] { usual_layout(); }},
      {"keys", [this] { show_keys(); }},
      {"about", [this] { about(); }},
  };
  for (const ActionRow& row : all_actions())
    if (const auto act = acts.find(row.name); act != acts.end()) make_action(row, act->second);
  actions_.at("redo")->setShortcuts({actions_.at("redo")->shortcut(), QKeySequence("Ctrl+Y")});
}

void MainWindow::make_menus() {
  std::map<std::string, QMenu*> menus;
  for (const ActionRow& row : all_actions()) {
    if (!*row.menu) continue;
    QMenu*& menu = menus[row.menu];
    if (!menu) {
      menu = menuBar()->addMenu("&" + tr(row.menu));
      menu->setAccessibleName(tr(row.menu));
    }
    if (row.after_line) menu->addSeparator();
    menu->addAction(actions_.at(row.name));
  }
  auto* recent = new QMenu(tr("Open &recent"), this);
  connect(recent, &QMenu::aboutToShow, this, [this, recent] { fill_recent(recent); });
  menus["File"]->insertMenu(menus["File"]->actions().at(2), recent);
  QMenu* docks = menus["View"]->addMenu(tr("&Docks"));
  for (QDockWidget* dock : docks_) docks->addAction(dock->toggleViewAction());

  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName("tools");
  bar->setMovable(false);
  bar->setIconSize({16, 16});
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar->setContextMenuPolicy(Qt::PreventContextMenu);
  const auto add_tool = [&](const char* name, const QString& text) {
    actions_.at(name)->setIconText(text);
    bar->addAction(actions_.at(name));
    if (QWidget* button = bar->widgetForAction(actions_.at(name))) {
      button->setFocusPolicy(Qt::TabFocus);
      button->setAccessibleName(text);
      button->setObjectName(QString("tool_") + name);
    }
  };
  add_tool("run", tr("Run"));
  add_tool("cancel", tr("Cancel"));
  bar->addSeparator();
  add_tool("undo", tr("Undo"));
  add_tool("redo", tr("Redo"));
  bar->addSeparator();
  add_tool("add", tr("Add"));
  add_tool("arrange", tr("Arrange"));
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(gap);
  add_tool("theme", tr("Theme"));
}

void MainWindow::update_icons() {
  const std::pair<const char*, Sign> signs[] = {
      {"run", Sign::run},   {"cancel", Sign::stop}, {"undo", Sign::undo},       {"redo", Sign::redo},
      {"add", Sign::add},   {"theme", Sign::theme}, {"arrange", Sign::tree},    {"new", Sign::new_file},
      {"open", Sign::open}, {"save", Sign::save},   {"frame_all", Sign::frame}, {"keys", Sign::keys},
      {"about", Sign::info}};
  for (const auto& [name, sign] : signs) actions_.at(name)->setIcon(icon(sign, *theme_));
  actions_.at("theme")->setText(theme_->dark ? tr("Light th&eme") : tr("Dark th&eme"));
  actions_.at("theme")->setIconText(theme_->dark ? tr("Light") : tr("Dark"));
}

void MainWindow::update_actions() {
  const auto step = [this](const char* name, const QString& verb, bool can, const Edit* edit) {
    actions_.at(name)->setEnabled(can);
    actions_.at(name)->setText(can && edit ? verb + ": " + QString::fromStdString(edit->title) : verb);
    actions_.at(name)->setIconText(QString(verb).remove('&'));
  };
  const History& history = session_.history();
  step("undo", tr("&Undo"), session_.can_undo(),
       history.can_undo() ? &history.steps()[history.position() - 1] : nullptr);
  step("redo", tr("&Redo"), session_.can_redo(),
       history.can_redo() ? &history.steps()[history.position()] : nullptr);
  const bool writable = !session_.is_read_only();
  const bool chosen = writable && !session_.selected().empty();
  for (const char* name : {"cut", "copy", "duplicate", "enable", "color", "group", "take_out", "collapse"})
    actions_.at(name)->setEnabled(chosen);
  for (const char* name : {"rename", "link"})
    actions_.at(name)->setEnabled(writable && !session_.current().empty());
  for (const char* name : {"add", "arrange", "paste"}) actions_.at(name)->setEnabled(writable);
  const auto current = session_.document().nodes.find(session_.current());
  actions_.at("open_inside")
      ->setEnabled(current != session_.document().nodes.end() && current->second.nested != nullptr);
  for (const char* name : {"next_page", "previous_page"}) actions_.at(name)->setEnabled(session_.pages() > 1);
  for (const char* name : {"run", "save", "save_as"}) actions_.at(name)->setEnabled(writable);
}

void MainWindow::show_keys() {
  KeysDialog(*theme_, this).exec();
}

void MainWindow::about() {
  const QString version = QApplication::applicationVersion();
  QMessageBox box(QMessageBox::Information, tr("About Kinegraph"),
                  version.isEmpty() ? tr("Kinegraph") : tr("Kinegraph %1").arg(version), QMessageBox::Close,
                  this);
  box.setInformativeText(
      tr("A compositor for character motion: graphs of nodes over captured and made clips. The same graphs "
         "run here and with “kinegraph run”."));
  ask(box);
}

}  // namespace kinegraph
