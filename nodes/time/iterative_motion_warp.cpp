#include "nodes/time/iterative_motion_warp.h"

#include <algorithm>

#include "nodes/time/space_warp.h"

namespace kinegraph {
namespace {

// After the first search the path moves little: later ones look near the last path only where that saves
// much.
constexpr std::size_t band_from_cells = std::size_t{1} << 24;

class Alternation {
 public:
  Alternation(const Series& warped, const Series& clock, const MotionWarpSettings& settings, Work& work)
      : warped_(warped), clock_(clock), settings_(settings), work_(work) {
    weights_ = {settings.scale_smoothness, settings.offset_smoothness,
                1e-9 * static_cast<double>(clock.frames) / static_cast<double>(warped.frames)};
  }

  MotionWarpResult run() {
    MotionWarpResult result;
    result.path = dynamic_time_warp(warped_, clock_, settings_.limits, work_);
    result.rounds = 1;
    work_.check();
    result.a = Series(warped_.frames, warped_.dims);
    work_.check();
    result.b = Series(warped_.frames, warped_.dims);
    std::fill(result.a.values.begin(), result.a.values.end(), 1.0);
    work_.check();
    result.energy.push_back(energy(result, result.path));
    if (!settings_.scale_and_offset) {
      result.settled = true;
      return result;
    }
    for (;;) {
      const double change = solve(result);
      result.energy.push_back(energy(result, result.path));
      work_.progress(static_cast<double>(result.rounds) / settings_.iterations);
      if (change < settings_.tolerance) {
        result.settled = true;
        return result;
      }
      if (result.rounds >= settings_.iterations) return result;
      const WarpPath path = search(result);
      ++result.rounds;
      // A path that is only as good is no progress: so two equal paths can't take turns for ever.
      const double before = result.energy.back(), now = energy(result, path);
      result.energy.push_back(now);
      if (path == result.path || now >= before) {
        result.settled = true;
        return result;
      }
      result.path = path;
    }
  }

 private:
  WarpPath search(const MotionWarpResult& result) {
    Series shaped(warped_.frames, warped_.dims);
    for (std::size_t d = 0; d < shaped.dims; ++d) {
      work_.check();
      const auto out = shaped.dim(d);
      const auto s = warped_.dim(d);
      const auto a = result.a.dim(d), b = result.b.dim(d);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = s[i] * a[i] + b[i];
    }
    if (warped_.frames * clock_.frames < band_from_cells)
      return dynamic_time_warp(shaped, clock_, settings_.limits, work_);
    const WarpBand band{result.path, std::max<std::size_t>(256, warped_.frames / 16)};
    return dynamic_time_warp(shaped, clock_, settings_.limits, work_, &band);
  }

  // Each dimension by itself: eq. 3 doesn't couple them.
  double solve(MotionWarpResult& result) {
    std::vector<double> changes(warped_.dims);
    const std::size_t grain = std::max<std::size_t>(1, 20'000 / clock_.frames);
    work_.parallel(warped_.dims, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t d = begin; d < end; ++d) {
        work_.check();
        changes[d] = solve_space_warp(warped_.dim(d), clock_.dim(d), result.path, weights_, result.a.dim(d),
                                      result.b.dim(d));
      }
    });
    return changes.empty() ? 0 : *std::max_element(changes.begin(), changes.end());
  }

  double energy(const MotionWarpResult& result, const WarpPath& path) {
    double total = 0;
    for (std::size_t d = 0; d < warped_.dims; ++d) {
      work_.check();
      total +=
          space_warp_energy(warped_.dim(d), clock_.dim(d), path, weights_, result.a.dim(d), result.b.dim(d));
    }
    return total;
  }

  const Series& warped_;
  const Series& clock_;
  const MotionWarpSettings& settings_;
  Work& work_;
  SpaceWarpWeights weights_;
};

}  // namespace

MotionWarpResult iterative_motion_warp(const Series& warped, const Series& clock,
                                       const MotionWarpSettings& settings, Work& work) {
  return Alternation(warped, clock, settings, work).run();
}

}  // namespace kinegraph
