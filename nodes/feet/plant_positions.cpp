#include "nodes/feet/plant_positions.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {

constexpr double no_skate = 0.0008;  // m

struct Plant {
  const FootTrack::Part* part;
  Run run;
  std::optional<double> height;  // of the ground there, as the contacts know it
  Vec3 from_first;               // of this plant's place, seen from the place of the stand's first plant
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vec3 path(const FootTrack& foot, const FootTrack::Part& part, std::size_t t) {
  return foot.ankle[t] + part.from_ankle[t];
}

// A foot along `direction`, of a length, which stands as flat as the contacts know of the two plants' ground:
// a restyled one may point its toes down into the floor.
Vec3 levelled(Vec3 direction, double length, const Plant& a, const Plant& b) {
  if (!a.height || !b.height) return length * direction;
  const double rise = *b.height - *a.height,
               level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  if (std::fabs(rise) >= length || level <= 0) return length * direction;
  const double along = std::sqrt(length * length - rise * rise) / level;
  return {along * direction.x, rise, along * direction.z};
}

// From the place of plant `a` to that of `b` as the foot itself spans it: over the frames they share, or at
// the seam.
Vec3 span(const Plant& a, const Plant& b) {
  if (a.part == b.part) return {};
  std::size_t start = std::max(a.run.start, b.run.start), end = std::min(a.run.end, b.run.end);
  if (start >= end) {
    start = std::min(a.run.end, b.run.end) - 1;
    end = std::max(a.run.start, b.run.start) + 1;
  }
  Vec3 sum;
  double length = 0;
  for (std::size_t t = start; t < end; ++t) {
    const Vec3 across = b.part->from_ankle[t] - a.part->from_ankle[t];
    sum += across;
    length += norm(across);
  }
  return levelled(normalized(sum), length / static_cast<double>(end - start), a, b);
}

// How far a part stands above the floor: the median over its plants, or its planted frames here where the
// contacts don't know.
double standing_height(const FootTrack& foot, const FootTrack::Part& part, double floor) {
  std::vector<double> heights;
  for (double height : part.heights) heights.push_back(height - floor);
  if (!heights.empty()) return median(std::move(heights));
  for (std::size_t t = 0; t < foot.frames(); ++t)
    if (part.planted_at(t)) heights.push_back(path(foot, part, t).y - floor);
  return heights.empty() ? 0 : median(std::move(heights));
}

std::optional<double> height_of(const FootTrack::Part& part, std::size_t plant) {
  if (plant >= part.heights.size()) return std::nullopt;
  return part.heights[plant];
}

// How much higher the ground under a stand is, where the contacts know it, than the stand's own height. A
// changed motion may float or sink; the contacts of the motion it came from still know where the ground was.
double lift_to_ground(const std::vector<Plant>& plants, std::size_t first, std::size_t last,
                      double first_height) {
  double sum = 0, frames = 0;
  for (std::size_t i = first; i <= last; ++i) {
    if (!plants[i].height) return 0;
    const auto length = static_cast<double>(plants[i].run.end - plants[i].run.start);
    sum += length * (*plants[i].height - (first_height + plants[i].from_first.y));
    frames += length;
  }
  return sum / frames;
}

}  // namespace

PlantPositions plant_positions(const FootTrack& foot, double fps, std::optional<double> floor,
                               double contacts_floor) {
  PlantPositions places;
  places.heel.resize(foot.frames());
  places.ball.resize(foot.frames());
  places.lift.resize(foot.frames(), 0.0);
  places.steady.resize(foot.frames(), false);
  std::vector<Plant> plants;
  for (const FootTrack::Part* part : {&foot.heel, &foot.ball})
    for (std::size_t i = 0; const Run& run : runs_of(part->planted)) {
      plants.push_back({part, run, height_of(*part, i), {}});
      ++i;
    }
  std::stable_sort(plants.begin(), plants.end(),
                   [](const Plant& a, const Plant& b) { return a.run.start < b.run.start; });
  const double heel_height = standing_height(foot, foot.heel, contacts_floor);
  const double ball_height = standing_height(foot, foot.ball, contacts_floor);

  const auto seam = static_cast<std::size_t>(fps / 30 + 0.5);
  for (std::size_t first = 0; first < plants.size();) {
    // A stand goes on while the next plant, of the other part, begins before or just after the latest end.
    std::size_t last = first;
    std::size_t holder = first;  // whose run reaches furthest
    while (last + 1 < plants.size()) {
      Plant& next = plants[last + 1];
      if (next.part == plants[holder].part || next.run.start > plants[holder].run.end + seam) break;
      next.from_first = plants[holder].from_first + span(plants[holder], next);
      ++last;
      if (next.run.end > plants[holder].run.end) holder = last;
    }
    Vec3 sum;
    double count = 0;
    for (std::size_t i = first; i <= last; ++i) {
      for (std::size_t t = plants[i].run.start; t < plants[i].run.end; ++t) {
        sum += path(foot, *plants[i].part, t) - plants[i].from_first;
        count += 1;
      }
    }
    const double lift = lift_to_ground(plants, first, last, sum.y / count);
    double furthest = 0;
    for (std::size_t i = first; i <= last; ++i) {
      Vec3 place = sum / count + plants[i].from_first;
      place.y += lift;
      if (floor) place.y = *floor + (plants[i].part == &foot.heel ? heel_height : ball_height);
      const double lifted = place.y - (sum.y / count + plants[i].from_first.y);
      auto& own = plants[i].part == &foot.heel ? places.heel : places.ball;
      for (std::size_t t = plants[i].run.start; t < plants[i].run.end; ++t) {
        own[t] = place;
        places.lift[t] = lifted;
        furthest = std::max(furthest, norm(path(foot, *plants[i].part, t) - place));
      }
    }
    for (std::size_t i = first; i <= last && furthest < no_skate; ++i)
      for (std::size_t t = plants[i].run.start; t < plants[i].run.end; ++t) places.steady[t] = true;
    first = last + 1;
  }
  return places;
}

}  // namespace kinegraph
