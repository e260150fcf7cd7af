// The Parameters dock: the current node's parameters, made from its type's description. Changes apply while
// dragging, one gesture is one undo step.
#pragma once
#include <QWidget>
#include <map>

#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/elided_line.h"
#include "gui/look/theme.h"
#include "gui/panels/mistake_line.h"
#include "gui/panels/param_field.h"

class QCheckBox;
class QFormLayout;
class QLabel;
class QScrollArea;
class QToolButton;

namespace kinegraph {

class ParameterPanel : public QWidget {
  Q_OBJECT

 public:
  ParameterPanel(Session& session, Evaluation& evaluation, QWidget* parent = nullptr);
  void set_theme(const Theme& theme);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Row {
    ParamField* field = nullptr;
    QLabel* label = nullptr;
    QToolButton* menu = nullptr;
    QWidget* line = nullptr;
    MistakeLine* mistake = nullptr;
    QString name;  // and whether it is published, as the label says where it has room
    Json value;    // shown
  };
  void show_node();
  void build(const NodeType& type);
  void refresh(bool another = false);  // another node: nothing that is being typed stays
  void fit_labels();
  void refresh_state();
  int help_height() const;
  void tell_help(const QString& text);
  void tell_mistake(const std::string& param, const QString& why);  // empty: there is none any more
  void mark_problems();
  bool give_up(const QString& param);
  void open_menu(const std::string& param, QToolButton* button);
  void set(const std::string& param, const Json& value);
  void publish(const std::string& param, bool on);
  std::string published_as(const std::string& param) const;
  std::vector<std::pair<std::string, int>> joints() const;
  const NodeType* type() const;

  Session& session_;
  Evaluation& evaluation_;
  const Theme* theme_;
  std::string node_;       // shown
  std::string node_type_;  // whose rows are built
  bool of_other_page_ = false;
  int label_width_ = 0;  // of the longest name
  std::map<std::string, Row> rows_;
  QWidget* none_;
  QWidget* some_;
  ElidedLine* name_;
  QLabel* type_label_;
  QCheckBox* enabled_;
  ElidedLine* note_;
  QLabel* state_;
  QScrollArea* scroll_;
  QLabel* help_;
};

}  // namespace kinegraph
