// Choices, switches, text, files, ranges and units.
#include "gui/panels/param_field.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QStyle>
#include <QToolButton>
#include <QWheelEvent>

#include "gui/document/problem_text.h"
#include "gui/look/ask_file.h"
#include "gui/panels/arithmetic.h"
#include "gui/panels/text_field.h"

namespace kinegraph {
namespace {

// Scrolling a panel must not change what it scrolls over.
template <class Widget>
class Still : public Widget {
 public:
  using Widget::Widget;

 protected:
  void wheelEvent(QWheelEvent* event) override { event->ignore(); }
};

// A folder, in the ink of the theme that is shown.
class FolderButton : public QToolButton {
 public:
  explicit FolderButton(QWidget* parent) : QToolButton(parent) { draw(); }

 protected:
  void changeEvent(QEvent* event) override {
    if (event->type() == QEvent::StyleChange) draw();
    QToolButton::changeEvent(event);
  }

 private:
  void draw() { setIcon(style()->standardIcon(QStyle::SP_DirIcon)); }
};

class BooleanField : public ParamField {
 public:
  BooleanField(const Param& param, QWidget* parent) : ParamField(parent), box_(new QCheckBox(this)) {
    row_of(this)->addWidget(box_);
    box_->setAccessibleName(QString::fromStdString(param.name));
    connect(box_, &QCheckBox::clicked, this, [this](bool on) { emit edited(Json(on)); });
    setFocusProxy(box_);
  }
  void show_value(const Json& value) override { box_->setChecked(value.is_boolean() && value.boolean()); }

 private:
  QCheckBox* box_;
};

class ChoiceField : public ParamField {
 public:
  ChoiceField(const Param& param, bool also_number, QWidget* parent)
      : ParamField(parent), type_(param), box_(new Still<QComboBox>(this)) {
    row_of(this)->addWidget(box_);
    box_->setAccessibleName(QString::fromStdString(param.name));
    box_->setEditable(also_number);
    box_->setInsertPolicy(QComboBox::NoInsert);
    box_->setMinimumContentsLength(6);
    box_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    for (const ParamType::Choice& choice : param.choices) {
      box_->addItem(QString::fromStdString(choice.key));
      box_->setItemData(box_->count() - 1, QString::fromStdString(choice.help), Qt::ToolTipRole);
    }
    setFocusProxy(box_);
    connect(box_, &QComboBox::activated, this, [this] { send(); });
    if (also_number) connect(box_->lineEdit(), &QLineEdit::editingFinished, this, [this] { send(); });
  }
  void show_value(const Json& value) override {
    const QString text = typed_text(value);
    const int at = box_->findText(text);
    if (at >= 0)
      box_->setCurrentIndex(at);
    else if (box_->isEditable())
      box_->setEditText(text);
    box_->setToolTip(at >= 0 ? box_->itemData(at, Qt::ToolTipRole).toString() : QString());
    shown_ = text;
  }

 private:
  void send() {
    const QString text = box_->currentText();
    if (text == shown_) return;
    QString why;
    Json value = text.toStdString();
    if (box_->findText(text) < 0)
      if (const auto number = calculated(text)) value = *number;
    const Diagnostics problems = check(type_, value, type_.name);
    if (has_error(problems)) {
      emit wrong(QString::fromStdString(problems.front().message));
      return;
    }
    emit edited(value);
  }
  ParamType type_;
  Still<QComboBox>* box_;
  QString shown_;
};

class FileField : public TextField {
 public:
  FileField(const Param& param, const FieldContext& context, QWidget* parent)
      : TextField(param, parent), context_(context) {
    line_->setPlaceholderText(param.kind == ParamType::Kind::open_file ? tr("no file")
                                                                       : tr("where to write"));
    auto* button = new FolderButton(this);
    button->setAccessibleName(tr("Choose a file for %1").arg(QString::fromStdString(param.name)));
    button->setToolTip(tr("Choose a file"));
    layout()->addWidget(button);
    connect(button, &QToolButton::clicked, this, [this] {
      const QString start = QDir(context_.folder).absoluteFilePath(line_->text());
      const QString path = type_.kind == ParamType::Kind::open_file
                               ? ask_to_open(this, tr("Choose a file"), start)
                               : ask_where_to_save(this, tr("Where to write"), start);
      if (!path.isEmpty()) emit edited(Json(context_.written_path(path).toStdString()));
    });
  }

 private:
  FieldContext context_;
};

class RangeField : public ParamField {
 public:
  RangeField(const Param& param, QWidget* parent)
      : ParamField(parent), type_(param), start_(new QLineEdit(this)), end_(new QLineEdit(this)) {
    auto* row = row_of(this);
    row->addWidget(start_, 1);
    row->addWidget(new QLabel("–", this));
    row->addWidget(end_, 1);
    start_->setAccessibleName(tr("%1: first frame").arg(QString::fromStdString(param.name)));
    end_->setAccessibleName(tr("%1: frame after the last").arg(QString::fromStdString(param.name)));
    start_->setPlaceholderText("0");
    end_->setPlaceholderText(tr("end"));
    setFocusProxy(start_);
    for (QLineEdit* line : {start_, end_})
      connect(line, &QLineEdit::editingFinished, this, [this] { send(); });
  }
  void show_value(const Json& value) override {
    const bool pair = value.is_array() && value.array().size() == 2;
    start_->setText(pair ? typed_text(value.array()[0]) : typed_text(value));
    end_->setText(pair && !value.array()[1].is_null() ? typed_text(value.array()[1]) : QString());
    shown_ = start_->text() + ":" + end_->text();
  }
  bool is_being_edited() const override {
    return (start_->hasFocus() || end_->hasFocus()) && start_->text() + ":" + end_->text() != shown_;
  }

 private:
  void send() {
    if (start_->text() + ":" + end_->text() == shown_) return;
    const auto first =
        start_->text().trimmed().isEmpty() ? std::optional<double>(0) : calculated(start_->text());
    const bool open = end_->text().trimmed().isEmpty() || end_->text().trimmed() == "end";
    const auto last = open ? std::optional<double>(0) : calculated(end_->text());
    if (!first || !last) {
      emit wrong(tr("A range is two frame numbers; an open end is left empty."));
      return;
    }
    const Json value = Json::Array{Json(*first), open ? Json() : Json(*last)};
    const Diagnostics problems = check(type_, value, type_.name);
    if (has_error(problems))
      emit wrong(QString::fromStdString(problems.front().message));
    else
      emit edited(value);
  }
  ParamType type_;
  QLineEdit *start_, *end_;
  QString shown_;
};

bool is_choice_or_number(const ParamType& type) {
  return type.kind == ParamType::Kind::either && type.parts.size() == 2 &&
         type.parts[0].kind == ParamType::Kind::choice &&
         (type.parts[1].kind == ParamType::Kind::number || type.parts[1].kind == ParamType::Kind::integer);
}

}  // namespace

QString typed_text(const Json& value) {
  if (value.is_string()) return QString::fromStdString(value.string());
  if (value.is_number()) return QString::fromStdString(shortest_number(value.number()));
  if (value.is_null()) return {};
  return QString::fromStdString(compact(value));
}

std::optional<Json> typed_value(const ParamType& type, const QString& text, QString* why) {
  using Kind = ParamType::Kind;
  Json value;
  if (type.kind == Kind::number || type.kind == Kind::integer) {
    const auto number = calculated(text);
    if (!number) {
      *why = QObject::tr("“%1” is no number.").arg(text);
      return {};
    }
    value = *number;
  } else {
    try {
      value = parse_value(type, text.toStdString());
    } catch (const Failure& failure) {
      *why = QString::fromStdString(failure.diagnostic().message);
      return {};
    }
  }
  const Diagnostics problems = check(type, value, type.name);
  if (has_error(problems)) {
    const QString advice = advice_on(problems.front());
    *why = problem_text(problems.front()) + (advice.isEmpty() ? "" : " " + advice);
    return {};
  }
  return value;
}

ParamField* make_field(const Param& param, const FieldContext& context, QWidget* parent) {
  using Kind = ParamType::Kind;
  switch (param.kind) {
    case Kind::number:
    case Kind::integer:
      return make_number_field(param, parent);
    case Kind::boolean:
      return new BooleanField(param, parent);
    case Kind::choice:
      return new ChoiceField(param, false, parent);
    case Kind::unit:
      return new ChoiceField(param, true, parent);
    case Kind::pattern:
      return make_pattern_field(param, context, parent);
    case Kind::range:
      return new RangeField(param, parent);
    case Kind::open_file:
    case Kind::save_file:
      return new FileField(param, context, parent);
    case Kind::list:
    case Kind::table:
      return make_table_field(param, context, parent);
    case Kind::either:
      if (is_choice_or_number(param)) {
        Param both = param;
        both.choices = param.parts[0].choices;
        return new ChoiceField(both, true, parent);
      }
      return new TextField(param, parent);
    default:
      return new TextField(param, parent);
  }
}

}  // namespace kinegraph
