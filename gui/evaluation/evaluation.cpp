#include "gui/evaluation/evaluation.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QMetaObject>

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

struct Evaluation::Result {
  RunLog log;
  Diagnostics problems;
  std::map<std::string, ValuePtr> values;
  bool effects = false;
  std::uint64_t generation = 0;
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
    if (request.effects)
      next_effects_ = std::move(request);
    else
      next_ = std::move(request);
    if (running_ && !running_effects_) running_->stop();
  }
  wake_.notify_all();
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
  PlanOptions planning;
  planning.file = request.file;
  planning.folder = planning.set_folder = planning.out = request.folder;
  const Plan plan = make_plan(request.document, registry_, planning, result->problems);
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
    if (node != request.document.nodes.end()) type = registry_.find(node->second.type);
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
        log_ = std::move(result->log);
        problems_ = std::move(result->problems);
        emit values_changed();
        emit finished(result->effects);
      },
      Qt::QueuedConnection);
}

}  // namespace kinegraph
