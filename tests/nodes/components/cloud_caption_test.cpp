#include "nodes/components/cloud_caption.h"

#include <gtest/gtest.h>

#include <functional>

#include "nodes/components/component_meaning.h"

namespace kinegraph {
namespace {

// A box of 5 x 4 x 5 particles, and one component that moves each as it is told.
Components box(const std::function<Vec3(Vec3)>& move) {
  Components out;
  out.space.of_motions = false;
  std::vector<Vec3> moves;
  for (int x = -2; x <= 2; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = -2; z <= 2; ++z) {
        const Vec3 place{double(x), double(y), double(z)};
        out.space.labels.push_back("p" + std::to_string(moves.size()));
        for (int axis = 0; axis < 3; ++axis) out.mean.push_back(place[axis]);
        moves.push_back(move(place));
      }
  out.mixing = Rows(3 * moves.size(), 1);
  for (std::size_t i = 0; i < moves.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      out.mixing(3 * i + static_cast<std::size_t>(axis), 0) = moves[i][axis];
  out.signals = Rows(1, 2);
  out.signals.data = {-1, 1};
  out.shares = {1};
  out.unique = {true};
  return out;
}

TEST(CloudCaption, TellsWhichPointsMoveWhereAndWhichWay) {
  EXPECT_EQ(what_moves(box([](Vec3) { return Vec3{0, 1, 0}; }), 0), "80 % of the points, mostly up and down");
  EXPECT_EQ(what_moves(box([](Vec3 at) {
                         return at.y > 2 ? Vec3{0, 1, 0} : Vec3{};
                       }),
                       0),
            "20 % of the points, the upper ones, mostly up and down");
  EXPECT_EQ(what_moves(box([](Vec3 at) {
                         return at.y < 1 ? Vec3{at.x, 0, at.z} : Vec3{};
                       }),
                       0),
            "14 % of the points, the lower outer ones, mostly in and out");
  EXPECT_EQ(what_moves(box([](Vec3 at) {
                         return Vec3{at.z, 0, -at.x};
                       }),
                       0),
            "56 % of the points, the outer ones, mostly round the middle");
  EXPECT_EQ(what_moves(box([](Vec3) { return Vec3{}; }), 0), "");
}

TEST(CloudCaption, IsForMoreNamesThanAnyoneReads) {
  Components few = box([](Vec3) { return Vec3{0, 1, 0}; });
  EXPECT_TRUE(is_cloud(few));
  few.space.labels.resize(64);
  few.mean.resize(3 * 64);
  few.mixing.rows = 3 * 64;
  few.mixing.data.resize(3 * 64);
  EXPECT_FALSE(is_cloud(few));
  EXPECT_EQ(what_moves(few, 0), "p0, p1, p2");
}

}  // namespace
}  // namespace kinegraph
