#include "headless/draws/strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "headless/draws/contact_bars.h"
#include "headless/draws/scale_bar.h"
#include "headless/draws/skeleton_figure.h"
#include "headless/draws/skin_figure.h"
#include "headless/draws/strip_layout.h"
#include "headless/draws/theme.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

namespace {

constexpr double elevation = 0.2;  // radians above the floor: enough to see where the feet stand

// Everything of a row that must be known before the rows' common scale.
struct Row {
  const StripRow* asked;
  WorldMotion world;
  Figure figure;
  View view;
  double travelled;  // along the view, m
  // Extents of the figures about the followed point, metres on the page: over and under it; left of it in the
  // first moment, right of it in the last.
  double above = 0, below = 0, before = 0, after = 0;
  std::optional<SkinFigure> skin = {};
  double wide = 0;         // a mesh on the page, m, on the mean of the moments
  bool stretched = false;  // some link at some time
};

Pose pose_of(const WorldMotion& world, std::size_t frame) {
  Pose pose;
  for (int joint = 0; joint < world.joints(); ++joint) {
    pose.positions.push_back(world.position(joint)[frame]);
    pose.orientations.push_back(world.orientation(joint)[frame]);
  }
  return pose;
}

Canvas empty_picture(const StripOptions& options) {
  Canvas canvas(options.width, 140);
  theme::draw_title(canvas, options.title, options.subtitle);
  canvas.text({theme::margin, 100}, "There is nothing to draw: the motion has no frames.",
              {.size = 12, .color = theme::muted});
  return canvas;
}

SolidMesh mesh_of(const Row& row, std::size_t frame) {
  const Motion& motion = *row.asked->motion;
  const Character& character = *row.asked->character;
  const double seconds = static_cast<double>(frame) / motion.fps();
  return row.skin->posed(pose_for(character, motion, frame),
                         static_cast<std::size_t>(std::lround(seconds * character.morph_fps)));
}

// Extent of the figures about the followed point, in metres on the page.
void measure(Row& row, const StripLayout& layout, const Camera& unit_camera) {
  for (std::size_t frame : layout.frames) {
    double leftmost = 1e300, rightmost = -1e300;
    // `reach`: what limbs and head stand out beyond the joints; of a mesh every vertex is there.
    const auto include = [&](Vec3 place, double reach) {
      Spot spot = unit_camera.project(place - layout.followed[frame]);
      row.above = std::max(row.above, reach - spot.y);
      row.below = std::max(row.below, reach + spot.y);
      leftmost = std::min(leftmost, spot.x);
      rightmost = std::max(rightmost, spot.x);
      if (frame == layout.frames.front()) row.before = std::max(row.before, reach - spot.x);
      if (frame == layout.frames.back()) row.after = std::max(row.after, reach + spot.x);
    };
    if (row.skin)
      for (Vec3 place : mesh_of(row, frame).positions) include(place, 0.01 * row.figure.height());
    else
      for (int joint : row.figure.joints())
        include(row.world.position(joint)[frame], row.figure.reach(joint));
    row.wide += (rightmost - leftmost) / static_cast<double>(layout.frames.size());
  }
}

void draw_ground(Canvas& canvas, const StripLayout& layout, const Camera& camera, double height, double x0,
                 double x1, double floor_y) {
  double half = std::max(9.0, 0.42 * height * camera.scale() * camera.flattening());
  canvas.fill(
      rectangle(x0, floor_y - half, x1 - x0, 2 * half),
      Paint::along({x0, floor_y - half}, {x0, floor_y + half},
                   {{0, faded(theme::floor, 0.45)}, {0.35, theme::floor}, {1, faded(theme::floor, 0.25)}}));
  if (!layout.to_scale) return;
  // A line across the floor every metre of the path.
  double first = layout.across.front();
  double metre = camera.scale();
  for (double x = first; x <= x1; x += metre)
    canvas.stroke(polyline({{x, floor_y - half}, {x, floor_y + half}}), {rgb(0xffffff, 0.9), 1.4});
  for (double x = first - metre; x >= x0; x -= metre)
    canvas.stroke(polyline({{x, floor_y - half}, {x, floor_y + half}}), {rgb(0xffffff, 0.9), 1.4});
}

void draw_trail(Canvas& canvas, const Row& row, const StripLayout& layout, const Camera& camera, int joint,
                double floor_y, Pen pen) {
  std::size_t frames = row.world.frames();
  std::size_t step = std::max<std::size_t>(1, frames / 600);
  std::vector<Spot> trail;
  for (std::size_t t = 0; t < frames; t += step)
    trail.push_back(Spot{layout.across[t], floor_y} +
                    camera.project(row.world.position(joint)[t] - layout.followed[t]));
  canvas.stroke(polyline(trail), std::move(pen));
}

void draw_contact_marks(Canvas& canvas, const Row& row, const StripLayout& layout, const Camera& camera,
                        std::size_t frame, double floor_y) {
  for (const auto& point : row.asked->contacts->points) {
    if (frame >= point.planted.size() || !point.planted[frame] || point.joint < 0 ||
        point.joint >= row.world.joints())
      continue;
    Vec3 at = point_at(row.world, point.joint, point.local, frame);
    at.y = layout.floor;
    Spot spot = Spot{layout.across[frame], floor_y} + camera.project(at - layout.followed[frame]);
    double r = std::max(3.0, 0.03 * row.figure.height() * camera.scale());
    Color color = point.left ? theme::left : theme::right;
    canvas.fill(ellipse(spot, 1.25 * r, 1.25 * r * 0.45), faded(color, 0.3));
    canvas.stroke(ellipse(spot, 1.25 * r, 1.25 * r * 0.45), {color, 1.1});
  }
}

// log2 of a link's length over its rest length: 1 = twice, -1 = half. 0 for where the body stands and links
// that are nothing at rest.
double stretch_of(const Row& row, int joint, std::size_t frame) {
  const Skeleton& skeleton = row.asked->motion->skeleton();
  const int parent = skeleton.joints[static_cast<std::size_t>(joint)].parent;
  if (parent < 0 || joint == row.figure.body()) return 0;
  const double rest = skeleton.link_length(joint) * skeleton.above_scale;
  const double length = norm(row.world.position(joint)[frame] - row.world.position(parent)[frame]);
  if (rest < 0.005 * row.figure.height() || length < 1e-6 * rest) return 0;
  return logarithm(length / rest) / logarithm(2);
}

bool stretches(const Row& row) {
  for (int joint : row.figure.joints()) {
    if (joint == 0 || !row.asked->motion->translates(joint)) continue;
    for (std::size_t t = 0; t < row.world.frames(); ++t)
      if (std::abs(stretch_of(row, joint, t)) > 0.03) return true;
  }
  return false;
}

// A colour going over to the stretched or squashed one by how much the joint's link is.
Color stretch_tint(const Row& row, int joint, std::size_t frame, Color base) {
  const double stretch = stretch_of(row, joint, frame);
  const double part = std::min(1.0, std::max(0.0, (std::abs(stretch) - 0.03) / 0.97));
  // The root of the part, so that a tenth of a length already shows.
  return mixed(base, stretch > 0 ? theme::stretched : theme::squashed, std::sqrt(part));
}

void draw_skin(Canvas& canvas, const Row& row, const StripLayout& layout, const Camera& camera,
               std::size_t frame, const Spot& at) {
  SolidMesh mesh = mesh_of(row, frame);
  const Skeleton& own = *row.asked->character->skeleton;
  row.skin->color(mesh, [&](int joint) {
    const int moved = joint < 0 ? -1 : row.asked->motion->skeleton().find(own.joints[joint].name);
    if (moved < 0) return clay();
    const Color side = row.figure.side(moved) == Side::middle ? clay() : side_color(row.figure.side(moved));
    // Of a rubber limb the stretch is what counts more.
    const Color tinted = mixed(clay(), side, row.stretched ? 0.22 : 0.45);
    return row.stretched ? stretch_tint(row, moved, frame, tinted) : tinted;
  });
  draw_mesh(canvas, camera, mesh, layout.followed[frame], at);
}

// The time and number of each moment, or of every other, third… one where they stand too close for all.
void draw_moment_labels(Canvas& canvas, const StripLayout& layout, double fps, double y) {
  const auto time_at = [&](std::size_t i) {
    return fmt::format("{:.2f} s", static_cast<double>(layout.frames[i]) / fps);
  };
  const auto has_room = [&](std::size_t step) {
    for (std::size_t i = step; i < layout.frames.size(); i += step) {
      const double gap = std::abs(layout.across[layout.frames[i]] - layout.across[layout.frames[i - step]]);
      if (gap < text_width(time_at(i), 11) + 8) return false;
    }
    return true;
  };
  std::size_t step = 1;
  while (!has_room(step)) ++step;
  for (std::size_t i = 0; i < layout.frames.size(); i += step) {
    const std::size_t frame = layout.frames[i];
    canvas.text({layout.across[frame], y}, time_at(i),
                {.size = 11, .color = theme::ink, .anchor = Anchor::middle});
    canvas.text({layout.across[frame], y + 14}, fmt::format("{}", frame),
                {.size = 9.5, .color = theme::faint, .anchor = Anchor::middle});
  }
}

void draw_row(Canvas& canvas, const Row& row, const StripLayout& layout, const Camera& camera,
              double floor_y) {
  const Motion& motion = *row.asked->motion;
  draw_ground(canvas, layout, camera, row.figure.height(), theme::margin, canvas.width() - theme::margin,
              floor_y);

  // A trail of many steps between two moments is a tangle that tells nothing.
  double between =
      static_cast<double>(motion.frames()) / motion.fps() / static_cast<double>(layout.frames.size());
  bool trails = between < 1.3;
  canvas.begin_clip(theme::margin, 0, canvas.width() - 2 * theme::margin, floor_y + 1000);
  if (between < 3)
    draw_trail(canvas, row, layout, camera, row.figure.body(), floor_y,
               {faded(theme::muted, 0.4), 1.1, {1, 3.5}});
  for (int foot : trails ? row.figure.feet() : std::vector<int>())
    draw_trail(canvas, row, layout, camera, foot, floor_y,
               {faded(row.figure.side(foot) == Side::left ? theme::left : theme::right, 0.5), 1.2});
  if (!layout.travels && trails)
    for (int hand : row.figure.hands())
      draw_trail(canvas, row, layout, camera, hand, floor_y,
                 {faded(row.figure.side(hand) == Side::left ? theme::left : theme::right, 0.28), 1.0});
  canvas.end();

  const auto place_of = [&](std::size_t frame) { return Spot{layout.across[frame], floor_y}; };
  for (std::size_t frame : layout.frames) {
    if (row.skin)
      draw_mesh_shadow(canvas, camera, mesh_of(row, frame), layout.followed[frame], place_of(frame),
                       layout.floor);
    else
      row.figure.draw_shadow(canvas, camera, pose_of(row.world, frame), layout.followed[frame],
                             place_of(frame), layout.floor);
  }
  if (row.asked->contacts)
    for (std::size_t frame : layout.frames) draw_contact_marks(canvas, row, layout, camera, frame, floor_y);
  for (std::size_t frame : layout.frames) {
    if (row.skin) {
      draw_skin(canvas, row, layout, camera, frame, place_of(frame));
      continue;
    }
    Figure::JointColor color;
    if (row.stretched)
      color = [&row, frame](int joint) {
        return stretch_tint(row, joint, frame, side_color(row.figure.side(joint)));
      };
    row.figure.draw(canvas, camera, pose_of(row.world, frame), layout.followed[frame], place_of(frame),
                    color);
  }

  draw_moment_labels(canvas, layout, motion.fps(), floor_y + row.below * camera.scale() + 20);
}

}  // namespace

std::string facts_of(const Motion& motion) {
  double seconds = static_cast<double>(motion.frames()) / motion.fps();
  std::string text = fmt::format("{} frame{} · {:g} fps · {:.2f} s · {} joints", motion.frames(),
                                 motion.frames() == 1 ? "" : "s", std::round(motion.fps() * 1000) / 1000,
                                 seconds, motion.joints());
  if (motion.frames() < 2 || motion.joints() == 0) return text;
  auto world = world_motion(motion);
  int body = Figure(motion.skeleton()).body();
  Vec3 way = world.position(body)[motion.frames() - 1] - world.position(body)[0];
  double metres = norm(Vec3{way.x, 0, way.z});
  text += fmt::format(" · ends {:.2f} m from its start", metres);
  return text;
}

Canvas draw_strips(const std::vector<StripRow>& asked, const StripOptions& options) {
  std::vector<Row> rows;
  for (const auto& row : asked) {
    if (!row.motion || row.motion->frames() == 0 || row.motion->joints() == 0) continue;
    rows.push_back({&row, world_motion(*row.motion), Figure(row.motion->skeleton()), {}, 0});
    if (row.character) rows.back().skin.emplace(*row.character);
    rows.back().stretched = stretches(rows.back());
  }
  if (rows.empty()) return empty_picture(options);

  // One camera direction a row, but all rows travel alike: from the first row's side of its own path.
  double tallest = 0, longest = 0, shortest = 1e300;
  bool travels = true;
  for (auto& row : rows) {
    row.view = best_view(*row.asked->motion, row.world, row.figure);
    travels = travels && row.view.travels;
    tallest = std::max(tallest, row.figure.height());
    auto path = smoothed_path(*row.asked->motion, row.world, row.figure.body());
    Camera camera(row.view.from, elevation, 1);
    row.travelled = camera.project(path.back() - path.front()).x;
    longest = std::max(longest, row.travelled);
    shortest = std::min(shortest, row.travelled);
  }

  double left = theme::margin + 46, right = options.width - theme::margin - 46;
  const double largest = 196, smallest = 96;  // a figure's height on the page
  int count = options.moments > 0 ? options.moments : 10;
  double scale = std::min(largest, 1.62 * (right - left) / std::max(count - 1, 1)) / tallest;
  const bool bars = options.contact_bars && std::any_of(rows.begin(), rows.end(), [](const Row& row) {
                      return row.asked->contacts != nullptr;
                    });
  double least_gap = 1e300;  // never to scale
  auto placed = [&](const Row& row) {
    return place_moments(*row.asked->motion, row.world, row.figure.body(),
                         Camera(row.view.from, elevation, scale), row.view.travels, count, left, right,
                         least_gap);
  };
  // To scale along the path where the figures of every row then neither crowd nor shrink.
  if (travels && !bars && longest > 0) {
    const int usual = count;
    const double usual_scale = scale;
    scale = std::min((right - left) / longest, largest / tallest);
    if (options.moments == 0) count = std::clamp(static_cast<int>(shortest / (0.6 * tallest)) + 1, 1, 12);
    least_gap = 0.5 * tallest * scale;
    bool fits = scale * tallest >= smallest && count >= 7;
    for (const auto& row : rows) fits = fits && placed(row).to_scale;
    if (!fits) {
      count = usual;
      scale = usual_scale;
      least_gap = 1e300;
    }
  }

  Canvas canvas(options.width, 100);
  double y = theme::draw_title(
      canvas, options.title, options.subtitle.empty() ? facts_of(*rows[0].asked->motion) : options.subtitle);
  const bool stretched = std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.stretched; });
  double key = options.width - theme::margin - (stretched ? 330 : 150);
  if (stretched) {
    key = theme::draw_key(canvas, {key, 40}, "stretched", theme::stretched);
    key = theme::draw_key(canvas, {key, 40}, "squashed", theme::squashed);
  }
  key = theme::draw_key(canvas, {key, 40}, "left", theme::left);
  theme::draw_key(canvas, {key, 40}, "right", theme::right);

  double above = 0, below = 0, before = 0, after = 0;
  for (auto& row : rows) {
    measure(row, placed(row), Camera(row.view.from, elevation, 1));
    above = std::max(above, row.above);
    below = std::max(below, row.below);
    before = std::max(before, row.before);
    after = std::max(after, row.after);
  }
  // A jump or a raised arm may need more room than a standing figure; a page taller than wide helps nobody.
  scale = std::min(scale, 0.6 * options.width / (above + below));
  // Nor may an outstretched arm leave it.
  left = std::max(left, theme::margin - 8 + std::min(before * scale, 0.25 * options.width));
  right = std::min(right, options.width - theme::margin + 8 - std::min(after * scale, 0.25 * options.width));
  // Meshes broader than the room between two moments hide each other.
  if (options.moments == 0 && least_gap > 1e299)
    for (const auto& row : rows)
      if (row.skin)
        count =
            std::min(count, std::max(3, static_cast<int>((right - left) / (0.85 * row.wide * scale)) + 1));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& row = rows[i];
    row.below = below;
    Camera camera(row.view.from, elevation, scale);
    if (!row.asked->label.empty()) {
      canvas.text({theme::margin, y + 18}, row.asked->label, {.size = 13, .color = theme::ink, .bold = true});
      if (i > 0 || !options.subtitle.empty())
        canvas.text({theme::margin + text_width(row.asked->label, 13, true) + 12, y + 18},
                    facts_of(*row.asked->motion), {.size = 10.5, .color = theme::muted});
      y += 22;
    }
    double floor_y = y + above * scale + 8;
    draw_row(canvas, row, placed(row), camera, floor_y);
    y = floor_y + below * scale + 44;
    if (bars && row.asked->contacts) {
      y = draw_contact_bars(canvas, *row.asked->contacts, left, right, y + 4);
      y += 16;
    }
  }
  draw_scale_bar(canvas, options.width - theme::margin, 66, scale);
  canvas.set_height(y + 6);
  return canvas;
}

}  // namespace kinegraph
