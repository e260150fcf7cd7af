// Points: moments in a row with their tails, one of them large with its labels, heights and speeds, and where
// samples are missing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "headless/draws/curves.h"
#include "headless/draws/points_layout.h"
#include "headless/draws/scale_bar.h"
#include "headless/draws/sheets.h"
#include "headless/draws/theme.h"
#include "nodes/motion/fill_gaps.h"

namespace kinegraph {

namespace {

constexpr double width = 1200, strip_height = 190, large_height = 400, large_width = 540;
constexpr std::size_t most_named = 64;  // more labels than that are particles

// Without what stands before a colon in all of them: a subject's name.
std::vector<std::string> short_names(std::vector<std::string> labels) {
  if (labels.empty()) return labels;
  const std::string subject = labels[0].substr(0, labels[0].rfind(':') + 1);
  const bool common = std::all_of(labels.begin(), labels.end(),
                                  [&](const std::string& label) { return label.starts_with(subject); });
  if (common)
    for (std::string& label : labels) label.erase(0, subject.size());
  return labels;
}

class PointsPainter {
 public:
  PointsPainter(Canvas& canvas, const Points& points)
      : canvas_(canvas),
        points_(points),
        bridged_(bridged(points)),
        names_(short_names(points.labels)),
        sides_(sides_of(points.labels)),
        view_(view_of(bridged_)),
        links_(points.links.empty() ? steady_links(points, bridged_, most_named) : points.links) {}

  bool nothing() const { return points_.frames == 0 || bridged_.middle.empty(); }

  bool guessed_links() const { return points_.links.empty() && !links_.empty(); }

  // Moments in a row below `y`; returns the y below them.
  double strip(double y, int wanted) const {
    const double tall = std::max(bridged_.height, 1e-9), broad = std::max(bridged_.width, 1e-9);
    double left = theme::margin + 60, right = width - theme::margin - 60;
    const double largest = strip_height / tall;
    double scale = largest;
    int count = wanted > 0 ? wanted : 9;
    bool to_scale = false;
    if (view_.travels && (right - left) / view_.travelled * tall > 90) {
      scale = std::min(scale, (right - left) / view_.travelled);
      if (wanted <= 0) count = std::clamp(static_cast<int>(view_.travelled / (0.75 * broad)) + 1, 2, 12);
      to_scale = count >= 7 || wanted > 0;
    }
    if (!to_scale) {
      count = wanted > 0 ? wanted : 9;
      scale = std::min(largest, 1.15 * (right - left) / std::max(1, count - 1) / broad);
    }
    const std::size_t span = bridged_.last - bridged_.first;
    count = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(count), span + 1));
    const Camera camera(view_.from, elevation_of_view(), scale);
    struct Moment {
      std::size_t frame;
      Spot at;
    };
    std::vector<Moment> moments;
    double high = -1e300, low = 1e300;
    for (int i = 0; i < count; ++i) {
      const double part = count == 1 ? 0.5 : static_cast<double>(i) / (count - 1);
      const auto frame =
          bridged_.first + static_cast<std::size_t>(std::lround(part * static_cast<double>(span)));
      double x = left + (right - left) * part;
      if (to_scale)
        x = (left + right - scale * view_.travelled) / 2 +
            scale * dot(camera.right(), bridged_.middle[frame] - bridged_.middle[bridged_.first]);
      moments.push_back({frame, {x, 0}});
      for (const auto& track : bridged_.places) {
        if (track.empty()) continue;
        const double over = -camera.project(track[frame] - origin(frame)).y;
        high = std::max(high, over);
        low = std::min(low, over);
      }
    }
    const double base = y + 12 + high;
    if (stands()) ground(base, camera);
    const double seconds = static_cast<double>(points_.frames) / points_.fps / std::max(1, count);
    for (Moment& moment : moments) {
      moment.at.y = base;
      tails(camera, moment.frame, moment.at, std::min(0.3, 0.7 * seconds));
    }
    for (const Moment& moment : moments) {
      dots(camera, moment.frame, moment.at, points_.labels.size() > most_named ? 1.5 : 2.1);
      canvas_.text({moment.at.x, base - low + 26},
                   fmt::format("{:.2f} s", static_cast<double>(moment.frame) / points_.fps),
                   {.size = 11, .color = theme::ink, .anchor = Anchor::middle});
      canvas_.text({moment.at.x, base - low + 40}, fmt::format("{}", moment.frame),
                   {.size = 9.5, .color = theme::faint, .anchor = Anchor::middle});
    }
    draw_scale_bar(canvas_, width - theme::margin, 66, scale);
    return base - low + 56;
  }

  // The moment with the fewest points missing, large, each with its label.
  double large(double y) const {
    std::size_t frame = 0, fewest = points_.labels.size() + 1;
    const std::size_t step = std::max<std::size_t>(1, points_.frames / 400);
    for (std::size_t t = 0; t < points_.frames; t += step) {
      // The middle is preferred: clips begin and end with people who stand and wait.
      const std::size_t at = (t + points_.frames / 2) % points_.frames;
      std::size_t gone = 0;
      for (int i = 0; i < labels(); ++i) gone += points_.is_missing(i, at);
      if (gone < fewest) fewest = gone, frame = at;
    }
    const bool named = points_.labels.size() <= most_named;
    const double column = named ? 128 : 0, room = large_width - 2 * column - 24;
    double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
    const Camera plain(view_.from, elevation_of_view(), 1);
    for (const auto& track : bridged_.places) {
      if (track.empty()) continue;
      const Spot spot = plain.project(track[frame] - origin(frame));
      low_x = std::min(low_x, spot.x), high_x = std::max(high_x, spot.x);
      low_y = std::min(low_y, spot.y), high_y = std::max(high_y, spot.y);
    }
    const double scale =
        std::min(room / std::max(high_x - low_x, 1e-9), (large_height - 30) / std::max(high_y - low_y, 1e-9));
    const Camera camera(view_.from, elevation_of_view(), scale);
    canvas_.text({theme::margin, y + 12},
                 fmt::format("{:.2f} s, frame {}", static_cast<double>(frame) / points_.fps, frame),
                 {.size = 11.5, .color = theme::ink, .bold = true});
    const double top = y + 24;
    const Spot at{theme::margin + large_width / 2 - scale * (low_x + high_x) / 2,
                  top + (large_height - scale * (low_y + high_y)) / 2};
    tails(camera, frame, at, 0.3);
    if (named) names(camera, frame, at, top);
    dots(camera, frame, at, named ? 3 : 2);
    return top + large_height;
  }

  // Heights and speeds over time.
  void curves(double x, double y, double wide) const {
    if (points_.frames < 2) return;
    draw_chart(canvas_, {x, y, wide, 194}, heights());
    draw_chart(canvas_, {x, y + 214, wide, 194}, speeds());
  }

  // Where samples are missing, a bar a gap, in two columns; returns the y below them.
  double gaps(double y) const {
    std::vector<int> holed;
    for (int i = 0; i < labels(); ++i)
      if (!gaps_of(points_, i).empty()) holed.push_back(i);
    if (holed.empty()) return y;
    const std::size_t shown = std::min<std::size_t>(holed.size(), 80);
    canvas_.text({theme::margin, y + 14},
                 fmt::format("missing: {} of {} points{}", holed.size(), labels(),
                             shown < holed.size() ? fmt::format(", the first {} here", shown) : ""),
                 {.size = 11.5, .color = theme::ink, .bold = true});
    const double column = (width - 2 * theme::margin) / 2;
    const std::size_t half = shown > 8 ? (shown + 1) / 2 : shown;
    for (std::size_t k = 0; k < shown; ++k)
      gap_row(holed[k], theme::margin + (k < half ? 0 : column), y + 24 + 12 * static_cast<double>(k % half),
              column);
    y += 24 + 12 * static_cast<double>(half);
    for (std::size_t k = 0; k < shown; k += half)
      draw_time_axis(canvas_, theme::margin + (k ? column : 0) + gap_name,
                     theme::margin + (k ? column : 0) + column - 24, y + 3,
                     static_cast<double>(points_.frames) / points_.fps);
    return y + 40;
  }

 private:
  int labels() const { return static_cast<int>(points_.labels.size()); }
  bool stands() const { return std::abs(bridged_.lowest) < 0.12 * bridged_.height; }
  double elevation_of_view() const { return stands() ? 0.2 : 0.06; }
  // What is put at a moment's place: on the floor where there is one.
  Vec3 origin(std::size_t frame) const {
    Vec3 place = bridged_.middle[frame];
    place.y = stands() ? bridged_.lowest : bridged_.middle[bridged_.first].y;
    return place;
  }

  void ground(double y, const Camera& camera) const {
    const double half = std::max(9.0, 0.42 * bridged_.width * camera.scale() * camera.flattening());
    canvas_.fill(
        rectangle(theme::margin, y - half, width - 2 * theme::margin, 2 * half),
        Paint::along({0, y - half}, {0, y + half},
                     {{0, faded(theme::floor, 0.45)}, {0.35, theme::floor}, {1, faded(theme::floor, 0.25)}}));
  }

  // Where each point has been until now, paler the longer ago; open where it was missing.
  void tails(const Camera& camera, std::size_t frame, Spot at, double seconds) const {
    const auto steps = static_cast<std::size_t>(std::max(1.0, seconds * points_.fps));
    const std::size_t first = frame > steps ? frame - steps : 0;
    constexpr std::size_t pieces = 3;
    for (int i = 0; i < labels(); ++i) {
      const auto& track = bridged_.places[static_cast<std::size_t>(i)];
      if (track.empty()) continue;
      for (std::size_t piece = 0; piece < pieces; ++piece) {
        const std::size_t from = first + (frame - first) * piece / pieces,
                          to = first + (frame - first) * (piece + 1) / pieces;
        std::vector<Spot> line;
        const auto flush = [&] {
          if (line.size() > 1)
            canvas_.stroke(polyline(line), {faded(color(i), 0.16 + 0.2 * static_cast<double>(piece)), 1.1});
          line.clear();
        };
        for (std::size_t t = from; t <= to; ++t) {
          if (points_.is_missing(i, t))
            flush();
          else
            line.push_back(at + camera.project(track[t] - origin(frame)));
        }
        flush();
      }
    }
  }

  void dots(const Camera& camera, std::size_t frame, Spot at, double radius) const {
    const auto spot = [&](int label) {
      return at + camera.project(bridged_.places[static_cast<std::size_t>(label)][frame] - origin(frame));
    };
    const auto is_there = [&](int label) {
      return !bridged_.places[static_cast<std::size_t>(label)].empty();
    };
    for (const auto& [a, b] : links_) {
      if (!is_there(a) || !is_there(b)) continue;
      const bool broken = points_.is_missing(a, frame) || points_.is_missing(b, frame);
      canvas_.stroke(polyline({spot(a), spot(b)}),
                     {broken ? faded(theme::faint, 0.6) : theme::faint, 1.4,
                      broken ? std::vector<double>{2, 3} : std::vector<double>{}});
    }
    std::vector<int> order;
    for (int i = 0; i < labels(); ++i)
      if (is_there(i)) order.push_back(i);
    const auto depth = [&](int label) {
      return camera.depth(bridged_.places[static_cast<std::size_t>(label)][frame] - bridged_.middle[frame]);
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return depth(a) < depth(b); });
    for (int i : order) {
      if (points_.is_missing(i, frame)) {
        canvas_.stroke(ellipse(spot(i), radius + 0.6, radius + 0.6), {theme::bad, 1.1, {1.5, 2}});
        continue;
      }
      const double behind = std::clamp(0.25 - depth(i) / std::max(bridged_.width, 1e-9), 0.0, 0.55);
      canvas_.stroke(ellipse(spot(i), radius, radius), {faded(theme::paper, 0.9), 1.2});
      canvas_.fill(ellipse(spot(i), radius, radius), mixed(color(i), theme::paper, behind));
    }
  }

  // Labels in a column on each side, ordered by height, with a line each to its point.
  void names(const Camera& camera, std::size_t frame, Spot at, double top) const {
    struct Name {
      int label;
      Spot spot;
      double y;
    };
    std::vector<Name> all;
    for (int i = 0; i < labels(); ++i) {
      const auto& track = bridged_.places[static_cast<std::size_t>(i)];
      if (!track.empty()) all.push_back({i, at + camera.project(track[frame] - origin(frame)), 0});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Name& a, const Name& b) { return a.spot.x < b.spot.x; });
    const std::size_t half = (all.size() + 1) / 2;
    for (const bool on_right : {false, true}) {
      std::vector<Name> column(all.begin() + static_cast<std::ptrdiff_t>(on_right ? half : 0),
                               on_right ? all.end() : all.begin() + static_cast<std::ptrdiff_t>(half));
      if (column.empty()) continue;
      std::stable_sort(column.begin(), column.end(),
                       [](const Name& a, const Name& b) { return a.spot.y < b.spot.y; });
      const double gap = std::min(13.0, large_height / static_cast<double>(column.size()));
      // Each as near to its point's height as those above it let it, then all shifted up where they overrun.
      double next = top + 6;
      for (Name& name : column) next = (name.y = std::max(next, name.spot.y)) + gap;
      double most = top + large_height;
      for (auto name = column.rbegin(); name != column.rend(); ++name) {
        name->y = std::min(name->y, most);
        most = name->y - gap;
      }
      const double x = on_right ? theme::margin + large_width - 122 : theme::margin + 122;
      const double size = std::min(10.0, gap - 1.5);
      for (const Name& name : column) {
        canvas_.stroke(polyline({{x + (on_right ? -4 : 4), name.y - 3}, name.spot}), {theme::hairline, 1});
        canvas_.text({x, name.y}, fitted(names_[static_cast<std::size_t>(name.label)], size, 120),
                     {.size = size,
                      .color = points_.is_missing(name.label, frame) ? theme::bad : theme::ink,
                      .anchor = on_right ? Anchor::start : Anchor::end});
      }
    }
  }

  Color color(int label) const {
    const Side side = sides_[static_cast<std::size_t>(label)];
    return side == Side::middle && points_.labels.size() > most_named ? theme::left : side_color(side);
  }

  std::vector<double> times() const {
    std::vector<double> out;
    for (std::size_t t = 0; t < points_.frames; ++t) out.push_back(static_cast<double>(t) / points_.fps);
    return out;
  }

  Chart heights() const {
    const double gap = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> low(points_.frames, gap), mean = low, high = low;
    for (std::size_t t = 0; t < points_.frames; ++t) {
      double sum = 0, count = 0, least = 1e300, most = -1e300;
      for (int i = 0; i < labels(); ++i) {
        if (points_.is_missing(i, t)) continue;
        const double y = points_.track(i)[t].y;
        sum += y, count += 1;
        least = std::min(least, y), most = std::max(most, y);
      }
      if (count > 0) low[t] = least, mean[t] = sum / count, high[t] = most;
    }
    return {"height",
            {"time", "s"},
            {"", "m"},
            {{"highest", theme::series(1), times(), high},
             {"mean", theme::series(6), times(), mean},
             {"lowest", theme::series(0), times(), low}}};
  }

  Chart speeds() const {
    const double gap = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> middle(points_.frames, gap), fastest = middle;
    for (std::size_t t = 1; t < points_.frames; ++t) {
      std::vector<double> all;
      for (int i = 0; i < labels(); ++i)
        if (!points_.is_missing(i, t) && !points_.is_missing(i, t - 1))
          all.push_back(points_.fps * norm(points_.track(i)[t] - points_.track(i)[t - 1]));
      if (all.empty()) continue;
      std::sort(all.begin(), all.end());
      middle[t] = all[all.size() / 2];
      fastest[t] = all.back();
    }
    return {"speed",
            {"time", "s"},
            {"", "m/s"},
            {{"fastest", theme::series(1), times(), fastest}, {"median", theme::series(6), times(), middle}}};
  }

  static constexpr double gap_name = 118;

  void gap_row(int label, double x, double y, double wide) const {
    const double bar = 7.5, x0 = x + gap_name, x1 = x + wide - 24;
    const double frames = static_cast<double>(points_.frames);
    canvas_.text({x0 - 8, y + bar - 0.5}, fitted(names_[static_cast<std::size_t>(label)], 9.5, gap_name - 12),
                 {.size = 9.5, .color = theme::muted, .anchor = Anchor::end});
    canvas_.fill(rectangle(x0, y, x1 - x0, bar, 2), theme::panel);
    for (const Gap& gap : gaps_of(points_, label)) {
      const double from = x0 + (x1 - x0) * static_cast<double>(gap.first) / frames,
                   to = x0 + (x1 - x0) * static_cast<double>(gap.last) / frames;
      canvas_.fill(rectangle(from, y, std::max(1.0, to - from), bar, 1), theme::bad);
    }
  }

  Canvas& canvas_;
  const Points& points_;
  BridgedPoints bridged_;
  std::vector<std::string> names_;
  std::vector<Side> sides_;
  PointsView view_;
  std::vector<std::pair<int, int>> links_;
};

}  // namespace

std::string facts_of(const Points& points) {
  std::string text =
      fmt::format("{} points · {} frames · {:g} fps · {:.2f} s", points.labels.size(), points.frames,
                  std::round(points.fps * 1000) / 1000, static_cast<double>(points.frames) / points.fps);
  const auto missing = std::count(points.missing.begin(), points.missing.end(), true);
  return text + (missing ? fmt::format(" · {} of {} samples missing", missing, points.missing.size())
                         : " · no sample missing");
}

Canvas draw_points(const Points& points, const std::string& title, int moments) {
  Canvas canvas(width, 140);
  const PointsPainter painter(canvas, points);
  double y = theme::draw_title(canvas, title, facts_of(points));
  if (painter.nothing()) {
    canvas.text({theme::margin, 100}, "There is nothing to draw: no point is ever there.",
                {.size = 12, .color = theme::muted});
    return canvas;
  }
  double key = width - theme::margin - 560;
  const auto sides = sides_of(points.labels);
  if (std::find(sides.begin(), sides.end(), Side::left) != sides.end()) {
    key = theme::draw_key(canvas, {key, 40}, "left", theme::left);
    key = theme::draw_key(canvas, {key, 40}, "right", theme::right);
    key = theme::draw_key(canvas, {key, 40}, "neither", theme::centre);
  }
  if (std::find(points.missing.begin(), points.missing.end(), true) != points.missing.end()) {
    canvas.stroke(ellipse({key + 4, 36.2}, 4, 4), {theme::bad, 1.1, {1.5, 2}});
    canvas.text({key + 12, 40}, "missing: where it might be", {.size = 11, .color = theme::muted});
    key += 28 + text_width("missing: where it might be", 11);
  }
  if (painter.guessed_links()) {
    canvas.stroke(polyline({{key, 36.2}, {key + 14, 36.2}}), {theme::faint, 1.4});
    canvas.text({key + 20, 40}, "keep their distance", {.size = 11, .color = theme::muted});
  }
  y = painter.strip(y, moments) + 8;
  const double column = theme::margin + large_width + 24;
  painter.curves(column, y, width - theme::margin - column);
  y = painter.gaps(painter.large(y) + 12);
  canvas.set_height(y + 16);
  return canvas;
}

}  // namespace kinegraph
