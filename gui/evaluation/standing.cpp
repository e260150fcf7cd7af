#include "gui/evaluation/standing.h"

#include <algorithm>

#include "graph/nested.h"

namespace kinegraph {
namespace {

using State = NodeStatus::State;
using Tone = Standing::Tone;

struct Count {
  int failed = 0, checks = 0, blocked = 0, unknown = 0, open = 0, cancelled = 0, computed = 0, due = 0;
};

Count counted(const Document& document, const Registry& registry, const Evaluation& evaluation) {
  Count count;
  for (const auto& [name, node] : document.nodes) {
    const NodeType* type = known_type(registry, node);
    const NodeStatus* status = evaluation.status(name);
    const State state = status ? status->state : State::idle;
    if (!type) {
      ++count.unknown;
      continue;
    }
    if (!node.enabled || (type->role == Role::pass && !node.nested)) continue;
    count.checks += status && status->broken_rules > 0;
    count.failed += state == State::failed && status->broken_rules == 0;
    count.blocked += state == State::blocked;
    count.open += state == State::incomplete;
    count.cancelled += state == State::cancelled;
    if (type->effect != Effect::none) continue;
    ++count.due;
    count.computed += state == State::done;
  }
  return count;
}

}  // namespace

Standing standing_of(const Document& document, const Registry& registry, const Evaluation& evaluation) {
  if (document.nodes.empty()) return {Tone::quiet, QObject::tr("No nodes")};
  const Count count = counted(document, registry, evaluation);
  QStringList parts;
  Tone tone = Tone::quiet;
  const auto say = [&](int number, const QString& one, const QString& several, Tone how) {
    if (number == 0) return;
    parts << (number == 1 ? one : several.arg(number));
    tone = std::max(tone, how);
  };
  say(count.failed, QObject::tr("1 node failed"), QObject::tr("%1 nodes failed"), Tone::error);
  say(count.checks, QObject::tr("1 check failed"), QObject::tr("%1 checks failed"), Tone::error);
  say(count.unknown, QObject::tr("1 node of unknown type"), QObject::tr("%1 nodes of unknown type"),
      Tone::warning);
  say(count.open, QObject::tr("1 node needs a link"), QObject::tr("%1 nodes need links"), Tone::warning);
  say(count.blocked, QObject::tr("1 node blocked"), QObject::tr("%1 nodes blocked"), Tone::warning);
  say(count.cancelled, QObject::tr("1 node cancelled"), QObject::tr("%1 nodes cancelled"), Tone::quiet);
  if (has_error(evaluation.problems()) && tone < Tone::error)
    return {Tone::error, QObject::tr("Can't be computed: see Problems")};
  if (!parts.isEmpty()) return {tone, parts.join(QStringLiteral(" · "))};
  if (count.computed < count.due)
    return {Tone::quiet, QObject::tr("%1 of %2 nodes computed").arg(count.computed).arg(count.due)};
  return {Tone::good, QObject::tr("Up to date")};
}

Standing standing_at_work(const Document& document, const Evaluation& evaluation, double* progress) {
  double sum = 0;
  int running = 0;
  QString name;
  for (const auto& [node, unused] : document.nodes) {
    const NodeStatus* status = evaluation.status(node);
    if (!status || status->state != State::running) continue;
    ++running;
    sum += status->progress;
    name = QString::fromStdString(node);
  }
  *progress = running ? sum / running : 0;
  return {Tone::busy, running == 1 ? QObject::tr("Computing %1").arg(name)
                      : running    ? QObject::tr("Computing %1 nodes").arg(running)
                                   : QObject::tr("Evaluating…")};
}

}  // namespace kinegraph
