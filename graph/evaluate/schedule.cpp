#include "graph/evaluate/schedule.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <utility>

#include "graph/evaluate/caught.h"
#include "graph/evaluate/note_paths.h"

namespace kinegraph {

Schedule::Schedule(const RunWorld& world, const Plan& plan, NodeKeys& keys, Demands& demands,
                   WriteRules& rules, const Halt& halt, const RunOptions& options,
                   const RunCallbacks& callbacks, int threads)
    : world_(world),
      plan_(plan),
      keys_(keys),
      demands_(demands),
      rules_(rules),
      halt_(halt),
      options_(options),
      callbacks_(callbacks),
      threads_(threads),
      used_(threads),
      tasks_(plan.nodes.size()) {
  for (int node : demands_.order) {
    auto& task = at(node);
    auto& demand = demand_of(node);
    task.users = demand.users;
    task.uses_inputs = demand.runs;
    task.outputs = std::move(demand.found);
    task.notes = std::move(demand.notes);
    if (const auto& key = keys_.of(node).key; demand.runs && key) join_twins(node, *key);
  }
}

void Schedule::go() {
  if (callbacks_.waiting) {
    std::vector<std::string> names;
    for (int node : demands_.order)
      if (demand_of(node).runs) names.push_back(planned(node).name);
    callbacks_.waiting(names);
  }
  tbb::global_control machine(tbb::global_control::max_allowed_parallelism,
                              static_cast<std::size_t>(threads_));
  tbb::task_arena arena(threads_);
  arena_ = &arena;
  arena.execute([&] {
    tbb::task_group group;
    group_ = &group;
    {
      std::lock_guard lock(mutex_);
      for (int node : demands_.order) {
        if (!demand_of(node).target || at(node).phase != Phase::idle) continue;
        at(node).phase = Phase::looking;
        spawn(&Schedule::look, node);
      }
    }
    group.wait();
    group_ = nullptr;
  });
}

void Schedule::spawn(Step step, int node) {
  ++active_;
  group_->run([this, step, node] { run_step(step, node); });
}

// The run isn't over before that was called. Whoever calls it belongs to another run: with the lock held, so
// that this one's end waits for it to be done with the arena.
std::function<void()> Schedule::come_back_to(int node) {
  if (stopping()) return {};  // and was woken already
  ++active_;
  auto task =
      std::make_shared<tbb::task_handle>(group_->defer([this, node] { run_step(&Schedule::compute, node); }));
  return [this, task = std::move(task)] {
    std::lock_guard lock(mutex_);
    arena_->enqueue(std::move(*task));
  };
}

void Schedule::run_step(Step step, int node) {
  try {
    int finished_before = 0;
    {
      std::lock_guard lock(mutex_);
      finished_before = finished_;
    }
    try {
      (this->*step)(node);
    } catch (const Cancelled&) {
    } catch (...) {
      auto why = caught();
      if (!try_later(step, node, why, finished_before)) finish(node, NodeState::failed, std::move(why));
    }
  } catch (...) {
    stop_new_ = true;
    std::lock_guard lock(mutex_);
    problems_.push_back(caught());
  }
  std::lock_guard lock(mutex_);
  if (--active_ > 0 || starved_.empty() || stopping()) return;
  const auto [next, starved] = starved_.back();
  starved_.pop_back();
  spawn(next, starved);
}

void Schedule::look(int node) {
  if (stopping()) return;
  const auto& plan = planned(node);
  const auto& key = keys_.of(node);
  if (!plan.type) return finish(node, NodeState::missing);
  if (!plan.blocked.empty()) return finish(node, NodeState::blocked, error("blocked", plan.blocked));
  if (key.failure) return finish(node, NodeState::failed, key.failure);
  if (plan.type->effect == Effect::none && key.key && find_cached(node)) return complete(node);
  {
    std::lock_guard lock(mutex_);
    auto& task = at(node);
    task.phase = Phase::waiting;
    use_inputs(node);
    if (key.key) join_twins(node, *key.key);
    task.waiting_for = 1;  // this look itself, so that no input starts the node before all are asked for
    for (const auto& [port, sources] : plan.inputs)
      for (const auto& source : sources)
        if (source.node >= 0) ask(source.node, source.port, node);
    if (--task.waiting_for > 0) return;
    task.phase = Phase::computing;
  }
  compute(node);
}

void Schedule::ask(int source, const std::string& port, int for_node) {
  auto& task = at(source);
  demand_of(source).wanted.insert(port);
  const bool there =
      task.phase == Phase::finished && (task.outcome.state != NodeState::done || task.outputs.contains(port));
  if (there) return;
  task.dependents.push_back(for_node);
  ++at(for_node).waiting_for;
  if (task.phase != Phase::idle && task.phase != Phase::finished) return;
  task.phase = Phase::looking;
  spawn(&Schedule::look, source);
}

bool Schedule::find_cached(int node) {
  const auto key = *keys_.of(node).key;
  bool all = true;
  std::set<std::string> wanted;
  {
    std::lock_guard lock(mutex_);
    wanted = demand_of(node).wanted;
  }
  for (const auto& port : wanted) all = find_one(node, key, port) && all;
  return all;
}

bool Schedule::find_one(int node, const Key& node_key, const std::string& port) {
  auto& task = at(node);
  const Key key = output_key(node_key, port);
  const auto take = [&](ValuePtr value, const char* cached, const Diagnostics& notes) {
    value = world_.ledger.hold(std::move(value));
    std::lock_guard lock(mutex_);
    task.outputs[port] = {key, std::move(value), cached, {}};
    merge_notes(task.notes, notes);
    return true;
  };
  {
    std::lock_guard lock(mutex_);
    if (task.outputs.contains(port)) return true;
    const auto twins = twins_.find(node_key);
    if (twins != twins_.end()) {
      const auto made = twins->second.outputs.find(port);
      if (made != twins->second.outputs.end()) {
        task.outputs[port] = {key, made->second.value, "memory", {}};
        merge_notes(task.notes, twins->second.notes);
        return true;
      }
    }
  }
  if (world_.memory) {
    if (auto cached = world_.memory->find(key))
      return take(std::move(cached->value), "memory", cached->notes);
  }
  if (world_.disk) {
    if (auto cached = world_.disk->find(key, [this] { return halt_.asked(); })) {
      auto value = world_.ledger.hold(std::move(cached->value));
      if (world_.memory) world_.memory->put(key, {value, cached->notes});
      return take(std::move(value), "disk", cached->notes);
    }
  }
  return false;
}

std::optional<Diagnostic> Schedule::blocked_by(int node) {
  for (const auto& [port, sources] : planned(node).inputs) {
    for (const auto& source : sources) {
      if (source.node < 0) continue;
      const auto state = at(source.node).outcome.state;
      const char* why = state == NodeState::failed    ? "failed"
                        : state == NodeState::blocked ? "is blocked"
                        : state == NodeState::missing ? "is missing"
                                                      : nullptr;
      if (!why) continue;
      const auto& name = planned(source.node).name;
      return error("blocked", "needs " + name + "." + source.port + ", and " + name + " " + why)
          .at_port(port);
    }
  }
  return std::nullopt;
}

ValuePtr Schedule::arriving(int node, const InputPort& port, const Source& source) {
  ValuePtr value = source.constant;
  std::string type;
  {
    std::lock_guard lock(mutex_);
    if (source.node >= 0) value = at(source.node).outputs.at(source.port).value;
    if (!value) {
      Diagnostic absent = error("absent-output", "gets nothing from here").at_port(port.name);
      if (source.node >= 0) {
        const auto& from = planned(source.node);
        absent.message = from.name + " gives no '" + source.port + "' here";
        std::string others;
        for (const auto& [other, given] : at(source.node).outputs)
          if (given.value) others += (others.empty() ? "" : ", ") + other;
        absent.hint = others.empty() ? "link another output" : "it gives " + others;
      }
      throw Failure(std::move(absent));
    }
    type = world_.registry.arrives_as(value->type(), port);
    if (type == value->type()) return value;
    if (source.node >= 0) {
      const auto& converted = at(source.node).outputs.at(source.port).converted;
      if (const auto known = converted.find(type); known != converted.end()) return known->second;
    }
  }
  const auto* to = type.empty() ? nullptr : world_.registry.find_value(type);
  if (!to || !to->convert) {
    throw Failure(
        error("type-mismatch", planned(node).type->name + " can't take " + std::string(value->type()))
            .at_port(port.name)
            .hinting("link an output of another type"));
  }
  auto converted = to->convert(*value);
  if (converted) {
    if (const auto bad = converted->non_finite()) {
      auto failure = error("not-finite", "taken as " + type + ", " + bad->what + " is not a finite number")
                         .at_port(port.name)
                         .at_joint(bad->joint);
      failure.frame = bad->frame;
      throw Failure(std::move(failure));
    }
  }
  converted = world_.ledger.hold(std::move(converted));
  if (source.node >= 0) {
    std::lock_guard lock(mutex_);
    at(source.node).outputs.at(source.port).converted.emplace(type, converted);
  }
  return converted;
}

std::optional<std::map<std::string, std::vector<ValuePtr>>> Schedule::gather_inputs(int node) {
  std::optional<Diagnostic> blocked;
  {
    std::lock_guard lock(mutex_);
    blocked = blocked_by(node);
  }
  if (blocked) {
    finish(node, NodeState::blocked, std::move(blocked));
    return std::nullopt;
  }
  std::map<std::string, std::vector<ValuePtr>> inputs;
  const auto& plan = planned(node);
  for (const auto& port : plan.type->inputs) {
    const auto sources = plan.inputs.find(port.name);
    if (sources == plan.inputs.end()) continue;
    for (const auto& source : sources->second) inputs[port.name].push_back(arriving(node, port, source));
  }
  return inputs;
}

void Schedule::compute(int node) {
  if (stopping()) return;
  auto inputs = gather_inputs(node);
  if (!inputs) return;
  const bool effect = planned(node).type->effect != Effect::none;
  auto& task = at(node);
  if (rekeyed_) {
    const auto before = keys_.of(node).key;
    keys_.make(node);
    if (keys_.of(node).key != before) {
      std::lock_guard lock(mutex_);
      task.outputs.clear();
      task.notes.clear();
    }
  }
  const auto& made = keys_.of(node);
  if (made.failure) return finish(node, NodeState::failed, made.failure);
  if (effect) return compute_effect(node, std::move(*inputs));
  if (!made.key) return finish(node, NodeState::failed, error("internal", "no key could be made"));
  if (find_cached(node)) return complete(node);

  std::set<std::string> wanted;
  {
    std::unique_lock lock(mutex_);
    join_twins(node, *made.key);
    auto& twins = twins_[*made.key];
    if (twins.failure) {
      auto why = twins.failure;
      lock.unlock();
      return finish(node, NodeState::failed, std::move(why));
    }
    twins.wanted.insert(demand_of(node).wanted.begin(), demand_of(node).wanted.end());
    if (twins.running) {
      twins.waiting.push_back(node);
      return;
    }
    for (const auto& port : twins.wanted)
      if (!task.outputs.contains(port) && !twins.outputs.contains(port)) wanted.insert(port);
    if (!wanted.empty()) twins.running = true;
  }
  if (wanted.empty()) {  // made between the look and the claim
    find_cached(node);
    return complete(node);
  }
  compute_claimed(node, *made.key, std::move(*inputs), std::move(wanted));
}

Attempt Schedule::attempt(int node, const Halt& halt, std::map<std::string, std::vector<ValuePtr>> inputs,
                          const std::set<std::string>& wanted) {
  used_.mark();
  tell(node, "running", 0);
  NodeWork work(halt, world_.ledger, used_,
                [this, node](double progress) { tell(node, "running", progress); });
  auto attempt =
      compute_node({planned(node), keys_.of(node).files, work, world_.files, world_.ledger, rules_}, work,
                   halt, std::move(inputs), wanted);
  at(node).outcome.seconds += attempt.seconds;
  return attempt;
}

// Which nodes run beside which is chance, so a lack of memory counts only for a node that had all there is to
// itself.
bool Schedule::try_later(Step step, int node, const Diagnostic& failure, int finished_before) {
  if (failure.code != "out-of-memory") return false;
  std::lock_guard lock(mutex_);
  if (at(node).alone || (active_ <= 1 && finished_ == finished_before)) return false;
  at(node).alone = true;
  starved_.push_back({step, node});
  return true;
}

void Schedule::compute_effect(int node, std::map<std::string, std::vector<ValuePtr>> inputs) {
  int finished_before = 0;
  {
    std::lock_guard lock(mutex_);
    finished_before = finished_;
  }
  auto done = attempt(node, halt_, std::move(inputs), {});
  auto& task = at(node);
  if (done.end == Attempt::End::file_changed && !std::exchange(task.restarted, true)) {
    keys_.make(node, true);
    return compute(node);
  }
  if (done.end == Attempt::End::cancelled) return finish(node, NodeState::cancelled);
  const bool failed = done.end == Attempt::End::failed;
  if (failed && done.files.empty() && try_later(&Schedule::compute, node, *done.failure, finished_before))
    return;
  {
    std::lock_guard lock(mutex_);
    task.notes = std::move(done.notes);
    task.outcome.rules = std::move(done.rules);
    task.outcome.files = std::move(done.files);
  }
  if (done.failure) return finish(node, NodeState::failed, std::move(done.failure));
  finish(node, NodeState::done);
}

// What another process made while this one waited for its turn.
bool Schedule::made_elsewhere(int node, const Key& key, const std::set<std::string>& wanted) {
  for (const auto& port : wanted)
    if (!world_.disk->contains(output_key(key, port))) return false;
  try {
    for (const auto& port : wanted)
      if (!find_one(node, key, port)) return false;
  } catch (const Failure&) {
    return false;  // no memory for it: computing it will say so
  }
  std::lock_guard lock(mutex_);
  auto& twins = twins_[key];
  twins.running = false;
  if (twins.left > 1) {
    for (const auto& port : wanted) twins.outputs[port] = at(node).outputs.at(port);
    twins.notes = at(node).notes;
  }
  for (int waiting : std::exchange(twins.waiting, {})) spawn(&Schedule::compute, waiting);
  return true;
}

void Schedule::compute_claimed(int node, const Key& key, std::map<std::string, std::vector<ValuePtr>> inputs,
                               std::set<std::string> wanted) {
  using End = Attempt::End;
  if (!world_.under_way.begin(key, [&] { return come_back_to(node); })) {
    std::lock_guard lock(mutex_);
    auto& twins = twins_[key];
    twins.running = false;
    for (int waiting : std::exchange(twins.waiting, {})) spawn(&Schedule::compute, waiting);
    return;
  }
  const auto ended = [this, &key](const void*) { world_.under_way.end(key); };
  std::unique_ptr<const void, decltype(ended)> at_work(&key, ended);  // until it is in memory
  const Halt halt(halt_, key);   // of the node, which may be wanted longer than the run
  std::unique_ptr<Claim> claim;  // until what was made is on the disk
  if (world_.disk) {
    claim = world_.disk->claim(key, [&] { return halt.asked(); });
    if (made_elsewhere(node, key, wanted)) return complete(node);
  }
  int finished_before = 0;
  {
    std::lock_guard lock(mutex_);
    finished_before = finished_;
  }
  auto done = attempt(node, halt, std::move(inputs), wanted);
  auto& task = at(node);

  const bool restart = done.end == End::file_changed && !std::exchange(task.restarted, true);
  const bool later =
      done.end == End::failed && try_later(&Schedule::compute, node, *done.failure, finished_before);
  std::map<Key, Cached> fresh;
  if (done.end == End::done) {
    for (auto& [port, value] : done.outputs) {
      const Key output = output_key(key, port);
      if (world_.memory) world_.memory->put(output, {value, done.notes});
      fresh[output] = {value, done.notes};
    }
  }
  {
    std::lock_guard lock(mutex_);
    auto& twins = twins_[key];
    twins.running = false;
    if (done.end == End::failed && !later) twins.failure = done.failure;
    for (auto& [port, value] : done.outputs) {
      const Given given{output_key(key, port), std::move(value), "no", {}};
      if (twins.left > 1) twins.outputs[port] = given;
      task.outputs[port] = given;
    }
    if (twins.left > 1) twins.notes = done.notes;
    if (!later) task.notes = std::move(done.notes);
    for (int waiting : std::exchange(twins.waiting, {})) spawn(&Schedule::compute, waiting);
  }
  at_work.reset();
  if (later) return;
  if (restart) {
    claim.reset();
    rekeyed_ = true;
    keys_.make(node, true);
    {
      std::lock_guard lock(mutex_);
      task.outputs.clear();
      task.notes.clear();
    }
    return compute(node);
  }
  if (done.end == End::cancelled) return finish(node, NodeState::cancelled);
  if (done.failure) return finish(node, NodeState::failed, std::move(done.failure));
  complete(node);
  if (!world_.disk) return;
  for (const auto& [output, cached] : fresh) world_.disk->put(output, cached, [&] { return halt.asked(); });
}

}  // namespace kinegraph
