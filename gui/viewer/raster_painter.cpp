#include "gui/viewer/raster_painter.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "gui/viewer/flat_shapes.h"
#include "gui/viewer/solid_sheet.h"

namespace kinegraph {
namespace {

// What the camera makes of a point: where on the picture, how far, and how many pixels a metre is there.
struct Projector {
  QMatrix4x4 view, all;
  QRectF where;
  float near_by;
  double scale;

  Projector(const OrbitCamera& camera, const QRectF& part) : where(part) {
    view = camera.view();
    const QMatrix4x4 projection = camera.projection(part.size());
    all = projection * view;
    near_by = std::max(0.01f, camera.distance * 0.02f);
    scale = static_cast<double>(projection(1, 1)) * part.height() / 2;
  }
  float depth(QVector3D p) const { return -view.map(p).z(); }
  bool visible(QVector3D p) const { return depth(p) > near_by; }
  QPointF spot(QVector3D p) const {
    const QVector4D clip = all * QVector4D(p, 1);
    return where.topLeft() + QPointF((clip.x() / clip.w() * 0.5 + 0.5) * where.width(),
                                     (0.5 - clip.y() / clip.w() * 0.5) * where.height());
  }
  double pixels_a_metre(QVector3D p) const { return scale / std::max(near_by, depth(p)); }
};

// The outline of two discs and what lies between.
QPainterPath capsule_path(QPointF a, double ra, QPointF b, double rb) {
  QPainterPath path;
  const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
  if (length <= std::abs(ra - rb) + 1e-6) {
    // By hand, as all outlines must run the same way round to unite into one shadow.
    const QPointF middle = ra > rb ? a : b;
    const double r = std::max(ra, rb);
    path.arcMoveTo(QRectF(middle.x() - r, middle.y() - r, 2 * r, 2 * r), 0);
    path.arcTo(QRectF(middle.x() - r, middle.y() - r, 2 * r, 2 * r), 0, 360);
    return path;
  }
  const QPointF along = (b - a) / length;
  const double cosine = (ra - rb) / length;
  const double tangent = std::acos(cosine) * 57.29577951308232;
  const double direction = std::atan2(-along.y(), along.x()) * 57.29577951308232;
  path.arcMoveTo(QRectF(a.x() - ra, a.y() - ra, 2 * ra, 2 * ra), direction + tangent);
  path.arcTo(QRectF(a.x() - ra, a.y() - ra, 2 * ra, 2 * ra), direction + tangent, 360 - 2 * tangent);
  path.arcTo(QRectF(b.x() - rb, b.y() - rb, 2 * rb, 2 * rb), direction - tangent, 2 * tangent);
  path.closeSubpath();
  return path;
}

// The capsules that the camera sees, and the pixels that they can cover.
QRect seen_capsules(const Projector& eye, const SceneFigure& figure, const OrbitCamera& camera,
                    std::vector<SeenCapsule>& all) {
  QRectF around;
  for (const SceneCapsule& c : figure.capsules) {
    if (!eye.visible(c.a) || !eye.visible(c.b)) continue;
    const QVector3D centre = (c.a + c.b) / 2;
    SeenCapsule seen;
    seen.a = eye.spot(c.a);
    seen.b = eye.spot(c.b);
    seen.radius_a = std::max(0.6, c.radius_a * eye.pixels_a_metre(c.a));
    seen.radius_b = std::max(0.6, c.radius_b * eye.pixels_a_metre(c.b));
    seen.depth_a = eye.depth(c.a);
    seen.depth_b = eye.depth(c.b);
    seen.scale = eye.pixels_a_metre(centre);
    seen.color = c.color;
    seen.toward = (camera.eye() - centre).normalized();
    const double thick = std::max(seen.radius_a, seen.radius_b) + 2;
    around |= QRectF(seen.a, seen.b).normalized().adjusted(-thick, -thick, thick, thick);
    all.push_back(seen);
  }
  return around.intersected(eye.where).toAlignedRect();
}

QVector3D on_floor(QVector3D p, float floor) {
  const QVector3D light = light_way();
  return p - light * ((p.y() - floor) / light.y());
}

// Cuts a line at the plane before the eye; false: nothing of it is seen.
bool cut_before_eye(QVector3D& from, QVector3D& to, const Projector& eye, const OrbitCamera& camera) {
  const QVector3D sight = (camera.target - camera.eye()).normalized();
  const float limit = eye.near_by * 1.01f;
  const float df = QVector3D::dotProduct(from - camera.eye(), sight) - limit;
  const float dt = QVector3D::dotProduct(to - camera.eye(), sight) - limit;
  if (df < 0 && dt < 0) return false;
  if (df < 0) from += (to - from) * (df / (df - dt));
  if (dt < 0) to += (from - to) * (dt / (dt - df));
  return true;
}

QColor between(QRgb from, QRgb to, float share) {
  const auto part = [&](int a, int b) {
    return static_cast<int>(std::lround(static_cast<float>(a) + static_cast<float>(b - a) * share));
  };
  return QColor(part(qRed(from), qRed(to)), part(qGreen(from), qGreen(to)), part(qBlue(from), qBlue(to)));
}

// The ground as discs of ever stronger colour, a step of which isn't seen.
void paint_ground(QPainter& painter, const Projector& eye, QVector3D middle, float reach,
                  const OrbitCamera& camera, const SceneColors& colors) {
  constexpr int rings = 20, corners = 48;
  painter.setPen(Qt::NoPen);
  for (int ring = 0; ring <= rings; ++ring) {
    const float share =
        floor_fades_to - (floor_fades_to - floor_fades_from) * static_cast<float>(ring) / rings;
    QPolygonF polygon;
    const auto rim = [&](int k) {
      const float angle = 6.2831853f * static_cast<float>(k % corners) / corners;
      return middle + share * reach * QVector3D(std::cos(angle), 0, std::sin(angle));
    };
    for (int k = 0; k < corners; ++k) {
      QVector3D from = rim(k), to = rim(k + 1);
      if (cut_before_eye(from, to, eye, camera)) polygon << eye.spot(from) << eye.spot(to);
    }
    painter.setBrush(between(colors.sky, colors.ground, floor_strength(share)));
    painter.drawPolygon(polygon);
  }
}

// The floor's lines along one axis, a step apart: each in pieces, that fade with the way from the middle and
// where lines come nearer together than pixels.
void paint_floor_lines(QPainter& painter, const Projector& eye, QVector3D middle, float reach, float step,
                       float strength, int left_out, const OrbitCamera& camera, QRgb color) {
  constexpr int pieces = 24;
  const int count = static_cast<int>(std::min(90.0f, floor_fades_to * reach / step));
  for (int axis = 0; axis < 2; ++axis) {
    const QVector3D along = axis == 0 ? QVector3D(0, 0, 1) : QVector3D(1, 0, 0);
    const QVector3D aside = axis == 0 ? QVector3D(1, 0, 0) : QVector3D(0, 0, 1);
    const float centre = axis == 0 ? middle.x() : middle.z();
    const int first = static_cast<int>(std::round(centre / step));
    for (int k = -count; k <= count; ++k) {
      if (left_out > 1 && (first + k) % left_out == 0) continue;
      const float away = static_cast<float>(first + k) * step - centre;
      const float half = std::sqrt(std::max(0.0f, reach * reach - away * away));
      for (int piece = 0; piece < pieces; ++piece) {
        // Shorter pieces in the middle, where they are near.
        const auto way = [&](int i) {
          const float t = 2 * static_cast<float>(i) / pieces - 1;
          return half * t * (0.25f + 0.75f * std::abs(t));
        };
        QVector3D from = middle + away * aside + way(piece) * along,
                  to = middle + away * aside + way(piece + 1) * along;
        if (!cut_before_eye(from, to, eye, camera)) continue;
        const QVector3D at = (from + to) / 2;
        const float fade = strength * floor_strength((at - middle).length() / reach);
        if (fade < 0.02f) continue;
        const QPointF a = eye.spot(from), b = eye.spot(to), next = eye.spot(at + step * aside);
        const QPointF line = b - a, across = next - (a + b) / 2;
        const double length = std::hypot(line.x(), line.y());
        if (length < 1e-6) continue;
        const double apart = std::abs(line.x() * across.y() - line.y() * across.x()) / length;
        QColor ink = QColor::fromRgb(color);
        ink.setAlphaF(fade * static_cast<float>(std::clamp(apart / 4, 0.0, 1.0)));
        if (ink.alpha() < 4) continue;
        painter.setPen(QPen(ink, 1, Qt::SolidLine, Qt::FlatCap));
        painter.drawLine(a, b);
      }
    }
  }
}

void paint_floor(QPainter& painter, const Projector& eye, const Scene& scene, const OrbitCamera& camera,
                 const SceneColors& colors) {
  const float reach = floor_reach(camera, scene);
  const QVector3D middle(camera.target.x(), scene.floor, camera.target.z());
  if (camera.eye().y() > scene.floor) paint_ground(painter, eye, middle, reach, camera, colors);
  paint_floor_lines(painter, eye, middle, reach, scene.grid / 4, quarter_lines, 4, camera,
                    colors.ground_line);
  paint_floor_lines(painter, eye, middle, reach, scene.grid, 1, 1, camera, colors.ground_line);
}

// A disc with a ring around it, each in one piece: triangles would show their seams.
void paint_marks(QPainter& painter, const Projector& eye, const Scene& scene) {
  constexpr int corners = 32;
  painter.setPen(Qt::NoPen);
  for (const SceneMark& mark : scene.marks) {
    QPolygonF inside, outside;
    bool whole = true;
    for (int k = 0; k < corners; ++k) {
      const float angle = 6.2831853f * static_cast<float>(k) / corners;
      const QVector3D way = mark.radius * QVector3D(std::cos(angle), 0, std::sin(angle));
      whole = whole && eye.visible(mark.at + way);
      if (!whole) break;
      inside << eye.spot(mark.at + mark_inside * way);
      outside << eye.spot(mark.at + way);
    }
    if (!whole) continue;
    QPainterPath ring;
    ring.addPolygon(outside);
    ring.closeSubpath();
    ring.addPolygon(inside);
    ring.closeSubpath();
    QColor color = QColor::fromRgba(mark.color);
    painter.setBrush(color);
    painter.drawPath(ring);
    color.setAlphaF(color.alphaF() * mark_strength);
    painter.setBrush(color);
    painter.drawPolygon(inside);
  }
}

// All triangles the same way round, so that they unite.
void add_mesh_shadow(QPainterPath& path, const Projector& eye, const PosedMesh& mesh, float floor) {
  const auto at = [&](std::uint32_t v) {
    return on_floor(QVector3D(mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]),
                    floor);
  };
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const QVector3D a = at(mesh.triangles[i]), b = at(mesh.triangles[i + 1]), c = at(mesh.triangles[i + 2]);
    if (!eye.visible(a) || !eye.visible(b) || !eye.visible(c)) continue;
    const QPointF p = eye.spot(a), q = eye.spot(b), r = eye.spot(c);
    const double turn = (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    path.addPolygon(turn > 0 ? QPolygonF{p, q, r, p} : QPolygonF{p, r, q, p});
  }
}

void paint_shadows(QPainter& painter, const Projector& eye, const Scene& scene, const SceneColors& colors) {
  // Winding: what overlaps is darkened once.
  QPainterPath all;
  all.setFillRule(Qt::WindingFill);
  for (const SceneFigure& figure : scene.figures) {
    if (!figure.shadow) continue;
    if (figure.mesh) add_mesh_shadow(all, eye, *figure.mesh, scene.floor);
    for (const SceneCapsule& c : figure.capsules) {
      const QVector3D a = on_floor(c.a, scene.floor), b = on_floor(c.b, scene.floor);
      if (!eye.visible(a) || !eye.visible(b)) continue;
      all.addPath(capsule_path(eye.spot(a), 0.8 * c.radius_a * eye.pixels_a_metre(a), eye.spot(b),
                               0.8 * c.radius_b * eye.pixels_a_metre(b)));
    }
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor::fromRgba(colors.shadow));
  painter.drawPath(all);
}

void paint_flats(QPainter& painter, const Projector& eye, const std::vector<FlatPoint>& points) {
  painter.setPen(Qt::NoPen);
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    QPointF corners[3];
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const QVector3D p(points[i + k].x, points[i + k].y, points[i + k].z);
      whole = whole && eye.visible(p);
      if (whole) corners[k] = eye.spot(p);
    }
    if (!whole) continue;
    const FlatPoint& last = points[i + 2];
    painter.setBrush(QColor(last.r, last.g, last.b, last.a));
    painter.drawPolygon(corners, 3);
  }
}

struct MeshCorner {
  QVector3D at, normal;
  QPointF spot;
};

MeshCorner between(const MeshCorner& a, const MeshCorner& b) {
  return {(a.at + b.at) / 2, (a.normal + b.normal).normalized(), (a.spot + b.spot) / 2};
}

void paint_mesh(QPainter& painter, const Projector& eye, const PosedMesh& mesh, QRgb color, QVector3D from,
                bool smooth) {
  struct Face {
    float depth;
    QPointF corners[3];
    QColor shade;
  };
  std::vector<Face> faces;
  faces.reserve(mesh.triangles.size() / 3);
  const auto vector_at = [](const std::vector<float>& all, std::uint32_t v) {
    return QVector3D(all[3 * v], all[3 * v + 1], all[3 * v + 2]);
  };
  // Large faces in four, until the shading of their corners' normals changes little over each.
  const auto add = [&](const auto& self, const MeshCorner& a, const MeshCorner& b, const MeshCorner& c,
                       int deeper) -> void {
    const auto far = [](QPointF p, QPointF q) { return (p - q).manhattanLength(); };
    if (deeper > 0 && std::max({far(a.spot, b.spot), far(b.spot, c.spot), far(c.spot, a.spot)}) > 9) {
      const MeshCorner ab = between(a, b), bc = between(b, c), ca = between(c, a);
      self(self, a, ab, ca, deeper - 1);
      self(self, ab, b, bc, deeper - 1);
      self(self, ca, bc, c, deeper - 1);
      self(self, ab, bc, ca, deeper - 1);
      return;
    }
    const QVector3D toward = (from - a.at).normalized();
    QVector3D n = (a.normal + b.normal + c.normal).normalized();
    if (QVector3D::dotProduct(n, toward) < 0) n = -n;
    faces.push_back(
        {eye.depth((a.at + b.at + c.at) / 3), {a.spot, b.spot, c.spot}, QColor(lit_color(color, n, toward))});
  };
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    MeshCorner corners[3];
    bool seen = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[i + k];
      corners[k].at = vector_at(mesh.positions, v);
      corners[k].normal = vector_at(mesh.normals, v);
      seen = seen && eye.visible(corners[k].at);
      if (seen) corners[k].spot = eye.spot(corners[k].at);
    }
    if (seen) add(add, corners[0], corners[1], corners[2], smooth ? 3 : 0);
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.depth > b.depth; });
  for (const Face& face : faces) {
    painter.setPen(QPen(face.shade, 0.6));  // closes the seams between antialiased neighbours
    painter.setBrush(face.shade);
    painter.drawPolygon(face.corners, 3);
  }
}

void paint_figure(QPainter& painter, const Projector& eye, const SceneFigure& figure,
                  const OrbitCamera& camera, bool smooth) {
  if (figure.mesh) paint_mesh(painter, eye, *figure.mesh, figure.mesh_color, camera.eye(), smooth);
  std::vector<SeenCapsule> capsules;
  const QRect area = seen_capsules(eye, figure, camera, capsules);
  if (!area.isEmpty()) painter.drawImage(area.topLeft(), solid_sheet(area, capsules, camera.up()));
}

}  // namespace

void paint_scene(QPainter& painter, const QRectF& where, const Scene& scene, const OrbitCamera& camera,
                 const SceneColors& colors, bool smooth) {
  painter.save();
  painter.setClipRect(where, Qt::IntersectClip);
  painter.setRenderHint(QPainter::Antialiasing);
  const Projector eye(camera, where);
  if (scene.has_floor) {
    paint_floor(painter, eye, scene, camera, colors);
    if (camera.eye().y() > scene.floor) paint_shadows(painter, eye, scene, colors);
    paint_marks(painter, eye, scene);
  }
  paint_flats(painter, eye, flat_paths(scene, camera.eye()));
  std::vector<std::pair<float, const SceneFigure*>> order;
  for (const SceneFigure& figure : scene.figures) {
    const QVector3D middle = figure.capsules.empty() ? QVector3D() : figure.capsules.front().a;
    order.emplace_back(eye.depth(middle), &figure);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [depth, figure] : order) {
    if (figure->opacity >= 1) {
      paint_figure(painter, eye, *figure, camera, smooth);
      continue;
    }
    // On a sheet of its own, so that its bones don't shine through each other.
    QImage sheet(where.size().toSize(), QImage::Format_ARGB32_Premultiplied);
    sheet.fill(Qt::transparent);
    {
      QPainter on_sheet(&sheet);
      on_sheet.setRenderHint(QPainter::Antialiasing);
      on_sheet.translate(-where.topLeft());
      paint_figure(on_sheet, eye, *figure, camera, smooth);
    }
    painter.setOpacity(figure->opacity);
    painter.drawImage(where.topLeft(), sheet);
    painter.setOpacity(1);
  }
  painter.restore();
}

QImage paint_raster(const ScenePicture& picture) {
  QImage image(picture.size, QImage::Format_RGB32);
  if (image.isNull()) return image;
  image.fill(picture.colors.sky);
  QPainter painter(&image);
  const auto pixels = [&](const QRectF& part) {
    return QRectF(part.x() * picture.size.width(), part.y() * picture.size.height(),
                  part.width() * picture.size.width(), part.height() * picture.size.height());
  };
  for (const SceneCell& cell : picture.cells) {
    painter.save();
    painter.setClipRect(pixels(cell.clip));
    painter.fillRect(pixels(cell.clip), QColor::fromRgb(picture.colors.sky));
    paint_scene(painter, pixels(cell.where), cell.scene, camera_of(picture, cell), picture.colors,
                picture.smooth);
    painter.restore();
  }
  return image;
}

}  // namespace kinegraph
