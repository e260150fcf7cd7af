#include "nodes/time/lowpass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "nodes/motion/elementary.h"
#include "nodes/time/gaussian.h"
#include "tests/nodes/every_target.h"

namespace kinegraph {
namespace {

std::vector<double> wave(double frequency, double fps, std::size_t count, double phase = 0.3) {
  std::vector<double> x(count);
  for (std::size_t t = 0; t < count; ++t)
    x[t] = std::sin(2 * pi * frequency * static_cast<double>(t) / fps + phase);
  return x;
}
double largest_in_the_middle(const std::vector<double>& x, const std::vector<double>& y, double gain) {
  double largest = 0;
  for (std::size_t t = x.size() / 3; t < 2 * x.size() / 3; ++t)
    largest = std::max(largest, std::fabs(y[t] - gain * x[t]));
  return largest;
}

TEST(Lowpass, scales_a_wave_by_the_butterworth_gain_squared_and_doesnt_delay_it) {
  for (int order : {1, 2, 3, 4, 5, 8}) {
    for (double cutoff : {3.0, 6.0, 15.0, 40.0}) {
      for (double frequency : {1.0, 6.0, 12.0, 30.0}) {
        double ratio = std::tan(pi * frequency / 120) / std::tan(pi * cutoff / 120);
        double gain = 1 / (1 + std::pow(ratio, 2 * order));
        auto x = wave(frequency, 120, 3000);
        EXPECT_LT(largest_in_the_middle(x, lowpass(x, 120, cutoff, order), gain), 1e-9)
            << order << " " << cutoff;
      }
    }
  }
}

TEST(Lowpass, has_gain_one_half_at_the_cutoff) {
  auto x = wave(6, 120, 3000);
  EXPECT_LT(largest_in_the_middle(x, lowpass(x, 120, 6, 4), 0.5), 1e-9);
}

TEST(Lowpass, leaves_uniform_motion_alone_up_to_its_ends) {
  for (std::size_t count : {2, 3, 10, 500}) {
    std::vector<double> x;
    for (std::size_t t = 0; t < count; ++t) x.push_back(3 - 0.25 * static_cast<double>(t));
    for (int order : {1, 2, 5})
      for (double cutoff : {0.5, 6.0, 50.0}) {
        auto y = lowpass(x, 120, cutoff, order);
        for (std::size_t t = 0; t < count; ++t)
          EXPECT_NEAR(y[t], x[t], 1e-7) << count << " " << order << " " << cutoff;
      }
  }
}

TEST(Lowpass, is_linear_and_the_same_backwards) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> a(300), b(300), sum(300), turned(300);
  for (std::size_t t = 0; t < 300; ++t) {
    a[t] = normal(random);
    b[t] = normal(random);
    sum[t] = 2 * a[t] - b[t];
    turned[299 - t] = a[t];
  }
  auto fa = lowpass(a, 60, 5, 3), fb = lowpass(b, 60, 5, 3), fs = lowpass(sum, 60, 5, 3),
       ft = lowpass(turned, 60, 5, 3);
  for (std::size_t t = 0; t < 300; ++t) {
    EXPECT_NEAR(fs[t], 2 * fa[t] - fb[t], 1e-12);
    EXPECT_NEAR(ft[299 - t], fa[t], 1e-9);
  }
}

TEST(Lowpass, passes_everything_from_half_the_rate_on) {
  auto x = wave(50, 120, 100);
  EXPECT_EQ(lowpass(x, 120, 60, 2), x);
  EXPECT_TRUE(Lowpass(120, 61).passes_all());
  EXPECT_FALSE(Lowpass(120, 59).passes_all());
  EXPECT_EQ(lowpass(std::vector<double>{5}, 120, 6, 2), std::vector<double>{5});
  EXPECT_TRUE(lowpass(std::vector<double>{}, 120, 6, 2).empty());
}

TEST(Reflection, is_odd_about_either_end_however_far) {
  std::vector<double> x = {1, 4, 2, 7};
  for (std::ptrdiff_t k = -40; k < 40; ++k) {
    EXPECT_NEAR(reflected(x, -k), 2 * x[0] - reflected(x, k), 1e-12) << k;
    EXPECT_NEAR(reflected(x, 3 + k), 2 * x[3] - reflected(x, 3 - k), 1e-12) << k;
  }
  EXPECT_EQ(reflected(std::vector<double>{9}, -5), 9);
}

TEST(Gaussian, scales_a_wave_by_its_transform_and_leaves_uniform_motion_alone) {
  double sigma = gaussian_sigma(6) * 120;
  auto x = wave(6, 120, 1000), y = x;
  Gaussian(sigma, 1000).apply(y);
  EXPECT_LT(largest_in_the_middle(x, y, 0.5), 1e-6);
  for (std::size_t t = 0; t < 1000; ++t) x[t] = 0.5 * static_cast<double>(t) - 7;
  y = x;
  Gaussian(sigma, 1000).apply(y);
  for (std::size_t t = 0; t < 1000; ++t) EXPECT_NEAR(y[t], x[t], 1e-10);
}

TEST(Gaussian, gives_the_same_bits_on_every_instruction_set) {
  on_every_target([] {
    std::vector<double> series(203);
    for (std::size_t i = 0; i < series.size(); ++i) series[i] = std::sin(static_cast<double>(i * i));
    Gaussian(3.3, series.size()).apply(series);
    return series;
  });
}

TEST(Gaussian, is_cut_at_six_sigma_or_the_series_and_sums_to_one) {
  EXPECT_EQ(Gaussian(2.1, 100).weights().size(), 14u);
  EXPECT_EQ(Gaussian(50, 10).weights().size(), 10u);
  auto w = Gaussian(2.1, 100).weights();
  double sum = w[0];
  for (std::size_t k = 1; k < w.size(); ++k) sum += 2 * w[k];
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(w[3] / w[0], std::exp(-0.5 * 9 / 2.1 / 2.1), 1e-15);
}

}  // namespace
}  // namespace kinegraph
