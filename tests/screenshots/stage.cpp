// Pictures of what a clip is watched with beside the viewer: the timeline and the curves, at work and with
// nothing to show.
#include <QComboBox>
#include <QHelpEvent>
#include <QToolTip>

#include "gui/timeline/timeline_tracks.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

void choose_channel(Shot& shot, const QString& channel) {
  shot.dock("Curves");
  for (QComboBox* box : shot.window.findChildren<QComboBox*>())
    if (box->accessibleName() == "Channel") {
      box->setCurrentText(channel);
      emit box->activated(box->currentIndex());
    }
  shot.wait();
}

void a_style_transfer(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.open("style_transfer");
  shot.window.playback().set_time(0.9);
  shot.select("warp");
  shot.take_dock("timeline_warp" + end, "Timeline");
  shot.take_dock("curves_warp" + end, "Curves");
  shot.select("style");
  shot.take_dock("curves_statistics" + end, "Curves");
  shot.select("feet");
  shot.take_dock("curves_channels" + end, "Curves");
  choose_channel(shot, "Speed");
  shot.take_dock("curves_speed" + end, "Curves");
  choose_channel(shot, "Rotation");
  shot.take_dock("curves_rotation" + end, "Curves");
  shot.window.playback().set_range(60, 250);
  shot.take_dock("timeline_range" + end, "Timeline");
  auto* tracks = shot.window.findChild<TimelineTracks*>();
  const QPoint at(static_cast<int>(tracks->x_of(160)), 60);
  QHelpEvent help(QEvent::ToolTip, at, tracks->mapToGlobal(at));
  QApplication::sendEvent(tracks, &help);
  shot.wait(200);
  for (QWidget* top : QApplication::topLevelWidgets())
    if (top->inherits("QTipLabel") && top->isVisible()) shot.take_widget("tool_tip" + end, top);
  QToolTip::hideText();
  shot.window.playback().play();
  QTest::qWait(600);
  shot.take_widget("timeline_playing" + end, shot.window.findChild<QWidget*>("dock_timeline"));
  shot.window.playback().pause();
}

void two_rates_and_contacts(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "film": {"type": "Resample", "params": {"fps": 24}, "inputs": {"motion": "walk.motion"}},
    "short": {"type": "Trim", "params": {"range": [0, 48]}, "inputs": {"motion": "film.motion"}},
    "feet": {"type": "DetectContacts", "inputs": {"motion": "walk.motion"},
      "params": {"edits": [{"foot": "left", "range": [100, 190], "planted": true}]}},
    "figures": {"type": "Metrics", "inputs": {"motion": "walk.motion"}},
    "judge": {"type": "Check", "params": {"rules": ["skate < 0.05"]}, "inputs": {"metrics": "figures.metrics"}})");
  shot.window.playback().set_time(0.9);
  shot.select("figures");
  shot.take_dock("curves_figures" + end, "Curves");
  shot.select("feet");
  shot.take_dock("timeline_contacts" + end, "Timeline");
  shot.take_dock("viewer_of_contacts" + end, "Viewer");
  shot.viewer().pin(1, "walk");
  shot.viewer().pin(2, "short");
  shot.wait();
  shot.take_dock("timeline_rates" + end, "Timeline");
}

// A search for a warp that takes a while, and what waits for it.
void under_way(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("clip": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "long_walk": {"type": "Gait", "params": {"seconds": 150}},
    "long_sneak": {"type": "Gait", "params": {"seconds": 140, "gait": "sneak"}},
    "search": {"type": "TimeWarp", "inputs": {"source": "long_walk.motion", "reference": "long_sneak.motion"}},
    "soft": {"type": "Filter", "inputs": {"motion": "search.warped"}})");
  shot.window.show_dock("Curves");
  shot.window.show_dock("Timeline");
  shot.session().select({"soft"}, "soft");
  QElapsedTimer clock;
  const NodeStatus* search = nullptr;
  for (clock.start(); clock.elapsed() < 20000;) {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    search = shot.window.evaluation().status("search");
    if (search && search->state == NodeStatus::State::running && clock.elapsed() > 600) break;
  }
  for (const char* dock : {"viewer", "timeline", "curves"})
    shot.take_widget(QString("%1_evaluating%2").arg(dock, end),
                     shot.window.findChild<QWidget*>(QString("dock_%1").arg(dock)));
  shot.window.evaluation().cancel();
  shot.wait();
  for (const char* dock : {"viewer", "timeline", "curves"})
    shot.take_widget(QString("%1_cancelled%2").arg(dock, end),
                     shot.window.findChild<QWidget*>(QString("dock_%1").arg(dock)));
}

void nothing_to_show(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.take_dock("timeline_empty" + end, "Timeline");
    shot.take_dock("curves_empty" + end, "Curves");
  }
  Shot shot(theme, into);
  shot.text(R"("gone": {"type": "Load", "params": {"file": "clips/nowhere.bvh"}},
    "soft": {"type": "Filter", "inputs": {"motion": "gone.motion"}},
    "walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
    "late": {"type": "Trim", "params": {"range": [9000, 9100]}, "inputs": {"motion": "walk.motion"}},
    "parts": {"type": "ICA", "inputs": {"motions": ["walk.motion"]}},
    "judge": {"type": "Check"}, "alone": {"type": "Filter"})");
  shot.select("soft");
  shot.take_dock("timeline_blocked" + end, "Timeline");
  shot.take_dock("curves_blocked" + end, "Curves");
  shot.select("late");
  shot.take_dock("viewer_failed" + end, "Viewer");
  shot.take_dock("timeline_failed" + end, "Timeline");
  shot.take_dock("curves_failed" + end, "Curves");
  shot.select("alone");
  shot.take_dock("timeline_not_linked" + end, "Timeline");
  shot.take_dock("curves_not_linked" + end, "Curves");
  shot.select("judge");
  shot.take_dock("timeline_nothing_moves" + end, "Timeline");
  shot.take_dock("curves_nothing_moves" + end, "Curves");
}

}  // namespace

void stage_pictures(const Theme& theme, const QDir& into, const QString& end) {
  a_style_transfer(theme, into, end);
  two_rates_and_contacts(theme, into, end);
  under_way(theme, into, end);
  nothing_to_show(theme, into, end);
}

}  // namespace kinegraph::shots
