// Whoever has no mouse sees where the keyboard is, and whoever doesn't see the window is told what each
// control is called: in all docks and dialogs, in both themes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTabBar>
#include <set>

#include "graph/file/write.h"
#include "tests/gui/editor.h"
#include "tests/places.h"

namespace kinegraph::editor_test {
namespace {

const QString graphs = QString::fromStdString(source_folder()) + "/graphs/";
// More than a text cursor: an edge of a small control.
constexpr int least_pixels = 30;

std::string named(const QWidget& widget) {
  std::string name = widget.metaObject()->className();
  for (const QString& more : {widget.objectName(), widget.accessibleName()})
    if (!more.isEmpty()) name += " " + more.toStdString();
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget))
    name += " " + button->text().toStdString();
  return name;
}

// Pixels at a widget that its focus changes; what changes by itself (figures that play) doesn't count.
int pixels_of_focus(QWidget& widget) {
  QWidget& window = *widget.window();
  const QRect place =
      QRect(widget.mapTo(&window, QPoint()), widget.size()).adjusted(-3, -3, 3, 3) & window.rect();
  const auto picture = [&] {
    QCoreApplication::processEvents();
    return window.grab(place).toImage().convertToFormat(QImage::Format_RGB32);
  };
  const QImage with = picture();
  widget.clearFocus();
  const QImage without = picture(), again = picture();
  widget.setFocus(Qt::TabFocusReason);
  int count = 0;
  for (int y = 0; y < with.height(); ++y)
    for (int x = 0; x < with.width(); ++x)
      count += with.pixel(x, y) != without.pixel(x, y) && without.pixel(x, y) == again.pixel(x, y);
  return count;
}

// From where the keyboard is by Tab until it leaves `room` or comes back; how many stops there were.
int tab_through(QWidget& room) {
  std::set<QWidget*> seen;
  for (;;) {
    QWidget* at = QApplication::focusWidget();
    if (!at || (at != &room && !room.isAncestorOf(at)) || !seen.insert(at).second) break;
    EXPECT_GE(pixels_of_focus(*at), least_pixels) << named(*at) << " in " << named(room);
    EXPECT_FALSE(at->visibleRegion().isEmpty()) << named(*at) << " has the keyboard and can't be seen";
    if (qobject_cast<GraphCanvas*>(at)) break;  // there Tab adds a node
    QTest::keyClick(at, Qt::Key_Tab);
    QCoreApplication::processEvents();
  }
  return int(seen.size());
}

TEST(EditorControls, AScreenReaderFindsEveryNodeWithItsStateAndLinks) {
  Editor editor;
  editor.session().open_text(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "walk": {"type": "Gait"}, "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}}}})",
                             {});
  editor.key(Qt::Key_Right);
  ASSERT_TRUE(editor.wait_for_evaluation());
  Editor::settle();
  QAccessibleInterface* canvas = QAccessible::queryAccessibleInterface(&editor.canvas());
  ASSERT_TRUE(canvas);
  EXPECT_EQ(canvas->text(QAccessible::Name), "Graph");
  ASSERT_EQ(canvas->childCount(), 2);
  QAccessibleInterface* soft = canvas->child(0);
  QAccessibleInterface* walk = canvas->child(1);
  EXPECT_EQ(soft->text(QAccessible::Name), "soft, Filter");
  EXPECT_EQ(soft->text(QAccessible::Description), "motion from walk.motion");
  EXPECT_EQ(walk->text(QAccessible::Description), "to soft.motion");
  EXPECT_FALSE(walk->text(QAccessible::Value).isEmpty());
  EXPECT_EQ(walk->parent(), canvas);
  EXPECT_EQ(canvas->indexOfChild(walk), 1);
  EXPECT_EQ(canvas->childAt(walk->rect().center().x(), walk->rect().center().y()), walk);
  EXPECT_EQ(canvas->focusChild(), walk);
  EXPECT_TRUE(walk->state().focused && walk->state().selected);
  editor.key(Qt::Key_Right);
  EXPECT_EQ(canvas->focusChild(), soft);
  editor.key(Qt::Key_Delete);
  EXPECT_FALSE(soft->isValid());
  EXPECT_EQ(canvas->childCount(), 1);
}

// An example, opened as a copy: what is tried here leaves nothing beside the original.
bool open_copy(Editor& editor, const char* graph, const QString& name, bool with_clips) {
  const QString path = editor.folder.filePath(name);
  QDir(editor.folder.path()).mkpath("clips");
  for (const QString& clip : with_clips ? QDir(graphs + "clips").entryList({"*.bvh"}) : QStringList())
    QFile::copy(graphs + "clips/" + clip, editor.folder.filePath("clips/" + clip));
  return QFile::copy(graphs + graph, path) && editor.window.open(path);
}

// Runs `look` in every dialog of the editor's own.
void in_every_dialog(Editor& editor, const std::function<void(QWidget&)>& look) {
  const auto during = [&](int key, Qt::KeyboardModifiers keys) {
    editor.when_asked([&](QWidget& dialog) {
      look(dialog);
      QTest::keyClick(&dialog, Qt::Key_Escape);
    });
    editor.canvas().setFocus();
    editor.key(key, keys);
  };
  const QString path = editor.folder.filePath("dialogs.kg.json");
  ASSERT_TRUE(
      open_copy(editor, "cartoon_boxing.kg.json", "dialogs.kg.json", false));  // its clips aren't beside it
  during(Qt::Key_F1, {});
  during(Qt::Key_F1, Qt::ShiftModifier);
  during(Qt::Key_R, Qt::ControlModifier | Qt::ShiftModifier);
  // Somebody else saves the file.
  Document theirs = editor.document();
  theirs.nodes.begin()->second.note = "theirs";
  const std::string text = write_document(theirs, editor.registry);
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(text.data(), qint64(text.size()));
  file.close();
  const auto button = [&](const QString& words) {
    QPushButton* found = nullptr;
    for (auto* one : editor.window.findChild<QWidget*>("notice_bar")->findChildren<QPushButton*>())
      if (one->text() == words && one->isVisible()) found = one;
    return found;
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return button("Show what changed"); }, 5000));
  editor.when_asked([&](QWidget& dialog) {
    look(dialog);
    QTest::keyClick(&dialog, Qt::Key_Escape);
  });
  QTest::mouseClick(button("Show what changed"), Qt::LeftButton);
  // What is unsaved is asked for.
  editor.canvas().add("Gait", {0, 0});
  during(Qt::Key_W, Qt::ControlModifier);
}

struct EditorFocus : testing::TestWithParam<bool> {};

TEST_P(EditorFocus, IsSeenAtEveryStopOfEveryDock) {
  Editor editor;
  if (GetParam()) editor.key(Qt::Key_T, Qt::ControlModifier);
  ASSERT_TRUE(open_copy(editor, "component_edit.kg.json", "edit.kg.json", true));
  editor.session().select({"edit"}, editor.document().nodes.count("edit") ? "edit" : "");
  ASSERT_TRUE(editor.wait_for_evaluation());
  editor.settle();
  const Qt::Key keys[] = {Qt::Key_1, Qt::Key_2, Qt::Key_3, Qt::Key_4,
                          Qt::Key_5, Qt::Key_6, Qt::Key_7, Qt::Key_8};
  for (Qt::Key key : keys) {
    editor.canvas().setFocus();
    editor.key(key, Qt::ControlModifier);
    QWidget* room = QApplication::focusWidget();
    ASSERT_TRUE(room);
    for (auto* dock : editor.window.findChildren<QDockWidget*>())
      if (dock->isAncestorOf(room)) room = dock;
    SCOPED_TRACE(named(*room));
    EXPECT_GE(tab_through(*room), 1);
  }
}

TEST_P(EditorFocus, IsSeenAtEveryStopOfTheParametersOfEveryNode) {
  Editor editor;
  if (GetParam()) editor.key(Qt::Key_T, Qt::ControlModifier);
  for (const char* type : {"ComponentEdit", "StyleTransfer", "Load", "Check", "MotionWarp", "Exaggerate"}) {
    SCOPED_TRACE(type);
    editor.canvas().add(type, {0, 0});
    editor.canvas().setFocus();
    editor.key(Qt::Key_4, Qt::ControlModifier);
    EXPECT_GE(tab_through(*editor.window.findChild<QDockWidget*>("dock_parameters")), 5);
  }
}

TEST_P(EditorFocus, IsSeenAtEveryStopOfEveryDialog) {
  Editor editor(true);
  if (GetParam()) editor.key(Qt::Key_T, Qt::ControlModifier);
  int dialogs = 0;
  in_every_dialog(editor, [&](QWidget& dialog) {
    ++dialogs;
    QApplication::setActiveWindow(&dialog);  // no window manager under Xvfb does it
    QCoreApplication::processEvents();
    SCOPED_TRACE(dialog.windowTitle().toStdString());
    EXPECT_GE(tab_through(dialog), 1);
  });
  EXPECT_EQ(dialogs, 5);
}

INSTANTIATE_TEST_SUITE_P(Themes, EditorFocus, testing::Bool(),
                         [](const auto& theme) { return theme.param ? "Light" : "Dark"; });

// Every control below a widget says what it is; parts of a control that has a name need none.
void expect_names(const QWidget& room) {
  for (QWidget* widget : room.findChildren<QWidget*>()) {
    const bool control = qobject_cast<QAbstractButton*>(widget) || qobject_cast<QComboBox*>(widget) ||
                         qobject_cast<QAbstractSlider*>(widget) || qobject_cast<QLineEdit*>(widget) ||
                         qobject_cast<QPlainTextEdit*>(widget) || qobject_cast<QAbstractSpinBox*>(widget) ||
                         qobject_cast<QAbstractItemView*>(widget) || qobject_cast<QTabBar*>(widget);
    if (!control || widget->objectName().startsWith("qt_") || widget->inherits("QScrollBar")) continue;
    const QWidget* owner = widget->parentWidget();
    bool is_part = false;
    for (const char* whole : {"QAbstractSpinBox", "QComboBox", "QComboBoxPrivateContainer",
                              "QAbstractItemView", "QTabBar", "QLineEdit", "QDockWidget"})
      is_part = is_part || (owner && owner->inherits(whole));
    if (is_part) continue;
    const auto* button = qobject_cast<QAbstractButton*>(widget);
    EXPECT_TRUE(!widget->accessibleName().isEmpty() || (button && !button->text().isEmpty()))
        << named(*widget) << " in " << (owner ? named(*owner) : "");
  }
}

TEST(EditorNames, EveryControlOfTheWindowHasOne) {
  Editor editor;
  ASSERT_TRUE(open_copy(editor, "component_edit.kg.json", "edit.kg.json", true));
  ASSERT_TRUE(editor.wait_for_evaluation());
  expect_names(editor.window);
  for (const std::string& type : editor.registry.names()) {
    SCOPED_TRACE(type);
    editor.canvas().add(type, {0, 0});
    Editor::settle();
    expect_names(editor.window);
  }
}

TEST(EditorNames, EveryControlOfADialogHasOne) {
  Editor editor(true);
  in_every_dialog(editor, [&](QWidget& dialog) {
    SCOPED_TRACE(dialog.windowTitle().toStdString());
    expect_names(dialog);
  });
}

}  // namespace
}  // namespace kinegraph::editor_test
