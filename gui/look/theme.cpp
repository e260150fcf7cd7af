#include "gui/look/theme.h"

#include <array>

namespace kinegraph {
namespace {

struct PortLook {
  std::string_view type;
  QRgb dark, light;
  Theme::Shape shape;
};
// Told apart by colour-blind eyes as well: lightness differs between neighbours, and every type has a shape.
constexpr std::array<PortLook, 8> ports{{
    {"Motion", 0xff5fb8e8, 0xff1b78ad, Theme::Shape::circle},
    {"Points", 0xffb5e36b, 0xff5c8a12, Theme::Shape::ring},
    {"Warp", 0xffe8b04a, 0xffa86e00, Theme::Shape::diamond},
    {"Stats", 0xffd58cf0, 0xff8a3aac, Theme::Shape::square},
    {"Components", 0xfff07f9b, 0xffb82e52, Theme::Shape::hexagon},
    {"Contacts", 0xff63d6b4, 0xff10806a, Theme::Shape::bar},
    {"Character", 0xfff2e08a, 0xff86740a, Theme::Shape::star},
    {"Metrics", 0xffb9bfd0, 0xff565c70, Theme::Shape::triangle},
}};

Theme make_dark() {
  Theme t;
  t.dark = true;
  t.window = 0xff1e2127;
  t.panel = 0xff262a31;
  t.raised = 0xff333842;
  t.line = 0xff3d434e;
  t.text = 0xffe4e7ec;
  t.faint_text = 0xffa8b0bc;
  t.accent = 0xff5aaaff;
  t.selection = 0xff2f5f94;
  t.canvas = 0xff191c21;
  t.grid = 0xff23272e;
  t.node = 0xff2c313a;
  t.node_title = 0xff39404c;
  t.node_line = 0xff0f1114;
  t.wire = 0xff8a93a1;
  t.still_ground = 0xff22262d;
  t.good = 0xff5ac57a;
  t.running = 0xff5aaaff;
  t.warning = 0xffe8b04a;
  t.error = 0xffff8a86;
  t.missing = 0xffdb92e8;
  t.ground = 0xff2a2e35;
  t.ground_line = 0xff3a404a;
  t.sky = 0xff20242b;
  t.bone = 0xffd9dde4;
  t.joint = 0xffaab2be;
  t.skin = 0xffbdd1e9;
  t.left = 0xff6fb7e9;
  t.right = 0xffeb8f6b;
  t.second = 0xff9fd48a;
  t.shadow = QColor(0, 0, 0, 110);
  t.stretch_short = 0xff86d92f;
  t.stretch_long = 0xfff0318f;
  return t;
}

Theme make_light() {
  Theme t;
  t.dark = false;
  t.window = 0xffeef0f3;
  t.panel = 0xfff8f9fb;
  t.raised = 0xffffffff;
  t.line = 0xffcdd2da;
  t.text = 0xff1d2229;
  t.faint_text = 0xff565f6c;
  t.accent = 0xff1463bd;
  t.selection = 0xffbcd8f7;
  t.canvas = 0xffe4e7ec;
  t.grid = 0xffd9dde3;
  t.node = 0xfffbfcfd;
  t.node_title = 0xffe9edf2;
  t.node_line = 0xffa9b1bd;
  t.wire = 0xff6c7683;
  t.still_ground = 0xffeef1f5;
  t.good = 0xff1a6e3c;
  t.running = 0xff1463bd;
  t.warning = 0xff855600;
  t.error = 0xffb92e2c;
  t.missing = 0xff8a3aac;
  t.ground = 0xffdfe3e8;
  t.ground_line = 0xffc6ccd4;
  t.sky = 0xfff1f3f6;
  t.bone = 0xff4a525e;
  t.joint = 0xff6a7480;
  t.skin = 0xffa9bbcf;
  t.left = 0xff1b78ad;
  t.right = 0xffb9562c;
  t.second = 0xff4d8a35;
  t.shadow = QColor(20, 30, 40, 60);
  t.stretch_short = 0xff4f9a00;
  t.stretch_long = 0xffd6006e;
  return t;
}

}  // namespace

QColor Theme::port(std::string_view type) const {
  for (const PortLook& look : ports)
    if (look.type == type) return QColor::fromRgb(dark ? look.dark : look.light);
  return wire;
}

Theme::Shape Theme::shape(std::string_view type) {
  for (const PortLook& look : ports)
    if (look.type == type) return look.shape;
  return Shape::circle;
}

QPalette Theme::palette() const {
  QPalette p;
  p.setColor(QPalette::Window, window);
  p.setColor(QPalette::WindowText, text);
  p.setColor(QPalette::Base, panel);
  p.setColor(QPalette::AlternateBase, raised);
  p.setColor(QPalette::Text, text);
  p.setColor(QPalette::PlaceholderText, faint_text);
  p.setColor(QPalette::Button, raised);
  p.setColor(QPalette::ButtonText, text);
  p.setColor(QPalette::BrightText, error);
  p.setColor(QPalette::ToolTipBase, raised);
  p.setColor(QPalette::ToolTipText, text);
  p.setColor(QPalette::Highlight, selection);
  p.setColor(QPalette::HighlightedText, text);
  p.setColor(QPalette::Link, accent);
  p.setColor(QPalette::Light, raised.lighter(115));
  p.setColor(QPalette::Midlight, raised);
  p.setColor(QPalette::Mid, line);
  p.setColor(QPalette::Dark, line.darker(120));
  p.setColor(QPalette::Shadow, shadow);
  for (auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    p.setColor(QPalette::Disabled, role, faint_text);
  return p;
}

QString Theme::style_sheet() const {
  const auto c = [](const QColor& color) { return color.name(); };
  // Of what can't be moved or chosen now, and of words on it: between faint ones and their ground.
  const QColor resting((faint_text.red() + window.red()) / 2, (faint_text.green() + window.green()) / 2,
                       (faint_text.blue() + window.blue()) / 2);
  return QString(R"(
QMainWindow::separator { background: %1; width: 4px; height: 4px; }
QMainWindow::separator:hover { background: %5; }
QDockWidget { font-weight: 600; color: %4; }
QDockWidget::title { background: %1; padding: 6px 8px; border-bottom: 1px solid %3; }
QDockWidget::float-button, QDockWidget::close-button { border: none; border-radius: 3px; padding: 1px; }
QDockWidget::float-button:hover, QDockWidget::close-button:hover { background: %2; }
QToolTip { background: %2; color: %4; border: 1px solid %3; padding: 4px; }
QMenuBar { background: %1; padding: 0px 6px; }
QMenuBar::item { padding: 4px 10px; background: transparent; border-radius: 3px; }
QMenuBar::item:selected, QMenu::item:selected { background: %6; color: %4; }
QMenu { background: %2; border: 1px solid %3; padding: 4px; }
QMenu::item { padding: 5px 32px 5px 12px; border-radius: 3px; min-height: 16px; }
QMenu::icon { padding-left: 8px; }
QMenu::separator { height: 1px; background: %3; margin: 4px 8px; }
QToolBar::separator { background: %3; width: 1px; margin: 6px 6px; }
QToolBar { background: %1; border: none; border-bottom: 1px solid %3; spacing: 4px; padding: 3px 6px; }
QToolButton { border: 1px solid transparent; border-radius: 4px; padding: 4px 8px; }
QToolBar#viewer_bar { spacing: 1px; padding: 3px 4px; }
QToolBar#viewer_bar > QToolButton { padding: 4px 4px; }
QToolButton:hover { background: %2; }
QToolButton:checked { background: %6; }
QToolButton:disabled, QToolButton:checked:disabled { background: transparent; }
QPushButton { background: %2; border: 1px solid %3; border-radius: 4px; padding: 5px 14px; }
QPushButton:hover { border-color: %5; }
QPushButton:default { background: %6; border-color: %6; }
QPushButton:disabled { color: %7; }
QLineEdit, QPlainTextEdit, QComboBox { background: %8; border: 1px solid %3; border-radius: 4px; padding: 3px 6px; selection-background-color: %6; }
QComboBox > QLineEdit { border: none; padding: 0px; margin: 0px; background: transparent; }
QComboBox:disabled { color: %13; background: transparent; }
QComboBox::drop-down { border: none; width: 18px; }
QComboBox::down-arrow { image: url(:/kinegraph/arrow_down.png); width: 10px; height: 10px; }
QComboBox QAbstractItemView { background: %2; border: 1px solid %3; selection-background-color: %6; outline: none; }
kinegraph--ParamField QToolButton { background: %2; border: 1px solid %3; padding: 3px 8px; }
kinegraph--ParamField QToolButton:hover { border-color: %5; }
QToolButton#row_menu { padding: 2px 0px; color: %7; }
QToolButton#row_menu:hover { color: %4; }
QFileDialog QToolButton { padding: 3px; }
QSplitter::handle { background: transparent; image: none; }
QPushButton:default:disabled { background: %2; border-color: %3; }
QLabel#faint, QLabel#unit { color: %7; }
QLabel#param_help { color: %7; border-top: 1px solid %3; padding-top: 6px; }
QLabel#node_state { background: %2; border-radius: 4px; padding: 6px 8px; }
QMessageBox QLabel#qt_msgbox_label { font-weight: 600; min-width: 300px; }
QMessageBox QLabel#qt_msgboxex_icon_label { margin: 2px 6px 0px 6px; }
QLineEdit#node_name { font-weight: 600; }
QFrame#search_box { background: %2; border: 1px solid %5; border-radius: 6px; }
QFrame#notice_bar { background: %8; border: none; border-left: 3px solid %5; }
QFrame#notice_bar[kind="good"] { border-left-color: %10; }
QFrame#notice_bar[kind="warning"] { border-left-color: %11; }
QFrame#notice_bar[kind="error"] { border-left-color: %12; }
QScrollArea#parameter_rows, QScrollArea#parameter_rows > QWidget > QWidget { background: transparent; }
QScrollArea#examples, QScrollArea#examples > QWidget > QWidget { background: transparent; }
QCheckBox, QRadioButton { spacing: 6px; padding: 2px; border: 1px solid transparent; border-radius: 3px; }
QRadioButton { margin: 3px 6px 3px 4px; }
QCheckBox:disabled, QRadioButton:disabled { color: %7; }
QCheckBox:focus, QRadioButton:focus { border-color: %5; }
QLineEdit:focus, QPlainTextEdit:focus, QComboBox:focus, QPushButton:focus, QToolButton:focus, QTreeView:focus, QListView:focus, QTableView:focus { border: 1px solid %5; }
QLineEdit[mistake="true"], QComboBox[mistake="true"], QTableView[mistake="true"] { border: 1px solid %12; }
QLineEdit[mistake="true"]:focus, QComboBox[mistake="true"]:focus, QTableView[mistake="true"]:focus { border: 2px solid %12; }
QLineEdit[mistake="true"]:focus { padding: 2px 5px; }
QLabel#param_mistake { color: %12; }
QTextBrowser { background: %8; border: 1px solid transparent; }
QTextBrowser:focus { border-color: %5; }
QSlider { border: 1px solid transparent; border-radius: 4px; min-height: 20px; }
QSlider:focus { border-color: %5; }
QSlider::groove:horizontal { height: 4px; border-radius: 2px; background: %3; margin: 0px 2px; }
QSlider::sub-page:horizontal { height: 4px; border-radius: 2px; background: %5; margin: 0px 2px; }
QSlider::handle:horizontal { width: 12px; height: 12px; margin: -5px 0px; border-radius: 6px; background: %9; border: 1px solid %7; }
QSlider::handle:horizontal:hover { border-color: %5; }
QSlider::sub-page:horizontal:disabled { background: %13; }
QSlider::handle:horizontal:disabled { background: %13; border-color: %13; }
QTreeView, QListView, QTableView { background: %8; border: 1px solid %3; border-radius: 4px; alternate-background-color: %2; }
QTableView { gridline-color: %3; }
QTreeView::item, QTableView::item { border: none; padding: 3px 8px; min-height: 16px; }
QTreeView::item:selected, QTableView::item:selected, QListView::item:selected { background: %6; color: %4; }
QTableView QLineEdit, QTreeView QLineEdit { padding: 0px 6px; border-radius: 0px; }
QTableView QComboBox { padding: 0px 6px; }
QFileDialog QHeaderView::up-arrow, QFileDialog QHeaderView::down-arrow { image: none; width: 0px; height: 0px; }
QFileDialog QListView#sidebar { padding: 4px 0px; }
QToolButton#notice_close { padding: 5px; }
QHeaderView { background: %1; }
QHeaderView::section { background: %1; color: %7; border: none; border-bottom: 1px solid %3; padding: 4px 11px; }
QTabBar::tab { padding: 6px 12px; border: none; border-bottom: 2px solid transparent; color: %7; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QTabBar::close-button { image: url(:/kinegraph/close.png); border-radius: 3px; margin: 1px 2px 4px 0px; }
QTabBar#pages::tab { padding-right: 4px; }
QTabBar::close-button:hover { background: %3; }
QTabBar#pages { background: %1; }
QTabBar::scroller { width: 44px; }
QTabBar::tear { width: 0px; border: none; }
QTabBar QToolButton { background: %1; border: 1px solid %3; border-radius: 3px; margin: 4px 0px; padding: 0px; }
QTabBar QToolButton:hover { background: %2; border-color: %5; }
QTabBar::tab:hover { color: %4; }
QTabBar::tab:focus { border-bottom-color: %5; color: %5; }
QTabBar::tab:selected { border-bottom-color: %5; color: %4; }
QStatusBar { background: %1; border-top: 1px solid %3; }
QScrollBar:vertical { width: 10px; background: transparent; }
QScrollBar:horizontal { height: 10px; background: transparent; }
QScrollBar::handle { background: %3; border-radius: 4px; min-height: 24px; min-width: 24px; margin: 1px; }
QScrollBar::handle:hover { background: %7; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: none; }
)")
      .arg(c(window), c(raised), c(line), c(text), c(accent), c(selection), c(faint_text), c(panel))
      .arg(c(dark ? text : raised), c(good), c(warning), c(error), c(resting));
}

const Theme& dark_theme() {
  static const Theme theme = make_dark();
  return theme;
}

const Theme& light_theme() {
  static const Theme theme = make_light();
  return theme;
}

}  // namespace kinegraph
