// A number: a slider over its soft range, and a line that takes arithmetic and any value of the hard range.
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QSlider>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/panels/arithmetic.h"
#include "gui/panels/param_field.h"
#include "gui/panels/typed_words.h"

namespace kinegraph {
namespace {

constexpr int slider_steps = 1000;

class CalmSlider : public QSlider {
 public:
  using QSlider::QSlider;

 protected:
  void wheelEvent(QWheelEvent* event) override { event->ignore(); }
};

constexpr int line_width = 76, least_line = 60, least_slider = 48, most_digits = 8;

class NumberField : public ParamField {
 public:
  NumberField(const Param& param, QWidget* parent)
      : ParamField(parent), type_(param), line_(new QLineEdit(this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(6);
    const QString name = QString::fromStdString(param.name);
    if (!std::isnan(param.soft_min) && !std::isnan(param.soft_max)) {
      slider_ = new CalmSlider(Qt::Horizontal, this);
      slider_->setRange(0, whole() && span() <= slider_steps ? int(span()) : slider_steps);
      slider_->setAccessibleName(QObject::tr("%1 slider").arg(name));
      slider_->setFocusPolicy(Qt::StrongFocus);
      slider_->setMinimumWidth(0);
      row->addWidget(slider_, 1);
      connect(slider_, &QSlider::sliderPressed, this, [this] { emit drag_started(); });
      connect(slider_, &QSlider::sliderReleased, this, [this] { emit drag_ended(); });
      connect(slider_, &QSlider::valueChanged, this, [this](int at) {
        if (!showing_) send(from_slider(at));
      });
    }
    line_->setAccessibleName(name);
    line_->setAlignment(Qt::AlignRight);
    line_->installEventFilter(this);
    if (slider_) line_->setFixedWidth(line_width);
    row->addWidget(line_, slider_ ? 0 : 1);
    unit_ = new QLabel(QString::fromStdString(param.unit), this);
    unit_->setObjectName("unit");
    unit_->setVisible(slider_ || !param.unit.empty());
    row->addWidget(unit_);
    setFocusProxy(line_);
    connect(line_, &QLineEdit::editingFinished, this, [this] {
      if (line_->text() == shown_) return void(emit corrected());
      QString why;
      if (const auto value = typed_value(type_, line_->text(), &why)) {
        emit edited(*value);
      } else if (line_->text().startsWith("${")) {
        emit edited(Json(line_->text().toStdString()));
      } else {
        emit wrong(why);
      }
    });
  }

  void show_value(const Json& value) override {
    showing_ = true;
    shown_ = fitting(value);
    line_->setText(shown_);
    line_->setToolTip(value.is_number() && shown_ != typed_text(type_, value) ? typed_text(type_, value)
                                                                              : toolTip());
    line_->setCursorPosition(0);
    if (slider_) {
      // The name of a variable has the slider's room as well.
      number_ = value.is_number() || value.is_null();
      show_slider();
      line_->setAlignment(number_ ? Qt::AlignRight : Qt::AlignLeft);
      slider_->setEnabled(value.is_number());
      if (value.is_number() && !slider_->isSliderDown())
        slider_->setValue(
            int(std::lround((std::clamp(value.number(), type_.soft_min, type_.soft_max) - type_.soft_min) /
                            span() * slider_->maximum())));
    }
    showing_ = false;
  }
  bool is_being_edited() const override { return line_->hasFocus() && line_->text() != shown_; }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    ParamField::resizeEvent(event);
    if (slider_ && !slider_->isSliderDown()) show_slider();
  }
  // Up and down change the number by a step of the slider.
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::KeyPress) {
      const int key = static_cast<QKeyEvent*>(event)->key();
      if (key == Qt::Key_Up || key == Qt::Key_Down) {
        const auto now = calculated(line_->text());
        if (now)
          send(std::clamp(rounded(*now + (key == Qt::Key_Up ? step() : -step())), type_.min, type_.max));
        return true;
      }
      if (key == Qt::Key_Escape) {
        line_->setText(shown_);
        emit corrected();
        return true;
      }
    }
    return ParamField::eventFilter(watched, event);
  }

 private:
  // Where there is too little room for it to be of use, the number has it.
  void show_slider() {
    const bool shown = number_ && width() - line_width - unit_->width() >= least_slider;
    slider_->setVisible(shown);
    line_->setMinimumWidth(shown ? line_width : least_line);
    line_->setMaximumWidth(shown ? line_width : QWIDGETSIZE_MAX);
  }
  bool whole() const { return type_.kind == ParamType::Kind::integer; }
  double span() const { return type_.soft_max - type_.soft_min; }
  double step() const {
    if (whole() || !slider_) return 1;
    return std::pow(10.0, std::floor(std::log10(span() / 50)));
  }
  // Rounded where all of its digits have no room; it stays what it is while nothing else is typed.
  QString fitting(const Json& value) const {
    const QString all = typed_text(type_, value);
    return slider_ && value.is_number() && all.size() > most_digits ? QString::number(value.number(), 'g', 5)
                                                                    : all;
  }
  // To a step that reads well: 0.35, not 0.3487.
  double rounded(double value) const {
    if (whole()) return std::round(value);
    const double grid = slider_ ? std::pow(10.0, std::floor(std::log10(span() / 200))) : 1e-6;
    const double steps = std::round(value / grid);
    return grid < 1 ? steps / std::round(1 / grid) : steps * grid;
  }
  double from_slider(int at) const {
    return std::clamp(rounded(type_.soft_min + span() * at / slider_->maximum()), type_.soft_min,
                      type_.soft_max);
  }
  void send(double value) {
    const Json json = value;
    shown_ = fitting(json);
    line_->setText(shown_);
    emit edited(json);
  }

  ParamType type_;
  QSlider* slider_ = nullptr;
  QLineEdit* line_;
  QLabel* unit_ = nullptr;
  QString shown_;
  bool showing_ = false, number_ = true;  // and no variable's name
};

}  // namespace

ParamField* make_number_field(const Param& param, QWidget* parent) {
  return new NumberField(param, parent);
}

}  // namespace kinegraph
