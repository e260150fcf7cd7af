// The viewer's pictures: everything that it can show of a motion, with OpenGL or with QPainter.
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {

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
  }
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
  }
}

}  // namespace kinegraph::shots
