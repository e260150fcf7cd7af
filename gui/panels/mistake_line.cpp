#include "gui/panels/mistake_line.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QStyle>

namespace kinegraph {

MistakeLine::MistakeLine(QWidget* parent)
    : QWidget(parent), badge_(new QLabel(this)), words_(new QLabel(this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 1, 0, 3);
  row->setSpacing(6);
  row->addWidget(badge_, 0, Qt::AlignTop);
  row->addWidget(words_, 1);
  words_->setObjectName("param_mistake");
  words_->setWordWrap(true);
  words_->setTextFormat(Qt::PlainText);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  hide();
}

void MistakeLine::say(const QString& why) {
  if (why == words_->text()) return;
  words_->setText(why);
  // Drawn when it is seen: rows are told at each step of a slider that nothing is wrong.
  if (!why.isEmpty()) draw_badge();
  setVisible(!why.isEmpty());
}

void MistakeLine::draw_badge() {
  badge_->setPixmap(style()->standardIcon(QStyle::SP_MessageBoxCritical).pixmap(14, 14));
}

bool MistakeLine::says_something() const {
  return !words_->text().isEmpty();
}

void MistakeLine::changeEvent(QEvent* event) {
  if (event->type() == QEvent::StyleChange && says_something()) draw_badge();
  QWidget::changeEvent(event);
}

}  // namespace kinegraph
