#include "nodes/cartoon/cartoon_filter.h"

#include <gtest/gtest.h>

#include "nodes/cartoon/exaggerate.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {

NodeType cartoon_filter_node();

namespace {

// A joint that swings about z with slow sines.
Motion pendulum(double hertz, double fps = 60) {
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"a", -1, {0, 2, 0}, {}}, {"b", 0, {0, -1, 0}, {}}, {"c", 1, {0, -1, 0}, {}}};
  Motion motion(skeleton, std::make_shared<SourceFacts>(), fps, 600, {false, false, false});
  for (std::size_t t = 0; t < 600; ++t)
    motion.rotation(0).set(
        t, axis_angle({0, 0, 1}, 0.4 * std::sin(2 * pi * hertz * static_cast<double>(t) / fps)));
  return motion;
}

double farthest(const Motion& a, const Motion& b, std::size_t from, std::size_t to) {
  const WorldMotion p = world_motion(a), q = world_motion(b);
  double worst = 0;
  for (int j = 0; j < a.joints(); ++j)
    for (std::size_t t = from; t < to; ++t)
      worst = std::max(worst, norm(p.position(j)[t] - q.position(j)[t]));
  return worst;
}

TEST(CartoonFilter, OnPositionsIsExaggerateForSlowMotion) {
  Alone work;
  for (double omega : {2.0, 5.0}) {
    ExaggerateParams wild;
    wild.omega = omega;
    wild.sigma = 0.1;
    wild.correct = false;
    LogFilterParams log;
    log.strength = (omega - 1) / 2;
    log.sigma = 0.1;
    log.on_positions = true;
    const Motion slow = pendulum(0.2);
    const Motion a = exaggerate(slow, wild, work).motion, b = log_filter(slow, log, work);
    const double changed = farthest(a, slow, 60, 540), apart = farthest(a, b, 60, 540);
    EXPECT_GT(changed, 0.005);
    EXPECT_LT(apart, 0.03 * changed);
    // At 2 Hz they are no longer the same.
    EXPECT_GT(
        farthest(exaggerate(pendulum(2), wild, work).motion, log_filter(pendulum(2), log, work), 60, 540),
        0.03);
  }
}

TEST(CartoonFilter, OnAnglesKeepsLinkLengthsAndAmplifiesAsTheFormulaSays) {
  Alone work;
  LogFilterParams log;
  log.strength = 2;
  log.sigma = 0.1;
  const Motion swing = pendulum(1), out = log_filter(swing, log, work);
  for (int j = 0; j < 3; ++j) EXPECT_FALSE(out.translates(j));
  // x ∗ g″ of a sine is −w² exp(−w² σ²/2) times it.
  const double w = 2 * pi;
  const double gain = 1 + 2 * 0.01 * w * w * std::exp(-0.5 * w * w * 0.01);
  double largest = 0;
  for (std::size_t t = 120; t < 480; ++t) largest = std::max(largest, turn(out.rotation(0)[t]));
  EXPECT_NEAR(largest, 0.4 * gain, 0.01);
}

TEST(CartoonFilter, LeavesUniformTurningAlone) {
  Alone work;
  Motion spin = pendulum(0);
  for (std::size_t t = 0; t < spin.frames(); ++t)
    spin.rotation(0).set(t, axis_angle({0, 0, 1}, 0.05 * static_cast<double>(t)));
  const auto q = spin.rotation(0);
  make_continuous(q.x, q.y, q.z, q.w);
  LogFilterParams log;
  EXPECT_LT(difference(log_filter(spin, log, work), spin).turn, 1e-7);
}

TEST(CartoonFilter, BandsWithGainOneComeBack) {
  Alone work;
  const Motion walk = gait("walk", 2);
  MultiresolutionParams params;
  params.gains = {1, 1, 1};
  const Difference same = difference(multiresolution_filter(walk, params, work), walk);
  EXPECT_LT(same.turn, 1e-9);
  EXPECT_LT(same.position, 1e-12);
  params.gains = {2, 2};
  EXPECT_GT(difference(multiresolution_filter(walk, params, work), walk).turn, 0.01);
}

TEST(CartoonFilterNode, RunsBothMethodsAndBlends) {
  const Motion walk = gait("walk", 2);
  const auto with = [&](const char* method, const char* on, double amount) {
    return NodeInMemory(cartoon_filter_node())
        .link("motion", walk)
        .set("method", method)
        .set("on", on)
        .set("amount", amount)
        .run()
        .out<Motion>("motion");
  };
  for (const char* method : {"log", "multiresolution"})
    for (const char* on : {"angles", "positions"}) {
      EXPECT_LT(difference(with(method, on, 0), walk).turn, 1e-12);
      EXPECT_GT(difference(with(method, on, 1), walk).turn, 0.01);
    }
}

}  // namespace
}  // namespace kinegraph
