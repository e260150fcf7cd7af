#include "gui/components/components_panel.h"

namespace kinegraph {

ComponentsPanel::ComponentsPanel(Session& session, Evaluation& evaluation, Playback& playback,
                                 QWidget* parent)
    : QWidget(parent), session_(session), evaluation_(evaluation), playback_(playback) {
  setAccessibleName(tr("Components"));
}

void ComponentsPanel::set_theme(const Theme&) {}

std::vector<Target> ComponentsPanel::wanted() const {
  return wanted_;
}

}  // namespace kinegraph
