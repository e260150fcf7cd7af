// Pictures of what is seen more seldom: notices of refusals, fields with mistakes, small windows, long names.
#include <QLineEdit>
#include <QMenu>
#include <QTest>

#include "gui/canvas/canvas_edits.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

void notices(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.text(R"("gait": {"type": "Gait"})");
    shot.window.action("run")->trigger();
    shot.take("nothing_to_run" + end);
    shot.window.action("relink")->trigger();
    shot.take("nothing_missing" + end);
  }
  {
    Shot shot(theme, into);
    shot.text(
        R"("gait": {"type": "Gait"}, "figures": {"type": "Metrics", "inputs": {"motion": "gait.motion"}},
      "check": {"type": "Check", "params": {"rules": ["skate < -1", "penetration < 1"]},
        "inputs": {"metrics": "figures.metrics"}})");
    shot.window.action("run")->trigger();
    shot.wait(1200);
    shot.take("check_failed" + end);
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(R"("gait": {"type": "Gait"})");
    shot.canvas().add("Filter", {260, 0});
    shot.take_popup("save_dialog" + end, [&] { shot.window.action("save_as")->trigger(); });
    QDir(QFileInfo(path).absolutePath()).removeRecursively();
    shot.take_popup("save_failed" + end, [&] { shot.window.action("save")->trigger(); });
  }
  {
    Shot shot(theme, into);
    QFile newer(shot.in_shot("newer.kg.json"));
    if (newer.open(QIODevice::WriteOnly))
      newer.write(R"({"format": "kinegraph", "schema": 99, "nodes": {"gait": {"type": "Gait"}}})");
    newer.close();
    shot.window.open(newer.fileName());
    shot.wait();
    shot.canvas().add("Filter", {260, 0});
    shot.take("edit_refused" + end);
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

void fields(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.open("style_transfer");
  shot.select("feet");
  auto* row = shot.window.findChild<QWidget*>("param_blend");
  auto* line = row ? row->findChild<QLineEdit*>() : nullptr;
  if (!line) return;
  line->setFocus();
  shot.wait(100);
  shot.take_dock("parameter_help" + end, "Parameters");
  line->selectAll();
  QTest::keyClicks(line, "fast");
  QTest::keyClick(line, Qt::Key_Return);
  shot.take_dock("parameter_mistake" + end, "Parameters");
  for (QMenu* menu : shot.window.findChildren<QMenu*>())
    for (const auto& [title, name] :
         {std::pair("Open recent", "menu_recent"), std::pair("Docks", "menu_docks")})
      if (QString(menu->title()).remove('&') == title)
        shot.take_popup(name + end, [menu] { menu->popup(QPoint(40, 40)); });
}

void sizes(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into, {1024, 700});
    shot.open("style_transfer");
    shot.select("feet");
    shot.canvas().frame_all();
    shot.take("window_small" + end);
  }
  {
    Shot shot(theme, into);
    shot.text(R"("walk_of_the_second_actor_take_07": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "the_walk_after_the_third_rehearsal_on_monday": {"type": "Filter",
        "inputs": {"motion": "walk_of_the_second_actor_take_07.motion"}})");
    shot.select("the_walk_after_the_third_rehearsal_on_monday");
    shot.viewer().pin(1, "walk_of_the_second_actor_take_07");
    shot.viewer().pin(2, "the_walk_after_the_third_rehearsal_on_monday");
    shot.canvas().frame_all();
    shot.wait();
    shot.take("names" + end);
  }
}

}  // namespace

void less_common_pictures(const Theme& theme, const QDir& into, const QString& end) {
  notices(theme, into, end);
  canvas_states(theme, into, end);
  fields(theme, into, end);
  sizes(theme, into, end);
}

}  // namespace kinegraph::shots
