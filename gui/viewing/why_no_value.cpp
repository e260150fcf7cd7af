#include "gui/viewing/why_no_value.h"

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

QString blocked(const Evaluation& evaluation, const QString& name, const std::string& by) {
  if (by.empty())
    return QObject::tr("%1 waits for a node before it that failed or is not linked. Problems tells which.")
        .arg(name);
  const NodeStatus* status = evaluation.status(by);
  const QString why =
      !status || status->state == State::failed ? QObject::tr("%1 waits for %2, which failed.")
      : status->state == State::missing         ? QObject::tr("%1 waits for %2, whose type is unknown here.")
      : status->state == State::incomplete      ? QObject::tr("%1 waits for %2, which isn't linked yet.")
                                                : QObject::tr("%1 waits for %2, which gives nothing.");
  return why.arg(name, QString::fromStdString(by));
}

State state_of(const Evaluation& evaluation, const std::string& node) {
  const NodeStatus* status = evaluation.status(node);
  return status ? status->state : State::idle;
}

}  // namespace

QString why_no_value(const Session& session, const Evaluation& evaluation, const std::string& node) {
  if (session.is_read_only())
    return QObject::tr("A newer Kinegraph made this graph; what its nodes give can't be computed here.");
  const QString name = QString::fromStdString(node);
  switch (state_of(evaluation, node)) {
    case State::failed:
      return QObject::tr("%1 failed. Problems tells why.").arg(name);
    case State::missing:
      return QObject::tr("%1 is of a type that is unknown here. Problems tells what to do.").arg(name);
    case State::blocked:
      return blocked(evaluation, name, evaluation.status(node)->blocked_by);
    case State::incomplete:
      return QObject::tr("%1 isn't linked yet.").arg(name);
    case State::disabled:
      return QObject::tr("%1 is disabled and passes nothing on.").arg(name);
    case State::cancelled:
      return QObject::tr("%1 was cancelled. Choose another node or change something, and work goes on.")
          .arg(name);
    default:
      return on_its_way(session.document(), evaluation, node);
  }
}

bool is_on_its_way(const Session& session, const Evaluation& evaluation, const std::string& node) {
  const State state = state_of(evaluation, node);
  return !session.is_read_only() &&
         (state == State::idle || state == State::waiting || state == State::running || state == State::done);
}

}  // namespace kinegraph
