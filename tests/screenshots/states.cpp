// Pictures of what docks say of nodes that can't show anything, of stopped work, and of rarer dialogs and
// docks.
#include <QComboBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QHelpEvent>
#include <QMessageBox>
#include <QProgressDialog>
#include <QThread>
#include <QToolTip>

#include "gui/look/ask_file.h"
#include "gui/timeline/timeline_tracks.h"
#include "gui/window/wait_aside.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

void blocked(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("gone": {"type": "Load", "params": {"file": "clips/nowhere.bvh"}},
    "soft": {"type": "Filter", "inputs": {"motion": "gone.motion"}},
    "parts": {"type": "ICA", "inputs": {"motions": ["soft.motion"]}})");
  shot.select("soft");
  shot.take_dock("viewer_blocked" + end, "Viewer");
  shot.take_dock("timeline_blocked" + end, "Timeline");
  shot.take_dock("curves_blocked" + end, "Curves");
  shot.select("parts");
  shot.take_dock("components_blocked" + end, "Components");
}

void nothing_moves(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("judge": {"type": "Check"})");
  shot.select("judge");
  shot.take_dock("viewer_nothing_moves" + end, "Viewer");
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

void rarer_docks(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.select("feet");
    shot.window.playback().set_range(60, 250);
    shot.window.playback().set_time(0.9);
    shot.take_dock("timeline_range" + end, "Timeline");
    for (const auto& [channel, name] :
         {std::pair("Speed", "curves_speed"), std::pair("Rotation", "curves_rotation")}) {
      shot.dock("Curves");
      for (QComboBox* box : shot.window.findChildren<QComboBox*>())
        if (box->accessibleName() == "Channel") {
          box->setCurrentText(channel);
          emit box->activated(box->currentIndex());
        }
      shot.wait();
      shot.take_dock(name + end, "Curves");
    }
    shot.dock("Timeline");
    auto* tracks = shot.window.findChild<TimelineTracks*>();
    const QPoint at(static_cast<int>(tracks->x_of(160)), 60);
    QHelpEvent help(QEvent::ToolTip, at, tracks->mapToGlobal(at));
    QApplication::sendEvent(tracks, &help);
    shot.wait(200);
    for (QWidget* top : QApplication::topLevelWidgets())
      if (top->inherits("QTipLabel") && top->isVisible()) shot.take_widget("tool_tip" + end, top);
    QToolTip::hideText();
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
    shot.open("cartoon_dance");
    shot.select("dance");
    shot.take_dock("parameters_keys" + end, "Parameters");
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

void rarer_dialogs(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  const QString path = shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}})");
  shot.take_popup("folder_dialog" + end,
                  [&] { ask_for_folder(&shot.window, "Look in a folder", QFileInfo(path).absolutePath()); });
  shot.session().select({"walk", "soft"}, "soft");
  shot.take_popup("collapse_dialog" + end, [&] { shot.window.action("collapse")->trigger(); });
  QTimer::singleShot(1500, [&] {
    if (auto* dialog = qobject_cast<QProgressDialog*>(QApplication::activeModalWidget())) {
      shot.take_widget("opening" + end, dialog);
      dialog->cancel();
    }
  });
  QElapsedTimer clock;
  clock.start();
  wait_aside(&shot.window, "Opening a_long_take.kg.json", [&clock](const StopToken& stop) {
    while (!stop.stopped() && clock.elapsed() < 5000) QThread::msleep(10);
  });
  // A name that is taken already: the dialogs are answered from behind their own loops.
  bool taken = false;
  QTimer answers;
  QObject::connect(&answers, &QTimer::timeout, [&] {
    QWidget* shown = QApplication::activeModalWidget();
    if (auto* question = qobject_cast<QMessageBox*>(shown)) {
      if (!taken) shot.take_widget("save_over" + end, question);
      taken = true;
      question->reject();
    } else if (auto* dialog = qobject_cast<QFileDialog*>(shown)) {
      if (taken)
        dialog->reject();
      else
        QMetaObject::invokeMethod(dialog, "accept", Qt::QueuedConnection);
    }
  });
  answers.start(700);
  shot.window.action("save_as")->trigger();
}

}  // namespace

void state_pictures(const Theme& theme, const QDir& into, const QString& end) {
  blocked(theme, into, end);
  nothing_moves(theme, into, end);
  cancelled(theme, into, end);
  rarer_docks(theme, into, end);
  rarer_dialogs(theme, into, end);
}

}  // namespace kinegraph::shots
