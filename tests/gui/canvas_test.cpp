#include <gtest/gtest.h>

#include <QClipboard>
#include <QContextMenuEvent>
#include <QDir>
#include <QFileInfo>
#include <QHelpEvent>
#include <QToolTip>

#include "gui/canvas/clear_wires.h"
#include "tests/gui/editor.h"
#include "tests/places.h"

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

// A third node, dropped on the wire between the two.
struct OnAWire : TwoNodes {
  OnAWire() {
    drag(port(gait, "motion", false), port(metrics, "motion", true));
    drag_node(metrics, {340, 0});
    feet = add("footskate");
    drag_node(feet, {20, 300});
    const QPointF wire = (canvas().scene().port_position({gait, "motion", false}) +
                          canvas().scene().port_position({metrics, "motion", true})) /
                         2;
    drag_node(feet, wire - QPointF(90, 50));
  }
  std::string feet;
};

TEST(EditorCanvas, ANodeDroppedOnAWireIsPutIntoItAndAltDragTakesItOut) {
  OnAWire editor;
  const std::string& feet = editor.feet;
  ASSERT_EQ(editor.links(feet, "motion"), 1u);
  EXPECT_EQ(editor.document().nodes.at(editor.metrics).inputs.at("motion").links[0].node, feet);
  const QPoint at = editor.middle(feet);
  editor.drag(at, at + QPoint(0, 200), Qt::AltModifier);
  EXPECT_EQ(editor.links(feet, "motion"), 0u);
  EXPECT_EQ(editor.document().nodes.at(editor.metrics).inputs.at("motion").links[0].node, editor.gait);
}

TEST(EditorCanvas, AltDragShowsTheLinkThatWillBeBeforeItIsLetGo) {
  OnAWire editor;
  const std::string& feet = editor.feet;
  ASSERT_EQ(editor.links(feet, "motion"), 1u);
  const QPoint middle =
      (editor.port(editor.gait, "motion", false) + editor.port(editor.metrics, "motion", true)) / 2;
  const auto is_drawn = [&] {  // the link past the node, in the colour of what is under way
    const QImage picture = editor.canvas().grab().toImage();
    const QColor accent = editor.canvas().theme().accent;
    for (int y = middle.y() - 3; y <= middle.y() + 3; ++y)
      if (picture.pixelColor(middle.x(), y) == accent) return true;
    return false;
  };
  bool before_release = false;
  const QPoint at = editor.middle(feet);
  editor_test::drag(editor.canvas(), at, at + QPoint(0, 200),
                    {.keys = Qt::AltModifier, .meanwhile = [&] { before_release = is_drawn(); }});
  EXPECT_TRUE(before_release);
  EXPECT_EQ(editor.links(feet, "motion"), 0u);
  editor.settle();
  EXPECT_FALSE(is_drawn());  // now it is a link like any other
}

TEST(EditorCanvas, TipsTellOfNodesPortsAndLinks) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  editor.settle();
  const auto tip = [&](QPoint at) {
    QHelpEvent help(QEvent::ToolTip, at, editor.canvas().mapToGlobal(at));
    QApplication::sendEvent(&editor.canvas(), &help);
    return QToolTip::text();
  };
  const QString gait = QString::fromStdString(editor.gait), metrics = QString::fromStdString(editor.metrics);
  EXPECT_TRUE(tip(editor.middle(editor.gait)).contains("<b>" + gait + "</b> · Gait"));
  EXPECT_TRUE(tip(editor.port(editor.metrics, "contacts", true)).contains("may stay open"));
  const QPoint middle =
      (editor.port(editor.gait, "motion", false) + editor.port(editor.metrics, "motion", true)) / 2;
  EXPECT_TRUE(tip(middle).contains(gait + ".motion</b> → <b>" + metrics + ".motion"))
      << qPrintable(tip(middle));
}

TEST(EditorCanvas, DeleteReconnectsWhatItCan) {
  Editor editor;
  ASSERT_TRUE(editor.session()
                  .open(QString::fromStdString(source_folder()) + "/graphs/style_transfer.kg.json")
                  .empty() ||
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

TEST(EditorCanvas, NodesPasteOutOfAChatToo) {
  Editor editor;
  editor.add("gait");
  editor.key(Qt::Key_C, Qt::ControlModifier);
  QApplication::clipboard()->setText("Look at this:\n" + QApplication::clipboard()->text() + "\nCheers");
  editor.key(Qt::Key_V, Qt::ControlModifier);
  EXPECT_EQ(editor.document().nodes.size(), 2u);
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
  editor.session().open(QString::fromStdString(source_folder()) + "/graphs/style_transfer.kg.json");
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

TEST(EditorCanvas, LinkToOffersWhatIsNeededFirst) {
  Editor editor;
  editor.session().open_text(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "style": {"type": "QuatStats"}, "transfer": {"type": "StyleTransfer"}}})",
                             {});
  editor.session().select({"style"}, "style");
  editor.canvas().setFocus();
  for (const char* port : {"style", "own"}) {
    editor.key(Qt::Key_L);
    editor.type("transfer");
    editor.key(Qt::Key_Return);
    EXPECT_EQ(editor.links("transfer", port), 1u) << port;
  }
  // Both are linked: nothing is left.
  const std::string before = editor.session().text();
  editor.key(Qt::Key_L);
  editor.type("transfer");
  editor.key(Qt::Key_Return);
  EXPECT_EQ(editor.session().text(), before);
}

TEST(EditorCanvas, ANewNodeIsSeenWhole) {
  Editor editor;
  for (int i = 0; i < 5; ++i) {
    const std::string node = editor.add("gait");
    const QRectF box = editor.canvas().scene().node(node)->rect;
    EXPECT_TRUE(editor.canvas().rect().contains(editor.canvas().to_view(box.topLeft()).toPoint())) << i;
    EXPECT_TRUE(editor.canvas().rect().contains(editor.canvas().to_view(box.bottomRight()).toPoint())) << i;
  }
}

TEST(EditorCanvas, ASearchGoesOnWhenANoticeComesUp) {
  Editor editor;
  editor.canvas().setFocus();
  editor.key(Qt::Key_Tab);
  editor.type("ga");
  emit editor.session().refused("Something happened meanwhile", {});
  Editor::settle();
  ASSERT_TRUE(editor.window.findChild<QWidget*>("notice_bar")->isVisible());
  editor.type("it");
  editor.key(Qt::Key_Return);
  EXPECT_EQ(editor.document().nodes.size(), 1u);
}

TEST(EditorCanvas, NodesThatWereNeverPlacedStayWhereTheyAreSeen) {
  const std::string text = R"({"format": "kinegraph", "schema": 1, "nodes": {
    "walk": {"type": "Gait"}, "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}},
    "feet": {"type": "Footskate", "inputs": {"motion": "soft.motion"}}}})";
  Editor editor;
  editor.session().open_text(text, {});
  const auto places = [&] {
    std::map<std::string, QPointF> found;
    for (const char* name : {"walk", "soft"})
      found[name] = editor.canvas().scene().node(name)->rect.topLeft();
    return found;
  };
  const auto seen = places();
  const std::string before = editor.session().text();
  const auto stays = [&](const char* what) {
    for (const auto& [name, at] : places()) {
      EXPECT_NEAR(at.x(), seen.at(name).x(), 5) << name << " after " << what;
      EXPECT_NEAR(at.y(), seen.at(name).y(), 5) << name << " after " << what;
    }
    EXPECT_EQ(editor.session().history().position(), 1u) << what;
    editor.canvas().setFocus();
    editor.key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(editor.session().text(), before) << what;
  };
  editor.drag_node("feet", editor.canvas().scene().node("feet")->rect.topLeft() + QPointF(40, 160));
  stays("a drag");
  editor.session().select({"feet"}, "feet");
  editor.key(Qt::Key_Down, Qt::ControlModifier);
  stays("a step by keys");
  editor.add("metrics");
  stays("a new node");
  editor.session().select({"feet"}, "feet");
  editor.canvas().setFocus();
  editor.key(Qt::Key_D, Qt::ControlModifier);
  stays("a copy");
}

TEST(EditorCanvas, AllIsShownHoweverFarApart) {
  Editor editor;
  editor.session().open_text(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "here": {"type": "Gait"}, "there": {"type": "Gait"}},
    "ui": {"nodes": {"here": {"pos": [0, 0]}, "there": {"pos": [12000, 9000]}}}})",
                             {});
  editor.canvas().setFocus();
  editor.key(Qt::Key_A);
  for (const SceneNode& node : editor.canvas().scene().nodes())
    EXPECT_TRUE(editor.canvas().rect().contains(editor.canvas().to_view(node.rect.center()).toPoint()))
        << node.name;
}

TEST(EditorCanvas, EverythingUndoneIsTheFileAsItWas) {
  Editor editor;
  editor.session().open(QString::fromStdString(source_folder()) + "/graphs/style_transfer.kg.json");
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

struct Examples : testing::Test {
  Examples() {
    const QDir graphs(QString::fromStdString(source_folder()) + "/graphs");
    for (const QString& folder : {graphs.path(), graphs.filePath("pipelines")})
      for (const QFileInfo& file : QDir(folder).entryInfoList({"*.kg.json"})) files << file.filePath();
  }
  GraphScene scene_of(const QString& file) {
    Session session(registry);
    session.open_page(file);
    GraphScene scene;
    scene.rebuild(session.document(), registry, {});
    return scene;
  }
  const Registry registry = all_nodes();
  QStringList files;
};

using EditorExamples = Examples;

// Stills, values and ports make nodes of different heights; none of an example may hide another.
TEST_F(EditorExamples, NoNodeLiesOnAnother) {
  ASSERT_GT(files.size(), 15);
  for (const QString& file : files) {
    const GraphScene scene = scene_of(file);
    for (const SceneNode& a : scene.nodes())
      for (const SceneNode& b : scene.nodes())
        if (a.name < b.name) {
          EXPECT_FALSE(a.rect.intersects(b.rect)) << file.toStdString() << ": " << a.name << ", " << b.name;
        }
  }
}

TEST_F(EditorExamples, NoWireRunsBehindANode) {
  ASSERT_GT(files.size(), 15);
  for (const QString& file : files) {
    const GraphScene scene = scene_of(file);
    for (const SceneWire& wire : scene.wires())
      for (const SceneNode& node : scene.nodes())
        if (node.name != wire.from && node.name != wire.to) {
          EXPECT_EQ(length_inside(wire.line, node.rect), 0)
              << file.toStdString() << ": " << wire.from << " to " << wire.to << " behind " << node.name;
        }
  }
}

TEST(EditorCanvas, AFrameIsUndoneWithTheNodesInIt) {
  TwoNodes editor;
  editor.key(Qt::Key_A, Qt::ControlModifier);
  editor.key(Qt::Key_G);
  editor.type("Both");
  editor.key(Qt::Key_Return);
  const std::string framed = editor.session().text();
  editor.key(Qt::Key_Escape);
  editor.key(Qt::Key_A, Qt::ControlModifier);
  editor.key(Qt::Key_Delete);
  EXPECT_TRUE(editor.document().nodes.empty());
  EXPECT_TRUE(editor.document().ui.frames.empty());
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), framed);
}

// What lies on top takes the mouse: a port below it is not there for the hand.
TEST(EditorCanvas, APortUnderAnotherNodeIsNotGrabbed) {
  TwoNodes editor;
  const QPointF port = editor.canvas().scene().port_position({editor.gait, "motion", false});
  editor.drag_node(editor.metrics, port - QPointF(90, 14));
  const SceneNode* over = editor.canvas().scene().node_at(port);
  ASSERT_TRUE(over);
  const std::string covering = over->name;
  EXPECT_EQ(covering, editor.metrics);  // what is chosen lies on top
  const QPointF before = editor.canvas().scene().node(covering)->rect.topLeft();
  const QPoint at = editor.middle(covering);
  editor.drag(at, at + QPoint(0, 120));
  EXPECT_NE(editor.canvas().scene().node(covering)->rect.topLeft(), before);
  EXPECT_EQ(editor.links(editor.metrics, "motion"), 0u);
  EXPECT_FALSE(editor.canvas().findChild<QWidget*>("search_box")->isVisible());
}

TEST(EditorCanvas, TheMenuOfALinkCutsItOrPutsADot) {
  TwoNodes editor;
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  const auto choose = [&](int entry) {
    const SceneWire& wire = editor.canvas().scene().wires().front();
    const QPoint at = editor.canvas().to_view((wire.line.first() + wire.line.last()) / 2).toPoint();
    editor.when_asked([entry](QWidget& menu) {
      for (int i = 0; i <= entry; ++i) QTest::keyClick(&menu, Qt::Key_Down);
      QTest::keyClick(&menu, Qt::Key_Return);
    });
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, editor.canvas().mapToGlobal(at));
    QApplication::sendEvent(&editor.canvas(), &event);
    editor.settle();
  };
  choose(0);
  ASSERT_EQ(editor.document().nodes.size(), 3u);
  const std::string from = editor.document().nodes.at(editor.metrics).inputs.at("motion").links[0].node;
  EXPECT_EQ(editor.document().nodes.at(from).type, "Dot");
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  choose(1);
  EXPECT_EQ(editor.links(editor.metrics, "motion"), 0u);
}

TEST(EditorCanvas, ANodeThatIsNotLinkedYetSaysWhatItNeeds) {
  TwoNodes editor;
  QTest::mouseClick(&editor.canvas(), Qt::LeftButton, {}, editor.middle(editor.metrics));
  ASSERT_TRUE(QTest::qWaitFor([&] {
    const NodeStatus* status = editor.window.evaluation().status(editor.metrics);
    return status && status->state == NodeStatus::State::incomplete;
  }));
  const Diagnostics& said = editor.window.evaluation().status(editor.metrics)->diagnostics;
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].port, "motion");
  EXPECT_FALSE(said[0].hint.empty());
  editor.drag(editor.port(editor.gait, "motion", false), editor.port(editor.metrics, "motion", true));
  EXPECT_TRUE(QTest::qWaitFor([&] {
    const NodeStatus* status = editor.window.evaluation().status(editor.metrics);
    return status && status->state != NodeStatus::State::incomplete;
  }));
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
