#include "gui/components/components_grid.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "gui/viewer/motion_scene.h"

namespace kinegraph {
namespace {
constexpr int least_width = 142, most_width = 230, least_height = 150, most_height = 300, gap = 8;
constexpr int head = 22, caption = 20, signal_height = 34;
constexpr int playing_ms = 50;
constexpr int looks_at_each = 12;  // moments of a figure that the camera takes in
}  // namespace

ComponentsGrid::ComponentsGrid(QWidget* parent) : QWidget(parent), theme_(&dark_theme()), maker_(this) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Components"));
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  clock_.start();
  playing_.setInterval(playing_ms);
  playing_.start();
  connect(&playing_, &QTimer::timeout, this, [this] {
    if (isVisible() && !drawing_) ask();
  });
  connect(&maker_, &PictureMaker::made, this, [this](const QImage& image) {
    image_ = image;
    drawing_ = false;
    update();
  });
}

void ComponentsGrid::set_picture(std::shared_ptr<const ComponentPicture> picture) {
  if (picture == picture_) return;
  const bool other_size = !picture || !picture_ || picture->figures.size() != picture_->figures.size();
  picture_ = std::move(picture);
  find_reach();
  if (other_size) {
    chosen_.clear();
    current_ = 0;
    image_ = QImage();
    emit chosen_changed();
  }
  fit_tiles();
  updateGeometry();
  ask();
  update();
}

// Where the points of all figures go, each counted from the middle of its own box.
void ComponentsGrid::find_reach() {
  reach_.clear();
  if (!picture_) return;
  for (const ComponentFigure& figure : picture_->figures) {
    if (!figure.motion) continue;
    const ShownMotion& motion = *figure.motion;
    const SceneBox box = box_of(motion);
    for (int k = 0; k < looks_at_each; ++k)
      for (int point = 0; point < motion.points; ++point)
        if (const auto& p = motion.at(k * (motion.frames - 1) / (looks_at_each - 1), point); !std::isnan(p.x))
          reach_.push_back(QVector3D(p.x, p.y, p.z) - (box.low + box.high) / 2);
  }
}

void ComponentsGrid::set_badges(std::vector<QString> badges) {
  badges_ = std::move(badges);
  update();
}

void ComponentsGrid::set_theme(const Theme& theme) {
  theme_ = &theme;
  ask();
  update();
}

int ComponentsGrid::columns(int width) const {
  return std::max(1, (width - gap) / (least_width + gap));
}

// All in one row where they fit in it, not wider than a figure needs.
int ComponentsGrid::tile_width() const {
  const int across = std::max(1, std::min(columns(width()), count()));
  return std::min(most_width, (width() - gap) / across - gap);
}

int ComponentsGrid::heightForWidth(int width) const {
  const int rows = (count() + columns(width) - 1) / columns(width);
  return std::max(tile_height_, rows * (tile_height_ + gap) + gap);
}

QSize ComponentsGrid::sizeHint() const {
  return QSize(400, heightForWidth(400));
}

QRect ComponentsGrid::tile(int component) const {
  const int across = columns(width());
  const int wide = tile_width();
  return QRect(gap + component % across * (wide + gap), gap + component / across * (tile_height_ + gap), wide,
               tile_height_);
}

QRect ComponentsGrid::figure_part(const QRect& tile) const {
  return tile.adjusted(1, 1, -1, -caption - signal_height - 4);
}

void ComponentsGrid::set_room(int height) {
  room_ = height;
  fit_tiles();
}

// All rows without scrolling where that leaves figures large enough.
void ComponentsGrid::fit_tiles() {
  const int rows = std::max(1, (count() + columns(width()) - 1) / columns(width()));
  const int wanted = std::clamp((room_ - gap) / rows - gap, least_height, most_height);
  if (wanted == tile_height_) return;
  tile_height_ = wanted;
  updateGeometry();
  update();
  ask();
}

void ComponentsGrid::choose(int component, bool also) {
  if (component < 0 || component >= count()) return;
  current_ = component;
  if (!also) {
    chosen_ = {component};
  } else if (!chosen_.erase(component)) {
    chosen_.insert(component);
  }
  update();
  emit chosen_changed();
}

void ComponentsGrid::ask() {
  if (!picture_ || width() < 10 || !isVisible()) return;
  ScenePicture all;
  all.size = (QSizeF(size()) * devicePixelRatioF()).toSize();
  all.colors = colors_of(*theme_);
  all.colors.sky = theme_->raised.rgb();
  all.camera.pitch = 0.12f;
  all.camera.yaw = 0.75f;
  const double seconds = static_cast<double>(clock_.elapsed()) / 1000;
  for (int i = 0; i < count(); ++i) {
    const ComponentFigure& figure = picture_->figures[static_cast<std::size_t>(i)];
    if (!figure.motion || visibleRegion().intersected(tile(i)).isEmpty()) continue;
    SceneCell cell;
    const QRectF part = figure_part(tile(i));
    cell.where = cell.clip =
        QRectF(part.x() / width(), part.y() / height(), part.width() / width(), part.height() / height());
    SceneLooks looks;
    looks.contacts = false;
    const double length = figure.motion->frames / figure.motion->fps;
    add_motion(cell.scene, *figure.motion, std::fmod(seconds, std::max(0.01, length)), looks, *theme_);
    const SceneBox box = box_of(*figure.motion);
    if (all.cells.empty())
      all.camera.frame_closely(reach_, static_cast<float>(0.02 * figure.motion->size),
                               part.width() / std::max(1.0, part.height()));
    cell.scene.camera_shift = (box.low + box.high) / 2;
    all.cells.push_back(std::move(cell));
  }
  if (all.cells.empty()) return;
  drawing_ = true;
  maker_.request(std::move(all));
}

void ComponentsGrid::paint_signal(QPainter& painter, const ComponentFigure& figure, const QRectF& where) {
  painter.setPen(QPen(theme_->line, 1));
  painter.drawLine(QPointF(where.left(), where.center().y()), QPointF(where.right(), where.center().y()));
  for (double seam : picture_->seams) {
    painter.setPen(QPen(theme_->warning, 1, Qt::DashLine));
    const double x = where.left() + seam * where.width();
    painter.drawLine(QPointF(x, where.top()), QPointF(x, where.bottom()));
  }
  if (figure.signal.size() < 2) return;
  float most = 0.5f;
  for (float v : figure.signal) most = std::max(most, std::abs(v));
  QPolygonF line;
  for (std::size_t i = 0; i < figure.signal.size(); ++i)
    line << QPointF(
        where.left() + where.width() * static_cast<double>(i) / static_cast<double>(figure.signal.size() - 1),
        where.center().y() - figure.signal[i] / most * where.height() / 2);
  painter.setPen(QPen(theme_->port("Components"), 1.2));
  painter.drawPolyline(line);
  // Where the figure is.
  if (figure.motion && picture_->frames > 0) {
    const double length = figure.motion->frames / figure.motion->fps;
    const double at = std::fmod(static_cast<double>(clock_.elapsed()) / 1000, std::max(0.01, length));
    const double x = where.left() + where.width() * at * picture_->fps / picture_->frames;
    painter.setPen(QPen(theme_->accent, 1));
    painter.drawLine(QPointF(x, where.top()), QPointF(x, where.bottom()));
  }
}

void ComponentsGrid::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.fillRect(event->rect(), theme_->panel);
  painter.setRenderHint(QPainter::Antialiasing);
  for (int i = 0; i < count(); ++i) {
    const QRect whole = tile(i);
    if (!event->rect().intersects(whole)) continue;
    const ComponentFigure& figure = picture_->figures[static_cast<std::size_t>(i)];
    const bool is_chosen = chosen_.count(i) > 0;
    QPainterPath card;
    card.addRoundedRect(QRectF(whole).adjusted(1, 1, -1, -1), 5, 5);
    painter.fillPath(card, theme_->raised);
    const QRect part = figure_part(whole);
    if (!image_.isNull() && figure.motion) {
      const double ratio = static_cast<double>(image_.width()) / std::max(1, width());
      const QRectF from(part.x() * ratio, part.y() * ratio, part.width() * ratio, part.height() * ratio);
      painter.save();
      painter.setClipPath(card);
      painter.drawImage(QRectF(part), image_, from);
      painter.restore();
    }
    painter.setPen(QPen(is_chosen ? theme_->accent : theme_->line, is_chosen ? 2 : 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(card);
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.setPen(theme_->text);
    const QRect title(whole.left() + 9, whole.top(), whole.width() - 18, head);
    painter.drawText(title, Qt::AlignVCenter | Qt::AlignLeft, QString("u%1").arg(i + 1));
    painter.setFont(font());
    painter.setPen(theme_->faint_text);
    painter.drawText(title, Qt::AlignVCenter | Qt::AlignRight,
                     figure.unique ? figure.share : figure.share + QStringLiteral(" ?"));
    painter.drawText(title.translated(0, fontMetrics().height() + 1), Qt::AlignVCenter | Qt::AlignRight,
                     figure.cadence);
    const QString badge =
        static_cast<std::size_t>(i) < badges_.size() ? badges_[static_cast<std::size_t>(i)] : QString();
    if (!badge.isEmpty()) {
      const QRectF plate(part.left() + 7, part.top() + head + 2, fontMetrics().horizontalAdvance(badge) + 12,
                         18);
      painter.setPen(Qt::NoPen);
      painter.setBrush(theme_->selection);
      painter.drawRoundedRect(plate, 3, 3);
      painter.setPen(theme_->text);
      painter.drawText(plate, Qt::AlignCenter, badge);
    }
    painter.setPen(theme_->text);
    const QRect words(whole.left() + 9, part.bottom() + 2, whole.width() - 18, caption);
    // As many joints as fit with all their letters; the tool tip names the rest.
    QString joints = figure.short_joints;
    while (fontMetrics().horizontalAdvance(joints) > words.width() && joints.contains(", "))
      joints.truncate(joints.lastIndexOf(", "));
    painter.drawText(words, Qt::AlignVCenter | Qt::AlignLeft,
                     fontMetrics().elidedText(joints, Qt::ElideRight, words.width()));
    paint_signal(painter, figure,
                 QRectF(whole.left() + 9, words.bottom() + 1, whole.width() - 18, signal_height - 6));
    if (hasFocus() && i == current_) {
      painter.setPen(QPen(theme_->accent, 1));
      painter.setBrush(Qt::NoBrush);
      painter.drawRoundedRect(QRectF(whole).adjusted(4, 4, -4, -4), 4, 4);
    }
  }
}

void ComponentsGrid::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  for (int i = 0; i < count(); ++i)
    if (tile(i).contains(event->pos()))
      choose(i, event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier));
}

void ComponentsGrid::keyPressEvent(QKeyEvent* event) {
  const int across = columns(width());
  int next = current_;
  switch (event->key()) {
    case Qt::Key_Left:
      next -= 1;
      break;
    case Qt::Key_Right:
      next += 1;
      break;
    case Qt::Key_Up:
      next -= across;
      break;
    case Qt::Key_Down:
      next += across;
      break;
    case Qt::Key_Space:
    case Qt::Key_Return:
      return choose(current_, event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier));
    default:
      return QWidget::keyPressEvent(event);
  }
  if (next >= 0 && next < count()) current_ = next;
  update();
}

bool ComponentsGrid::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    auto* help = static_cast<QHelpEvent*>(event);
    for (int i = 0; i < count(); ++i)
      if (tile(i).contains(help->pos())) {
        const ComponentFigure& figure = picture_->figures[static_cast<std::size_t>(i)];
        QString words = tr("u%1: %2 of the variance").arg(i + 1).arg(figure.share);
        if (!figure.cadence.isEmpty()) words += tr(", %1").arg(figure.cadence);
        words += "\n" + tr("Moves %1").arg(figure.joints);
        if (!figure.unique) words += "\n" + tr("Another start of the search finds another component here.");
        QToolTip::showText(help->globalPos(), words, this);
      }
    return true;
  }
  return QWidget::event(event);
}

void ComponentsGrid::resizeEvent(QResizeEvent*) {
  fit_tiles();
  ask();
}

}  // namespace kinegraph
