// What people do by mistake or in a hurry: keys in the middle of a drag, lines that are never finished,
// things dropped that are no clips.
#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QLabel>
#include <QMimeData>
#include <QMouseEvent>
#include <QTabBar>
#include <QTableWidget>
#include <QUrl>

#include "tests/gui/editor.h"

namespace kinegraph::editor_test {
namespace {

const char* const two_gaits = R"({"format": "kinegraph", "schema": 1, "nodes": {
  "calm": {"type": "Gait"},
  "walk": {"type": "Gait"}},
  "ui": {"nodes": {"calm": {"pos": [0, 0]}, "walk": {"pos": [300, 0]}}}})";

struct Files : Editor {
  QString write(const QString& name, const std::string& text = two_gaits) {
    QFile file(folder.filePath(name));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(text.data(), qint64(text.size()));
    return file.fileName();
  }
  bool open(const QString& name) {
    const bool opened = window.open(write(name));
    session().select({"walk"}, "walk");
    settle();
    return opened;
  }
  QLineEdit& line(const char* field) {
    auto* found = window.findChild<QWidget*>(field);
    auto* inside = found ? found->findChild<QLineEdit*>() : nullptr;
    EXPECT_TRUE(inside) << field;
    return *inside;
  }
  void type_into(QLineEdit& at, const QString& text) {
    at.setFocus();
    at.selectAll();
    type(text);
  }
  double speed(const std::string& node = "walk") {
    const auto& params = document().nodes.at(node).params;
    const auto found = params.find("speed");
    return found == params.end() ? -1 : found->second.number();
  }
  QPointF place(const std::string& node) { return canvas().scene().node(node)->rect.topLeft(); }
};

TEST(EditorMistakes, WhatStandsInALineIsSavedWithoutEnter) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  QLineEdit& line = editor.line("param_speed");
  editor.type_into(line, "1.75");
  editor.key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(editor.speed(), 1.75);
  EXPECT_FALSE(editor.session().is_modified());
  QFile file(editor.session().path());
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_TRUE(file.readAll().contains("1.75"));
  EXPECT_EQ(QApplication::focusWidget(), &line) << "who types goes on typing";
}

TEST(EditorMistakes, WhatStandsInALineIsForTheGraphThatItWasTypedIn) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  ASSERT_TRUE(editor.open("b.kg.json"));
  editor.type_into(editor.line("param_speed"), "1.75");
  editor.key(Qt::Key_PageUp, Qt::ControlModifier);
  ASSERT_EQ(editor.session().title(), "a.kg.json");
  editor.canvas().setFocus();
  Editor::settle();
  EXPECT_EQ(editor.speed(), -1);
  editor.key(Qt::Key_PageDown, Qt::ControlModifier);
  EXPECT_EQ(editor.speed(), 1.75);

  editor.type_into(editor.line("param_speed"), "1.25");
  auto& tabs = *editor.window.findChild<QTabBar*>("pages");
  QTest::mouseClick(&tabs, Qt::LeftButton, {}, tabs.tabRect(0).center());
  ASSERT_EQ(editor.session().title(), "a.kg.json");
  editor.canvas().setFocus();
  EXPECT_EQ(editor.speed(), -1);
  EXPECT_FALSE(editor.session().is_modified());
}

TEST(EditorMistakes, ANameThatHadTheKeyboardRenamesNoNodeOfAnotherGraph) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  editor.session().select({"calm"}, "calm");
  ASSERT_TRUE(editor.open("b.kg.json"));
  editor.key(Qt::Key_4, Qt::ControlModifier);  // the name's line
  editor.key(Qt::Key_PageUp, Qt::ControlModifier);
  ASSERT_EQ(editor.session().title(), "a.kg.json");
  editor.canvas().setFocus();
  Editor::settle();
  EXPECT_FALSE(editor.session().is_modified());
  EXPECT_EQ(editor.session().current(), "calm");
}

TEST(EditorMistakes, UndoInTheMiddleOfADragGivesUpTheDrag) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  editor.drag_node("walk", {320, 200});
  const std::string before = editor.session().text();
  const QPointF was = editor.place("walk");
  editor_test::drag(editor.canvas(), editor.middle("walk"), editor.middle("walk") + QPoint(60, 40),
                    {.meanwhile = [&] { editor.key(Qt::Key_Z, Qt::ControlModifier); }});
  EXPECT_EQ(editor.session().text(), before);
  EXPECT_EQ(editor.place("walk"), was);
}

TEST(EditorMistakes, APageThatIsTurnedInTheMiddleOfADragStaysAsItWas) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  ASSERT_TRUE(editor.open("b.kg.json"));
  editor_test::drag(editor.canvas(), editor.middle("walk"), editor.middle("walk") + QPoint(60, 40),
                    {.meanwhile = [&] { editor.key(Qt::Key_PageUp, Qt::ControlModifier); }});
  ASSERT_EQ(editor.session().title(), "a.kg.json");
  EXPECT_FALSE(editor.session().is_modified());
  EXPECT_FALSE(editor.session().is_page_modified(1));
}

TEST(EditorMistakes, ANodeThatIsDeletedWhileItIsLinkedEndsTheLink) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  const QPoint from = editor.port("walk", "motion", false);
  editor_test::drag(editor.canvas(), from, from + QPoint(80, 80),
                    {.meanwhile = [&] { editor.key(Qt::Key_Delete); }});
  Editor::settle();
  EXPECT_FALSE(editor.document().nodes.count("walk"));
  EXPECT_FALSE(editor.canvas().findChild<QWidget*>("search_box")->isVisible());
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_FALSE(editor.session().is_modified());
}

TEST(EditorMistakes, AnotherButtonDoesNotEndADrag) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  const QPoint to = editor.middle("walk") + QPoint(0, 80);
  editor_test::drag(editor.canvas(), editor.middle("walk"), to, {.meanwhile = [&] {
                      QTest::mouseClick(&editor.canvas(), Qt::MiddleButton, {}, to);
                      EXPECT_FALSE(editor.session().is_modified());
                    }});
  EXPECT_TRUE(editor.session().is_modified());
}

TEST(EditorMistakes, UndoInTheMiddleOfASlidersDragLeavesTheRestOneStep) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  auto* slider = editor.window.findChild<QWidget*>("param_speed")->findChild<QSlider*>();
  ASSERT_TRUE(slider);
  const std::string first = editor.session().text();
  const auto slide = [&](QPoint from, int by) {
    for (int i = 1; i <= 6; ++i) {
      const QPoint at = from + QPoint(by * i / 6, 0);
      QMouseEvent event(QEvent::MouseMove, at, slider->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
      QApplication::sendEvent(slider, &event);
    }
  };
  const QPoint handle = handle_of(*slider, slider->value());
  QTest::mousePress(slider, Qt::LeftButton, {}, handle);
  slide(handle, 20);
  ASSERT_NE(editor.session().text(), first);
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), first);
  slide(handle + QPoint(20, 0), 20);
  QTest::mouseRelease(slider, Qt::LeftButton, {}, handle + QPoint(40, 0));
  Editor::settle();
  ASSERT_NE(editor.session().text(), first);
  EXPECT_EQ(editor.session().history().position(), 1u);
  EXPECT_FALSE(editor.session().in_gesture());
  editor.canvas().setFocus();
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), first);
}

TEST(EditorMistakes, ADragEndsThoughItsSliderWentAway) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  const std::string made = editor.add("resample");
  editor.session().select({"walk"}, "walk");
  Editor::settle();
  auto* slider = editor.window.findChild<QWidget*>("param_speed")->findChild<QSlider*>();
  QTest::mousePress(slider, Qt::LeftButton, {}, handle_of(*slider, slider->value()));
  EXPECT_TRUE(editor.session().in_gesture());
  editor.session().select({made}, made);  // as an answer to a notice does
  QTest::mouseRelease(&editor.window, Qt::LeftButton);
  Editor::settle();
  EXPECT_FALSE(editor.session().in_gesture());
}

TEST(EditorMistakes, ControlYDoesAgainToo) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  const std::string made = editor.add("filter");
  editor.canvas().setFocus();
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_FALSE(editor.document().nodes.count(made));
  editor.key(Qt::Key_Y, Qt::ControlModifier);
  EXPECT_TRUE(editor.document().nodes.count(made));
}

TEST(EditorMistakes, AHundredUndosAndRedosAtTheEndsDoNothing) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  const std::string first = editor.session().text();
  editor.add("filter");
  const std::string last = editor.session().text();
  editor.canvas().setFocus();
  for (int i = 0; i < 100; ++i) QTest::keyClick(&editor.canvas(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), first);
  for (int i = 0; i < 100; ++i)
    QTest::keyClick(&editor.canvas(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(editor.session().text(), last);
}

TEST(EditorMistakes, ADroppedFolderIsNoClip) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  QDir(editor.folder.path()).mkpath("clips");
  QMimeData dropped;
  dropped.setUrls({QUrl::fromLocalFile(editor.folder.filePath("clips"))});
  const QPointF at(200, 200);
  QDragEnterEvent enter(at.toPoint(), Qt::CopyAction, &dropped, Qt::LeftButton, {});
  QApplication::sendEvent(&editor.canvas(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(at, Qt::CopyAction, &dropped, Qt::LeftButton, {});
  QApplication::sendEvent(&editor.canvas(), &drop);
  EXPECT_EQ(editor.document().nodes.size(), 2u);
  EXPECT_FALSE(editor.session().is_modified());
}

TEST(EditorMistakes, ANumberThatIsNoneOrTooLargeSaysWhatFits) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  QLineEdit& line = editor.line("param_speed");
  auto* why = line.parentWidget()->parentWidget()->findChild<QLabel*>("param_mistake");
  ASSERT_TRUE(why);
  for (const auto& [typed, said] : {std::pair{"=1/0", "no number"},
                                    {"banana", "no number"},
                                    {"-100000000", "Wanted is"},
                                    {"1e300", "Wanted is"}}) {
    editor.type_into(line, typed);
    editor.key(Qt::Key_Return);
    EXPECT_TRUE(why->isVisible());
    EXPECT_TRUE(why->text().contains(said)) << typed << ": " << why->text().toStdString();
    EXPECT_TRUE(why->text().contains("Wanted is a number")) << typed << ": " << why->text().toStdString();
    EXPECT_TRUE(line.property("mistake").toBool()) << typed;
    EXPECT_EQ(line.text(), typed) << "what was typed stays until it is corrected";
    EXPECT_EQ(editor.speed(), -1) << typed;
  }
  // Escape gives it up.
  editor.key(Qt::Key_Escape);
  EXPECT_FALSE(why->isVisible()) << why->text().toStdString();
  EXPECT_FALSE(line.property("mistake").toBool());
  EXPECT_NE(line.text(), "1e300");
  EXPECT_FALSE(editor.session().is_modified());
  editor.type_into(line, "banana");
  editor.key(Qt::Key_Return);
  EXPECT_TRUE(why->isVisible());
  editor.type_into(line, "=3/2");
  editor.key(Qt::Key_Return);
  EXPECT_EQ(editor.speed(), 1.5);
  EXPECT_FALSE(why->isVisible());
  EXPECT_FALSE(line.property("mistake").toBool());
}

// A graph with a MotionWarp whose keys stand in a table.
struct Keys : Files {
  QTableWidget& open_keys() {
    QFile file(folder.filePath("keys.kg.json"));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(R"({"format": "kinegraph", "schema": 1, "nodes": {"walk": {"type": "Gait"},
      "reach": {"type": "MotionWarp", "inputs": {"motion": "walk.motion"}, "params": {"keys": [
        {"frame": 20, "joint": "LeftHand"}, {"frame": 45, "joint": "LeftHand", "position": [0.45, 1.7, -0.1]}]}}}})");
    file.close();
    EXPECT_TRUE(window.open(file.fileName()));
    session().select({"reach"}, "reach");
    window.show_dock("Parameters");
    settle();
    auto* table = window.findChild<QWidget*>("param_keys")->findChild<QTableWidget*>();
    EXPECT_TRUE(table);
    return *table;
  }
  // Double-click, all of it typed anew, Enter.
  void type_cell(QTableWidget& table, int row, int column, const QString& text) {
    const QPoint at = table.visualItemRect(table.item(row, column)).center();
    QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, at);
    QTest::mouseDClick(table.viewport(), Qt::LeftButton, {}, at);
    settle();
    key(Qt::Key_A, Qt::ControlModifier);
    type(text);
    key(Qt::Key_Return);
  }
};

TEST(EditorMistakes, ACellThatDoesNotFitStaysAndSaysWhatIsWanted) {
  Keys editor;
  QTableWidget& table = editor.open_keys();
  EXPECT_EQ(table.item(1, 3)->text(), "0.45, 1.7, -0.1");
  const std::string before = editor.session().text();
  editor.type_cell(table, 1, 3, "0.45, 1.7");
  auto* why =
      editor.window.findChild<QWidget*>("param_keys")->parentWidget()->findChild<QLabel*>("param_mistake");
  ASSERT_TRUE(why);
  EXPECT_TRUE(why->isVisible());
  EXPECT_TRUE(why->text().contains("position")) << why->text().toStdString();
  EXPECT_EQ(table.item(1, 3)->text(), "0.45, 1.7");
  EXPECT_FALSE(table.item(1, 3)->icon().isNull());
  EXPECT_TRUE(table.property("mistake").toBool());
  EXPECT_EQ(editor.session().text(), before);
  // Another row that fits is taken, and the cell stays marked.
  editor.type_cell(table, 0, 0, "5*6");
  EXPECT_EQ(editor.document().nodes.at("reach").params.at("keys").array()[0].find("frame")->number(), 30);
  EXPECT_TRUE(why->isVisible());
  EXPECT_EQ(table.item(1, 3)->text(), "0.45, 1.7");
  editor.type_cell(table, 1, 3, "0.45 1.7 1/2");
  EXPECT_FALSE(why->isVisible());
  EXPECT_TRUE(table.item(1, 3)->icon().isNull());
  EXPECT_EQ(
      editor.document().nodes.at("reach").params.at("keys").array()[1].find("position")->array()[2].number(),
      0.5);
  // Two steps, and all is as it was.
  editor.canvas().setFocus();
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), before);
}

TEST(EditorMistakes, AnUnfinishedRowIsNotTakenAlongToAnotherNode) {
  Keys editor;
  QTableWidget& table = editor.open_keys();
  editor.session().perform(
      [](const Document& d, const Registry& r) { return add_node(d, r, "other", "MotionWarp"); });
  editor.type_cell(table, 0, 0, "soon");
  auto* why =
      editor.window.findChild<QWidget*>("param_keys")->parentWidget()->findChild<QLabel*>("param_mistake");
  EXPECT_TRUE(why->isVisible());
  editor.session().select({"other"}, "other");
  Editor::settle();
  auto* shown = editor.window.findChild<QWidget*>("param_keys")->findChild<QTableWidget*>();
  EXPECT_EQ(shown->rowCount(), 0);
  EXPECT_FALSE(editor.window.findChild<QWidget*>("param_keys")
                   ->parentWidget()
                   ->findChild<QLabel*>("param_mistake")
                   ->isVisible());
}

TEST(EditorMistakes, ADraggedFileSaysWhatLettingGoDoes) {
  Files editor;
  ASSERT_TRUE(editor.open("a.kg.json"));
  QMimeData dragged;
  dragged.setUrls({QUrl::fromLocalFile(editor.folder.filePath("jump.bvh"))});
  const QImage before = editor.canvas().grab().toImage();
  QDragEnterEvent enter(QPoint(290, 200), Qt::CopyAction, &dragged, Qt::LeftButton, {});
  QApplication::sendEvent(&editor.canvas(), &enter);
  QDragMoveEvent move(QPoint(300, 200), Qt::CopyAction, &dragged, Qt::LeftButton, {});
  QApplication::sendEvent(&editor.canvas(), &move);
  EXPECT_TRUE(move.isAccepted());
  EXPECT_NE(editor.canvas().grab().toImage(), before);
  QDragLeaveEvent leave;
  QApplication::sendEvent(&editor.canvas(), &leave);
  EXPECT_EQ(editor.canvas().grab().toImage(), before);
}

}  // namespace
}  // namespace kinegraph::editor_test
