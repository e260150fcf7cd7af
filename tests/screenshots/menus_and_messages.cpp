// Pictures of menus, gestures under way, questions, notices, and of what docks say when they have nothing to
// show.
#include <QFileDialog>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QToolButton>

#include "gui/canvas/canvas_edits.h"
#include "tests/places.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

void menus(const Theme& theme, const QDir& into, const QString& end) {
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

void questions(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    QDir(shot.folder.path()).mkpath("pipelines");
    for (const char* name : {"reuse", "pipelines/sneakify", "pipelines/restyle", "pipelines/clean_feet"})
      QFile::copy(Shot::example(name), shot.folder.filePath(QString(name) + ".kg.json"));
    QFile::link(QString::fromStdString(source_folder()) + "/graphs/clips", shot.folder.filePath("clips"));
    shot.window.open(shot.folder.filePath("reuse.kg.json"));
    shot.wait();
    shot.window.open(shot.folder.filePath("pipelines/sneakify.kg.json"));
    shot.wait();
    shot.session().perform(
        [](const Document& d, const Registry&) { return set_note(d, d.nodes.begin()->first, "calmer"); });
    shot.session().show_page(0);
    shot.wait();
    shot.take_popup("run_asks_to_save" + end, [&] { shot.window.action("run")->trigger(); });
    shot.take_popup("file_dialog" + end, [&] { shot.window.action("open")->trigger(); });
  }
  {
    Shot shot(theme, into);
    QFile torn(shot.folder.filePath("torn.kg.json"));
    if (torn.open(QIODevice::WriteOnly))
      torn.write("{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {\n  \"walk\": {\"type\": ");
    torn.close();
    shot.take_popup("damaged_graph" + end, [&] { shot.window.open(torn.fileName()); });
  }
}

void notices(const Theme& theme, const QDir& into, const QString& end) {
  const auto change = [](const QString& path, const QByteArray& from, const QByteArray& to) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return;
    QByteArray text = file.readAll();
    file.close();
    text.replace(from, to);
    if (file.open(QIODevice::WriteOnly)) file.write(text);
  };
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}},
      "out": {"type": "Export", "params": {"file": "soft.bvh"}, "inputs": {"motion": "soft.motion"}})");
    shot.window.action("run")->trigger();
    shot.wait(1200);
    shot.take("ran" + end);
  }
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "feet": {"type": "Footskate"},
      "out": {"type": "Export", "params": {"file": "soft.bvh"}, "inputs": {"motion": "feet.motion"}})");
    shot.window.action("run")->trigger();
    shot.select("feet");
    shot.take("run_refused" + end);
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}})");
    shot.session().perform([](const Document& d, const Registry& r) {
      return set_param(d, r, "walk", "file", "clips/run.bvh");
    });
    change(path, "walk.bvh", "strut.bvh");
    shot.wait(1200);
    for (QPushButton* button : shot.window.findChild<QWidget*>("notice_bar")->findChildren<QPushButton*>())
      if (button->isVisible() && button->text().startsWith("Merge")) {
        button->click();
        break;
      }
    shot.wait();
    shot.take("merge_conflict" + end);
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}})");
    change(path, "}", "");
    shot.wait(1200);
    shot.take("torn_on_disk" + end);
  }
}

void nothing_to_show(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "figures": {"type": "Metrics", "inputs": {"motion": "walk.motion"}},
    "feet": {"type": "Footskate"}, "parts": {"type": "ICA"},
    "inside": {"type": "Graph", "params": {"file": "nowhere.kg.json"}})");
  shot.select("feet");
  shot.take_dock("viewer_not_linked" + end, "Viewer");
  shot.take_dock("parameters_problem" + end, "Parameters");
  shot.select("parts");
  shot.take_dock("components_not_linked" + end, "Components");
  shot.select("inside");
  shot.take_dock("parameters_no_graph" + end, "Parameters");
  shot.select("figures");
  shot.take_dock("curves_figures" + end, "Curves");
}

}  // namespace

void menus_and_messages(const Theme& theme, const QDir& into, const QString& end) {
  menus(theme, into, end);
  gestures_under_way(theme, into, end);
  questions(theme, into, end);
  notices(theme, into, end);
  nothing_to_show(theme, into, end);
}

}  // namespace kinegraph::shots
