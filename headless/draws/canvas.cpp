#include "headless/draws/canvas.h"

#include <algorithm>
#include <cmath>

#include "graph/diagnostic.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

Color rgb(std::uint32_t hex, double alpha) {
  return {((hex >> 16) & 255) / 255.0, ((hex >> 8) & 255) / 255.0, (hex & 255) / 255.0, alpha};
}

Color mixed(Color from, Color to, double share) {
  auto mix = [share](double a, double b) { return a + share * (b - a); };
  return {mix(from.r, to.r), mix(from.g, to.g), mix(from.b, to.b), mix(from.a, to.a)};
}

Outline& Outline::move(Spot to) {
  steps_.push_back({'M', {to, {}, {}}});
  return *this;
}
Outline& Outline::line(Spot to) {
  steps_.push_back({'L', {to, {}, {}}});
  return *this;
}
Outline& Outline::curve(Spot first_control, Spot second_control, Spot to) {
  steps_.push_back({'C', {first_control, second_control, to}});
  return *this;
}
Outline& Outline::close() {
  steps_.push_back({'Z', {}});
  return *this;
}

Outline polyline(const std::vector<Spot>& spots, bool closed) {
  Outline outline;
  for (std::size_t i = 0; i < spots.size(); ++i) i == 0 ? outline.move(spots[i]) : outline.line(spots[i]);
  if (closed && !spots.empty()) outline.close();
  return outline;
}

namespace {

// Handle length of the cubic that follows a circle's arc of the angle; 0.5523 for a quarter.
double arc_handle(double angle) {
  auto quarter = sin_cos(angle / 4);
  return 4.0 / 3.0 * quarter.sin / quarter.cos;
}

// Adds the arc from angle `start` over `sweep` (radians, clockwise on the page), in steps of at most a
// quarter circle.
void add_arc(Outline& outline, Spot centre, double radius, double start, double sweep) {
  int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / (pi / 2) - 1e-9)));
  double step = sweep / pieces;
  double handle = arc_handle(step) * radius;
  for (int i = 0; i < pieces; ++i) {
    auto a = sin_cos(start + i * step);
    auto b = sin_cos(start + (i + 1) * step);
    Spot from{centre.x + radius * a.cos, centre.y + radius * a.sin};
    Spot to{centre.x + radius * b.cos, centre.y + radius * b.sin};
    outline.curve({from.x - handle * a.sin, from.y + handle * a.cos},
                  {to.x + handle * b.sin, to.y - handle * b.cos}, to);
  }
}

}  // namespace

Outline rectangle(double x, double y, double width, double height, double corner) {
  corner = std::min({corner, width / 2, height / 2});
  if (corner <= 0) return polyline({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, true);
  Outline outline;
  outline.move({x + corner, y}).line({x + width - corner, y});
  add_arc(outline, {x + width - corner, y + corner}, corner, -pi / 2, pi / 2);
  outline.line({x + width, y + height - corner});
  add_arc(outline, {x + width - corner, y + height - corner}, corner, 0, pi / 2);
  outline.line({x + corner, y + height});
  add_arc(outline, {x + corner, y + height - corner}, corner, pi / 2, pi / 2);
  outline.line({x, y + corner});
  add_arc(outline, {x + corner, y + corner}, corner, pi, pi / 2);
  return outline.close();
}

Outline ellipse(Spot centre, double rx, double ry, double turned) {
  auto turn = sin_cos(turned);
  auto at = [&](double u, double v) {
    return Spot{centre.x + turn.cos * rx * u - turn.sin * ry * v,
                centre.y + turn.sin * rx * u + turn.cos * ry * v};
  };
  const double k = arc_handle(pi / 2);
  Outline outline;
  outline.move(at(1, 0))
      .curve(at(1, k), at(k, 1), at(0, 1))
      .curve(at(-k, 1), at(-1, k), at(-1, 0))
      .curve(at(-1, -k), at(-k, -1), at(0, -1))
      .curve(at(k, -1), at(1, -k), at(1, 0));
  return outline.close();
}

Outline capsule(Spot a, double radius_a, Spot b, double radius_b) {
  Spot along = b - a;
  double length = std::sqrt(along.x * along.x + along.y * along.y);
  if (length <= std::abs(radius_a - radius_b) + 1e-9)
    return radius_a >= radius_b ? ellipse(a, radius_a, radius_a) : ellipse(b, radius_b, radius_b);
  double direction = arc_tangent2(along.y, along.x);
  double lean = arc_cosine((radius_a - radius_b) / length);
  auto top_a = sin_cos(direction + lean);
  auto bottom_b = sin_cos(direction - lean);
  Outline outline;
  outline.move({a.x + radius_a * top_a.cos, a.y + radius_a * top_a.sin});
  add_arc(outline, a, radius_a, direction + lean, 2 * (pi - lean));
  outline.line({b.x + radius_b * bottom_b.cos, b.y + radius_b * bottom_b.sin});
  add_arc(outline, b, radius_b, direction - lean, 2 * lean);
  return outline.close();
}

Paint Paint::along(Spot from, Spot to, std::vector<Stop> stops) {
  Paint paint(Color{});
  paint.from = from;
  paint.to = to;
  paint.stops = std::move(stops);
  return paint;
}

Paint Paint::around(Spot centre, double radius, std::vector<Stop> stops) {
  Paint paint = along(centre, centre, std::move(stops));
  paint.radius = radius;
  return paint;
}

Canvas::Canvas(double width, double height) : width_(width), height_(height) {}

void Canvas::fill(Outline outline, Paint paint) {
  if (!outline.empty())
    marks_.emplace_back(std::in_place_type<Fill>, Fill{std::move(outline), std::move(paint)});
}
void Canvas::stroke(Outline outline, Pen pen) {
  if (!outline.empty())
    marks_.emplace_back(std::in_place_type<Stroke>, Stroke{std::move(outline), std::move(pen)});
}
void Canvas::text(Spot baseline, std::string_view utf8, Lettering lettering) {
  if (!utf8.empty())
    marks_.emplace_back(std::in_place_type<Text>, Text{baseline, std::string(utf8), lettering});
}
void Canvas::image(std::shared_ptr<const Pixels> pixels, double x, double y, double width, double height) {
  if (pixels->width > 0 && pixels->height > 0)
    marks_.emplace_back(std::in_place_type<Image>, Image{std::move(pixels), x, y, width, height});
}
void Canvas::begin_clip(double x, double y, double width, double height) {
  marks_.emplace_back(std::in_place_type<Clip>, Clip{x, y, width, height});
}
void Canvas::begin_group(double opacity) {
  marks_.emplace_back(std::in_place_type<Group>, Group{opacity});
}
void Canvas::end() {
  marks_.emplace_back(std::in_place_type<End>, End{});
}

std::string encoded_picture(const Canvas& canvas, std::string_view path, std::string_view title) {
  if (path.ends_with(".svg")) return canvas.svg(title);
  if (path.ends_with(".png")) return canvas.png();
  throw Failure(
      error("unknown-picture-format", "'" + std::string(path) + "' ends neither in .svg nor in .png")
          .hinting("name the picture FILE.svg or FILE.png"));
}

}  // namespace kinegraph
