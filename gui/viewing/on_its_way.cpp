#include "gui/viewing/on_its_way.h"

#include <QObject>
#include <cmath>
#include <deque>
#include <set>

namespace kinegraph {
namespace {

using State = NodeStatus::State;

// The running one that is nearest before it; "" where none is.
std::string running_before(const Document& document, const Evaluation& evaluation, const std::string& node) {
  std::deque<std::string> waiting{node};
  std::set<std::string> seen{node};
  while (!waiting.empty()) {
    const std::string at = waiting.front();
    waiting.pop_front();
    const NodeStatus* status = evaluation.status(at);
    if (status && status->state == State::running) return at;
    const auto found = document.nodes.find(at);
    if (found == document.nodes.end()) continue;
    for (const auto& [port, inputs] : found->second.inputs)
      for (const Link& link : inputs.links)
        if (seen.insert(link.node).second) waiting.push_back(link.node);
  }
  return {};
}

}  // namespace

QString on_its_way(const Document& document, const Evaluation& evaluation, const std::string& node) {
  const NodeStatus* status = evaluation.status(node);
  const QString name = QString::fromStdString(node);
  if (!status || status->state != State::waiting) return QObject::tr("Evaluating %1…").arg(name);
  const std::string running = running_before(document, evaluation, node);
  if (running.empty()) return QObject::tr("%1 waits for its turn.").arg(name);
  const double progress = evaluation.status(running)->progress;
  const QString before = QString::fromStdString(running);
  if (progress < 0.01) return QObject::tr("%1 waits for %2, which is being evaluated…").arg(name, before);
  return QObject::tr("%1 waits for %2, which is at %3 %…").arg(name, before).arg(std::lround(100 * progress));
}

}  // namespace kinegraph
