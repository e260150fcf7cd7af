#include <gmock/gmock.h>

#include "headless/draws/picture.h"
#include "nodes/components/ica.h"
#include "nodes/motion/metrics.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

Components walk_and_sneak() {
  Alone work;
  std::vector<std::shared_ptr<const Motion>> clips = {std::make_shared<const Motion>(gait("walk", 1.5)),
                                                      std::make_shared<const Motion>(gait("sneak", 2))};
  IcaParams params;
  params.components = 2;
  const std::vector<bool> all(static_cast<std::size_t>(clips[0]->joints()), true);
  return components_of_motions(space_of_motions(Representation::points, clips, all, true, {}, work), clips,
                               params, work);
}

TEST(ComponentsSheet, ShowsEachComponentAndLastAllTogether) {
  const std::string svg = picture_of(walk_and_sneak(), {.title = "parts"}).svg("parts");
  for (const char* words : {"u1", "u2", "of the variance", "moves", "all of them together",
                            "segment 0 · 90 frames · 1.50 s", "segment 1 · 120 frames"})
    EXPECT_THAT(svg, HasSubstr(words));
  EXPECT_THAT(svg, testing::Not(HasSubstr("nan")));
}

TEST(ComponentsSheet, GivesTheSameBytesAgain) {
  EXPECT_EQ(picture_of(walk_and_sneak(), {}).svg(""), picture_of(walk_and_sneak(), {}).svg(""));
}

TEST(ComponentsSheet, ShowsComponentsOfPoints) {
  Alone work;
  auto clip = std::make_shared<Points>(std::vector<std::string>{"brow", "jaw", "ear"}, 60, 60);
  clip->links = {{0, 1}};
  for (int i = 0; i < 3; ++i)
    for (std::size_t t = 0; t < 60; ++t)
      clip->track(i).set(t, {0.1 * i, sine(0.1 * static_cast<double>(t * (i + 1))), 0});
  IcaParams params;
  params.components = 2;
  const Components components = components_of_points(
      space_of_points({clip}, Stabilise::none, {true, true, true}), {clip}, params, work);
  EXPECT_THAT(picture_of(components, {}).svg(""), HasSubstr("moves"));
}

TEST(MeaningSheet, DrawsAColumnOfBarsForEachComponent) {
  Metrics metrics;
  for (const char* u : {"u1", "u2"}) {
    metrics.all.push_back({std::string(u) + ".d_emotion", 1.5, ""});
    metrics.all.push_back({std::string(u) + ".d_region.arms", -0.12, "m"});
    metrics.all.push_back({std::string(u) + ".variance", 0.4, ""});
    metrics.all.push_back({std::string(u) + ".cadence", std::nullopt, "Hz"});
    metrics.all.push_back({std::string(u) + ".moves.Head", 0.1, "m"});
  }
  const std::string svg = picture_of(metrics, {}).svg("");
  for (const char* words : {"u2", "arms", "-12", "mostly arms", "40.0 % of the variance", "no steady beat", "Head"})
    EXPECT_THAT(svg, HasSubstr(words));
}

}  // namespace
}  // namespace kinegraph
