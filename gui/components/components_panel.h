// The Components dock: what an analysis found, one small playing figure a component, with its caption and its
// signal. A click chooses; sliders and buttons write entries into the `edits` of a ComponentEdit node,
// through the session, so that everything can be undone.
#pragma once
#include <QWidget>
#include <string>
#include <vector>

#include "graph/evaluate/run_log.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/timeline/playback.h"
#include "gui/window/theme.h"

class QLabel;

namespace kinegraph {

class ComponentsPanel : public QWidget {
  Q_OBJECT

 public:
  ComponentsPanel(Session& session, Evaluation& evaluation, Playback& playback, QWidget* parent = nullptr);

  void set_theme(const Theme& theme);
  std::vector<Target> wanted() const;  // the components at the current node

 signals:
  void wanted_changed();

 private:
  void find_wanted();

  Session& session_;
  Evaluation& evaluation_;
  Playback& playback_;
  std::vector<Target> wanted_;
  QLabel* empty_ = nullptr;
};

}  // namespace kinegraph
