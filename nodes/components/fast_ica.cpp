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

// E[z g(w'z)] (rows of the fixed-point update) and E[g'] for the rows of w.
struct Moments {
  Rows zg;
  std::vector<double> slope;
};
Moments moments(const Rows& w, const Rows& z, Nonlinearity nonlinearity, Rows& y, Work& work) {
  const std::size_t m = w.rows, k = z.rows, columns = z.columns;
  if (y.rows != m || y.columns != columns) y = Rows(m, columns);
  Moments out{Rows(m, k), std::vector<double>(m)};
  double beta = 0;
  mix_rows(w.data.data(), m, k, z.data.data(), columns, y.data.data());
  work.check();
  for (std::size_t i = 0; i < m; ++i)
    nonlinearity_of_row(kind_of(nonlinearity), y.row(i), columns, &out.slope[i], &beta);
  work.check();
  products_of_rows(y.data.data(), m, z.data.data(), k, columns, false, out.zg.data.data());
  const double scale = 1.0 / static_cast<double>(columns);
  for (double& x : out.zg.data) x *= scale;
  for (double& x : out.slope) x *= scale;
  return out;
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

// w⁺ = E[z g(w'z)] - E[g'(w'z)] w, each row's sign so that it points as w does.
Rows stepped(const Rows& w, const Moments& m) {
  Rows next = w;
  for (std::size_t i = 0; i < w.rows; ++i)
    for (std::size_t j = 0; j < w.columns; ++j) next(i, j) = m.zg(i, j) - m.slope[i] * w(i, j);
  return next;
}
void point_alike(Rows& next, const Rows& w) {
  for (std::size_t i = 0; i < w.rows; ++i)
    if (dot(next.row(i), w.row(i), w.columns) < 0)
      for (std::size_t j = 0; j < w.columns; ++j) next(i, j) = -next(i, j);
}
Rows between(const Rows& w, const Rows& next, double mu) {
  Rows out = w;
  for (std::size_t i = 0; i < w.data.size(); ++i) out.data[i] += mu * (next.data[i] - w.data[i]);
  return out;
}

// How far along the fixed-point step a run goes. It is halved when the steps have not become smaller for a
// while: the run goes round and round then (stabilised FastICA).
class Step {
 public:
  double size() const { return size_; }
  // `change`: that of the whole step, whatever part of it was gone.
  void after(double change) {
    if (change < 0.8 * least_) {
      least_ = change;
      waited_ = 0;
    } else if (++waited_ >= patience && size_ > 1.0 / 64) {
      size_ /= 2;
      waited_ = 0;
      least_ = change;
    }
  }

 private:
  static constexpr int patience = 8;
  double size_ = 1, least_ = 1;
  int waited_ = 0;
};

FastIcaRun symmetric_run(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work) {
  FastIcaRun run;
  Rows y;
  Rows w = nearest_orthonormal(start);
  Step step;
  for (int iteration = 1; iteration <= params.iterations && !run.converged; ++iteration) {
    Rows next = nearest_orthonormal(stepped(w, moments(w, z, params.nonlinearity, y, work)));
    point_alike(next, w);
    run.iterations = iteration;
    run.reached = change(next, w);
    run.converged = run.reached < params.tolerance;
    if (!run.converged && step.size() < 1) next = nearest_orthonormal(between(w, next, step.size()));
    step.after(run.reached);
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
    Step step;
    double reached = 1;
    for (int iteration = 1; iteration <= params.iterations && reached >= params.tolerance; ++iteration) {
      Rows next = stepped(w, moments(w, z, params.nonlinearity, y, work));
      make_new(next, found, i);
      point_alike(next, w);
      reached = change(next, w);
      if (reached >= params.tolerance && step.size() < 1) {
        next = between(w, next, step.size());
        make_new(next, found, i);
      }
      step.after(reached);
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
  out.centred = centred(channels, out.mean, work);
  const Rows& x = out.centred;
  out.axes = identity(d);
  out.variance.resize(d);
  // A covariance knows its small variances only to 1e-16 of the largest. So the axes under 1e-8 of the first
  // are decomposed once more, in the space of these axes alone, where they are the large ones; and so on.
  for (std::size_t first = 0; first < d;) {
    const std::size_t m = d - first;
    Rows axes(m, d);
    std::copy_n(out.axes.row(first), m * d, axes.data.data());
    Rows projected, covariance(m, m);
    if (first > 0) {
      projected = Rows(m, columns);
      mix_rows(axes.data.data(), m, d, x.data.data(), columns, projected.data.data());
      work.check();
    }
    const double* rows = first > 0 ? projected.data.data() : x.data.data();
    products_of_rows(rows, m, rows, m, columns, true, covariance.data.data());
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

Whitened whiten(const Principal& principal, std::size_t k, Work& work) {
  const Rows& x = principal.centred;
  const std::size_t d = x.rows, columns = x.columns;
  Whitened out{Rows(k, columns), Rows(d, k), Rows(k, d)};
  for (std::size_t i = 0; i < k; ++i) {
    const double sigma = std::sqrt(principal.variance[i]);
    for (std::size_t j = 0; j < d; ++j) {
      out.p(j, i) = principal.axes(i, j) * sigma;
      out.p_inverse(i, j) = principal.axes(i, j) / sigma;
    }
  }
  mix_rows(out.p_inverse.data.data(), k, d, x.data.data(), columns, out.z.data.data());
  work.check();
  return out;
}

FastIcaRun fast_ica(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work) {
  FastIcaRun run =
      params.symmetric ? symmetric_run(z, start, params, work) : deflation_run(z, start, params, work);
  run.negentropy = negentropy(rotated(run.w, z));
  return run;
}

namespace {

constexpr double gaussian_log_cosh = 0.3745672;  // E[log cosh ν] of a standard normal ν

// The angle by which turning a and b into each other gives the largest negentropy, of seven and none; by
// every `stride`-th sample.
double best_turn(const double* a, const double* b, std::size_t count, std::size_t stride) {
  constexpr double gaussian = 1.3545308064;  // E[√(1 + ν²)] of a standard normal ν
  double best = 0, most = 0;
  for (int step = 0; step < 8; ++step) {
    const double angle = step * pi / 16;
    const SinCos turn = sin_cos(angle);
    double first = 0, second = 0;
    std::size_t n = 0;
    for (std::size_t t = 0; t < count; t += stride, ++n) {
      const double x = turn.cos * a[t] + turn.sin * b[t], y = turn.cos * b[t] - turn.sin * a[t];
      first += std::sqrt(1 + x * x);
      second += std::sqrt(1 + y * y);
    }
    first = first / static_cast<double>(n) - gaussian;
    second = second / static_cast<double>(n) - gaussian;
    const double worth = first * first + second * second;
    if (step == 0 || worth > 1.02 * most) {
      most = worth;
      best = angle;
    }
  }
  return best;
}

}  // namespace

constexpr std::size_t most_pairwise = 20;  // components; beyond, pairs are too many to try

FastIcaRun leave_side_optimum(const Rows& z, FastIcaRun run, const FastIcaParams& params, Work& work) {
  const std::size_t k = run.w.rows, stride = std::max<std::size_t>(1, z.columns / 500);
  for (int round = 0; round < 4 && k <= most_pairwise; ++round) {
    const Rows u = rotated(run.w, z);
    Rows start = run.w;
    bool turned = false;
    std::vector<bool> taken(k, false);
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = i + 1; j < k && !taken[i]; ++j) {
        if (taken[j]) continue;
        work.check();
        const double angle = best_turn(u.row(i), u.row(j), z.columns, stride);
        if (angle == 0) continue;
        const SinCos turn = sin_cos(angle);
        for (std::size_t c = 0; c < k; ++c) {
          start(i, c) = turn.cos * run.w(i, c) + turn.sin * run.w(j, c);
          start(j, c) = turn.cos * run.w(j, c) - turn.sin * run.w(i, c);
        }
        taken[i] = taken[j] = turned = true;
      }
    }
    if (!turned) break;
    FastIcaRun other = fast_ica(z, start, params, work);
    if (other.negentropy <= run.negentropy || (run.converged && !other.converged)) break;
    run = std::move(other);
  }
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
  double sum = 0;
  for (std::size_t i = 0; i < u.rows; ++i) {
    const double mean = sum_of_log_cosh(u.row(i), u.columns) / static_cast<double>(u.columns);
    sum += (mean - gaussian_log_cosh) * (mean - gaussian_log_cosh);
  }
  return sum;
}

}  // namespace kinegraph
