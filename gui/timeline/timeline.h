// The Timeline dock: play, loop, speed, step, scrub, in and out, bars where the feet are planted, and a time
// warp between two motions as lines from frame to frame. Keys: space plays, arrows step (with Shift by ten),
// Home and End, I and O set the range, L loops.
#pragma once
#include <QWidget>
#include <vector>

#include "graph/evaluate/run_log.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/timeline/playback.h"
#include "gui/viewer/viewer.h"
#include "gui/window/theme.h"

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
  void find_wanted();
  void take_values();
  void update_clip();
  void update_state();
  void update_moment();

  Session& session_;
  Evaluation& evaluation_;
  Playback& playback_;
  Viewer& viewer_;
  std::vector<Target> wanted_;
  TimelineTracks* tracks_ = nullptr;
  QToolButton *play_ = nullptr, *loop_ = nullptr;
  QComboBox* speed_ = nullptr;
  QLabel* moment_ = nullptr;
};

}  // namespace kinegraph
