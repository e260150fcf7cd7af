#include "gui/viewer/stage.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/look/hairline.h"

namespace kinegraph {
namespace {
constexpr int rest_ms = 180;      // without a new picture until it is drawn smooth
constexpr double line_reach = 8;  // pixels around the wipe's line that take hold of it
}  // namespace

Stage::Stage(QWidget* parent) : QWidget(parent), maker_(this), theme_(&dark_theme()) {
  setMinimumSize(160, 120);
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(tr("Motion in 3D"));
  rest_.setSingleShot(true);
  rest_.setInterval(rest_ms);
  connect(&rest_, &QTimer::timeout, this, [this] { maker_.request(picture(true)); });
  connect(&maker_, &PictureMaker::made, this, [this](const QImage& image) {
    image_ = image;
    ++pictures_;
    update();
  });
}

ScenePicture Stage::picture(bool smooth) const {
  ScenePicture all;
  all.cells = cells_;
  all.camera = camera_;
  all.colors = colors_;
  all.size = (QSizeF(size()) * devicePixelRatioF()).toSize();
  all.smooth = smooth;
  return all;
}

void Stage::ask(bool moving) {
  if (!isVisible()) return;  // a hidden dock draws nothing; showing it asks again
  maker_.request(picture(false));
  if (moving)
    rest_.stop();
  else
    rest_.start();
}

void Stage::show_cells(std::vector<SceneCell> cells, std::vector<Caption> captions, bool moving) {
  cells_ = std::move(cells);
  captions_ = std::move(captions);
  ask(moving);
}

void Stage::set_colors(const SceneColors& colors, const Theme& theme) {
  colors_ = colors;
  theme_ = &theme;
  ask(false);
}

void Stage::set_wipe(bool on) {
  has_wipe_ = on;
  update();
}

void Stage::set_legend(bool on) {
  has_legend_ = on;
  update();
}

double Stage::shape() const {
  const QRectF cell = cells_.empty() ? QRectF(0, 0, 1, 1) : cells_.front().where;
  return std::max(1.0, cell.width() * width()) / std::max(1.0, cell.height() * height());
}

double Stage::cell_height() const {
  return (cells_.empty() ? 1.0 : cells_.front().where.height()) * height();
}

// Upright at the edge, where it keeps clear of the feet: longer above, shorter below.
void Stage::paint_legend(QPainter& painter) const {
  constexpr double edge = 9, bar_width = 8, space = 8;
  const QFontMetricsF metrics(painter.font());
  const QString title = tr("Link length");
  const QString lines[] = {tr("+10 %"), tr("as at rest"), tr("−10 %")};
  double words = metrics.horizontalAdvance(title) - bar_width - space;
  for (const QString& line : lines) words = std::max(words, metrics.horizontalAdvance(line));
  const double line_height = metrics.height() + 1, wide = edge + bar_width + space + words + edge;
  const QRectF plate(8, height() - 4 * line_height - edge - 14, wide, 4 * line_height + edge + 6);
  QColor back = theme_->panel;
  back.setAlpha(215);
  painter.setPen(Qt::NoPen);
  painter.setBrush(back);
  painter.drawRoundedRect(plate, 4, 4);
  painter.setPen(theme_->faint_text);
  painter.drawText(QRectF(plate.left() + edge, plate.top() + edge / 2, plate.width(), line_height),
                   Qt::AlignLeft | Qt::AlignVCenter, title);
  const double top = plate.top() + edge / 2 + line_height + 3;
  const QRectF bar(plate.left() + edge, top + 2, bar_width, 3 * line_height - 4);
  QLinearGradient colors(bar.bottomLeft(), bar.topLeft());
  colors.setColorAt(0, theme_->stretch_short);
  colors.setColorAt(0.5, theme_->bone);
  colors.setColorAt(1, theme_->stretch_long);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colors);
  painter.drawRoundedRect(bar, 3, 3);
  painter.setPen(theme_->text);
  for (int i = 0; i < 3; ++i)
    painter.drawText(QRectF(bar.right() + space, top + i * line_height, words + 2, line_height),
                     Qt::AlignLeft | Qt::AlignVCenter, lines[i]);
}

void Stage::camera_changed() {
  ask(false);
  emit camera_moved();
}

QImage Stage::picture_now(bool smooth) {
  image_ = maker_.make_now(picture(smooth));
  update();
  return image_;
}

void Stage::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (image_.isNull())
    painter.fillRect(rect(), QColor::fromRgb(colors_.sky));
  else
    painter.drawImage(rect(), image_);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPointSizeF(font.pointSizeF() * 0.95);
  painter.setFont(font);
  const QFontMetrics metrics(font);
  for (const Caption& caption : captions_) {
    const QRectF cell(caption.cell.x() * width(), caption.cell.y() * height(), caption.cell.width() * width(),
                      caption.cell.height() * height());
    const QString words =
        metrics.elidedText(caption.words, Qt::ElideRight, static_cast<int>(cell.width()) - 34);
    const double wide = metrics.horizontalAdvance(words) + 26, high = metrics.height() + 6;
    QRectF plate(caption.right ? cell.right() - wide - 8 : cell.left() + 8, cell.top() + 8, wide, high);
    QColor back = theme_->panel;
    back.setAlpha(205);
    painter.setPen(Qt::NoPen);
    painter.setBrush(back);
    painter.drawRoundedRect(plate, 4, 4);
    painter.setBrush(caption.color);
    painter.drawEllipse(QPointF(plate.left() + 10, plate.center().y()), 4, 4);
    painter.setPen(theme_->text);
    painter.drawText(plate.adjusted(19, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, words);
  }
  if (cells_.size() > 1 && !has_wipe_) {
    for (const SceneCell& cell : cells_) {
      const QRectF part(cell.clip.x() * width(), cell.clip.y() * height(), cell.clip.width() * width(),
                        cell.clip.height() * height());
      if (cell.clip.right() < 0.999)
        draw_hairline(painter, part.topRight(), part.bottomRight(), theme_->line);
      if (cell.clip.left() > 0.001) draw_hairline(painter, part.topLeft(), part.bottomLeft(), theme_->line);
      if (cell.clip.bottom() < 0.999)
        draw_hairline(painter, part.bottomLeft(), part.bottomRight(), theme_->line);
    }
  }
  if (has_legend_) paint_legend(painter);
  if (parentWidget() && parentWidget()->hasFocus()) draw_hair_frame(painter, QRectF(rect()), theme_->accent);
  if (has_wipe_) {
    const double x = wipe_ * width();
    draw_hairline(painter, QPointF(x, 0), QPointF(x, height()), theme_->accent, 2);
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme_->accent);
    painter.drawRoundedRect(QRectF(x - 5, height() / 2.0 - 16, 10, 32), 5, 5);
  }
}

void Stage::resizeEvent(QResizeEvent*) {
  ask(false);
}

void Stage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ask(false);
}

bool Stage::on_wipe_line(QPointF at) const {
  return has_wipe_ && std::abs(at.x() - wipe_ * width()) < line_reach;
}

void Stage::mousePressEvent(QMouseEvent* event) {
  emit clicked();
  last_ = event->position();
  button_ = event->button();
  wiping_ = button_ == Qt::LeftButton && on_wipe_line(last_);
  panning_ = button_ == Qt::MiddleButton || (event->modifiers() & Qt::ShiftModifier);
}

void Stage::mouseMoveEvent(QMouseEvent* event) {
  if (button_ == Qt::NoButton) {
    setCursor(on_wipe_line(event->position()) ? Qt::SplitHCursor : Qt::ArrowCursor);
    return;
  }
  const QPointF way = event->position() - last_;
  last_ = event->position();
  if (wiping_) {
    wipe_ = std::clamp(event->position().x() / std::max(1, width()), 0.02, 0.98);
    emit wipe_moved();
    return;
  }
  if (button_ == Qt::RightButton)
    camera_.zoom(-way.y() * 0.05);
  else if (panning_)
    camera_.pan(way, height());
  else
    camera_.orbit(way);
  camera_changed();
}

void Stage::mouseReleaseEvent(QMouseEvent*) {
  button_ = Qt::NoButton;
  panning_ = wiping_ = false;
}

void Stage::wheelEvent(QWheelEvent* event) {
  camera_.zoom(event->angleDelta().y() / 120.0);
  camera_changed();
  event->accept();
}

}  // namespace kinegraph
