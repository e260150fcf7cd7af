#include "tests/screenshots/panels.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDragMoveEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QPainter>
#include <QSlider>
#include <QTableWidget>
#include <QToolButton>
#include <QTreeWidget>
#include <QUrl>

#include "gui/components/components_grid.h"
#include "gui/look/settings.h"
#include "gui/panels/param_field.h"

namespace kinegraph::shots {
namespace {

// The Parameters dock in a window of its own, as high as all it holds.
struct Tall {
  Tall(Shot& shot, int height) : dock(shot.window.findChild<QDockWidget*>("dock_parameters")) {
    shot.dock("Parameters");
    dock->setFloating(true);
    dock->resize(435, height);
    QApplication::setActiveWindow(dock);
    shot.wait();
  }
  QDockWidget* dock;
};

QWidget* field(Shot& shot, const char* param) {
  auto* found =
      shot.window.findChild<QDockWidget*>("dock_parameters")->findChild<QWidget*>(QString("param_") + param);
  if (!found) qFatal("no field %s", param);
  return found;
}

void retype(Shot& shot, QLineEdit* line, const QString& text, bool enter = true) {
  QApplication::setActiveWindow(line->window());
  line->setFocus();
  line->selectAll();
  QTest::keyClicks(line, text);
  if (enter) QTest::keyClick(line, Qt::Key_Return);
  shot.wait(250);
}

// Tables: edits, keys, pins, weights and regions, whole; a row that doesn't fit; a cell that is typed into.
void tables(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("cartoon_dance");
    Tall tall(shot, 620);
    shot.select("dance");
    shot.take_widget("parameters_keys" + end, tall.dock);
    auto* table = field(shot, "keys")->findChild<QTableWidget*>();
    QApplication::setActiveWindow(tall.dock);
    table->setFocus();
    table->setCurrentCell(1, 3);
    shot.wait(150);
    shot.take_widget("focus_table" + end, tall.dock);
    table->editItem(table->item(1, 3));
    auto* editor = table->viewport()->findChild<QLineEdit*>();
    editor->selectAll();
    QTest::keyClicks(editor, "0.45, 1.7");
    shot.wait(150);
    shot.take_widget("parameters_cell_typed" + end, tall.dock);
    QTest::keyClick(editor, Qt::Key_Return);
    shot.wait(150);
    shot.take_widget("parameters_cell_mistake" + end, tall.dock);
  }
  {
    Shot shot(theme, into);
    shot.open("component_edit");
    Tall tall(shot, 620);
    shot.select("edit");
    shot.take_widget("parameters_edits" + end, tall.dock);
  }
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "reach": {"type": "Pin", "inputs": {"motion": "walk.motion"}, "params": {"pins": [
      {"joint": "LeftHand", "range": [10, 50], "position": [0.45, 1.7, -0.1]},
      {"joint": "RightHand", "position": [-0.45, 1.25, 0.3]}]}},
    "parts": {"type": "ICA", "inputs": {"motions": ["walk.motion"]}},
    "bold": {"type": "Exaggerate", "inputs": {"motion": "walk.motion"},
      "params": {"weights": {"*Arm*": 1.5, "Head": 0, "Spine>": 0.8}}},
    "rubber": {"type": "RubberJoints", "inputs": {"motion": "walk.motion"}, "params": {"sub_joints": {"*Arm*": 4, "*Leg*": 2},
      "groups": [{"from": "LeftArm", "to": "LeftHand"}, {"from": "RightArm", "to": "RightHand"}]}},
    "meaning": {"type": "ComponentMeaning", "inputs": {"components": "parts.components"}, "params": {
      "pairs": [[0, 1], [2, 3]], "align": ["u1", "joint:*Leg*"], "emotion": [1, "swing"],
      "regions": {"arms": "*Arm*, *Hand*", "legs": "*Leg*, *Foot*, *Toe*", "everything else that swings": "Spine>, -*Arm*, -*Hand*"}}})");
  Tall tall(shot, 700);
  for (const auto& [node, name] : {std::pair("reach", "pins"), std::pair("bold", "weights"),
                                   std::pair("rubber", "groups"), std::pair("meaning", "regions")}) {
    shot.select(node);
    shot.take_widget(QString("parameters_%1").arg(name) + end, tall.dock);
  }
}

// What is typed: under way, taken, refused; and where the keyboard is, on each kind of field.
void typing(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "hold": {"type": "Footskate", "inputs": {"motion": "walk.motion"}},
    "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}},
    "a_walk_that_was_smoothed_twice_and_held_on_the_floor": {"type": "Filter", "inputs": {"motion": "soft.motion"},
      "note": "Smoothed twice, as the director wants it, and then once more for the close shot of the third scene",
      "params": {"joints": "LeftUpLeg>, RightUpLeg>, LeftShoulder>, RightShoulder>, -LeftHand>, -RightHand>"}})");
  Tall tall(shot, 520);
  shot.select("hold");
  auto* blend = field(shot, "blend")->findChild<QLineEdit*>();
  retype(shot, blend, "1/3*2", false);
  shot.take_widget("parameter_arithmetic_typed" + end, tall.dock);
  QTest::keyClick(blend, Qt::Key_Return);
  shot.wait();
  shot.take_widget("parameter_arithmetic" + end, tall.dock);
  tall.dock->resize(435, 640);
  retype(shot, blend, "fast");
  retype(shot, field(shot, "stretch")->findChild<QLineEdit*>(), "-3");
  retype(shot, field(shot, "range")->findChild<QLineEdit*>(), "soon");
  shot.take_widget("parameter_mistake" + end, tall.dock);
  shot.select("a_walk_that_was_smoothed_twice_and_held_on_the_floor");
  QApplication::setActiveWindow(&shot.window);
  shot.canvas().setFocus();
  shot.wait(150);
  shot.take_widget("parameters_long" + end, tall.dock);
  shot.select("soft");
  const auto focus = [&](const char* name, QWidget* at) {
    QApplication::setActiveWindow(tall.dock);
    at->setFocus(Qt::TabFocusReason);
    shot.wait(150);
    shot.take_widget(QString("focus_") + name + end, tall.dock);
  };
  focus("choice", field(shot, "method")->findChild<QComboBox*>());
  focus("slider", field(shot, "cutoff")->findChild<QSlider*>());
  focus("number", field(shot, "cutoff")->findChild<QLineEdit*>());
  focus("joints", field(shot, "joints")->findChild<QToolButton*>());
  focus("range", field(shot, "range")->findChild<QLineEdit*>());
  focus("row_menu", field(shot, "amount")->parentWidget()->findChild<QToolButton*>("row_menu"));
  focus("enabled", tall.dock->findChild<QCheckBox*>());
  shot.select("walk");
  focus("file", field(shot, "file")->findChild<QToolButton*>());
  shot.session().select({"soft"}, "soft");
  shot.wait();
  shot.take_popup("joint_tree" + end, [&] {
    retype(shot, field(shot, "joints")->findChild<QLineEdit*>(), "LeftUpLeg>, RightArm");
    shot.wait();
    field(shot, "joints")->findChild<QToolButton*>()->click();
  });
  shot.take_popup("parameter_menu" + end, [&] {
    field(shot, "joints")->parentWidget()->findChild<QToolButton*>("row_menu")->click();
  });
}

// Nodes whose parameters are a graph's own, are unknown, or may only be read.
void strangers(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    QFile inner(shot.in_shot("stylist.kg.json"));
    if (inner.open(QIODevice::WriteOnly))
      inner.write(R"({"format": "kinegraph", "schema": 1, "nodes": {
        "in": {"type": "Filter", "params": {"cutoff": 5}}, "bold": {"type": "Exaggerate", "inputs": {"motion": "in.motion"}},
        "feet": {"type": "Footskate", "inputs": {"motion": "bold.motion"}}},
        "publish": {"inputs": {"motion": "in.motion"}, "outputs": {"motion": "feet.motion"},
          "params": {"softness": "in.cutoff", "method": "in.method", "joints": "in.joints", "frames": "in.range",
            "boldness": "bold.omega", "weights": "bold.weights", "hold": "feet.blend", "floor": "feet.floor", "correct": "bold.correct"}}})");
    inner.close();
    shot.text(
        R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "style": {"type": "Graph", "params": {"file": "stylist.kg.json", "softness": 7}, "inputs": {"motion": "walk.motion"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}, "params": {"cutoff": 5}})",
        R"(, "publish": {"params": {"method": "soft.method", "cutoff": "soft.cutoff", "order": "soft.order",
                "joints": "soft.joints", "range": "soft.range", "fade": "soft.fade", "amount": "soft.amount"}})");
    Tall tall(shot, 520);
    shot.select("style");
    shot.take_widget("parameters_graph" + end, tall.dock);
    shot.select("soft");
    shot.take_widget("parameters_all_published" + end, tall.dock);
  }
  {
    Shot shot(theme, into);
    shot.take_popup("unknown_parameter" + end, [&] {
      shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
        "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}, "params": {"cutoff": 5, "sharpness": 3, "order": "many"}})");
    });
  }
  Shot shot(theme, into);
  QFile newer(shot.in_shot("newer.kg.json"));
  if (newer.open(QIODevice::WriteOnly))
    newer.write(R"({"format": "kinegraph", "schema": 99, "nodes": {"gait": {"type": "Gait"},
      "soft": {"type": "Filter", "inputs": {"motion": "gait.motion"}, "params": {"cutoff": 5, "sharpness": 3}}}})");
  newer.close();
  shot.window.open(newer.fileName());
  shot.wait();
  Tall tall(shot, 520);
  shot.select("soft");
  shot.take_widget("parameters_read_only" + end, tall.dock);
}

void components(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("component_edit");
    shot.select("edit");
    shot.dock("Components");
    shot.wait(1500);
    auto* grid = shot.window.findChild<ComponentsGrid*>();
    grid->setFocus();
    grid->choose(1, false);
    shot.wait();
    shot.take_dock("components_chosen" + end, "Components");
    grid->choose(2, true);
    grid->choose(3, true);
    shot.wait();
    shot.take_dock("components_several" + end, "Components");
    auto* dock = shot.window.findChild<QDockWidget*>("dock_components");
    dock->setFloating(true);
    dock->resize(420, 640);
    shot.wait(1000);
    shot.take_widget("components_narrow" + end, dock);
  }
  {
    Shot shot(theme, into);
    shot.text(R"("long": {"type": "Gait", "params": {"seconds": 60}},
      "other": {"type": "Gait", "params": {"seconds": 60, "speed": 2}},
      "parts": {"type": "ICA", "inputs": {"motions": ["long.motion", "other.motion"]}, "params": {"components": 30, "starts": 60, "iterations": 100000, "tolerance": 1e-15}})");
    shot.session().select({"parts"}, "parts");
    shot.window.show_dock("Components");
    QElapsedTimer clock;
    for (clock.start(); clock.elapsed() < 30000;) {
      QApplication::processEvents(QEventLoop::AllEvents, 20);
      const NodeStatus* parts = shot.window.evaluation().status("parts");
      if (parts && parts->state == NodeStatus::State::running &&
          (parts->progress > 0.3 || clock.elapsed() > 15000))
        break;
    }
    shot.take_widget("components_running" + end, shot.window.findChild<QWidget*>("dock_components"));
    shot.window.action("cancel")->trigger();
    shot.wait();
    shot.take_widget("components_cancelled" + end, shot.window.findChild<QWidget*>("dock_components"));
  }
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "parts": {"type": "ICA", "inputs": {"motions": ["walk.motion"]}, "params": {"components": 5000}})");
  shot.select("parts");
  shot.take_dock("components_failed" + end, "Components");
}

void problems(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("gone": {"type": "Load", "params": {"file": "takes/a_walk_of_the_second_actor/walk.bvh"}},
    "walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}, "params": {"cutoff": 59}},
    "joints": {"type": "Filter", "inputs": {"motion": "walk.motion"}, "params": {"joints": "Tail>, Wing"}},
    "trim": {"type": "Trim", "inputs": {"motion": "walk.motion"}, "params": {"range": [5000, 6000]}},
    "parts": {"type": "ICA", "inputs": {"motions": ["walk.motion"]}, "params": {"components": 5000}},
    "figures": {"type": "Metrics", "inputs": {"motion": "walk.motion"}},
    "check": {"type": "Check", "params": {"rules": ["skate < 0.02", "no_such_figure < 1"]}, "inputs": {"metrics": "figures.metrics"}},
    "holo": {"type": "Hologram", "inputs": {"motion": "soft.motion"}}, "feet": {"type": "Footskate"})");
  for (const char* node : {"joints", "trim", "parts", "soft"}) shot.select(node);
  shot.dock("Problems");
  auto* dock = shot.window.findChild<QDockWidget*>("dock_problems");
  shot.take_widget("problems_many" + end, dock);
  auto* list = dock->findChild<QTreeWidget*>("problem_list");
  for (int i = 0; i < list->topLevelItemCount(); ++i)
    if (list->topLevelItem(i)->text(0).startsWith("trim"))
      QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                        list->visualItemRect(list->topLevelItem(i)).center());
  shot.wait();
  shot.take("problems_clicked" + end);
  dock->setFloating(true);
  dock->resize(460, 560);
  shot.wait();
  shot.take_widget("problems_narrow" + end, dock);
}

void files(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  QDir assets(shot.in_shot("Motion library"));
  for (const char* clip : {"dance/tango_long_take_of_the_second_actor_01.bvh", "dance/waltz.bvh", "jump.bvh",
                           "walks/sneak.bvh"}) {
    QDir().mkpath(QFileInfo(assets.filePath(clip)).path());
    QFile::copy(QFileInfo(Shot::example("style_transfer")).path() + "/clips/walk.bvh", assets.filePath(clip));
  }
  const auto before = user_settings();
  const QVariant recent = before->value("recent"), folders = before->value("assets");
  before->setValue("recent", QStringList{Shot::example("style_transfer"), Shot::example("component_edit"),
                                         Shot::example("cartoon_dance")});
  before->setValue("assets", QStringList{assets.absolutePath()});
  before->sync();
  shot.open("style_transfer");
  shot.dock("Files");
  auto* dock = shot.window.findChild<QDockWidget*>("dock_files");
  dock->setFloating(true);
  dock->resize(435, 760);
  shot.wait();
  shot.take_widget("files" + end, dock);
  auto* filter = dock->findChild<QLineEdit*>();
  retype(shot, filter, "walk", false);
  shot.take_widget("files_filtered" + end, dock);
  retype(shot, filter, "quadrille", false);
  shot.take_widget("files_none" + end, dock);
  filter->clear();
  dock->setFloating(false);
  shot.dock("Files");
  shot.canvas().setFocus();
  QMimeData dragged;
  dragged.setUrls({QUrl::fromLocalFile(assets.filePath("jump.bvh"))});
  const QPoint at(420, 300);
  QDragEnterEvent enter(at, Qt::CopyAction, &dragged, Qt::LeftButton, {});
  QApplication::sendEvent(&shot.canvas(), &enter);
  QDragMoveEvent move(at, Qt::CopyAction, &dragged, Qt::LeftButton, {});
  QApplication::sendEvent(&shot.canvas(), &move);
  shot.wait(150);
  shot.take("files_dragged" + end);
  before->setValue("recent", recent);
  before->setValue("assets", folders);
  before->sync();
}

}  // namespace

void panel_pictures(const Theme& theme, const QDir& into, const QString& end) {
  tables(theme, into, end);
  typing(theme, into, end);
  strangers(theme, into, end);
  components(theme, into, end);
  problems(theme, into, end);
  files(theme, into, end);
}

}  // namespace kinegraph::shots
