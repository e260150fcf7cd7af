#include "nodes/cartoon/skin_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {

// A strip of skin along a link of sub-links 1 m long: two rows of vertices, 0.1 m apart.
struct Strip {
  explicit Strip(int columns) {
    for (int row = 0; row < 2; ++row)
      for (int i = 0; i < columns; ++i) at.push_back({0.1 * i, 0.1 * row, 0});
    for (int i = 0; i + 1 < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>(columns + i);
      for (std::uint32_t v : {a, a + 1, b, b, a + 1, b + 1}) triangles.push_back(v);
    }
    tight.assign(at.size(), false);
  }
  // Those from one x to another have no room.
  void tighten(double from, double to) {
    for (std::size_t v = 0; v < at.size(); ++v)
      if (at[v].x > from - 1e-9 && at[v].x < to + 1e-9) tight[v] = true;
  }
  std::vector<double> settled() const {
    Alone work;
    const auto beside = mesh_neighbours(at, triangles);
    JointSkin skin{at, beside, 1, {}, tight};
    std::vector<double> places;
    for (std::size_t v = 0; v < at.size(); ++v) {
      skin.vertices.push_back(static_cast<int>(v));
      places.push_back(at[v].x);
    }
    settle_places(skin, places, work);
    return places;
  }
  std::vector<Vec3> at;
  std::vector<std::uint32_t> triangles;
  std::vector<bool> tight;
};

TEST(SkinPlaces, AreOnesOwnWhereAllHaveRoom) {
  const Strip strip(60);
  const std::vector<double> places = strip.settled();
  for (std::size_t v = 0; v < places.size(); ++v) EXPECT_EQ(places[v], strip.at[v].x);
}

TEST(SkinPlaces, AreOneForAPatchWithoutRoomAndGoOverToTheirOwnAround) {
  Strip strip(60);
  strip.tighten(2, 3.5);
  const std::vector<double> places = strip.settled();
  for (std::size_t v = 0; v < places.size(); ++v) {
    const double x = strip.at[v].x;
    if (strip.tight[v]) {
      EXPECT_EQ(places[v], 3) << x;
    } else if (x < 0.49 || x > 5.01) {
      EXPECT_EQ(places[v], x);
    }
    // No step from a vertex to the next one.
    const double before = v % 60 > 0 ? places[v - 1] : places[v];
    EXPECT_LT(std::fabs(places[v] - before), 0.31) << x;
  }
}

TEST(SkinPlaces, AreTheNearestWhereAPatchIsLong) {
  Strip strip(60);
  strip.tighten(1, 5);
  const std::vector<double> places = strip.settled();
  for (std::size_t v = 0; v < places.size(); ++v)
    EXPECT_EQ(places[v], strip.tight[v] ? std::floor(strip.at[v].x + 0.5) : places[v]);
}

// A seam of the texture has two vertices at each place.
TEST(SkinPlaces, GoAcrossSeams) {
  Strip whole(60), cut(60);
  for (int row = 0; row < 2; ++row) {
    const auto old = static_cast<std::uint32_t>(60 * row + 20);
    cut.at.push_back(cut.at[old]);
    const auto fresh = static_cast<std::uint32_t>(cut.at.size() - 1);
    for (std::size_t i = 0; i + 2 < cut.triangles.size(); i += 3) {
      const auto middle = [&](std::size_t k) { return whole.at[whole.triangles[i + k]].x; };
      if ((middle(0) + middle(1) + middle(2)) / 3 > 2.0)
        std::replace(cut.triangles.begin() + static_cast<std::ptrdiff_t>(i),
                     cut.triangles.begin() + static_cast<std::ptrdiff_t>(i + 3), old, fresh);
    }
  }
  cut.tight.assign(cut.at.size(), false);
  whole.tighten(1.1, 1.9);
  cut.tighten(1.1, 1.9);
  const std::vector<double> expected = whole.settled(), places = cut.settled();
  for (std::size_t v = 0; v < expected.size(); ++v) EXPECT_NEAR(places[v], expected[v], 1e-12) << v;
  EXPECT_NEAR(places[120], expected[20], 1e-12);
  EXPECT_GT(std::fabs(places[24] - cut.at[24].x), 0.01);
}

}  // namespace
}  // namespace kinegraph
