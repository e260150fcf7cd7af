#include "headless/draws/character_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "headless/draws/scale_bar.h"
#include "headless/draws/skin_figure.h"
#include "headless/draws/theme.h"

namespace kinegraph {

namespace {

constexpr double width = 1200, tallest = 300, between = 26;

// One picture of the character.
struct Look {
  SolidMesh mesh;
  Camera camera;  // of scale 1
  std::string caption, below;
  Spot low{1e300, 1e300}, high{-1e300, -1e300};  // metres on the page

  Look(SolidMesh posed, Camera seen, std::string words, std::string more)
      : mesh(std::move(posed)), camera(seen), caption(std::move(words)), below(std::move(more)) {
    for (Vec3 place : mesh.positions) {
      const Spot spot = camera.project(place);
      low = {std::min(low.x, spot.x), std::min(low.y, spot.y)};
      high = {std::max(high.x, spot.x), std::max(high.y, spot.y)};
    }
  }
};

constexpr double elevation = 0.12;

std::vector<Look> sides_of(const Character& character, const SkinFigure& figure) {
  const Pose rest = rest_pose_of(*character.skeleton);
  std::vector<Look> out;
  const std::pair<const char*, Vec3> sides[] = {
      {"front", {0, 0, 1}}, {"half left", {1, 0, 1}}, {"left", {1, 0, 0}}, {"back", {0, 0, -1}}};
  for (const auto& [name, from] : sides)
    out.emplace_back(figure.posed(rest), Camera(from, elevation, 1), name, "");
  return out;
}

std::vector<Look> moments_of(const Character& character, const SkinFigure& figure, int count) {
  std::size_t frames = 0;
  for (const MorphTrack& track : character.morph_tracks) frames = std::max(frames, track.weights.size());
  const Pose rest = rest_pose_of(*character.skeleton);
  std::vector<Look> out;
  count = static_cast<int>(std::min<std::size_t>(frames, static_cast<std::size_t>(count > 0 ? count : 8)));
  for (int i = 0; i < count; ++i) {
    const auto frame =
        count == 1 ? 0
                   : static_cast<std::size_t>(
                         std::lround(static_cast<double>(i) * static_cast<double>(frames - 1) / (count - 1)));
    out.emplace_back(
        figure.posed(rest, frame), Camera({0.45, 0, 1}, elevation, 1),
        fmt::format("{:.2f} s", static_cast<double>(frame) / std::max(character.morph_fps, 1e-9)),
        fmt::format("{}", frame));
  }
  return out;
}

// Morphed parts by how far a vertex is from where it rests: what moves shows.
void color_by_displacement(std::vector<Look>& looks, const SolidMesh& rest) {
  double most = 0;
  for (const Look& look : looks)
    for (std::size_t v = 0; v < rest.positions.size(); ++v)
      most = std::max(most, norm(look.mesh.positions[v] - rest.positions[v]));
  if (!(most > 0)) return;
  for (Look& look : looks)
    for (std::size_t v = 0; v < rest.positions.size(); ++v)
      look.mesh.colors[v] =
          mixed(clay(), theme::right, 0.85 * norm(look.mesh.positions[v] - rest.positions[v]) / most);
}

}  // namespace

std::string facts_of(const Character& character) {
  std::size_t vertices = 0, triangles = 0, morphs = 0;
  for (const MeshPart& part : character.parts) {
    vertices += part.vertices();
    triangles += part.triangles.size() / 3;
    morphs += part.morphs.size();
  }
  std::string text =
      fmt::format("{} {} · {} vertices · {} triangles · {} {}", character.parts.size(),
                  character.parts.size() == 1 ? "mesh" : "meshes", vertices, triangles,
                  character.skeleton->size(), character.skeleton->size() == 1 ? "joint" : "joints");
  if (morphs) text += fmt::format(" · {} morph targets", morphs);
  return text;
}

Canvas draw_character(const Character& character, const std::string& title, int moments) {
  Canvas canvas(width, 140);
  const bool moves = !character.morph_tracks.empty();
  double y = theme::draw_title(
      canvas, title, facts_of(character) + (moves ? " · the redder, the farther from rest" : " · at rest"));
  const SkinFigure figure(character);
  auto looks = moves ? moments_of(character, figure, moments) : sides_of(character, figure);
  std::erase_if(looks, [](const Look& look) { return look.low.x > look.high.x; });
  if (looks.empty()) {
    canvas.text({theme::margin, 100}, "There is nothing to draw: the character has no mesh.",
                {.size = 12, .color = theme::muted});
    return canvas;
  }
  if (moves) color_by_displacement(looks, figure.posed(rest_pose_of(*character.skeleton)));

  double wide = 0, high = -1e300, low = 1e300;  // metres
  for (const Look& look : looks) {
    wide += look.high.x - look.low.x;
    high = std::max(high, look.high.y);
    low = std::min(low, look.low.y);
  }
  const double room = width - 2 * theme::margin - between * static_cast<double>(looks.size() - 1);
  const double scale = std::min(room / wide, tallest / std::max(high - low, 1e-9));
  double x = theme::margin + (room - scale * wide) / 2;
  for (Look& look : looks) {
    const Camera camera(cross(look.camera.right(), look.camera.up()), elevation, scale);
    draw_mesh(canvas, camera, look.mesh, {}, {x - scale * look.low.x, y + 10 - scale * low});
    const double middle = x + scale * (look.high.x - look.low.x) / 2,
                 line = y + 10 + scale * (high - low) + 20;
    canvas.text({middle, line}, look.caption, {.size = 11, .color = theme::ink, .anchor = Anchor::middle});
    canvas.text({middle, line + 14}, look.below,
                {.size = 9.5, .color = theme::faint, .anchor = Anchor::middle});
    x += scale * (look.high.x - look.low.x) + between;
  }
  draw_scale_bar(canvas, width - theme::margin, 66, scale);
  canvas.set_height(y + 10 + scale * (high - low) + 48);
  return canvas;
}

}  // namespace kinegraph
