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
  words_->setText(why);
  badge_->setPixmap(style()->standardIcon(QStyle::SP_MessageBoxCritical).pixmap(14, 14));
  setVisible(!why.isEmpty());
}

bool MistakeLine::says_something() const {
  return !words_->text().isEmpty();
}

void MistakeLine::changeEvent(QEvent* event) {
  if (event->type() == QEvent::StyleChange && says_something()) say(words_->text());
  QWidget::changeEvent(event);
}

}  // namespace kinegraph
