// The viewer in a real window: what it shows, how mouse and keys change it, and that it keeps the clip's
// clock.
#include <gtest/gtest.h>

#include <QColor>
#include <cmath>

#include "tests/gui/viewing_window.h"

namespace kinegraph {
namespace {

const char* const two_walks = R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "sneak": {"type": "Gait", "params": {"gait": "sneak", "seconds": 4}},
    "walk": {"type": "Gait", "params": {"seconds": 4}}
  }
})";

int pixels_like(const QImage& image, const QColor& color, int tolerance) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const QColor at = image.pixelColor(x, y);
      if (std::abs(at.hslHue() - color.hslHue()) < tolerance && at.hslSaturation() > 90) ++count;
    }
  return count;
}

TEST(Viewer, ShowsTheCurrentNodeAsALitBodyWithSides) {
  ViewingWindow window(two_walks);
  ASSERT_TRUE(window.problems.empty()) << window.problems.front().message;
  window.session.select({"walk"});
  ASSERT_TRUE(window.shows_motions());
  window.playback.set_frame(40);
  window.keep_picture("viewer_dark");
  const QImage picture = window.viewer->picture();
  EXPECT_GT(pixels_like(picture, dark_theme().left, 12), 300);
  EXPECT_GT(pixels_like(picture, dark_theme().right, 12), 300);
  window.set_theme(light_theme());
  window.keep_picture("viewer_light");
}

}  // namespace
}  // namespace kinegraph
