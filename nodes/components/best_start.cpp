#include "nodes/components/best_start.h"

#include <algorithm>
#include <atomic>

#include "nodes/components/optima.h"

namespace kinegraph {
namespace {

// A run that did not converge counts 1 % less.
double worth(const FastIcaRun& run) {
  return run.negentropy * (run.converged ? 1 : 0.99);
}
const FastIcaRun& best_of(const std::vector<FastIcaRun>& runs) {  // the first, where several are the best
  return *std::max_element(runs.begin(), runs.end(),
                           [](const FastIcaRun& a, const FastIcaRun& b) { return worth(a) < worth(b); });
}

BestStart search(const Rows& z, const FastIcaParams& params, int starts, std::uint64_t seed, Work& work) {
  const auto count = static_cast<std::size_t>(std::max(starts, 1));
  std::vector<FastIcaRun> all(count);
  std::atomic<std::size_t> done = 0;
  work.parallel(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      all[n] = fast_ica(z, starting_rotation(z.rows, static_cast<int>(n), seed), params, work);
      work.progress(0.9 * static_cast<double>(++done) / static_cast<double>(count));
    }
  });
  BestStart best{leave_side_optimum(z, best_of(all), params, work), std::vector<bool>(z.rows, true)};
  if (count == 1) return best;
  // What lies around the best is looked at too; a better one found there is the best from then on.
  for (int round = 0; round < 3; ++round) {
    auto around = runs_around(z, best.run, params, work);
    if (around.empty()) break;
    all.insert(all.end(), around.begin(), around.end());
    const FastIcaRun other = best_of(around);
    if (worth(other) < 1.01 * worth(best.run)) break;
    best.run = leave_side_optimum(z, other, params, work);
  }
  best.unique = unique_components(best.run, all);
  return best;
}

// `count` frames, one out of each of as many stretches, in each at a different place, so that nothing that
// repeats is always met at the same phase. [Steele, Lea & Flood 2014, SplitMix64]
Rows thinned(const Rows& z, std::size_t count) {
  Rows out(z.rows, count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t begin = t * z.columns / count, end = (t + 1) * z.columns / count;
    std::uint64_t mixed = (t + 1) * 0x9E3779B97F4A7C15ull;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9ull;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBull;
    const std::size_t from = begin + (mixed ^ (mixed >> 31)) % (end - begin);
    for (std::size_t i = 0; i < z.rows; ++i) out(i, t) = z(i, from);
  }
  return out;
}

}  // namespace

BestStart best_of_starts(const Rows& z, const FastIcaParams& params, int starts, std::uint64_t seed,
                         Work& work) {
  // What has more frames than can be searched at leisure is given less time for going round in circles.
  const std::size_t few = std::max<std::size_t>(2048, 64 * z.rows);
  FastIcaParams sooner = params;
  if (4 * z.columns >= 5 * few) sooner.patience = params.patience / 2;
  if (z.columns < 2 * few) return search(z, sooner, starts, seed, work);
  BestStart best = search(thinned(z, few), sooner, starts, seed, work);
  FastIcaRun whole = leave_side_optimum(z, fast_ica(z, best.run.w, sooner, work), sooner, work);
  // Where all frames lead elsewhere, what was found was of some frames alone.
  best.run.negentropy = whole.negentropy;
  const std::vector<bool> again = unique_components(whole, {best.run});
  for (std::size_t i = 0; starts > 1 && i < again.size(); ++i) best.unique[i] = best.unique[i] && again[i];
  best.run = std::move(whole);
  return best;
}

}  // namespace kinegraph
