#include "headless/draws/mesh_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "headless/draws/theme.h"

namespace kinegraph {

namespace {

constexpr int density = 2;  // pixels a point of the picture, as the PNG has
constexpr int samples = 2;  // across a pixel and down it
constexpr int rim = 2;      // pixels of paper round the shape
constexpr int largest = 4000;

struct Ink {
  float r = 0, g = 0, b = 0, a = 0;
};

struct Corner {
  double x, y, depth;  // sub-pixels from the plate's corner; m
  Vec3 normal;
  Color color;
};

// Sub-pixels of the mesh's own rectangle, nearest surface each.
struct Plate {
  double x0 = 0, y0 = 0;  // of the page
  int width = 0, height = 0;
  std::vector<float> depth;
  std::vector<Ink> color;  // a = 0: nothing

  // The mesh's rectangle on the page with room for the rim; none for a mesh of nothing.
  static std::optional<Plate> around(const std::vector<Corner>& corners) {
    double x0 = 1e300, y0 = 1e300, x1 = -1e300, y1 = -1e300;
    for (const Corner& corner : corners) {
      if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) continue;
      x0 = std::min(x0, corner.x), x1 = std::max(x1, corner.x);
      y0 = std::min(y0, corner.y), y1 = std::max(y1, corner.y);
    }
    if (x0 > x1) return {};
    const double room = (rim + 1.0) / density;
    Plate plate;
    plate.x0 = std::floor(x0 - room);
    plate.y0 = std::floor(y0 - room);
    plate.width = static_cast<int>(std::min<double>(largest, std::ceil(x1 + room - plate.x0) * density));
    plate.height = static_cast<int>(std::min<double>(largest, std::ceil(y1 + room - plate.y0) * density));
    const auto all =
        static_cast<std::size_t>(plate.width * samples) * static_cast<std::size_t>(plate.height * samples);
    plate.depth.assign(all, -std::numeric_limits<float>::infinity());
    plate.color.assign(all, Ink{});
    return plate;
  }
};

// A key light from above left in front of the picture, a weak one from the other side, and the sky.
struct Lights {
  Vec3 up, toward, key, fill, half;
  explicit Lights(const Camera& camera)
      : up(camera.up()),
        toward(cross(camera.right(), camera.up())),
        key(normalized(-0.55 * camera.right() + 0.75 * camera.up() + 0.75 * toward)),
        fill(normalized(0.8 * camera.right() + 0.1 * camera.up() + 0.5 * toward)),
        half(normalized(key + toward)) {}
};

Color lit(Color color, Vec3 normal, const Lights& lights, bool back) {
  double light = 0.50 + 0.11 * dot(normal, lights.up) + 0.52 * std::max(0.0, dot(normal, lights.key)) +
                 0.13 * std::max(0.0, dot(normal, lights.fill));
  // What turns away from the viewer darkens, so that folds and outlines show.
  const double facing = std::max(0.0, dot(normal, lights.toward));
  light *= 0.72 + 0.28 * std::min(1.0, 2.2 * facing);
  if (back) light *= 0.6;
  const double shine = std::max(0.0, dot(normal, lights.half));
  const double spot = shine * shine * shine * shine;
  const double gloss = back ? 0 : 0.10 * spot * spot * spot;
  auto channel = [&](double value) { return std::clamp(value * light * 1.04 + gloss, 0.0, 1.0); };
  return {channel(color.r), channel(color.g), channel(color.b), 1};
}

void fill_triangle(Plate& plate, const Lights& lights, const Corner (&corners)[3], Vec3 flat, bool shaded) {
  const Corner &a = corners[0], &b = corners[1], &c = corners[2];
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 1e-12)) return;
  const int wide = plate.width * samples, tall = plate.height * samples;
  const int x0 = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
  const int x1 = std::min(wide - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
  const int y0 = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
  const int y1 = std::min(tall - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
  const bool back = dot(flat, lights.toward) < 0;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double of_a = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
      const double of_b = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
      const double of_c = 1 - of_a - of_b;
      if (of_a < 0 || of_b < 0 || of_c < 0) continue;
      const auto depth = static_cast<float>(of_a * a.depth + of_b * b.depth + of_c * c.depth);
      const auto at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(wide) + static_cast<std::size_t>(x);
      if (!(depth > plate.depth[at])) continue;
      plate.depth[at] = depth;
      auto blend = [&](double Color::*part) {
        return of_a * a.color.*part + of_b * b.color.*part + of_c * c.color.*part;
      };
      Color color{blend(&Color::r), blend(&Color::g), blend(&Color::b), 1};
      if (shaded) {
        Vec3 normal = normalized(of_a * a.normal + of_b * b.normal + of_c * c.normal);
        if (!(norm(normal) > 0)) normal = normalized(flat);
        color = lit(color, back ? -normal : normal, lights, back);
      }
      plate.color[at] = {static_cast<float>(color.r), static_cast<float>(color.g),
                         static_cast<float>(color.b), 1};
    }
}

// Averages the samples of each pixel.
std::vector<Color> pixels_of(const Plate& plate) {
  std::vector<Color> out(static_cast<std::size_t>(plate.width) * static_cast<std::size_t>(plate.height));
  for (int y = 0; y < plate.height; ++y)
    for (int x = 0; x < plate.width; ++x) {
      Color sum{0, 0, 0, 0};  // premultiplied
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
          const Ink& one = plate.color[static_cast<std::size_t>(y * samples + j) *
                                           static_cast<std::size_t>(plate.width * samples) +
                                       static_cast<std::size_t>(x * samples + i)];
          sum.r += one.r, sum.g += one.g, sum.b += one.b, sum.a += one.a;
        }
      constexpr double share = 1.0 / (samples * samples);
      out[static_cast<std::size_t>(y * plate.width + x)] = {sum.r * share, sum.g * share, sum.b * share,
                                                            sum.a * share};
    }
  return out;
}

// Lays premultiplied paper under what is near the shape.
void add_rim(std::vector<Color>& pixels, int width, int height) {
  const std::vector<Color> shape = pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double most = 0;
      for (int j = -rim; j <= rim; ++j)
        for (int i = -rim; i <= rim; ++i) {
          if (i * i + j * j > rim * rim || x + i < 0 || y + j < 0 || x + i >= width || y + j >= height)
            continue;
          most = std::max(most, shape[static_cast<std::size_t>((y + j) * width + x + i)].a);
        }
      Color& pixel = pixels[static_cast<std::size_t>(y * width + x)];
      const double under = 0.9 * most * (1 - pixel.a);
      pixel = {pixel.r + under, pixel.g + under, pixel.b + under, pixel.a + under};
    }
}

std::uint32_t packed(Color premultiplied) {
  auto byte = [](double share) {
    return static_cast<std::uint32_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  };
  return byte(premultiplied.a) << 24 | byte(premultiplied.r) << 16 | byte(premultiplied.g) << 8 |
         byte(premultiplied.b);
}

void draw(Canvas& canvas, const Camera& camera, const SolidMesh& mesh, Vec3 origin, Spot at, bool shaded,
          double opacity) {
  std::vector<Corner> corners;
  corners.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Spot spot = at + camera.project(mesh.positions[v] - origin);
    corners.push_back(
        {spot.x, spot.y, camera.depth(mesh.positions[v] - origin), mesh.normals[v], mesh.colors[v]});
  }
  auto plate = Plate::around(corners);
  const Lights lights(camera);
  if (!plate) return;
  for (Corner& corner : corners) {
    corner.x = (corner.x - plate->x0) * density * samples;
    corner.y = (corner.y - plate->y0) * density * samples;
  }
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const std::uint32_t* v = mesh.triangles.data() + i;
    const Corner three[3] = {corners[v[0]], corners[v[1]], corners[v[2]]};
    if (!std::isfinite(three[0].x + three[0].y + three[1].x + three[1].y + three[2].x + three[2].y)) continue;
    const Vec3 flat =
        cross(mesh.positions[v[1]] - mesh.positions[v[0]], mesh.positions[v[2]] - mesh.positions[v[0]]);
    fill_triangle(*plate, lights, three, flat, shaded);
  }
  auto colors = pixels_of(*plate);
  if (shaded) add_rim(colors, plate->width, plate->height);
  auto pixels = std::make_shared<Pixels>();
  pixels->width = plate->width;
  pixels->height = plate->height;
  for (Color& color : colors)
    pixels->argb.push_back(
        packed({opacity * color.r, opacity * color.g, opacity * color.b, opacity * color.a}));
  canvas.image(std::move(pixels), plate->x0, plate->y0, static_cast<double>(plate->width) / density,
               static_cast<double>(plate->height) / density);
}

}  // namespace

void draw_mesh(Canvas& canvas, const Camera& camera, const SolidMesh& mesh, Vec3 origin, Spot at) {
  draw(canvas, camera, mesh, origin, at, true, 1);
}

void draw_mesh_flat(Canvas& canvas, const Camera& camera, const SolidMesh& mesh, Vec3 origin, Spot at,
                    Color color) {
  SolidMesh plain = mesh;
  plain.colors.assign(mesh.positions.size(), {color.r, color.g, color.b, 1});
  draw(canvas, camera, plain, origin, at, false, color.a);
}

}  // namespace kinegraph
