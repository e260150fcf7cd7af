#include "gui/window/notice_bar.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStyle>

namespace kinegraph {

NoticeBar::NoticeBar(QWidget* parent)
    : QFrame(parent), sign_(new QLabel(this)), label_(new QLabel(this)), layout_(new QHBoxLayout(this)) {
  setObjectName("notice_bar");
  setAccessibleName(tr("Notice"));
  layout_->setContentsMargins(12, 6, 8, 6);
  label_->setObjectName("notice_text");
  label_->setWordWrap(true);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  sign_->setFixedSize(16, 16);
  layout_->setSpacing(8);
  layout_->addWidget(sign_);
  layout_->addWidget(label_, 1);
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, &QWidget::hide);
  hide();
}

// Its sign is drawn in the colours of the theme.
void NoticeBar::changeEvent(QEvent* event) {
  if (event->type() == QEvent::StyleChange) draw_sign();
  QFrame::changeEvent(event);
}

void NoticeBar::draw_sign() {
  const QStyle::StandardPixmap signs[] = {QStyle::SP_MessageBoxInformation, QStyle::SP_DialogApplyButton,
                                          QStyle::SP_MessageBoxWarning, QStyle::SP_MessageBoxCritical};
  const QIcon sign = style()->standardIcon(signs[static_cast<int>(kind_)]);
  sign_->setPixmap(sign.pixmap(QSize(16, 16), devicePixelRatioF()));
}

void NoticeBar::say(Kind kind, const QString& message, std::vector<Answer> answers, int seconds) {
  for (QWidget* button : buttons_) {
    button->hide();  // one of them may have been clicked just now
    button->deleteLater();
  }
  buttons_.clear();
  kind_ = kind;
  static const char* const names[] = {"info", "good", "warning", "error"};
  setProperty("kind", QString(names[static_cast<int>(kind)]));
  style()->unpolish(this);  // its edge has the colour of its kind
  style()->polish(this);
  draw_sign();
  label_->setText(message);
  answers.push_back({tr("Close"), [] {}});
  for (Answer& answer : answers) {
    auto* button = new QPushButton(answer.text, this);
    button->setAccessibleName(answer.text);
    connect(button, &QPushButton::clicked, this, [this, act = std::move(answer.act)] {
      hide();
      act();
    });
    layout_->addWidget(button);
    button->show();  // also on a bar that is shown already
    buttons_.push_back(button);
  }
  timer_.stop();
  if (seconds) timer_.start(seconds * 1000);
  show();
}

}  // namespace kinegraph
