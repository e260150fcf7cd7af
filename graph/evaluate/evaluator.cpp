#include "graph/evaluate/evaluator.h"

#include <mutex>
#include <utility>

#include "graph/evaluate/cpu_path.h"
#include "graph/evaluate/demand.h"
#include "graph/evaluate/run.h"

namespace kinegraph {

struct Evaluator::State {
  State(const Registry& registry, FileStore& files, MemoryCache* memory, DiskCache* disk)
      : ledger(memory), world{registry, files, memory, disk, ledger, under_way, cpu_path()} {}

  MemoryLedger ledger;
  UnderWay under_way;
  RunWorld world;
  mutable std::mutex mutex;
  std::uint64_t runs = 0;        // begun so far
  std::map<Key, ValuePtr> kept;  // what the targets of the last of them asked for

  // The keys of a node and all before it.
  NodeKeys keys_to(const Plan& plan, int node) const {
    NodeKeys keys(plan, world.registry, world.files, world.cpu_path);
    for (int before : in_order(plan, {node})) keys.make(before);
    return keys;
  }
};

Evaluator::Evaluator(const Registry& registry, FileStore& files, MemoryCache* memory, DiskCache* disk)
    : state_(std::make_unique<State>(registry, files, memory, disk)) {}
Evaluator::~Evaluator() = default;

void Evaluator::set_cpu_path(std::string name) {
  state_->world.cpu_path = std::move(name);
}

RunLog Evaluator::run(const Plan& plan, const std::vector<Target>& targets, const RunOptions& options,
                      const RunCallbacks& callbacks, StopToken* stop) {
  std::map<Key, ValuePtr> kept;
  std::uint64_t own = 0;
  {
    std::lock_guard lock(state_->mutex);
    std::swap(kept, state_->kept);
    own = ++state_->runs;
  }
  kept.clear();  // before the run, which may need the memory
  auto log = run_plan(state_->world, plan, targets, options, callbacks, stop, kept);
  std::lock_guard lock(state_->mutex);
  if (own == state_->runs) state_->kept = std::move(kept);
  return log;
}

ValuePtr Evaluator::value(const Plan& plan, const std::string& node, const std::string& port) const {
  return Known(*this, plan, {node}).value(node, port);
}

Evaluator::Known::Known(const Evaluator& evaluator, const Plan& plan, const std::vector<std::string>& nodes,
                        std::function<void()> check)
    : evaluator_(evaluator),
      plan_(plan),
      keys_(plan, evaluator.state_->world.registry, evaluator.state_->world.files,
            evaluator.state_->world.cpu_path, std::move(check)) {
  std::vector<int> wanted;
  for (const std::string& node : nodes) {
    if (const auto index = plan.by_name.find(node); index != plan.by_name.end())
      wanted.push_back(index->second);
    if (const auto instead = plan.passed.find(node); instead != plan.passed.end())
      for (const auto& [port, source] : instead->second)
        if (source.node >= 0) wanted.push_back(source.node);
  }
  for (const int node : in_order(plan, wanted)) keys_.make(node);
}

std::optional<Key> Evaluator::Known::key_of(const std::string& node, const std::string& port) const {
  const auto source = plan_.find_output(node, port);
  return source ? keys_.of(*source) : std::nullopt;
}

ValuePtr Evaluator::Known::value(const std::string& node, const std::string& port) const {
  if (const auto source = plan_.find_output(node, port); source && source->node < 0) return source->constant;
  const auto key = key_of(node, port);
  if (!key) return nullptr;
  State& state = *evaluator_.state_;
  {
    std::lock_guard lock(state.mutex);
    if (const auto found = state.kept.find(*key); found != state.kept.end()) return found->second;
  }
  if (!state.world.memory) return nullptr;
  auto cached = state.world.memory->find(*key);
  return cached ? cached->value : nullptr;
}

std::string Evaluator::Known::cached(const std::string& node, const std::string& port) const {
  const auto key = key_of(node, port);
  const RunWorld& world = evaluator_.state_->world;
  if (key && world.memory && world.memory->contains(*key)) return "memory";
  if (key && world.disk && world.disk->contains(*key)) return "disk";
  return "no";
}

std::map<std::string, Key> Evaluator::wanted_under_way(const Plan& plan, const std::vector<Target>& targets,
                                                       const std::function<void()>& check) const {
  const std::set<Key> at_work = state_->under_way.keys();
  std::map<std::string, Key> wanted;
  if (at_work.empty()) return wanted;
  const auto& world = state_->world;
  auto demands = reached_by(plan, targets);
  NodeKeys keys(plan, world.registry, world.files, world.cpu_path, check);
  for (int node : demands.order) keys.make(node);
  demand(plan, keys, world.memory, world.disk, demands);
  for (int node : demands.order) {
    const auto& key = keys.of(node).key;
    if (demands.nodes[static_cast<std::size_t>(node)].runs && key && at_work.contains(*key))
      wanted.emplace(plan.nodes[static_cast<std::size_t>(node)].name, *key);
  }
  return wanted;
}

bool Evaluator::is_computing() const {
  return !state_->under_way.keys().empty();
}

void Evaluator::wake() {
  state_->under_way.wake();
}

Evaluator::Explained Evaluator::explain(const Plan& plan, const std::string& node,
                                        const std::string& wanted) {
  std::string port = wanted;
  const auto index = plan.by_name.find(node);
  const auto* type =
      index == plan.by_name.end() ? nullptr : plan.nodes[static_cast<std::size_t>(index->second)].type;
  const auto passed = plan.passed.find(node);
  if (index == plan.by_name.end() && passed == plan.passed.end()) {
    std::vector<std::string> names;
    for (const auto& [name, number] : plan.by_name) names.push_back(name);
    throw Failure(
        error("unknown-target", "there is no node '" + node + "'").hinting(suggestion(node, names)));
  }
  if (port.empty() && passed != plan.passed.end() && !passed->second.empty())
    port = passed->second.begin()->first;
  if (port.empty() && type && !type->outputs.empty()) port = type->outputs.front().name;
  auto source = plan.find_output(node, port);
  if (!source && port.empty() && index != plan.by_name.end()) source = Source{index->second, "", nullptr, ""};
  if (!source) {
    throw Failure(error("absent-output", "nothing comes out of '" + node + "." + port + "'")
                      .at_node(node)
                      .at_port(port));
  }

  Explained told;
  told.cached = "no";
  if (source->node < 0) {
    told.key = constant_key(source->constant_id);
    told.has_key = true;
    told.parts = {{"constant", source->constant_id}};
    told.why = "a constant: " + node + " is disabled";
    return told;
  }
  const auto& planned = plan.nodes[static_cast<std::size_t>(source->node)];
  if (planned.type && !source->port.empty() && !planned.type->find_output(source->port)) {
    throw Failure(error("unknown-target", planned.name + " has no output '" + source->port + "'")
                      .hinting(suggestion(source->port, planned.type->output_names())));
  }
  const auto keys = state_->keys_to(plan, source->node);
  const auto& made = keys.of(source->node);
  told.parts = made.parts;
  if (!planned.type) {
    told.why = "its type is not known, so it has no key";
    return told;
  }
  if (made.failure) {
    told.why = "no key: " + made.failure->message;
    return told;
  }
  if (!made.key) {
    told.why = planned.blocked.empty() ? "no key: a node before it has none" : "no key: " + planned.blocked;
    return told;
  }
  told.has_key = true;
  if (planned.type->effect != Effect::none) {
    told.key = *made.key;
    told.why = planned.type->effect == Effect::writes ? "it writes files, so it runs whenever it is asked for"
                                                      : "it checks, so it runs whenever it is asked for";
    return told;
  }
  told.parts.push_back({"port", source->port});
  told.key = output_key(*made.key, source->port);
  if (state_->world.memory && state_->world.memory->contains(told.key)) {
    told.cached = "memory";
    told.why = "the same key was computed in this session";
  } else if (state_->world.disk && state_->world.disk->contains(told.key)) {
    told.cached = "disk";
    told.why = "the cache folder has an entry of this key";
  } else if (!state_->world.disk) {
    told.why = "there is no cache folder; give one with --cache";
  } else {
    told.why = "the cache folder has no entry of this key: it was never computed, or is collected";
  }
  return told;
}

}  // namespace kinegraph
