#include "gui/look/elided_line.h"

#include <QHelpEvent>
#include <QPainter>
#include <QStyleOptionFrame>
#include <QToolTip>

namespace kinegraph {
namespace {
constexpr int beside_text = 2;  // as QLineEdit keeps free at each side
}

QRect ElidedLine::room() const {
  QStyleOptionFrame panel;
  initStyleOption(&panel);
  return style()
      ->subElementRect(QStyle::SE_LineEditContents, &panel, this)
      .marginsRemoved(textMargins())
      .adjusted(beside_text, 0, -beside_text, 0);
}

bool ElidedLine::is_cut() const {
  return fontMetrics().horizontalAdvance(text()) > room().width();
}

void ElidedLine::paintEvent(QPaintEvent* event) {
  if (hasFocus() || !is_cut()) return QLineEdit::paintEvent(event);
  QPainter painter(this);
  QStyleOptionFrame panel;
  initStyleOption(&panel);
  style()->drawPrimitive(QStyle::PE_PanelLineEdit, &panel, &painter, this);
  painter.setPen(palette().color(isEnabled() ? QPalette::Normal : QPalette::Disabled, QPalette::Text));
  const QRect words = room();
  painter.drawText(words, Qt::AlignVCenter | Qt::AlignLeft,
                   fontMetrics().elidedText(text(), mode_, words.width()));
}

bool ElidedLine::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && is_cut()) {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(),
                       toolTip().isEmpty() ? text() : text() + "\n" + toolTip(), this);
    return true;
  }
  return QLineEdit::event(event);
}

}  // namespace kinegraph
