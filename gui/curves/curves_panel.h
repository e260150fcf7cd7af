// The Curves dock: channels over time of the current node's result and its source; of a Warp the path and the
// energy over its iterations; Stats and Metrics as bars.
#pragma once
#include <QWidget>
#include <memory>
#include <string>
#include <vector>

#include "graph/evaluate/run_log.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/timeline/playback.h"
#include "gui/viewer/viewer.h"
#include "gui/window/theme.h"

class QComboBox;
class QLabel;
class QStackedWidget;

namespace kinegraph {

class ChannelPlot;
class WarpPlot;
class BarPlot;

class CurvesPanel : public QWidget {
  Q_OBJECT

 public:
  CurvesPanel(Session& session, Evaluation& evaluation, Playback& playback, Viewer& viewer,
              QWidget* parent = nullptr);

  void set_theme(const Theme& theme);
  std::vector<Target> wanted() const;  // the current node's outputs and the source beside them

 signals:
  void wanted_changed();

 private:
  void find_wanted();
  void take_values();
  void fill_joints();
  void show_what_there_is();

  Session& session_;
  Evaluation& evaluation_;
  Playback& playback_;
  Viewer& viewer_;
  std::vector<Target> wanted_;
  Target result_, source_, analysis_;  // node "" = none
  QComboBox *what_ = nullptr, *joint_ = nullptr, *channel_ = nullptr;
  QStackedWidget* pages_ = nullptr;
  QLabel* empty_ = nullptr;
  ChannelPlot* channels_ = nullptr;
  WarpPlot* warp_ = nullptr;
  BarPlot* bars_ = nullptr;
};

}  // namespace kinegraph
