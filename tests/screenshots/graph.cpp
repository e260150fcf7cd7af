// Pictures of the canvas: port types, states of nodes, gestures under way.
#include <QHelpEvent>
#include <QToolTip>

#include "graph/file/read.h"
#include "graph/links.h"
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

// A person's afternoon: every state that a node can be in, at once. What is wrong comes later: with it the
// graph would not run.
const char* const sound_states = R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
  "calm": {"type": "Filter", "params": {"cutoff": 8}, "inputs": {"motion": "walk.motion"},
    "note": "Takes the marker noise out"},
  "final": {"type": "Filter", "params": {"cutoff": 4}, "inputs": {"motion": "calm.motion"}},
  "to_game": {"type": "Export", "enabled": false, "params": {"file": "walk_soft.bvh"},
    "inputs": {"motion": "final.motion"}},
  "strut": {"type": "Load", "params": {"file": "clips/strut.bvh"}},
  "left_handed": {"type": "Mirror", "enabled": false, "inputs": {"motion": "walk.motion"}},
  "figures": {"type": "Metrics", "inputs": {"motion": "calm.motion"}},
  "no_skating": {"type": "Check", "params": {"rules": ["skate < 0.0001"]}, "inputs": {"metrics": "figures.metrics"}},
  "long_walk": {"type": "Gait", "params": {"seconds": 200}},
  "align": {"type": "TimeWarp", "inputs": {"source": "long_walk.motion", "reference": "long_sneak.motion"}},
  "retimed": {"type": "UnwarpTime", "inputs": {"motion": "align.warped", "warp": "align.warp"}},
  "long_sneak": {"type": "Gait", "params": {"seconds": 190, "gait": "sneak"}},
  "first_try": {"type": "TimeWarp", "inputs": {"source": "long_sneak.motion", "reference": "long_walk.motion"}})";
const char* const places_of_states = R"(, "ui": {"nodes": {
  "walk": {"pos": [0, 0]}, "calm": {"pos": [250, 0]}, "final": {"pos": [500, 0]}, "to_game": {"pos": [750, 0]},
  "strut": {"pos": [0, 190]}, "left_handed": {"pos": [250, 190]}, "figures": {"pos": [500, 190]},
  "no_skating": {"pos": [750, 190]},
  "long_walk": {"pos": [0, 380]}, "align": {"pos": [250, 380]}, "retimed": {"pos": [500, 380]},
  "long_sneak": {"pos": [0, 560]}, "first_try": {"pos": [250, 560]}}})";
const char* const wrong_states = R"({"format": "kinegraph", "schema": 1, "nodes": {
  "feet": {"type": "Footskate"},
  "hologram": {"type": "Hologram", "inputs": {"motion": "old_take.motion"}},
  "old_take": {"type": "Load", "params": {"file": "clips/take_07.bvh"}},
  "cleaned": {"type": "Filter", "inputs": {"motion": "old_take.motion"}}}, "ui": {"nodes": {
  "feet": {"pos": [750, 380]}, "old_take": {"pos": [500, 560]}, "cleaned": {"pos": [750, 560]},
  "hologram": {"pos": [750, 690]}}}})";

using State = NodeStatus::State;

bool stands(Shot& shot, const std::string& node, State state) {
  const NodeStatus* status = shot.window.evaluation().status(node);
  return status && status->state == state;
}

void wait_for(const std::function<bool()>& condition) {
  QElapsedTimer clock;
  for (clock.start(); clock.elapsed() < 120000 && !condition();)
    QApplication::processEvents(QEventLoop::AllEvents, 20);
}

// Wherever a tool tip is: its own window.
void take_tip(Shot& shot, const QString& name, QPoint view) {
  QHelpEvent help(QEvent::ToolTip, view, shot.canvas().mapToGlobal(view));
  QApplication::sendEvent(&shot.canvas(), &help);
  shot.wait(250);
  for (QWidget* top : QApplication::topLevelWidgets())
    if (top->inherits("QTipLabel") && top->isVisible()) shot.take_widget(name, top);
  QToolTip::hideText();
  shot.wait(100);
}

void every_state(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into, {1580, 1560});
  shot.text(sound_states, places_of_states);
  shot.session().select({"calm"}, "calm");
  shot.wait();
  shot.window.action("run")->trigger();  // the check fails
  shot.wait(600);
  const auto edit = [&](const EditStep& step) {
    shot.session().perform(step);
    shot.wait();
  };
  edit([](const Document& d, const Registry&) { return set_enabled(d, "to_game", true); });
  edit([](const Document& d, const Registry& r) {
    std::vector<std::string> names;
    const Document part = read_document(wrong_states, "wrong", r).document;
    std::vector<EditStep> steps{
        [&](const Document& now, const Registry&) { return paste(now, r, part, 0, 0, &names); }};
    // A paste gives names of its own.
    for (const auto& [name, node] : part.nodes)
      steps.push_back([&, name = name, at = steps.size() - 1](const Document& now, const Registry&) {
        return rename_node(now, names[at], name);
      });
    return one_after_another(d, r, "Paste", steps);
  });
  shot.session().select({"first_try"}, "first_try");
  wait_for([&] { return stands(shot, "first_try", State::running); });
  shot.window.action("cancel")->trigger();
  shot.wait();
  shot.select("final");
  edit([](const Document& d, const Registry& r) { return set_param(d, r, "final", "cutoff", Json(3.0)); });
  shot.session().undo();  // what it gave is in the cache
  shot.wait();
  shot.canvas().frame_all();
  shot.wait();
  shot.session().select({"retimed"}, "retimed");
  wait_for([&] {
    const NodeStatus* align = shot.window.evaluation().status("align");
    return stands(shot, "align", State::running) && align->progress > 0.2 &&
           stands(shot, "retimed", State::waiting);
  });
  shot.take_widget("node_states" + end, &shot.canvas());
  shot.window.evaluation().cancel();
  shot.wait();
  shot.session().select({"final"}, "final");
  shot.wait();
  for (const auto& [node, name] : {std::pair("no_skating", "tip_of_check"),
                                   std::pair("cleaned", "tip_of_blocked"), std::pair("calm", "tip_of_node")})
    take_tip(shot, name + end, shot.view_of(node));
  take_tip(shot, "tip_of_port" + end, shot.port("feet", "contacts", true));
  const QPoint a = shot.port("calm", "motion", false), b = shot.port("final", "motion", true);
  take_tip(shot, "tip_of_link" + end, (a + b) / 2);
}

void at_work(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("long_walk": {"type": "Gait", "params": {"seconds": 2}},
    "long_sneak": {"type": "Gait", "params": {"seconds": 2, "gait": "sneak"}},
    "align": {"type": "TimeWarp", "inputs": {"source": "long_walk.motion", "reference": "long_sneak.motion"}},
    "style": {"type": "QuatStats", "inputs": {"motion": "align.reference"}},
    "transfer": {"type": "StyleTransfer", "inputs": {"motion": "align.warped", "style": "style.stats"}},
    "retimed": {"type": "UnwarpTime", "inputs": {"motion": "transfer.motion", "warp": "align.warp"}})");
  shot.select("long_walk");
  for (const auto& [name, seconds] : {std::pair("long_walk", 200.0), std::pair("long_sneak", 190.0)})
    shot.session().perform([&, name = name, seconds = seconds](const Document& d, const Registry& r) {
      return set_param(d, r, name, "seconds", Json(seconds));
    });
  shot.canvas().frame_all();
  shot.wait();
  shot.session().select({"retimed"}, "retimed");
  wait_for([&] {
    const NodeStatus* align = shot.window.evaluation().status("align");
    return stands(shot, "align", State::running) && align->progress > 0.2;
  });
  QElapsedTimer clock;
  for (clock.start(); clock.elapsed() < 300;) QApplication::processEvents(QEventLoop::AllEvents, 20);
  shot.take("running" + end);
  shot.window.action("cancel")->trigger();
  shot.wait();
  shot.take("cancelled" + end);
}

// As many as anybody has: takes of a day of recording, each cleaned the same way.
struct Takes {
  QByteArray nodes, places;
};
Takes takes(int rows, int rows_in_a_column) {
  static const char* const way[] = {"Load",   "Filter", "Resample",   "DetectContacts", "Footskate",
                                    "Filter", "Mirror", "Exaggerate", "Metrics",        "Check"};
  static const char* const names[] = {"take", "calm",   "at_60",  "plants",  "feet",
                                      "soft", "mirror", "strong", "figures", "judge"};
  QByteArray nodes, places;
  for (int row = 1; row <= rows; ++row) {
    const QByteArray number = "_" + QByteArray::number(row).rightJustified(2, '0');
    QByteArray motion;
    for (int i = 0; i < 10; ++i) {
      const QByteArray name = names[i] + number, type = way[i];
      nodes += (nodes.isEmpty() ? "\"" : ", \"") + name + "\": {\"type\": \"" + type + "\"";
      if (type == "Load")
        nodes += ", \"params\": {\"file\": \"clips/walk.bvh\"}";
      else if (type == "Check")
        nodes += ", \"inputs\": {\"metrics\": \"figures" + number + ".metrics\"}";
      else
        nodes +=
            ", \"inputs\": {\"motion\": \"" + motion + ".motion\"" +
            (type == "Footskate" ? ", \"contacts\": \"plants" + number + ".contacts\"}" : QByteArray("}"));
      nodes += "}";
      const int x = 250 * i + 2700 * ((row - 1) / rows_in_a_column),
                y = 200 * ((row - 1) % rows_in_a_column) + (type == "DetectContacts" ? 90 : 0);
      places += (places.isEmpty() ? "\"" : ", \"") + name + "\": {\"pos\": [" + QByteArray::number(x) + ", " +
                QByteArray::number(y) + "]}";
      if (type != "DetectContacts") motion = name;
    }
  }
  return {nodes, ", \"ui\": {\"nodes\": {" + places + "}}"};
}

void ports_and_sizes(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.take("empty" + end);
    shot.press(Qt::Key_Tab);
    shot.type("style");
    shot.take_widget("search" + end, &shot.canvas());
    shot.press(Qt::Key_Escape);
    shot.press(Qt::Key_Tab);
    shot.type("smooth");
    shot.take_widget("search_keyword" + end, &shot.canvas());
    shot.press(Qt::Key_Escape);
    shot.press(Qt::Key_Tab);
    shot.type("ftsk");
    shot.take_widget("search_fuzzy" + end, &shot.canvas());
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
    for (const char* last : {"figures", "edit", "skin", "sparks"}) shot.select(last);
    shot.session().select({});
    shot.wait(600);
    shot.take_canvas("port_types" + end);
  }
  {
    Shot shot(theme, into);
    const Takes many = takes(50, 17);
    shot.text(many.nodes, many.places);
    shot.select("feet_02");
    shot.canvas().frame_all();
    shot.wait(600);
    shot.take("five_hundred_nodes" + end);
    shot.canvas().show_rect(
        shot.canvas().scene().bounds_of({"calm_02", "soft_04"}).adjusted(-40, -40, 40, 40));
    shot.wait(600);
    shot.take("mini_map" + end);
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
    shot.press(Qt::Key_Escape);
    shot.window.action("find")->trigger();
    shot.type("retarget");
    shot.take_widget("find_nothing" + end, &shot.canvas());
    shot.press(Qt::Key_Escape);
    shot.session().perform(
        [](const Document& d, const Registry& r) { return kinegraph::disconnect(d, r, "plants", "motion"); });
    shot.wait();
    const QPoint open = shot.port("plants", "motion", true);
    shot.drag(open, open + QPoint(-80, -40));
    QTest::mouseRelease(&shot.canvas(), Qt::LeftButton, Qt::NoModifier, open + QPoint(-80, -40));
    shot.wait(150);
    shot.take_widget("search_before" + end, &shot.canvas());
    shot.press(Qt::Key_Escape);
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
    shot.canvas().select_decor({}, {});
    shot.select("transfer");
    shot.take_canvas("frame_and_note" + end);
    const QRectF bar = shot.canvas().scene().frames().front().title_bar;
    QTest::mouseClick(&shot.canvas(), Qt::LeftButton, Qt::NoModifier,
                      shot.canvas().to_view(bar.center()).toPoint());
    shot.take_canvas("frame_chosen" + end);
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
    std::map<std::string, QPointF> apart;  // room between two nodes, and a third one below
    for (const SceneNode& node : shot.canvas().scene().nodes())
      apart[node.name] =
          node.rect.topLeft() +
          QPointF(node.name == "feet" || node.name == "out" || node.name == "plants" ? 240 : 0, 0);
    shot.session().perform([&](const Document& d, const Registry&) { return move_nodes(d, apart); });
    const QRectF transfer = shot.canvas().scene().node("transfer")->rect;
    const std::string added = shot.canvas().add("Filter", transfer.bottomRight() + QPointF(60, 60));
    shot.session().perform(
        [&](const Document& d, const Registry&) { return rename_node(d, added, "soften"); });
    shot.canvas().frame_all();
    shot.wait();
    const QPoint a = shot.port("transfer", "motion", false), b = shot.port("feet", "motion", true);
    const QPoint at = shot.view_of("soften");
    const QPoint onto = (a + b) / 2 - QPoint(0, int(26 * shot.canvas().zoom()));
    shot.drag(at, onto);
    shot.take_widget("insert_under_way" + end, &shot.canvas());
    QTest::mouseRelease(&shot.canvas(), Qt::LeftButton, Qt::NoModifier, onto);
    shot.wait();
    shot.take_widget("inserted" + end, &shot.canvas());
    const QPoint from = shot.view_of("soften");
    const QPoint away = from + QPoint(0, int(200 * shot.canvas().zoom()));
    shot.drag(from, away, Qt::AltModifier);
    shot.take_widget("take_out_under_way" + end, &shot.canvas());
    QTest::mouseRelease(&shot.canvas(), Qt::LeftButton, Qt::AltModifier, away);
    shot.wait();
    shot.take_widget("taken_out" + end, &shot.canvas());
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

}  // namespace

void graph_pictures(const Theme& theme, const QDir& into, const QString& end) {
  ports_and_sizes(theme, into, end);
  every_state(theme, into, end);
  at_work(theme, into, end);
  gestures_ended(theme, into, end);
  gestures_under_way(theme, into, end);
  canvas_states(theme, into, end);
}

}  // namespace kinegraph::shots
