#include "nodes/components/component_meaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "nodes/components/alignment.h"
#include "nodes/components/cloud_caption.h"
#include "nodes/components/rebuild.h"
#include "nodes/motion/body.h"
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
    if (params.pairs[p].first == params.pairs[p].second)
      throw Failure(error("bad-pair", "a segment is no pair with itself")
                        .at_param(param)
                        .hinting("name two segments of equal content and different emotion"));
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

// The period of a segment's signal in frames, 0 = none, and how much of its variance repeats.
struct Beat {
  std::size_t period = 0;
  double strength = 0;
};
Beat beat_of(const double* u, std::size_t frames) {
  double mean = 0;
  for (std::size_t t = 0; t < frames; ++t) mean += u[t] / static_cast<double>(frames);
  std::vector<double> correlation(frames * 2 / 3);
  for (std::size_t lag = 0; lag < correlation.size(); ++lag) {
    double sum = 0;
    for (std::size_t t = 0; t + lag < frames; ++t) sum += (u[t] - mean) * (u[t + lag] - mean);
    correlation[lag] = sum / static_cast<double>(frames - lag);
  }
  std::size_t lag = 0, best = 0;
  while (lag < correlation.size() && correlation[lag] > 0) ++lag;
  for (lag = std::max<std::size_t>(lag, 1); lag + 1 < correlation.size(); ++lag)
    if (correlation[lag] >= correlation[lag - 1] && correlation[lag] >= correlation[lag + 1] &&
        (best == 0 ||
         correlation[lag] > 1.1 * correlation[best]))  // a multiple of the period must be clearly better
      best = lag;
  // Of the whole signal's variance, 1, next to nothing repeats here where the component rests.
  constexpr double least = 0.01;
  if (best == 0 || correlation[best] < 0.3 * correlation[0] || correlation[best] < least) return {};
  return {best, correlation[best]};
}

// The joints of a region and all that hangs on them.
void mark(const Skeleton& skeleton, int joint, std::size_t region, std::vector<std::size_t>& of) {
  if (joint < 0) return;
  of[static_cast<std::size_t>(joint)] = region;
  for (int child : skeleton.children(joint)) mark(skeleton, child, region, of);
}

}  // namespace

std::vector<std::optional<Cadence>> cadences_of(const Components& components) {
  const std::size_t k = components.count(), segments = components.segments.size();
  std::vector<std::vector<Beat>> beats(segments, std::vector<Beat>(k));
  std::vector<double> repeats(segments);
  for (std::size_t s = 0; s < segments; ++s) {
    const ComponentSegment& segment = components.segments[s];
    for (std::size_t i = 0; i < k; ++i) {
      beats[s][i] = beat_of(components.signals.row(i) + segment.start, segment.frames());
      repeats[s] += components.shares[i] * beats[s][i].strength;
    }
  }
  std::size_t common = 0;
  const double most = segments > 0 ? *std::max_element(repeats.begin(), repeats.end()) : 0;
  while (common + 1 < segments && repeats[common] < 0.5 * most) ++common;
  std::vector<std::optional<Cadence>> out(k);
  for (std::size_t i = 0; segments > 0 && i < k; ++i) {
    std::size_t at = common;
    for (std::size_t s = 0; beats[at][i].period == 0 && s < segments; ++s)
      if (beats[s][i].period > 0) at = s;
    if (beats[at][i].period > 0)
      out[i] = Cadence{components.fps / static_cast<double>(beats[at][i].period), at};
  }
  return out;
}

std::string text_of(const Cadence& cadence, const Components& components) {
  std::string text = fmt::format("{:.2f} Hz", cadence.hertz);
  if (components.segments.size() > 1) text += fmt::format(" in segment {}", cadence.segment);
  return text;
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

std::vector<Moved> regions_moved_by(const Components& components, std::size_t entry) {
  const ChannelSpace& space = components.space;
  if (!space.of_motions) return {};
  const Skeleton& skeleton = *space.skeleton;
  const Body body = find_body(skeleton);
  if (body.pelvis < 0 || (body.arms.empty() && body.legs.empty())) return {};
  const std::array<const char*, 4> names{"trunk", "head", "arms", "legs"};
  std::vector<std::size_t> region(skeleton.joints.size(), 0);
  if (!body.neck.empty() || body.head >= 0)
    mark(skeleton, body.neck.empty() ? body.head : body.neck.front(), 1, region);
  for (const Arm& arm : body.arms) mark(skeleton, arm.upper, 2, region);
  for (const Leg& leg : body.legs) mark(skeleton, leg.hip, 3, region);

  const std::size_t per = space.per_label();
  const double* u = components.signals.row(entry);
  double square = 0;
  for (std::size_t t = 0; t < components.frames(); ++t)
    square += u[t] * u[t] / static_cast<double>(components.frames());
  const bool points = space.representation == Representation::points;
  std::array<double, 4> sums{}, counts{};
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    const int joint = space.joints[i], parent = skeleton.joints[joint].parent;
    const auto before = std::find(space.joints.begin(), space.joints.end(), parent);
    const double length = skeleton.link_length(joint);
    if (points && (before == space.joints.end() || length < 1e-6)) continue;
    double turn = 0;
    for (std::size_t c = 0; c < per; ++c) {
      double part = components.mixing(i * per + c, entry);
      if (points)
        part = (part -
                components.mixing(static_cast<std::size_t>(before - space.joints.begin()) * per + c, entry)) /
               length;
      turn += part * part;
    }
    // A link turns with the joint that it hangs on.
    const std::size_t r = region[static_cast<std::size_t>(points ? parent : joint)];
    sums[r] += turn * (space.representation == Representation::quaternions ? 4 : 1);
    counts[r] += 1;
  }
  std::vector<Moved> out;
  for (std::size_t r = 0; r < names.size(); ++r)
    if (counts[r] > 0) out.push_back({names[r], std::sqrt(square * sums[r] / counts[r])});
  std::stable_sort(out.begin(), out.end(),
                   [](const Moved& a, const Moved& b) { return a.amount > b.amount; });
  return out;
}

std::string what_moves(const Components& components, std::size_t entry) {
  std::string text;
  if (const auto regions = regions_moved_by(components, entry); !regions.empty()) {
    for (const Moved& region : regions)
      if (region.amount > 0 && region.amount >= regions.front().amount * 2 / 3)
        text += (text.empty() ? "" : " and ") + region.label;
    return text;
  }
  if (is_cloud(components)) return cloud_caption(components, entry);
  const auto moved = moved_by(components, entry);
  for (std::size_t i = 0; i < moved.size() && i < 3; ++i)
    if (moved[i].amount > 0) text += (text.empty() ? "" : ", ") + moved[i].label;
  return text;
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
