#include "nodes/components/stabilised_points.h"

#include <algorithm>

#include "nodes/components/points_to_rotations.h"

namespace kinegraph {
namespace {

// "3 to 7, 12": the frames where a label is missing.
std::string missing_frames(const Points& points, int label) {
  std::string text;
  for (std::size_t t = 0; t < points.frames; ++t) {
    if (!points.is_missing(label, t)) continue;
    const std::size_t first = t;
    while (t + 1 < points.frames && points.is_missing(label, t + 1)) ++t;
    text +=
        (text.empty() ? "" : ", ") + std::to_string(first) + (t > first ? " to " + std::to_string(t) : "");
  }
  return text;
}

}  // namespace

std::vector<int> labels_of(const std::vector<std::string>& wanted, const Points& points,
                           std::string_view clip) {
  std::vector<int> out;
  for (const std::string& label : wanted) {
    const auto found = std::find(points.labels.begin(), points.labels.end(), label);
    if (found == points.labels.end())
      throw Failure(
          error("label-missing", std::string(clip) + " has no point '" + label + "'")
              .at_port("motions")
              .at_joint(label)
              .hinting("give clips with the same labels, or choose those they share with `joints`"));
    out.push_back(static_cast<int>(found - points.labels.begin()));
  }
  return out;
}
std::vector<Move> moves_of(const ChannelSpace& space, const Points& points) {
  std::vector<Move> moves(points.frames);
  if (space.stabilise == Stabilise::none) return moves;
  const auto stable = labels_of(space.stable, points);
  std::vector<Vec3> present(stable.size());
  for (std::size_t t = 0; t < points.frames; ++t) {
    Move& move = moves[t];
    for (int label : stable) move.centre += points.track(label)[t];
    move.centre = move.centre / static_cast<double>(stable.size());
    if (space.stabilise == Stabilise::centroid) continue;
    for (std::size_t i = 0; i < stable.size(); ++i) present[i] = points.track(stable[i])[t] - move.centre;
    move.turn = best_rotation(present, space.shape, t > 0 ? moves[t - 1].turn : Quat{});
  }
  return moves;
}

void check_whole(const Points& points, const std::vector<int>& labels, std::string_view clip) {
  for (int label : labels) {
    const std::string frames = missing_frames(points, label);
    if (frames.empty()) continue;
    throw Failure(
        error("gaps", "the point '" + points.labels[label] + "' of " + std::string(clip) +
                          " is missing at frames " + frames)
            .at_port("motions")
            .at_joint(points.labels[label])
            .hinting("fill longer gaps with Load's `max_gap`, or leave the point out with `joints`"));
  }
}

}  // namespace kinegraph
