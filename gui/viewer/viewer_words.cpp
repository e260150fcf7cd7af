// What the viewer says where there is nothing to see.
#include <QLabel>
#include <algorithm>
#include <cmath>

#include "gui/document/problem_text.h"
#include "gui/viewer/viewer.h"
#include "gui/viewing/why_no_value.h"

namespace kinegraph {

bool Viewer::may_wait() const {
  return !shown_.empty() && is_on_its_way(session_, evaluation_, shown_.front().target.node);
}

void Viewer::update_words() {
  if (patience_.isActive()) {
    if (may_wait()) return;
    patience_.stop();
    return update_scene();
  }
  const bool any =
      std::any_of(shown_.begin(), shown_.end(), [](const Shown& one) { return one.motion != nullptr; });
  QString words;
  if (session_.is_read_only()) {
    words = why_no_value(session_, evaluation_, {});
  } else if (session_.document().nodes.empty()) {
    words = tr("Motions are shown here. Add a Load or a Gait to the graph.");
  } else if (shown_.empty()) {
    words = tr("Nothing at this node moves. Choose a node that makes a motion.");
  } else if (!any) {
    const std::string& node = shown_.front().target.node;
    const NodeStatus* status = evaluation_.status(node);
    const QString name = QString::fromStdString(node);
    using State = NodeStatus::State;
    if (status && (status->state == State::failed || status->state == State::missing ||
                   status->state == State::incomplete)) {
      words = "<b>" +
              (status->state == State::incomplete ? tr("%1 isn't linked yet.") : tr("%1 failed."))
                  .arg(name.toHtmlEscaped()) +
              "</b>";
      for (const Diagnostic& problem : status->diagnostics)
        if (problem.severity == Severity::error) {
          words += "<p style='margin: 6px 0 0 0'>" + problem_text(problem).toHtmlEscaped() + "</p>";
          if (const QString advice = advice_on(problem); !advice.isEmpty())
            words += QString("<p style='margin: 6px 0 0 0; color: %1'>%2</p>")
                         .arg(theme_->faint_text.name(), advice.toHtmlEscaped());
          break;
        }
    } else {
      words = why_no_value(session_, evaluation_, node).toHtmlEscaped();
    }
  }
  if (any && words.isEmpty()) {
    const auto unseen = [this](const Shown& one) {
      if (!one.motion || !one.motion->markers) return !one.motion;
      const int frame = one.motion->frame_at(playback_.time());
      for (int point = 0; point < one.motion->points; ++point)
        if (!std::isnan(one.motion->at(frame, point).x)) return false;
      return true;
    };
    if (std::all_of(shown_.begin(), shown_.end(), unseen))
      words = tr("No point was captured in this frame. Scrub on to where they are seen.");
  }
  words_->setText(words);
  words_->setVisible(!words.isEmpty());
}

}  // namespace kinegraph
