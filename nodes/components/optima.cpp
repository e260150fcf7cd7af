#include "nodes/components/optima.h"

#include <algorithm>
#include <cmath>

#include "nodes/components/ica_kernels.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr std::size_t most_pairwise = 20;  // components; beyond, pairs are too many to try

// Rows i and j of w turned into each other.
void turn_rows(Rows& w, std::size_t i, std::size_t j, double angle) {
  const SinCos turn = sin_cos(angle);
  for (std::size_t c = 0; c < w.columns; ++c) {
    const double a = w(i, c), b = w(j, c);
    w(i, c) = turn.cos * a + turn.sin * b;
    w(j, c) = turn.cos * b - turn.sin * a;
  }
}

std::vector<double> negentropies(const Rows& u) {
  std::vector<double> out;
  for (std::size_t i = 0; i < u.rows; ++i) out.push_back(negentropy_of_row(u.row(i), u.columns));
  return out;
}

// The negentropy of two signals once they are turned into each other.
double turned_negentropy(const Rows& u, std::size_t i, std::size_t j, double angle) {
  Rows pair(2, u.columns);
  std::copy_n(u.row(i), u.columns, pair.row(0));
  std::copy_n(u.row(j), u.columns, pair.row(1));
  turn_rows(pair, 0, 1, angle);
  return negentropy(pair);
}

// The angle by which turning a and b into each other gives the largest negentropy, of seven and none, judged
// by E[√(1 + u²)].
double best_turn(const double* a, const double* b, std::size_t count) {
  constexpr double gaussian = 1.3545308064;  // E[√(1 + ν²)] of a standard normal ν
  double best = 0, most = 0;
  for (int step = 0; step < 8; ++step) {
    const double angle = step * pi / 16;
    const SinCos turn = sin_cos(angle);
    double sums[2];
    turned_roots(a, b, count, turn.cos, turn.sin, sums);
    const double first = sums[0] / static_cast<double>(count) - gaussian,
                 second = sums[1] / static_cast<double>(count) - gaussian;
    const double worth = first * first + second * second;
    if (step == 0 || worth > 1.02 * most) {
      most = worth;
      best = angle;
    }
  }
  return best;
}

// Some 500 of the frames.
Rows sample_of(const Rows& u) {
  const std::size_t stride = std::max<std::size_t>(1, u.columns / 500);
  Rows out(u.rows, (u.columns + stride - 1) / stride);
  for (std::size_t i = 0; i < u.rows; ++i)
    for (std::size_t t = 0; t < out.columns; ++t) out(i, t) = u(i, t * stride);
  return out;
}

}  // namespace

FastIcaRun leave_side_optimum(const Rows& z, FastIcaRun run, const FastIcaParams& params, Work& work) {
  const std::size_t k = run.w.rows;
  for (int round = 0; round < 4 && k <= most_pairwise; ++round) {
    const Rows u = rotated(run.w, z), sample = sample_of(u);
    const std::vector<double> worth = negentropies(u);
    Rows start = run.w;
    bool turned = false;
    std::vector<bool> taken(k, false);
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = i + 1; j < k && !taken[i]; ++j) {
        if (taken[j]) continue;
        work.check();
        const double angle = best_turn(sample.row(i), sample.row(j), sample.columns);
        if (angle == 0 || turned_negentropy(u, i, j, angle) <= worth[i] + worth[j]) continue;
        turn_rows(start, i, j, angle);
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

std::vector<FastIcaRun> runs_around(const Rows& z, const FastIcaRun& best, const FastIcaParams& params,
                                    Work& work) {
  constexpr std::size_t most = 6;
  const std::size_t k = best.w.rows;
  struct Pair {
    std::size_t i, j;
    double cost;
  };
  std::vector<Pair> pairs;
  if (k > most_pairwise) return {};
  const Rows u = rotated(best.w, z);
  const std::vector<double> worth = negentropies(u);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = i + 1; j < k; ++j) {
      work.check();
      pairs.push_back({i, j, worth[i] + worth[j] - turned_negentropy(u, i, j, pi / 4)});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
  pairs.resize(std::min(most, pairs.size()));
  std::vector<FastIcaRun> runs(pairs.size());
  work.parallel(pairs.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Rows start = best.w;
      turn_rows(start, pairs[n].i, pairs[n].j, pi / 4);
      runs[n] = fast_ica(z, start, params, work);
    }
  });
  return runs;
}

std::vector<bool> unique_components(const FastIcaRun& best, const std::vector<FastIcaRun>& others) {
  constexpr double nearly = 0.9, alike = 0.95;
  const std::size_t k = best.w.rows;
  std::vector<bool> unique(k, true);
  for (const FastIcaRun& other : others) {
    if (!other.converged || other.negentropy < nearly * best.negentropy) continue;
    // On whitened axes the correlation of two signals is the product of their rows.
    const Rows correlations = product(best.w, transposed(other.w));
    for (std::size_t i = 0; i < k; ++i) {
      double nearest = 0;
      for (std::size_t j = 0; j < k; ++j) nearest = std::max(nearest, std::fabs(correlations(i, j)));
      if (nearest < alike) unique[i] = false;
    }
  }
  return unique;
}

}  // namespace kinegraph
