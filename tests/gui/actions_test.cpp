// The table of actions, each run by its keys alone; names for those who can't see the window.
#include "gui/window/actions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenu>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QTimer>
#include <set>

#include "tests/gui/editor.h"

namespace kinegraph::editor_test {
namespace {

const QString graphs = QString(KINEGRAPH_SOURCE_DIR) + "/graphs/";

TEST(EditorActions, EveryRowOfAMenuIsAnActionWithKeysOfItsOwn) {
  Editor editor;
  std::set<QString> keys;
  for (const ActionRow& row : all_actions()) {
    if (!*row.menu) continue;
    const QAction* action = editor.window.action(row.name);
    ASSERT_TRUE(action) << row.name;
    EXPECT_FALSE(action->shortcut().isEmpty()) << row.name;
    EXPECT_TRUE(keys.insert(action->shortcut().toString()).second) << row.keys << " is taken twice";
  }
}

TEST(EditorActions, MenusAndHelpSayAllOfThem) {
  Editor editor;
  std::set<QString> in_menus;
  for (QMenu* menu : editor.window.menuBar()->findChildren<QMenu*>())
    for (const QAction* action : menu->actions()) in_menus.insert(action->objectName());
  const QString help = help_page();
  for (const ActionRow& row : all_actions()) {
    if (*row.menu) {
      EXPECT_TRUE(in_menus.count(QString("action_") + row.name)) << row.name;
    }
    EXPECT_TRUE(help.contains(QString(row.what).toHtmlEscaped())) << row.name;
  }
}

// Presses the keys of an action and closes whatever dialog or menu comes up.
void press(Editor& editor, const ActionRow& row) {
  QTimer closing;
  closing.setInterval(20);
  QObject::connect(&closing, &QTimer::timeout, [] {
    if (QWidget* menu = QApplication::activePopupWidget()) menu->close();
    if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget())) dialog->reject();
  });
  closing.start();
  const QKeyCombination keys = QKeySequence(row.keys)[0];
  editor.canvas().setFocus();
  editor.key(keys.key(), keys.keyboardModifiers());
}

TEST(EditorActions, EachRunsByItsKeys) {
  for (const ActionRow& row : all_actions()) {
    const QString name = row.name;
    if (!*row.menu || name == "quit") continue;
    SCOPED_TRACE(row.name);
    Editor editor;
    ASSERT_TRUE(editor.window.open(graphs + "reuse.kg.json"));
    if (name.contains("page")) {
      ASSERT_TRUE(editor.window.open(graphs + "feet.kg.json"));
    }
    const std::string node = name == "open_inside" || name == "collapse" ? "sneaky" : "walk";
    if (editor.document().nodes.count(node)) editor.session().select({node}, node);
    if (name == "redo" || name == "undo") {
      editor.session().perform([](const Document& d, const Registry&) { return set_note(d, "walk", "one"); });
      if (name == "redo") editor.session().undo();
    }
    if (name == "paste") editor.canvas().copy_selected();
    QAction* action = editor.window.action(name);
    if (name == "cancel") action->setEnabled(true);
    int ran = 0;
    QObject::connect(action, &QAction::triggered, [&] { ++ran; });
    press(editor, row);
    // Tab is the canvas's own key: what it opens is the search.
    if (name == "add")
      EXPECT_TRUE(editor.canvas().findChild<QWidget*>("search_box")->isVisible());
    else
      EXPECT_EQ(ran, 1);
  }
}

TEST(EditorActions, KeysGoToEveryDock) {
  Editor editor;
  ASSERT_TRUE(editor.window.open(graphs + "component_edit.kg.json"));
  for (const ActionRow& row : all_actions()) {
    const QString name = row.name;
    if (!name.startsWith("go_") || name == "go_graph") continue;
    const QKeyCombination keys = QKeySequence(row.keys)[0];
    editor.session().select({editor.document().nodes.begin()->first}, editor.document().nodes.begin()->first);
    editor.canvas().setFocus();
    editor.key(keys.key(), keys.keyboardModifiers());
    auto* dock = editor.window.findChild<QDockWidget*>("dock_" + name.mid(3));
    ASSERT_TRUE(dock) << row.name;
    EXPECT_TRUE(dock->isVisible()) << row.name;
    if (name != "go_problems" && name != "go_components" && name != "go_curves")
      EXPECT_TRUE(QApplication::focusWidget() && dock->isAncestorOf(QApplication::focusWidget())) << row.name;
  }
}

TEST(EditorActions, EveryControlHasAName) {
  Editor editor;
  ASSERT_TRUE(editor.window.open(graphs + "style_transfer.kg.json"));
  for (const auto& [node, unused] : editor.document().nodes) {
    editor.session().select({node}, node);
    Editor::settle();
    for (QWidget* widget : editor.window.findChildren<QWidget*>()) {
      const bool control = qobject_cast<QAbstractButton*>(widget) || qobject_cast<QComboBox*>(widget) ||
                           qobject_cast<QAbstractSlider*>(widget) || qobject_cast<QLineEdit*>(widget) ||
                           qobject_cast<QPlainTextEdit*>(widget) || qobject_cast<QAbstractSpinBox*>(widget) ||
                           widget->inherits("QAbstractItemView") || widget->inherits("QTabBar");
      if (!control || widget->objectName().startsWith("qt_") || widget->inherits("QScrollBar")) continue;
      // Parts of a control that has a name itself.
      if (widget->parentWidget() &&
          (widget->parentWidget()->inherits("QAbstractSpinBox") ||
           widget->parentWidget()->inherits("QComboBox") ||
           widget->parentWidget()->inherits("QComboBoxPrivateContainer") ||
           widget->parentWidget()->inherits("QAbstractItemView") ||
           widget->parentWidget()->inherits("QTabBar") || widget->parentWidget()->inherits("QLineEdit") ||
           widget->parentWidget()->inherits("QDockWidget")))
        continue;
      const auto* button = qobject_cast<QAbstractButton*>(widget);
      EXPECT_TRUE(!widget->accessibleName().isEmpty() || (button && !button->text().isEmpty()))
          << widget->metaObject()->className() << " " << widget->objectName().toStdString() << " in "
          << (widget->parentWidget() ? widget->parentWidget()->metaObject()->className() : "") << " "
          << (widget->parentWidget() ? widget->parentWidget()->objectName().toStdString() : "");
    }
  }
}

TEST(EditorActions, TheWindowFits1280By800) {
  Editor editor;
  for (const char* graph : {"style_transfer.kg.json", "component_edit.kg.json"}) {
    ASSERT_TRUE(editor.window.open(graphs + graph));
    for (const QString& dock : editor.window.dock_names()) {
      editor.window.show_dock(dock);
      Editor::settle();
      EXPECT_LE(editor.window.minimumSizeHint().width(), 1280) << dock.toStdString();
      EXPECT_LE(editor.window.minimumSizeHint().height(), 800) << dock.toStdString();
      EXPECT_EQ(editor.window.size(), QSize(1280, 800)) << dock.toStdString();
    }
  }
}

}  // namespace
}  // namespace kinegraph::editor_test
