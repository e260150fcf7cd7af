#include "gui/canvas/node_pixmaps.h"

#include <cmath>

namespace kinegraph {

void NodePixmaps::forget() {
  for (auto& [name, picture] : pictures_) picture.fresh = false;
}

void NodePixmaps::forget(const std::string& node) {
  if (auto found = pictures_.find(node); found != pictures_.end()) found->second.fresh = false;
}

void NodePixmaps::begin(double zoom, double device_ratio, double budget_ms) {
  if (device_ratio != ratio_) pictures_.clear();
  zoom_ = zoom;
  ratio_ = device_ratio;
  budget_ms_ = budget_ms;
  ran_out_ = false;
  clock_.start();
}

void NodePixmaps::draw(QPainter& painter, QPointF at, const SceneNode& node, const NodeStatus* status,
                       std::optional<Severity> problem, const Theme& theme) {
  Picture& picture = pictures_[node.name];
  // On whole pixels, so that text and edges stay sharp.
  const auto whole = [this](double x) { return std::round(x * ratio_) / ratio_; };
  const double around = whole(margin * zoom_);
  const bool wanted = !picture.fresh || picture.zoom != zoom_;
  if (wanted && (picture.pixmap.isNull() || double(clock_.nsecsElapsed()) < budget_ms_ * 1e6)) {
    const QSizeF size = node.rect.size() * zoom_ + QSizeF(2 * around, 2 * around);
    picture.pixmap =
        QPixmap(QSize(int(std::ceil(size.width() * ratio_)), int(std::ceil(size.height() * ratio_))));
    picture.pixmap.setDevicePixelRatio(ratio_);
    picture.pixmap.fill(Qt::transparent);
    QPainter inside(&picture.pixmap);
    inside.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
    inside.translate(around, around);
    draw_node(inside, node, status, problem, theme, zoom_);
    picture.zoom = zoom_;
    picture.fresh = true;
  }
  if (picture.zoom == zoom_) {
    painter.drawPixmap(QPointF(whole(at.x()) - around, whole(at.y()) - around), picture.pixmap);
    if (!picture.fresh) ran_out_ = true;
    return;
  }
  ran_out_ = true;
  const QSizeF size = picture.pixmap.deviceIndependentSize() * (zoom_ / picture.zoom);
  painter.drawPixmap(QRectF(at - QPointF(around, around), size), picture.pixmap,
                     QRectF(QPointF(), QSizeF(picture.pixmap.size())));
}

}  // namespace kinegraph
