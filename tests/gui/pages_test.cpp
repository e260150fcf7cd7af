// Graphs inside graphs, and several graphs in one window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QFile>
#include <QFileDialog>
#include <QProgressBar>
#include <QPushButton>
#include <QTabBar>
#include <QTimer>
#include <fstream>

#include "graph/nested.h"
#include "gui/viewer/viewer.h"
#include "tests/gui/editor.h"
#include "tests/gui/long_row.h"
#include "tests/mocap.h"
#include "tests/places.h"

namespace kinegraph::editor_test {
namespace {

const QString graphs = QString::fromStdString(source_folder()) + "/graphs/";

void copy_graphs(const QTemporaryDir& folder) {
  QDir(folder.path()).mkpath("pipelines");
  for (const char* name : {"reuse.kg.json", "pipelines/sneakify.kg.json", "pipelines/restyle.kg.json",
                           "pipelines/clean_feet.kg.json"})
    ASSERT_TRUE(QFile::copy(graphs + name, folder.filePath(name))) << name;
}

struct Reuse : Editor {
  Reuse() {
    copy_graphs(folder);
    EXPECT_TRUE(window.open(folder.filePath("reuse.kg.json")));
    canvas().setFocus();
    canvas().frame_all();
    settle();
  }
  QTabBar& tabs() { return *window.findChild<QTabBar*>("pages"); }
  void double_click(const std::string& node) {
    QTest::mouseDClick(&canvas(), Qt::LeftButton, Qt::NoModifier, middle(node));
    settle();
  }
};

TEST(EditorPages, AGraphNodeShowsWhatItsFilePublishesAndIsEvaluated) {
  Reuse editor;
  const SceneNode& node = *editor.canvas().scene().node("sneaky");
  EXPECT_FALSE(node.missing);
  EXPECT_TRUE(node.port(true, "motion"));
  EXPECT_TRUE(node.port(false, "motion"));
  EXPECT_FALSE(has_error(editor.session().problems()));
  ASSERT_TRUE(editor.wait_for_evaluation());
  EXPECT_TRUE(QTest::qWaitFor([&] { return editor.window.evaluation().value("sneaky", "motion") != nullptr; },
                              30000));
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.window.evaluation().status("sneaky") != nullptr; }, 5000));
  EXPECT_EQ(editor.window.evaluation().status("sneaky")->state, NodeStatus::State::done);
}

TEST(EditorPages, ADoubleClickOpensItsFileInATabWithItsOwnUndo) {
  Reuse editor;
  editor.double_click("sneaky");
  ASSERT_EQ(editor.session().pages(), 2);
  EXPECT_EQ(editor.session().title(), "sneakify.kg.json");
  EXPECT_TRUE(editor.tabs().isVisible());
  EXPECT_FALSE(editor.session().can_undo());
  editor.add("gait");
  EXPECT_TRUE(editor.session().can_undo());
  editor.key(Qt::Key_PageUp, Qt::ControlModifier);
  EXPECT_EQ(editor.session().title(), "reuse.kg.json");
  EXPECT_FALSE(editor.session().can_undo());
  editor.key(Qt::Key_PageDown, Qt::ControlModifier);
  EXPECT_TRUE(editor.session().can_undo());
}

TEST(EditorPages, TheOuterGraphFollowsUnsavedChanges) {
  Reuse editor;
  ASSERT_TRUE(editor.canvas().scene().node("sneaky")->port(false, "motion"));
  editor.double_click("sneaky");
  editor.session().perform([](const Document& d, const Registry&) {
    return set_unit(d, {Unit::Kind::publish_output, "again", {}},
                    Json(to_text(d.publish.outputs.at("motion").front())), "Publish again");
  });
  editor.key(Qt::Key_PageUp, Qt::ControlModifier);
  const Document& outer = editor.document();
  const NodeType* type = known_type(editor.registry, outer.nodes.at("sneaky"));
  ASSERT_TRUE(type);
  EXPECT_TRUE(type->find_output("again"));
  EXPECT_THAT(editor.session().modified_inside(), testing::ElementsAre(1));
}

TEST(EditorPages, AFileInsideThatChangesOnDiskIsReadAgain) {
  Reuse editor;
  const QString path = editor.folder.filePath("pipelines/sneakify.kg.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  QByteArray text = file.readAll();
  file.close();
  text.replace(
      "\"outputs\": {",
      "\"outputs\": {\n      \"again\": \"" +
          QByteArray::fromStdString(to_text(
              editor.document().nodes.at("sneaky").nested->document->publish.outputs.at("motion").front())) +
          "\",");
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(text);
  file.close();
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const NodeType* type = known_type(editor.registry, editor.document().nodes.at("sneaky"));
        return type && type->find_output("again");
      },
      5000));
}

TEST(EditorPages, CtrlGMakesTheSelectionAGraphFile) {
  Editor editor;
  const QString path = editor.folder.filePath("main.kg.json");
  ASSERT_TRUE(QFile::copy(graphs + "style_transfer.kg.json", path));
  ASSERT_TRUE(QFile::link(graphs + "clips", editor.folder.filePath("clips")));
  ASSERT_TRUE(editor.window.open(path));
  const std::string before = editor.session().text();
  const auto choose = [&] {
    editor.session().select({"style", "transfer"}, "transfer");
    editor.canvas().setFocus();
  };
  choose();
  QTimer::singleShot(0, &editor.window, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    ASSERT_TRUE(dialog);
    dialog->findChild<QLineEdit*>("fileNameEdit")->setText(editor.folder.filePath("styled.kg.json"));
    QTest::keyClick(dialog->findChild<QLineEdit*>("fileNameEdit"), Qt::Key_Return);
  });
  editor.key(Qt::Key_G, Qt::ControlModifier);
  ASSERT_TRUE(QFile::exists(editor.folder.filePath("styled.kg.json")));
  EXPECT_FALSE(editor.document().nodes.count("transfer"));
  EXPECT_FALSE(has_error(editor.session().problems()));
  EXPECT_EQ(editor.document().nodes.at(editor.session().current()).type, "Graph");
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), before);
  EXPECT_TRUE(QFile::exists(editor.folder.filePath("styled.kg.json")));
}

TEST(EditorPages, OpeningAnotherGraphKeepsTheFirstInItsTab) {
  Reuse editor;
  editor.add("gait");
  ASSERT_TRUE(editor.window.open(graphs + "feet.kg.json"));
  EXPECT_EQ(editor.session().pages(), 2);
  EXPECT_TRUE(editor.session().is_page_modified(0));
}

TEST(EditorEvaluation, WhatIsWrongStandsAsideAndTheRestRuns) {
  Editor editor;
  const std::string gait = editor.add("gait");
  const std::string feet = editor.add("footskate");  // its motion is open
  editor.session().select({gait}, gait);
  ASSERT_TRUE(editor.wait_for_evaluation());
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return editor.window.evaluation().value(gait, "motion") != nullptr; }, 20000));
  ASSERT_TRUE(editor.window.evaluation().status(feet));
  EXPECT_EQ(editor.window.evaluation().status(feet)->state, NodeStatus::State::incomplete);
}

TEST(EditorEvaluation, WhatIsWrongThroughAnotherNodeIsMendedByItsRemoval) {
  Editor editor;
  editor.session().open_text(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "walk": {"type": "Gait"},
    "out": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "walk.motion"}}}})",
                             {});
  editor.session().select({"out"}, "out");
  ASSERT_TRUE(editor.wait_for_evaluation());
  const auto failed = [&] {
    const NodeStatus* status = editor.window.evaluation().status("out");
    return status && status->state == NodeStatus::State::failed;
  };
  EXPECT_FALSE(failed());
  editor.canvas().setFocus();
  editor.key(Qt::Key_D, Qt::ControlModifier);  // its copy writes the same file
  ASSERT_TRUE(editor.wait_for_evaluation());
  EXPECT_TRUE(failed());
  editor.canvas().setFocus();
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(editor.wait_for_evaluation());
  EXPECT_FALSE(failed());
}

TEST(EditorEvaluation, ANodeThatWaitsForAnotherSaysSo) {
  Editor editor;
  editor.session().open_text(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "a": {"type": "Gait", "params": {"seconds": 200}},
    "b": {"type": "Gait", "params": {"gait": "sneak", "seconds": 200}},
    "warp": {"type": "TimeWarp", "inputs": {"source": "a.motion", "reference": "b.motion"}},
    "back": {"type": "UnwarpTime", "inputs": {"motion": "warp.warped", "warp": "warp.warp"}}}})",
                             {});
  editor.session().select({"back"}, "back");
  const auto state = [&](const char* node) {
    const NodeStatus* status = editor.window.evaluation().status(node);
    return status ? status->state : NodeStatus::State::idle;
  };
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        return state("warp") == NodeStatus::State::running && state("back") == NodeStatus::State::waiting;
      },
      60000));
  // Whoever cancels sees that neither goes on.
  editor.canvas().setFocus();
  editor.key(Qt::Key_Period, Qt::ControlModifier);
  EXPECT_TRUE(QTest::qWaitFor([&] { return state("back") == NodeStatus::State::cancelled; }, 20000));
}

TEST(EditorEvaluation, AnotherNodeChosenKeepsTheLongWorkThatItNeedsToo) {
  Editor editor;
  editor.session().open_text(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "a": {"type": "Gait", "params": {"seconds": 80}},
    "b": {"type": "Gait", "params": {"gait": "sneak", "seconds": 80}},
    "warp": {"type": "TimeWarp", "inputs": {"source": "a.motion", "reference": "b.motion"}},
    "back": {"type": "UnwarpTime", "inputs": {"motion": "warp.warped", "warp": "warp.warp"}},
    "turned": {"type": "Mirror", "inputs": {"motion": "warp.warped"}}}})",
                             {});
  double furthest = 0;
  int fell_back = 0;
  QObject::connect(&editor.window.evaluation(), &Evaluation::status_changed, &editor.window, [&] {
    const NodeStatus* warp = editor.window.evaluation().status("warp");
    if (!warp || warp->state == NodeStatus::State::done) return;
    fell_back += warp->progress < furthest || (furthest > 0 && warp->state != NodeStatus::State::running);
    furthest = std::max(furthest, warp->progress);
  });
  editor.session().select({"back"}, "back");
  ASSERT_TRUE(QTest::qWaitFor([&] { return furthest > 0; }, 180000));
  // Hither and thither, and an edit of what it does not depend on.
  for (const char* chosen : {"turned", "warp", "back", "turned"}) {
    editor.session().select({chosen}, chosen);
    QTest::qWait(20);
  }
  editor.canvas().setFocus();
  editor.key(Qt::Key_D);
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const NodeStatus* turned = editor.window.evaluation().status("turned");
        return turned && turned->state == NodeStatus::State::done && !editor.window.is_evaluating();
      },
      180000));
  EXPECT_EQ(fell_back, 0);
  EXPECT_TRUE(editor.window.evaluation().value("turned", "motion"));
}

TEST(EditorEvaluation, AMotionsNodeHasAStill) {
  Editor editor;
  const std::string gait = editor.add("gait");
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const NodeStatus* status = editor.window.evaluation().status(gait);
        return status && status->still;
      },
      20000));
  const Still& still = *editor.window.evaluation().status(gait)->still;
  EXPECT_EQ(still.figures, 5);
  EXPECT_NEAR(still.height, 1, 0.15);
  EXPECT_FALSE(editor.canvas().scene().node(gait)->still.isNull());
}

TEST(EditorPages, AGraphNodeWhoseFileIsGoneIsMendedAmongItsParameters) {
  Reuse editor;
  editor.session().select({"sneaky"}, "sneaky");
  const auto file_field = [&] {
    auto* row = editor.window.findChild<QWidget*>("param_file");
    return row ? row->findChild<QLineEdit*>() : nullptr;
  };
  const auto name = [&](const QString& path) {
    QLineEdit* line = file_field();
    ASSERT_TRUE(line);
    QTest::mouseClick(line, Qt::LeftButton);
    editor.key(Qt::Key_A, Qt::ControlModifier);
    editor.type(path);
    editor.key(Qt::Key_Return);
  };
  ASSERT_TRUE(file_field());
  const QString right = file_field()->text();
  name("pipelines/nowhere.kg.json");
  EXPECT_TRUE(has_error(editor.session().problems()));
  name(right);
  EXPECT_FALSE(has_error(editor.session().problems()));
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(has_error(editor.session().problems()));
}

// Sixty files of a thousand nodes inside a graph, which take far longer to read than a window may stand
// still.
struct ManyInside : Editor {
  ManyInside() : path(folder.filePath("outer.kg.json")) {
    const std::string inside = long_row();
    std::string outer = R"({"format": "kinegraph", "schema": 1, "nodes": {"walk": {"type": "Gait"})";
    for (int i = 0; i < 60; ++i) {
      const std::string file = "inside" + std::to_string(i) + ".kg.json";
      std::ofstream(folder.filePath(QString::fromStdString(file)).toStdString()) << inside;
      outer += ",\n\"g" + std::to_string(i) + R"(": {"type": "Graph", "params": {"file": ")" + file + "\"}}";
    }
    std::ofstream(path.toStdString()) << outer << "}}";
    QObject::connect(&turn, &QTimer::timeout, [this] { ++turns; });
    turn.start(1);
  }
  bool all_read() {
    for (const auto& [name, node] : document().nodes)
      if (name != "walk" && (!node.nested || !node.nested->document)) return false;
    return true;
  }
  QString path;
  QTimer turn;
  int turns = 0;
};

TEST(EditorPages, TheWindowLivesWhileManyFilesInsideAreRead) {
  ManyInside editor;
  ASSERT_TRUE(editor.window.open(editor.path));
  EXPECT_GT(editor.turns, 10) << "the window stood still while the graph was opened";
  EXPECT_TRUE(editor.all_read());
  // A colleague's pull: they are read again, by and by.
  editor.turns = 0;
  editor.session().reopen_inside();
  EXPECT_TRUE(editor.session().is_reading_inside());
  EXPECT_TRUE(QTest::qWaitFor([&] { return editor.window.findChild<QProgressBar*>()->isVisible(); }, 60000));
  EXPECT_TRUE(QTest::qWaitFor([&] { return !editor.session().is_reading_inside(); }, 60000));
  EXPECT_GT(editor.turns, 10);
  EXPECT_TRUE(editor.all_read());
}

TEST(EditorPages, ReadingManyFilesInsideIsCancelledAndTakenUpAgain) {
  ManyInside editor;
  ASSERT_TRUE(editor.window.open(editor.path));
  editor.session().reopen_inside();
  ASSERT_TRUE(editor.session().is_reading_inside());
  editor.canvas().setFocus();
  editor.key(Qt::Key_Period, Qt::ControlModifier);
  EXPECT_FALSE(editor.session().is_reading_inside());
  QPushButton* again = nullptr;
  for (QPushButton* button : editor.window.findChildren<QPushButton*>())
    if (button->text() == "Read them" && button->isVisible()) again = button;
  ASSERT_TRUE(again);
  QTest::mouseClick(again, Qt::LeftButton);
  EXPECT_TRUE(editor.session().is_reading_inside());
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return !editor.session().is_reading_inside() && editor.all_read(); }, 60000));
}

TEST(EditorPages, OfThirtyOpenGraphsTheShownOnesTabIsSeen) {
  Editor editor;
  for (int i = 0; i < 30; ++i) {
    const QString path = editor.folder.filePath(QString("walk_of_day_%1.kg.json").arg(i));
    ASSERT_TRUE(QFile::copy(graphs + "feet.kg.json", path));
    ASSERT_TRUE(editor.window.open(path));
  }
  auto* tabs = editor.window.findChild<QTabBar*>("pages");
  ASSERT_EQ(tabs->count(), 30);
  EXPECT_EQ(editor.window.width(), 1280);
  editor.canvas().setFocus();
  for (int i = 0; i < 30; ++i) {
    Editor::settle();
    const QRect tab = tabs->tabRect(tabs->currentIndex());
    EXPECT_TRUE(tabs->rect().contains(tab)) << tabs->currentIndex();
    EXPECT_GT(tab.width(), tabs->fontMetrics().horizontalAdvance("walk_of_day_1"));
    editor.key(Qt::Key_PageDown, Qt::ControlModifier);
  }
  for (int i = 30; i > 1; --i) {
    EXPECT_EQ(editor.session().pages(), i);
    editor.key(Qt::Key_W, Qt::ControlModifier);
  }
}

TEST(EditorPages, EachPageKeepsThePinsOfItsViewer) {
  Editor editor;
  editor.window.open(graphs + "style_transfer.kg.json");
  auto* viewer = editor.window.findChild<Viewer*>();
  viewer->pin(1, "walk");
  viewer->pin(2, "feet");
  editor.window.open(graphs + "sneaky_walk.kg.json");
  EXPECT_EQ(viewer->pinned(1), "");
  viewer->pin(1, "sneak");
  editor.session().show_page(0);
  EXPECT_EQ(viewer->pinned(1), "walk");
  EXPECT_EQ(viewer->pinned(2), "feet");
  editor.session().show_page(1);
  EXPECT_EQ(viewer->pinned(1), "sneak");
  EXPECT_EQ(viewer->pinned(2), "");
}

// Every real motion file, of whatever kind, shows what it holds as soon as its Load is chosen.
TEST(EditorViewer, ALoadOfMarkersShowsThemWithoutALink) {
  KINEGRAPH_NEEDS_MOCAP();
  Editor editor;
  editor.canvas().add("Load", {0, 0}, {}, {{"file", Json(mocap("points/walking2.c3d"))}});
  auto* viewer = editor.window.findChild<Viewer*>();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return viewer->shown().size() == 1 && viewer->shown()[0].motion; }, 20000));
  EXPECT_TRUE(viewer->shown()[0].motion->markers);
  EXPECT_EQ(editor.window.evaluation().status(editor.session().current())->state, NodeStatus::State::done);
}

}  // namespace
}  // namespace kinegraph::editor_test
