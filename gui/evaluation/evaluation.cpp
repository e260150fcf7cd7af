#include "gui/evaluation/evaluation.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QMetaObject>

#include "graph/links.h"
#include "graph/nested.h"
#include "graph/validate.h"

namespace kinegraph {
namespace {

constexpr std::size_t memory_for_values = std::size_t(1) << 30;

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

// So that the window's thread always comes first: on Linux a nice value belongs to a thread.
void lower_priority_of_this_thread() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), 10);
}

}  // namespace

namespace {

// Nodes that something is wrong with stand aside as missing, so that all that doesn't depend on them still
// runs: half of the graphs that a person edits aren't whole. What is wrong and of no node stays in `problems`.
Plan plan_of_sound_part(EvaluationRequest& request, const Registry& registry, const PlanOptions& options,
                        std::map<std::string, Diagnostics>& left_out, Diagnostics& problems) {
  const auto set_aside = [&](const Diagnostics& found) {
    bool any = false;
    for (const Diagnostic& problem : found) {
      if (problem.severity != Severity::error) continue;
      const std::string name = problem.node.substr(0, problem.node.find('/'));
      auto node = request.document.nodes.find(name);
      if (node == request.document.nodes.end() || node->second.missing) continue;
      left_out[name].push_back(problem);
      node->second.missing = to_json(node->second);
      node->second.nested.reset();
      any = true;
    }
    return any;
  };
  for (const std::vector<std::string>& round : cycles(request.document))
    for (const std::string& name : round)
      set_aside({error("cycle", "it is part of a cycle").at_node(name).hinting("cut one of its links")});
  ValidateOptions validating;
  validating.file = request.file;
  validating.folder = request.folder;
  validating.check_files = false;  // a missing file fails the node that reads it
  set_aside(validate(request.document, registry, validating));
  for (;;) {
    problems.clear();
    Plan plan = make_plan(request.document, registry, options, problems);
    if (!has_error(problems) || !set_aside(problems)) return plan;
  }
}

}  // namespace

struct Evaluation::Result {
  RunLog log;
  Diagnostics problems;
  std::map<std::string, ValuePtr> values;
  std::map<std::string, Diagnostics> left_out;  // nodes with problems that keep them from running
  bool effects = false;
  std::uint64_t generation = 0, graph = 0;
};

Evaluation::Evaluation(const Registry& registry, std::string cache_folder, QObject* parent)
    : QObject(parent),
      registry_(registry),
      memory_(memory_for_values),
      disk_(cache_folder.empty()
                ? nullptr
                : std::make_unique<DiskCache>(std::move(cache_folder), std::uint64_t(4) << 30, registry)),
      evaluator_(registry, files_, &memory_, disk_.get()),
      thread_([this] { work(); }) {}

Evaluation::~Evaluation() {
  {
    std::lock_guard lock(mutex_);
    quitting_ = true;
    if (running_) running_->stop();
  }
  wake_.notify_all();
  thread_.join();
}

void Evaluation::request(EvaluationRequest request) {
  {
    std::lock_guard lock(mutex_);
    ++generation_;
    request.graph = graph_;
    if (request.effects)
      next_effects_ = std::move(request);
    else
      next_ = std::move(request);
    if (running_ && !running_effects_) running_->stop();
  }
  wake_.notify_all();
}

void Evaluation::forget() {
  {
    std::lock_guard lock(mutex_);
    ++generation_;
    ++graph_;
    next_.reset();
    if (running_ && !running_effects_) running_->stop();
  }
  statuses_.clear();
  values_.clear();
  log_ = {};
  problems_.clear();
}

void Evaluation::cancel() {
  std::lock_guard lock(mutex_);
  next_.reset();
  next_effects_.reset();
  if (running_) running_->stop();
}

bool Evaluation::is_busy() const {
  std::lock_guard lock(mutex_);
  return busy_;
}

const NodeStatus* Evaluation::status(const std::string& node) const {
  auto found = statuses_.find(node);
  return found == statuses_.end() ? nullptr : &found->second;
}

ValuePtr Evaluation::value(const std::string& node, const std::string& port) const {
  auto found = values_.find(node + "." + port);
  return found == values_.end() ? nullptr : found->second;
}

void Evaluation::work() {
  lower_priority_of_this_thread();
  for (;;) {
    EvaluationRequest request;
    {
      std::unique_lock lock(mutex_);
      const bool was_busy = busy_;
      busy_ = next_ || next_effects_;
      if (was_busy != busy_)
        QMetaObject::invokeMethod(
            this, [this, busy = busy_] { emit busy_changed(busy); }, Qt::QueuedConnection);
      wake_.wait(lock, [this] { return quitting_ || next_ || next_effects_; });
      if (quitting_) return;
      auto& taken = next_effects_ ? next_effects_ : next_;
      request = std::move(*taken);
      taken.reset();
      running_ = std::make_shared<StopToken>();
      running_effects_ = request.effects;
      if (!busy_) {
        busy_ = true;
        QMetaObject::invokeMethod(
            this, [this] { emit busy_changed(true); }, Qt::QueuedConnection);
      }
    }
    run(std::move(request));
    std::lock_guard lock(mutex_);
    running_.reset();
  }
}

void Evaluation::run(EvaluationRequest request) {
  auto result = std::make_shared<Result>();
  std::shared_ptr<StopToken> stop;
  {
    std::lock_guard lock(mutex_);
    stop = running_;
    result->generation = generation_;
  }
  result->effects = request.effects;
  result->graph = request.graph;
  PlanOptions planning;
  planning.file = request.file;
  planning.folder = planning.set_folder = planning.out = request.folder;
  const Plan plan = plan_of_sound_part(request, registry_, planning, result->left_out, result->problems);
  if (has_error(result->problems)) {
    deliver(std::move(result));
    return;
  }
  std::vector<Target> targets;
  for (Target& target : request.targets)
    if (request.document.nodes.count(target.node)) targets.push_back(std::move(target));
  if (request.effects)
    for (const std::string& node : plan.effects) targets.push_back({node, ""});
  RunOptions options;
  options.keep_going = true;
  options.out = request.folder;
  RunCallbacks callbacks;
  callbacks.progress = [&](const std::string& node, std::string_view state, double progress) {
    NodeStatus status;
    status.state = state_named(state);
    status.progress = progress;
    deliver_status(node, std::move(status), result->generation);
  };
  result->log = evaluator_.run(plan, targets, options, callbacks, stop.get());
  for (const Target& target : targets) {
    const NodeType* type = nullptr;
    auto node = request.document.nodes.find(target.node);
    if (node != request.document.nodes.end()) type = known_type(registry_, node->second);
    if (!type) continue;
    for (const OutputPort& port : type->outputs)
      if (target.port.empty() || target.port == port.name)
        if (ValuePtr value = evaluator_.value(plan, target.node, port.name))
          result->values[target.node + "." + port.name] = std::move(value);
  }
  deliver(std::move(result));
}

void Evaluation::deliver_status(const std::string& node, NodeStatus status, std::uint64_t generation) {
  QMetaObject::invokeMethod(
      this,
      [this, node, status = std::move(status), generation]() mutable {
        {
          std::lock_guard lock(mutex_);
          if (generation != generation_) return;
        }
        NodeStatus& known = statuses_[node];
        status.seconds = known.seconds;
        status.cached = known.cached;
        status.diagnostics = known.diagnostics;
        known = std::move(status);
        emit status_changed(QString::fromStdString(node));
      },
      Qt::QueuedConnection);
}

void Evaluation::deliver(std::shared_ptr<Result> result) {
  QMetaObject::invokeMethod(
      this,
      [this, result] {
        {
          std::lock_guard lock(mutex_);
          if (result->graph != graph_) return;
        }
        // An older run that was stopped says nothing new, but its finished values are as good as any.
        for (auto& [name, value] : result->values) values_[name] = value;
        for (const auto& [name, run] : result->log.nodes) {
          if (run.state == NodeState::skipped || run.state == NodeState::cancelled) continue;
          NodeStatus& status = statuses_[name];
          status.state = state_named(name_of(run.state));
          status.progress = 1;
          status.seconds = run.seconds;
          status.diagnostics = run.diagnostics;
          status.cached.clear();
          for (const auto& [port, output] : run.outputs)
            if (output.computed) status.cached = output.cached;
          emit status_changed(QString::fromStdString(name));
        }
        for (const auto& [name, diagnostics] : result->left_out) {
          NodeStatus& status = statuses_[name];
          status = {};
          status.state = NodeStatus::State::failed;
          status.diagnostics = diagnostics;
          emit status_changed(QString::fromStdString(name));
        }
        log_ = std::move(result->log);
        problems_ = std::move(result->problems);
        emit values_changed();
        emit finished(result->effects);
      },
      Qt::QueuedConnection);
}

}  // namespace kinegraph
