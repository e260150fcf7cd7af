// Every command with its name, key and place in menus and toolbar.
#include <QDockWidget>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>
#include <QToolButton>

#include "gui/window/main_window.h"

namespace kinegraph {

QAction* MainWindow::make(const QString& name, const QString& text, const QKeySequence& key,
                          std::function<void()> act, QWidget* where) {
  auto* made = new QAction(text, this);
  made->setObjectName("action_" + name);
  if (!key.isEmpty()) made->setShortcut(key);
  QString plain = text;
  plain.remove('&').remove("…");
  made->setToolTip(key.isEmpty() ? plain
                                 : QString("%1 (%2)").arg(plain, key.toString(QKeySequence::NativeText)));
  connect(made, &QAction::triggered, this, [act = std::move(act)] { act(); });
  if (where) {
    // Keys of one letter belong to the canvas alone.
    made->setShortcutContext(Qt::WidgetShortcut);
    where->addAction(made);
  } else {
    addAction(made);
  }
  actions_[name] = made;
  return made;
}

QAction* MainWindow::action(const QString& name) const {
  auto found = actions_.find(name);
  return found == actions_.end() ? nullptr : found->second;
}

void MainWindow::make_actions() {
  GraphCanvas* c = canvas_;
  make("new", tr("&New"), QKeySequence::New, [this] { new_graph(); });
  make("open", tr("&Open…"), QKeySequence::Open, [this] { choose_and_open(); });
  make("save", tr("&Save"), QKeySequence::Save, [this] { save(); });
  make("save_as", tr("Save &as…"), QKeySequence("Ctrl+Shift+S"), [this] { save_as(); });
  make("quit", tr("&Quit"), QKeySequence("Ctrl+Q"), [this] { close(); });
  make("undo", tr("&Undo"), QKeySequence::Undo, [this] { session_.undo(); });
  make("redo", tr("&Redo"), QKeySequence("Ctrl+Shift+Z"), [this] { session_.redo(); });
  make("run", tr("&Run"), QKeySequence("F5"), [this] { run_effects(); });
  make("cancel", tr("&Cancel"), QKeySequence("Ctrl+."), [this] { evaluation_.cancel(); });
  make("theme", tr("Light &theme"), QKeySequence("Ctrl+T"),
       [this] { set_theme(theme_->dark ? light_theme() : dark_theme()); });
  make("canvas", tr("Go to the graph"), QKeySequence("Ctrl+1"),
       [this] { canvas_->setFocus(Qt::ShortcutFocusReason); });
  make("keys", tr("&Keys and mouse"), QKeySequence::HelpContents, [this] { show_keys(); });
  make("about", tr("&About Kinegraph"), {}, [this] { about(); });

  make(
      "add", tr("&Add a node…"), QKeySequence("Shift+A"), [c] { c->add_by_search(); }, c);
  make(
      "delete", tr("&Delete, reconnecting"), QKeySequence::Delete, [c] { c->remove_selected(); }, c);
  make(
      "cut", tr("Cu&t"), QKeySequence::Cut, [c] { c->cut_selected(); }, c);
  make(
      "copy", tr("&Copy"), QKeySequence::Copy, [c] { c->copy_selected(); }, c);
  make(
      "paste", tr("&Paste"), QKeySequence::Paste, [c] { c->paste(); }, c);
  make(
      "duplicate", tr("Du&plicate"), QKeySequence("Ctrl+D"), [c] { c->duplicate(); }, c);
  make(
      "select_all", tr("Select &all"), QKeySequence::SelectAll, [c] { c->select_all(); }, c);
  make(
      "rename", tr("Re&name…"), QKeySequence("F2"), [c] { c->rename_selected(); }, c);
  make(
      "enable", tr("&Disable or enable"), QKeySequence("D"), [c] { c->toggle_enabled(); }, c);
  make(
      "color", tr("&Colour…"), QKeySequence("C"), [c] { c->choose_color(); }, c);
  make(
      "note", tr("&Note"), QKeySequence("N"), [c] { c->add_note(); }, c);
  make(
      "group", tr("&Group in a frame"), QKeySequence("G"), [c] { c->group_in_frame(); }, c);
  make(
      "link", tr("&Link to…"), QKeySequence("L"), [c] { c->link_by_search(); }, c);
  make(
      "take_out", tr("Take &out of its links"), QKeySequence("X"), [c] { c->take_out_selected(); }, c);
  make(
      "arrange", tr("A&rrange"), QKeySequence("Ctrl+L"), [c] { c->arrange(); }, c);
  make(
      "find", tr("&Find a node…"), QKeySequence::Find, [c] { c->find_node(); }, c);
  make(
      "frame", tr("Show &selection"), QKeySequence("F"), [c] { c->frame_selected(); }, c);
  make(
      "frame_all", tr("Show &all"), QKeySequence("A"), [c] { c->frame_all(); }, c);
}

void MainWindow::make_menus() {
  const auto fill = [this](QMenu* menu, const QStringList& names) {
    for (const QString& name : names)
      if (name.isEmpty())
        menu->addSeparator();
      else
        menu->addAction(actions_.at(name));
  };
  QMenu* file = menuBar()->addMenu(tr("&File"));
  fill(file, {"new", "open"});
  QMenu* recent = file->addMenu(tr("Open &recent"));
  connect(recent, &QMenu::aboutToShow, this, [this, recent] { fill_recent(recent); });
  fill(file, {"", "save", "save_as", "", "quit"});
  fill(menuBar()->addMenu(tr("&Edit")),
       {"undo", "redo", "", "cut", "copy", "paste", "duplicate", "delete", "", "select_all", "find"});
  fill(menuBar()->addMenu(tr("&Graph")), {"add", "link", "take_out", "rename", "", "enable", "color", "note",
                                          "group", "", "arrange", "", "run", "cancel"});
  QMenu* view = menuBar()->addMenu(tr("&View"));
  fill(view, {"frame", "frame_all", "canvas", "", "theme", ""});
  for (QDockWidget* dock : docks_) view->addAction(dock->toggleViewAction());
  fill(menuBar()->addMenu(tr("&Help")), {"keys", "about"});

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
      {"run", Sign::run}, {"cancel", Sign::stop}, {"undo", Sign::undo},   {"redo", Sign::redo},
      {"add", Sign::add}, {"theme", Sign::theme}, {"arrange", Sign::tree}};
  for (const auto& [name, sign] : signs) {
    actions_.at(name)->setIcon(icon(sign, *theme_));
    actions_.at(name)->setIconVisibleInMenu(false);
  }
  actions_.at("theme")->setText(theme_->dark ? tr("Light &theme") : tr("Dark &theme"));
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
  const bool chosen = !session_.selected().empty();
  for (const char* name : {"cut", "copy", "duplicate", "enable", "color", "group", "take_out"})
    actions_.at(name)->setEnabled(chosen);
  for (const char* name : {"rename", "link"}) actions_.at(name)->setEnabled(!session_.current().empty());
  actions_.at("run")->setEnabled(!session_.is_read_only());
  actions_.at("save")->setEnabled(!session_.is_read_only());
  actions_.at("save_as")->setEnabled(!session_.is_read_only());
}

void MainWindow::show_keys() {
  static const std::pair<const char*, const char*> rows[] = {
      {"Tab, double-click", "add a node"},
      {"Drag from a port", "link; let go on empty space to choose a node that fits"},
      {"Drop a node on a wire", "insert it"},
      {"Alt+drag a node", "take it out of its links"},
      {"Ctrl+drag", "cut the links that are crossed"},
      {"Ctrl+click on a wire", "put a dot there"},
      {"Wheel, + and −", "zoom"},
      {"Middle button, Space+drag", "pan"},
      {"Arrow keys", "walk along links; with Ctrl: move the selection"},
      {"F, A", "show the selection, show all"},
      {"D, C, N, G", "disable, colour, note, group in a frame"},
      {"L, X", "link to another node, take out of links"},
      {"F2", "rename"},
      {"Ctrl+F", "find a node"},
      {"Ctrl+L", "arrange"},
      {"F5, Ctrl+.", "run Exports and Checks, cancel"},
  };
  QString text = "<table cellspacing=6>";
  for (const auto& [keys, what] : rows)
    text += QString("<tr><td><b>%1</b></td><td>%2</td></tr>").arg(tr(keys), tr(what));
  QMessageBox box(QMessageBox::NoIcon, tr("Keys and mouse"), text + "</table>", QMessageBox::Close, this);
  box.exec();
}

void MainWindow::about() {
  QMessageBox::about(
      this, tr("About Kinegraph"),
      tr("<b>Kinegraph</b><br>A compositor for character motion. The same graphs run here and with "
         "<tt>kinegraph run</tt>."));
}

}  // namespace kinegraph
