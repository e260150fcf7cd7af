// Pictures of the docks, filled and with nothing to show.
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>

#include "tests/screenshots/panels.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

void filled(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.select("feet");
    shot.take_dock("parameters" + end, "Parameters");
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
  }
  {
    Shot shot(theme, into);
    shot.text(R"("sparks": {"type": "Burst"})");
    shot.take_dock("components_empty" + end, "Components");
    shot.take_dock("problems_empty" + end, "Problems");
  }
  {
    Shot shot(theme, into);
    shot.take_dock("viewer_empty" + end, "Viewer");
    shot.take_dock("parameters_empty" + end, "Parameters");
  }
}

void nothing_to_show(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "feet": {"type": "Footskate"}, "parts": {"type": "ICA"},
    "inside": {"type": "Graph", "params": {"file": "nowhere.kg.json"}})");
  shot.select("feet");
  shot.take_dock("viewer_not_linked" + end, "Viewer");
  shot.take_dock("parameters_problem" + end, "Parameters");
  shot.select("parts");
  shot.take_dock("components_not_linked" + end, "Components");
  shot.select("inside");
  shot.take_dock("parameters_no_graph" + end, "Parameters");
}

void blocked(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("gone": {"type": "Load", "params": {"file": "clips/nowhere.bvh"}},
    "soft": {"type": "Filter", "inputs": {"motion": "gone.motion"}},
    "parts": {"type": "ICA", "inputs": {"motions": ["soft.motion"]}})");
  shot.select("soft");
  shot.take_dock("viewer_blocked" + end, "Viewer");
  shot.select("parts");
  shot.take_dock("components_blocked" + end, "Components");
}

void nothing_moves(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("judge": {"type": "Check"})");
  shot.select("judge");
  shot.take_dock("viewer_nothing_moves" + end, "Viewer");
}

void seldom_filled(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.select("feet");
    shot.window.playback().set_time(0.9);
    shot.dock("Curves");
    auto* curves = shot.window.findChild<QDockWidget*>("dock_curves");
    curves->setFloating(true);
    curves->resize(620, 360);
    shot.wait();
    shot.take_widget("dock_floating" + end, curves);
  }
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "params": {"cutoff": "${softness}", "order": 3}, "note": "As the director wants it",
        "inputs": {"motion": "walk.motion"}})",
              R"(, "variables": {"softness": 4}, "publish": {"params": {"order": "soft.order"}})");
    shot.select("soft");
    shot.take_dock("parameters_published" + end, "Parameters");
  }
  {
    Shot shot(theme, into);
    shot.open("face");
    shot.take("face" + end);
  }
  {
    QByteArray nodes = R"("take": {"type": "Load", "params": {"file": "clips/walk.bvh"}})";
    QByteArray before = "take";
    for (int i = 1; i < 40; ++i) {
      static const char* const types[] = {"Filter", "Mirror", "Resample", "Exaggerate"};
      const QByteArray name = "step_" + QByteArray::number(i);
      nodes += ", \"" + name + "\": {\"type\": \"" + types[i % 4] + "\", \"inputs\": {\"motion\": \"" +
               before + ".motion\"}}";
      before = i % 5 == 0 ? QByteArray("take") : name;
    }
    Shot shot(theme, into);
    shot.text(nodes);
    shot.select("step_4");
    shot.canvas().frame_all();
    shot.wait();
    shot.take("forty_nodes" + end);
  }
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
  for (QMenu* menu : shot.window.findChildren<QMenu*>())
    for (const auto& [title, name] :
         {std::pair("Open recent", "menu_recent"), std::pair("Docks", "menu_docks")})
      if (QString(menu->title()).remove('&') == title)
        shot.take_popup(name + end, [menu] { menu->popup(QPoint(40, 40)); });
}

}  // namespace

void dock_pictures(const Theme& theme, const QDir& into, const QString& end) {
  panel_pictures(theme, into, end);
  filled(theme, into, end);
  nothing_to_show(theme, into, end);
  blocked(theme, into, end);
  nothing_moves(theme, into, end);
  seldom_filled(theme, into, end);
  fields(theme, into, end);
}

}  // namespace kinegraph::shots
