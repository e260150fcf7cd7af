#include "gui/curves/curves_panel.h"

namespace kinegraph {

CurvesPanel::CurvesPanel(Session& session, Evaluation& evaluation, Playback& playback, Viewer& viewer,
                         QWidget* parent)
    : QWidget(parent), session_(session), evaluation_(evaluation), playback_(playback), viewer_(viewer) {
  setAccessibleName(tr("Curves"));
}

void CurvesPanel::set_theme(const Theme&) {}

std::vector<Target> CurvesPanel::wanted() const {
  return wanted_;
}

}  // namespace kinegraph
