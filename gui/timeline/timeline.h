// The Timeline dock: play, loop, speed, step, scrub, in and out, bars where the feet are planted, and a time
// warp between two motions as lines from frame to frame. Keys: space plays, arrows step (with Shift by ten),
// Home and End, I and O set the range, L loops.
#pragma once
#include <QTimer>
#include <QWidget>
#include <optional>
#include <utility>
#include <vector>

#include "graph/evaluate/run_log.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/theme.h"
#include "gui/timeline/transport_icon.h"
#include "gui/viewer/viewer.h"
#include "gui/viewing/playback.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace kinegraph {

class TimelineTracks;

class Timeline : public QWidget {
  Q_OBJECT

 public:
  Timeline(Session& session, Evaluation& evaluation, Playback& playback, Viewer& viewer,
           QWidget* parent = nullptr);

  void set_theme(const Theme& theme);
  std::vector<Target> wanted() const;  // the warp of the current node

 signals:
  void wanted_changed();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void build();
  void set_in();
  void set_out();
  void change_speed(int steps);
  void find_wanted();
  std::optional<Target> nearest_warp(const Document& document, const Registry& registry,
                                     const std::string& node) const;
  void take_values();
  void update_state();
  void update_moment();
  void set_playable(bool playable);

  Session& session_;
  Evaluation& evaluation_;
  Playback& playback_;
  Viewer& viewer_;
  const Theme* theme_;
  std::vector<Target> wanted_;
  Target warp_, source_, reference_;  // node "" = none
  std::vector<std::pair<QToolButton*, TransportIcon>> buttons_;
  bool playable_ = false;  // a motion is shown
  // Where a chosen node's value is still on its way the timeline stays as it is for a moment, so that going
  // through nodes that are ready at once doesn't flicker.
  QTimer patience_;
  TimelineTracks* tracks_ = nullptr;
  QToolButton *play_ = nullptr, *loop_ = nullptr;
  QComboBox* speed_ = nullptr;
  QLabel* moment_ = nullptr;
};

}  // namespace kinegraph
