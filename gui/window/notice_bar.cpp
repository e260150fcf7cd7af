#include "gui/window/notice_bar.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>
#include <algorithm>

#include "gui/look/words.h"

namespace kinegraph {

NoticeBar::NoticeBar(QWidget* parent)
    : QFrame(parent),
      sign_(new QLabel(this)),
      label_(new QLabel(this)),
      close_(new QToolButton(this)),
      layout_(new QHBoxLayout(this)) {
  setObjectName("notice_bar");
  setAccessibleName(tr("Notice"));
  layout_->setContentsMargins(12, 6, 8, 6);
  label_->setObjectName("notice_text");
  label_->setWordWrap(true);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  sign_->setFixedSize(16, 16);
  layout_->setSpacing(8);
  layout_->addWidget(sign_);
  layout_->addWidget(label_, 1);  // as wide as its words need, see set_words()
  layout_->addStretch(0);
  close_->setObjectName("notice_close");
  close_->setAccessibleName(tr("Close"));
  close_->setToolTip(tr("Close"));
  close_->setIconSize({12, 12});
  close_->setFocusPolicy(Qt::TabFocus);
  connect(close_, &QToolButton::clicked, this, &QWidget::hide);
  layout_->addWidget(close_);
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, &QWidget::hide);
  hide();
}

// Its sign is drawn in the colours of the theme.
void NoticeBar::changeEvent(QEvent* event) {
  if (event->type() == QEvent::StyleChange) draw_sign();
  QFrame::changeEvent(event);
}

void NoticeBar::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  set_words();
}

// In lines about as long as each other, in the room that the buttons leave.
void NoticeBar::set_words() {
  const QMargins around = layout_->contentsMargins();
  int room = width() - around.left() - around.right() - sign_->width() - close_->sizeHint().width() -
             3 * layout_->spacing();
  for (const QWidget* button : buttons_) room -= button->sizeHint().width() + layout_->spacing();
  int wide = 1;
  for (const QString& line : label_->text().split('\n'))
    wide = std::max(wide, balanced_width(label_->fontMetrics(), line, std::max(room, 120)));
  label_->setMaximumWidth(wide + 2);
}

void NoticeBar::draw_sign() {
  close_->setIcon(style()->standardIcon(QStyle::SP_DockWidgetCloseButton));
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
  topic_.clear();
  static const char* const names[] = {"info", "good", "warning", "error"};
  setProperty("kind", QString(names[static_cast<int>(kind)]));
  style()->unpolish(this);  // its edge has the colour of its kind
  style()->polish(this);
  draw_sign();
  label_->setText(message);
  for (Answer& answer : answers) {
    auto* button = new QPushButton(answer.text, this);
    button->setAccessibleName(answer.text);
    connect(button, &QPushButton::clicked, this, [this, act = std::move(answer.act)] {
      hide();
      act();
    });
    layout_->insertWidget(layout_->count() - 1, button);
    button->show();  // also on a bar that is shown already
    buttons_.push_back(button);
  }
  set_words();
  timer_.stop();
  if (seconds) timer_.start(seconds * 1000);
  show();
}

}  // namespace kinegraph
