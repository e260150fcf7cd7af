#include "gui/timeline/timeline.h"

#include <QKeyEvent>

namespace kinegraph {

Timeline::Timeline(Session& session, Evaluation& evaluation, Playback& playback, Viewer& viewer,
                   QWidget* parent)
    : QWidget(parent), session_(session), evaluation_(evaluation), playback_(playback), viewer_(viewer) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Timeline"));
  connect(&viewer_, &Viewer::shown_changed, this, &Timeline::update_clip);
  update_clip();
}

void Timeline::set_theme(const Theme&) {}

std::vector<Target> Timeline::wanted() const {
  return wanted_;
}

void Timeline::keyPressEvent(QKeyEvent* event) {
  QWidget::keyPressEvent(event);
}

void Timeline::update_clip() {
  for (const Viewer::Shown& one : viewer_.shown())
    if (one.motion) {
      playback_.set_clip(one.motion->fps, one.motion->frames);
      break;
    }
}

}  // namespace kinegraph
