#include "nodes/components/component_meaning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/components/alignment.h"
#include "nodes/motion/metrics.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
NodeType component_meaning_node();
namespace {

// Three points; u1 moves the first and differs between the two segments, u2 moves the second, u3 the first
// and third.
Components three() {
  Components c;
  c.space.of_motions = false;
  c.space.labels = {"brow", "jaw", "ear"};
  c.fps = 50;
  c.mean.assign(9, 0);
  c.mixing = Rows(9, 3);
  c.mixing(1, 0) = 2;
  c.mixing(4, 1) = 1;
  c.mixing(2, 2) = 0.5;
  c.mixing(8, 2) = 0.25;
  c.signals = Rows(3, 200);
  for (std::size_t t = 0; t < 200; ++t) {
    c.signals(0, t) = (t < 100 ? 1.2 : -1.2) + 0.1 * sine(0.9 * static_cast<double>(t));
    c.signals(1, t) = sine(2 * pi * static_cast<double>(t % 100) / 25);
    c.signals(2, t) = cosine(2 * pi * static_cast<double>(t % 100) / 25);
  }
  c.shares = {0.7, 0.2, 0.1};
  for (std::size_t start : {0, 100}) {
    const auto clip = std::make_shared<const Points>(c.space.labels, 50, 100);
    c.segments.push_back({start, start + 100, nullptr, clip, {}});
  }
  return c;
}
double rms(const Components& c, std::size_t i) {
  double sum = 0;
  for (std::size_t t = 0; t < c.frames(); ++t)
    sum += c.signals(i, t) * c.signals(i, t) / static_cast<double>(c.frames());
  return std::sqrt(sum);
}

TEST(ComponentMeaningOf, MeasuresHowClipsDifferAfterAlignment) {
  Alone work;
  const Components c = three();
  MeaningParams params;
  params.pairs = {{0, 1}};
  params.align = {"u2", "u3"};
  const ComponentMeaning meaning = component_meaning(c, params, work);
  const Correspondence path = aligned_segments(c, c.segments[0], c.segments[1], {"u2", "u3"}, "align", work);
  for (std::size_t j = 0; j < 3; ++j) {
    double sum = 0;
    for (const auto& [a, b] : path.pairs) {
      const double d = c.signals(j, a) - c.signals(j, 100 + b);
      sum += d * d;
    }
    EXPECT_NEAR(*meaning.d_emotion[j], std::sqrt(sum / static_cast<double>(path.pairs.size())), 1e-12);
  }
  EXPECT_EQ(meaning.emotion, std::vector<std::size_t>{0}) << "u1 tells them apart";
}

TEST(ComponentMeaningOf, MeasuresWhatEachAddsToARegion) {
  Alone work;
  const Components c = three();
  MeaningParams params;
  params.pairs = {{0, 1}};
  params.align = {"u2"};
  params.regions = {{"brow", "brow"}, {"jaw", "jaw"}, {"both", "brow,jaw"}};
  const auto d = component_meaning(c, params, work).d_region;
  // Only what is missing counts: of the brow u3 (0.5), of the jaw u2 (1).
  EXPECT_NEAR(d[0][1], 0, 1e-12);
  EXPECT_NEAR(d[0][2], -0.5 * rms(c, 2), 1e-12);
  EXPECT_NEAR(d[1][1], -1 * rms(c, 1), 1e-12);
  EXPECT_NEAR(d[1][2], 0, 1e-12);
  // u1 is E itself: d(x_E, x_all) - d(mean, x_all).
  double with = 0, without = 0;
  for (std::size_t t = 0; t < 200; ++t) {
    const double y = 2 * c.signals(0, t), z = 0.5 * c.signals(2, t);
    with += z * z / 200;
    without += (y * y + z * z) / 200;
  }
  EXPECT_NEAR(d[0][0], std::sqrt(with) - std::sqrt(without), 1e-12);
  EXPECT_NEAR(d[2][1], std::sqrt(with / 2) - std::sqrt((with + rms(c, 1) * rms(c, 1)) / 2), 1e-12);
}

TEST(ComponentMeaningOf, FindsCadenceAndWhatMoves) {
  const Components c = three();
  EXPECT_NEAR(cadences_of(c)[1]->hertz, 2, 0.05);
  const auto moved = moved_by(c, 2);
  EXPECT_EQ(moved[0].label, "brow");
  EXPECT_NEAR(moved[0].amount, 0.5 * rms(c, 2), 1e-12);
  EXPECT_EQ(moved[1].label, "ear");
}

// Joined clips have beats of their own; numbers beside each other are of one of them.
// A jaw that opens steadily in its own clip, and trembles by next to nothing in the brows'.
TEST(ComponentMeaningOf, FindsNoCadenceWhereAComponentRests) {
  Components c = three();
  for (std::size_t t = 0; t < 100; ++t) c.signals(1, t) = 0.05 * sine(2 * pi * static_cast<double>(t) / 10);
  const auto cadence = cadences_of(c)[1];
  ASSERT_TRUE(cadence);
  EXPECT_EQ(cadence->segment, 1u);
  EXPECT_NEAR(cadence->hertz, 2, 0.05);
}

TEST(ComponentMeaningOf, MeasuresAllCadencesInOneSegment) {
  Components c = three();
  const auto swing = [&](std::size_t i, std::size_t start, double period, double size) {
    for (std::size_t t = start; t < start + 100; ++t)
      c.signals(i, t) = size * sine(2 * pi * static_cast<double>(t - start) / period);
  };
  swing(0, 0, 25, 1);  // 2 Hz in the first
  swing(1, 0, 25, 1);
  swing(0, 100, 20, 0.8);
  swing(1, 100, 20, 1.3);  // 2.5 Hz in the second, where the second component alone is stronger
  swing(2, 0, 1e9, 0);
  swing(2, 100, 20, 1);  // still in the first
  const auto cadences = cadences_of(c);
  for (std::size_t i : {0, 1}) {
    ASSERT_TRUE(cadences[i]);
    EXPECT_NEAR(cadences[i]->hertz, 2, 0.05) << "u" << i + 1;
    EXPECT_EQ(cadences[i]->segment, 0u);
  }
  ASSERT_TRUE(cadences[2]);
  EXPECT_NEAR(cadences[2]->hertz, 2.5, 0.05);
  EXPECT_EQ(cadences[2]->segment, 1u);
  EXPECT_EQ(text_of(*cadences[2], c), "2.50 Hz in segment 1");
  NodeInMemory node(component_meaning_node());
  node.link("components", c).run();
  const auto& metrics = node.out<Metrics>("metrics");
  EXPECT_EQ(metrics.find("u1.cadence_segment")->value, 0);
  EXPECT_EQ(metrics.find("u3.cadence_segment")->value, 1);
}

// Regions of the body, by how much their links turn: what hangs on a limb is only carried along.
TEST(ComponentMeaningOfMotions, NamesTheRegionsThatMove) {
  Motion still = gait("walk", 1);
  for (int joint = 0; joint < still.joints(); ++joint)
    for (std::size_t t = 1; t < 60; ++t) {
      still.rotation(joint).set(t, still.rotation(joint)[0]);
      if (still.translates(joint)) still.translation(joint).set(t, still.translation(joint)[0]);
    }
  const auto moved = [&](std::initializer_list<const char*> joints) {
    Motion motion = still;
    for (const char* joint : joints)
      for (std::size_t t = 0; t < 60; ++t)
        motion.rotation(motion.skeleton().find(joint))
            .set(t, exp(Vec3{0.2 * sine(0.3 * static_cast<double>(t)), 0, 0}));
    Alone work;
    for (Representation representation : {Representation::logarithm, Representation::quaternions}) {
      const std::string by_rotation = what_moves(analysed({shared(motion)}, representation, 1, work), 0);
      EXPECT_EQ(by_rotation, what_moves(analysed({shared(motion)}, Representation::logarithm, 1, work), 0));
    }
    return what_moves(analysed({shared(motion)}, Representation::points, 1, work), 0);
  };
  EXPECT_EQ(moved({"LeftUpLeg", "RightUpLeg"}), "legs");
  EXPECT_EQ(moved({"LeftArm", "RightArm"}), "arms");
  EXPECT_EQ(moved({"Head", "Neck"}), "head");
}

TEST(ComponentMeaningNode, NamesItsMetrics) {
  NodeInMemory node(component_meaning_node());
  node.link("components", three()).set("regions", Json::Object{{"upper face", "brow,ear"}}).run();
  const auto& metrics = node.out<Metrics>("metrics");
  for (const char* name :
       {"u1.d_emotion", "u1.d_region.upper_face", "u1.variance", "u2.cadence", "u3.moves.brow"})
    EXPECT_TRUE(metrics.find(name)) << name;
  EXPECT_EQ(metrics.find("u1.variance")->value, 0.7);
}

TEST(ComponentMeaningNode, LeavesEmotionOpenForASingleClip) {
  Components c = three();
  c.segments.pop_back();
  NodeInMemory node(component_meaning_node());
  node.link("components", c).run();
  EXPECT_FALSE(node.out<Metrics>("metrics").find("u1.d_emotion")->value);
}

TEST(ComponentMeaningNode, TellsWhatIsWrong) {
  NodeInMemory pairs(component_meaning_node()), regions(component_meaning_node());
  pairs.link("components", three()).set("pairs", Json::Array(1, Json(Json::Array{0, 5})));
  EXPECT_EQ(pairs.refusal().code, "unknown-segment");
  pairs.set("pairs", Json::Array(1, Json(Json::Array{1, 1})));
  EXPECT_EQ(pairs.refusal().code, "bad-pair");
  regions.link("components", three()).set("regions", Json::Object{{"face", "nose"}});
  EXPECT_EQ(regions.refusal().code, "unknown-joint");
}

// Arms and legs of a walk: rotations count where they move the joints.
TEST(ComponentMeaningOfMotions, MeasuresRegionsInMetresForEveryRepresentation) {
  Alone work;
  for (Representation representation : {Representation::points, Representation::logarithm}) {
    const Components c =
        analysed({shared(gait("walk", 2)), shared(gait("sneak", 2))}, representation, 3, work);
    MeaningParams params;
    params.pairs = {{0, 1}};
    params.regions = {{"legs", "*Leg*"}};
    const auto d = component_meaning(c, params, work).d_region[0];
    for (double value : d) EXPECT_LT(std::fabs(value), 0.5);
    EXPECT_LT(*std::min_element(d.begin(), d.end()), -0.005);
  }
}

}  // namespace
}  // namespace kinegraph
