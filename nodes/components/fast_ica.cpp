#include "nodes/components/fast_ica.h"

#include <algorithm>
#include <cmath>

#include "nodes/components/ica_kernels.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

int kind_of(Nonlinearity nonlinearity) {
  return static_cast<int>(nonlinearity);
}

// E[z g(w'z)] (rows of the fixed-point update), E[g'] and β = E[w'z g(w'z)] for the rows of w.
struct Moments {
  Rows zg;
  std::vector<double> slope, beta;
};
Moments moments(const Rows& w, const Rows& z, Nonlinearity nonlinearity, Rows& y, Work& work) {
  const std::size_t m = w.rows, k = z.rows, columns = z.columns;
  if (y.rows != m || y.columns != columns) y = Rows(m, columns);
  Moments out{Rows(m, k), std::vector<double>(m), std::vector<double>(m)};
  mix_rows(w.data.data(), m, k, z.data.data(), columns, y.data.data());
  work.check();
  for (std::size_t i = 0; i < m; ++i)
    nonlinearity_of_row(kind_of(nonlinearity), y.row(i), columns, &out.slope[i], &out.beta[i]);
  work.check();
  products_of_rows(y.data.data(), m, z.data.data(), k, columns, false, out.zg.data.data());
  const double scale = 1.0 / static_cast<double>(columns);
  for (double& x : out.zg.data) x *= scale;
  for (double& x : out.slope) x *= scale;
  for (double& x : out.beta) x *= scale;
  return out;
}

// w⁺ = E[z g(w'z)] - E[g'(w'z)] w; with a step μ < 1 the stabilised form
// w⁺ = w - μ (E[z g] - β w) / (E[g'] - β), which is the same direction at μ = 1.
Rows stepped(const Rows& w, const Moments& m, double mu) {
  Rows next = w;
  for (std::size_t i = 0; i < w.rows; ++i)
    for (std::size_t j = 0; j < w.columns; ++j)
      next(i, j) = mu == 1 ? m.zg(i, j) - m.slope[i] * w(i, j)
                           : w(i, j) - mu / (m.slope[i] - m.beta[i]) * (m.zg(i, j) - m.beta[i] * w(i, j));
  return next;
}

double dot(const double* a, const double* b, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

double change(const Rows& a, const Rows& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rows; ++i)
    largest = std::max(largest, std::fabs(std::fabs(dot(a.row(i), b.row(i), a.columns)) - 1));
  return largest;
}

constexpr double smallest_step = 1.0 / 64;

FastIcaRun symmetric_run(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work) {
  FastIcaRun run;
  Rows y;
  Rows w = nearest_orthonormal(start), before = w;
  double mu = 1;
  for (int iteration = 1; iteration <= params.iterations && !run.converged; ++iteration) {
    Rows next = nearest_orthonormal(stepped(w, moments(w, z, params.nonlinearity, y, work), mu));
    run.iterations = iteration;
    run.reached = change(next, w);
    run.converged = run.reached < params.tolerance;
    // Back where it was two steps ago, but not one: it oscillates.
    if (!run.converged && iteration > 2 && change(next, before) < params.tolerance && mu > smallest_step)
      mu /= 2;
    before = std::move(w);
    w = std::move(next);
  }
  run.w = std::move(w);
  return run;
}

// Takes out of w the rows found so far and makes it a unit vector [Gram-Schmidt].
void make_new(Rows& w, const Rows& found, std::size_t count) {
  std::vector<double> shares(count);
  for (std::size_t i = 0; i < count; ++i) shares[i] = dot(w.row(0), found.row(i), w.columns);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < w.columns; ++j) w(0, j) -= shares[i] * found(i, j);
  const double length = std::sqrt(dot(w.row(0), w.row(0), w.columns));
  for (double& x : w.data) x /= length;
}

FastIcaRun deflation_run(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work) {
  FastIcaRun run;
  run.converged = true;
  Rows y, found(start.rows, start.columns);
  for (std::size_t i = 0; i < start.rows; ++i) {
    Rows w(1, start.columns);
    std::copy_n(start.row(i), start.columns, w.row(0));
    make_new(w, found, 0);
    Rows before = w;
    double mu = 1, reached = 1;
    for (int iteration = 1; iteration <= params.iterations && reached >= params.tolerance; ++iteration) {
      Rows next = stepped(w, moments(w, z, params.nonlinearity, y, work), mu);
      make_new(next, found, i);
      reached = change(next, w);
      if (reached >= params.tolerance && iteration > 2 && change(next, before) < params.tolerance &&
          mu > smallest_step)
        mu /= 2;
      before = std::move(w);
      w = std::move(next);
      run.iterations = std::max(run.iterations, iteration);
    }
    run.converged = run.converged && reached < params.tolerance;
    run.reached = std::max(run.reached, reached);
    std::copy_n(w.row(0), w.columns, found.row(i));
  }
  run.w = std::move(found);
  return run;
}

// Standard normal numbers from two uniform ones in (0, 1) [Box & Muller 1958].
double normal(double a, double b) {
  return std::sqrt(-2 * logarithm(a)) * cosine(2 * pi * b);
}

// A 64-bit counter turned into a well-mixed one [Steele, Lea & Flood 2014, SplitMix64].
double uniform(std::uint64_t counter) {
  std::uint64_t x = counter * 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  x ^= x >> 31;
  return (static_cast<double>(x >> 11) + 0.5) * 0x1p-53;
}

// The n-th point's d-th coordinate of a Kronecker sequence: multiples of square roots of primes, modulo 1.
double quasi_uniform(std::uint64_t n, std::size_t d) {
  std::uint64_t prime = 2;
  for (std::size_t found = 0;; ++prime) {
    bool is_prime = true;
    for (std::uint64_t q = 2; q * q <= prime && is_prime; ++q) is_prime = prime % q != 0;
    if (is_prime && found++ == d) break;
  }
  const double x = static_cast<double>(n) * std::sqrt(static_cast<double>(prime));
  return std::clamp(x - std::floor(x), 1e-12, 1 - 1e-12);
}

}  // namespace

namespace {

Rows centred(const Rows& channels, const std::vector<double>& mean, Work& work) {
  Rows out(channels.rows, channels.columns);
  for (std::size_t i = 0; i < channels.rows; ++i) {
    for (std::size_t t = 0; t < channels.columns; ++t) out(i, t) = channels(i, t) - mean[i];
    work.check();
  }
  return out;
}

}  // namespace

Principal principal_components(const Rows& channels, Work& work) {
  const std::size_t d = channels.rows, columns = channels.columns;
  Principal out;
  out.mean.resize(d);
  for (std::size_t i = 0; i < d; ++i) {
    double sum = 0, rest = 0;
    for (std::size_t t = 0; t < columns; ++t) sum += channels(i, t);
    const double mean = sum / static_cast<double>(columns);
    for (std::size_t t = 0; t < columns; ++t)
      rest += channels(i, t) - mean;  // the rounding of the first pass
    out.mean[i] = mean + rest / static_cast<double>(columns);
  }
  const Rows x = centred(channels, out.mean, work);
  out.axes = identity(d);
  out.variance.resize(d);
  // A covariance knows its small variances only to 1e-16 of the largest. So the axes under 1e-8 of the first
  // are decomposed once more, in the space of these axes alone, where they are the large ones; and so on.
  for (std::size_t first = 0; first < d;) {
    const std::size_t m = d - first;
    Rows axes(m, d);
    std::copy_n(out.axes.row(first), m * d, axes.data.data());
    Rows projected(m, columns), covariance(m, m);
    if (first == 0)
      projected.data = x.data;
    else
      mix_rows(axes.data.data(), m, d, x.data.data(), columns, projected.data.data());
    work.check();
    products_of_rows(projected.data.data(), m, projected.data.data(), m, columns, true,
                     covariance.data.data());
    work.check();
    const Eigenpairs pairs = symmetric_eigen(covariance);
    const Rows turned = product(pairs.vectors, axes);
    std::copy_n(turned.data.data(), m * d, out.axes.row(first));
    for (std::size_t i = 0; i < m; ++i)
      out.variance[first + i] = std::max(0.0, pairs.values[i]) / static_cast<double>(columns);
    std::size_t next = first + 1;
    while (next < d && out.variance[next] > 1e-8 * out.variance[first]) ++next;
    if (next < d && out.variance[next] <= 1e-22 * out.variance[0]) break;  // the rest is rounding
    first = next;
  }
  while (out.rank < d && out.variance[out.rank] > 1e-20 * out.variance[0]) ++out.rank;
  return out;
}

Whitened whiten(const Rows& channels, const Principal& principal, std::size_t k, Work& work) {
  const std::size_t d = channels.rows, columns = channels.columns;
  Whitened out{Rows(k, columns), Rows(d, k), Rows(k, d)};
  for (std::size_t i = 0; i < k; ++i) {
    const double sigma = std::sqrt(principal.variance[i]);
    for (std::size_t j = 0; j < d; ++j) {
      out.p(j, i) = principal.axes(i, j) * sigma;
      out.p_inverse(i, j) = principal.axes(i, j) / sigma;
    }
  }
  const Rows x = centred(channels, principal.mean, work);
  mix_rows(out.p_inverse.data.data(), k, d, x.data.data(), columns, out.z.data.data());
  return out;
}

FastIcaRun fast_ica(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work) {
  FastIcaRun run =
      params.symmetric ? symmetric_run(z, start, params, work) : deflation_run(z, start, params, work);
  run.negentropy = negentropy(rotated(run.w, z));
  return run;
}

Rows starting_rotation(std::size_t k, int n, std::uint64_t seed) {
  if (seed == 0 && n == 0) return identity(k);
  Rows w(k, k);
  const auto index = static_cast<std::uint64_t>(n);
  for (std::size_t i = 0; i < k * k; ++i) {
    const double a =
        seed ? uniform((seed * 1000003 + index) * 65536 + 2 * i + 1) : quasi_uniform(index, 2 * i);
    const double b =
        seed ? uniform((seed * 1000003 + index) * 65536 + 2 * i + 2) : quasi_uniform(index, 2 * i + 1);
    w.data[i] = normal(a, b);
  }
  return nearest_orthonormal(w);
}

Rows rotated(const Rows& w, const Rows& z) {
  Rows u(w.rows, z.columns);
  mix_rows(w.data.data(), w.rows, z.rows, z.data.data(), z.columns, u.data.data());
  return u;
}

double negentropy(const Rows& u) {
  constexpr double gaussian = 0.3745672;  // E[log cosh ν] of a standard normal ν
  double sum = 0;
  for (std::size_t i = 0; i < u.rows; ++i) {
    double mean = 0;
    for (std::size_t t = 0; t < u.columns; ++t) mean += log_cosh(u(i, t));
    mean /= static_cast<double>(u.columns);
    sum += (mean - gaussian) * (mean - gaussian);
  }
  return sum;
}

}  // namespace kinegraph
