// A parameter as one line of text, taken over when it is finished. File and pattern fields add a button to
// it.
#pragma once
#include "gui/look/elided_line.h"
#include "gui/panels/param_field.h"

class QHBoxLayout;

namespace kinegraph {

// The layout of a field of one line: no margins, what it holds close together.
QHBoxLayout* row_of(QWidget* field);

class TextField : public ParamField {
 public:
  TextField(const Param& param, QWidget* parent);
  void show_value(const Json& value) override;
  bool is_being_edited() const override { return line_->hasFocus() && line_->text() != shown_; }

 protected:
  ParamType type_;
  ElidedLine* line_;
  QString shown_;  // what was shown last; the line may hold newer text
};

}  // namespace kinegraph
