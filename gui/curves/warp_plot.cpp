#include "gui/curves/warp_plot.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/curves/axis.h"

namespace kinegraph {
namespace {

constexpr int most_cells = 160;  // of the picture of distances, along a side

// How far apart the poses are, relative to the roots and turned by neither: a picture to see the path by.
QImage distances_between(const ShownMotion& source, const ShownMotion& reference) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < source.names.size(); ++i)
    for (std::size_t k = 0; k < reference.names.size(); ++k)
      if (!source.names[i].empty() && source.names[i] == reference.names[k])
        pairs.emplace_back(static_cast<int>(i), static_cast<int>(k));
  if (pairs.empty()) return {};
  const int across = std::min(most_cells, source.frames), down = std::min(most_cells, reference.frames);
  std::vector<double> far(static_cast<std::size_t>(across * down));
  double most = 1e-9;
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
      cell = std::sqrt(sum);
      most = std::max(most, cell);
    }
  QImage image(across, down, QImage::Format_Grayscale8);
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x)
      image.scanLine(down - 1 - y)[x] =
          static_cast<uchar>(std::lround(255 * far[static_cast<std::size_t>(y * across + x)] / most));
  return image;
}

QImage tinted(const QImage& grey, const QColor& near, const QColor& far) {
  QImage image = grey.convertToFormat(QImage::Format_Indexed8);
  QList<QRgb> table;
  for (int i = 0; i < 256; ++i) {
    const double s = i / 255.0;
    const auto part = [&](int a, int b) { return static_cast<int>(a + (b - a) * s); };
    table << qRgb(part(near.red(), far.red()), part(near.green(), far.green()),
                  part(near.blue(), far.blue()));
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
    const QImage image = distances_between(*source, *reference);
    QMetaObject::invokeMethod(
        this,
        [this, image, source, reference] {
          if (source != source_ || reference != reference_) return;
          distances_ = image;
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
  const QRectF all = QRectF(rect()).adjusted(58, 30, -14, -28);
  if (!with_energy) return paint_path(painter, all);
  // Beside each other where the dock is wide and low, else the energy below the path.
  QRectF path = all, energy = all;
  if (width() > 1.5 * height()) {
    path.setWidth(all.width() * 0.6);
    energy.setLeft(path.right() + 96);
  } else {
    energy.setTop(all.bottom() - std::min(120.0, all.height() * 0.25));
    path.setBottom(energy.top() - 58);
  }
  paint_path(painter, path);
  paint_energy(painter, energy);
}

void WarpPlot::paint_path(QPainter& painter, const QRectF& area) {
  const double across = std::max(1u, warp_->source_frames), up = std::max(1u, warp_->reference_frames);
  if (!distances_.isNull()) {
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const QColor far = theme_->dark ? QColor(0x4d6f9a) : QColor(0x8fb3dc);
    painter.drawImage(area, tinted(distances_, theme_->panel, far));
  }
  paint_axis(painter, area, *theme_, across, 0, up, QString(), tr("frame"));
  painter.setPen(theme_->text);
  painter.drawText(QRectF(area.left(), area.top() - 24, area.width(), 20), Qt::AlignLeft | Qt::AlignVCenter,
                   tr("Reference frame over source frame"));
  const auto spot = [&](double source, double reference) {
    return QPointF(area.left() + source / across * area.width(),
                   area.bottom() - reference / up * area.height());
  };
  painter.setClipRect(area);
  painter.setPen(QPen(theme_->faint_text, 1, Qt::DotLine));
  painter.drawLine(spot(0, 0), spot(across, up));
  for (std::size_t which = 0; which < warp_->paths.size(); ++which) {
    const std::vector<std::uint32_t>& path = warp_->paths[which];
    QPolygonF line;
    for (std::size_t row = 0; row < path.size(); ++row)
      line << (warp_->source_warped ? spot(path[row], static_cast<double>(row))
                                    : spot(static_cast<double>(row), path[row]));
    QColor color = theme_->port("Warp");
    if (warp_->paths.size() > 1) color.setAlphaF(0.4f);
    painter.setPen(QPen(color, warp_->paths.size() > 1 ? 1 : 2));
    painter.drawPolyline(line);
  }
  painter.setClipping(false);
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
