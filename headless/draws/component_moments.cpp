#include "headless/draws/component_moments.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {

void show(const Components& components, std::size_t frame, Moment& moment) {
  for (std::size_t s = 0; s < components.segments.size(); ++s)
    if (frame >= components.segments[s].start && frame < components.segments[s].end) {
      moment.frame = frame;
      moment.segment = s;
      moment.own_frame = frame - components.segments[s].start;
    }
}

std::vector<Moment> evenly(const Components& components, int count) {
  std::vector<Moment> out;
  for (int i = 0; i < count; ++i) {
    Moment moment{0, 0, 0, (i + 0.5) / count};
    show(components, static_cast<std::size_t>(moment.part * static_cast<double>(components.frames())),
         moment);
    out.push_back(moment);
  }
  return out;
}

struct Range {
  double low = 1e300, high = -1e300;
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return std::max(high - low, 0.0); }
};

// What part of the components' movement in each clip lies between what the moments show: the poses of a gait
// may all fall on the same phase of its cycle, and the strip would seem to stand still.
double shown_part(const Components& components, const std::vector<Moment>& moments) {
  double sum = 0;
  for (std::size_t s = 0; s < components.segments.size(); ++s) {
    const ComponentSegment& segment = components.segments[s];
    for (std::size_t i = 0; i < components.count(); ++i) {
      const double* u = components.signals.row(i);
      Range all, shown;
      for (std::size_t t = segment.start; t < segment.end; ++t) all.include(u[t]);
      for (const Moment& moment : moments)
        if (moment.segment == s) shown.include(u[moment.frame]);
      if (all.size() > 0)
        sum += components.shares[i] * static_cast<double>(segment.frames()) * shown.size() / all.size();
    }
  }
  return sum / static_cast<double>(components.frames());
}

}  // namespace

std::vector<Moment> even_moments(const Components& components) {
  if (components.frames() == 0) return {};
  std::vector<Moment> best = evenly(components, 12);
  double most = shown_part(components, best);
  for (int count : {11, 13, 10, 14}) {
    std::vector<Moment> other = evenly(components, count);
    const double part = shown_part(components, other);
    if (part < 1.02 * most || part <= most) continue;
    most = part;
    best = std::move(other);
  }
  return best;
}

std::vector<Moment> telling_moments(const Components& components, std::vector<Moment> moments,
                                    std::size_t entry) {
  const double* u = components.signals.row(entry);
  Range whole;
  for (std::size_t t = 0; t < components.frames(); ++t) whole.include(u[t]);
  std::vector<bool> moved(moments.size(), false);
  std::vector<std::size_t> frames;
  for (const Moment& moment : moments) frames.push_back(moment.frame);
  for (std::size_t s = 0; s < components.segments.size(); ++s) {
    const ComponentSegment& segment = components.segments[s];
    for (const double direction : {1.0, -1.0}) {
      std::size_t farthest = segment.start;
      for (std::size_t t = segment.start; t < segment.end; ++t)
        if (direction * u[t] > direction * u[farthest]) farthest = t;
      const double part = static_cast<double>(farthest) / static_cast<double>(components.frames());
      bool is_shown = false;
      std::size_t nearest = moments.size();
      for (std::size_t i = 0; i < moments.size(); ++i) {
        if (moments[i].segment != s) continue;
        is_shown = is_shown || direction * (u[farthest] - u[frames[i]]) <= 0.2 * whole.size();
        if (!moved[i] && (nearest == moments.size() ||
                          std::fabs(moments[i].part - part) < std::fabs(moments[nearest].part - part)))
          nearest = i;
      }
      if (is_shown || nearest == moments.size()) continue;
      frames[nearest] = farthest;
      moved[nearest] = true;
    }
  }
  std::sort(frames.begin(), frames.end());
  for (std::size_t i = 0; i < moments.size(); ++i) show(components, frames[i], moments[i]);
  return moments;
}

}  // namespace kinegraph
