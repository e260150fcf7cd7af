#include "nodes/components/rows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kinegraph {
namespace {

double off_orthonormal(const Rows& w) {
  const Rows gram = product(w, transposed(w));
  double worst = 0;
  for (std::size_t i = 0; i < gram.rows; ++i)
    for (std::size_t j = 0; j < gram.columns; ++j) worst = std::max(worst, std::fabs(gram(i, j) - (i == j)));
  return worst;
}

Rows sample(double third) {
  Rows a(3, 3);
  a.data = {1, 2, 0.5, -0.3, 0.8, 1.1, 0, 0, 0};
  for (std::size_t c = 0; c < 3; ++c) a(2, c) = a(0, c) - 2 * a(1, c) + (c == 1 ? third : 0);
  return a;
}

TEST(NearestOrthonormal, IsOrthonormalHoweverDependentTheRowsAre) {
  for (double third : {1.0, 1e-3, 1e-6, 1e-9, 1e-15, 0.0})
    EXPECT_LT(off_orthonormal(nearest_orthonormal(sample(third))), 1e-10) << third;
  Rows nothing(3, 3);
  nothing(0, 1) = 2;
  EXPECT_LT(off_orthonormal(nearest_orthonormal(nothing)), 1e-12);
  EXPECT_EQ(std::fabs(nearest_orthonormal(nothing)(0, 1)), 1);
}

// The symmetric factor of A = S W is W: turned rows come back.
TEST(NearestOrthonormal, TakesAStretchOut) {
  const Rows w = nearest_orthonormal(sample(1));
  Rows stretch(3, 3);
  stretch.data = {2, 0.3, 0, 0.3, 1, 0.1, 0, 0.1, 0.5};
  const Rows again = nearest_orthonormal(product(stretch, w));
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(again.data[i], w.data[i], 1e-12);
}

}  // namespace
}  // namespace kinegraph
