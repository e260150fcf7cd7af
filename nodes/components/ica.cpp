#include "nodes/components/ica.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nodes/components/best_start.h"
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

// Which way round a component is shown: positive skewness where it is plain, else the largest entry of its
// mixing column positive. It hangs on little where skewness comes near the bound and says the opposite of the
// entry, or where two entries of opposite sign are the largest: what differs from seed to seed may turn it
// round then.
struct Sign {
  bool flip = false, steady = true;
};
Sign sign_of(double skew, const Rows& mixing, std::size_t column) {
  constexpr double plain = 0.3, margin = 0.01;
  double high = 0, low = 0;
  for (std::size_t d = 0; d < mixing.rows; ++d) {
    high = std::max(high, mixing(d, column));
    low = std::max(low, -mixing(d, column));
  }
  const double size = std::fabs(skew);
  const bool tied = std::min(high, low) > (1 - margin) * std::max(high, low);
  return {size > plain ? skew < 0 : low > high,
          size > plain + margin || (!tied && (size < plain - margin || (skew < 0) == (low > high)))};
}

// Rows of `rotation` in the order and with the signs that users see; `steady`: whether a sign is sure.
Rows canonical(const Rows& rotation, const Whitened& white, std::vector<bool>& unique,
               std::vector<bool>& steady) {
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
    const Sign sign = sign_of(skewness(u.row(from), u.columns), mixing, from);
    steady.push_back(sign.steady);
    for (std::size_t c = 0; c < out.columns; ++c)
      out(i, c) = sign.flip ? -rotation(from, c) : rotation(from, c);
    unique_in_order.push_back(unique[from]);
  }
  unique = unique_in_order;
  return out;
}

// Those that aren't.
std::string list_of(const std::vector<bool>& flags) {
  std::string text;
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (!flags[i]) text += fmt::format("{}u{}", text.empty() ? "" : ", ", i + 1);
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
  Principal principal = leading_components(channels, work);
  // What stays of an unchanging channel of size s after its mean is taken out is rounding, some 1e-16 s.
  double largest = 0;
  for (double x : principal.mean) largest = std::max(largest, std::fabs(x));
  if (principal.rank == 0 || principal.variance[0] <= 1e-28 * largest * largest)
    throw Failure(error("no-variance", "no channel changes over time")
                      .hinting("give a clip that moves, or other `joints`"));
  const auto wanted = [&] {
    return params.components > 0 ? static_cast<std::size_t>(params.components)
                                 : count_for(principal, params.variance);
  };
  std::size_t k = wanted();
  if (k >= principal.rank) {
    principal = principal_components(channels, work);
    k = wanted();
  }
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
    BestStart best = best_of_starts(white.z, params.fast_ica, params.starts, params.seed, work);
    rotation = std::move(best.run.w);
    out.converged = best.run.converged;
    out.iterations = best.run.iterations;
    out.reached = best.run.reached;
    out.unique = std::move(best.unique);
  }
  std::vector<bool> steady;
  rotation = canonical(rotation, white, out.unique, steady);
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
  if (const std::string others = list_of(steady); params.rotate && !others.empty())
    work.report(warning("sign-not-sure", "which way round " + others +
                                             " stands hangs on little: another `seed` may turn it round")
                    .hinting("where an edit adds to it (translate, warp), keep the `seed`"));
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
