// The Components dock: what an analysis found, one small playing figure a component, with its caption and its
// signal. A click chooses; sliders and buttons write entries into the `edits` of a ComponentEdit node,
// through the session, so that everything can be undone. Where there is no ComponentEdit yet, the first edit
// adds one.
#pragma once
#include <QWidget>
#include <string>
#include <vector>

#include "graph/evaluate/run_log.h"
#include "gui/components/component_figures.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/theme.h"
#include "gui/viewing/playback.h"

class QBoxLayout;
class QComboBox;
class QGridLayout;
class QLabel;
class QProgressBar;
class QPushButton;
class QScrollArea;
class QSlider;
class QStackedWidget;

namespace kinegraph {

class ComponentsGrid;

class ComponentsPanel : public QWidget {
  Q_OBJECT

 public:
  ComponentsPanel(Session& session, Evaluation& evaluation, Playback& playback, QWidget* parent = nullptr);

  void set_theme(const Theme& theme);
  // The components at the current node; nothing while the dock is hidden, as an analysis may take long.
  std::vector<Target> wanted() const;
  ComponentsGrid& grid() { return *grid_; }
  const std::string& edit_node() const { return edit_node_; }  // that takes the edits; "" = none yet

 signals:
  void wanted_changed();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  QWidget* build_controls();
  void lay_controls(bool above);
  void name_segments(int count);
  QSlider* build_slider(const QString& name, double low, double high);
  void find_wanted();
  void find_edit_node();
  void take_values();
  void update_controls();
  void tell_edits();
  void tell_nothing();
  QString fitting(const QString& words, const QStringList& done, int room) const;
  Json edits() const;
  // Puts `edits` into the ComponentEdit node, as one step with the node where that has to be added first.
  void set_edits(const Json& edits);
  Edit connect_edit(const Document& document, const Registry& registry, const Target& from,
                    const std::string& name);
  void set_amount(const char* op, double amount);
  std::vector<int> chosen() const;  // from 1

  Session& session_;
  Evaluation& evaluation_;
  Playback& playback_;
  const Theme* theme_;
  ComponentFigures figures_;
  Target components_;  // node "" = none
  std::string edit_node_;
  bool wanting_ = false, above_ = false;

  QBoxLayout* parts_;
  QScrollArea* controls_;
  QGridLayout* control_grid_;
  QStackedWidget* pages_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QLabel *empty_ = nullptr, *told_ = nullptr, *scale_label_ = nullptr, *translate_label_ = nullptr,
         *scale_value_ = nullptr, *translate_value_ = nullptr, *arrow_ = nullptr;
  ComponentsGrid* grid_ = nullptr;
  QSlider *scale_ = nullptr, *translate_ = nullptr;
  QPushButton *take_away_ = nullptr, *merge_ = nullptr, *transfer_ = nullptr;
  QComboBox *from_ = nullptr, *to_ = nullptr;
};

}  // namespace kinegraph
