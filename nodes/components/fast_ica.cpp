#include "nodes/components/fast_ica.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/ica_kernels.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

// E[z g(w'z)] (rows of the fixed-point update) and E[g'] for the rows of w.
struct Moments {
  Rows zg;
  std::vector<double> slope;
};
Moments moments(const Rows& w, const Rows& z, Nonlinearity nonlinearity, Work& work) {
  const std::size_t m = w.rows, k = z.rows, columns = z.columns;
  const auto scratch = hwy::AllocateAligned<double>((m + k) * moment_slice);
  std::vector<double> zg(m * k * kernel_lanes), slope(m * kernel_lanes);
  // Parts of some milliseconds, after each of which the work may be stopped.
  const std::size_t part = std::max<std::size_t>(1, 2'000'000 / (m * (k + 16)) / moment_slice) * moment_slice;
  for (std::size_t start = 0; start < columns; start += part) {
    add_moments(static_cast<int>(nonlinearity), w.data.data(), m, z.data.data() + start, columns, k,
                std::min(part, columns - start), scratch.get(), zg.data(), slope.data());
    work.check();
  }
  Moments out{Rows(m, k), std::vector<double>(m)};
  add_up_lanes(zg.data(), m * k, out.zg.data.data());
  add_up_lanes(slope.data(), m, out.slope.data());
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
  explicit Step(int patience) : patience_(patience) {}
  double size() const { return size_; }
  // `change`: that of the whole step, whatever part of it was gone.
  void after(double change) {
    if (change < 0.8 * least_) {
      least_ = change;
      waited_ = 0;
    } else if (++waited_ >= patience_ && size_ > 1.0 / 64) {
      size_ /= 2;
      waited_ = 0;
      least_ = change;
    }
  }

 private:
  double size_ = 1, least_ = 1;
  int patience_, waited_ = 0;
};

FastIcaRun symmetric_run(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work) {
  FastIcaRun run;
  Rows w = nearest_orthonormal(start);
  Step step(params.patience);
  for (int iteration = 1; iteration <= params.iterations && !run.converged; ++iteration) {
    Rows next = nearest_orthonormal(stepped(w, moments(w, z, params.nonlinearity, work)));
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

// Takes out of w the rows found so far [Gram-Schmidt].
void take_out(Rows& w, const Rows& found, std::size_t count) {
  std::vector<double> shares(count);
  for (std::size_t i = 0; i < count; ++i) shares[i] = dot(w.row(0), found.row(i), w.columns);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < w.columns; ++j) w(0, j) -= shares[i] * found(i, j);
}
double length_of(const Rows& w) {
  return std::sqrt(dot(w.row(0), w.row(0), w.columns));
}
// And makes it a unit vector.
void make_new(Rows& w, const Rows& found, std::size_t count) {
  const double before = length_of(w);
  take_out(w, found, count);
  if (!(length_of(w) > 1e-12 * before)) {  // nothing of it is new: the axis that is least among those found
    std::size_t least = 0;
    std::vector<double> squares(w.columns);
    for (std::size_t j = 0; j < w.columns; ++j)
      for (std::size_t i = 0; i < count; ++i) squares[j] += found(i, j) * found(i, j);
    for (std::size_t j = 1; j < w.columns; ++j)
      if (squares[j] < squares[least]) least = j;
    for (std::size_t j = 0; j < w.columns; ++j) w(0, j) = j == least;
    take_out(w, found, count);
  }
  // What is little keeps some of what was taken out, by rounding.
  if (length_of(w) < 1e-3 * before) take_out(w, found, count);
  const double length = length_of(w);
  for (double& x : w.data) x /= length;
}

FastIcaRun deflation_run(const Rows& z, const Rows& start, const FastIcaParams& params, Work& work) {
  FastIcaRun run;
  run.converged = true;
  Rows found(start.rows, start.columns);
  for (std::size_t i = 0; i < start.rows; ++i) {
    Rows w(1, start.columns);
    std::copy_n(start.row(i), start.columns, w.row(0));
    make_new(w, found, 0);
    Step step(params.patience);
    double reached = 1;
    for (int iteration = 1; iteration <= params.iterations && reached >= params.tolerance; ++iteration) {
      Rows next = stepped(w, moments(w, z, params.nonlinearity, work));
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
  mix_rows(w.data.data(), w.rows, z.rows, z.data.data(), z.columns, z.columns, u.data.data(), u.columns);
  return u;
}

double negentropy_of_row(const double* u, std::size_t count) {
  constexpr double gaussian = 0.3745672;  // E[log cosh ν] of a standard normal ν
  const double less = sum_of_log_cosh(u, count) / static_cast<double>(count) - gaussian;
  return less * less;
}

double negentropy(const Rows& u) {
  double sum = 0;
  for (std::size_t i = 0; i < u.rows; ++i) sum += negentropy_of_row(u.row(i), u.columns);
  return sum;
}

}  // namespace kinegraph
