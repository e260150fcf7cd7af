// Drawing the canvas: pictures of nodes and polylines; smooth lines once the view rests.
#include <QPainterPath>
#include <QTextLayout>
#include <cmath>

#include "gui/canvas/graph_canvas.h"

namespace kinegraph {
namespace {

constexpr double budget_while_moving_ms = 6;

QFont ui_font(double pixels, bool bold = false) {
  QFont font;
  font.setPixelSize(int(std::lround(pixels)));
  font.setBold(bold);
  return font;
}

// Wrapped into the box; what has no room there ends in an ellipsis.
void draw_wrapped(QPainter& p, const QRectF& box, const QString& text) {
  const double high = p.fontMetrics().lineSpacing();
  double y = box.top();
  qsizetype start = 0;  // of the paragraph
  for (const QString& paragraph : text.split('\n')) {
    QTextLayout layout(paragraph, p.font());
    layout.beginLayout();
    for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
      line.setLineWidth(box.width());
      if (y + high > box.bottom() + 1) return;
      const bool last = y + 2 * high > box.bottom() + 1;
      const QString rest = last ? text.mid(start + line.textStart()) : QString();
      p.drawText(
          QPointF(box.left(), y + p.fontMetrics().ascent()),
          last && rest.size() > line.textLength()
              ? p.fontMetrics().elidedText(QString(rest).replace('\n', ' '), Qt::ElideRight, int(box.width()))
              : paragraph.mid(line.textStart(), line.textLength()));
      y += high;
    }
    layout.endLayout();
    start += paragraph.size() + 1;
  }
}

}  // namespace

void GraphCanvas::paintEvent(QPaintEvent*) {
  QPainter p(this);
  p.fillRect(rect(), theme_->canvas);
  const QRectF seen(to_graph({-20, -20}), to_graph({width() + 20.0, height() + 20.0}));
  paint_grid(p);
  p.setRenderHint(QPainter::Antialiasing, resting_);
  paint_frames(p);
  paint_wires(p, seen);
  if (gesture_) gesture_->paint_below(p);
  p.setRenderHint(QPainter::Antialiasing, resting_);
  paint_nodes(p, seen);
  if (gesture_) gesture_->paint(p);
  p.setRenderHint(QPainter::Antialiasing, true);
  paint_mini_map(p);
  paint_hint(p);
  if (hasFocus()) {
    p.setRenderHint(QPainter::Antialiasing, false);
    p.setPen(QPen(theme_->accent, 1));
    p.setBrush(Qt::NoBrush);
    p.drawRect(rect().adjusted(0, 0, -1, -1));
  }
  if (pixmaps_.ran_out() && resting_) QTimer::singleShot(0, this, qOverload<>(&QWidget::update));
}

void GraphCanvas::paint_grid(QPainter& p) {
  double step = 40 * zoom_;
  while (step < 20) step *= 4;
  // Alike thick at any scale of the screen: as many whole pixels of it.
  const double ratio = devicePixelRatioF(), thick = std::max(1.0, std::floor(ratio)) / ratio;
  const auto whole = [ratio](double x) { return std::round(x * ratio) / ratio; };
  const double x0 = std::fmod(pan_.x(), step), y0 = std::fmod(pan_.y(), step);
  QList<QRectF> lines;
  for (double x = x0; x < width(); x += step) lines << QRectF(whole(x), 0, thick, height());
  for (double y = y0; y < height(); y += step) lines << QRectF(0, whole(y), width(), thick);
  p.setPen(Qt::NoPen);
  p.setBrush(theme_->grid);
  p.drawRects(lines);
}

void GraphCanvas::paint_frames(QPainter& p) {
  const double lettering = std::clamp(14 * zoom_, 10.0, 22.0);
  for (const SceneFrame& frame : scene_.frames()) {
    const QRectF box(to_view(frame.rect.topLeft()), to_view(frame.rect.bottomRight()));
    if (!box.intersects(QRectF(rect()))) continue;
    QColor color = frame.color.isEmpty() ? theme_->faint_text : QColor(frame.color);
    if (!color.isValid()) color = theme_->faint_text;
    QColor fill = color;
    fill.setAlpha(26);
    const bool chosen = selected_frames_.count(frame.name);
    p.setPen(QPen(chosen ? theme_->accent : color, chosen ? 2 : 1));
    p.setBrush(fill);
    p.drawRoundedRect(box, 8, 8);
    p.setFont(ui_font(lettering, true));
    p.setPen(theme_->text);
    p.drawText(QRectF(box.left() + 10, box.top(), box.width() - 20, std::max(34 * zoom_, lettering + 8)),
               Qt::AlignVCenter | Qt::TextSingleLine,
               QFontMetricsF(p.font()).elidedText(frame.title, Qt::ElideRight, box.width() - 20));
  }
  for (const SceneNote& note : scene_.notes()) {
    const QRectF box(to_view(note.rect.topLeft()), to_view(note.rect.bottomRight()));
    if (!box.intersects(QRectF(rect()))) continue;
    QColor fill = theme_->warning;
    fill.setAlpha(theme_->dark ? 40 : 50);
    const bool chosen = selected_notes_.count(note.name);
    p.setPen(QPen(chosen ? theme_->accent : theme_->warning, chosen ? 2 : 1));
    p.setBrush(fill);
    p.drawRoundedRect(box, 4, 4);
    if (zoom_ < 0.3) continue;
    p.setFont(ui_font(std::max(9.0, 12 * zoom_)));
    p.setPen(theme_->text);
    draw_wrapped(p, box.adjusted(8 * zoom_, 6 * zoom_, -8 * zoom_, -6 * zoom_),
                 note.text.isEmpty() ? tr("(empty note: double-click to write)") : note.text);
    if (chosen) {
      p.setPen(QPen(theme_->accent, 1.5));
      p.drawLine(box.bottomRight() - QPointF(10, 2), box.bottomRight() - QPointF(2, 10));
      p.drawLine(box.bottomRight() - QPointF(6, 2), box.bottomRight() - QPointF(2, 6));
    }
  }
}

void GraphCanvas::paint_wires(QPainter& p, const QRectF& seen) {
  const double width = std::clamp(2.2 * zoom_, 1.0, 3.0);
  QPolygonF line;
  for (const SceneWire& wire : scene_.wires()) {
    if (!wire.bounds.intersects(seen) || (gesture_ && gesture_->hides(wire))) continue;
    QColor color = wire.type.empty() ? theme_->wire : theme_->port(wire.type);
    const SceneNode* to = scene_.node(wire.to);
    const bool chosen = session_.selected().count(wire.from) || session_.selected().count(wire.to);
    if (to && !to->enabled) color.setAlphaF(0.45f);
    p.setPen(QPen(color, is_hovered(wire) ? width * 2.2 : chosen ? width * 1.5 : width));
    line.clear();
    // A picture of a curve that is a few pixels long needs no twenty pieces.
    const qsizetype stride = zoom_ < 0.4 && !resting_ ? 4 : zoom_ < 0.3 ? 2 : 1;
    for (qsizetype i = 0; i < wire.line.size(); i += stride) line << to_view(wire.line[i]);
    if ((wire.line.size() - 1) % stride) line << to_view(wire.line.back());
    p.drawPolyline(line);
  }
}

void GraphCanvas::paint_nodes(QPainter& p, const QRectF& seen) {
  pixmaps_.begin(zoom_, devicePixelRatioF(), resting_ ? 40 : budget_while_moving_ms);
  for (const std::size_t index : scene_.order()) {
    const SceneNode& node = scene_.nodes()[index];
    if (!node.rect.adjusted(-8, -8, 8, 8).intersects(seen)) continue;
    const NodeStatus* status = evaluation_.status(node.name);
    const QPointF at = to_view(node.rect.topLeft());
    const QRectF box(at, node.rect.size() * zoom_);
    // Under the node, so that its ports stay whole.
    if (session_.selected().count(node.name)) {
      const bool current = session_.current() == node.name;
      p.setPen(QPen(theme_->accent, current ? 5.5 : 3.5));
      p.setBrush(Qt::NoBrush);
      p.drawRoundedRect(box.adjusted(-0.5, -0.5, 0.5, 0.5), 7 * zoom_, 7 * zoom_);
    } else if (node.name == hover_node_ && !gesture_) {
      p.setPen(QPen(theme_->wire, 2.5));
      p.setBrush(Qt::NoBrush);
      p.drawRoundedRect(box.adjusted(-0.5, -0.5, 0.5, 0.5), 7 * zoom_, 7 * zoom_);
    }
    pixmaps_.draw(p, at, node, status, problem_of(node.name), *theme_);
    if (status && status->state == NodeStatus::State::running && !node.dot) {
      const double full = box.width() - 12 * zoom_;
      p.fillRect(QRectF(box.left() + 6 * zoom_, box.bottom() - 4 * zoom_, full, std::max(2.0, 2.5 * zoom_)),
                 theme_->line);
      p.fillRect(QRectF(box.left() + 6 * zoom_, box.bottom() - 4 * zoom_, full * status->progress,
                        std::max(2.0, 2.5 * zoom_)),
                 theme_->running);
    }
  }
  if (hover_ && !gesture_) {
    if (const SceneNode* node = scene_.node(hover_->node))
      if (const ScenePort* port = node->port(hover_->input, hover_->port)) {
        p.setRenderHint(QPainter::Antialiasing);
        draw_port(p, to_view(node->rect.topLeft() + port->at), 7 * std::max(0.6, zoom_),
                  Theme::shape(port->type), port->type.empty() ? theme_->wire : theme_->port(port->type),
                  theme_->canvas, true);
      }
  }
}

void GraphCanvas::paint_mini_map(QPainter& p) {
  const QRectF map = mini_map_rect();
  if (map.isNull()) return;
  p.setPen(QPen(theme_->line, 1));
  p.setBrush(theme_->panel);
  p.drawRoundedRect(map, 5, 5);
  const QRectF inside = map.adjusted(6, 6, -6, -6), all = scene_.bounds();
  const double scale = std::min(inside.width() / all.width(), inside.height() / all.height());
  const auto place = [&](QPointF graph) { return inside.center() + (graph - all.center()) * scale; };
  p.save();
  p.setClipRect(map.adjusted(1, 1, -1, -1));
  p.setRenderHint(QPainter::Antialiasing, false);
  for (const SceneNode& node : scene_.nodes()) {
    const QRectF box(place(node.rect.topLeft()), QSizeF(std::max(2.0, node.rect.width() * scale),
                                                        std::max(2.0, node.rect.height() * scale)));
    p.fillRect(box, session_.selected().count(node.name) ? theme_->accent : family_color(*theme_, node));
  }
  // What is out of sight is dimmed, so that the part in sight stands out among any number of nodes.
  const QRectF seen(place(to_graph({0, 0})), place(to_graph({double(width()), double(height())})));
  QPainterPath out_of_sight;
  out_of_sight.addRect(map);
  out_of_sight.addRect(seen.intersected(map));
  QColor veil = theme_->panel;
  veil.setAlphaF(0.6f);
  p.fillPath(out_of_sight, veil);
  p.setPen(QPen(theme_->accent, 1));
  p.setBrush(Qt::NoBrush);
  p.drawRect(seen);
  p.restore();
}

void GraphCanvas::paint_hint(QPainter& p) {
  if (hint_.isEmpty()) return;
  p.setFont(ui_font(12));
  const QRectF text = QFontMetricsF(p.font()).boundingRect(QRectF(0, 0, 320, 400), Qt::TextWordWrap, hint_);
  QRectF box(hint_at_ + QPointF(16, 18), text.size() + QSizeF(18, 10));
  if (box.right() > width() - 6) box.moveRight(width() - 6);
  if (box.bottom() > height() - 6) box.moveBottom(hint_at_.y() - 10);
  p.setPen(QPen(hint_refused_ ? theme_->error : theme_->line, 1));
  p.setBrush(theme_->raised);
  p.drawRoundedRect(box, 4, 4);
  p.setPen(hint_refused_ ? theme_->error : theme_->text);
  p.drawText(box.adjusted(9, 5, -9, -5), Qt::TextWordWrap, hint_);
}

}  // namespace kinegraph
