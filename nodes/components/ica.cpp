#include "nodes/components/ica.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nodes/components/optima.h"
#include "nodes/components/principal.h"

namespace kinegraph {
namespace {

double skewness(const double* u, std::size_t n) {
  double second = 0, third = 0;
  for (std::size_t t = 0; t < n; ++t) {
    second += u[t] * u[t];
    third += u[t] * u[t] * u[t];
  }
  second /= static_cast<double>(n);
  third /= static_cast<double>(n);
  return second > 0 ? third / (second * std::sqrt(second)) : 0;
}

std::size_t count_for(const Principal& principal, double variance) {
  const double whole = std::accumulate(principal.variance.begin(), principal.variance.end(), 0.0);
  double sum = 0;
  std::size_t k = 0;
  while (k < principal.rank && sum < variance * whole) sum += principal.variance[k++];
  return std::max<std::size_t>(k, 1);
}

// The best of the starts, and which of its components the others have too.
struct Best {
  FastIcaRun run;
  std::vector<bool> unique;
};
Best best_of_starts(const Rows& z, const IcaParams& params, Work& work) {
  const auto count = static_cast<std::size_t>(std::max(params.starts, 1));
  std::vector<FastIcaRun> all(count);
  work.parallel(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      all[n] =
          fast_ica(z, starting_rotation(z.rows, static_cast<int>(n), params.seed), params.fast_ica, work);
  });
  // The largest negentropy; a run that did not converge counts 1 % less; then the first.
  const auto worth = [](const FastIcaRun& run) { return run.negentropy * (run.converged ? 1 : 0.99); };
  const auto best_of = [&](const std::vector<FastIcaRun>& runs) {
    return *std::max_element(runs.begin(), runs.end(),
                             [&](const FastIcaRun& a, const FastIcaRun& b) { return worth(a) < worth(b); });
  };
  Best best{leave_side_optimum(z, best_of(all), params.fast_ica, work), std::vector<bool>(z.rows, true)};
  if (count == 1) return best;
  // What lies around the best is looked at too; a better one found there is the best from then on.
  for (int round = 0; round < 3; ++round) {
    auto around = runs_around(z, best.run, params.fast_ica, work);
    if (around.empty()) break;
    all.insert(all.end(), around.begin(), around.end());
    const FastIcaRun other = best_of(around);
    if (worth(other) < 1.01 * worth(best.run)) break;
    best.run = leave_side_optimum(z, other, params.fast_ica, work);
  }
  best.unique = unique_components(best.run, all);
  return best;
}

// Rows of `rotation` in the order and with the signs that users see.
Rows canonical(const Rows& rotation, const Whitened& white, std::vector<bool>& unique) {
  const Rows u = rotated(rotation, white.z);
  const Rows mixing = product(white.p, transposed(rotation));  // W⁻¹ = Wᵀ
  std::vector<double> energy(u.rows);
  for (std::size_t i = 0; i < u.rows; ++i)
    for (std::size_t d = 0; d < mixing.rows; ++d) energy[i] += mixing(d, i) * mixing(d, i);
  std::vector<std::size_t> order(u.rows);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return energy[a] > energy[b]; });
  Rows out(rotation.rows, rotation.columns);
  std::vector<bool> unique_in_order;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t from = order[i];
    const double skew = skewness(u.row(from), u.columns);
    double largest = 0;
    for (std::size_t d = 0; d < mixing.rows; ++d)
      if (std::fabs(mixing(d, from)) > std::fabs(largest)) largest = mixing(d, from);
    const bool flip = std::fabs(skew) > 0.3 ? skew < 0 : largest < 0;
    for (std::size_t c = 0; c < out.columns; ++c) out(i, c) = flip ? -rotation(from, c) : rotation(from, c);
    unique_in_order.push_back(unique[from]);
  }
  unique = unique_in_order;
  return out;
}

std::string list_of(const std::vector<bool>& unique) {
  std::string text;
  for (std::size_t i = 0; i < unique.size(); ++i)
    if (!unique[i]) text += fmt::format("{}u{}", text.empty() ? "" : ", ", i + 1);
  return text;
}

Components assembled(ChannelSpace space, std::vector<ComponentSegment> segments, const Rows& channels,
                     double fps, const IcaParams& params, Work& work) {
  Decomposition found = decompose(channels, params, work);
  Components out;
  out.space = std::move(space);
  out.fps = fps;
  out.mean = std::move(found.mean);
  out.mixing = std::move(found.mixing);
  out.unmixing = std::move(found.unmixing);
  out.signals = std::move(found.signals);
  out.shares = std::move(found.shares);
  out.segments = std::move(segments);
  out.converged = found.converged;
  out.iterations = found.iterations;
  out.reached = found.reached;
  out.tolerance = params.fast_ica.tolerance;
  out.negentropy = found.negentropy;
  out.unique = std::move(found.unique);
  constexpr const char* nonlinearities[] = {"logcosh", "pow3", "gauss"};
  out.nonlinearity = nonlinearities[static_cast<int>(params.fast_ica.nonlinearity)];
  out.method = !params.rotate ? "pca" : params.fast_ica.symmetric ? "symmetric" : "deflation";
  return out;
}

// Side by side: each part's columns after those of the part before.
Rows joined(const std::vector<Rows>& parts) {
  std::size_t columns = 0;
  for (const Rows& part : parts) columns += part.columns;
  Rows out(parts.front().rows, columns);
  std::size_t at = 0;
  for (const Rows& part : parts) {
    for (std::size_t i = 0; i < part.rows; ++i) std::copy_n(part.row(i), part.columns, out.row(i) + at);
    at += part.columns;
  }
  return out;
}

std::vector<double> last_column(const Rows& rows) {
  std::vector<double> out;
  for (std::size_t i = 0; rows.columns && i < rows.rows; ++i) out.push_back(rows(i, rows.columns - 1));
  return out;
}

}  // namespace

Decomposition decompose(const Rows& channels, const IcaParams& params, Work& work) {
  if (channels.columns < 2)
    throw Failure(
        error("too-few-frames", fmt::format("{} frame(s) are too few to decompose", channels.columns))
            .hinting("give clips of at least two frames"));
  const Principal principal = principal_components(channels, work);
  // What stays of an unchanging channel of size s after its mean is taken out is rounding, some 1e-16 s.
  double largest = 0;
  for (double x : principal.mean) largest = std::max(largest, std::fabs(x));
  if (principal.rank == 0 || principal.variance[0] <= 1e-28 * largest * largest)
    throw Failure(error("no-variance", "no channel changes over time")
                      .hinting("give a clip that moves, or other `joints`"));
  const auto k = params.components > 0 ? static_cast<std::size_t>(params.components)
                                       : count_for(principal, params.variance);
  if (k > principal.rank)
    throw Failure(
        error("too-many-components",
              fmt::format("{} components are wanted, but the clips span only {}", k, principal.rank))
            .at_param("components")
            .hinting(
                fmt::format("ask for at most {}, or 0 for as many as `variance` needs", principal.rank)));
  const Whitened white = whiten(channels, principal, k, work);

  Decomposition out;
  out.mean = principal.mean;
  out.unique.assign(k, true);
  Rows rotation = identity(k);
  if (params.rotate && k > 1) {
    Best best = best_of_starts(white.z, params, work);
    rotation = std::move(best.run.w);
    out.converged = best.run.converged;
    out.iterations = best.run.iterations;
    out.reached = best.run.reached;
    out.unique = std::move(best.unique);
  }
  rotation = canonical(rotation, white, out.unique);
  out.signals = rotated(rotation, white.z);
  out.mixing = product(white.p, transposed(rotation));
  out.unmixing = product(rotation, white.p_inverse);
  out.negentropy = negentropy(out.signals);
  const double whole = std::accumulate(principal.variance.begin(), principal.variance.end(), 0.0);
  for (std::size_t i = 0; i < k; ++i) {
    double energy = 0;
    for (std::size_t d = 0; d < out.mixing.rows; ++d) energy += out.mixing(d, i) * out.mixing(d, i);
    out.shares.push_back(energy / whole);
  }
  if (!out.converged)
    work.report(
        warning("not-converged",
                fmt::format("the change of the components is still {:.2g} after {} iterations; wanted {:.2g}",
                            out.reached, out.iterations, params.fast_ica.tolerance))
            .hinting("raise `iterations` or `tolerance`, or ask for fewer `components`"));
  if (const std::string others = list_of(out.unique); !others.empty())
    work.report(
        warning("not-unique", "the components " + others +
                                  " are not unique: the optimum is flat, others are nearly as independent")
            .hinting("look at several guesses with `seed`, or ask for fewer `components`"));
  return out;
}

Components components_of_motions(ChannelSpace space,
                                 const std::vector<std::shared_ptr<const Motion>>& motions,
                                 const IcaParams& params, Work& work) {
  std::vector<Rows> parts;
  std::vector<ComponentSegment> segments;
  std::size_t at = 0;
  for (const auto& motion : motions) {
    parts.push_back(
        channels_of(space, *motion, parts.empty() ? std::vector<double>{} : last_column(parts.back()), work));
    segments.push_back({at, at + motion->frames(), motion, nullptr, {}});
    at += motion->frames();
  }
  return assembled(std::move(space), std::move(segments), joined(parts), motions.front()->fps(), params,
                   work);
}

Components components_of_points(ChannelSpace space, const std::vector<std::shared_ptr<const Points>>& points,
                                const IcaParams& params, Work& work) {
  std::vector<Rows> parts;
  std::vector<ComponentSegment> segments;
  std::size_t at = 0;
  for (const auto& one : points) {
    parts.push_back(channels_of(space, *one, work));
    segments.push_back({at, at + one->frames, nullptr, one, {}});
    at += one->frames;
  }
  return assembled(std::move(space), std::move(segments), joined(parts), points.front()->fps, params, work);
}

}  // namespace kinegraph
