#include <gtest/gtest.h>

#include <QClipboard>
#include <QDir>
#include <QFileInfo>

#include "tests/gui/editor.h"

namespace kinegraph::editor_test {
namespace {

TEST(EditorCanvas, TabAndAFewLettersAddANode) {
  Editor editor;
  const std::string gait = editor.add("gait");
  ASSERT_EQ(editor.document().nodes.size(), 1u);
  EXPECT_EQ(editor.document().nodes.at(gait).type, "Gait");
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(editor.document().nodes.empty());
}

struct TwoNodes : Editor {
  TwoNodes() {
    gait = add("gait");
    drag_node(gait, {-300, 0});
    metrics = add("metrics");
    drag_node(metrics, {100, 0});
  }
  std::string gait, metrics;
};

TEST(EditorCanvas, AWireIsDraggedFromAnOutputToAnInput) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  ASSERT_EQ(editor.links(editor.metrics, "motion"), 1u);
  EXPECT_EQ(editor.document().nodes.at(editor.metrics).inputs.at("motion").links[0].node, editor.gait);
}

TEST(EditorCanvas, AWireIsDraggedFromAnInputToAnOutput) {
  TwoNodes editor;
  editor.drag(editor.port(editor.metrics, "motion", true), editor.port(editor.gait, "motion", false));
  EXPECT_EQ(editor.links(editor.metrics, "motion"), 1u);
}

TEST(EditorCanvas, AWireThatDoesNotFitIsRefused) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "contacts", true));
  EXPECT_EQ(editor.links(editor.metrics, "contacts"), 0u);
  EXPECT_EQ(editor.links(editor.metrics, "motion"), 0u);
}

TEST(EditorCanvas, ALinkIsTakenOffByDraggingItsEndAway) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  const QPoint end = editor.port(editor.metrics, "motion", true);
  editor.drag(end, end + QPoint(-60, 160));
  EXPECT_EQ(editor.links(editor.metrics, "motion"), 0u);
}

TEST(EditorCanvas, AWireLetGoOnEmptySpaceOffersWhatFitsAndLinksIt) {
  Editor editor;
  const std::string gait = editor.add("gait");
  editor.drag_node(gait, {-300, 0});
  const QPoint from = editor.port(gait, "motion", false);
  editor.drag(from, from + QPoint(150, 20));
  editor.type("footsk");
  editor.key(Qt::Key_Return);
  const std::string added = editor.session().current();
  ASSERT_EQ(editor.document().nodes.at(added).type, "Footskate");
  EXPECT_EQ(editor.links(added, "motion"), 1u);
}

TEST(EditorCanvas, ADragOfManyStepsIsOneStepOfUndo) {
  TwoNodes editor;
  const std::string before = editor.session().text();
  const std::size_t steps = editor.session().history().position();
  editor.drag_node(editor.gait, {-340, 90});
  EXPECT_EQ(editor.session().history().position(), steps + 1);
  EXPECT_NE(editor.session().text(), before);
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), before);
}

TEST(EditorCanvas, CtrlDragCutsTheWiresItCrosses) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  const QPoint middle =
      (editor.port(editor.gait, "motion", false) + editor.port(editor.metrics, "motion", true)) / 2;
  editor.drag(middle - QPoint(0, 80), middle + QPoint(0, 80), Qt::ControlModifier);
  EXPECT_EQ(editor.links(editor.metrics, "motion"), 0u);
}

TEST(EditorCanvas, ANodeDroppedOnAWireIsPutIntoItAndAltDragTakesItOut) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  editor.drag_node(editor.metrics, {340, 0});
  const std::string feet = editor.add("footskate");
  editor.drag_node(feet, {20, 300});
  const QPointF wire = (editor.canvas().scene().port_position({editor.gait, "motion", false}) +
                        editor.canvas().scene().port_position({editor.metrics, "motion", true})) /
                       2;
  editor.drag_node(feet, wire - QPointF(90, 50));
  ASSERT_EQ(editor.links(feet, "motion"), 1u);
  EXPECT_EQ(editor.document().nodes.at(editor.metrics).inputs.at("motion").links[0].node, feet);
  const QPoint at = editor.middle(feet);
  editor.drag(at, at + QPoint(0, 200), Qt::AltModifier);
  EXPECT_EQ(editor.links(feet, "motion"), 0u);
  EXPECT_EQ(editor.document().nodes.at(editor.metrics).inputs.at("motion").links[0].node, editor.gait);
}

TEST(EditorCanvas, DeleteReconnectsWhatItCan) {
  Editor editor;
  ASSERT_TRUE(
      editor.session().open(QString(KINEGRAPH_SOURCE_DIR) + "/graphs/style_transfer.kg.json").empty() ||
      !has_error(editor.session().problems()));
  editor.canvas().setFocus();
  editor.session().select({"unwarp"}, "unwarp");
  editor.key(Qt::Key_Delete);
  ASSERT_FALSE(editor.document().nodes.count("unwarp"));
  EXPECT_EQ(to_text(editor.document().nodes.at("feet").inputs.at("motion").links.at(0)), "transfer.motion");
}

TEST(EditorCanvas, CopiedNodesAreGraphTextAndPasteWithTheirLinks) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  editor.key(Qt::Key_A, Qt::ControlModifier);
  editor.key(Qt::Key_C, Qt::ControlModifier);
  EXPECT_TRUE(QApplication::clipboard()->text().contains("\"format\": \"kinegraph\""));
  editor.key(Qt::Key_V, Qt::ControlModifier);
  ASSERT_EQ(editor.document().nodes.size(), 4u);
  std::size_t linked = 0;
  for (const auto& [name, node] : editor.document().nodes) linked += node.inputs.count("motion");
  EXPECT_EQ(linked, 2u);
}

TEST(EditorCanvas, KeysOfOneLetterDisableGroupAndArrange) {
  TwoNodes editor;
  editor.key(Qt::Key_D);
  EXPECT_FALSE(editor.document().nodes.at(editor.metrics).enabled);
  editor.key(Qt::Key_D);
  EXPECT_TRUE(editor.document().nodes.at(editor.metrics).enabled);
  editor.key(Qt::Key_G);
  editor.type("Judging");
  editor.key(Qt::Key_Return);
  ASSERT_EQ(editor.document().ui.frames.size(), 1u);
  EXPECT_EQ(editor.document().ui.frames.begin()->second.find("title")->string(), "Judging");
  editor.key(Qt::Key_L, Qt::ControlModifier);
  EXPECT_FALSE(editor.canvas()
                   .scene()
                   .node(editor.gait)
                   ->rect.intersects(editor.canvas().scene().node(editor.metrics)->rect));
}

TEST(EditorCanvas, ArrowKeysWalkAlongTheLinks) {
  Editor editor;
  editor.session().open(QString(KINEGRAPH_SOURCE_DIR) + "/graphs/style_transfer.kg.json");
  editor.canvas().setFocus();
  editor.session().select({"transfer"}, "transfer");
  editor.key(Qt::Key_Right);
  EXPECT_EQ(editor.session().current(), "unwarp");
  editor.key(Qt::Key_Left);
  EXPECT_EQ(editor.session().current(), "transfer");
}

TEST(EditorCanvas, ZoomKeepsWhatIsUnderThePointer) {
  TwoNodes editor;
  const QPointF at(200, 150);
  const QPointF graph = editor.canvas().to_graph(at);
  editor.canvas().zoom_at(at, -3);
  EXPECT_LT(editor.canvas().zoom(), 1);
  EXPECT_NEAR(editor.canvas().to_graph(at).x(), graph.x(), 1e-6);
  EXPECT_NEAR(editor.canvas().to_graph(at).y(), graph.y(), 1e-6);
}

TEST(EditorCanvas, EverythingUndoneIsTheFileAsItWas) {
  Editor editor;
  editor.session().open(QString(KINEGRAPH_SOURCE_DIR) + "/graphs/style_transfer.kg.json");
  const std::string before = editor.session().text();
  editor.canvas().setFocus();
  editor.canvas().frame_all();
  editor.add("gait");
  editor.key(Qt::Key_D);
  editor.session().select({"transfer", "unwarp"}, "transfer");
  editor.canvas().setFocus();
  editor.key(Qt::Key_D, Qt::ControlModifier);
  editor.key(Qt::Key_Delete);
  editor.session().select({"walk"}, "walk");
  editor.drag_node("walk", {-50, -70});
  editor.key(Qt::Key_L, Qt::ControlModifier);
  EXPECT_NE(editor.session().text(), before);
  while (editor.session().can_undo()) editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), before);
}

// Stills, values and ports make nodes of different heights; none of an example may hide another.
TEST(EditorExamples, NoNodeLiesOnAnother) {
  const Registry registry = all_nodes();
  const QDir graphs(QString(KINEGRAPH_SOURCE_DIR) + "/graphs");
  QStringList files;
  for (const QString& folder : {graphs.path(), graphs.filePath("pipelines")})
    for (const QFileInfo& file : QDir(folder).entryInfoList({"*.kg.json"})) files << file.filePath();
  ASSERT_GT(files.size(), 15);
  for (const QString& file : files) {
    Session session(registry);
    session.open_page(file);
    GraphScene scene;
    scene.rebuild(session.document(), registry, {});
    for (const SceneNode& a : scene.nodes())
      for (const SceneNode& b : scene.nodes())
        if (a.name < b.name) {
          EXPECT_FALSE(a.rect.intersects(b.rect)) << file.toStdString() << ": " << a.name << ", " << b.name;
        }
  }
}

TEST(EditorCanvas, NodesAddedAtOnePlaceStandBelowEachOther) {
  Editor editor;
  for (int i = 0; i < 3; ++i) editor.canvas().add("Load", {0, 0});
  const auto& nodes = editor.canvas().scene().nodes();
  ASSERT_EQ(nodes.size(), 3u);
  for (const SceneNode& a : nodes)
    for (const SceneNode& b : nodes) EXPECT_TRUE(a.name == b.name || !a.rect.intersects(b.rect));
}

}  // namespace
}  // namespace kinegraph::editor_test
