// The other half of Schedule: how nodes end, and how values are let go when nobody needs them any more.
#include <utility>

#include "graph/evaluate/note_paths.h"
#include "graph/evaluate/schedule.h"

namespace kinegraph {

void Schedule::tell(int node, const char* state, double progress) {
  if (callbacks_.progress) callbacks_.progress(planned(node).name, state, progress);
}

void Schedule::complete(int node) {
  std::optional<Diagnostic> absent;
  {
    std::lock_guard lock(mutex_);
    const auto& outputs = at(node).outputs;
    for (const auto& port : demand_of(node).asked) {
      const auto given = outputs.find(port);
      if (given == outputs.end() || given->second.value) continue;
      std::string others;
      for (const auto& [other, there] : outputs)
        if (there.value) others += (others.empty() ? "" : ", ") + other;
      absent = error("absent-output", "gives no '" + port + "' here")
                   .at_port(port)
                   .hinting(others.empty() ? "ask for another output" : "it gives " + others);
      break;
    }
  }
  if (absent) return finish(node, NodeState::failed, std::move(absent));
  finish(node, NodeState::done);
}

void Schedule::finish(int node, NodeState state, std::optional<Diagnostic> why) {
  const auto& files = keys_.of(node).files;
  {
    std::lock_guard lock(mutex_);
    auto& task = at(node);
    auto& demand = demand_of(node);
    if (state == NodeState::done) {
      for (const auto& port : demand.wanted) {
        if (task.outputs.contains(port)) continue;
        task.phase = Phase::looking;  // asked for while this node was already at work on others
        return spawn(&Schedule::look, node);
      }
    }
    task.phase = Phase::finished;
    task.outcome.state = state;
    task.outcome.diagnostics.clear();
    for (const auto& note : task.notes) task.outcome.diagnostics.push_back(with_paths(note, files));
    if (why) task.outcome.diagnostics.push_back(with_paths(without_paths(std::move(*why), files), files));
    for (auto& diagnostic : task.outcome.diagnostics) diagnostic.node = planned(node).name;
    if (state == NodeState::done) {
      for (const auto& port : demand.wanted) {
        const auto& given = task.outputs.at(port);
        auto& told = task.outcome.outputs[port];
        told = {to_text(given.key), given.cached, given.value ? given.value->bytes() : 0,
                given.value != nullptr};
      }
    }
    ++finished_;
    for (int dependent : std::exchange(task.dependents, {})) {
      if (--at(dependent).waiting_for > 0) continue;
      at(dependent).phase = Phase::computing;
      spawn(&Schedule::compute, dependent);
    }
    leave_twins(node);
    let_go(node);
    if (task.users == 0 && !demand.target) task.outputs.clear();
    const bool bad = state == NodeState::failed || state == NodeState::blocked || state == NodeState::missing;
    if (bad && !options_.keep_going) stop_new_ = true;
  }
  tell(node, name_of(state), 1);
}

void Schedule::use_inputs(int node) {
  if (std::exchange(at(node).uses_inputs, true)) return;
  for (const auto& [port, sources] : planned(node).inputs)
    for (const auto& source : sources)
      if (source.node >= 0) ++at(source.node).users;
}

void Schedule::let_go(int node) {
  std::vector<int> leaving{node};
  while (!leaving.empty()) {
    const int user = leaving.back();
    leaving.pop_back();
    if (!std::exchange(at(user).uses_inputs, false)) continue;
    for (const auto& [port, sources] : planned(user).inputs) {
      for (const auto& source : sources) {
        if (source.node < 0) continue;
        auto& task = at(source.node);
        if (--task.users > 0 || demand_of(source.node).target) continue;
        if (task.phase == Phase::finished) {
          task.outputs.clear();
        } else if (task.phase == Phase::idle) {  // and will stay so: it need not wait for its own inputs
          leave_twins(source.node);
          leaving.push_back(source.node);
        }
      }
    }
  }
}

void Schedule::join_twins(int node, const Key& key) {
  auto& task = at(node);
  if (task.twin == key) return;
  leave_twins(node);
  task.twin = key;
  auto& twins = twins_[key];
  ++twins.left;
  twins.wanted.insert(demand_of(node).wanted.begin(), demand_of(node).wanted.end());
}

void Schedule::leave_twins(int node) {
  const auto key = std::exchange(at(node).twin, std::nullopt);
  if (!key) return;
  const auto twins = twins_.find(*key);
  if (--twins->second.left == 0) twins_.erase(twins);
}

void Schedule::fail(int node, Diagnostic why) {
  auto& task = at(node);
  task.phase = Phase::finished;
  task.outcome.state = NodeState::failed;
  why.node = planned(node).name;
  task.outcome.diagnostics.push_back(std::move(why));
}

void Schedule::close() {
  for (int node : demands_.order) {
    auto& task = at(node);
    const auto& plan = planned(node);
    if (task.phase == Phase::finished) continue;
    if (!plan.type) {
      task.outcome.state = NodeState::missing;
      continue;
    }
    const bool live = demand_of(node).target || task.users > 0 || task.phase != Phase::idle;
    if (!live) continue;
    auto blocked = blocked_by(node);
    if (!plan.blocked.empty()) blocked = error("blocked", plan.blocked);
    task.outcome.state = blocked ? NodeState::blocked : NodeState::cancelled;
    if (!blocked) continue;
    blocked->node = plan.name;
    task.outcome.diagnostics.push_back(std::move(*blocked));
  }
}

}  // namespace kinegraph
