// The table of actions, each run by its keys alone.
#include "gui/look/actions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QDockWidget>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QTimer>
#include <QTreeWidget>
#include <set>

#include "gui/viewer/viewer.h"
#include "gui/window/keys_dialog.h"
#include "tests/gui/editor.h"
#include "tests/places.h"

namespace kinegraph::editor_test {
namespace {

const QString graphs = QString::fromStdString(source_folder()) + "/graphs/";

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
  QStringList help;
  KeysDialog dialog(dark_theme(), &editor.window);
  auto* list = dialog.findChild<QTreeWidget*>();
  for (int i = 0; i < list->topLevelItemCount(); ++i) help << list->topLevelItem(i)->text(2);
  for (const ActionRow& row : all_actions()) {
    if (*row.menu) {
      EXPECT_TRUE(in_menus.count(QString("action_") + row.name)) << row.name;
    }
    EXPECT_TRUE(help.contains(row.what)) << row.name;
  }
}

TEST(EditorActions, EveryEntryOfAMenuHasALetterOfItsOwn) {
  Editor editor;
  for (QMenu* menu : editor.window.menuBar()->findChildren<QMenu*>()) {
    std::set<QString> letters;
    for (const QAction* action : menu->actions()) {
      if (action->isSeparator() || (!action->menu() && action->objectName().isEmpty())) continue;
      const qsizetype mark = action->text().indexOf('&');
      ASSERT_GE(mark, 0) << action->text().toStdString();
      EXPECT_TRUE(letters.insert(action->text().mid(mark + 1, 1).toLower()).second)
          << action->text().toStdString() << " in " << menu->title().toStdString();
    }
  }
}

TEST(EditorActions, ALetterOrTwoFindTheirKeys) {
  Editor editor(true);
  QStringList shown;
  bool whole_rows = false;
  editor.when_asked([&](QWidget& dialog) {
    auto* list = dialog.findChild<QTreeWidget*>();
    const int height = list->visualItemRect(list->topLevelItem(0)).height();
    whole_rows = height > 0 && list->viewport()->height() % height == 0;
    QTest::keyClicks(dialog.findChild<QLineEdit*>(), "ghosts");
    for (int i = 0; i < list->topLevelItemCount(); ++i)
      if (!list->topLevelItem(i)->isHidden()) shown << list->topLevelItem(i)->text(0);
    QTest::keyClick(&dialog, Qt::Key_Escape);
  });
  editor.key(Qt::Key_F1);
  EXPECT_TRUE(whole_rows);
  EXPECT_EQ(shown, QStringList({"In the viewer", "G"}));
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
    if (name == "add") {
      EXPECT_TRUE(editor.canvas().findChild<QWidget*>("search_box")->isVisible());
    } else {
      EXPECT_EQ(ran, 1);
    }
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
    if (name != "go_problems" && name != "go_components" && name != "go_curves") {
      EXPECT_TRUE(QApplication::focusWidget() && dock->isAncestorOf(QApplication::focusWidget())) << row.name;
    }
  }
}

TEST(EditorActions, EveryActionWithKeysStandsInTheTable) {
  Editor editor;
  std::set<QString> rows;
  for (const ActionRow& row : all_actions()) rows.insert(QString("action_") + row.name);
  for (const QAction* action : editor.window.findChildren<QAction*>())
    if (!action->shortcut().isEmpty()) {
      EXPECT_TRUE(rows.count(action->objectName()))
          << action->text().toStdString() << " " << action->shortcut().toString().toStdString();
    }
}

// Rows of the viewer and timeline are keys of their docks, no actions: each must change what it says.
TEST(EditorActions, KeysOfTheViewerAndTimelineDoWhatTheirRowsSay) {
  Editor editor;
  editor.session().open_text(R"({"format": "kinegraph", "schema": 1, "nodes": {"walk": {"type": "Gait"}}})",
                             {});
  editor.session().select({"walk"}, "walk");
  auto& viewer = *editor.window.findChild<Viewer*>();
  Playback& playback = editor.window.playback();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return viewer.shown().size() == 1 && viewer.shown()[0].motion && playback.frames() > 0; },
      30000));
  const auto keys_of = [](const QString& keys) {
    QStringList all = keys.split(", ");
    if (keys == "Arrow keys") all = QStringList{"Left", "Right", "Up", "Down"};
    if (keys == "1 … 9") all = QStringList{"1"};
    if (keys == "+, -") all = QStringList{"+", "-"};
    return all;
  };
  // All that the keys can change, as text.
  const auto state = [&] {
    const Viewer::Looks looks = viewer.looks();
    const QImage picture = viewer.picture();
    std::size_t pixels = qHashBits(picture.constBits(), std::size_t(picture.sizeInBytes()));
    QString text = QString("%1 %2 %3 %4 %5 %6 %7")
                       .arg(looks.trails)
                       .arg(looks.contacts)
                       .arg(looks.stretch)
                       .arg(looks.follow)
                       .arg(looks.ghosts)
                       .arg(int(viewer.arrangement()))
                       .arg(QString::fromStdString(viewer.pinned(1)));
    text += QString(" %1 %2 %3 %4 %5 %6")
                .arg(playback.frame())
                .arg(playback.is_playing())
                .arg(playback.loops())
                .arg(playback.speed())
                .arg(playback.in())
                .arg(playback.out());
    return text + " " + QString::number(playback.is_playing() ? 0 : pixels);
  };
  for (const ActionRow& row : all_actions()) {
    const bool of_viewer = row.where == ActionRow::Where::viewer;
    if (!of_viewer && row.where != ActionRow::Where::timeline) continue;
    for (const QString& one : keys_of(row.keys)) {
      SCOPED_TRACE(std::string(row.name) + ": " + one.toStdString());
      playback.pause();
      playback.clear_range();
      playback.set_frame(40);
      const QString name = row.name;
      if (name == "unpin") viewer.pin(1, "walk");
      if (name == "whole") playback.set_range(10, 60);
      if (name == "viewer_frame") {  // away first
        viewer.setFocus();
        editor.key(Qt::Key_Left);
        editor.key(Qt::Key_Plus);
      }
      editor.key(of_viewer ? Qt::Key_2 : Qt::Key_3, Qt::ControlModifier);
      ASSERT_TRUE(QApplication::focusWidget());
      const QString before = state();
      const QKeyCombination keys = QKeySequence(one)[0];
      editor.key(keys.key(), keys.keyboardModifiers());
      EXPECT_NE(state(), before);
      if (name == "pin") viewer.pin(1, "");
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
