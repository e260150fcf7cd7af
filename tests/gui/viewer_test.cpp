// The viewer in a real window: what it shows, how mouse and keys change it, and that it keeps the clip's
// clock.
#include <gtest/gtest.h>

#include <QColor>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "graph/file/read.h"
#include "gui/look/hairline.h"
#include "gui/viewing/looked_at.h"
#include "tests/gui/mouse.h"
#include "tests/gui/viewing_window.h"
#include "tests/mocap.h"

namespace kinegraph {
namespace {

const char* const five_gaits = R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "walk": {"type": "Gait", "params": {"seconds": 4}},
    "run": {"type": "Gait", "params": {"gait": "run", "seconds": 4}},
    "sneak": {"type": "Gait", "params": {"gait": "sneak", "seconds": 4}},
    "strut": {"type": "Gait", "params": {"gait": "strut", "seconds": 4}},
    "hobble": {"type": "Gait", "params": {"gait": "hobble", "seconds": 4}}
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

QPoint middle_of_stage(const Viewer& viewer) {
  return QPoint(viewer.width() / 2, viewer.height() / 2 + 15);
}

// What a person's hand hits there.
QWidget* widget_at(QWidget& window, QPoint at) {
  QWidget* child = window.childAt(at);
  return child ? child : &window;
}

TEST(Viewer, ShowsTheCurrentNodeAsALitBodyWithSides) {
  ViewingWindow window(five_gaits);
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

TEST(Viewer, SaysWhatToDoWhereThereIsNothing) {
  ViewingWindow window(R"({"format": "kinegraph", "schema": 1, "nodes": {}})");
  window.keep_picture("viewer_empty");
  bool told = false;
  for (const QLabel* label : window.viewer->findChildren<QLabel*>())
    told = told || (label->isVisible() && label->text().contains("Load"));
  EXPECT_TRUE(told);
}

TEST(Viewer, TurnsWithTheMouseAndFramesWithF) {
  ViewingWindow window(five_gaits);
  window.session.select({"walk"});
  ASSERT_TRUE(window.shows_motions());
  const QImage before = window.viewer->picture();
  const QPoint at = middle_of_stage(*window.viewer);
  QWidget* stage = widget_at(*window.viewer, at);
  const QPoint inside = stage->mapFrom(window.viewer, at);
  editor_test::drag(*stage, inside, inside + QPoint(120, 10));
  EXPECT_NE(window.viewer->picture(), before);
  QTest::keyClick(window.viewer, Qt::Key_F);  // as near as this side allows
  const QImage turned = window.viewer->picture();
  EXPECT_NE(turned, before);
  editor_test::drag(*stage, inside, inside + QPoint(60, 60), {.button = Qt::MiddleButton});
  EXPECT_NE(window.viewer->picture(), turned);
  QTest::keyClick(window.viewer, Qt::Key_F);
  EXPECT_EQ(window.viewer->picture(), turned);
}

TEST(Viewer, PinsNodesToPlacesSideBySideOverlaidAndWithAWipe) {
  ViewingWindow window(five_gaits);
  window.viewer->setFocus();
  window.session.select({"walk"});
  QTest::keyClick(window.viewer, Qt::Key_1);
  window.session.select({"sneak"});
  QTest::keyClick(window.viewer, Qt::Key_2);
  ASSERT_TRUE(window.shows_motions(2));
  ASSERT_EQ(window.viewer->shown().size(), 2u);
  EXPECT_EQ(window.viewer->shown()[0].target.node, "walk");
  EXPECT_EQ(window.viewer->shown()[1].target.node, "sneak");
  window.playback.set_frame(100);
  QTest::keyClick(window.viewer, Qt::Key_F);
  window.keep_picture("viewer_side_by_side");
  const QImage beside = window.viewer->picture();
  QTest::keyClick(window.viewer, Qt::Key_W);
  EXPECT_EQ(window.viewer->arrangement(), Viewer::Arrangement::overlaid);
  window.keep_picture("viewer_overlaid");
  const QImage overlaid = window.viewer->picture();
  EXPECT_NE(overlaid, beside);
  QTest::keyClick(window.viewer, Qt::Key_W);
  EXPECT_EQ(window.viewer->arrangement(), Viewer::Arrangement::wipe);
  window.keep_picture("viewer_wipe");
  EXPECT_NE(window.viewer->picture(), overlaid);
  QTest::keyClick(window.viewer, Qt::Key_2);  // the current node again: empties its place
  EXPECT_EQ(window.viewer->shown().size(), 1u);
}

TEST(Viewer, AddsTrailsAndGhosts) {
  ViewingWindow window(five_gaits);
  window.session.select({"run"});
  ASSERT_TRUE(window.shows_motions());
  window.playback.set_frame(200);
  const QImage plain = window.viewer->picture();
  QTest::keyClick(window.viewer, Qt::Key_T);
  const QImage trails = window.viewer->picture();
  EXPECT_NE(trails, plain);
  QTest::keyClick(window.viewer, Qt::Key_R);  // no longer follows the root
  QTest::keyClick(window.viewer, Qt::Key_G);
  QTest::keyClick(window.viewer, Qt::Key_F);
  window.keep_picture("viewer_trails_ghosts");
  EXPECT_TRUE(window.viewer->looks().ghosts > 0);
  EXPECT_NE(window.viewer->picture(), trails);
}

TEST(Viewer, PlaysFiveBodiesOnTheClipsClock) {
  ViewingWindow window(five_gaits);
  const char* const names[] = {"walk", "run", "sneak", "strut", "hobble"};
  for (int place = 1; place <= 5; ++place) window.viewer->pin(place, names[place - 1]);
  ASSERT_TRUE(window.shows_motions(5));
  window.keep_picture("viewer_five");
  window.playback.set_frame(0);
  window.playback.set_loops(false);
  const int drawn = window.viewer->pictures_drawn();
  QElapsedTimer clock;
  clock.start();
  window.playback.play();
  double late = 0;
  while (clock.elapsed() < 3000) {
    QTest::qWait(15);
    late =
        std::max(late, std::abs(window.playback.time() - static_cast<double>(clock.nsecsElapsed()) * 1e-9));
  }
  const double pictures = (window.viewer->pictures_drawn() - drawn) / 3.0;
  RecordProperty("pictures_a_second", static_cast<int>(pictures));
  std::printf("%.1f pictures a second, %s, clock off by %.3f s\n", pictures,
              window.viewer->uses_opengl() ? "OpenGL" : "QPainter", late);
  // The clock runs on whatever the machine can draw; a busy machine only draws fewer pictures.
  window.playback.pause();
  EXPECT_NEAR(window.playback.time(), static_cast<double>(clock.nsecsElapsed()) * 1e-9, 0.25);
  EXPECT_GT(pictures, 1);
}

TEST(Viewer, DrawsTheSameSceneWithoutOpenGL) {
  qputenv("KINEGRAPH_OPENGL", "0");
  {
    ViewingWindow window(five_gaits);
    window.session.select({"walk"});
    ASSERT_TRUE(window.shows_motions());
    EXPECT_FALSE(window.viewer->uses_opengl());
    window.playback.set_frame(40);
    window.keep_picture("viewer_qpainter");
    const QImage picture = window.viewer->picture();
    EXPECT_GT(pixels_like(picture, dark_theme().left, 12), 300);
    EXPECT_GT(pixels_like(picture, dark_theme().right, 12), 300);
  }
  qunsetenv("KINEGRAPH_OPENGL");
}

TEST(Viewer, ShowsASkinnedCharacter) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::string file = mocap("gltf/CesiumMan.glb");
  ViewingWindow window(
      R"({"format": "kinegraph", "schema": 1, "nodes": {"man": {"type": "Load", "params": {"file": ")" +
      file + R"("}}}})");
  ASSERT_TRUE(window.shows_motions());
  ASSERT_TRUE(ViewingWindow::until([&] { return window.viewer->shown().front().character != nullptr; }));
  window.playback.set_frame(20);
  window.keep_picture("viewer_character");
  // A skin is one surface without sides.
  EXPECT_LT(pixels_like(window.viewer->picture(), dark_theme().right, 10), 300);
}

TEST(Viewer, ShowsPointsOfANodeThatIsFedWithPointsThoughItCanMakeMotions) {
  const Registry registry = all_nodes();
  const Document document = read_document(R"({"format": "kinegraph", "schema": 1, "nodes": {
        "sparks": {"type": "Burst"},
        "parts": {"type": "ICA", "inputs": {"motions": ["sparks.points"]}},
        "edit": {"type": "ComponentEdit", "inputs": {"components": "parts.components"}},
        "walk": {"type": "Gait"},
        "steps": {"type": "ICA", "inputs": {"motions": ["walk.motion"]}},
        "calmer": {"type": "ComponentEdit", "inputs": {"components": "steps.components"}}}})",
                                          "a", registry)
                                .document;
  const auto points = nearest_output(document, registry, "edit", {"Motion", "Points"});
  ASSERT_TRUE(points);
  EXPECT_EQ(points->node + "." + points->port, "edit.points");
  const auto motion = nearest_output(document, registry, "calmer", {"Motion", "Points"});
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->node + "." + motion->port, "calmer.motion");
}

TEST(Viewer, LooksTheSameWithOpenGLAndWithQPainter) {
  const auto pictures = [] {
    ViewingWindow window(five_gaits);
    window.session.select({"walk"});
    std::vector<QImage> all;
    if (!window.shows_motions()) return all;
    window.playback.set_frame(40);
    window.viewer->frame_all();
    for (const Theme* theme : {&dark_theme(), &light_theme()}) {
      window.set_theme(*theme);
      all.push_back(window.viewer->picture());
    }
    return all;
  };
  const std::vector<QImage> drawn = pictures();
  qputenv("KINEGRAPH_OPENGL", "0");
  const std::vector<QImage> painted = pictures();
  qunsetenv("KINEGRAPH_OPENGL");
  ASSERT_EQ(drawn.size(), 2u);
  ASSERT_EQ(painted.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(drawn[i].size(), painted[i].size());
    // By small tiles: edges of bones and lines may lie half a pixel apart.
    constexpr int tile = 12;
    double worst = 0, sum = 0;
    int tiles = 0;
    for (int y = 0; y + tile <= drawn[i].height(); y += tile)
      for (int x = 0; x + tile <= drawn[i].width(); x += tile, ++tiles) {
        double difference = 0;
        for (int k = 0; k < tile * tile; ++k)
          difference += qGray(drawn[i].pixel(x + k % tile, y + k / tile)) -
                        qGray(painted[i].pixel(x + k % tile, y + k / tile));
        difference = std::abs(difference / (tile * tile));
        worst = std::max(worst, difference);
        sum += difference;
      }
    EXPECT_LT(sum / tiles, 1.5);
    EXPECT_LT(worst, 40);
  }
}

TEST(Viewer, FramesAllOfABodyAsLargeAsItFits) {
  OrbitCamera camera;
  camera.yaw = 1.1f;
  camera.pitch = 0.4f;
  std::vector<QVector3D> points;
  for (int i = 0; i < 60; ++i)
    points.emplace_back(0.3f * std::sin(0.7f * static_cast<float>(i)) + 4, 0.03f * static_cast<float>(i),
                        0.02f * static_cast<float>(i) - 3);
  for (const QSizeF size : {QSizeF(900, 300), QSizeF(300, 300), QSizeF(200, 500)}) {
    camera.frame_closely(points, 0.02f, size.width() / size.height(), 0.12);
    double left = 1, right = 0, top = 1, bottom = 0;
    for (const QVector3D& point : points) {
      const auto at = camera.on_picture(point, size);
      ASSERT_TRUE(at);
      left = std::min(left, at->x() / size.width());
      right = std::max(right, at->x() / size.width());
      top = std::min(top, at->y() / size.height());
      bottom = std::max(bottom, at->y() / size.height());
    }
    EXPECT_GT(left, 0.04);
    EXPECT_LT(right, 0.96);
    EXPECT_GT(top, 0.11);  // the caption stands there
    EXPECT_LT(bottom, 0.96);
    EXPECT_TRUE(bottom - top > 0.75 || right - left > 0.75) << bottom - top << " " << right - left;
  }
}

TEST(Viewer, GivesEveryBodyAHead) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* clip : {"xia/angry_13_000.bvh", "bandai/dataset-1_kick_normal_001.bvh",
                           "accad/Male1_B3_Walk.bvh", "cmu/bvh/08_01.bvh", "gltf/CesiumMan.glb"}) {
    ViewingWindow window(
        R"({"format": "kinegraph", "schema": 1, "nodes": {"clip": {"type": "Load", "params": {"file": ")" +
        mocap(clip) + R"("}}}})");
    ASSERT_TRUE(window.shows_motions()) << clip;
    const auto& bones = window.viewer->shown().front().motion->bones;
    EXPECT_EQ(std::count_if(bones.begin(), bones.end(), [](const auto& bone) { return bone.head; }), 1)
        << clip;
  }
}

TEST(Viewer, LinksMarkersThatStayTogetherAndNoneThatFly) {
  ViewingWindow sparks(R"({"format": "kinegraph", "schema": 1, "nodes": {"sparks": {"type": "Burst"}}})");
  ASSERT_TRUE(sparks.shows_motions());
  EXPECT_TRUE(sparks.viewer->shown().front().motion->bones.empty());
  KINEGRAPH_NEEDS_MOCAP();
  ViewingWindow body(
      R"({"format": "kinegraph", "schema": 1, "nodes": {"clip": {"type": "Load", "params": {"file": ")" +
      mocap("points/cmu_02_01.c3d") + R"("}}}})");
  ASSERT_TRUE(body.shows_motions());
  const ShownMotion& motion = *body.viewer->shown().front().motion;
  EXPECT_GE(motion.bones.size(), static_cast<std::size_t>(motion.points) * 3 / 4);
  for (const ShownMotion::Bone& bone : motion.bones) EXPECT_LT(bone.from, bone.to);
}

TEST(Hairlines, AreOneSharpPixelAtOneAndAHalfTimesTheScale) {
  for (const double scale : {1.0, 1.25, 1.5, 2.0}) {
    QImage image(QSize(60, 60), QImage::Format_RGB32);
    image.setDevicePixelRatio(scale);
    image.fill(Qt::black);
    {
      QPainter painter(&image);
      painter.setRenderHint(QPainter::Antialiasing);
      draw_hairline(painter, QPointF(10.3, 4), QPointF(10.3, 20), Qt::white);
    }
    int lit = 0;
    for (int x = 0; x < image.width(); ++x) {
      const int grey = qGray(image.pixel(x, 15));
      EXPECT_TRUE(grey == 0 || grey == 255) << "scale " << scale << ", column " << x << ": " << grey;
      lit += grey == 255 ? 1 : 0;
    }
    EXPECT_EQ(lit, static_cast<int>(scale));
  }
}

TEST(Viewer, ShowsARealClip) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::string graph =
      R"({"format": "kinegraph", "schema": 1, "nodes": {"clip": {"type": "Load", "params": {"file": ")" +
      mocap("cmu/bvh/08_01.bvh") + R"("}}}})";
  ViewingWindow window(graph);
  ASSERT_TRUE(window.shows_motions());
  window.playback.set_frame(120);
  window.keep_picture("viewer_clip");
  EXPECT_GT(window.viewer->shown().front().motion->contacts.points.size(), 0u);
}

}  // namespace
}  // namespace kinegraph
