#include "gui/window/example_card.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "graph/file/read.h"
#include "graph/nested.h"
#include "gui/canvas/node_painter.h"

namespace kinegraph {
namespace {

GraphScene graph_of(const QString& path, const Registry& registry) {
  GraphScene scene;
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return scene;
  ReadResult read = read_document(file.readAll().toStdString(), path.toStdString(), registry);
  if (!has_error(read.problems)) scene.rebuild(read.document, registry, {});
  return scene;
}

}  // namespace

ExampleCard::ExampleCard(const QString& path, const QString& about, const Registry& registry, QWidget* parent)
    : QPushButton(parent), graph_(graph_of(path, registry)), about_(about), theme_(&dark_theme()) {
  title_ = QFileInfo(path).fileName().remove(".kg.json").replace('_', ' ');
  if (!title_.isEmpty()) title_[0] = title_[0].toUpper();
  setAccessibleName(title_);
  setAccessibleDescription(about);
  setToolTip((about.isEmpty() ? QString() : about + "\n") + QDir::toNativeSeparators(path));
  setCursor(Qt::PointingHandCursor);
  setAttribute(Qt::WA_Hover);
  resize(wide, high);
}

void ExampleCard::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
}

void ExampleCard::paint_graph(QPainter& p, const QRectF& room) const {
  const QRectF all = graph_.bounds();
  if (all.isEmpty()) return;
  const double scale = std::min({room.width() / all.width(), room.height() / all.height(), 0.22});
  const auto place = [&](QPointF at) { return room.center() + (at - all.center()) * scale; };
  for (const SceneWire& wire : graph_.wires()) {
    p.setPen(QPen(wire.type.empty() ? theme_->wire : theme_->port(wire.type), 1));
    QPolygonF line;
    for (const QPointF& point : wire.line) line << place(point);
    p.drawPolyline(line);
  }
  for (const SceneNode& node : graph_.nodes()) {
    const QRectF box(place(node.rect.topLeft()), place(node.rect.bottomRight()));
    p.setPen(Qt::NoPen);
    QPainterPath outline;
    outline.addRoundedRect(box, 2, 2);
    p.save();
    p.setClipPath(outline);
    p.fillRect(box, theme_->dark ? theme_->node_title.lighter(130) : theme_->node_title.darker(108));
    p.fillRect(QRectF(box.topLeft(), QSizeF(box.width(), std::max(2.5, box.height() * 0.22))),
               family_color(*theme_, node));
    p.restore();
  }
}

void ExampleCard::paintEvent(QPaintEvent*) {
  QPainter p(this);
  p.setRenderHint(QPainter::Antialiasing);
  const bool lit = underMouse() || hasFocus();
  p.setPen(QPen(lit ? theme_->accent : theme_->line, hasFocus() ? 2 : 1));
  p.setBrush(isDown() ? theme_->selection : lit ? theme_->raised : theme_->panel);
  p.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 7, 7);
  paint_graph(p, QRectF(rect()).adjusted(14, 12, -14, -66));
  QFont font;
  font.setPixelSize(12);
  font.setBold(true);
  p.setFont(font);
  p.setPen(theme_->text);
  p.drawText(QRect(12, height() - 60, width() - 20, 20), Qt::AlignLeft | Qt::AlignVCenter,
             QFontMetrics(font).elidedText(title_, Qt::ElideRight, width() - 20));
  font.setPixelSize(11);
  font.setBold(false);
  p.setFont(font);
  p.setPen(theme_->faint_text);
  p.drawText(QRect(12, height() - 40, width() - 24, 32), Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap,
             about_);
}

}  // namespace kinegraph
