// The timeline in a real window: keys and mouse move the clip's clock.
#include <gtest/gtest.h>

#include <QToolButton>

#include "gui/timeline/timeline_tracks.h"
#include "tests/gui/viewing_window.h"

namespace kinegraph {
namespace {

const char* const warped = R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "walk": {"type": "Gait", "params": {"seconds": 3}},
    "sneak": {"type": "Gait", "params": {"gait": "sneak", "seconds": 4}},
    "warp": {"type": "TimeWarp", "inputs": {"source": "walk.motion", "reference": "sneak.motion"}}
  }
})";

TEST(ViewerTimeline, StepsPlaysAndSetsARangeWithKeys) {
  ViewingWindow window(warped);
  window.session.select({"walk"});
  ASSERT_TRUE(window.shows_motions());
  ASSERT_TRUE(ViewingWindow::until([&] { return window.playback.frames() > 0; }));
  QWidget* timeline = window.timeline;
  timeline->setFocus();
  window.playback.set_frame(0);
  QTest::keyClick(timeline, Qt::Key_Right);
  EXPECT_EQ(window.playback.frame(), 1);
  QTest::keyClick(timeline, Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_EQ(window.playback.frame(), 11);
  QTest::keyClick(timeline, Qt::Key_Left);
  EXPECT_EQ(window.playback.frame(), 10);
  QTest::keyClick(timeline, Qt::Key_I);
  QTest::keyClick(timeline, Qt::Key_End);
  EXPECT_EQ(window.playback.frame(), window.playback.frames() - 1);
  QTest::keyClick(timeline, Qt::Key_Home);
  EXPECT_EQ(window.playback.frame(), 10);  // the start of the range
  for (int i = 0; i < 5; ++i) QTest::keyClick(timeline, Qt::Key_Right, Qt::ShiftModifier);
  QTest::keyClick(timeline, Qt::Key_O);
  EXPECT_EQ(window.playback.in(), 10);
  EXPECT_EQ(window.playback.out(), 61);
  QTest::keyClick(timeline, Qt::Key_Space);
  EXPECT_TRUE(window.playback.is_playing());
  QTest::qWait(900);  // loops inside the range
  EXPECT_GE(window.playback.frame(), 10);
  EXPECT_LE(window.playback.frame(), 60);
  QTest::keyClick(timeline, Qt::Key_Space);
  EXPECT_FALSE(window.playback.is_playing());
  window.keep_picture("timeline_range");
}

TEST(ViewerTimeline, ScrubsWhereTheMouseIs) {
  ViewingWindow window(warped);
  window.session.select({"walk"});
  ASSERT_TRUE(window.shows_motions());
  auto* tracks = window.timeline->findChild<TimelineTracks*>();
  ASSERT_NE(tracks, nullptr);
  const int x = static_cast<int>(tracks->x_of(100)) + 1;
  QTest::mouseClick(tracks, Qt::LeftButton, {}, QPoint(x, tracks->height() / 2));
  EXPECT_NEAR(window.playback.frame(), 100, 1);
}

// A person chooses a node that can't give a motion after one that plays.
TEST(ViewerTimeline, TellsOfTheChosenNodeWhereItHasNothingToPlay) {
  ViewingWindow window(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "walk": {"type": "Gait", "params": {"seconds": 2}},
    "gone": {"type": "Load", "params": {"file": "nowhere.bvh"}},
    "soft": {"type": "Filter", "inputs": {"motion": "gone.motion"}},
    "alone": {"type": "Filter"}}})");
  auto* tracks = window.timeline->findChild<TimelineTracks*>();
  const auto buttons = [&] {
    int usable = 0;
    for (const QToolButton* button : window.timeline->findChildren<QToolButton*>())
      usable += button->isEnabled() ? 1 : 0;
    return usable;
  };
  const auto tells = [&](const char* words) {
    return ViewingWindow::until([&] { return tracks->accessibleDescription().contains(words); }, 10000);
  };
  window.session.select({"walk"});
  ASSERT_TRUE(window.shows_motions());
  ASSERT_TRUE(ViewingWindow::until([&] { return buttons() > 0; }));
  const QImage playing = tracks->grab().toImage();
  QTest::keyClick(tracks, Qt::Key_Space);
  EXPECT_TRUE(window.playback.is_playing());

  window.session.select({"soft"});
  EXPECT_TRUE(tells("soft waits for gone, which failed."));
  EXPECT_EQ(buttons(), 0);
  EXPECT_FALSE(window.playback.is_playing());
  QTest::keyClick(tracks, Qt::Key_Space);
  EXPECT_FALSE(window.playback.is_playing());
  QTest::mouseClick(tracks, Qt::LeftButton, {}, QPoint(tracks->width() / 2, tracks->height() / 2));
  EXPECT_NE(tracks->grab().toImage(), playing);

  window.session.select({"alone"});
  EXPECT_TRUE(tells("alone isn't linked yet"));
  window.session.select({"gone"});
  EXPECT_TRUE(tells("gone failed"));

  window.session.select({"walk"});
  EXPECT_TRUE(ViewingWindow::until([&] { return buttons() > 0; }));
  EXPECT_EQ(tracks->accessibleDescription(), "");
  QTest::keyClick(tracks, Qt::Key_Space);
  EXPECT_TRUE(window.playback.is_playing());
}

TEST(ViewerTimeline, ShowsTheContactsThatTheChosenNodeFinds) {
  ViewingWindow window(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "walk": {"type": "Gait", "params": {"seconds": 2}},
    "feet": {"type": "DetectContacts", "inputs": {"motion": "walk.motion"},
      "params": {"edits": [{"foot": "left", "range": [0, 200], "planted": true},
                           {"foot": "right", "range": [0, 200], "planted": true}]}}}})");
  ASSERT_TRUE(window.problems.empty()) << window.problems.front().message;
  auto* tracks = window.timeline->findChild<TimelineTracks*>();
  const auto colored = [&] {
    const QImage image = tracks->grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y).hslSaturation() > 120 ? 1 : 0;
    return count;
  };
  window.session.select({"walk"});
  ASSERT_TRUE(window.shows_motions());
  QTest::qWait(100);
  const int found = colored();
  window.session.select({"feet"});
  ASSERT_TRUE(ViewingWindow::until([&] { return window.viewer->shown().front().contacts() != nullptr; }));
  QTest::qWait(100);
  EXPECT_GT(colored(), found * 5 / 4);  // planted all the time
}

TEST(ViewerTimeline, ShowsAWarpAsLinesAndCurves) {
  ViewingWindow window(warped);
  window.session.select({"warp"});
  ASSERT_TRUE(window.shows_motions());
  ASSERT_TRUE(ViewingWindow::until([&] { return window.evaluation.value("warp", "warp") != nullptr; }));
  window.playback.set_frame(150);
  QTest::qWait(800);
  window.keep_picture("timeline_warp");
  window.set_theme(light_theme());
  window.keep_picture("timeline_warp_light");
}

TEST(ViewerCurves, LaysTheResultOverItsSource) {
  ViewingWindow window(R"({
    "format": "kinegraph",
    "schema": 1,
    "nodes": {
      "walk": {"type": "Gait", "params": {"seconds": 3}},
      "calm": {"type": "Filter", "params": {"cutoff": 1.5}, "inputs": {"motion": "walk.motion"}},
      "stats": {"type": "QuatStats", "inputs": {"motion": "walk.motion"}},
      "metrics": {"type": "Metrics", "inputs": {"motion": "calm.motion", "reference": "walk.motion"}}
    }
  })");
  ASSERT_TRUE(window.problems.empty()) << window.problems.front().message;
  window.session.select({"calm"});
  ASSERT_TRUE(window.shows_motions());
  QTest::qWait(800);
  window.keep_picture("curves_channels");
  window.session.select({"stats"});
  ASSERT_TRUE(ViewingWindow::until([&] { return window.evaluation.value("stats", "stats") != nullptr; }));
  window.keep_picture("curves_stats");
  window.session.select({"metrics"});
  ASSERT_TRUE(ViewingWindow::until([&] { return window.evaluation.value("metrics", "metrics") != nullptr; }));
  window.keep_picture("curves_metrics");
}

}  // namespace
}  // namespace kinegraph
