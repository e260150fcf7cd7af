// Components: each as a strip of poses with its signal underneath, and last all of them together.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "headless/draws/camera.h"
#include "headless/draws/sheets.h"
#include "headless/draws/skeleton_figure.h"
#include "headless/draws/theme.h"
#include "nodes/components/component_meaning.h"
#include "nodes/components/rebuild.h"

namespace kinegraph {
namespace {

constexpr int moments = 12;
constexpr double width = 1200, figure_height = 104, signal_height = 44, inset = 40;

double left_edge() {
  return theme::margin + inset;
}
double right_edge() {
  return width - theme::margin;
}

// What stands at one moment: the frame of the joined signals, its segment, and the frame of that.
struct Moment {
  std::size_t frame, segment, own_frame;
  double x;  // on the page
};
std::vector<Moment> moments_of(const Components& components) {
  std::vector<Moment> out;
  for (int i = 0; i < moments; ++i) {
    const double part = (i + 0.5) / moments;
    const auto frame = static_cast<std::size_t>(part * static_cast<double>(components.frames()));
    for (std::size_t s = 0; s < components.segments.size(); ++s) {
      const ComponentSegment& segment = components.segments[s];
      if (frame >= segment.start && frame < segment.end)
        out.push_back({frame, s, frame - segment.start, left_edge() + part * (right_edge() - left_edge())});
    }
  }
  return out;
}

class Painter {
 public:
  Painter(Canvas& canvas, const Components& components, Work& work)
      : canvas_(canvas), components_(components), work_(work), moments_(moments_of(components)) {}

  // Poses of these components at the moments, standing on `floor`.
  void strip(const std::vector<std::size_t>& entries, double floor) const {
    canvas_.fill(
        rectangle(left_edge(), floor - 7, right_edge() - left_edge(), 14),
        Paint::along({0, floor - 7}, {0, floor + 7},
                     {{0, faded(theme::floor, 0.3)}, {0.4, theme::floor}, {1, faded(theme::floor, 0.2)}}));
    for (std::size_t s = 0; s < components_.segments.size(); ++s) {
      const ComponentSegment& segment = components_.segments[s];
      const Rows x = channels_from_signals(components_, signals_of(components_, segment), entries);
      if (segment.motion)
        figures(motion_of(components_, x, segment, {true, false}, work_), s, floor);
      else
        dots(points_of(components_, x, segment, {true, false}, work_), s, floor);
    }
  }

  // Signals of these components in a box of signal_height below `top`, segments shaded in turn.
  void signals(const std::vector<std::size_t>& entries, double top, bool named) const {
    const double bottom = top + signal_height;
    const auto x_of = [&](std::size_t frame) {
      return left_edge() + static_cast<double>(frame) / static_cast<double>(components_.frames()) *
                               (right_edge() - left_edge());
    };
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
  }

 private:
  // All figures from one side, half in front: they face along the page.
  void figures(const Motion& motion, std::size_t segment, double floor) const {
    const Figure figure(motion.skeleton());
    const Camera camera({-1, 0, 0.35}, 0.12, (figure_height - 8) / (1.08 * figure.height()));
    for (const Moment& moment : moments_)
      if (moment.segment == segment)
        figure.draw_shadow(canvas_, camera, pose_at(motion, moment.own_frame), {}, {moment.x, floor}, 0);
    for (const Moment& moment : moments_)
      if (moment.segment == segment)
        figure.draw(canvas_, camera, pose_at(motion, moment.own_frame), {}, {moment.x, floor});
  }

  void dots(const Points& points, std::size_t segment, double floor) const {
    Vec3 low{1e300, 1e300, 1e300}, high = -low;
    for (int i = 0; i < static_cast<int>(points.labels.size()); ++i)
      for (std::size_t t = 0; t < points.frames; ++t)
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], points.track(i)[t][axis]);
          high[axis] = std::max(high[axis], points.track(i)[t][axis]);
        }
    const Vec3 middle = 0.5 * (low + high);
    const double room = (right_edge() - left_edge()) / moments - 8;
    const double scale = std::min((figure_height - 10) / std::max(high.y - low.y, 1e-6),
                                  room / std::max(high.x - low.x, 1e-6));
    const Camera camera({0.25, 0, 1}, 0.05, scale);
    for (const Moment& moment : moments_) {
      if (moment.segment != segment) continue;
      const auto spot = [&](int label) {
        return Spot{moment.x, floor - figure_height / 2} +
               camera.project(points.track(label)[moment.own_frame] - middle);
      };
      for (const auto& [a, b] : points.links) canvas_.stroke(polyline({spot(a), spot(b)}), {theme::faint, 1});
      for (int i = 0; i < static_cast<int>(points.labels.size()); ++i)
        canvas_.fill(ellipse(spot(i), 1.7, 1.7), theme::left);
    }
  }

  Canvas& canvas_;
  const Components& components_;
  Work& work_;
  std::vector<Moment> moments_;
};

// "48 % of the variance · 0.86 Hz · moves RightHand, LeftHand, Head"
std::string caption(const Components& components, std::size_t entry) {
  std::string text = fmt::format("{:.1f} % of the variance", 100 * components.shares[entry]);
  if (const auto cadence = cadence_of(components, entry)) text += fmt::format(" · {:.2f} Hz", *cadence);
  const auto moved = moved_by(components, entry);
  for (std::size_t i = 0; i < moved.size() && i < 3; ++i) text += (i ? ", " : " · moves ") + moved[i].label;
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
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < components.count(); ++i) {
    all.push_back(i);
    const std::string name = fmt::format("u{}", i + 1);
    canvas.text({theme::margin, y + 14}, name,
                {.size = 14, .color = theme::series(static_cast<int>(i)), .bold = true});
    canvas.text({left_edge(), y + 14}, fitted(caption(components, i), 11, width - 2 * theme::margin - inset),
                {.size = 11, .color = theme::ink});
    painter.strip({i}, y + 22 + figure_height);
    painter.signals({i}, y + 36 + figure_height, false);
    y += 36 + figure_height + signal_height + 22;
  }
  canvas.text({theme::margin, y + 14}, "all", {.size = 14, .color = theme::ink, .bold = true});
  canvas.text({left_edge(), y + 14}, "all of them together", {.size = 11, .color = theme::ink});
  painter.strip(all, y + 22 + figure_height);
  painter.signals(all, y + 36 + figure_height, true);
  canvas.set_height(y + 36 + figure_height + signal_height + 34);
  return canvas;
}

}  // namespace kinegraph
