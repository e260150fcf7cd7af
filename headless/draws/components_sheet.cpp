// Components: each as a strip of poses with its signal underneath, and last all of them together.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "headless/draws/camera.h"
#include "headless/draws/component_moments.h"
#include "headless/draws/curves.h"
#include "headless/draws/points_layout.h"
#include "headless/draws/sheets.h"
#include "headless/draws/skeleton_figure.h"
#include "headless/draws/theme.h"
#include "nodes/components/component_meaning.h"
#include "nodes/components/rebuild.h"

namespace kinegraph {
namespace {

constexpr double width = 1200, figure_height = 104, signal_height = 44, inset = 40;

double left_edge() {
  return theme::margin + inset;
}
double right_edge() {
  return width - theme::margin;
}

Points rebuilt(const Components& components, const ComponentSegment& segment,
               const std::vector<std::size_t>& entries, Work& work) {
  const Rows x = channels_from_signals(components, signals_of(components, segment), entries);
  return points_of(components, x, segment, {true, false}, work);
}

std::vector<std::size_t> all_entries(const Components& components) {
  std::vector<std::size_t> all(components.count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

// Of components of points: what all their pictures share.
struct Cloud {
  std::vector<Vec3> mean;  // where each point is without any component
  Vec3 low, high;          // of the mean, and of all components together
  double height = 0;       // of the mean
  std::vector<std::pair<int, int>> links;
  std::vector<Side> sides;
};
Cloud cloud_of(const Components& components, Work& work) {
  Cloud cloud;
  if (components.space.of_motions || components.segments.empty()) return cloud;
  cloud.low = {1e300, 1e300, 1e300};
  cloud.high = -cloud.low;
  const auto include = [&](Vec3 place) {
    for (int axis = 0; axis < 3; ++axis) {
      cloud.low[axis] = std::min(cloud.low[axis], place[axis]);
      cloud.high[axis] = std::max(cloud.high[axis], place[axis]);
    }
  };
  const Points still = rebuilt(components, components.segments.front(), {}, work);
  const int count = static_cast<int>(still.labels.size());
  for (int i = 0; i < count; ++i) {
    cloud.mean.push_back(still.track(i)[0]);
    include(cloud.mean.back());
  }
  cloud.height = cloud.high.y - cloud.low.y;
  for (const ComponentSegment& segment : components.segments) {
    const Points clip = rebuilt(components, segment, all_entries(components), work);
    for (int i = 0; i < count; ++i)
      for (std::size_t t = 0; t < clip.frames; ++t) include(clip.track(i)[t]);
  }
  const Points& first = *components.segments.front().points;
  cloud.links = first.labels != still.labels ? still.links
                : first.links.empty()        ? steady_links(first, bridged(first), 64)
                                             : first.links;
  cloud.sides = sides_of(still.labels);
  return cloud;
}

// From the lowest joint to a head above the highest, over the moments of all components together.
double tallest_of(const Components& components, const std::vector<Moment>& shown, Work& work) {
  double tallest = 0;
  for (std::size_t s = 0; s < components.segments.size(); ++s) {
    const ComponentSegment& segment = components.segments[s];
    if (!segment.motion) return 0;
    const Rows x =
        channels_from_signals(components, signals_of(components, segment), all_entries(components));
    const Motion motion = motion_of(components, x, segment, {true, false}, work);
    const Figure figure(motion.skeleton());
    double highest = 1e-3;
    for (const Moment& moment : shown) {
      if (moment.segment != s) continue;
      const Pose pose = pose_at(motion, moment.own_frame);
      for (int joint : figure.joints())
        highest = std::max(highest, pose.positions[static_cast<std::size_t>(joint)].y + figure.reach(joint));
    }
    tallest = std::max(tallest, highest);
  }
  return tallest;
}

class Painter {
 public:
  Painter(Canvas& canvas, const Components& components, Work& work)
      : canvas_(canvas),
        components_(components),
        work_(work),
        moments_(even_moments(components)),
        cloud_(cloud_of(components, work)),
        tallest_(tallest_of(components, moments_, work)) {}

  // How many times as far from their mean the points of these components are drawn, so that what moves
  // little, as a face does, shows.
  double magnified(const std::vector<std::size_t>& entries) const {
    if (components_.space.of_motions) return 1;
    double farthest = 0;
    for (const ComponentSegment& segment : components_.segments) {
      const Points clip = rebuilt(components_, segment, entries, work_);
      for (std::size_t i = 0; i < cloud_.mean.size(); ++i)
        for (std::size_t t = 0; t < clip.frames; ++t)
          farthest = std::max(farthest, norm(clip.track(static_cast<int>(i))[t] - cloud_.mean[i]));
    }
    double times = 1;
    for (double more : {2.0, 4.0, 8.0})
      if (farthest > 0 && more * farthest < 0.25 * cloud_.height) times = more;
    return times;
  }

  // The moments at which these components are shown.
  std::vector<Moment> moments(const std::vector<std::size_t>& entries) const {
    return entries.size() == 1 ? telling_moments(components_, moments_, entries.front()) : moments_;
  }

  // Poses of these components at the moments, standing on `floor`.
  void strip(const std::vector<std::size_t>& entries, double times, double floor) const {
    const auto shown = moments(entries);
    if (components_.space.of_motions)
      canvas_.fill(
          rectangle(left_edge(), floor - 7, right_edge() - left_edge(), 14),
          Paint::along({0, floor - 7}, {0, floor + 7},
                       {{0, faded(theme::floor, 0.3)}, {0.4, theme::floor}, {1, faded(theme::floor, 0.2)}}));
    for (std::size_t s = 0; s < components_.segments.size(); ++s) {
      const ComponentSegment& segment = components_.segments[s];
      if (!segment.motion) {
        dots(rebuilt(components_, segment, entries, work_), s, shown, times, floor);
        continue;
      }
      const Rows x = channels_from_signals(components_, signals_of(components_, segment), entries);
      figures(motion_of(components_, x, segment, {true, false}, work_), s, shown, floor);
    }
  }

  // Seconds of each segment.
  void time_axes(double y) const {
    for (const ComponentSegment& segment : components_.segments)
      draw_time_axis(canvas_, x_of(segment.start), x_of(segment.end) - 16, y,
                     static_cast<double>(segment.frames()) / components_.fps *
                         (1 - 16 / (x_of(segment.end) - x_of(segment.start))));
  }

  // Signals of these components in a box of signal_height below `top`, segments shaded in turn.
  void signals(const std::vector<std::size_t>& entries, double top, bool named) const {
    const double bottom = top + signal_height;
    for (std::size_t s = 0; s < components_.segments.size(); ++s) {
      const double x0 = x_of(components_.segments[s].start), x1 = x_of(components_.segments[s].end);
      canvas_.fill(rectangle(x0, top, x1 - x0, signal_height), s % 2 ? theme::floor : theme::panel);
      if (named)
        canvas_.text({x0 + 5, bottom + 12},
                     fmt::format("segment {} · {} frames · {:.2f} s", s, components_.segments[s].frames(),
                                 static_cast<double>(components_.segments[s].frames()) / components_.fps),
                     {.size = 9.5, .color = theme::muted});
    }
    double most = 2.5;
    for (std::size_t i : entries)
      for (std::size_t t = 0; t < components_.frames(); ++t)
        most = std::max(most, std::fabs(components_.signals(i, t)));
    const double middle = (top + bottom) / 2, scale = (signal_height / 2 - 3) / most;
    canvas_.stroke(polyline({{left_edge(), middle}, {right_edge(), middle}}), {theme::hairline, 1});
    canvas_.text({left_edge() - 6, top + 9}, fmt::format("{:.1f}", most),
                 {.size = 9, .color = theme::faint, .anchor = Anchor::end});
    canvas_.text({left_edge() - 6, bottom - 1}, fmt::format("−{:.1f}", most),
                 {.size = 9, .color = theme::faint, .anchor = Anchor::end});
    const std::size_t step = std::max<std::size_t>(1, components_.frames() / 1200);
    for (std::size_t i : entries) {
      for (const ComponentSegment& segment : components_.segments) {
        std::vector<Spot> line;
        for (std::size_t t = segment.start; t < segment.end; t += step)
          line.push_back({x_of(t), middle - scale * components_.signals(i, t)});
        if (line.size() > 1) canvas_.stroke(polyline(line), {theme::series(static_cast<int>(i)), 1.5});
      }
    }
    // What the strip above shows, on a component's own line.
    if (entries.size() == 1)
      for (const Moment& moment : moments(entries))
        canvas_.fill(
            ellipse({x_of(moment.frame), middle - scale * components_.signals(entries[0], moment.frame)}, 2.4,
                    2.4),
            theme::series(static_cast<int>(entries[0])));
  }

 private:
  double x_of(std::size_t frame) const {
    return left_edge() + static_cast<double>(frame) / static_cast<double>(components_.frames()) *
                             (right_edge() - left_edge());
  }

  static double x_of(const Moment& moment) {
    return left_edge() + moment.part * (right_edge() - left_edge());
  }

  // All figures from one side, half in front: they face along the page.
  void figures(const Motion& motion, std::size_t segment, const std::vector<Moment>& shown,
               double floor) const {
    const Figure figure(motion.skeleton());
    const Camera camera({-1, 0, 0.35}, 0.12, (figure_height - 8) / (1.04 * tallest_));
    for (const Moment& moment : shown)
      if (moment.segment == segment)
        figure.draw_shadow(canvas_, camera, pose_at(motion, moment.own_frame), {}, {x_of(moment), floor}, 0);
    for (const Moment& moment : shown)
      if (moment.segment == segment)
        figure.draw(canvas_, camera, pose_at(motion, moment.own_frame), {}, {x_of(moment), floor});
  }

  // Points at the moments, `times` as far from their mean as they are, with a line from there.
  void dots(const Points& points, std::size_t segment, const std::vector<Moment>& shown, double times,
            double floor) const {
    const double room = (right_edge() - left_edge()) / static_cast<double>(shown.size()) - 8;
    const double scale =
        std::min((figure_height - 10) / std::max(cloud_.high.y - cloud_.low.y, 1e-6),
                 room / std::max({cloud_.high.x - cloud_.low.x, 0.4 * (cloud_.high.z - cloud_.low.z), 1e-6}));
    const Camera camera({0.25, 0, 1}, 0.05, scale);
    const Vec3 middle = 0.5 * (cloud_.low + cloud_.high);
    for (const Moment& moment : shown) {
      if (moment.segment != segment) continue;
      const auto page = [&](Vec3 place) {
        return Spot{x_of(moment), floor - figure_height / 2} + camera.project(place - middle);
      };
      const auto place = [&](int label) {
        const Vec3 rest = cloud_.mean[static_cast<std::size_t>(label)];
        return rest + times * (points.track(label)[moment.own_frame] - rest);
      };
      for (const auto& [a, b] : cloud_.links)
        canvas_.stroke(polyline({page(place(a)), page(place(b))}), {faded(theme::faint, 0.55), 0.9});
      for (int i = 0; i < static_cast<int>(points.labels.size()); ++i) {
        const Side side = cloud_.sides[static_cast<std::size_t>(i)];
        const bool many = points.labels.size() > 64;
        const Color color = side == Side::middle && many ? theme::left : side_color(side);
        if (points.labels.size() <= 64)
          canvas_.stroke(polyline({page(cloud_.mean[static_cast<std::size_t>(i)]), page(place(i))}),
                         {theme::bad, 1.1});
        canvas_.fill(ellipse(page(place(i)), many ? 1.3 : 1.7, many ? 1.3 : 1.7), color);
      }
    }
  }

  Canvas& canvas_;
  const Components& components_;
  Work& work_;
  std::vector<Moment> moments_;
  Cloud cloud_;
  double tallest_;
};

// "48 % of the variance · 0.86 Hz in segment 0 · moves trunk and arms, farthest RightHand, LeftHand"
std::string caption(const Components& components, std::size_t entry, const std::optional<Cadence>& cadence) {
  std::string text = fmt::format("{:.1f} % of the variance", 100 * components.shares[entry]);
  if (cadence) text += " · " + text_of(*cadence, components);
  if (const std::string what = what_moves(components, entry); !what.empty()) text += " · moves " + what;
  if (!regions_moved_by(components, entry).empty()) {
    const auto moved = moved_by(components, entry);
    for (std::size_t i = 0; i < moved.size() && i < 2; ++i)
      text += (i ? ", " : ", farthest ") + moved[i].label;
  }
  if (!components.unique[entry]) text += " · not unique";
  return text;
}

}  // namespace

Canvas draw_components(const Components& components, const std::string& title) {
  Canvas canvas(width, 140);
  const std::string how =
      components.method == "pca"
          ? "principal components"
          : fmt::format("independent components ({}, {})", components.nonlinearity, components.method);
  const double kept = std::accumulate(components.shares.begin(), components.shares.end(), 0.0);
  double y = theme::draw_title(
      canvas, title,
      fmt::format("{} {} of {} · {:.1f} % of the variance · {}", components.count(), how,
                  name_of(components.space.representation), 100 * kept,
                  components.method == "pca" ? "not rotated"
                  : components.converged     ? fmt::format("found in {} iterations", components.iterations)
                                         : fmt::format("not converged: {:.2g} reached", components.reached)));
  if (components.frames() == 0) return canvas;
  Alone work;
  const Painter painter(canvas, components, work);
  const auto row = [&](const std::string& name, Color color, std::string words,
                       const std::vector<std::size_t>& entries) {
    const double times = painter.magnified(entries);
    if (times > 1) words += fmt::format(" · drawn {:g} times as far from the mean", times);
    canvas.text({theme::margin, y + 14}, name, {.size = 14, .color = color, .bold = true});
    canvas.text({left_edge(), y + 14}, fitted(words, 11, width - 2 * theme::margin - inset),
                {.size = 11, .color = theme::ink});
    painter.strip(entries, times, y + 26 + figure_height);
    painter.signals(entries, y + 40 + figure_height, entries.size() == components.count());
    y += 40 + figure_height + signal_height + 22;
  };
  const auto cadences = cadences_of(components);
  for (std::size_t i = 0; i < components.count(); ++i)
    row(fmt::format("u{}", i + 1), theme::series(static_cast<int>(i)), caption(components, i, cadences[i]),
        {i});
  row("all", theme::ink, "all of them together", all_entries(components));
  painter.time_axes(y - 4);
  canvas.set_height(y + 36);
  return canvas;
}

}  // namespace kinegraph
