#include "gui/window/state_line.h"

#include <QPainter>

namespace kinegraph {
namespace {

constexpr int room_for_dot = 16;  // pixels before the words

}  // namespace

StateLine::StateLine(QWidget* parent) : QLabel(parent), theme_(&dark_theme()) {
  setObjectName("state_line");
  setAccessibleName(tr("State of the evaluation"));
  setContentsMargins(room_for_dot, 0, 2, 0);
}

void StateLine::say(const Standing& standing) {
  setText(standing.words);
  if (tone_ == standing.tone) return;
  tone_ = standing.tone;
  update();
}

void StateLine::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
}

void StateLine::paintEvent(QPaintEvent* event) {
  QLabel::paintEvent(event);
  if (text().isEmpty()) return;
  using Tone = Standing::Tone;
  QPainter p(this);
  p.setRenderHint(QPainter::Antialiasing);
  p.setPen(Qt::NoPen);
  p.setBrush(tone_ == Tone::error     ? theme_->error
             : tone_ == Tone::warning ? theme_->warning
             : tone_ == Tone::busy    ? theme_->running
             : tone_ == Tone::good    ? theme_->good
                                      : theme_->faint_text);
  p.drawEllipse(QPointF(room_for_dot / 2.0 - 1, height() / 2.0 + 0.5), 4, 4);
}

}  // namespace kinegraph
