// Writes the pictures of docs/editor: every port type, node state, dock, dialog, error and empty state.
//   editor_screenshots FOLDER dark|light|qpainter [PART…]
//   editor_screenshots FOLDER scaled END
// PART: graph, gestures, viewer, docks, menus, others, states, troubles; all of them where none is given.
#include <QCheckBox>
#include <QMessageBox>
#include <QStandardPaths>
#include <QToolButton>
#include <cstdio>

#include "graph/edit.h"
#include "graph/file/read.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/components/components_grid.h"
#include "gui/look/editor_style.h"
#include "gui/window/changes_dialog.h"
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

void graph_pictures(const Theme& theme, const QDir& into, const QString& end) {
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

void gestures(const Theme& theme, const QDir& into, const QString& end) {
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

void docks(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.window.playback().set_time(0.9);
    shot.select("warp");
    shot.take_dock("timeline_warp" + end, "Timeline");
    shot.take_dock("curves_warp" + end, "Curves");
    shot.select("feet");
    shot.take_dock("curves_channels" + end, "Curves");
    shot.take_dock("parameters" + end, "Parameters");
    shot.select("style");
    shot.take_dock("curves_statistics" + end, "Curves");
    shot.select("warp");
    shot.take_popup("parameter_menu" + end, [&] {
      shot.window.findChild<QWidget*>("param_features")
          ->parentWidget()
          ->findChild<QToolButton*>("row_menu")
          ->click();
    });
    shot.take_popup("joint_tree" + end, [&] {
      shot.window.findChild<QWidget*>("param_features")->findChild<QToolButton*>()->click();
    });
    shot.dock("Files");
    shot.take_dock("files" + end, "Files");
    shot.select("check");
    shot.take_dock("parameters_rules" + end, "Parameters");
  }
  {
    Shot shot(theme, into);
    shot.open("component_edit");
    shot.select("edit");
    shot.dock("Components");
    shot.wait(1500);
    shot.take("components" + end);
    shot.take_dock("parameters_edits" + end, "Parameters");
    shot.dock("Components");
    shot.window.findChild<ComponentsGrid*>()->choose(1, false);
    shot.wait();
    shot.take_dock("components_chosen" + end, "Components");
  }
  {
    Shot shot(theme, into);
    shot.text(R"("sparks": {"type": "Burst"})");
    shot.take_dock("components_empty" + end, "Components");
    shot.take_dock("problems_empty" + end, "Problems");
  }
  {
    Shot shot(theme, into);
    shot.open("cartoon_walk");
    shot.select("rubber");
    shot.take_dock("parameters_groups" + end, "Parameters");
  }
  {
    Shot shot(theme, into);
    shot.take_dock("viewer_empty" + end, "Viewer");
    shot.take_dock("timeline_empty" + end, "Timeline");
    shot.take_dock("curves_empty" + end, "Curves");
    shot.take_dock("parameters_empty" + end, "Parameters");
  }
}

void troubles(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "takes/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}}, "feet": {"type": "Footskate"},
      "holo": {"type": "Hologram", "inputs": {"motion": "soft.motion"}})");
    shot.select("walk");
    shot.dock("Problems");
    shot.take("missing_file" + end);
    shot.take_dock("problems" + end, "Problems");
    shot.take_popup(
        "relink" + end, [&] { shot.window.action("relink")->trigger(); }, 2500);
    shot.select("holo");
    shot.take_dock("parameters_unknown" + end, "Parameters");
  }
  {
    Shot shot(theme, into);
    QFile newer(shot.folder.filePath("newer.kg.json"));
    if (newer.open(QIODevice::WriteOnly))
      newer.write(R"({"format": "kinegraph", "schema": 99, "nodes": {"gait": {"type": "Gait"},
        "soft": {"type": "Filter", "inputs": {"motion": "gait.motion"}}}})");
    newer.close();
    shot.window.open(newer.fileName());
    shot.wait();
    shot.take("newer_file" + end);
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}})");
    QFile file(path);
    if (file.open(QIODevice::ReadOnly)) {
      QByteArray changed = file.readAll();
      file.close();
      changed.replace("\"Filter\",", "\"Filter\", \"note\": \"calmer\",");
      changed.replace("walk.bvh", "strut.bvh");
      if (file.open(QIODevice::WriteOnly)) file.write(changed);
      file.close();
    }
    shot.wait(1200);
    shot.take("changed_on_disk" + end);
    const ReadResult before = read_document(shot.session().text_on_disk(), "a", shot.registry);
    if (file.open(QIODevice::ReadOnly)) {
      const ReadResult after = read_document(file.readAll().toStdString(), "a", shot.registry);
      ChangesDialog dialog("example.kg.json changed on disk", diff(before.document, after.document),
                           &shot.window);
      shot.take_popup("changes" + end, [&] { dialog.exec(); });
    }
  }
  {
    Shot shot(theme, into);
    QFile damaged(shot.in_shot("damaged.bvh"));
    if (damaged.open(QIODevice::WriteOnly)) damaged.write("HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0\n}\n");
    damaged.close();
    shot.text(R"("walk": {"type": "Load", "params": {"file": "damaged.bvh"}})");
    shot.select("walk");
    shot.take("damaged_clip" + end);
  }
  {
    Shot first(theme, into);
    const QString path = first.text(R"("walk": {"type": "Gait"})");
    first.canvas().add("Filter", {260, 0});
    first.wait(2600);
    Shot second(theme, into);
    second.window.open(path);
    second.wait();
    second.take("autosave" + end);
    second.session().discard_found();
  }
  {
    Shot shot(theme, into);
    shot.open("sneaky_walk");
    shot.take_popup("keys" + end, [&] { shot.window.action("keys")->trigger(); });
    shot.take_popup("about" + end, [&] { shot.window.action("about")->trigger(); });
    shot.session().perform([](const Document& d, const Registry&) { return set_note(d, "walk", "mine"); });
    shot.take_popup("unsaved" + end, [&] { shot.window.action("close_page")->trigger(); });
  }
}

}  // namespace
}  // namespace kinegraph::shots

int main(int argc, char** argv) {
  QStandardPaths::setTestModeEnabled(true);
  QApplication application(argc, argv);
  QApplication::setApplicationName("kinegraph-editor");
  QApplication::setApplicationVersion(KINEGRAPH_VERSION);
  QApplication::setStyle(new kinegraph::EditorStyle);
  if (argc < 3) {
    std::fprintf(stderr, "editor_screenshots FOLDER dark|light|qpainter [PART…] or FOLDER scaled END\n");
    return 2;
  }
  using namespace kinegraph;
  const QDir into(argv[1]);
  const QString what = argv[2];
  QDir().mkpath(into.path());
  if (what == "scaled" && argc > 3) {
    // With QT_SCALE_FACTOR in the environment: the same windows with more pixels.
    for (const Theme* theme : {&dark_theme(), &light_theme()}) {
      const QString end = (theme->dark ? "_" : "_light_") + QString(argv[3]);
      shots::Shot shot(*theme, into, {1280, 800});
      shot.open("component_edit");
      shot.select("edit");
      shot.dock("Components");
      shot.wait(1500);
      shot.take("window" + end);
    }
    return 0;
  }
  if (what == "qpainter") {
    // With QT_QPA_PLATFORM=offscreen in the environment: what is seen where there is no OpenGL.
    shots::viewer_pictures(dark_theme(), into, "_qpainter");
    shots::viewer_pictures(light_theme(), into, "_qpainter_light");
    return 0;
  }
  const Theme& theme = what == "light" ? light_theme() : dark_theme();
  const QString end = what == "light" ? "_light" : "";
  const QStringList wanted = QApplication::arguments().mid(3);
  using Take = void (*)(const Theme&, const QDir&, const QString&);
  const std::pair<const char*, Take> parts[] = {
      {"graph", shots::graph_pictures},     {"gestures", shots::gestures},
      {"viewer", shots::viewer_pictures},   {"docks", shots::docks},
      {"menus", shots::menus_and_messages}, {"others", shots::less_common_pictures},
      {"states", shots::state_pictures},    {"troubles", shots::troubles}};
  for (const auto& [part, take] : parts)
    if (wanted.isEmpty() || wanted.contains(part)) take(theme, into, end);
  return 0;
}
