#include "nodes/components/fast_ica.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/ica.h"
#include "nodes/components/principal.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr std::size_t frames = 600, channels = 6, sources = 4;

struct Oracle {
  Nonlinearity nonlinearity;
  bool symmetric;
  double amari;
  std::vector<double> unmixing;  // sources x channels
};
const std::vector<Oracle> scikit_learn = {
#include "tests/nodes/components/fast_ica_oracle.inc"
};

// Four independent sources of unit variance: flat, peaked, sparse, skewed. The same numbers as in
// fast_ica_oracle.py.
Rows independent_sources() {
  std::uint64_t state = 2024;
  const auto uniform = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  Rows s(sources, frames);
  for (std::size_t t = 0; t < frames; ++t) {
    double u[7];
    for (double& x : u) x = uniform();
    const double peaked = 2 * u[1] - 1;
    s(0, t) = 2 * u[0] - 1;
    s(1, t) = peaked * peaked * peaked * peaked * peaked;
    s(2, t) = u[3] < 0.2 ? 2 * u[2] - 1 : 0;
    s(3, t) = u[4] * u[5] * u[6];
  }
  for (std::size_t i = 0; i < sources; ++i) {
    double mean = 0, square = 0;
    for (std::size_t t = 0; t < frames; ++t) mean += s(i, t) / frames;
    for (std::size_t t = 0; t < frames; ++t) square += (s(i, t) - mean) * (s(i, t) - mean) / frames;
    for (std::size_t t = 0; t < frames; ++t) s(i, t) /= std::sqrt(square);
  }
  return s;
}
Rows mixing() {
  Rows a(channels, sources);
  for (int i = 0; i < static_cast<int>(channels); ++i)
    for (int j = 0; j < static_cast<int>(sources); ++j)
      a(i, j) = ((7 * i + 3 * j * j + i * j + 5) % 11 - 5) / 3.0;
  return a;
}
Rows mixed() {
  return product(mixing(), independent_sources());
}

double correlation(const double* a, const double* b, std::size_t n) {
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  for (std::size_t t = 0; t < n; ++t) {
    ma += a[t] / static_cast<double>(n);
    mb += b[t] / static_cast<double>(n);
  }
  for (std::size_t t = 0; t < n; ++t) {
    ab += (a[t] - ma) * (b[t] - mb);
    aa += (a[t] - ma) * (a[t] - ma);
    bb += (b[t] - mb) * (b[t] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

// 0 = each estimate is one source alone [Amari 1996], scaled to [0, 1].
double amari(const Rows& p) {
  double sum = 0;
  const std::size_t n = p.rows;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0, column = 0, row_max = 0, column_max = 0;
    for (std::size_t j = 0; j < n; ++j) {
      row += std::fabs(p(i, j));
      column += std::fabs(p(j, i));
      row_max = std::max(row_max, std::fabs(p(i, j)));
      column_max = std::max(column_max, std::fabs(p(j, i)));
    }
    sum += row / row_max - 1 + column / column_max - 1;
  }
  return sum / static_cast<double>(2 * n * (n - 1));
}

struct Found {
  Rows unmixing, u;
};
Found separated(const Oracle& oracle) {
  Alone work;
  const Rows x = mixed();
  const Whitened white = whiten(x, principal_components(x, work), sources, work);
  const FastIcaRun run =
      fast_ica(white.z, identity(sources), {oracle.nonlinearity, oracle.symmetric, 1e-8, 2000}, work);
  EXPECT_TRUE(run.converged);
  return {product(run.w, white.p_inverse), rotated(run.w, white.z)};
}

TEST(FastIca, FindsTheSignalsOfScikitLearn) {
  const Rows x = mixed();
  for (const Oracle& oracle : scikit_learn) {
    Rows w(sources, channels);
    w.data = oracle.unmixing;
    const Rows theirs = product(w, x);
    const Found ours = separated(oracle);
    for (std::size_t i = 0; i < sources; ++i) {
      double nearest = 0;
      for (std::size_t j = 0; j < sources; ++j)
        nearest = std::max(nearest, std::fabs(correlation(theirs.row(i), ours.u.row(j), frames)));
      EXPECT_GT(nearest, 0.999) << "signal " << i << ", nonlinearity "
                                << static_cast<int>(oracle.nonlinearity)
                                << (oracle.symmetric ? ", symmetric" : ", deflation");
    }
  }
}

// Amari's index in three significant digits.
TEST(FastIca, SeparatesMixedSourcesAsWellAsScikitLearn) {
  for (const Oracle& oracle : scikit_learn)
    EXPECT_NEAR(amari(product(separated(oracle).unmixing, mixing())) / oracle.amari, 1, 5e-4)
        << static_cast<int>(oracle.nonlinearity) << oracle.symmetric;
}

TEST(FastIca, WhitensToUnitVarianceWithoutCorrelation) {
  Alone work;
  const Rows x = mixed();
  const Whitened white = whiten(x, principal_components(x, work), sources, work);
  for (std::size_t i = 0; i < sources; ++i) {
    for (std::size_t j = 0; j < sources; ++j) {
      double sum = 0;
      for (std::size_t t = 0; t < frames; ++t) sum += white.z(i, t) * white.z(j, t);
      EXPECT_NEAR(sum / frames, i == j ? 1 : 0, 1e-12);
    }
  }
}

TEST(FastIca, KnowsTheRank) {
  Alone work;
  EXPECT_EQ(principal_components(mixed(), work).rank, sources);
}

TEST(FastIca, SaysWhenItDidNotConverge) {
  Alone work;
  IcaParams params;
  params.components = 4;
  params.fast_ica.iterations = 1;
  const Decomposition found = decompose(mixed(), params, work);
  EXPECT_FALSE(found.converged);
  ASSERT_FALSE(work.reported.empty());
  EXPECT_EQ(work.reported[0].code, "not-converged");
  EXPECT_NE(work.reported[0].message.find("1 iteration"), std::string::npos);
}

// scikit-learn 1.2 loses a whole component when the first channel is constant.
TEST(FastIca, IsNotHarmedByConstantChannels) {
  Alone work;
  const Rows x = mixed();
  for (std::size_t constant : {std::size_t{0}, std::size_t{3}, channels}) {
    Rows with(channels + 1, frames);
    for (std::size_t i = 0; i <= channels; ++i)
      for (std::size_t t = 0; t < frames; ++t)
        with(i, t) = i == constant ? 3.7 : x(i < constant ? i : i - 1, t);
    IcaParams params;
    params.components = 4;
    const Decomposition plain = decompose(x, params, work), other = decompose(with, params, work);
    for (std::size_t i = 0; i < sources; ++i) {
      EXPECT_GT(correlation(plain.signals.row(i), other.signals.row(i), frames), 0.999999) << constant;
      EXPECT_NEAR(other.mixing(constant, i), 0, 1e-14);
    }
    EXPECT_NEAR(other.mean[constant], 3.7, 1e-15);
  }
}

TEST(FastIca, ExplainsTheVarianceAskedFor) {
  Alone work;
  IcaParams params;
  params.variance = 1;
  EXPECT_EQ(decompose(mixed(), params, work).signals.rows, sources);
  params.variance = 0.01;
  EXPECT_EQ(decompose(mixed(), params, work).signals.rows, 1u);
}

TEST(FastIca, OrdersByVarianceAndFixesSigns) {
  Alone work;
  IcaParams params;
  params.components = 4;
  const Decomposition found = decompose(mixed(), params, work);
  for (std::size_t i = 0; i < sources; ++i) {
    EXPECT_GE(found.shares[i > 0 ? i - 1 : 0], found.shares[i]);
    double skewness = 0, largest = 0;
    for (std::size_t t = 0; t < frames; ++t)
      skewness += found.signals(i, t) * found.signals(i, t) * found.signals(i, t);
    skewness /= frames;
    for (std::size_t d = 0; d < channels; ++d)
      if (std::fabs(found.mixing(d, i)) > std::fabs(largest)) largest = found.mixing(d, i);
    EXPECT_TRUE(std::fabs(skewness) > 0.3 ? skewness > 0 : largest > 0) << "u" << i + 1;
  }
}

TEST(FastIca, GivesTheSameBitsForTheSameSeed) {
  Alone work;
  IcaParams params;
  params.components = 4;
  for (std::uint64_t seed : {0ull, 7ull}) {
    params.seed = seed;
    EXPECT_EQ(decompose(mixed(), params, work).signals.data, decompose(mixed(), params, work).signals.data);
  }
}

TEST(FastIca, StartsAreRotations) {
  for (std::uint64_t seed : {0ull, 5ull}) {
    for (int n = 0; n < 8; ++n) {
      const Rows w = starting_rotation(5, n, seed);
      const Rows gram = product(w, transposed(w));
      for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(gram(i, j), i == j ? 1 : 0, 1e-12);
    }
  }
  EXPECT_EQ(starting_rotation(3, 0, 0).data, identity(3).data);
}

}  // namespace
}  // namespace kinegraph
