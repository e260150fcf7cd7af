#include "nodes/time/filter.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "nodes/time/gaussian.h"
#include "nodes/time/lowpass.h"

namespace kinegraph {

namespace {

// A series of quaternions with room before and after, continued by q(-k) = q₀ q_k⁻¹ q₀.
class LongerRotation {
 public:
  LongerRotation(ConstQuatTrack q, std::size_t pad)
      : pad_(static_cast<std::ptrdiff_t>(pad)),
        last_(static_cast<std::ptrdiff_t>(q.w.size()) - 1),
        all_(q.w.size() + 2 * pad) {
    for (std::ptrdiff_t t = 0; t <= last_; ++t) at(t) = q[t];
    Quat first = at(0), last = at(last_);
    for (std::ptrdiff_t k = 1; k <= pad_;
         ++k) {  // from the ends outwards: what lies farther reflects what lies nearer
      at(last_ + k) = normalized(last * inverse(at(last_ - k)) * last);
      at(-k) = normalized(first * inverse(at(k)) * first);
    }
    for (std::size_t i = 1; i < all_.size(); ++i) all_[i] = nearer(all_[i], all_[i - 1]);
  }
  std::size_t size() const { return all_.size(); }
  const Quat& operator[](std::size_t i) const { return all_[i]; }
  std::size_t pad() const { return static_cast<std::size_t>(pad_); }

 private:
  Quat& at(std::ptrdiff_t t) { return all_[static_cast<std::size_t>(t + pad_)]; }
  std::ptrdiff_t pad_, last_;
  std::vector<Quat> all_;
};

using Smooth = std::function<void(std::span<double>)>;

// Component by component, normalised after; nothing where the mean of a stretch comes near zero.
std::optional<std::vector<Quat>> smoothed_components(const LongerRotation& q, const Smooth& smooth) {
  std::vector<double> series[4];
  for (int c = 0; c < 4; ++c) {
    series[c].resize(q.size());
    for (std::size_t i = 0; i < q.size(); ++i)
      series[c][i] = c == 0 ? q[i].x : c == 1 ? q[i].y : c == 2 ? q[i].z : q[i].w;
    smooth(series[c]);
  }
  std::vector<Quat> result(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    Quat sum{series[0][i], series[1][i], series[2][i], series[3][i]};
    if (dot(sum, sum) < 0.01) return {};
    result[i] = normalized(sum);
  }
  return result;
}

void filter_rotation(ConstQuatTrack from, QuatTrack to, const Smooth& smooth, std::size_t memory, double fps,
                     double cutoff) {
  // The slower the reference, the less of it the filter would have taken; the faster, the less is left to
  // wrap round.
  constexpr double slower[] = {0.1, 0.2, 0.5};
  constexpr double widest = 2.1;  // full angle from the reference, rad: a log jumps at π
  std::size_t frames = from.w.size();
  auto finish = [&](const auto& result_at) {
    for (std::size_t t = 0; t < frames; ++t) to.set(t, result_at(t));
    make_continuous(to.x, to.y, to.z, to.w);
  };
  for (double part : slower) {
    Lowpass reference_filter(fps, part * cutoff, 2);
    LongerRotation q(from, std::max(memory, reference_filter.memory()));
    auto reference =
        smoothed_components(q, [&](std::span<double> s) { reference_filter.apply_to_continued(s); });
    if (!reference) continue;
    double largest = 0;
    for (std::size_t i = 0; i < q.size(); ++i) largest = std::max(largest, turn((*reference)[i], q[i]));
    if (largest > widest) continue;
    std::vector<double> v[3];
    for (auto& series : v) series.resize(q.size());
    for (std::size_t i = 0; i < q.size(); ++i) {
      Vec3 l = log(nearer(inverse((*reference)[i]) * q[i], Quat{}));
      v[0][i] = l.x;
      v[1][i] = l.y;
      v[2][i] = l.z;
    }
    for (auto& series : v) smooth(series);
    finish([&](std::size_t t) {
      std::size_t i = t + q.pad();
      return normalized((*reference)[i] * exp({v[0][i], v[1][i], v[2][i]}));
    });
    return;
  }
  LongerRotation q(from, memory);
  auto components = smoothed_components(q, smooth);
  finish([&](std::size_t t) { return components ? (*components)[t + q.pad()] : from[t]; });
}

}  // namespace

Motion filtered(const Motion& motion, const std::vector<bool>& joints, const FilterSettings& settings,
                Work& work) {
  Motion result = motion;
  if (motion.frames() < 2 || 2 * settings.cutoff >= motion.fps()) return result;
  bool gaussian = settings.method == FilterSettings::Method::gaussian;
  double sigma = gaussian_sigma(settings.cutoff) * motion.fps();
  Lowpass butterworth(motion.fps(), settings.cutoff, settings.order);
  auto memory = gaussian ? static_cast<std::size_t>(6 * sigma) + 1 : butterworth.memory();
  Smooth smooth = [&](std::span<double> series) {
    if (gaussian)
      Gaussian(sigma, series.size()).apply(series);
    else
      butterworth.apply(series);
  };
  Smooth smooth_continued = [&](std::span<double> series) {
    if (gaussian)
      Gaussian(sigma, series.size()).apply(series);
    else
      butterworth.apply_to_continued(series);
  };
  work.parallel(joints.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (int j = static_cast<int>(begin); j < static_cast<int>(end); ++j) {
      work.check();
      if (!joints[j]) continue;
      filter_rotation(motion.rotation(j), result.rotation(j), smooth_continued, memory, motion.fps(),
                      settings.cutoff);
      if (!motion.translates(j)) continue;
      auto p = result.translation(j);
      for (auto series : {p.x, p.y, p.z}) smooth(series);
    }
  });
  return result;
}

}  // namespace kinegraph
