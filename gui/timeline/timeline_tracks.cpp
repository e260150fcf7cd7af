#include "gui/timeline/timeline_tracks.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/look/hairline.h"

namespace kinegraph {
namespace {

constexpr double ruler = 24, right_edge = 14, gap = 6;
constexpr double least_gutter = 96, most_gutter = 200;  // where the rows' names stand
constexpr double lane_pad = 3;                          // around the contact bars of a row
constexpr double most_lane = 24, plain_row = 56, least_named_lane = 9;
constexpr double handle = 6;  // pixels around an end of the range that take hold of it

double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(1.0, least))));
  for (double factor : {1.0, 2.0, 5.0, 10.0})
    if (power * factor >= least) return power * factor;
  return power * 10;
}

QFont lane_font(const QFont& font, double lane) {
  QFont small = font;
  small.setPixelSize(std::clamp(static_cast<int>(lane) - 1, 9, 11));
  return small;
}

QString lane_name(const FootPoint& point) {
  return QObject::tr(point.left ? "L %1" : "R %1").arg(QString::fromStdString(point.part));
}

const std::vector<FootPoint>& points_of(const TimelineTracks::Row& row) {
  return row.contacts ? row.contacts->points : row.motion->contacts.points;
}

std::size_t lanes_of(const TimelineTracks::Row& row) {
  return row.motion ? points_of(row).size() : 0;
}

}  // namespace

TimelineTracks::TimelineTracks(Playback& playback, QWidget* parent)
    : QWidget(parent), playback_(playback), theme_(&dark_theme()) {
  setMouseTracking(true);
  setAccessibleName(tr("Frames of the clip"));
  setAccessibleDescription(why_nothing());
  connect(&playback_, &Playback::moved, this, qOverload<>(&QWidget::update));
  connect(&playback_, &Playback::state_changed, this, qOverload<>(&QWidget::update));
  connect(&playback_, &Playback::clip_changed, this, [this] {
    first_ = shown_ = 0;
    update();
  });
}

void TimelineTracks::set_rows(std::vector<Row> rows) {
  rows_ = std::move(rows);
  setAccessibleDescription(why_nothing());
  fit_gutter();
  update();
}

// As wide as the longest name, and what its lanes are called beside it.
void TimelineTracks::fit_gutter() {
  lane_names_ = 0;
  double names = 0;
  const QFontMetricsF small(lane_font(font(), most_lane));
  for (const Row& row : rows_) {
    names = std::max(names, QFontMetricsF(font()).horizontalAdvance(row.name));
    if (!row.motion) continue;
    for (const FootPoint& point : points_of(row))
      lane_names_ = std::max(lane_names_, small.horizontalAdvance(lane_name(point)) + 8);
  }
  gutter_ = std::clamp(22 + names + 10 + lane_names_, least_gutter, most_gutter);
}

QString TimelineTracks::why_nothing() const {
  if (any_motion()) return {};
  if (!rows_.empty() && !rows_.front().why_not.isEmpty()) return rows_.front().why_not;
  return tr("No motion is shown, so there is nothing to play.");
}

bool TimelineTracks::any_motion() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.motion != nullptr; });
}

void TimelineTracks::set_warp(std::shared_ptr<const Warp> warp) {
  warp_ = std::move(warp);
  update();
}

void TimelineTracks::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
}

int TimelineTracks::last_frame() const {
  int last = playback_.frames();
  // All lengths in frames of the clip's rate.
  for (const Row& row : rows_)
    if (row.motion)
      last =
          std::max(last, static_cast<int>(std::ceil(row.motion->frames * playback_.fps() / row.motion->fps)));
  return std::max(last, 1);
}

double TimelineTracks::x_of(double frame) const {
  const double width_of_view = shown_ > 0 ? shown_ : last_frame();
  return gutter_ + (frame - first_) / width_of_view * std::max(10.0, width() - gutter_ - right_edge);
}

double TimelineTracks::frame_at(double x) const {
  const double width_of_view = shown_ > 0 ? shown_ : last_frame();
  return first_ + (x - gutter_) / std::max(10.0, width() - gutter_ - right_edge) * width_of_view;
}

QRectF TimelineTracks::row_rect(std::size_t index) const {
  const bool warped = warp_ && rows_.size() >= 2;
  const double between = warped ? std::clamp((height() - ruler) * 0.34, 26.0, 90.0) : gap;
  const double count = static_cast<double>(std::max<std::size_t>(1, rows_.size()));
  const double free = height() - ruler - 2 * gap - (warped ? between + (count - 2) * gap : (count - 1) * gap);
  std::size_t lanes = 0;
  for (const Row& row : rows_) lanes = std::max(lanes, lanes_of(row));
  const double most =
      lanes > 0 ? std::max(plain_row, most_lane * static_cast<double>(lanes) + 2 * lane_pad) : plain_row;
  const double high = std::clamp(free / count, 8.0, most);
  double top = ruler + gap;
  for (std::size_t i = 0; i < index; ++i) top += high + (warped && i == 0 ? between : gap);
  return QRectF(0, top, width(), high);
}

void TimelineTracks::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme_->panel);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!any_motion()) {
    painter.setPen(theme_->faint_text);
    painter.drawText(rect().adjusted(12, 0, -12, 0), Qt::AlignCenter | Qt::TextWordWrap,
                     accessibleDescription());
    return paint_focus(painter);
  }
  paint_ruler(painter);
  painter.save();
  for (std::size_t i = 0; i < rows_.size(); ++i) paint_row(painter, rows_[i], row_rect(i));
  if (warp_ && rows_.size() >= 2) paint_warp(painter, row_rect(0), row_rect(1));
  painter.restore();
  // What lies outside the range is dimmed.
  if (playback_.has_range()) {
    QColor dim = theme_->window;
    dim.setAlpha(150);
    const double in = x_of(playback_.in()), out = x_of(playback_.out());
    painter.fillRect(QRectF(gutter_, ruler, std::max(0.0, in - gutter_), height()), dim);
    painter.fillRect(QRectF(out, ruler, std::max(0.0, width() - out), height()), dim);
    for (double end : {in, out})
      draw_hairline(painter, QPointF(end, ruler - 6), QPointF(end, height()), theme_->good, 2);
  }
  if (const QRectF head = playhead(); !head.isNull()) {
    const double at = x_of(playback_.time() * playback_.fps());
    draw_hairline(painter, QPointF(at, ruler - 4), QPointF(at, height()), theme_->accent, 2);
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme_->accent);
    painter.drawRoundedRect(head, 3, 3);
    painter.setPen(theme_->dark ? theme_->window : Qt::white);
    painter.drawText(head, Qt::AlignCenter, QString::number(playback_.frame()));
  }
  paint_focus(painter);
}

QRectF TimelineTracks::playhead() const {
  const double at = x_of(playback_.time() * playback_.fps());
  if (at < gutter_ - 1 || at > width()) return {};
  const double wide = fontMetrics().horizontalAdvance(QString::number(playback_.frame())) + 10;
  return {std::clamp(at - wide / 2, gutter_ - 10, width() - wide - 1.0), 3, wide, ruler - 7};
}

void TimelineTracks::paint_focus(QPainter& painter) const {
  if (hasFocus()) draw_hair_frame(painter, QRectF(rect()), theme_->accent);
}

void TimelineTracks::paint_ruler(QPainter& painter) {
  painter.fillRect(QRectF(0, 0, width(), ruler), theme_->window);
  draw_hairline(painter, QPointF(0, ruler), QPointF(width(), ruler), theme_->line);
  const double frames_a_pixel = frame_at(gutter_ + 1) - frame_at(gutter_);
  const double step = nice_step(70 * frames_a_pixel);
  painter.setPen(theme_->faint_text);
  painter.drawText(QRectF(10, 0, gutter_ - 16, ruler), Qt::AlignVCenter | Qt::AlignLeft, tr("Frame"));
  const double end = frame_at(width());
  for (double frame = std::max(0.0, std::ceil(first_ / step) * step); frame <= end; frame += step) {
    const double x = x_of(frame);
    draw_hairline(painter, QPointF(x, ruler - 6), QPointF(x, height()), theme_->line);
    const QString number = QString::number(static_cast<int>(frame));
    const double wide = painter.fontMetrics().horizontalAdvance(number);
    const double left = std::min(x - wide / 2, width() - wide - 3.0);  // the last one stays inside
    if (QRectF(left - 3, 0, wide + 6, ruler).intersects(playhead())) continue;
    painter.setPen(theme_->faint_text);
    painter.drawText(QRectF(left - 1, 2, wide + 2, ruler - 8), Qt::AlignCenter, number);
  }
}

void TimelineTracks::paint_row(QPainter& painter, const Row& row, const QRectF& where) {
  const std::size_t lanes = lanes_of(row);
  const double lane = lanes > 0 ? (where.height() - 2 * lane_pad) / static_cast<double>(lanes) : 0;
  const bool named = lane >= least_named_lane;
  painter.setPen(theme_->text);
  const double room = gutter_ - 28 - (named ? lane_names_ : 0);
  const QString name = painter.fontMetrics().elidedText(row.name, Qt::ElideRight, static_cast<int>(room) + 1);
  painter.drawText(QRectF(22, where.top(), room + 2, where.height()), Qt::AlignVCenter | Qt::AlignLeft, name);
  // A rate of its own, as frames are counted in those of the clip.
  if (row.motion && row.motion->fps != playback_.fps() &&
      where.height() > 2.6 * painter.fontMetrics().height()) {
    const QFont usual = painter.font();
    painter.setFont(lane_font(usual, most_lane));
    painter.setPen(theme_->faint_text);
    painter.drawText(QRectF(22, where.center().y() + 0.55 * QFontMetricsF(usual).height(), room + 2, 16),
                     Qt::AlignTop | Qt::AlignLeft | Qt::TextDontClip,
                     tr("%1 fps").arg(row.motion->fps, 0, 'g', 4));
    painter.setFont(usual);
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(row.color);
  painter.drawEllipse(QPointF(13, where.center().y()), 4, 4);
  if (!row.motion) {
    painter.setPen(theme_->faint_text);
    painter.drawText(QRectF(gutter_ + 10, where.top(), width() - gutter_ - 20, where.height()),
                     Qt::AlignVCenter | Qt::AlignLeft, row.why_not);
    return;
  }
  const ShownMotion& motion = *row.motion;
  const double scale = playback_.fps() / motion.fps;
  const QRectF body(x_of(0), where.top(), x_of(motion.frames * scale) - x_of(0), where.height());
  painter.setClipRect(QRectF(gutter_ - 2, 0, width(), height()));
  const QRectF plate = on_pixels(painter, body);
  painter.fillRect(plate, theme_->raised);
  draw_hair_frame(painter, plate, theme_->line);
  if (named) {
    painter.setClipping(false);
    const QFont usual = painter.font();
    painter.setFont(lane_font(usual, lane));
    painter.setPen(theme_->faint_text);
    for (std::size_t i = 0; i < lanes; ++i)
      painter.drawText(QRectF(gutter_ - 7 - lane_names_,
                              where.top() + lane_pad + static_cast<double>(i) * lane, lane_names_, lane - 1),
                       Qt::AlignVCenter | Qt::AlignRight | Qt::TextDontClip, lane_name(points_of(row)[i]));
    painter.setFont(usual);
    painter.setClipping(true);
  }
  painter.setPen(Qt::NoPen);
  for (std::size_t i = 0; i < lanes; ++i) {
    const FootPoint& point = points_of(row)[i];
    QColor color = point.left ? theme_->left : theme_->right;
    if (point.part == "ball") color = theme_->dark ? color.lighter(122) : color.darker(118);
    for (const Run& run : runs_of(point.planted)) {
      const double from = x_of(static_cast<double>(run.start) * scale),
                   to = x_of(static_cast<double>(run.end) * scale);
      painter.fillRect(on_pixels(painter, QRectF(from, where.top() + lane_pad + static_cast<double>(i) * lane,
                                                 std::max(1.0, to - from), std::max(1.0, lane - 1))),
                       color);
    }
  }
  painter.setClipping(false);
}

void TimelineTracks::paint_warp(QPainter& painter, const QRectF& upper, const QRectF& lower) {
  if (warp_->paths.empty() || warp_->paths.front().empty()) return;
  const std::vector<std::uint32_t>& path = warp_->paths.front();
  painter.setClipRect(QRectF(gutter_ - 2, upper.bottom(), width(), lower.top() - upper.bottom()));
  const double scale = playback_.fps() / warp_->fps;
  const double pixels = (x_of(1) - x_of(0)) * scale;
  const std::size_t step =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(12 / std::max(0.01, pixels))));
  QColor plain = theme_->port("Warp");
  for (std::size_t row = 0; row < path.size(); row += step) {
    const double source = warp_->source_warped ? path[row] : static_cast<double>(row);
    const double reference = warp_->source_warped ? static_cast<double>(row) : path[row];
    const double above = x_of(source * scale), below = x_of(reference * scale);
    // Steep lines are where time runs alike; the others stand out.
    const double slant = std::min(1.0, std::abs(above - below) / 120);
    plain.setAlphaF(static_cast<float>(0.45 + 0.5 * slant));
    painter.setPen(QPen(plain, 1));
    painter.drawLine(QPointF(above, upper.bottom() + 1), QPointF(below, lower.top() - 1));
  }
  const int now = playback_.frame();
  if (static_cast<std::size_t>(now) < path.size()) {
    const double source = warp_->source_warped ? path[static_cast<std::size_t>(now)] : now;
    const double reference = warp_->source_warped ? now : path[static_cast<std::size_t>(now)];
    painter.setPen(QPen(theme_->accent, 2));
    painter.drawLine(QPointF(x_of(source * scale), upper.bottom()),
                     QPointF(x_of(reference * scale), lower.top()));
  }
  painter.setClipping(false);
}

QString TimelineTracks::told_at(QPointF at) const {
  const int frame = static_cast<int>(std::floor(frame_at(at.x())));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const QRectF where = row_rect(i);
    const Row& row = rows_[i];
    if (!row.motion || !where.contains(at)) continue;
    const double scale = playback_.fps() / row.motion->fps;
    QString words = tr("%1, frame %2").arg(row.name).arg(std::max(0, frame));
    const auto& points = points_of(row);
    if (points.empty() || at.x() < gutter_) return words;
    const double lane = (where.height() - 2 * lane_pad) / static_cast<double>(points.size());
    const int over = static_cast<int>(std::floor((at.y() - where.top() - lane_pad) / lane));
    const FootPoint& point =
        points[static_cast<std::size_t>(std::clamp(over, 0, static_cast<int>(points.size()) - 1))];
    const QString foot = tr(point.left ? "left %1" : "right %1").arg(QString::fromStdString(point.part));
    const auto at_rate = [&](std::size_t t) { return std::lround(static_cast<double>(t) * scale); };
    for (const Run& run : runs_of(point.planted))
      if (at_rate(run.start) <= frame && frame < at_rate(run.end))
        return words + "\n" +
               tr("%1 planted in frames %2 to %3")
                   .arg(foot)
                   .arg(at_rate(run.start))
                   .arg(at_rate(run.end) - 1);
    return words + "\n" + tr("%1 in the air").arg(foot);
  }
  return {};
}

bool TimelineTracks::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  auto* help = static_cast<QHelpEvent*>(event);
  QToolTip::showText(help->globalPos(), told_at(help->pos()), this);
  return true;
}

void TimelineTracks::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  if (!any_motion()) return;
  const double x = event->position().x();
  if (event->button() == Qt::MiddleButton) {
    drag_ = Drag::pan;
    dragged_from_ = frame_at(x);
  } else if (event->button() == Qt::LeftButton) {
    if (playback_.has_range() && std::abs(x - x_of(playback_.in())) < handle)
      drag_ = Drag::in;
    else if (playback_.has_range() && std::abs(x - x_of(playback_.out())) < handle)
      drag_ = Drag::out;
    else
      drag_ = Drag::scrub;
    mouseMoveEvent(event);
  }
}

void TimelineTracks::mouseMoveEvent(QMouseEvent* event) {
  const double x = event->position().x();
  const int frame = static_cast<int>(std::lround(frame_at(x)));
  switch (drag_) {
    case Drag::scrub:
      playback_.pause();
      playback_.set_frame(static_cast<int>(std::floor(frame_at(x))));
      break;
    case Drag::in:
      playback_.set_range(std::min(frame, playback_.out() - 1), playback_.out());
      break;
    case Drag::out:
      playback_.set_range(playback_.in(), std::max(frame, playback_.in() + 1));
      break;
    case Drag::pan:
      first_ += dragged_from_ - frame_at(x);
      keep_view_inside();
      break;
    case Drag::none: {
      const bool end = playback_.has_range() && (std::abs(x - x_of(playback_.in())) < handle ||
                                                 std::abs(x - x_of(playback_.out())) < handle);
      setCursor(end ? Qt::SizeHorCursor : Qt::ArrowCursor);
      break;
    }
  }
}

void TimelineTracks::mouseReleaseEvent(QMouseEvent*) {
  drag_ = Drag::none;
}

void TimelineTracks::mouseDoubleClickEvent(QMouseEvent*) {
  first_ = shown_ = 0;
  update();
}

void TimelineTracks::wheelEvent(QWheelEvent* event) {
  const double under = frame_at(event->position().x());
  const double all = last_frame(), before = shown_ > 0 ? shown_ : all;
  shown_ = std::clamp(before * std::pow(0.85, event->angleDelta().y() / 120.0), std::min(10.0, all), all);
  first_ = under - (under - first_) * shown_ / before;
  keep_view_inside();
  event->accept();
}

void TimelineTracks::keep_view_inside() {
  const double all = last_frame();
  if (shown_ <= 0 || shown_ >= all) {
    first_ = shown_ = 0;
  } else {
    first_ = std::clamp(first_, 0.0, all - shown_);
  }
  update();
}

}  // namespace kinegraph
