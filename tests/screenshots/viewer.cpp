// The viewer's pictures: everything that it can show of a motion, with OpenGL or with QPainter.
#include "gui/viewer/stage.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

// The hand stays on the line.
void drag_wipe(Shot& shot, double from, double to) {
  auto* stage = shot.viewer().findChild<Stage*>();
  const auto at = [&](double share) {
    return QPoint(static_cast<int>(share * stage->width()), stage->height() / 2);
  };
  QTest::mousePress(stage, Qt::LeftButton, {}, at(from));
  QMouseEvent move(QEvent::MouseMove, at(to), stage->mapToGlobal(at(to)), Qt::NoButton, Qt::LeftButton, {});
  QApplication::sendEvent(stage, &move);
  shot.wait();
}

void nine(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  const char* const gaits[] = {"walk", "run", "sneak", "strut", "hobble", "jog", "stroll", "creep", "limp"};
  QByteArray nodes;
  for (int i = 0; i < 9; ++i) {
    // Each another way of going: those after the fifth lean, crouch and swing their arms in their own way.
    const QByteArray own = i < 5 ? QByteArray()
                                 : ", \"lean\": " + QByteArray::number(4 * i - 26) +
                                       ", \"crouch\": " + QByteArray::number(0.03 * (i - 4)) +
                                       ", \"arm_swing\": " + QByteArray::number(3 - 0.3 * i);
    nodes += (i ? QByteArray(", \"") : QByteArray("\"")) + gaits[i] +
             "\": {\"type\": \"Gait\", \"params\": {\"seconds\": 4, \"speed\": 1.2, \"gait\": \"" +
             gaits[i % 5] + "\"" + own + "}}";
  }
  shot.text(nodes);
  for (int i = 0; i < 9; ++i) shot.viewer().pin(i + 1, gaits[i]);
  shot.window.playback().set_time(0.6);
  shot.wait();
  for (const auto& [arrangement, name] : {std::pair(Viewer::Arrangement::side_by_side, "viewer_nine"),
                                          std::pair(Viewer::Arrangement::overlaid, "viewer_nine_overlaid")}) {
    shot.viewer().set_arrangement(arrangement);
    shot.viewer().frame_all();
    shot.wait();
    shot.take_dock(name + end, "Viewer");
  }
}

// The camera goes along with the root: the same picture, three seconds on.
void followed(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("run": {"type": "Gait", "params": {"gait": "run", "seconds": 4}})");
  Viewer::Looks looks;
  looks.trails = true;
  shot.viewer().set_looks(looks);
  shot.window.playback().set_time(3);
  shot.viewer().frame_all();
  shot.wait();
  shot.take_dock("viewer_followed" + end, "Viewer");
  looks.trails = false;
  looks.follow = false;
  shot.viewer().set_looks(looks);
  shot.viewer().frame_all();
  shot.wait();
  shot.take_dock("viewer_not_followed" + end, "Viewer");
}

}  // namespace

void viewer_pictures(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.open("style_transfer");
    shot.select("feet");
    shot.window.playback().set_time(0.9);
    Viewer::Looks looks;
    const auto take = [&](const QString& name) {
      shot.viewer().set_looks(looks);
      shot.viewer().frame_all();
      shot.wait();
      shot.take_dock(name + end, "Viewer");
    };
    take("viewer_contacts");
    looks.trails = true;
    take("viewer_trails");
    looks.trails = false;
    looks.ghosts = 30;
    looks.follow = false;
    take("viewer_ghosts");
    looks.ghosts = 0;
    looks.follow = true;
    shot.viewer().pin(1, "walk");
    shot.viewer().pin(2, "feet");
    take("viewer_side_by_side");
    shot.viewer().set_arrangement(Viewer::Arrangement::overlaid);
    take("viewer_overlaid");
    shot.viewer().set_arrangement(Viewer::Arrangement::wipe);
    take("viewer_wipe");
    drag_wipe(shot, 0.5, 0.46);
    shot.take_dock("viewer_wipe_dragged" + end, "Viewer");
  }
  nine(theme, into, end);
  followed(theme, into, end);
  {
    Shot shot(theme, into);
    shot.text(R"("sparks": {"type": "Burst"})");
    shot.window.playback().set_time(1.2);
    shot.wait();
    shot.viewer().frame_all();
    shot.wait();
    shot.take_dock("viewer_points" + end, "Viewer");
  }
  {
    Shot shot(theme, into);
    shot.open("face");
    shot.select("brows");
    shot.window.playback().set_time(0.5);
    shot.viewer().frame_all();
    shot.wait();
    shot.take_dock("viewer_markers" + end, "Viewer");
  }
  {
    Shot shot(theme, into);
    shot.open("cartoon_walk");
    shot.select("planted");
    shot.window.playback().set_time(0.4);
    Viewer::Looks looks;
    looks.stretch = true;
    shot.viewer().set_looks(looks);
    shot.wait();
    shot.take_dock("viewer_stretch" + end, "Viewer");
  }
  {
    Shot shot(theme, into);
    shot.open("cartoon_character");
    shot.select("rubber");
    shot.window.playback().set_time(0.4);
    shot.wait();
    shot.viewer().frame_all();
    shot.wait();
    shot.take_dock("viewer_character" + end, "Viewer");
    Viewer::Looks looks;
    looks.trails = true;
    looks.contacts = true;
    shot.viewer().set_looks(looks);
    shot.wait();
    shot.take_dock("viewer_character_trails" + end, "Viewer");
  }
}

}  // namespace kinegraph::shots
