#include "gui/canvas/node_painter.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace kinegraph {
namespace {

constexpr double corner = 6;

QFont font_of(double pixels, bool bold = false) {
  QFont font;
  font.setPixelSize(std::max(1, int(std::lround(pixels))));
  font.setBold(bold);
  font.setHintingPreference(QFont::PreferNoHinting);
  return font;
}

// Letters may stand narrower, but for so much, before some are left out.
QFont fitted(QFont font, const QString& text, double width) {
  const double wanted = QFontMetricsF(font).horizontalAdvance(text);
  if (wanted > width) font.setStretch(std::max(80, int(99 * width / wanted)));
  return font;
}

void draw_text(QPainter& p, const QRectF& box, Qt::Alignment align, const QString& text) {
  p.drawText(box, int(align | Qt::AlignVCenter | Qt::TextSingleLine),
             QFontMetricsF(p.font()).elidedText(text, Qt::ElideRight, box.width()));
}

QPolygonF ring_of_corners(int corners, double radius, double turned) {
  QPolygonF polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = turned + 2 * std::numbers::pi * i / corners;
    polygon << QPointF(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

}  // namespace

QColor family_color(const Theme& theme, const SceneNode& node) {
  if (!node.color.isEmpty()) {
    const QColor own(node.color);
    if (own.isValid()) return own;
  }
  if (node.missing) return theme.wire;
  static const std::map<std::string, const char*> types{
      {"files", "Metrics"}, {"motion", "Motion"},         {"time", "Warp"},         {"style", "Stats"},
      {"feet", "Contacts"}, {"components", "Components"}, {"cartoon", "Character"}, {"judge", "Points"}};
  auto found = types.find(node.category);
  return found == types.end() ? theme.wire : theme.port(found->second);
}

namespace {

void draw_badge(QPainter& p, QPointF centre, const QColor& color, const QColor& ink, const QString& sign) {
  p.setPen(Qt::NoPen);
  p.setBrush(color);
  p.drawEllipse(centre, 7, 7);
  p.setPen(ink);
  p.setFont(font_of(11, true));
  p.drawText(QRectF(centre - QPointF(7, 7.5), QSizeF(14, 14)), Qt::AlignCenter, sign);
}

// A sheet with lines: somebody wrote a note on this node.
void draw_note_mark(QPainter& p, QPointF at, const QColor& color) {
  p.setPen(QPen(color, 1));
  p.setBrush(Qt::NoBrush);
  p.drawRoundedRect(QRectF(at + QPointF(0.5, 0.5), QSizeF(9, 10)), 1.5, 1.5);
  for (const double y : {3.5, 5.5, 7.5}) p.drawLine(at + QPointF(2.5, y), at + QPointF(y > 7 ? 5.5 : 7.5, y));
}

void draw_dot(QPainter& p, const SceneNode& node, const Theme& theme) {
  const std::string& type = node.outputs.front().type;
  p.setPen(QPen(theme.node_line, 1));
  p.setBrush(type.empty() ? theme.wire : theme.port(type));
  p.drawEllipse(QPointF(10, 10), 8, 8);
}

}  // namespace

void draw_port(QPainter& p, QPointF at, double r, Theme::Shape shape, const QColor& color, const QColor& hole,
               bool filled) {
  p.save();
  p.translate(at);
  p.setPen(QPen(color, r * 0.36));
  p.setBrush(filled ? color : hole);
  using Shape = Theme::Shape;
  switch (shape) {
    case Shape::circle:
      p.drawEllipse(QPointF(), r, r);
      break;
    case Shape::ring:
      p.drawEllipse(QPointF(), r, r);
      p.setBrush(filled ? hole : color);
      p.setPen(Qt::NoPen);
      p.drawEllipse(QPointF(), r * 0.4, r * 0.4);
      break;
    case Shape::square:
      p.drawRect(QRectF(-r * 0.9, -r * 0.9, r * 1.8, r * 1.8));
      break;
    case Shape::diamond:
      p.drawPolygon(ring_of_corners(4, r * 1.2, 0));
      break;
    case Shape::triangle:
      p.drawPolygon(ring_of_corners(3, r * 1.25, 0));
      break;
    case Shape::hexagon:
      p.drawPolygon(ring_of_corners(6, r * 1.1, 0));
      break;
    case Shape::bar:
      p.drawRect(QRectF(-r * 0.55, -r * 1.15, r * 1.1, r * 2.3));
      break;
    case Shape::star: {
      QPolygonF star;
      for (int i = 0; i < 10; ++i) {
        const double angle = std::numbers::pi * (i / 5.0 - 0.5), reach = i % 2 ? r * 0.6 : r * 1.35;
        star << QPointF(reach * std::cos(angle), reach * std::sin(angle));
      }
      p.drawPolygon(star);
      break;
    }
  }
  p.restore();
}

QString shown_seconds(double seconds) {
  if (seconds < 0.0005) return "<1 ms";
  if (seconds < 1) return QString("%1 ms").arg(std::lround(seconds * 1000));
  if (seconds < 60) return QString("%1 s").arg(seconds, 0, 'f', 1);
  return QString("%1 min").arg(seconds / 60, 0, 'f', 1);
}

QString shown_state(NodeStatus::State state) {
  using State = NodeStatus::State;
  switch (state) {
    case State::idle:
      return QObject::tr("not computed yet");
    case State::waiting:
      return QObject::tr("waiting");
    case State::running:
      return QObject::tr("running");
    case State::done:
      return QObject::tr("up to date");
    case State::failed:
      return QObject::tr("failed");
    case State::blocked:
      return QObject::tr("blocked");
    case State::cancelled:
      return QObject::tr("cancelled");
    case State::disabled:
      return QObject::tr("disabled");
    case State::missing:
      return QObject::tr("unknown type");
    case State::incomplete:
      return QObject::tr("not linked yet");
  }
  return {};
}

QColor state_color(const Theme& theme, NodeStatus::State state) {
  using State = NodeStatus::State;
  switch (state) {
    case State::waiting:
    case State::running:
      return theme.running;
    case State::done:
      return theme.good;
    case State::failed:
      return theme.error;
    case State::blocked:
    case State::incomplete:
    case State::missing:
      return theme.warning;
    default:
      return theme.faint_text;
  }
}

namespace {

// What stands where a motion's still will be.
QString instead_of_still(NodeStatus::State state, const NodeStatus* status) {
  using State = NodeStatus::State;
  switch (state) {
    case State::idle:
      return QObject::tr("not computed yet");
    case State::waiting:
      return QObject::tr("waits for its turn");
    case State::running:
      return QObject::tr("computing…");
    case State::cancelled:
      return QObject::tr("stopped before it was done");
    case State::blocked:
      return status && !status->blocked_by.empty()
                 ? QObject::tr("waits for %1").arg(QString::fromStdString(status->blocked_by))
                 : QObject::tr("waits for what is before it");
    case State::incomplete:
      return QObject::tr("link what it needs");
    case State::failed:
      return QObject::tr("see Problems");
    case State::done:
      return QObject::tr("drawing its poses…");
    default:
      return {};
  }
}

// Farther limbs first: the right side, then the middle, then the left.
void draw_still(QPainter& p, const QRectF& box, const Still* still, const QString& instead,
                const Theme& theme) {
  if ((!still || still->limbs.empty()) && instead.isEmpty()) {
    p.setPen(Qt::NoPen);
    p.setBrush(theme.still_ground);
    p.drawRoundedRect(box, 3, 3);
    return;
  }
  if (!still || still->limbs.empty()) {
    p.setPen(QPen(theme.line, 1, Qt::DashLine));
    p.setBrush(Qt::NoBrush);
    p.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
    p.setPen(theme.faint_text);
    p.setFont(font_of(11));
    draw_text(p, box.adjusted(4, 0, -4, 0), Qt::AlignHCenter, instead);
    return;
  }
  p.setPen(Qt::NoPen);
  p.setBrush(theme.still_ground);
  p.drawRoundedRect(box, 3, 3);
  p.save();
  QPainterPath inside;
  inside.addRoundedRect(box, 3, 3);
  p.setClipPath(inside);
  const double room = box.height() - 9;
  const double across = box.width() / (still->figures + 0.1);
  const double scale = std::min(room / still->height, room);
  const double floor = box.bottom() - 4;
  const double pixel = 1 / (p.transform().m11() * p.device()->devicePixelRatioF());
  p.fillRect(QRectF(box.left() + 4, std::round(floor / pixel) * pixel, box.width() - 8,
                    std::max(1.0, std::round(1 / pixel)) * pixel),
             theme.line);
  for (const auto side : {Still::Side::right, Still::Side::middle, Still::Side::left}) {
    QColor color = side == Still::Side::left    ? theme.left
                   : side == Still::Side::right ? theme.right
                                                : theme.bone;
    p.setPen(QPen(color, 1.6, Qt::SolidLine, Qt::RoundCap));
    for (const Still::Limb& limb : still->limbs) {
      if (limb.side != side) continue;
      const double x = box.left() + across * (limb.figure + 0.55);
      const auto at = [&](QPointF point) {
        return QPointF(x + point.x() * scale, floor - point.y() * scale);
      };
      p.drawLine(at(limb.line.p1()), at(limb.line.p2()));
    }
  }
  p.restore();
}

// "needs motion", "needs motion, style".
QString what_it_needs(const NodeStatus& status) {
  QStringList ports;
  for (const Diagnostic& open : status.diagnostics)
    if (!open.port.empty()) ports << QString::fromStdString(open.port);
  return ports.isEmpty() ? QObject::tr("needs an input") : QObject::tr("needs %1").arg(ports.join(", "));
}

// What stands beside the type: the first of these that has room there, else the last.
QStringList beside_type(const SceneNode& node, NodeStatus::State state, const NodeStatus* status) {
  using State = NodeStatus::State;
  switch (state) {
    case State::idle:
      if (node.effect) return {QObject::tr("not run yet"), QObject::tr("not run")};
      // A motion's still says so.
      return node.still.isNull() ? QStringList{shown_state(state), QObject::tr("not computed"), {}}
                                 : QStringList();
    case State::done: {
      if (status->seconds <= 0 && status->cached.empty()) return {};
      const bool cached = status->cached == "memory" || status->cached == "disk";
      if (!cached) return {shown_seconds(status->seconds)};
      const QString from_cache = QObject::tr("cached");
      if (status->seconds < 0.0005) return {from_cache};
      return {shown_seconds(status->seconds) + " · " + from_cache, from_cache};
    }
    case State::failed:
      return status && status->broken_rules > 0 ? QStringList{QObject::tr("check failed"), shown_state(state)}
                                                : QStringList{shown_state(state)};
    case State::blocked:
      return status->blocked_by.empty()
                 ? QStringList{shown_state(state)}
                 : QStringList{QObject::tr("blocked by %1").arg(QString::fromStdString(status->blocked_by)),
                               shown_state(state)};
    case State::incomplete:
      return {what_it_needs(*status)};
    case State::running:
      return {QObject::tr("running · %1 %").arg(int(100 * status->progress)), shown_state(state)};
    default:
      return {shown_state(state)};
  }
}

bool has_warning(const NodeStatus* status, std::optional<Severity> problem) {
  return problem == Severity::warning ||
         (status && std::any_of(status->diagnostics.begin(), status->diagnostics.end(),
                                [](const Diagnostic& d) { return d.severity == Severity::warning; }));
}

// How it stands as a dot; a ring where its time is yet to come.
void draw_state(QPainter& p, QPointF at, double radius, const QColor& color, NodeStatus::State state) {
  const bool ring = state == NodeStatus::State::waiting;
  p.setPen(ring ? QPen(color, radius * 0.5) : QPen(Qt::NoPen));
  p.setBrush(ring ? QBrush(Qt::NoBrush) : QBrush(color));
  if (ring) radius *= 0.8;
  p.drawEllipse(at, radius, radius);
}

// What a node shows from afar: its name, at least 9 pixels on the screen, its type and its still where there
// is room, and its state as a dot in the corner, where it never meets the name.
void draw_small(QPainter& p, const SceneNode& node, const NodeStatus* status, NodeStatus::State state,
                bool bad, std::optional<Severity> problem, const QRectF& box, const QColor& ink,
                const Theme& theme, double zoom) {
  const double pixel = 1 / zoom, top_edge = 3 * pixel;
  const double dot = std::clamp(3.4 * pixel, 5.0, box.height() / 5);
  const double left = std::max(11.0, 6 * pixel);
  const bool with_dot = state != NodeStatus::State::idle || bad;
  const QPointF corner_dot(box.right() - 2.3 * dot, top_edge + 2 * dot);
  const QString name = QString::fromStdString(node.name);
  const auto wide = [&](double at) { return QFontMetricsF(font_of(at, true)).horizontalAdvance(name); };
  const Still* known = status ? status->still.get() : nullptr;
  const bool with_still = !node.still.isNull() && zoom >= 0.3;
  const double largest = std::clamp(10.6 * pixel, 14.0, 44.0), smallest = 9.2 * pixel;
  const double type_pixels = 9 * pixel, type_line = type_pixels * 1.35;
  const double below = with_still ? 0.42 * box.height() : 0;
  const double room = box.height() - top_edge - below;
  const bool with_type = zoom >= 0.34 && room >= largest * 1.3 + type_line;
  // Names are of two sizes only.
  const auto beside_dot = [&](double pixels) {
    const double high = pixels * 1.3 + (with_type ? type_line : 0);
    const double top = with_still ? top_edge + 3 * pixel : top_edge + std::max(0.0, room - high) / 2;
    const bool meets = with_dot && top + 0.25 * pixels < corner_dot.y() + dot;
    return std::pair(top, box.width() - left - (meets ? 4 * dot : 5 * pixel));
  };
  double pixels = largest;
  if (wide(pixels) > beside_dot(pixels).second) pixels = std::min(pixels, smallest);
  const auto [top, across] = beside_dot(pixels);
  const double line = pixels * 1.3;
  p.setFont(fitted(font_of(pixels, true), name, across));
  p.setPen(ink);
  // Of a letter or two with an ellipsis nobody reads anything.
  const bool legible = across > std::min(wide(pixels), 3 * pixels);
  if (legible) draw_text(p, QRectF(left, top, across, line), Qt::AlignLeft, name);
  double bottom = top + line;
  if (with_type) {
    const QString type = QString::fromStdString(node.type);
    const QRectF words(left, bottom, box.width() - left - 5 * pixel, type_line);
    p.setFont(fitted(font_of(type_pixels), type, words.width()));
    p.setPen(theme.faint_text);
    draw_text(p, words, Qt::AlignLeft, type);
    bottom += type_line;
  }
  if (with_still) {
    const double free = box.height() - 7 - bottom - 3 * pixel;
    const double high = std::min(free, 1.2 * node.still.height());
    draw_still(p, QRectF(8, box.height() - 7 - high, box.width() - 16, high), known, {}, theme);
  }
  if (!with_dot) return;
  const bool plain = !bad && !has_warning(status, problem);
  draw_state(p, corner_dot, dot,
             plain ? state_color(theme, state)
             : bad ? theme.error
                   : theme.warning,
             plain ? state : NodeStatus::State::done);
}

}  // namespace

void draw_node(QPainter& p, const SceneNode& node, const NodeStatus* status, std::optional<Severity> problem,
               const Theme& theme, double zoom) {
  p.save();
  p.scale(zoom, zoom);
  if (node.dot) {
    draw_dot(p, node, theme);
    p.restore();
    return;
  }
  using State = NodeStatus::State;
  const State state = node.missing    ? State::missing
                      : !node.enabled ? State::disabled
                      : status        ? status->state
                                      : State::idle;
  // Edges and separators lie on whole pixels of the screen at any zoom, so that they stay sharp.
  const double pixel = 1 / (zoom * p.device()->devicePixelRatioF());
  const auto whole = [pixel](double length) { return std::round(length / pixel) * pixel; };
  const bool bad = state == State::failed || problem == Severity::error;
  const double edge_width = std::max(pixel, whole(bad ? 1.6 : 1.2));
  const QRectF box(edge_width / 2, edge_width / 2, whole(node.rect.width()) - edge_width,
                   whole(node.rect.height()) - edge_width);
  QColor family = family_color(theme, node);
  if (!node.enabled) family.setAlphaF(0.4f);
  const bool small = zoom < 0.6;

  QPainterPath outline;
  outline.addRoundedRect(box, corner, corner);
  QColor body = theme.node;
  if (!node.enabled) body.setAlphaF(0.55f);
  p.fillPath(outline, body);
  p.save();
  p.setClipPath(outline);
  QColor title = theme.node_title;
  if (!node.color.isEmpty() && QColor(node.color).isValid()) {
    const QColor own(node.color);
    title = QColor::fromRgbF(title.redF() * 0.65f + own.redF() * 0.35f,
                             title.greenF() * 0.65f + own.greenF() * 0.35f,
                             title.blueF() * 0.65f + own.blueF() * 0.35f);
  }
  if (!node.enabled) title.setAlphaF(0.55f);
  if (small) {
    p.fillRect(box, title);
  } else {
    p.fillRect(QRectF(0, 0, box.width() + edge_width, whole(40)), title);
  }
  p.fillRect(QRectF(0, 0, box.width() + edge_width, whole(small ? 3 / zoom : 3)), family);
  p.restore();
  QPen edge(bad ? theme.error : state == State::missing ? theme.warning : theme.node_line, edge_width);
  if (state == State::missing || !node.enabled) edge.setStyle(Qt::DashLine);
  p.setPen(edge);
  p.setBrush(Qt::NoBrush);
  p.drawPath(outline);

  const QColor ink = node.enabled ? theme.text : theme.faint_text;
  const QString name = QString::fromStdString(node.name);
  if (small) {
    draw_small(p, node, status, state, bad, problem, box, ink, theme, zoom);
  } else {
    p.setFont(font_of(13, true));
    p.setPen(ink);
    draw_text(p, QRectF(12, 5, box.width() - (node.note.isEmpty() ? 40 : 58), 18), Qt::AlignLeft, name);
    if (!node.note.isEmpty()) draw_note_mark(p, QPointF(box.width() - 38, 9), theme.faint_text);
    p.setFont(font_of(11));
    p.setPen(theme.faint_text);
    const QFontMetricsF metrics(p.font());
    const QString type = QString::fromStdString(node.type);
    const double line = box.width() - 24, room = line - metrics.horizontalAdvance(type) - 8;
    const QStringList said = beside_type(node, state, status);
    QString right = said.isEmpty() ? QString() : said.back();
    for (const QString& words : said)
      if (metrics.horizontalAdvance(words) <= room) {
        right = words;
        break;
      }
    const double right_width = right.isEmpty() ? 0 : metrics.horizontalAdvance(right) + 1;
    draw_text(p, QRectF(12, 21, right.isEmpty() ? line : line - right_width - 7, 16), Qt::AlignLeft, type);
    if (!right.isEmpty()) {
      if (state == State::failed || state == State::blocked || state == State::missing ||
          state == State::incomplete)
        p.setPen(state_color(theme, state));
      draw_text(p, QRectF(box.width() - 12 - right_width, 21, right_width, 16), Qt::AlignRight, right);
    }
    const QPointF badge(box.width() - 16, 14);
    if (bad)
      draw_badge(p, badge, theme.error, theme.node, "!");
    else if (has_warning(status, problem) || state == State::incomplete || state == State::missing)
      draw_badge(p, badge, theme.warning, theme.node, "!");
    else if (state != State::idle)
      draw_state(p, badge, 4, state_color(theme, state), state);
    p.setFont(font_of(11.5));
    for (const bool input : {true, false})
      for (const ScenePort& port : input ? node.inputs : node.outputs) {
        p.setPen(port.linked || !port.optional ? ink : theme.faint_text);
        const double half =
            node.inputs.empty() || node.outputs.empty() ? box.width() - 24 : box.width() / 2 - 10;
        const QRectF label(input ? 12 : box.width() - 12 - half, port.at.y() - 9, half, 18);
        draw_text(p, label, input ? Qt::AlignLeft : Qt::AlignRight,
                  QString::fromStdString(port.name) + (port.list ? " +" : ""));
      }
    if (!node.still.isNull())
      draw_still(p, node.still, status ? status->still.get() : nullptr, instead_of_still(state, status),
                 theme);
    if (node.expandable) {
      p.setPen(theme.faint_text);
      p.setFont(font_of(11));
      draw_text(
          p, node.more.adjusted(12, 0, -12, 0), Qt::AlignHCenter,
          node.expanded ? QObject::tr("show fewer") : QObject::tr("+ %1 more ports").arg(node.hidden_ports));
    }
    if (!node.values.empty()) {
      double y = box.height() - 5 - 17.0 * double(node.values.size());
      p.fillRect(QRectF(8, whole(y - 3), box.width() - 16, std::max(pixel, whole(1))), theme.line);
      p.setFont(font_of(11));
      for (const SceneValue& value : node.values) {
        const double name_width = std::min(QFontMetricsF(p.font()).horizontalAdvance(value.name) + 8, 84.0);
        p.setPen(theme.faint_text);
        draw_text(p, QRectF(12, y, name_width, 17), Qt::AlignLeft, value.name);
        p.setPen(ink);
        draw_text(p, QRectF(12 + name_width, y, box.width() - 24 - name_width, 17), Qt::AlignRight,
                  value.value);
        y += 17;
      }
    }
  }
  const double radius = small ? std::min(5.0, 3.2 / zoom) : 5;
  for (const bool input : {true, false})
    for (const ScenePort& port : input ? node.inputs : node.outputs)
      draw_port(p, port.at, radius, Theme::shape(port.type),
                port.type.empty() ? theme.wire : theme.port(port.type), theme.canvas, port.linked);
  p.restore();
}

}  // namespace kinegraph
