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

#include "gui/look/ask_file.h"
#include "gui/panels/arithmetic.h"
#include "gui/panels/text_field.h"
#include "gui/panels/typed_words.h"

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
  bool is_being_edited() const override {
    return box_->isEditable() && box_->lineEdit()->hasFocus() && box_->currentText() != shown_;
  }
  void show_value(const Json& value) override {
    const QString text = typed_text(type_, value);
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
    if (text == shown_) return void(emit corrected());
    Json value = text.toStdString();
    if (box_->findText(text) < 0)
      if (const auto number = calculated(text)) value = *number;
    if (has_error(check(type_, value, type_.name)) && !text.startsWith("${"))
      emit wrong(tr("“%1” doesn't fit.").arg(text) + " " + what_fits(type_));
    else
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
    line_->set_elide(Qt::ElideMiddle);
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
    start_->setText(typed_text(type_, pair ? value.array()[0] : value));
    end_->setText(pair ? typed_text(type_, value.array()[1]) : QString());
    shown_ = start_->text() + ":" + end_->text();
  }
  bool is_being_edited() const override {
    return (start_->hasFocus() || end_->hasFocus()) && start_->text() + ":" + end_->text() != shown_;
  }
  void mark_wrong(bool wrong) override {
    for (QLineEdit* line : {start_, end_}) mark(line, wrong && (!wrong_ || wrong_ == line));
  }

 private:
  void send() {
    if (start_->text() + ":" + end_->text() == shown_) return void(emit corrected());
    if (start_->text().startsWith("${")) return void(emit edited(Json(start_->text().toStdString())));
    const auto first =
        start_->text().trimmed().isEmpty() ? std::optional<double>(0) : calculated(start_->text());
    const bool open = end_->text().trimmed().isEmpty() || end_->text().trimmed() == "end";
    const auto last = open ? std::optional<double>(0) : calculated(end_->text());
    wrong_ = !first ? start_ : !last ? end_ : nullptr;
    if (!first || !last) {
      emit wrong(
          tr("“%1” is no frame's number. Wanted is the first frame and the one after the last; an open "
             "end is left empty.")
              .arg(first ? end_->text() : start_->text()));
      return;
    }
    const Json value = Json::Array{Json(*first), open ? Json() : Json(*last)};
    QString why;
    if (typed_value(type_, typed_text(type_, value), &why))
      emit edited(value);
    else
      emit wrong(why);
  }
  ParamType type_;
  QLineEdit *start_, *end_;
  QLineEdit* wrong_ = nullptr;  // the one that is no number; none: both together don't fit
  QString shown_;
};

bool is_choice_or_number(const ParamType& type) {
  return type.kind == ParamType::Kind::either && type.parts.size() == 2 &&
         type.parts[0].kind == ParamType::Kind::choice &&
         (type.parts[1].kind == ParamType::Kind::number || type.parts[1].kind == ParamType::Kind::integer);
}

}  // namespace

void ParamField::mark(QWidget* part, bool wrong) {
  if (part->property("mistake").toBool() == wrong) return;
  part->setProperty("mistake", wrong);
  part->style()->unpolish(part);
  part->style()->polish(part);
}

void ParamField::mark_wrong(bool wrong) {
  for (QWidget* part : findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
    if (qobject_cast<QLineEdit*>(part) || qobject_cast<QComboBox*>(part)) mark(part, wrong);
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
