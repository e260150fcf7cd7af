#include "nodes/components/cloud_caption.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace kinegraph {
namespace {

constexpr std::size_t readable_names = 64;

Vec3 at(const Rows& rows, std::size_t point, std::size_t column) {
  return {rows(3 * point, column), rows(3 * point + 1, column), rows(3 * point + 2, column)};
}

// By how many standard deviations the weighted mean of `values` lies off their plain mean.
double off_centre(const std::vector<double>& values, const std::vector<double>& weights) {
  double mean = 0, spread = 0, weighted = 0, all = 0;
  for (double value : values) mean += value / static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    spread += (values[i] - mean) * (values[i] - mean) / static_cast<double>(values.size());
    weighted += weights[i] * (values[i] - mean);
    all += weights[i];
  }
  return spread > 0 && all > 0 ? weighted / all / std::sqrt(spread) : 0;
}

// The fewest that hold four fifths of the sum.
std::size_t most_of(std::vector<double> weights) {
  std::sort(weights.begin(), weights.end(), std::greater<>());
  double all = 0, sum = 0;
  for (double weight : weights) all += weight;
  std::size_t count = 0;
  while (count < weights.size() && sum < 0.8 * all) sum += weights[count++];
  return count;
}

}  // namespace

bool is_cloud(const Components& components) {
  if (components.space.of_motions || components.space.labels.size() <= readable_names) return false;
  return std::all_of(
      components.segments.begin(), components.segments.end(),
      [](const ComponentSegment& segment) { return !segment.points || segment.points->links.empty(); });
}

std::string cloud_caption(const Components& components, std::size_t entry) {
  constexpr double apart = 0.25, most = 0.6;
  const std::size_t count = components.space.labels.size();
  std::vector<Vec3> places;
  Vec3 centre;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back({components.mean[3 * i], components.mean[3 * i + 1], components.mean[3 * i + 2]});
    centre += places.back() / static_cast<double>(count);
  }
  std::vector<double> weights, heights, radii;
  double up = 0, outwards = 0, all = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 move = at(components.mixing, i, entry);
    Vec3 away = places[i] - centre;
    heights.push_back(away.y);
    away.y = 0;
    radii.push_back(norm(away));
    weights.push_back(dot(move, move));
    all += weights.back();
    up += move.y * move.y;
    if (norm(away) > 0) outwards += dot(move, normalized(away)) * dot(move, normalized(away));
  }
  if (!(all > 0)) return "";
  const double share = static_cast<double>(most_of(weights)) / static_cast<double>(count);
  std::string text = fmt::format("{:.0f} % of the points", 100 * share);
  const double height = off_centre(heights, weights), radius = off_centre(radii, weights);
  std::string where = height > apart ? "upper" : height < -apart ? "lower" : "";
  if (std::fabs(radius) > apart)
    where += (where.empty() ? "" : " ") + std::string(radius > 0 ? "outer" : "inner");
  if (!where.empty()) text += ", the " + where + " ones";
  if (up > most * all)
    text += ", mostly up and down";
  else if (outwards > most * all)
    text += ", mostly in and out";
  else if (all - up - outwards > most * all)
    text += ", mostly round the middle";
  return text;
}

}  // namespace kinegraph
