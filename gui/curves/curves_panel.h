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
#include "gui/look/theme.h"
#include "gui/viewer/viewer.h"
#include "gui/viewing/playback.h"

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
  // The current node's outputs and the source beside them; nothing while the dock is hidden.
  std::vector<Target> wanted() const;

 signals:
  void wanted_changed();

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  // What can be looked at: an output of the current node, or what leads to it.
  struct Offer {
    QString name;
    std::string type;  // "Motion" (also Points), "Warp", "Stats", "Metrics"
    Target result;
    Target source;  // what the result is laid over; of a Warp, what was warped. Node "" = none
    Target reference;
  };
  void build();
  void find_wanted();
  void take_values();
  void fill_joints(const ShownMotion& motion);
  void show_channels(const Offer& offer);
  void show_warp(const Offer& offer);
  void show_bars(const Offer& offer);
  void tell(const QString& words);
  const Offer* offer() const;

  Session& session_;
  Evaluation& evaluation_;
  Playback& playback_;
  Viewer& viewer_;
  const Theme* theme_;
  std::vector<Offer> offers_;
  std::vector<Target> wanted_;
  bool visible_ = false;
  QString looked_at_;  // the kind of offer that was chosen last

  QComboBox *what_ = nullptr, *joint_ = nullptr, *channel_ = nullptr;
  QStackedWidget* pages_ = nullptr;
  QLabel* empty_ = nullptr;
  ChannelPlot* channels_ = nullptr;
  WarpPlot* warp_ = nullptr;
  BarPlot* bars_ = nullptr;
};

}  // namespace kinegraph
