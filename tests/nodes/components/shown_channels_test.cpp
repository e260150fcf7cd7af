#include "nodes/components/shown_channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/rebuild.h"
#include "tests/nodes/components/clips.h"

namespace kinegraph {
namespace {

Rows by_way_of_a_motion(const ChannelSpace& space, const Rows& channels, const Motion& base) {
  Alone work;
  std::vector<double> first;
  for (std::size_t d = 0; d < channels.rows; ++d) first.push_back(channels(d, 0));
  return channels_of(space, motion_from_channels(space, channels, base, {}, work), first, work);
}

double farthest(const Rows& a, const Rows& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) most = std::max(most, std::fabs(a.data[i] - b.data[i]));
  return most;
}

// However far a component is turned: past half turns, over singular angles, and in steps that leave open
// which of two solutions goes on.
TEST(ShownChannels, AreThoseOfTheMotionThatIsShown) {
  KINEGRAPH_NEEDS_MOCAP();
  const auto boxing = real_clip("cmu/asfamc/17_10.amc");
  for (Representation representation : {Representation::points, Representation::quaternions,
                                        Representation::euler, Representation::logarithm}) {
    Alone work;
    const Components c = analysed({boxing}, representation, 4, work);
    for (double factor : {1.0, -3.0, 40.0}) {
      Rows u = signals_of(c, c.segments[0]);
      for (double& value : u.data) value *= factor;
      const Rows channels = channels_from_signals(c, u, {1});
      const Rows shown = channels_as_shown(c.space, channels, *boxing, work);
      EXPECT_LT(farthest(shown, by_way_of_a_motion(c.space, channels, *boxing)), 1e-9)
          << name_of(representation) << " " << factor;
    }
  }
}

TEST(ShownChannels, DifferWhereAVectorTurnsByMoreThanHalfATurn) {
  Alone work;
  const auto walk = shared(gait("walk", 1));
  const Components c = analysed({walk}, Representation::logarithm, 2, work);
  Rows channels = channels_from_signals(c, signals_of(c, c.segments[0]));
  const std::size_t row = 3 * 5;
  channels(row, 7) = 4;
  channels(row + 1, 7) = channels(row + 2, 7) = 0;
  const Rows shown = channels_as_shown(c.space, channels, *walk, work);
  EXPECT_NEAR(shown(row, 7), 4 - 2 * 3.14159265358979, 1e-9);
  EXPECT_NEAR(shown(row, 8), channels(row, 8), 1e-9);
}

}  // namespace
}  // namespace kinegraph
