#include "nodes/components/component_meaning.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "nodes/components/alignment.h"
#include "nodes/components/rebuild.h"
#include "nodes/motion/joint_pattern.h"

namespace kinegraph {
namespace {

// Positions of the joints or points, the root at the origin, of all segments side by side.
class Places {
 public:
  Places(const Components& components, Work& work) : components_(components), work_(work) {}

  Rows of(const std::set<std::size_t>& entries) const {
    const std::vector<std::size_t> list(entries.begin(), entries.end());
    const Rows x = channels_from_signals(components_, components_.signals, list);
    if (components_.space.representation == Representation::points) return x;
    ChannelSpace as_points = components_.space;
    as_points.representation = Representation::points;
    as_points.reference.clear();
    Rows out(3 * components_.space.labels.size(), x.columns);
    for (const ComponentSegment& segment : components_.segments) {
      Rows part(x.rows, segment.frames());
      for (std::size_t d = 0; d < x.rows; ++d)
        std::copy_n(x.row(d) + segment.start, part.columns, part.row(d));
      const Motion motion = motion_from_channels(components_.space, part, *segment.motion, {}, work_);
      const Rows places = channels_of(as_points, motion, {}, work_);
      for (std::size_t d = 0; d < out.rows; ++d)
        std::copy_n(places.row(d), part.columns, out.row(d) + segment.start);
    }
    return out;
  }

 private:
  const Components& components_;
  Work& work_;
};

double apart(const Rows& a, const Rows& b, const std::vector<bool>& region) {
  double sum = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (!region[i]) continue;
    ++points;
    for (std::size_t d = 3 * i; d < 3 * i + 3; ++d)
      for (std::size_t t = 0; t < a.columns; ++t) sum += (a(d, t) - b(d, t)) * (a(d, t) - b(d, t));
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(points * a.columns, 1)));
}

std::vector<bool> region_of(const Components& components, const std::string& name, const std::string& pattern,
                            Work& work) {
  const ChannelSpace& space = components.space;
  const std::string param = "regions." + name;
  std::vector<bool> out;
  if (space.of_motions) {
    const auto chosen = chosen_joints(pattern, *space.skeleton, param, work);
    for (int joint : space.joints) out.push_back(chosen[joint]);
  } else {
    out = chosen_names(pattern, space.labels, param, work);
  }
  if (std::none_of(out.begin(), out.end(), [](bool b) { return b; }))
    throw Failure(error("no-joints", "the region '" + name + "' holds nothing")
                      .at_param(param)
                      .hinting("choose joints"));
  return out;
}

std::vector<std::optional<double>> emotion_distances(const Components& components,
                                                     const MeaningParams& params, Work& work) {
  std::vector<double> sums(components.count());
  std::size_t rows = 0;
  for (std::size_t p = 0; p < params.pairs.size(); ++p) {
    const std::string param = "pairs[" + std::to_string(p) + "]";
    const auto &a = segment_of(components, params.pairs[p].first, param),
               &b = segment_of(components, params.pairs[p].second, param);
    const Correspondence path = aligned_segments(components, a, b, params.align, "align", work);
    rows += path.pairs.size();
    for (std::size_t j = 0; j < sums.size(); ++j)
      for (const auto& [at_a, at_b] : path.pairs) {
        const double difference =
            components.signals(j, a.start + at_a) - components.signals(j, b.start + at_b);
        sums[j] += difference * difference;
      }
  }
  std::vector<std::optional<double>> out(sums.size());
  for (std::size_t j = 0; rows > 0 && j < sums.size(); ++j)
    out[j] = std::sqrt(sums[j] / static_cast<double>(rows));
  return out;
}

}  // namespace

std::optional<double> cadence_of(const Components& components, std::size_t entry) {
  double strongest = 0;
  std::size_t period = 0;
  for (const ComponentSegment& segment : components.segments) {
    const double* u = components.signals.row(entry) + segment.start;
    double mean = 0;
    for (std::size_t t = 0; t < segment.frames(); ++t) mean += u[t] / static_cast<double>(segment.frames());
    std::vector<double> correlation(segment.frames() * 2 / 3);
    for (std::size_t lag = 0; lag < correlation.size(); ++lag) {
      double sum = 0;
      for (std::size_t t = 0; t + lag < segment.frames(); ++t) sum += (u[t] - mean) * (u[t + lag] - mean);
      correlation[lag] = sum / static_cast<double>(segment.frames() - lag);
    }
    std::size_t lag = 0, best = 0;
    while (lag < correlation.size() && correlation[lag] > 0) ++lag;
    for (lag = std::max<std::size_t>(lag, 1); lag + 1 < correlation.size(); ++lag)
      if (correlation[lag] >= correlation[lag - 1] && correlation[lag] >= correlation[lag + 1] &&
          (best == 0 ||
           correlation[lag] > 1.1 * correlation[best]))  // a multiple of the period must be clearly better
        best = lag;
    if (best == 0 || correlation[best] < 0.3 * correlation[0] || correlation[best] <= strongest) continue;
    strongest = correlation[best];
    period = best;
  }
  if (period == 0 || strongest <= 1e-12) return std::nullopt;
  return components.fps / static_cast<double>(period);
}

std::vector<Moved> moved_by(const Components& components, std::size_t entry) {
  const std::size_t per = components.space.per_label();
  double square = 0;
  for (std::size_t t = 0; t < components.frames(); ++t)
    square += components.signals(entry, t) * components.signals(entry, t) /
              static_cast<double>(components.frames());
  std::vector<Moved> out;
  for (std::size_t i = 0; i < components.space.labels.size(); ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < per; ++c) {
      const double part = components.mixing(i * per + c, entry);
      sum += part * part;
    }
    out.push_back({components.space.labels[i], std::sqrt(square * sum)});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Moved& a, const Moved& b) { return a.amount > b.amount; });
  return out;
}

ComponentMeaning component_meaning(const Components& components, const MeaningParams& params, Work& work) {
  ComponentMeaning out;
  out.d_emotion = emotion_distances(components, params, work);
  if (!params.emotion.empty()) {
    out.emotion = entries_of(params.emotion, components, "emotion");
  } else if (!params.pairs.empty()) {
    out.emotion = {static_cast<std::size_t>(std::max_element(out.d_emotion.begin(), out.d_emotion.end()) -
                                            out.d_emotion.begin())};
  }
  if (params.regions.empty()) return out;

  std::set<std::size_t> all, emotion(out.emotion.begin(), out.emotion.end());
  for (std::size_t i = 0; i < components.count(); ++i) all.insert(i);
  std::vector<std::vector<bool>> regions;
  for (const auto& [name, pattern] : params.regions)
    regions.push_back(region_of(components, name, pattern, work));
  const Places places(components, work);
  const Rows whole = places.of(all), base = places.of(emotion);
  out.d_region.assign(regions.size(), std::vector<double>(components.count()));
  for (std::size_t i = 0; i < components.count(); ++i) {
    work.check();
    const bool inside = emotion.count(i) > 0;
    std::set<std::size_t> changed = emotion;
    if (inside)
      changed.erase(i);
    else
      changed.insert(i);
    const Rows other = places.of(changed);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const double with_base = apart(base, whole, regions[r]), with_other = apart(other, whole, regions[r]);
      out.d_region[r][i] = inside ? with_base - with_other : with_other - with_base;
    }
  }
  return out;
}

}  // namespace kinegraph
