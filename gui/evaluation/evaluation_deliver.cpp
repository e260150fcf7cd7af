// What the GUI thread is told, and what it keeps of it.
#include <QMetaObject>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/evaluation/evaluation_run.h"
#include "gui/evaluation/sum_up.h"

namespace kinegraph {

NodeStatus::State state_named(std::string_view name) {
  using State = NodeStatus::State;
  if (name == "running") return State::running;
  if (name == "done") return State::done;
  if (name == "failed") return State::failed;
  if (name == "blocked") return State::blocked;
  if (name == "cancelled") return State::cancelled;
  if (name == "disabled") return State::disabled;
  if (name == "missing") return State::missing;
  return State::waiting;
}

void Evaluation::take_stills(const std::map<std::string, std::shared_ptr<const Still>>& stills) {
  for (const auto& [name, still] : stills) {
    NodeStatus& status = statuses_[name];
    if (status.still == still) continue;
    status.still = still;
    emit status_changed(QString::fromStdString(name));
  }
}

void Evaluation::sum_up_graph_nodes() {
  std::vector<std::string> graphs;
  for (const auto& [name, status] : statuses_) {
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos) continue;
    if (graphs.empty() || name.compare(0, slash, graphs.back()) != 0) graphs.push_back(name.substr(0, slash));
  }
  for (const std::string& graph : graphs) {
    sum_up(statuses_, graph);
    emit status_changed(QString::fromStdString(graph));
  }
  for (const auto& [name, source] : stands_as_) {
    const NodeStatus* as = status(source);
    if (!as) continue;
    const bool failed = as->state == NodeStatus::State::failed;
    const auto state = failed ? NodeStatus::State::blocked : as->state;
    const std::string& blocked_by = failed ? source : as->blocked_by;
    NodeStatus& own = statuses_[name];
    if (own.state == state && own.blocked_by == blocked_by) continue;
    own.state = state;
    own.progress = as->progress;
    own.blocked_by = blocked_by;
    emit status_changed(QString::fromStdString(name));
  }
}

void Evaluation::take_unasked(const Unasked& told) {
  using State = NodeStatus::State;
  const auto stands = [this](const std::string& name, NodeStatus status) {
    statuses_[name] = std::move(status);
    emit status_changed(QString::fromStdString(name));
  };
  stands_as_ = told.stands_as;
  for (const std::string& name : told.able) {
    const auto was = statuses_.find(name);
    if (was != statuses_.end() &&
        (was->second.state == State::disabled || was->second.state == State::missing))
      stands(name, {});
  }
  for (const std::string& name : told.found)
    if (statuses_[name].state == State::failed) stands(name, {});
  for (const auto& [name, problems] : told.lost)
    if (statuses_[name].state != State::failed) {
      NodeStatus failed;
      failed.state = State::failed;
      failed.diagnostics = problems;
      stands(name, std::move(failed));
    }
  for (auto& [name, status] : statuses_)
    if (status.state == State::blocked && !told.blocked.count(name) && !stands_as_.count(name))
      stands(name, {});
  for (const auto& [name, by] : told.blocked) {
    const NodeStatus& known = statuses_[name];
    if (known.state == State::running || (known.state == State::blocked && known.blocked_by == by)) continue;
    NodeStatus blocked;
    blocked.state = State::blocked;
    blocked.blocked_by = by;
    if (known.state == State::blocked) blocked.diagnostics = known.diagnostics;
    stands(name, std::move(blocked));
  }
  sum_up_graph_nodes();
}

// A Check whose rules don't hold ran, but nobody would call that done.
void Evaluation::take_broken_rules(const RunLog& log) {
  for (const RuleRun& rule : log.rules) {
    if (rule.passed) continue;
    NodeStatus& status = statuses_[rule.node];
    status.state = NodeStatus::State::failed;
    ++status.broken_rules;
    const QString measured = std::isfinite(rule.value) ? tr("measured %1").arg(rule.value, 0, 'g', 4)
                                                       : tr("could not be measured");
    status.diagnostics.push_back(
        error("check-failed", tr("the rule \"%1\" does not hold: %2")
                                  .arg(QString::fromStdString(rule.rule), measured)
                                  .toStdString())
            .at_node(rule.node)
            .hinting(tr("change what leads to it until the rule holds, or change the rule; then Run")
                         .toStdString()));
    emit status_changed(QString::fromStdString(rule.node));
  }
}

// Each of thousands of inner nodes tells of itself, and a sum goes through all of them.
void Evaluation::sum_up_soon(const std::string& inner) {
  const std::size_t slash = inner.find('/');
  if (slash == std::string::npos) return;
  unsummed_.insert(inner.substr(0, slash));
  if (!summing_.isActive()) summing_.start();
}

void Evaluation::deliver_status(const Run& run, const std::string& node, NodeStatus status) {
  std::uint64_t generation = 0;
  {
    std::lock_guard lock(mutex_);
    // That it was stopped is no news of the node: a newer run asks for it.
    if (run.aside && (!run.speaks_for.contains(node) || status.state == NodeStatus::State::cancelled)) return;
    generation = run.generation;
  }
  QMetaObject::invokeMethod(
      this,
      [this, node, status = std::move(status), generation]() mutable {
        {
          std::lock_guard lock(mutex_);
          if (generation != generation_) return;
        }
        NodeStatus& known = statuses_[node];
        if (status.state != NodeStatus::State::running) {
          status.seconds = known.seconds;
          status.cached = known.cached;
        }
        status.diagnostics = known.diagnostics;
        status.still = known.still;
        known = std::move(status);
        emit status_changed(QString::fromStdString(node));
        sum_up_soon(node);
      },
      Qt::QueuedConnection);
}

void Evaluation::deliver_waiting(const Run& run, std::vector<std::string> nodes) {
  QMetaObject::invokeMethod(
      this,
      [this, nodes = std::set<std::string>(nodes.begin(), nodes.end()), joins = run.joins,
       generation = run.result->generation] {
        {
          std::lock_guard lock(mutex_);
          if (generation != generation_) return;
        }
        using State = NodeStatus::State;
        for (auto& [node, status] : statuses_) {
          const bool goes_on = status.state == State::running && joins.contains(node);
          const bool was_due = status.state == State::running || status.state == State::waiting;
          if (nodes.contains(node) || goes_on || !was_due) continue;
          status.state = State::idle;  // for an older run it was
          emit status_changed(QString::fromStdString(node));
        }
        for (const std::string& node : nodes) {
          NodeStatus& status = statuses_[node];
          if (status.state == State::running && joins.contains(node)) continue;
          status.state = State::waiting;
          status.progress = 0;
          emit status_changed(QString::fromStdString(node));
        }
        sum_up_graph_nodes();
      },
      Qt::QueuedConnection);
}

void Evaluation::deliver(std::shared_ptr<Result> result) {
  QMetaObject::invokeMethod(
      this,
      [this, result] {
        bool newest = false;
        {
          std::lock_guard lock(mutex_);
          if (result->graph != graph_) return;
          newest = result->generation == generation_;
        }
        if (result->generation < delivered_) return;
        delivered_ = result->generation;
        // An older run that was stopped says nothing new, but its finished values are as good as any.
        for (auto& [name, value] : result->values) values_[name] = value;
        for (const std::string& name : result->outdated) {
          statuses_[name] = {};
          emit status_changed(QString::fromStdString(name));
        }
        for (const auto& [name, run] : result->log.nodes) {
          NodeStatus& status = statuses_[name];
          if (run.state == NodeState::skipped || run.state == NodeState::cancelled) {
            // What takes its place says so itself.
            if (!newest) continue;
            if (status.state != NodeStatus::State::running && status.state != NodeStatus::State::waiting)
              continue;
            status.state = NodeStatus::State::cancelled;
            status.progress = 0;
            emit status_changed(QString::fromStdString(name));
            continue;
          }
          status.state = state_named(name_of(run.state));
          status.progress = 1;
          status.seconds = run.seconds;
          status.diagnostics = run.diagnostics;
          status.broken_rules = 0;
          if (run.state != NodeState::blocked) status.blocked_by.clear();
          status.cached.clear();
          for (const auto& [port, output] : run.outputs)
            if (output.computed) status.cached = output.cached;
          emit status_changed(QString::fromStdString(name));
        }
        take_broken_rules(result->log);
        for (auto& [name, status] : statuses_) {
          const bool was_due =
              status.state == NodeStatus::State::running || status.state == NodeStatus::State::waiting;
          if (!newest || !was_due || result->log.nodes.contains(name)) continue;
          status.state = NodeStatus::State::idle;
          emit status_changed(QString::fromStdString(name));
        }
        for (const auto& [name, diagnostics] : result->left_out) {
          NodeStatus& status = statuses_[name];
          status = {};
          const bool open = std::all_of(diagnostics.begin(), diagnostics.end(),
                                        [](const Diagnostic& d) { return d.code == "open-input"; });
          status.state = open ? NodeStatus::State::incomplete : NodeStatus::State::failed;
          status.diagnostics = diagnostics;
          emit status_changed(QString::fromStdString(name));
        }
        sum_up_graph_nodes();
        log_ = std::move(result->log);
        problems_ = std::move(result->problems);
        emit values_changed();
        emit finished(result->effects);
      },
      Qt::QueuedConnection);
}

}  // namespace kinegraph
