#include "gui/panels/text_field.h"

#include <QHBoxLayout>

#include "gui/panels/typed_words.h"

namespace kinegraph {

QHBoxLayout* row_of(QWidget* field) {
  auto* row = new QHBoxLayout(field);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  return row;
}

TextField::TextField(const Param& param, QWidget* parent)
    : ParamField(parent), type_(param), line_(new ElidedLine(this)) {
  row_of(this)->addWidget(line_, 1);
  line_->setAccessibleName(QString::fromStdString(param.name));
  line_->setPlaceholderText(param.kind == ParamType::Kind::text ? QObject::tr("not set")
                                                                : QString::fromStdString(described(param)));
  setFocusProxy(line_);
  connect(line_, &QLineEdit::editingFinished, this, [this] {
    if (line_->text() == shown_) return void(emit corrected());
    QString why;
    if (const auto value = typed_value(type_, line_->text(), &why))
      emit edited(*value);
    else
      emit wrong(why);
  });
}

void TextField::show_value(const Json& value) {
  shown_ = typed_text(type_, value);
  line_->setText(shown_);
  line_->setCursorPosition(0);
}

}  // namespace kinegraph
