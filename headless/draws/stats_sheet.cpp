#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "headless/draws/curves.h"
#include "headless/draws/sheets.h"
#include "headless/draws/skeleton_figure.h"
#include "headless/draws/theme.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// σ of a joint as a turn in degrees: quaternion space keeps the half angle, Euler space one σ a DOF.
double spread_degrees(const Stats& stats, const JointStats& joint) {
  if (stats.space == "euler") {
    const auto& s = joint.euler_spread;
    return degrees_per_radian * std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
  }
  return 2 * degrees_per_radian * joint.spread;
}

Quat mean_of(const Stats& stats, const JointStats& joint) {
  return stats.space == "euler" ? from_euler(joint.order, joint.euler_mean.data()) : joint.mean;
}

std::string angle_cell(double degrees) {
  return fmt::format("{:.1f}°", degrees);
}

void draw_mean_pose(Canvas& canvas, const Stats& stats, double x, double y, double width, double height,
                    double largest) {
  Skeleton skeleton;
  for (std::size_t i = 0; i < stats.joints.size(); ++i)
    skeleton.joints.push_back({stats.joints[i].joint, stats.parents[i], stats.offsets[i], stats.rests[i]});
  auto motion = Motion(std::make_shared<Skeleton>(skeleton), std::make_shared<SourceFacts>(), stats.fps, 1,
                       std::vector<bool>(stats.joints.size(), false));
  for (std::size_t i = 0; i < stats.joints.size(); ++i)
    motion.rotation(static_cast<int>(i))
        .set(0, stats.joints[i].chosen ? mean_of(stats, stats.joints[i]) : stats.rests[i]);
  Pose pose = pose_at(motion, 0);
  Figure figure(skeleton);
  auto warmth = [&](int joint) {
    double share = largest > 0 ? std::sqrt(spread_degrees(stats, stats.joints[joint]) / largest) : 0;
    return mixed(rgb(0x7f93a8), rgb(0xd9432f), std::clamp(share, 0.0, 1.0));
  };
  double low = 1e300, high = -1e300;
  for (Vec3 p : pose.positions) low = std::min(low, p.y), high = std::max(high, p.y);
  double tall = std::max(high - low, 0.5 * figure.height()) + 0.16 * figure.height();
  double scale = std::min((height - 40) / tall, width / 2 / (0.9 * figure.height()));
  Vec3 origin{pose.positions[0].x, low, pose.positions[0].z};
  const char* names[] = {"front", "side"};
  Vec3 from[] = {{0.35, 0, 1}, {-1, 0, 0.12}};
  for (int i = 0; i < 2; ++i) {
    Camera camera(from[i], 0.1, scale);
    Spot at{x + width * (0.25 + 0.5 * i), y + height - 42};
    figure.draw_shadow(canvas, camera, pose, origin, at, low - 0.02 * figure.height());
    figure.draw(canvas, camera, pose, origin, at, warmth);
    canvas.text({at.x, y + height - 6}, names[i],
                {.size = 10.5, .color = theme::muted, .anchor = Anchor::middle});
  }
}

// Four gauges: mean as a dot, one σ to each side as a bar, zero marked.
void draw_root(Canvas& canvas, const Stats& stats, double x, double y, double width) {
  const char* names[] = {"sideways", "forwards", "height", "turning"};
  const char* units[] = {"m/s", "m/s", "m", "°/s"};
  for (int i = 0; i < 4; ++i) {
    double unit = i == 3 ? degrees_per_radian : 1;
    double mean = stats.root_mean[i] * unit, spread = stats.root_spread[i] * unit;
    double low = std::min(0.0, mean - 1.4 * spread), high = std::max(0.0, mean + 1.4 * spread);
    if (high - low < 1e-6) low = -1, high = 1;
    double x0 = x + 74, x1 = x + width - 128;
    auto place = [&](double value) { return x0 + (x1 - x0) * (value - low) / (high - low); };
    double row = y + 26 * i;
    canvas.text({x0 - 12, row + 4}, names[i], {.size = 11, .color = theme::ink, .anchor = Anchor::end});
    canvas.stroke(polyline({{x0, row}, {x1, row}}), {theme::hairline, 1.5});
    canvas.stroke(polyline({{place(0), row - 7}, {place(0), row + 7}}), {theme::faint, 1});
    canvas.fill(rectangle(place(mean - spread), row - 4, place(mean + spread) - place(mean - spread), 8, 4),
                faded(theme::good, 0.35));
    canvas.fill(ellipse({place(mean), row}, 4.5, 4.5), theme::good);
    canvas.text({x1 + 14, row + 4}, fmt::format("{:.2f} ± {:.2f} {}", mean, spread, units[i]),
                {.size = 10.5, .color = theme::muted});
  }
}

}  // namespace

Canvas draw_stats(const Stats& stats, const std::string& title) {
  const double row = 16;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < stats.joints.size(); ++i)
    if (stats.joints[i].chosen) shown.push_back(i);
  double largest = 0;
  for (std::size_t i : shown) largest = std::max(largest, spread_degrees(stats, stats.joints[i]));

  Canvas canvas(1080, 100);
  double y = theme::draw_title(
      canvas, title,
      fmt::format("{} · {} frames · {:g} fps · {} joints · leg length {:.3f} m",
                  stats.space == "euler" ? "each Euler angle by itself"
                                         : fmt::format("{} space · {} mean", stats.space, stats.mean_kind),
                  stats.frames, stats.fps, shown.size(), stats.leg_length));
  bool posed = stats.parents.size() == stats.joints.size() && stats.offsets.size() == stats.joints.size() &&
               stats.rests.size() == stats.joints.size() && !stats.joints.empty();
  const double left = theme::margin, column = 400;
  canvas.text({left, y + 14}, "Mean pose, warmer where it moves more",
              {.size = 12.5, .color = theme::ink, .bold = true});
  if (posed) draw_mean_pose(canvas, stats, left, y + 24, column, 330, largest);
  canvas.text({left, y + 388}, "The root: mean and spread",
              {.size = 12.5, .color = theme::ink, .bold = true});
  draw_root(canvas, stats, left, y + 412, column);

  double x = left + column + 40, names = 128, numbers = 70,
         bars = canvas.width() - theme::margin - x - names - numbers;
  canvas.text({x, y + 14}, "Spread of each joint about its mean",
              {.size = 12.5, .color = theme::ink, .bold = true});
  canvas.text({canvas.width() - theme::margin, y + 14}, "σ as a turn",
              {.size = 10.5, .color = theme::muted, .anchor = Anchor::end});
  double top = y + 28;
  auto ticks = round_ticks(0, std::max(largest, 1.0), 5);
  double bottom = top + row * static_cast<double>(shown.size());
  auto place = [&](double degrees) { return x + names + bars * degrees / std::max(largest, 1.0); };
  for (double tick : ticks) {
    canvas.stroke(polyline({{place(tick), top}, {place(tick), bottom}}), {theme::hairline, 1});
    canvas.text({place(tick), bottom + 14}, fmt::format("{:g}°", tick),
                {.size = 10, .color = theme::muted, .anchor = Anchor::middle});
  }
  std::vector<Side> sides;
  Skeleton skeleton;
  if (posed) {
    for (std::size_t i = 0; i < stats.joints.size(); ++i)
      skeleton.joints.push_back({stats.joints[i].joint, stats.parents[i], stats.offsets[i], stats.rests[i]});
    Figure figure(skeleton);
    for (std::size_t i = 0; i < stats.joints.size(); ++i) sides.push_back(figure.side(static_cast<int>(i)));
  }
  for (std::size_t line = 0; line < shown.size(); ++line) {
    const auto& joint = stats.joints[shown[line]];
    double at = top + row * static_cast<double>(line);
    Side side = sides.empty() ? Side::middle : sides[shown[line]];
    Color color = side == Side::left ? theme::left : side == Side::right ? theme::right : theme::centre;
    double degrees = spread_degrees(stats, joint);
    canvas.text({x + names - 10, at + 11.5}, fitted(joint.joint, 10.5, names - 12),
                {.size = 10.5, .color = theme::ink, .anchor = Anchor::end});
    canvas.fill(rectangle(x + names, at + 2.5, std::max(1.0, place(degrees) - x - names), row - 5, 3), color);
    canvas.text({canvas.width() - theme::margin, at + 11.5}, angle_cell(degrees),
                {.size = 10.5, .color = theme::muted, .anchor = Anchor::end});
  }
  canvas.set_height(std::max(bottom + 28, y + 412 + 4 * 26) + 12);
  return canvas;
}

}  // namespace kinegraph
