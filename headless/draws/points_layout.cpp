#include "headless/draws/points_layout.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "headless/draws/camera.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/fill_gaps.h"

namespace kinegraph {

namespace {

int labels_of(const Points& points) {
  return static_cast<int>(points.labels.size());
}

std::vector<std::size_t> counts_there(const Points& points) {
  std::vector<std::size_t> out(points.frames);
  for (int label = 0; label < labels_of(points); ++label)
    for (std::size_t t = 0; t < points.frames; ++t) out[t] += !points.is_missing(label, t);
  return out;
}

// Where the cloud goes: from the frame with most points on, by the mean step of those there in both frames.
std::vector<Vec3> middle_of(const Points& points, std::size_t anchor) {
  std::vector<Vec3> middle(points.frames);
  double count = 0;
  for (int label = 0; label < labels_of(points); ++label)
    if (!points.is_missing(label, anchor)) middle[anchor] += points.track(label)[anchor], count += 1;
  middle[anchor] = middle[anchor] / count;
  const auto step = [&](std::size_t from, std::size_t to) {
    Vec3 sum;
    double moving = 0;
    for (int label = 0; label < labels_of(points); ++label)
      if (!points.is_missing(label, from) && !points.is_missing(label, to))
        sum += points.track(label)[to] - points.track(label)[from], moving += 1;
    return moving > 0 ? sum / moving : Vec3{};
  };
  for (std::size_t t = anchor + 1; t < points.frames; ++t) middle[t] = middle[t - 1] + step(t - 1, t);
  for (std::size_t t = anchor; t-- > 0;) middle[t] = middle[t + 1] + step(t + 1, t);
  return middle;
}

std::vector<Vec3> smoothed(const std::vector<Vec3>& path, std::ptrdiff_t reach) {
  const auto last = static_cast<std::ptrdiff_t>(path.size()) - 1;
  std::vector<Vec3> out;
  for (std::ptrdiff_t t = 0; t <= last; ++t) {
    const std::ptrdiff_t near = std::min({reach, t, last - t});
    Vec3 sum;
    for (std::ptrdiff_t other = t - near; other <= t + near; ++other)
      sum += path[static_cast<std::size_t>(other)];
    out.push_back(sum / static_cast<double>(2 * near + 1));
  }
  return out;
}

std::vector<Vec3> bridged_track(const Points& points, int label, const std::vector<Vec3>& middle) {
  const auto track = points.track(label);
  std::vector<Vec3> out(points.frames);
  for (std::size_t t = 0; t < points.frames; ++t) out[t] = track[t];
  for (const Gap& gap : gaps_of(points, label)) {
    if (gap.first == 0 && gap.last == points.frames) return {};
    const auto off = [&](std::size_t t) { return track[t] - middle[t]; };
    const Vec3 after = gap.last < points.frames ? off(gap.last) : off(gap.first - 1);
    const Vec3 before = gap.first > 0 ? off(gap.first - 1) : after;
    const double steps = static_cast<double>(gap.last - gap.first + 1);
    for (std::size_t t = gap.first; t < gap.last; ++t)
      out[t] = middle[t] + before + static_cast<double>(t - gap.first + 1) / steps * (after - before);
  }
  return out;
}

// The larger axis of a scatter over the floor.
Vec3 long_axis(double xx, double xz, double zz) {
  const auto axis = sin_cos(0.5 * arc_tangent2(2 * xz, xx - zz));
  return {axis.cos, 0, axis.sin};
}

Vec3 turned_about_y(Vec3 v, double radians) {
  const auto turn = sin_cos(radians);
  return {turn.cos * v.x + turn.sin * v.z, v.y, turn.cos * v.z - turn.sin * v.x};
}

}  // namespace

BridgedPoints bridged(const Points& points) {
  BridgedPoints out;
  const std::vector<std::size_t> there = counts_there(points);
  const auto most = std::max_element(there.begin(), there.end());
  if (most == there.end() || *most == 0) return out;
  const auto enough = [&](std::size_t count) { return 2 * count >= *most; };
  out.first = static_cast<std::size_t>(std::find_if(there.begin(), there.end(), enough) - there.begin());
  out.last = points.frames - 1 -
             static_cast<std::size_t>(std::find_if(there.rbegin(), there.rend(), enough) - there.rbegin());
  out.middle = smoothed(middle_of(points, static_cast<std::size_t>(most - there.begin())),
                        static_cast<std::ptrdiff_t>(points.fps / 6));
  for (int label = 0; label < labels_of(points); ++label)
    out.places.push_back(bridged_track(points, label, out.middle));
  std::vector<double> heights;
  for (std::size_t t = out.first; t <= out.last; ++t) {
    double low = 1e300, high = -1e300, reach_out = 0;
    for (const auto& track : out.places) {
      if (track.empty()) continue;
      low = std::min(low, track[t].y);
      high = std::max(high, track[t].y);
      const Vec3 off = track[t] - out.middle[t];
      reach_out = std::max(reach_out, std::sqrt(off.x * off.x + off.z * off.z));
    }
    heights.push_back(low);
    out.height = std::max(out.height, high - low);
    out.width = std::max(out.width, 2 * reach_out);
  }
  const auto hundredth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 100);
  std::nth_element(heights.begin(), hundredth, heights.end());
  out.lowest = *hundredth;
  return out;
}

std::vector<Side> sides_of(const std::vector<std::string>& labels) {
  const std::set<std::string> all(labels.begin(), labels.end());
  const std::pair<std::string, std::string> words[] = {
      {"L", "R"}, {"l", "r"}, {"Left", "Right"}, {"left", "right"}};
  const auto has_twin = [&](const std::string& label, const std::string& from, const std::string& to) {
    for (std::size_t at = label.find(from); at != std::string::npos; at = label.find(from, at + 1)) {
      std::string twin = label;
      if (all.count(twin.replace(at, from.size(), to))) return true;
    }
    return false;
  };
  std::vector<Side> sides;
  for (const std::string& label : labels) {
    Side side = Side::middle;
    for (const auto& [left, right] : words) {
      if (has_twin(label, left, right)) side = Side::left;
      if (has_twin(label, right, left)) side = Side::right;
    }
    sides.push_back(side);
  }
  return sides;
}

std::vector<std::pair<int, int>> steady_links(const Points& points, const BridgedPoints& bridged,
                                              std::size_t most) {
  const int count = labels_of(points);
  if (points.labels.size() > most || bridged.middle.empty()) return {};
  struct Pair {
    double apart;
    int a, b;
  };
  std::vector<Pair> pairs;
  const std::size_t step = std::max<std::size_t>(1, points.frames / 120);
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      double sum = 0, squares = 0, frames = 0;
      for (std::size_t t = 0; t < points.frames; t += step) {
        if (points.is_missing(a, t) || points.is_missing(b, t)) continue;
        const double apart = norm(points.track(a)[t] - points.track(b)[t]);
        sum += apart, squares += apart * apart, frames += 1;
      }
      if (frames < 3) continue;
      const double mean = sum / frames, spread = std::sqrt(std::max(0.0, squares / frames - mean * mean));
      // A link much longer than a limb says nothing, however steady.
      if (mean > 0.4 * std::max(bridged.height, bridged.width) || spread > 0.06 * mean) continue;
      pairs.push_back({mean, a, b});
    }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& x, const Pair& y) { return x.apart < y.apart; });
  std::vector<int> linked(points.labels.size());
  std::vector<std::pair<int, int>> links;
  for (const Pair& pair : pairs) {
    int &of_a = linked[static_cast<std::size_t>(pair.a)], &of_b = linked[static_cast<std::size_t>(pair.b)];
    if (of_a >= 2 && of_b >= 2) continue;
    ++of_a, ++of_b;
    links.emplace_back(pair.a, pair.b);
  }
  return links;
}

PointsView view_of(const BridgedPoints& points) {
  if (points.middle.empty()) return {.from = {0, 0, 1}};
  double xx = 0, xz = 0, zz = 0;
  const auto add = [&](Vec3 d) { xx += d.x * d.x, xz += d.x * d.z, zz += d.z * d.z; };
  const std::vector<Vec3> path(points.middle.begin() + static_cast<std::ptrdiff_t>(points.first),
                               points.middle.begin() + static_cast<std::ptrdiff_t>(points.last) + 1);
  Vec3 mean;
  for (Vec3 place : path) mean += place / static_cast<double>(path.size());
  for (Vec3 place : path) add(place - mean);
  Vec3 along = long_axis(xx, xz, zz);
  PointsView view;
  double low = 1e300, high = -1e300;
  for (Vec3 place : path) {
    low = std::min(low, dot(along, place));
    high = std::max(high, dot(along, place));
  }
  view.travels = high - low > 0.6 * std::max(points.height, points.width);
  if (view.travels) {
    if (dot(along, path.back() - path.front()) < 0) along = -along;
    view.from = turned_about_y(cross(along, {0, 1, 0}), 0.33);
    view.travelled = dot(Camera(view.from, 0, 1).right(), path.back() - path.front());
    return view;
  }
  xx = xz = zz = 0;
  for (const auto& track : points.places)
    if (!track.empty()) add(track[points.first] - path.front());
  along = long_axis(xx, xz, zz);
  view.from = cross(along, {0, 1, 0});
  // Which of the two: most people and faces look along +Z, else along +X.
  if (std::abs(view.from.z) > 0.5 ? view.from.z < 0 : view.from.x < 0) view.from = -view.from;
  view.from = turned_about_y(view.from, 0.25);
  return view;
}

}  // namespace kinegraph
