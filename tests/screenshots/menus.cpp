// Pictures of the menus.
#include <QMenu>
#include <QMenuBar>
#include <QToolButton>

#include "tests/screenshots/shots.h"

namespace kinegraph::shots {

void menu_pictures(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.open("style_transfer");
  shot.select("transfer");
  shot.canvas().frame_all();
  shot.wait();
  shot.take_menu_at("menu_of_a_node" + end, shot.view_of("transfer"));
  const QPointF from = shot.canvas().scene().port_position({"feet", "motion", false});
  for (const SceneWire& wire : shot.canvas().scene().wires())
    if (wire.from == "feet" && wire.to == "result") {
      const QPointF middle = (wire.line.first() + wire.line.last()) / 2;
      shot.take_menu_at("menu_of_a_link" + end, shot.canvas().to_view(middle).toPoint());
    }
  shot.take_menu_at("menu_of_the_graph" + end, shot.canvas().to_view(from).toPoint() + QPoint(0, -150));
  const auto actions = shot.window.menuBar()->actions();
  for (int i = 0; i < int(actions.size()) && i < 5; ++i) {
    static const char* const names[] = {"file", "edit", "graph", "view", "help"};
    shot.take_popup(QString("menu_") + names[i] + end,
                    [&, i] { actions[i]->menu()->popup(shot.window.mapToGlobal(QPoint(20 + 50 * i, 24))); });
  }
  for (QToolButton* button : shot.viewer().findChildren<QToolButton*>())
    if (button->menu() && button->isVisible()) {
      shot.take_popup("viewer_menu" + end,
                      [&] { button->menu()->popup(shot.window.mapToGlobal(QPoint(900, 140))); });
    }
}

}  // namespace kinegraph::shots
