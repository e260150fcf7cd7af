// What the window says of how nodes stand, in the status line, on the canvas and among the problems.
#include <gtest/gtest.h>

#include <QAccessible>
#include <QTreeWidget>

#include "graph/edit.h"
#include "gui/document/problem_text.h"
#include "gui/window/state_line.h"
#include "tests/gui/editor.h"
#include "tests/places.h"

namespace kinegraph::editor_test {
namespace {

using State = NodeStatus::State;

struct Standing : Editor {
  explicit Standing(const std::string& nodes) {
    QFile::link(QString::fromStdString(source_folder()) + "/graphs/clips", folder.filePath("clips"));
    QFile file(folder.filePath("graph.kg.json"));
    if (file.open(QIODevice::WriteOnly))
      file.write(("{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {" + nodes + "}}").c_str());
    file.close();
    window.open(file.fileName());
    settle();
  }
  State state(const std::string& node) {
    const NodeStatus* status = window.evaluation().status(node);
    return status ? status->state : State::idle;
  }
  bool comes_to(const std::string& node, State wanted) {
    return QTest::qWaitFor([&] { return state(node) == wanted; }, 20000);
  }
  bool is_blocked_by(const std::string& node, const std::string& other) {
    return QTest::qWaitFor([&] { return window.evaluation().status(node)->blocked_by == other; }, 20000);
  }
  QString line() { return window.findChild<StateLine*>()->text(); }
  bool line_says(const QString& words) {
    return QTest::qWaitFor([&] { return line() == words; }, 20000);
  }
};

const char* const checked = R"("walk": {"type": "Gait", "params": {"seconds": 2}},
  "figures": {"type": "Metrics", "inputs": {"motion": "walk.motion"}},
  "judge": {"type": "Check", "params": {"rules": ["skate < -1"]}, "inputs": {"metrics": "figures.metrics"}})";

TEST(EditorStates, UpToDateIsSaidOnlyOnceEverythingIsComputed) {
  Standing editor(R"("walk": {"type": "Gait", "params": {"seconds": 2}},
    "sneak": {"type": "Gait", "params": {"gait": "sneak", "seconds": 2}})");
  ASSERT_TRUE(editor.comes_to("sneak", State::done));  // looked at as long as nothing is chosen
  EXPECT_TRUE(editor.line_says("1 of 2 nodes computed")) << qPrintable(editor.line());
  editor.session().select({"walk"}, "walk");
  EXPECT_TRUE(editor.line_says("Up to date")) << qPrintable(editor.line());
}

TEST(EditorStates, WhatAnEditMadeOldIsNotUpToDate) {
  Standing editor(R"("walk": {"type": "Gait", "params": {"seconds": 2}},
    "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}})");
  editor.session().select({"soft"}, "soft");
  ASSERT_TRUE(editor.line_says("Up to date"));
  editor.session().select({"walk"}, "walk");
  ASSERT_TRUE(editor.wait_for_evaluation());
  editor.session().perform(
      [](const Document& d, const Registry& r) { return set_param(d, r, "walk", "bounce", Json(1.5)); });
  EXPECT_TRUE(editor.comes_to("soft", State::idle));
  EXPECT_TRUE(editor.line_says("1 of 2 nodes computed")) << qPrintable(editor.line());
  editor.key(Qt::Key_Z, Qt::ControlModifier);  // what it gave is in the cache
  EXPECT_TRUE(editor.comes_to("soft", State::done));
  EXPECT_TRUE(editor.line_says("Up to date")) << qPrintable(editor.line());
}

TEST(EditorStates, ACheckThatFailedSaysSoUntilWhatItJudgesChanges) {
  Standing editor(checked);
  editor.key(Qt::Key_F5);
  ASSERT_TRUE(editor.comes_to("judge", State::failed));
  EXPECT_TRUE(editor.line_says("1 check failed")) << qPrintable(editor.line());
  editor.window.show_dock("Problems");
  auto* list = editor.window.findChild<QTreeWidget*>("problem_list");
  ASSERT_TRUE(QTest::qWaitFor([&] { return list->topLevelItemCount() == 1; }, 5000));
  EXPECT_EQ(list->topLevelItem(0)->text(0), "judge");
  EXPECT_TRUE(list->topLevelItem(0)->text(1).contains("skate < -1"));
  editor.session().perform(
      [](const Document& d, const Registry& r) { return set_param(d, r, "walk", "bounce", Json(1.5)); });
  EXPECT_TRUE(editor.comes_to("judge", State::idle));
  EXPECT_TRUE(QTest::qWaitFor([&] { return list->topLevelItemCount() == 0; }, 5000));
}

TEST(EditorStates, WhatWaitsForAMissingFileIsBlockedByNameThoughNobodyAskedForIt) {
  Standing editor(R"("walk": {"type": "Gait", "params": {"seconds": 2}},
    "gone": {"type": "Load", "params": {"file": "clips/nowhere.bvh"}},
    "soft": {"type": "Filter", "inputs": {"motion": "gone.motion"}},
    "softer": {"type": "Filter", "inputs": {"motion": "soft.motion"}})");
  editor.session().select({"walk"}, "walk");
  ASSERT_TRUE(editor.comes_to("softer", State::blocked));
  EXPECT_EQ(editor.state("gone"), State::failed);
  EXPECT_EQ(editor.state("soft"), State::blocked);
  EXPECT_TRUE(editor.is_blocked_by("softer", "gone"));
  EXPECT_TRUE(editor.line_says("1 node failed · 2 nodes blocked")) << qPrintable(editor.line());
  editor.session().perform([](const Document& d, const Registry& r) {
    return set_param(d, r, "gone", "file", Json("clips/walk.bvh"));
  });
  EXPECT_TRUE(editor.comes_to("softer", State::idle));
  EXPECT_NE(editor.state("gone"), State::failed);
}

TEST(EditorStates, ANodeThatNeedsALinkIsAWarningEverywhere) {
  Standing editor(
      R"("feet": {"type": "Footskate"}, "soft": {"type": "Filter", "inputs": {"motion": "feet.motion"}})");
  ASSERT_TRUE(editor.comes_to("feet", State::incomplete));
  ASSERT_TRUE(editor.comes_to("soft", State::blocked));
  EXPECT_TRUE(editor.is_blocked_by("soft", "feet"));
  EXPECT_TRUE(editor.line_says("1 node needs a link · 1 node blocked")) << qPrintable(editor.line());
  for (const Diagnostic& problem : editor.session().problems())
    EXPECT_EQ(shown_severity(problem), Severity::warning) << problem.message;
}

TEST(EditorStates, ANodeOfUnknownTypeIsCalledSo) {
  Standing editor(R"("walk": {"type": "Gait", "params": {"seconds": 2}},
    "hologram": {"type": "Hologram", "inputs": {"motion": "walk.motion"}})");
  EXPECT_TRUE(editor.line_says("1 node of unknown type")) << qPrintable(editor.line());
  QAccessibleInterface* canvas = QAccessible::queryAccessibleInterface(&editor.canvas());
  QStringList values;
  for (int i = 0; i < canvas->childCount(); ++i) values << canvas->child(i)->text(QAccessible::Value);
  EXPECT_TRUE(values.contains("unknown type")) << qPrintable(values.join(", "));
}

TEST(EditorStates, ADisabledNodeThatIsNotLinkedIsNoProblem) {
  Standing editor(R"("mirror": {"type": "Mirror"})");
  QTest::mouseClick(&editor.canvas(), Qt::LeftButton, {}, editor.middle("mirror"));
  ASSERT_TRUE(editor.line_says("1 node needs a link")) << qPrintable(editor.line());
  editor.key(Qt::Key_D);
  ASSERT_TRUE(editor.line_says("Up to date")) << qPrintable(editor.line());
  editor.window.show_dock("Problems");
  auto* list = editor.window.findChild<QTreeWidget*>("problem_list");
  EXPECT_TRUE(QTest::qWaitFor([&] { return list->topLevelItemCount() == 0; }, 5000))
      << qPrintable(list->topLevelItem(0)->text(1));
}

TEST(EditorStates, AGraphOfANewerKinegraphIsReadOnly) {
  Editor editor;
  QFile file(editor.folder.filePath("newer.kg.json"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(R"({"format": "kinegraph", "schema": 99, "nodes": {"walk": {"type": "Gait"}}})");
  file.close();
  editor.window.open(file.fileName());
  ASSERT_TRUE(editor.session().is_read_only());
  const auto* line = editor.window.findChild<StateLine*>();
  EXPECT_TRUE(QTest::qWaitFor([&] { return line->text() == "Read-only"; }, 3000)) << qPrintable(line->text());
}

TEST(EditorStates, ASwitchStandsAsWhatItPassesOn) {
  Standing editor(R"("walk": {"type": "Gait", "params": {"seconds": 2}},
    "gone": {"type": "Load", "params": {"file": "clips/nowhere.bvh"}},
    "choice": {"type": "Switch", "inputs": {"inputs": ["walk.motion", "gone.motion"]}})");
  editor.session().select({"choice"}, "choice");
  EXPECT_TRUE(editor.comes_to("choice", State::done));
  editor.session().perform(
      [](const Document& d, const Registry& r) { return set_param(d, r, "choice", "index", Json(1)); });
  EXPECT_TRUE(editor.comes_to("choice", State::blocked));
  EXPECT_TRUE(editor.is_blocked_by("choice", "gone"));
}

}  // namespace
}  // namespace kinegraph::editor_test
