#include "gui/viewer/raster_painter.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "gui/viewer/flat_shapes.h"

namespace kinegraph {
namespace {

const QVector3D light = QVector3D(0.45f, 1.0f, 0.35f).normalized();

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

QColor shaded(QRgb base, double light_share) {
  const double f = light_share;
  const auto part = [&](int c) { return std::clamp(static_cast<int>(c * f), 0, 255); };
  return QColor(part(qRed(base)), part(qGreen(base)), part(qBlue(base)));
}

void paint_capsule(QPainter& painter, const Projector& eye, const SceneCapsule& c) {
  if (!eye.visible(c.a) || !eye.visible(c.b)) return;
  const QPointF a = eye.spot(c.a), b = eye.spot(c.b);
  const double ra = std::max(0.6, c.radius_a * eye.pixels_a_metre(c.a));
  const double rb = std::max(0.6, c.radius_b * eye.pixels_a_metre(c.b));
  const double thick = std::max(ra, rb);
  // Lit across, from the upper left of the picture: a gradient stands for the roundness.
  QPointF along = b - a;
  const double length = std::hypot(along.x(), along.y());
  along = length > 1e-6 ? along / length : QPointF(1, 0);
  QPointF across(-along.y(), along.x());
  if (across.x() * -0.4 + across.y() * -1.0 < 0) across = -across;
  const QPointF middle = (a + b) / 2;
  QLinearGradient gradient(middle + across * thick, middle - across * thick);
  gradient.setColorAt(0, shaded(c.color, 0.95));
  gradient.setColorAt(0.3, shaded(c.color, 1.05));
  gradient.setColorAt(1, shaded(c.color, 0.5));
  painter.setPen(Qt::NoPen);
  painter.setBrush(gradient);
  painter.drawPath(capsule_path(a, ra, b, rb));
}

QVector3D on_floor(QVector3D p, float floor) {
  return p - light * ((p.y() - floor) / light.y());
}

void paint_floor(QPainter& painter, const Projector& eye, const Scene& scene, const OrbitCamera& camera,
                 const SceneColors& colors) {
  const float reach = camera.distance * 3 + 4 * scene.grid;
  const QVector3D middle(camera.target.x(), scene.floor, camera.target.z());
  const QVector3D sight = (camera.target - camera.eye()).normalized();
  // Cut at the plane before the eye.
  const auto cut = [&](QVector3D& from, QVector3D& to) {
    const float limit = eye.near_by * 1.01f;
    const float df = QVector3D::dotProduct(from - camera.eye(), sight) - limit;
    const float dt = QVector3D::dotProduct(to - camera.eye(), sight) - limit;
    if (df < 0 && dt < 0) return false;
    if (df < 0) from += (to - from) * (df / (df - dt));
    if (dt < 0) to += (from - to) * (dt / (dt - df));
    return true;
  };
  // The ground as rings that fade into the sky.
  if (camera.eye().y() > scene.floor) {
    painter.setPen(Qt::NoPen);
    constexpr int rings = 5, corners = 40;
    for (int ring = rings; ring >= 1; --ring) {
      QPolygonF polygon;
      const float radius = reach * static_cast<float>(ring) / rings;
      std::vector<QVector3D> rim;
      for (int k = 0; k < corners; ++k) {
        const float angle = 6.2831853f * static_cast<float>(k) / corners;
        rim.push_back(middle + radius * QVector3D(std::cos(angle), 0, std::sin(angle)));
      }
      for (int k = 0; k < corners; ++k) {
        QVector3D from = rim[static_cast<std::size_t>(k)],
                  to = rim[static_cast<std::size_t>((k + 1) % corners)];
        if (!cut(from, to)) continue;
        polygon << eye.spot(from) << eye.spot(to);
      }
      QColor ground = QColor::fromRgb(colors.ground);
      ground.setAlphaF(0.45f);
      painter.setBrush(ground);
      painter.drawPolygon(polygon);
    }
  }
  const int count = static_cast<int>(std::min(60.0f, reach / scene.grid));
  for (int k = -count; k <= count; ++k)
    for (int axis = 0; axis < 2; ++axis) {
      const float x = (std::round(middle.x() / scene.grid) + static_cast<float>(k)) * scene.grid;
      const float z = (std::round(middle.z() / scene.grid) + static_cast<float>(k)) * scene.grid;
      const float away = axis == 0 ? x - middle.x() : z - middle.z();
      const float half = std::sqrt(std::max(0.0f, reach * reach - away * away));
      QVector3D from = axis == 0 ? QVector3D(x, scene.floor, middle.z() - half)
                                 : QVector3D(middle.x() - half, scene.floor, z);
      QVector3D to = axis == 0 ? QVector3D(x, scene.floor, middle.z() + half)
                               : QVector3D(middle.x() + half, scene.floor, z);
      if (!cut(from, to)) continue;
      QColor line = QColor::fromRgb(colors.ground_line);
      line.setAlphaF(std::clamp(1 - std::abs(away) / reach, 0.0f, 1.0f));
      painter.setPen(QPen(line, 1));
      painter.drawLine(eye.spot(from), eye.spot(to));
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

void paint_mesh(QPainter& painter, const Projector& eye, const PosedMesh& mesh, QRgb color, QVector3D from) {
  struct Face {
    float depth;
    QPointF corners[3];
    double shade;
  };
  std::vector<Face> faces;
  faces.reserve(mesh.triangles.size() / 3);
  const auto at = [&](std::uint32_t v) {
    return QVector3D(mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]);
  };
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const QVector3D a = at(mesh.triangles[i]), b = at(mesh.triangles[i + 1]), c = at(mesh.triangles[i + 2]);
    if (!eye.visible(a) || !eye.visible(b) || !eye.visible(c)) continue;
    const QVector3D n = QVector3D::crossProduct(b - a, c - a).normalized();
    const QVector3D toward = (from - a).normalized();
    const float facing = QVector3D::dotProduct(n, toward);
    const float key = std::max(0.0f, QVector3D::dotProduct(facing < 0 ? -n : n, light));
    faces.push_back({eye.depth((a + b + c) / 3),
                     {eye.spot(a), eye.spot(b), eye.spot(c)},
                     0.4 + 0.45 * key + 0.2 * std::abs(facing)});
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.depth > b.depth; });
  for (const Face& face : faces) {
    const QColor shade = shaded(color, face.shade);
    painter.setPen(QPen(shade, 0.6));  // closes the seams between antialiased neighbours
    painter.setBrush(shade);
    painter.drawPolygon(face.corners, 3);
  }
}

void paint_figure(QPainter& painter, const Projector& eye, const SceneFigure& figure, QVector3D from) {
  if (figure.mesh) paint_mesh(painter, eye, *figure.mesh, figure.mesh_color, from);
  std::vector<std::pair<float, const SceneCapsule*>> order;
  for (const SceneCapsule& c : figure.capsules)
    order.emplace_back(eye.depth((c.a + c.b) / 2) - std::max(c.radius_a, c.radius_b), &c);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [depth, c] : order) paint_capsule(painter, eye, *c);
}

}  // namespace

void paint_scene(QPainter& painter, const QRectF& where, const Scene& scene, const OrbitCamera& camera,
                 const SceneColors& colors) {
  painter.save();
  painter.setClipRect(where, Qt::IntersectClip);
  painter.setRenderHint(QPainter::Antialiasing);
  const Projector eye(camera, where);
  if (scene.has_floor) {
    paint_floor(painter, eye, scene, camera, colors);
    if (camera.eye().y() > scene.floor) paint_shadows(painter, eye, scene, colors);
    paint_flats(painter, eye, flat_marks(scene));
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
      paint_figure(painter, eye, *figure, camera.eye());
      continue;
    }
    // On a sheet of its own, so that its bones don't shine through each other.
    QImage sheet(where.size().toSize(), QImage::Format_ARGB32_Premultiplied);
    sheet.fill(Qt::transparent);
    {
      QPainter on_sheet(&sheet);
      on_sheet.setRenderHint(QPainter::Antialiasing);
      on_sheet.translate(-where.topLeft());
      paint_figure(on_sheet, eye, *figure, camera.eye());
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
    paint_scene(painter, pixels(cell.where), cell.scene, camera_of(picture, cell), picture.colors);
    painter.restore();
  }
  return image;
}

}  // namespace kinegraph
