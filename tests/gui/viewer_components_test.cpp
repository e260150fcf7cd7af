// The components dock in a real window: clicks become entries in a ComponentEdit's edits, which can be
// undone.
#include <gtest/gtest.h>

#include <QPushButton>
#include <QSlider>
#include <QTabWidget>

#include "gui/components/component_edits.h"
#include "gui/components/components_grid.h"
#include "tests/gui/viewing_window.h"

namespace kinegraph {
namespace {

const char* const analysed = R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "walk": {"type": "Gait", "params": {"seconds": 3}},
    "sneak": {"type": "Gait", "params": {"gait": "sneak", "seconds": 3}},
    "ica": {"type": "ICA", "params": {"components": 5}, "inputs": {"motions": ["walk.motion", "sneak.motion"]}}
  }
})";

const Json& edits_of(const ViewingWindow& window) {
  return window.session.document()
      .nodes.find(window.components->edit_node())
      ->second.params.find("edits")
      ->second;
}

struct OpenDock : ViewingWindow {
  OpenDock() : ViewingWindow(analysed) {
    window.findChild<QTabWidget*>()->setCurrentIndex(1);
    session.select({"ica"});
  }
  bool ready() {
    return until([&] { return !components->grid().tile(0).isEmpty() && components->grid().isVisible(); });
  }
  QPushButton* button(const QString& text) {
    for (QPushButton* one : components->findChildren<QPushButton*>())
      if (one->text() == text) return one;
    return nullptr;
  }
};

TEST(ViewerComponents, AClickAndAButtonTakeAComponentAway) {
  OpenDock dock;
  ASSERT_TRUE(dock.problems.empty()) << dock.problems.front().message;
  ASSERT_TRUE(dock.ready());
  dock.keep_picture("components_dark");
  const std::string before = dock.session.text();
  QTest::mouseClick(&dock.components->grid(), Qt::LeftButton, {}, dock.components->grid().tile(1).center());
  ASSERT_TRUE(dock.button("Take away")->isEnabled());
  QTest::mouseClick(dock.button("Take away"), Qt::LeftButton);
  ASSERT_FALSE(dock.components->edit_node().empty());
  EXPECT_EQ(amount_of(edits_of(dock), "scale", 2), 0);
  EXPECT_EQ(edits_of(dock).array().size(), 1u);
  dock.session.undo();  // node, link and edit were one step
  EXPECT_EQ(dock.session.text(), before);
  dock.session.redo();
  EXPECT_EQ(amount_of(edits_of(dock), "scale", 2), 0);
  dock.keep_picture("components_edited");
  dock.set_theme(light_theme());
  dock.keep_picture("components_light");
}

TEST(ViewerComponents, AllFiguresStandInOneRowBelowTheGraph) {
  OpenDock dock;
  ASSERT_TRUE(dock.ready());
  dock.components->setFixedSize(836, 230);  // its room in a window of 1280 x 800
  ASSERT_TRUE(ViewingWindow::until([&] { return dock.components->height() == 230; }));
  ViewingWindow::until([&] { return dock.components->grid().height() <= 230; });
  const ComponentsGrid& grid = dock.components->grid();
  for (int component = 1; component < 5; ++component)
    EXPECT_EQ(grid.tile(component).top(), grid.tile(0).top()) << component;
  EXPECT_LE(grid.tile(4).right(), grid.width());
  EXPECT_LE(grid.height(), 230);
}

TEST(ViewerComponents, ASliderIsOneEntryAndOneStepOfUndo) {
  OpenDock dock;
  ASSERT_TRUE(dock.ready());
  dock.components->grid().choose(0, false);
  QSlider* scale = nullptr;
  for (QSlider* one : dock.components->findChildren<QSlider*>())
    if (one->accessibleName() == "Scale") scale = one;
  ASSERT_NE(scale, nullptr);
  scale->setFocus();
  QTest::keyClick(scale, Qt::Key_PageUp);
  QTest::keyClick(scale, Qt::Key_PageUp);
  EXPECT_EQ(edits_of(dock).array().size(), 1u);
  EXPECT_DOUBLE_EQ(amount_of(edits_of(dock), "scale", 1), 1.5);
  dock.session.undo();
  EXPECT_DOUBLE_EQ(amount_of(edits_of(dock), "scale", 1), 1.25);
}

TEST(ViewerComponents, MergesAndTransfersWhatIsChosen) {
  OpenDock dock;
  ASSERT_TRUE(dock.ready());
  ComponentsGrid& grid = dock.components->grid();
  QTest::mouseClick(&grid, Qt::LeftButton, {}, grid.tile(0).center());
  EXPECT_FALSE(dock.button("Merge")->isEnabled());
  QTest::mouseClick(&grid, Qt::LeftButton, Qt::ControlModifier, grid.tile(2).center());
  QTest::mouseClick(dock.button("Merge"), Qt::LeftButton);
  QTest::mouseClick(dock.button("Transfer"), Qt::LeftButton);
  const Json::Array& entries = edits_of(dock).array();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(compact(entries[0]), R"({"name": "group1", "op": "merge", "terms": [[1, 1], [3, 1]]})");
  EXPECT_EQ(compact(entries[1]), R"({"components": [1, 3], "from": 0, "op": "transfer", "to": 1})");
}

TEST(ViewerComponents, SaysWhatToDoWithoutComponents) {
  ViewingWindow window(R"({"format": "kinegraph", "schema": 1, "nodes": {"walk": {"type": "Gait"}}})");
  window.window.findChild<QTabWidget*>()->setCurrentIndex(1);
  window.keep_picture("components_empty");
  bool told = false;
  for (const QLabel* label : window.components->findChildren<QLabel*>())
    told = told || (label->isVisible() && label->text().contains("ICA"));
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace kinegraph
