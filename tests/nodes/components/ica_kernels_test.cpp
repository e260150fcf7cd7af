// The loops over frames: right by plain sums, and with the same bits on every instruction set.
#include "nodes/components/ica_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "nodes/motion/elementary.h"
#include "tests/nodes/every_target.h"

namespace kinegraph {
namespace {

// 7 and 5 rows, neither a multiple of a block, of 403 frames, not one of the lanes.
constexpr std::size_t m = 7, n = 5, frames = 403, stride = 411;

std::vector<double> numbers(std::size_t count, double size, std::uint64_t state) {
  std::vector<double> out(count);
  for (double& x : out) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x = size * (static_cast<double>(state >> 11) * 0x1p-52 - 1);
  }
  return out;
}
const std::vector<double> a = numbers(m * stride, 2, 1), b = numbers(n * stride, 3, 2),
                          w = numbers(m * n, 1, 3);

std::vector<double> added_up(const std::vector<double>& sums) {
  std::vector<double> out(sums.size() / kernel_lanes);
  add_up_lanes(sums.data(), out.size(), out.data());
  return out;
}

TEST(IcaKernels, AreTriedOnSeveralInstructionSets) {
  EXPECT_GE(hwy::SupportedAndGeneratedTargets().size(), 2u);
}

TEST(IcaKernels, SumARow) {
  const auto sum = on_every_target([] { return std::vector{sum_of_row(a.data(), frames, 0.25)}; });
  double expected = 0;
  for (std::size_t t = 0; t < frames; ++t) expected += a[t] - 0.25;
  EXPECT_NEAR(sum[0], expected, 1e-12);
}

TEST(IcaKernels, SubtractFromARow) {
  const auto less = on_every_target([] {
    std::vector<double> out(frames);
    subtract_from_row(a.data(), frames, 0.25, out.data());
    return out;
  });
  for (std::size_t t = 0; t < frames; ++t) EXPECT_EQ(less[t], a[t] - 0.25);
}

TEST(IcaKernels, AddProductsOfRows) {
  const auto products = on_every_target([] {
    std::vector<double> sums(m * n * kernel_lanes);
    add_products(a.data(), stride, m, b.data(), stride, n, frames, false, sums.data());
    return added_up(sums);
  });
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double expected = 0;
      for (std::size_t t = 0; t < frames; ++t) expected += a[i * stride + t] * b[j * stride + t];
      EXPECT_NEAR(products[i * n + j], expected, 1e-11) << i << ", " << j;
    }
}

TEST(IcaKernels, AddTheLowerTriangleOfARowsOwnProducts) {
  const auto products = on_every_target([] {
    std::vector<double> sums(m * m * kernel_lanes);
    add_products(a.data(), stride, m, a.data(), stride, m, frames, true, sums.data());
    return added_up(sums);
  });
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double expected = 0;
      for (std::size_t t = 0; t < frames; ++t) expected += a[i * stride + t] * a[j * stride + t];
      EXPECT_NEAR(products[i * m + j], expected, 1e-11) << i << ", " << j;
    }
}

TEST(IcaKernels, CarrySumsFromPartToPart) {
  std::vector<double> whole(m * n * kernel_lanes), parts(m * n * kernel_lanes);
  add_products(a.data(), stride, m, b.data(), stride, n, frames, false, whole.data());
  for (std::size_t start = 0; start < frames; start += 48)
    add_products(a.data() + start, stride, m, b.data() + start, stride, n,
                 std::min<std::size_t>(48, frames - start), false, parts.data());
  EXPECT_EQ(whole, parts);
}

TEST(IcaKernels, MixRows) {
  const auto mixed = on_every_target([] {
    std::vector<double> out(m * frames);
    mix_rows(w.data(), m, n, b.data(), stride, frames, out.data(), frames);
    return out;
  });
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t t = 0; t < frames; ++t) {
      double expected = w[i * n] * b[t];
      for (std::size_t j = 1; j < n; ++j) expected += w[i * n + j] * b[j * stride + t];
      ASSERT_EQ(mixed[i * frames + t], expected) << "summed in the order of j";
    }
}

TEST(IcaKernels, AddMomentsOfEveryNonlinearity) {
  const auto g = [](int kind, double y) {
    return kind == 0 ? std::tanh(y) : kind == 1 ? y * y * y : y * std::exp(-y * y / 2);
  };
  const auto slope = [](int kind, double y) {
    return kind == 0   ? 1 - std::tanh(y) * std::tanh(y)
           : kind == 1 ? 3 * y * y
                       : (1 - y * y) * std::exp(-y * y / 2);
  };
  for (int kind : {0, 1, 2}) {
    const auto moments = on_every_target([&] {
      std::vector<double> scratch((m + n) * moment_slice), zg(m * n * kernel_lanes), slopes(m * kernel_lanes);
      add_moments(kind, w.data(), m, b.data(), stride, n, frames, scratch.data(), zg.data(), slopes.data());
      auto out = added_up(zg), last = added_up(slopes);
      out.insert(out.end(), last.begin(), last.end());
      return out;
    });
    for (std::size_t i = 0; i < m; ++i) {
      std::vector<double> zg(n);
      double slopes = 0;
      for (std::size_t t = 0; t < frames; ++t) {
        double y = 0;
        for (std::size_t j = 0; j < n; ++j) y += w[i * n + j] * b[j * stride + t];
        for (std::size_t j = 0; j < n; ++j) zg[j] += g(kind, y) * b[j * stride + t];
        slopes += slope(kind, y);
      }
      for (std::size_t j = 0; j < n; ++j)
        EXPECT_NEAR(moments[i * n + j], zg[j], 1e-12 * (1 + std::fabs(zg[j])))
            << kind << ": " << i << ", " << j;
      EXPECT_NEAR(moments[m * n + i], slopes, 1e-12 * (1 + std::fabs(slopes))) << kind << ": " << i;
    }
  }
}

// Small, great and very great numbers, more of them than one product of factors holds.
TEST(IcaKernels, SumLogCoshAsTheElementaryFunctionDoes) {
  std::vector<double> y;
  for (int i = -1100; i <= 1103; ++i) y.push_back(0.037 * i);
  y.push_back(800);
  y.push_back(-1e5);
  const auto single = on_every_target([&] {
    std::vector<double> out;
    for (double x : y) out.push_back(sum_of_log_cosh(&x, 1));
    return out;
  });
  double sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(single[i], log_cosh(y[i]), 1e-15 * std::max(1.0, log_cosh(y[i]))) << y[i];
    sum += log_cosh(y[i]);
  }
  const auto all = on_every_target([&] { return std::vector{sum_of_log_cosh(y.data(), y.size())}; });
  EXPECT_NEAR(all[0] / sum, 1, 1e-14);
  const std::vector<double> small(2000, 1e-3);  // where |y| and ln 2 all but cancel
  EXPECT_NEAR(sum_of_log_cosh(small.data(), small.size()) / (2000 * log_cosh(1e-3)), 1, 1e-9);
}

TEST(IcaKernels, SumRootsOfTurnedRows) {
  const double c = 0.8, s = 0.6;
  const auto sums = on_every_target([&] {
    std::vector<double> out(2);
    turned_roots(a.data(), b.data(), frames, c, s, out.data());
    return out;
  });
  double first = 0, second = 0;
  for (std::size_t t = 0; t < frames; ++t) {
    first += std::sqrt(1 + std::pow(c * a[t] + s * b[t], 2));
    second += std::sqrt(1 + std::pow(c * b[t] - s * a[t], 2));
  }
  EXPECT_NEAR(sums[0], first, 1e-10);
  EXPECT_NEAR(sums[1], second, 1e-10);
}

}  // namespace
}  // namespace kinegraph
