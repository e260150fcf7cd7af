// Pictures of the canvas: port types, states of nodes, gestures under way.
#include "gui/canvas/canvas_edits.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

const char* const every_port =
    R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
  "strut": {"type": "Load", "params": {"file": "clips/strut.bvh"}},
  "warp": {"type": "TimeWarp", "inputs": {"source": "walk.motion", "reference": "strut.motion"}},
  "style": {"type": "QuatStats", "inputs": {"motion": "warp.reference"}},
  "transfer": {"type": "StyleTransfer", "inputs": {"motion": "warp.warped", "style": "style.stats"}},
  "unwarp": {"type": "UnwarpTime", "inputs": {"motion": "transfer.motion", "warp": "warp.warp"}},
  "plants": {"type": "DetectContacts", "inputs": {"motion": "walk.motion"}},
  "feet": {"type": "Footskate", "inputs": {"motion": "unwarp.motion", "contacts": "plants.contacts"}},
  "parts": {"type": "ICA", "params": {"components": 3}, "inputs": {"motions": ["walk.motion", "strut.motion"]}},
  "edit": {"type": "ComponentEdit", "inputs": {"components": "parts.components"}},
  "sparks": {"type": "Burst"},
  "figures": {"type": "Metrics", "inputs": {"motion": "feet.motion", "contacts": "feet.contacts"}},
  "judge": {"type": "Check", "params": {"rules": ["skate < 0.05"]}, "inputs": {"metrics": "figures.metrics"}},
  "cloud": {"type": "Export", "params": {"file": "cloud.csv"}, "inputs": {"points": "sparks.points"}},
  "out": {"type": "Export", "params": {"file": "edited.bvh"}, "inputs": {"motion": "edit.motion"}},
  "body": {"type": "Load", "params": {"file": "characters/mannequin.glb"}},
  "skin": {"type": "RubberJoints", "inputs": {"motion": "body.motion", "character": "body.character"}},
  "rubbery": {"type": "Export", "params": {"file": "rubber.glb"}, "inputs": {"motion": "skin.motion",
    "character": "skin.character"}})";

const char* const states = R"("long_walk": {"type": "Gait", "params": {"seconds": 150}},
  "long_sneak": {"type": "Gait", "params": {"seconds": 140, "gait": "sneak"}},
  "running": {"type": "TimeWarp", "inputs": {"source": "long_walk.motion", "reference": "long_sneak.motion"}},
  "waiting": {"type": "UnwarpTime", "inputs": {"motion": "running.warped", "warp": "running.warp"}},
  "gone": {"type": "Load", "params": {"file": "clips/nowhere.bvh"}},
  "blocked": {"type": "Filter", "inputs": {"motion": "gone.motion"}},
  "unknown": {"type": "Hologram", "inputs": {"motion": "walk.motion"}},
  "walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
  "done": {"type": "Filter", "inputs": {"motion": "walk.motion"}},
  "disabled": {"type": "Mirror", "enabled": false, "inputs": {"motion": "done.motion"}},
  "open": {"type": "Footskate"})";

void ports_and_states(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.take("empty" + end);
    shot.press(Qt::Key_Tab);
    shot.type("style");
    shot.take_widget("search" + end, &shot.canvas());
  }
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.select("transfer");
    shot.canvas().frame_all();
    shot.wait();
    shot.take("window" + end);
  }
  {
    Shot shot(theme, into, {2200, 1250});
    shot.text(every_port);
    shot.wait(1500);
    shot.take_canvas("port_types" + end);
  }
  {
    Shot shot(theme, into, {1680, 1560});
    shot.text(states);
    shot.select("done");
    shot.wait(800);
    shot.select("waiting");
    shot.canvas().frame_all();
    QElapsedTimer clock;
    for (clock.start(); clock.elapsed() < 60000;) {
      QApplication::processEvents(QEventLoop::AllEvents, 20);
      const NodeStatus* running = shot.window.evaluation().status("running");
      const NodeStatus* waiting = shot.window.evaluation().status("waiting");
      const bool well_under_way = running && running->progress > 0.15;
      if ((well_under_way || clock.elapsed() > 20000) && running &&
          running->state == NodeStatus::State::running && waiting &&
          waiting->state == NodeStatus::State::waiting)
        break;
    }
    shot.take_widget("node_states" + end, &shot.canvas());
    shot.window.resize(1280, 800);
    shot.window.action("reset_layout")->trigger();
    QApplication::processEvents();
    shot.canvas().show_rect(shot.canvas().scene().bounds_of({"long_sneak", "gone", "running", "waiting"}));
    shot.wait(0);
    shot.take("running" + end);
    shot.window.evaluation().cancel();
  }
}

void gestures_ended(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.canvas().show_rect(
        shot.canvas().scene().bounds_of({"style", "transfer", "unwarp"}).adjusted(-30, -60, 30, 60));
    shot.wait();
    shot.drag(shot.port("transfer", "motion", false), shot.port("style", "motion", true) + QPoint(2, 0));
    shot.take_widget("refused_wire" + end, &shot.canvas());
    QTest::keyClick(&shot.canvas(), Qt::Key_Escape);
    shot.drag(shot.port("style", "stats", false), shot.port("unwarp", "motion", true) + QPoint(-2, 0));
    shot.take_widget("refused_type" + end, &shot.canvas());
  }
  {
    Shot shot(theme, into);
    shot.open("sneaky_walk");
    const QPoint from = shot.port("sneak", "motion", false);
    shot.drag(from, from + QPoint(20, 60));
    QTest::mouseRelease(&shot.canvas(), Qt::LeftButton, Qt::NoModifier, from + QPoint(20, 60));
    shot.wait(150);
    shot.take_widget("search_fitting" + end, &shot.canvas());
    shot.press(Qt::Key_Escape);
    shot.window.action("find")->trigger();
    shot.type("tr");
    shot.take_widget("find_node" + end, &shot.canvas());
  }
  {
    Shot shot(theme, into);
    shot.open("sneaky_walk");
    shot.session().select({"feet", "out"}, "feet");
    shot.press(Qt::Key_G);
    shot.type("Finish");
    shot.press(Qt::Key_Return);
    shot.press(Qt::Key_N);
    shot.type("Half as sneaky is enough.");
    shot.press(Qt::Key_Return, Qt::ControlModifier);
    const std::string note = shot.session().document().ui.notes.begin()->first;
    const QRectF all = shot.canvas().scene().bounds_of({"sneak", "style", "transfer"});
    shot.session().perform([&](const Document& d, const Registry&) {
      return place_note(d, note, QRectF(all.left(), all.bottom() + 60, 220, 60));
    });
    shot.take_canvas("frame_and_note" + end);
    shot.select("transfer");
    shot.take_popup("colours" + end, [&] { shot.window.action("color")->trigger(); });
  }
  {
    Shot shot(theme, into);
    shot.open("reuse");
    shot.window.open(Shot::example("pipelines/sneakify"));
    shot.wait();
    shot.canvas().zoom_at(QPointF(300, 200), 2);
    shot.wait();
    shot.take("graph_in_graph" + end);
  }
}

void gestures_under_way(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.canvas().show_rect(
        shot.canvas().scene().bounds_of({"style", "transfer", "unwarp"}).adjusted(-30, -60, 30, 60));
    shot.wait();
    shot.drag(shot.port("style", "stats", false), shot.port("transfer", "style", true) + QPoint(-20, 110));
    shot.take_widget("link_under_way" + end, &shot.canvas());
  }
  {
    Shot shot(theme, into);
    shot.open("sneaky_walk");
    const QPoint a = shot.port("transfer", "motion", false), b = shot.port("feet", "motion", true);
    shot.drag((a + b) / 2 - QPoint(10, 90), (a + b) / 2 + QPoint(10, 90), Qt::ControlModifier);
    shot.take_widget("cut_under_way" + end, &shot.canvas());
  }
  {
    Shot shot(theme, into);
    shot.open("sneaky_walk");
    const QString name = QString::fromStdString(shot.canvas().add("Filter", {420, 420}));
    shot.canvas().frame_all();
    shot.wait();
    const QPoint a = shot.port("transfer", "motion", false), b = shot.port("feet", "motion", true);
    const QPoint at = shot.view_of(name.toStdString());
    shot.drag(at, (a + b) / 2);
    shot.take_widget("insert_under_way" + end, &shot.canvas());
  }
  {
    Shot shot(theme, into);
    shot.open("sneaky_walk");
    const QRectF box = shot.canvas().scene().bounds_of({"walk", "style"});
    shot.drag(shot.canvas().to_view(box.topLeft() - QPointF(40, 40)).toPoint(),
              shot.canvas().to_view(box.bottomRight() + QPointF(20, 30)).toPoint());
    shot.take_widget("box_under_way" + end, &shot.canvas());
  }
  {
    Shot shot(theme, into);
    shot.press(Qt::Key_Tab);
    shot.type("hologram");
    shot.take_widget("search_nothing" + end, &shot.canvas());
  }
}

void canvas_states(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.open("sneaky_walk");
  for (const SceneWire& wire : shot.canvas().scene().wires())
    if (wire.from == "sneak") {
      const QPointF middle = (wire.line.first() + wire.line.last()) / 2;
      QTest::mouseClick(&shot.canvas(), Qt::LeftButton, Qt::ControlModifier,
                        shot.canvas().to_view(middle).toPoint());
      break;
    }
  shot.take_canvas("dot" + end);
  shot.session().undo();
  shot.select("transfer");
  shot.press(Qt::Key_F2);
  shot.take_widget("renaming" + end, &shot.canvas());
  shot.press(Qt::Key_Escape);
  shot.canvas().setFocus();
  shot.press(Qt::Key_L);
  shot.take_widget("search_link" + end, &shot.canvas());
  shot.press(Qt::Key_Escape);
  shot.session().select({"sneak", "walk", "style"}, "");
  shot.wait();
  shot.take_dock("parameters_several" + end, "Parameters");
}

void cancelled(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("long_walk": {"type": "Gait", "params": {"seconds": 400}},
    "long_sneak": {"type": "Gait", "params": {"seconds": 380, "gait": "sneak"}},
    "warp": {"type": "TimeWarp", "inputs": {"source": "long_walk.motion", "reference": "long_sneak.motion"}},
    "back": {"type": "UnwarpTime", "inputs": {"motion": "warp.warped", "warp": "warp.warp"}})");
  shot.session().select({"back"}, "back");
  QElapsedTimer clock;
  for (clock.start(); clock.elapsed() < 60000;) {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    const NodeStatus* warp = shot.window.evaluation().status("warp");
    if (warp && warp->state == NodeStatus::State::running) break;
  }
  shot.window.action("cancel")->trigger();
  shot.canvas().frame_all();
  shot.wait();
  shot.take("cancelled" + end);
}

}  // namespace

void graph_pictures(const Theme& theme, const QDir& into, const QString& end) {
  ports_and_states(theme, into, end);
  gestures_ended(theme, into, end);
  gestures_under_way(theme, into, end);
  canvas_states(theme, into, end);
  cancelled(theme, into, end);
}

}  // namespace kinegraph::shots
