#include "gui/viewer/solid_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinegraph {
namespace {

struct V3 {
  float x, y, z;
};
float dot(V3 a, V3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Where a ray straight into the picture first meets a rod with two balls as its ends: pixels towards the eye,
// and the normal there. The ends, their difference and what follows from these are the same for all rays.
class Rod {
 public:
  Rod(V3 a, float ra, V3 b, float rb) : a_(a), b_(b), ra_(ra), rb_(rb) {
    ba_ = {b.x - a.x, b.y - a.y, b.z - a.z};
    rr_ = ra - rb;
    m0_ = dot(ba_, ba_);
    m2_ = -ba_.z;
    d2_ = m0_ - rr_ * rr_;
    k2_ = d2_ - m2_ * m2_;
  }

  bool meets(float x, float y, float& z, V3& normal) const {
    const V3 oa{x - a_.x, y - a_.y, -a_.z};
    const float m1 = dot(ba_, oa), m3 = -oa.z, m5 = dot(oa, oa);
    if (d2_ > 1e-6f && k2_ > 1e-6f) {  // else one ball holds the other, or they stand behind each other
      const float k1 = d2_ * m3 - m1 * m2_ + m2_ * rr_ * ra_;
      const float k0 = d2_ * m5 - m1 * m1 + m1 * rr_ * ra_ * 2 - m0_ * ra_ * ra_;
      const float h = k1 * k1 - k0 * k2_;
      if (h >= 0) {
        const float t = (-std::sqrt(h) - k1) / k2_, along = m1 - ra_ * rr_ + t * m2_;
        if (along > 0 && along < d2_) {
          const V3 n{d2_ * oa.x - ba_.x * along, d2_ * oa.y - ba_.y * along,
                     d2_ * (oa.z - t) - ba_.z * along};
          const float length = std::sqrt(dot(n, n));
          normal = {n.x / length, n.y / length, n.z / length};
          z = -t;
          return true;
        }
      }
    }
    bool met = false;
    const auto ball = [&](V3 middle, float r) {
      const float dx = x - middle.x, dy = y - middle.y, h = r * r - dx * dx - dy * dy;
      if (h <= 0) return;
      const float up = std::sqrt(h);
      if (met && middle.z + up <= z) return;
      met = true;
      z = middle.z + up;
      normal = {dx / r, dy / r, up / r};
    };
    ball(a_, ra_);
    ball(b_, rb_);
    return met;
  }

 private:
  V3 a_, b_, ba_;
  float ra_, rb_, rr_, m0_, m2_, d2_, k2_;
};

}  // namespace

QVector3D light_way() {
  return QVector3D(0.45f, 1.0f, 0.35f).normalized();
}

QRgb lit_color(QRgb base, QVector3D normal, QVector3D toward) {
  static const QVector3D light = light_way();
  const float key = std::max(0.0f, QVector3D::dotProduct(normal, light));
  const float sky = 0.5f + 0.5f * normal.y();
  const float head = std::max(0.0f, QVector3D::dotProduct(normal, toward));
  const float gleam = std::max(0.0f, QVector3D::dotProduct(normal, (light + toward).normalized()));
  const float g2 = gleam * gleam, g8 = g2 * g2 * g2 * g2;
  const float share = 0.27f + 0.19f * sky + 0.50f * key + 0.18f * head, shine = 25.5f * g8 * g8 * g8;
  const auto part = [&](int c) {
    return std::clamp(static_cast<int>(static_cast<float>(c) * share + shine), 0, 255);
  };
  return qRgb(part(qRed(base)), part(qGreen(base)), part(qBlue(base)));
}

QImage solid_sheet(const QRect& area, const std::vector<SeenCapsule>& capsules, QVector3D up) {
  QImage sheet(area.size(), QImage::Format_ARGB32_Premultiplied);
  sheet.fill(Qt::transparent);
  std::vector<float> nearest(static_cast<std::size_t>(area.width()) * static_cast<std::size_t>(area.height()),
                             std::numeric_limits<float>::infinity());
  // From behind, so that edges blend into what lies behind them.
  std::vector<const SeenCapsule*> order;
  for (const SeenCapsule& c : capsules) order.push_back(&c);
  std::stable_sort(order.begin(), order.end(), [](const SeenCapsule* one, const SeenCapsule* other) {
    return one->depth_a + one->depth_b > other->depth_a + other->depth_b;
  });
  for (const SeenCapsule* one : order) {
    const SeenCapsule& c = *one;
    const double middle = (c.depth_a + c.depth_b) / 2;
    const auto ra = static_cast<float>(c.radius_a), rb = static_cast<float>(c.radius_b);
    const V3 a{static_cast<float>(c.a.x()), static_cast<float>(-c.a.y()),
               static_cast<float>((middle - c.depth_a) * c.scale)};
    const V3 b{static_cast<float>(c.b.x()), static_cast<float>(-c.b.y()),
               static_cast<float>((middle - c.depth_b) * c.scale)};
    const Rod rod(a, ra, b, rb);
    const QVector3D up_way = (up - QVector3D::dotProduct(up, c.toward) * c.toward).normalized();
    const QVector3D aside_way = QVector3D::crossProduct(up_way, c.toward);
    // Of the outline, for its soft edge.
    const float bx = b.x - a.x, by = b.y - a.y, length = std::hypot(bx, by);
    const bool long_enough = length > std::abs(ra - rb) + 1e-3f;
    const float lean = long_enough ? (ra - rb) / length : 0;
    const float slope = lean / std::sqrt(std::max(1e-6f, 1 - lean * lean));
    const float most = std::max(ra, rb) + 1;
    const int left = std::max(area.left(), static_cast<int>(std::floor(std::min(a.x, b.x) - most)));
    const int right_end = std::min(area.right(), static_cast<int>(std::ceil(std::max(a.x, b.x) + most)));
    const int top = std::max(area.top(), static_cast<int>(std::floor(-std::max(a.y, b.y) - most)));
    const int bottom = std::min(area.bottom(), static_cast<int>(std::ceil(-std::min(a.y, b.y) + most)));
    for (int row = top; row <= bottom; ++row) {
      QRgb* line = reinterpret_cast<QRgb*>(sheet.scanLine(row - area.top()));
      float* depths =
          &nearest[static_cast<std::size_t>(row - area.top()) * static_cast<std::size_t>(area.width())];
      const float y = -(static_cast<float>(row) + 0.5f);
      for (int column = left; column <= right_end; ++column) {
        const float x = static_cast<float>(column) + 0.5f;
        float share = 0, radius = 0, ex = 0, ey = 0;
        if (long_enough) {
          const float along = ((x - a.x) * bx + (y - a.y) * by) / length;
          const float aside = std::abs((x - a.x) * by - (y - a.y) * bx) / length;
          share = std::clamp((along - aside * slope) / length, 0.0f, 1.0f);
        } else {
          share = ra >= rb ? 0.0f : 1.0f;
        }
        radius = ra + (rb - ra) * share;
        ex = x - (a.x + bx * share);
        ey = y - (a.y + by * share);
        const float away = std::sqrt(ex * ex + ey * ey);
        const float cover = std::clamp(radius - away + 0.5f, 0.0f, 1.0f);
        if (cover <= 0) continue;
        float z = 0;
        V3 n;
        if (!rod.meets(x, y, z, n)) {  // at the very edge
          z = a.z + (b.z - a.z) * share;
          n = {ex / std::max(away, 1e-4f), ey / std::max(away, 1e-4f), 0};
        }
        const float depth = static_cast<float>(middle) - z / static_cast<float>(c.scale);
        float& known = depths[column - area.left()];
        if (depth >= known) continue;
        const QRgb color = lit_color(c.color, n.x * aside_way + n.y * up_way + n.z * c.toward, c.toward);
        QRgb& pixel = line[column - area.left()];
        if (cover >= 1) {
          pixel = color;
        } else {
          const int over = static_cast<int>(cover * 256), under = 256 - over;
          const auto part = [&](int one_part, int other) { return (one_part * over + other * under) >> 8; };
          pixel = qRgba(part(qRed(color), qRed(pixel)), part(qGreen(color), qGreen(pixel)),
                        part(qBlue(color), qBlue(pixel)), part(255, qAlpha(pixel)));
        }
        if (cover > 0.5f) known = depth;
      }
    }
  }
  return sheet;
}

}  // namespace kinegraph
