// Editors of parameter values, one for each form a parameter can have, made from its description alone.
#pragma once
#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "graph/param.h"

namespace kinegraph {

// What fields ask of where they stand.
struct FieldContext {
  QString folder;  // where relative paths start
  std::function<QString(const QString& absolute)> written_path;
  // Joints of the motion that the parameter is about: name and parent's index; empty where none is known yet.
  std::function<std::vector<std::pair<std::string, int>>()> joints;
};

class ParamField : public QWidget {
  Q_OBJECT

 public:
  using QWidget::QWidget;
  // Shows a value without emitting anything. A variable, "${name}", is shown as it stands.
  virtual void show_value(const Json& value) = 0;
  // The person is in the middle of typing: it must not be overwritten.
  virtual bool is_being_edited() const { return false; }
  // Gives up what is being typed: what comes next to be shown is another node's.
  virtual void drop_typed() {}
  // Marks what stands in it as not taken over, or no longer: the look, not the words.
  virtual void mark_wrong(bool wrong);

 protected:
  static void mark(QWidget* part, bool wrong);

 signals:
  void edited(const Json& value);
  void drag_started();
  void drag_ended();
  void wrong(const QString& message);  // what was typed doesn't fit; it stays, to be corrected
  void corrected();                    // what stands in it is what it showed again, or would fit
};

ParamField* make_field(const Param& param, const FieldContext& context, QWidget* parent);
// Those that have a file of their own.
ParamField* make_number_field(const Param& param, QWidget* parent);
ParamField* make_pattern_field(const Param& param, const FieldContext& context, QWidget* parent);
ParamField* make_table_field(const Param& param, const FieldContext& context, QWidget* parent);

}  // namespace kinegraph
