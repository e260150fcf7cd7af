#include "gui/curves/warp_plot.h"

#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include "gui/curves/axis.h"
#include "gui/look/hairline.h"

namespace kinegraph {
namespace {

constexpr int most_cells = 160;     // of the picture of distances, along a side
constexpr double scale_width = 66;  // pixels for the colours' scale

struct Distances {
  QImage grey;
  double least = 0, most = 0;  // m, of black and of white
};

// How far apart the poses are, relative to the roots and turned by neither, as the root mean square over the
// joints: a picture to see the path by.
Distances distances_between(const ShownMotion& source, const ShownMotion& reference) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < source.names.size(); ++i)
    for (std::size_t k = 0; k < reference.names.size(); ++k)
      if (!source.names[i].empty() && source.names[i] == reference.names[k])
        pairs.emplace_back(static_cast<int>(i), static_cast<int>(k));
  if (pairs.empty()) return {};
  const int across = std::min(most_cells, source.frames), down = std::min(most_cells, reference.frames);
  std::vector<double> far(static_cast<std::size_t>(across * down));
  double least = 1e9, most = 0;
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) {
      const int a = x * source.frames / across, b = y * reference.frames / down;
      const auto ra = source.root(a), rb = reference.root(b);
      double sum = 0;
      for (const auto& [i, k] : pairs) {
        const auto& p = source.at(a, i);
        const auto& q = reference.at(b, k);
        const double dx = (p.x - ra.x) - (q.x - rb.x), dy = p.y - q.y, dz = (p.z - ra.z) - (q.z - rb.z);
        sum += dx * dx + dy * dy + dz * dz;
      }
      double& cell = far[static_cast<std::size_t>(y * across + x)];
      cell = std::sqrt(sum / static_cast<double>(pairs.size()));
      least = std::min(least, cell);
      most = std::max(most, cell);
    }
  QImage image(across, down, QImage::Format_Grayscale8);
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x)
      image.scanLine(down - 1 - y)[x] = static_cast<uchar>(std::lround(
          255 * (far[static_cast<std::size_t>(y * across + x)] - least) / std::max(1e-9, most - least)));
  return {image, least, most};
}

// Near is the ground, then a blue, far the lightest or darkest of it.
std::array<QColor, 3> distance_colors(const Theme& theme) {
  if (theme.dark) return {theme.window, QColor(0x35608f), QColor(0xa9cdf2)};
  return {QColor(0xffffff), QColor(0x9dc0e6), QColor(0x2a5b91)};
}

QImage tinted(const QImage& grey, const std::array<QColor, 3>& colors) {
  QImage image;
  QList<QRgb> table;
  for (int i = 0; i < 256; ++i) {
    const QColor &from = colors[i < 128 ? 0 : 1], &to = colors[i < 128 ? 1 : 2];
    const double s = i < 128 ? i / 128.0 : (i - 128) / 127.0;
    const auto part = [&](int a, int b) { return static_cast<int>(a + (b - a) * s); };
    table << qRgb(part(from.red(), to.red()), part(from.green(), to.green()), part(from.blue(), to.blue()));
  }
  image = QImage(grey.constBits(), grey.width(), grey.height(), grey.bytesPerLine(), QImage::Format_Indexed8)
              .copy();
  image.setColorTable(table);
  return image;
}

}  // namespace

WarpPlot::WarpPlot(Playback& playback, QWidget* parent)
    : QWidget(parent), playback_(playback), theme_(&dark_theme()) {
  setAccessibleName(tr("Path and energy of the time warp"));
  pool_.setMaxThreadCount(1);
  connect(&playback_, &Playback::moved, this, qOverload<>(&QWidget::update));
}

WarpPlot::~WarpPlot() {
  pool_.clear();
  pool_.waitForDone();
}

void WarpPlot::set_warp(std::shared_ptr<const Warp> warp) {
  warp_ = std::move(warp);
  update();
}

void WarpPlot::set_motions(std::shared_ptr<const ShownMotion> source,
                           std::shared_ptr<const ShownMotion> reference) {
  if (source == source_ && reference == reference_) return;
  source_ = source;
  reference_ = reference;
  distances_ = QImage();
  update();
  if (!source || !reference) return;
  pool_.clear();
  pool_.start([this, source, reference] {
    const Distances found = distances_between(*source, *reference);
    QMetaObject::invokeMethod(
        this,
        [this, found, source, reference] {
          if (source != source_ || reference != reference_) return;
          distances_ = found.grey;
          nearest_ = found.least;
          farthest_ = found.most;
          update();
        },
        Qt::QueuedConnection);
  });
}

void WarpPlot::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
}

void WarpPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme_->panel);
  if (!warp_ || warp_->identity || warp_->paths.empty()) {
    painter.setPen(theme_->faint_text);
    painter.drawText(rect(), Qt::AlignCenter, warp_ ? tr("This warp changes nothing.") : tr("Evaluating …"));
    return;
  }
  const bool with_energy = warp_->energy.size() > 1;
  const QRectF all = QRectF(rect()).adjusted(62, 30, -18, -28);
  if (!with_energy) return paint_path(painter, all.adjusted(0, 0, -scale_width, 0));
  // Beside each other where the dock is wide and low, else the energy below the path.
  QRectF path = all, energy = all;
  if (width() > 1.5 * height()) {
    path.setWidth(all.width() * 0.64 - scale_width);
    energy.setLeft(path.right() + scale_width + 84);
  } else {
    energy.setTop(all.bottom() - std::min(120.0, all.height() * 0.25));
    path.setBottom(energy.top() - 58);
    path.setRight(all.right() - scale_width);
  }
  paint_path(painter, path);
  paint_energy(painter, energy);
}

void WarpPlot::paint_path(QPainter& painter, const QRectF& area) {
  const double across = std::max(1u, warp_->source_frames), up = std::max(1u, warp_->reference_frames);
  paint_axis(painter, area, *theme_, across, 0, up, QString(), tr("frame"));
  if (!distances_.isNull()) {
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const QRectF place = on_pixels(painter, area);
    painter.drawImage(place, tinted(distances_, distance_colors(*theme_)));
    paint_scale(painter, QRectF(area.right() + 12, area.top(), 10, area.height()));
  }
  draw_hair_frame(painter, area, theme_->line);
  painter.setPen(theme_->text);
  const double title_room = area.width() + scale_width - 8;
  painter.drawText(QRectF(area.left(), area.top() - 24, title_room, 20), Qt::AlignLeft | Qt::AlignVCenter,
                   painter.fontMetrics().elidedText(tr("Frames of the reference (up) and of the source"),
                                                    Qt::ElideRight, static_cast<int>(title_room)));
  const auto spot = [&](double source, double reference) {
    return QPointF(area.left() + source / across * area.width(),
                   area.bottom() - reference / up * area.height());
  };
  painter.setClipRect(area);
  painter.setPen(QPen(theme_->text, 1, Qt::DotLine));
  painter.drawLine(spot(0, 0), spot(across, up));
  for (std::size_t which = 0; which < warp_->paths.size(); ++which) {
    const std::vector<std::uint32_t>& path = warp_->paths[which];
    QPolygonF line;
    for (std::size_t row = 0; row < path.size(); ++row)
      line << (warp_->source_warped ? spot(path[row], static_cast<double>(row))
                                    : spot(static_cast<double>(row), path[row]));
    QColor color = theme_->port("Warp");
    const bool many = warp_->paths.size() > 1;
    if (many) {
      color.setAlphaF(0.4f);
    } else {  // dark around it, so that it is seen on light and on dark
      painter.setPen(QPen(theme_->dark ? QColor(0, 0, 0, 140) : QColor(255, 255, 255, 200), 4.5,
                          Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.drawPolyline(line);
    }
    painter.setPen(QPen(color, many ? 1.0 : 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
    const auto now =
        static_cast<std::size_t>(std::max(0.0, std::floor(playback_.time() * warp_->fps + 1e-6)));
    if (many || now >= path.size()) continue;
    painter.setPen(QPen(theme_->panel, 1.5));
    painter.setBrush(theme_->accent);
    painter.drawEllipse(line[static_cast<qsizetype>(now)], 5, 5);
    painter.setBrush(Qt::NoBrush);
  }
  painter.setClipping(false);
}

// What the colours of the picture under the path mean.
void WarpPlot::paint_scale(QPainter& painter, const QRectF& bar) {
  const std::array<QColor, 3> colors = distance_colors(*theme_);
  QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
  for (std::size_t i = 0; i < colors.size(); ++i) gradient.setColorAt(static_cast<double>(i) / 2, colors[i]);
  const QRectF place = on_pixels(painter, bar);
  painter.fillRect(place, gradient);
  draw_hair_frame(painter, place, theme_->line);
  painter.setPen(theme_->faint_text);
  const auto tell = [&](double y, const QString& words) {
    painter.drawText(QRectF(bar.right() + 5, y - 9, scale_width, 18), Qt::AlignLeft | Qt::AlignVCenter,
                     words);
  };
  tell(bar.top() + 7, tr("%1 m").arg(farthest_, 0, 'f', 2));
  if (bar.height() > 60) tell(bar.center().y(), tr("apart"));
  tell(bar.bottom() - 7, tr("%1 m").arg(nearest_, 0, 'f', 2));
}

void WarpPlot::paint_energy(QPainter& painter, const QRectF& area) {
  const std::vector<double>& energy = warp_->energy;
  const double low = 0, high = std::max(1e-12, *std::max_element(energy.begin(), energy.end())) * 1.05;
  paint_axis(painter, area, *theme_, static_cast<double>(energy.size() - 1), low, high, QString(),
             tr("half-step"));
  painter.setPen(theme_->text);
  painter.drawText(QRectF(area.left(), area.top() - 24, area.width(), 20), Qt::AlignLeft | Qt::AlignVCenter,
                   tr("Energy: %1 to %2").arg(plain_number(energy.front()), plain_number(energy.back())));
  QPolygonF line;
  for (std::size_t i = 0; i < energy.size(); ++i)
    line << QPointF(
        area.left() + area.width() * static_cast<double>(i) / static_cast<double>(energy.size() - 1),
        area.bottom() - (energy[i] - low) / (high - low) * area.height());
  painter.setPen(QPen(theme_->accent, 2));
  painter.drawPolyline(line);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme_->accent);
  for (const QPointF& p : line) painter.drawEllipse(p, 2.5, 2.5);
  painter.setBrush(Qt::NoBrush);
}

}  // namespace kinegraph
