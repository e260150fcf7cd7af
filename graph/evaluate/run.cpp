#include "graph/evaluate/run.h"

#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "graph/evaluate/caught.h"
#include "graph/evaluate/demand.h"
#include "graph/evaluate/schedule.h"
#include "graph/evaluate/writes.h"

namespace kinegraph {

namespace {

class PlanRun {
 public:
  PlanRun(const RunWorld& world, const Plan& plan, const RunOptions& options, const RunCallbacks& callbacks,
          const StopToken* stop)
      : world_(world),
        plan_(plan),
        options_(options),
        callbacks_(callbacks),
        stop_(stop),
        halt_(stop, options.timeout, options.since),
        keys_(plan, world.registry, world.files, world.cpu_path, [this] { halt_.check(); }),
        rules_(options) {
    log_.threads_allowed = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    for (const auto& node : plan.nodes) {
      auto& told = log_.nodes[node.name];
      told.type = node.type_name;
      if (!node.enabled) {
        told.state = NodeState::disabled;
      } else if (!node.type) {
        told.state = NodeState::missing;
      }
    }
  }

  RunLog go(const std::vector<Target>& targets, std::map<Key, ValuePtr>& kept) {
    const auto start = std::chrono::steady_clock::now();
    world_.ledger.limit_to(options_.memory);
    try {
      demands_ = reached_by(plan_, targets);
      log_.diagnostics = demands_.problems;
      if (log_.diagnostics.empty() || options_.keep_going) run(kept);
    } catch (...) {
      log_.diagnostics.push_back(caught());
    }
    if (world_.disk)
      for (auto& problem : world_.disk->take_warnings()) log_.diagnostics.push_back(std::move(problem));
    log_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(log_);
  }

 private:
  const PlannedNode& planned(int node) const { return plan_.nodes[static_cast<std::size_t>(node)]; }
  Demand& demand_of(int node) { return demands_.nodes[static_cast<std::size_t>(node)]; }

  void run(std::map<Key, ValuePtr>& kept) {
    bool ready = true;
    try {
      for (int node : demands_.order) keys_.make(node);
    } catch (const Cancelled&) {
      ready = false;
    }
    std::map<int, Diagnostic> refused;
    if (ready) {
      refused = check_writes();
      demand(plan_, keys_, world_.memory, world_.disk, demands_);
    }
    for (int node : demands_.order) {
      if (planned(node).type) continue;
      log_.missing = true;
      log_.nodes[planned(node).name].diagnostics.push_back(
          error("missing-node", planned(node).missing_because.empty()
                                    ? (world_.registry.find(planned(node).type_name)
                                           ? "it was saved with a newer version of " + planned(node).type_name
                                           : "there is no node type '" + planned(node).type_name + "'")
                                    : planned(node).missing_because)
              .at_node(planned(node).name)
              .hinting(!planned(node).missing_because.empty() ? "mend the graph file that it names"
                       : world_.registry.find(planned(node).type_name)
                           ? "a newer Kinegraph can run it"
                           : "`kinegraph nodes` lists the types there are"));
    }
    Schedule schedule(world_, plan_, keys_, demands_, rules_, halt_, options_, callbacks_,
                      log_.threads_allowed);
    for (auto& [node, why] : refused) {
      log_.refused = log_.refused || is_refusal(why);
      schedule.fail(node, std::move(why));
    }
    if (options_.dry_run && ready) {
      forecast();
      take_failures(schedule);
      return;
    }
    if (ready && !log_.refused && (!log_.missing || options_.keep_going)) schedule.go();
    schedule.close();
    take(schedule, kept);
  }

  // Every file that enabled Exports among the targets will write, as far as it is known, before anything
  // runs.
  std::map<int, Diagnostic> check_writes() {
    for (int node : demands_.order)
      for (const auto& file : keys_.of(node).files) rules_.reads(file.path);
    for (const auto& path : plan_.graph_files) rules_.is_graph(path);
    if (!plan_.file.empty()) {
      const auto name = std::filesystem::path(plan_.file).filename();
      rules_.is_graph((std::filesystem::path(plan_.folder) / name).string());
    }
    std::map<int, Diagnostic> refused;
    for (int node : demands_.order) {
      const auto& plan = planned(node);
      if (!plan.type || plan.type->effect != Effect::writes || !plan.enabled) continue;
      for (const auto& [path, of, param] : writes_of(plan)) {
        try {
          log_.planned_files.push_back(path);
          log_.planned_files.back() = rules_.take(plan.name, path, of);
        } catch (const Failure& failure) {
          refused.emplace(node, Diagnostic(failure.diagnostic()).at_param(param));
        }
      }
    }
    return refused;
  }

  struct Write {
    std::string path, of, param;
  };
  static std::vector<Write> writes_of(const PlannedNode& node) {
    std::vector<Write> all;
    for (const auto& param : node.type->params) {
      if (param.kind != ParamType::Kind::save_file) continue;
      const auto value = node.params.find(param.name);
      if (value == node.params.end() || !value->second.is_string() || value->second.string().empty())
        continue;
      all.push_back({value->second.string(), value->second.string(), param.name});
    }
    if (all.empty() || !node.type->also_writes) return all;
    try {
      for (const auto& path : node.type->also_writes(Params(node.params)))
        all.push_back({path, all.front().of, all.front().param});
    } catch (const std::exception&) {
      // What can't be told beforehand, the node itself complains about when it runs.
    }
    return all;
  }

  void forecast() {
    for (int node : demands_.order) {
      const auto& demand = demand_of(node);
      auto& told = log_.nodes[planned(node).name];
      if (!demand.needed || told.state != NodeState::skipped) continue;
      if (!planned(node).blocked.empty()) {
        told.state = NodeState::blocked;
        told.diagnostics.push_back(error("blocked", planned(node).blocked).at_node(planned(node).name));
        continue;
      }
      told.forecast = demand.hit ? Forecast::hit : Forecast::run;
      const auto& key = keys_.of(node).key;
      if (!key) continue;
      told.key = to_text(*key);
      for (const auto& port : demand.wanted) {
        const Key output = output_key(*key, port);
        const auto found = demand.found.find(port);
        const bool in_memory = found != demand.found.end();
        const bool on_disk = !in_memory && world_.disk && world_.disk->contains(output);
        const bool there = in_memory ? found->second.value != nullptr : on_disk;
        told.outputs[port] = {to_text(output),
                              in_memory ? "memory"
                              : on_disk ? "disk"
                                        : "no",
                              in_memory && there ? found->second.value->bytes() : 0, there};
      }
    }
  }

  void take_failures(Schedule& schedule) {
    for (int node : demands_.order) {
      auto& outcome = schedule.outcome(node);
      if (outcome.state != NodeState::failed) continue;
      auto& told = log_.nodes[planned(node).name];
      told.state = outcome.state;
      told.forecast = Forecast::none;
      told.diagnostics = std::move(outcome.diagnostics);
    }
  }

  void take(Schedule& schedule, std::map<Key, ValuePtr>& kept) {
    bool cut_short = false;
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      const int node = static_cast<int>(i);
      auto& told = log_.nodes[plan_.nodes[i].name];
      if (!demand_of(node).reached || told.state == NodeState::disabled) continue;
      auto& outcome = schedule.outcome(node);
      if (const auto& key = keys_.of(node).key) told.key = to_text(*key);
      told.seconds = outcome.seconds;
      told.outputs = std::move(outcome.outputs);
      for (auto& diagnostic : outcome.diagnostics) {
        log_.refused = log_.refused || is_refusal(diagnostic);
        log_.write_failed = log_.write_failed || diagnostic.code == "cannot-write";
        told.diagnostics.push_back(std::move(diagnostic));
      }
      for (auto& rule : outcome.rules) log_.rules.push_back(std::move(rule));
      for (auto& file : outcome.files) log_.files.push_back(std::move(file));
      if (told.state != NodeState::missing) told.state = outcome.state;
      cut_short = cut_short || told.state == NodeState::cancelled;
      if (demand_of(node).target) {
        for (const auto& [port, given] : schedule.outputs(node))
          if (given.value && demand_of(node).wanted.contains(port)) kept[given.key] = given.value;
      }
    }
    log_.threads_used = std::max(1, schedule.threads_used());
    log_.timed_out = cut_short && halt_.late();
    log_.stopped = cut_short && stop_ && stop_->stopped();
    for (auto& problem : schedule.problems()) log_.diagnostics.push_back(std::move(problem));
  }

  const RunWorld& world_;
  const Plan& plan_;
  const RunOptions& options_;
  const RunCallbacks& callbacks_;
  const StopToken* stop_;
  Halt halt_;
  NodeKeys keys_;
  WriteRules rules_;
  Demands demands_;
  RunLog log_;
};

}  // namespace

RunLog run_plan(const RunWorld& world, const Plan& plan, const std::vector<Target>& targets,
                const RunOptions& options, const RunCallbacks& callbacks, const StopToken* stop,
                std::map<Key, ValuePtr>& kept) {
  return PlanRun(world, plan, options, callbacks, stop).go(targets, kept);
}

}  // namespace kinegraph
