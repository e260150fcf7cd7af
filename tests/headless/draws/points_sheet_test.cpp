#include <gmock/gmock.h>

#include "headless/draws/picture.h"
#include "headless/draws/points_layout.h"
#include "nodes/motion/elementary.h"
#include "nodes/points/burst.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::Not;

// A triangle of markers that walks along x; the third is gone from frame 10 to 29.
Points three_markers() {
  Points points({"LKNE", "RKNE", "SACR"}, 60, 90);
  for (std::size_t t = 0; t < 90; ++t) {
    const double x = 0.03 * static_cast<double>(t);
    points.track(0).set(t, {x, 0.5, 0.1});
    points.track(1).set(t, {x, 0.5, -0.1});
    points.track(2).set(t, {x, 1.0, 0.01 * static_cast<double>(t % 2)});
  }
  for (std::size_t t = 10; t < 30; ++t) points.set_missing(2, t);
  return points;
}

TEST(PointsLayout, BridgesAGapAlongWithTheOthers) {
  const BridgedPoints bridge = bridged(three_markers());
  for (std::size_t t = 10; t < 30; ++t) {
    EXPECT_NEAR(bridge.places[2][t].x, 0.03 * static_cast<double>(t), 0.02);
    EXPECT_NEAR(bridge.places[2][t].y, 1.0, 1e-9);
  }
  EXPECT_NEAR(bridge.middle[20].y, bridge.middle[60].y, 1e-9)
      << "a point that vanishes doesn't move the cloud";
}

TEST(PointsLayout, HasNoPlaceForAPointThatIsNeverThere) {
  Points points = three_markers();
  for (std::size_t t = 0; t < points.frames; ++t) points.set_missing(1, t);
  EXPECT_TRUE(bridged(points).places[1].empty());
}

TEST(PointsLayout, FindsSidesByTwins) {
  const auto sides = sides_of({"LKNE", "RKNE", "SACR", "Mouth_UpL1", "Mouth_UpR1", "Lcheek", "Ring"});
  EXPECT_EQ(sides, (std::vector<Side>{Side::left, Side::right, Side::middle, Side::left, Side::right,
                                      Side::middle, Side::middle}));
}

TEST(PointsLayout, LooksAtTheSideOfWhatTravels) {
  const PointsView view = view_of(bridged(three_markers()));
  EXPECT_TRUE(view.travels);
  EXPECT_GT(std::abs(view.from.z), std::abs(view.from.x));
  EXPECT_NEAR(view.travelled, 0.03 * 89, 0.2);
}

TEST(PointsLayout, JoinsWhatKeepsItsDistance) {
  const Points points = three_markers();
  const auto links = steady_links(points, bridged(points), 64);
  EXPECT_THAT(links, testing::Contains(std::pair(0, 1)));
  EXPECT_TRUE(steady_links(points, bridged(points), 2).empty());
}

TEST(PointsSheet, NamesMarkersAndShowsWhereTheyAreMissing) {
  const std::string svg = picture_of(three_markers(), {.title = "knees"}).svg("knees");
  for (const char* words :
       {"knees", "3 points · 90 frames · 60 fps · 1.50 s · 20 of 270 samples missing", "LKNE", "RKNE", "left",
        "right", "missing: 1 of 3 points", "missing: where it might be", "m/s", "height", "time"})
    EXPECT_THAT(svg, HasSubstr(words));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(svg, picture_of(three_markers(), {.title = "knees"}).svg("knees"));
}

TEST(PointsSheet, LeavesOutTheNamesOfParticles) {
  Alone work;
  const std::string svg = picture_of(burst({}, work), {}).svg("");
  EXPECT_THAT(svg, HasSubstr("200 points"));
  EXPECT_THAT(svg, Not(HasSubstr(">p17<")));
}

TEST(PointsSheet, LeavesOutASubjectsNameAndDrawsOneFrame) {
  Points points({"Ann:LKNE", "Ann:RKNE"}, 60, 1);
  points.track(1).set(0, {0.2, 0, 0});
  const std::string svg = picture_of(points, {}).svg("");
  EXPECT_THAT(svg, HasSubstr(">LKNE<"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(PointsSheet, SaysThatThereIsNothing) {
  EXPECT_THAT(picture_of(Points(), {}).svg(""), HasSubstr("nothing to draw"));
  EXPECT_THAT(picture_of(Points({"A"}, 60, 0), {}).svg(""), HasSubstr("nothing to draw"));
}

}  // namespace
}  // namespace kinegraph
