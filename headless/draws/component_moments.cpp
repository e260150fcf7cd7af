#include "headless/draws/component_moments.h"

#include <algorithm>
#include <cmath>

#include "nodes/components/component_meaning.h"

namespace kinegraph {
namespace {

int count_of_moments(const Components& components) {
  constexpr int usual = 12, least = 10, most = 14;
  for (const auto& cadence : cadences_of(components)) {  // by variance: the first that swings
    if (!cadence) continue;
    const auto off_phase = [&](int count) {
      const double halves =
          2 * cadence->hertz * static_cast<double>(components.frames()) / components.fps / count;
      return std::fabs(halves - std::round(halves));
    };
    int best = usual;
    for (int count = least; count <= most; ++count)
      if (off_phase(count) > 1.2 * off_phase(best)) best = count;
    return best;
  }
  return usual;
}

void show(const Components& components, std::size_t frame, Moment& moment) {
  for (std::size_t s = 0; s < components.segments.size(); ++s)
    if (frame >= components.segments[s].start && frame < components.segments[s].end) {
      moment.frame = frame;
      moment.segment = s;
      moment.own_frame = frame - components.segments[s].start;
    }
}

}  // namespace

std::vector<Moment> even_moments(const Components& components) {
  if (components.frames() == 0) return {};
  const int count = count_of_moments(components);
  std::vector<Moment> out;
  for (int i = 0; i < count; ++i) {
    Moment moment{0, 0, 0, (i + 0.5) / count};
    show(components, static_cast<std::size_t>(moment.part * static_cast<double>(components.frames())),
         moment);
    out.push_back(moment);
  }
  return out;
}

std::vector<Moment> telling_moments(const Components& components, std::vector<Moment> moments,
                                    std::size_t entry) {
  if (moments.size() < 2) return moments;
  const double* u = components.signals.row(entry);
  std::vector<std::size_t> frames;
  for (const Moment& moment : moments) frames.push_back(moment.frame);
  std::size_t moved = frames.size();  // none
  for (const double direction : {1.0, -1.0}) {
    std::size_t farthest = 0;
    for (std::size_t t = 1; t < components.frames(); ++t)
      if (direction * u[t] > direction * u[farthest]) farthest = t;
    if (std::any_of(frames.begin(), frames.end(),
                    [&](std::size_t frame) { return direction * u[frame] >= 0.8 * direction * u[farthest]; }))
      continue;
    const double part = static_cast<double>(farthest) / static_cast<double>(components.frames());
    std::size_t nearest = moved == 0 ? 1 : 0;
    for (std::size_t i = 0; i < moments.size(); ++i)
      if (i != moved && std::fabs(moments[i].part - part) < std::fabs(moments[nearest].part - part))
        nearest = i;
    frames[nearest] = farthest;
    moved = nearest;
  }
  std::sort(frames.begin(), frames.end());
  for (std::size_t i = 0; i < moments.size(); ++i) show(components, frames[i], moments[i]);
  return moments;
}

}  // namespace kinegraph
