#include "nodes/feet/ankle_targets.h"

#include "nodes/feet/blending.h"

namespace kinegraph {

// A foot that is being lifted while it is still held turns fast against its places; carried on at that speed
// it would go on to point backwards.
constexpr double largest_carried_turn = 0.1;  // rad, half
constexpr double largest_carried_move = 0.1;  // m

AnkleTargets ankle_turns(const FootTrack& foot, const PlantPositions& places, double fps, double blend) {
  const std::size_t frames = foot.frames();
  std::vector<Vec3> half_turn(frames);  // logs of the turns
  std::vector<bool> aimed(frames, false);
  for (std::size_t t = 0; t < frames; ++t) {
    if (!foot.heel.planted_at(t) || !foot.ball.planted_at(t)) continue;
    aimed[t] = true;
    if (places.steady[t]) continue;
    half_turn[t] = log(
        smallest_turn(foot.ball.from_ankle[t] - foot.heel.from_ankle[t], places.ball[t] - places.heel[t]));
  }
  fill_smoothly(half_turn, aimed, fps, blend, largest_carried_turn);

  AnkleTargets targets;
  targets.turn.resize(frames);
  targets.held.resize(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    targets.turn[t] = places.steady[t] ? Quat{} : exp(half_turn[t]);
    targets.held[t] = foot.heel.planted_at(t) || foot.ball.planted_at(t);
  }
  return targets;
}

void move_ankles(const FootTrack& foot, const PlantPositions& places, double fps, double blend,
                 AnkleTargets& targets) {
  targets.move.assign(foot.frames(), {});
  for (std::size_t t = 0; t < foot.frames(); ++t) {
    const bool heel = foot.heel.planted_at(t), ball = foot.ball.planted_at(t);
    if (places.steady[t]) continue;
    const auto needed = [&](const FootTrack::Part& part, Vec3 place) {
      return place - (foot.ankle[t] + rotate(targets.turn[t], part.from_ankle[t]));
    };
    if (heel && ball) {
      targets.move[t] = 0.5 * (needed(foot.heel, places.heel[t]) + needed(foot.ball, places.ball[t]));
    } else if (heel) {
      targets.move[t] = needed(foot.heel, places.heel[t]);
    } else if (ball) {
      targets.move[t] = needed(foot.ball, places.ball[t]);
    }
  }
  fill_smoothly(targets.move, targets.held, fps, blend, largest_carried_move);
}

}  // namespace kinegraph
