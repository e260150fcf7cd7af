#include "gui/evaluation/evaluation.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QMetaObject>
#include <algorithm>
#include <ctime>
#include <utility>

#include "graph/nested.h"
#include "graph/validate.h"
#include "gui/evaluation/blocked_part.h"
#include "gui/evaluation/described.h"
#include "gui/evaluation/evaluation_run.h"
#include "gui/evaluation/sound_part.h"
#include "gui/evaluation/sum_up.h"

namespace kinegraph {
namespace {

// At what of older work is still wanted: of this thread's own time, and by the clock.
constexpr double longest_look = 0.02, latest_look = 0.2;  // seconds
constexpr std::size_t most_nodes_looked_at = 200;
constexpr int sum_up_after_ms = 30;
constexpr std::size_t memory_for_values = std::size_t(1) << 30;

// So that the window's thread always comes first: on Linux a nice value belongs to a thread.
void lower_priority_of_this_thread() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), 10);
}

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return double(now.tv_sec) + double(now.tv_nsec) * 1e-9;
}

}  // namespace

Evaluation::Evaluation(const Registry& registry, std::string cache_folder, QObject* parent)
    : QObject(parent),
      registry_(registry),
      memory_(memory_for_values),
      disk_(cache_folder.empty()
                ? nullptr
                : std::make_unique<DiskCache>(std::move(cache_folder), std::uint64_t(4) << 30, registry)),
      evaluator_(registry, files_, &memory_, disk_.get()),
      stills_(registry),
      thread_([this] { work(); }) {
  summing_.setSingleShot(true);
  summing_.setInterval(sum_up_after_ms);
  connect(&summing_, &QTimer::timeout, this, [this] {
    for (const std::string& graph : std::exchange(unsummed_, {})) {
      sum_up(statuses_, graph);
      emit status_changed(QString::fromStdString(graph));
    }
  });
}

Evaluation::~Evaluation() {
  {
    std::lock_guard lock(mutex_);
    quitting_ = true;
  }
  cancel();
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
    // While nothing is computed there is nothing to keep.
    if (running_ && !running_->request.effects && !evaluator_.is_computing()) running_->stop.stop();
  }
  wake_.notify_all();
}

void Evaluation::forget() {
  {
    std::lock_guard lock(mutex_);
    ++generation_;
    ++graph_;
    next_.reset();
    if (running_ && !running_->request.effects) running_->stop.stop();
    for (const auto& run : aside_) run->stop.stop();
  }
  evaluator_.wake();
  unsummed_.clear();
  stands_as_.clear();
  statuses_.clear();
  values_.clear();
  log_ = {};
  problems_.clear();
}

void Evaluation::cancel() {
  {
    std::lock_guard lock(mutex_);
    next_.reset();
    next_effects_.reset();
    if (running_) running_->stop.stop();
    for (const auto& run : aside_) run->stop.stop();
  }
  evaluator_.wake();
}

bool Evaluation::is_busy() const {
  std::lock_guard lock(mutex_);
  return busy_ || next_ || next_effects_;
}

const NodeStatus* Evaluation::status(const std::string& node) const {
  auto found = statuses_.find(node);
  return found == statuses_.end() ? nullptr : &found->second;
}

ValuePtr Evaluation::value(const std::string& node, const std::string& port) const {
  auto found = values_.find(node + "." + port);
  return found == values_.end() ? nullptr : found->second;
}

bool Evaluation::may_begin(const std::optional<EvaluationRequest>& request) const {
  return request && !(running_ && running_->request.effects);
}

void Evaluation::work() {
  lower_priority_of_this_thread();
  for (;;) {
    std::optional<EvaluationRequest> request;
    std::vector<std::shared_ptr<Run>> ended;
    {
      std::unique_lock lock(mutex_);
      const auto is_over = [this](const std::shared_ptr<Run>& run) {
        return run && (quitting_ || run->over);
      };
      wake_.wait(lock, [&] {
        return quitting_ || is_over(running_) || std::any_of(aside_.begin(), aside_.end(), is_over) ||
               may_begin(next_effects_) || may_begin(next_);
      });
      if (is_over(running_)) aside_.push_back(std::exchange(running_, nullptr));
      for (auto& run : aside_)
        if (is_over(run)) ended.push_back(std::exchange(run, nullptr));
      std::erase(aside_, nullptr);
      if (!quitting_ && may_begin(next_effects_))
        request = std::exchange(next_effects_, std::nullopt);
      else if (!quitting_ && may_begin(next_))
        request = std::exchange(next_, std::nullopt);
      const bool busy = request || next_ || next_effects_ || running_ || !aside_.empty();
      if (std::exchange(busy_, busy) != busy)
        QMetaObject::invokeMethod(
            this, [this, busy] { emit busy_changed(busy); }, Qt::QueuedConnection);
      if (quitting_) {
        lock.unlock();
        for (const auto& run : ended) run->thread.join();
        return;
      }
    }
    for (const auto& run : ended) run->thread.join();
    if (request) begin(std::move(*request));
  }
}

void Evaluation::begin(EvaluationRequest request) {
  const std::shared_ptr<Run> fresh = planned(std::move(request));
  replace_by(*fresh);
  if (has_error(fresh->result->problems)) {
    deliver(fresh->result);
    return;
  }
  std::lock_guard lock(mutex_);
  if (quitting_) return;
  running_ = fresh;
  fresh->thread = std::thread([this, fresh] { run(*fresh); });
}

std::shared_ptr<Evaluation::Run> Evaluation::planned(EvaluationRequest request) {
  auto fresh = std::make_shared<Run>();
  Run& run = *fresh;
  {
    std::lock_guard lock(mutex_);
    run.generation = run.result->generation = generation_;
  }
  run.request = std::move(request);
  run.result->effects = run.request.effects;
  run.result->graph = run.request.graph;
  run.whole = run.request.document;
  PlanOptions planning;
  planning.file = run.request.file;
  planning.folder = planning.set_folder = planning.out = run.request.folder;
  run.plan = plan_of_sound_part(run.request, registry_, planning, run.result->left_out, run.result->problems);
  // Who looks at a disabled node through which nothing passes makes no mistake.
  const auto gives_nothing = [&](const Target& target) {
    return run.plan.passed.count(target.node) && !target.port.empty() &&
           !run.plan.find_output(target.node, target.port);
  };
  for (const Target& target : run.request.targets)
    if (run.request.document.nodes.count(target.node) && !gives_nothing(target))
      run.targets.push_back(target);
  if (run.request.effects)
    for (const std::string& node : run.plan.effects) run.targets.push_back({node, ""});
  return fresh;
}

void Evaluation::replace_by(Run& fresh) {
  std::set<Key> kept;
  try {
    // What nobody needs any more has to stop at once, however long it takes to tell what somebody does.
    const double begun = seconds_of(CLOCK_THREAD_CPUTIME_ID), asked = seconds_of(CLOCK_MONOTONIC);
    const auto check = [&] {
      if (seconds_of(CLOCK_THREAD_CPUTIME_ID) - begun > longest_look ||
          seconds_of(CLOCK_MONOTONIC) - asked > latest_look)
        throw Cancelled();
    };
    if (!has_error(fresh.result->problems))
      for (const auto& [node, key] : evaluator_.wanted_under_way(fresh.plan, fresh.targets, check)) {
        kept.insert(key);
        fresh.joins.insert(node);
      }
  } catch (const Cancelled&) {
    kept.clear();
    fresh.joins.clear();
  }
  std::shared_ptr<Run> before;
  {
    std::lock_guard lock(mutex_);
    before = std::exchange(running_, nullptr);
    if (before) aside_.push_back(before);
    for (const auto& run : aside_) {
      if (kept.empty())
        run->stop.stop();
      else
        run->stop.stop_all_but(kept);
      run->aside = true;
      run->generation = fresh.generation;
      run->speaks_for = fresh.joins;
    }
  }
  evaluator_.wake();
  if (!before || !kept.empty()) return;
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [&] { return before->over; });
}

void Evaluation::run(Run& run) {
  lower_priority_of_this_thread();
  RunOptions options;
  options.keep_going = true;
  options.out = run.request.folder;
  RunCallbacks callbacks;
  callbacks.progress = [&](const std::string& node, std::string_view state, double progress) {
    NodeStatus status;
    status.state = state_named(state);
    status.progress = progress;
    deliver_status(run, node, std::move(status));
  };
  callbacks.waiting = [&](const std::vector<std::string>& nodes) { deliver_waiting(run, nodes); };
  run.result->log = evaluator_.run(run.plan, run.targets, options, callbacks, &run.stop);
  finish(run);
  std::lock_guard lock(mutex_);
  run.over = true;
  wake_.notify_all();
}

void Evaluation::finish(Run& run) {
  std::lock_guard one(finishing_);
  Result& result = *run.result;
  std::vector<std::string> asked;
  for (const Target& target : run.targets) asked.push_back(target.node);
  const Evaluator::Known known(evaluator_, run.plan, asked);
  for (const Target& target : run.targets) {
    const NodeType* type = nullptr;
    auto node = run.request.document.nodes.find(target.node);
    if (node != run.request.document.nodes.end()) type = known_type(registry_, node->second);
    if (!type) continue;
    for (const OutputPort& port : type->outputs)
      if (target.port.empty() || target.port == port.name)
        if (ValuePtr value = known.value(target.node, port.name))
          result.values[target.node + "." + port.name] = std::move(value);
  }
  std::vector<std::string> done;
  for (const auto& [node, one_run] : result.log.nodes)
    if (one_run.state == NodeState::done && node.find('/') == std::string::npos) done.push_back(node);
  for (const auto& [node, unused] : run.plan.passed)
    if (run.request.document.nodes.count(node)) done.push_back(node);
  find_outdated(run.whole, result);
  // Of what nothing asked for there is nothing to tell; with large graphs inside it is most.
  std::erase_if(result.log.nodes, [](const auto& entry) { return entry.second.state == NodeState::skipped; });
  deliver(run.result);
  deliver_stills(run, done);
  if (run.stop.stopped()) return;
  tell_of_unasked(run);
  if (!run.request.effects) look_around(run, {done.begin(), done.end()});
}

bool Evaluation::gives_way(const Run& run) const {
  std::lock_guard lock(mutex_);
  return quitting_ || next_ || next_effects_ || run.aside;
}

// After the values, which somebody waits for.
void Evaluation::deliver_stills(const Run& run, const std::vector<std::string>& nodes) {
  std::map<std::string, std::shared_ptr<const Still>> stills;
  if (nodes.empty() || gives_way(run)) return;
  stills_.forget_what_is_gone();
  const Evaluator::Known known(evaluator_, run.plan, nodes);
  for (const std::string& node : nodes) {
    if (gives_way(run)) break;  // what comes next makes those that are still missing
    if (auto still = stills_.of(run.request.document, known, node)) stills[node] = std::move(still);
  }
  if (stills.empty()) return;
  QMetaObject::invokeMethod(
      this,
      [this, stills = std::move(stills), graph = run.request.graph] {
        {
          std::lock_guard lock(mutex_);
          if (graph != graph_) return;
        }
        take_stills(stills);
        sum_up_graph_nodes();
      },
      Qt::QueuedConnection);
}

// What failed, was mended and isn't looked at any more must not stand there as failed.
void Evaluation::find_outdated(const Document& document, Result& result) {
  // What is wrong with a node may be another node's doing, such as one that writes the same file.
  const auto as_it_is = [&](const std::string& name) {
    std::string text = described(document, name);
    if (const auto found = result.left_out.find(name); found != result.left_out.end())
      for (const Diagnostic& problem : found->second) text += problem.message;
    return text;
  };
  for (auto* known : {&failed_as_, &ran_as_})
    std::erase_if(*known, [&](const auto& entry) {
      if (as_it_is(entry.first) == entry.second) return false;
      result.outdated.push_back(entry.first);
      return true;
    });
  for (const auto& [name, run] : result.log.nodes) {
    if (run.state == NodeState::failed || run.state == NodeState::blocked)
      failed_as_[name] = as_it_is(name);
    else if (run.state == NodeState::done && result.effects && run.outputs.empty())
      ran_as_[name] = as_it_is(name);
  }
  for (const auto& [name, diagnostics] : result.left_out) failed_as_[name] = as_it_is(name);
}

// Files that are missing are known without reading them, and what is blocked follows from that.
void Evaluation::tell_of_unasked(const Run& run) {
  if (gives_way(run)) return;
  auto told = std::make_shared<Unasked>();
  const EvaluationRequest& request = run.request;
  for (Diagnostic& problem :
       validate(run.whole, registry_, {.file = request.file, .folder = request.folder, .check_files = true}))
    if (problem.code == "missing-file" && problem.severity == Severity::error &&
        request.document.nodes.count(problem.node) && !request.document.nodes.at(problem.node).missing)
      told->lost[problem.node].push_back(std::move(problem));
  for (const std::string& name : lost_)
    if (!told->lost.count(name)) {
      failed_as_.erase(name);
      told->found.push_back(name);
    }
  lost_.clear();
  std::set<std::string> failed;
  for (const auto& [name, as] : failed_as_) failed.insert(name);
  for (const auto& [name, problems] : told->lost) {
    failed.insert(name);
    lost_.insert(name);
  }
  told->blocked = blocked_part(run.plan, failed);
  for (const PlannedNode& node : run.plan.nodes)
    if (node.type && node.enabled) told->able.insert(node.name);
  for (const auto& [name, ports] : run.plan.passed) {
    const auto node = request.document.nodes.find(name);
    if (node == request.document.nodes.end() || node->second.nested || !node->second.enabled) continue;
    for (const auto& [port, source] : ports)
      if (source.node >= 0) told->stands_as.emplace(name, run.plan.nodes[std::size_t(source.node)].name);
  }
  QMetaObject::invokeMethod(
      this,
      [this, told, generation = run.result->generation] {
        {
          std::lock_guard lock(mutex_);
          if (generation != generation_) return;
        }
        take_unasked(*told);
      },
      Qt::QueuedConnection);
}

void Evaluation::look_around(Run& run, const std::set<std::string>& done) try {
  const EvaluationRequest& request = run.request;
  const Plan& plan = run.plan;
  if (request.document.nodes.size() > most_nodes_looked_at) return;
  auto seen = std::make_shared<Result>();
  seen->generation = run.result->generation;
  seen->graph = request.graph;
  const auto check = [&] {
    if (gives_way(run)) throw Cancelled();
  };
  std::vector<std::string> names;
  for (const PlannedNode& node : plan.nodes)
    if (node.type && node.enabled && !node.type->outputs.empty() && node.blocked.empty())
      names.push_back(node.name);
  Evaluator::Known known(evaluator_, plan, names, check);
  std::vector<Target> cached;
  for (const std::string& name : names) {
    check();
    const std::vector<OutputPort>& outputs = plan.nodes[std::size_t(plan.by_name.at(name))].type->outputs;
    const OutputPort& first = outputs.front();
    const std::string where = known.cached(name, first.name);
    if (where == "no") {
      if (!done.count(name) && std::all_of(outputs.begin() + 1, outputs.end(), [&](const OutputPort& port) {
            return known.cached(name, port.name) == "no";
          }))
        seen->outdated.push_back(name);
      continue;
    }
    NodeRun& found = seen->log.nodes[name];
    found.state = NodeState::done;
    found.outputs[first.name] = {.cached = where, .computed = true};
    if (first.type == "Motion" && request.document.nodes.count(name)) cached.push_back({name, first.name});
  }
  // What is on disk alone is read for its still.
  evaluator_.run(plan, cached, {.keep_going = true}, {}, &run.stop);
  for (const Target& target : cached)
    if (auto still = stills_.of(request.document, known, target.node))
      seen->stills[target.node] = std::move(still);
  QMetaObject::invokeMethod(
      this,
      [this, seen] {
        {
          std::lock_guard lock(mutex_);
          if (seen->graph != graph_ || seen->generation != generation_) return;
        }
        for (const std::string& name : seen->outdated) {
          const auto was = statuses_.find(name);
          if (was == statuses_.end() || was->second.state != NodeStatus::State::done) continue;
          was->second = {};
          emit status_changed(QString::fromStdString(name));
        }
        for (const auto& [name, found] : seen->log.nodes) {
          NodeStatus& status = statuses_[name];
          if (status.state == NodeStatus::State::done && !status.cached.empty()) continue;
          const auto still = status.still;
          status = {};
          status.state = NodeStatus::State::done;
          status.still = still;
          status.cached = found.outputs.begin()->second.cached;
          emit status_changed(QString::fromStdString(name));
        }
        take_stills(seen->stills);
        sum_up_graph_nodes();
      },
      Qt::QueuedConnection);
} catch (const Cancelled&) {
  // What comes next looks around itself.
}

}  // namespace kinegraph
