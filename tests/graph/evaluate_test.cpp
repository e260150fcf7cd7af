// What is computed, how often, and what of it: the first half of the contract's "Evaluation".
#include <gmock/gmock.h>

#include "graph/evaluate/evaluator.h"
#include "tests/graph/evaluate_toys.h"

namespace kinegraph {
namespace {

using toys::numbers;
using enum NodeState;

class Evaluate : public toys::World {};

// a, b -> left; b, c -> right; left, right -> top
const std::string diamond = R"(
  "a": {"type": "Count", "params": {"tag": "a", "value": 1}},
  "b": {"type": "Count", "params": {"tag": "b", "value": 2}},
  "c": {"type": "Count", "params": {"tag": "c", "value": 4}},
  "left": {"type": "Add", "params": {"tag": "left"}, "inputs": {"terms": ["a.numbers", "b.numbers"]}},
  "right": {"type": "Add", "params": {"tag": "right"}, "inputs": {"terms": ["b.numbers", "c.numbers"]}},
  "top": {"type": "Add", "params": {"tag": "top", "plus": 100},
          "inputs": {"terms": ["left.sum", "right.sum"]}},
  "idle": {"type": "Bad", "params": {"tag": "idle"}})";

TEST_F(Evaluate, ComputesWhatATargetNeedsAndNothingElse) {
  const auto plan = plan_of(diamond);
  const auto log = run(plan, {{"left", "sum"}});
  EXPECT_EQ(numbers(evaluator().value(plan, "left", "sum")), std::vector<double>{3});
  EXPECT_EQ(trace.times(), 3);
  EXPECT_EQ(state(log, "left"), done);
  EXPECT_EQ(state(log, "top"), skipped);
  EXPECT_EQ(state(log, "idle"), skipped);
  EXPECT_EQ(log.nodes.at("left").outputs.at("sum").cached, "no");
  EXPECT_TRUE(log.nodes.at("top").outputs.empty());
}

TEST_F(Evaluate, RunsANodeOnceHoweverManyAskForIt) {
  const auto plan = plan_of(diamond);
  run(plan, {{"top", "sum"}, {"left", "sum"}, {"b", "numbers"}, {"top", ""}});
  EXPECT_EQ(numbers(evaluator().value(plan, "top", "sum")), std::vector<double>{109});
  for (const char* tag : {"a", "b", "c", "left", "right", "top"}) EXPECT_EQ(trace.times(tag), 1) << tag;
}

TEST_F(Evaluate, RunsAKeyOnceAlsoWhenManyNodesHaveIt) {
  std::string nodes = R"("sum": {"type": "Add", "inputs": {"terms": [)";
  for (int i = 0; i < 20; ++i) nodes += (i ? ", " : "") + ("\"n" + std::to_string(i) + ".sum\"");
  nodes += "]}}";
  for (int i = 0; i < 20; ++i) {
    const auto n = std::to_string(i);
    nodes += ", \"c" + n + R"(": {"type": "Count", "params": {"tag": "c", "value": 3}})";
    nodes += ", \"n" + n + R"(": {"type": "Add", "params": {"tag": "n"}, "inputs": {"terms": ["c)" + n +
             ".numbers\"]}}";
  }
  for (int threads : {1, 4}) {
    trace.counts.clear();
    options.threads = threads;
    const auto plan = plan_of(nodes);
    const auto log = run(plan, {{"sum", "sum"}});
    EXPECT_EQ(numbers(evaluator().value(plan, "sum", "sum")), std::vector<double>{60});
    EXPECT_EQ(trace.times("c"), 1);
    EXPECT_EQ(trace.times("n"), 1);
    EXPECT_EQ(log.nodes.at("n3").outputs.at("sum").key, log.nodes.at("n7").outputs.at("sum").key);
  }
}

TEST_F(Evaluate, ANodeWaitsForOneOfItsKeyThatIsAtWork) {
  // Holds on for a while, so that the other has every chance to begin as well.
  registry.add(toys::toy("Slow", trace, [this](Compute& node) {
                 std::unique_lock lock(trace.mutex);
                 trace.changed.wait_for(lock, std::chrono::milliseconds(200),
                                        [&] { return trace.counts["slow"] > 1; });
                 node.output("numbers", toys::Numbers({1}));
               }).output("numbers", "Numbers", "one"));
  options.threads = 4;
  const auto log = run(R"(
    "a": {"type": "Slow", "params": {"tag": "slow"}},
    "b": {"type": "Slow", "params": {"tag": "slow"}},
    "sum": {"type": "Add", "inputs": {"terms": ["a.numbers", "b.numbers"]}})",
                       {{"sum", "sum"}});
  EXPECT_EQ(state(log, "sum"), done);
  EXPECT_EQ(trace.times("slow"), 1);
}

TEST_F(Evaluate, OneComputingServesAllOutputsThatAreWanted) {
  const auto plan = plan_of(R"(
    "n": {"type": "Count", "params": {"value": 2.5}},
    "split": {"type": "Split", "params": {"tag": "split"}, "inputs": {"numbers": "n.numbers"}},
    "sum": {"type": "Add", "inputs": {"terms": ["split.whole", "split.rest"]}})");
  auto log = run(plan, {{"sum", "sum"}});
  EXPECT_EQ(trace.times("split"), 1);
  EXPECT_EQ(log.nodes.at("split").outputs.size(), 2u);
  EXPECT_EQ(numbers(evaluator().value(plan, "sum", "sum")), std::vector<double>{2.5});
  trace.counts.clear();
  log = run(plan, {{"split", "rest"}});
  EXPECT_EQ(log.nodes.at("split").outputs.size(), 1u) << "whole was not asked for";
}

TEST_F(Evaluate, ConvertsWhereThePortTakesNoOther) {
  const auto plan = plan_of(R"(
    "n": {"type": "Count", "params": {"value": 2.5}},
    "one": {"type": "Total", "inputs": {"sum": "n.numbers"}},
    "two": {"type": "Total", "inputs": {"sum": "one.total"}})");
  run(plan, {{"two", "total"}});
  EXPECT_EQ(dynamic_cast<const toys::Sum&>(*evaluator().value(plan, "two", "total")).total, 2.5);
}

TEST_F(Evaluate, IndependentNodesRunAtTheSameTime) {
  options.threads = 2;
  const auto log = run(R"(
    "a": {"type": "Meet", "params": {"tag": "a", "other": "b", "value": 1}},
    "b": {"type": "Meet", "params": {"tag": "b", "other": "a", "value": 2}},
    "sum": {"type": "Add", "inputs": {"terms": ["a.numbers", "b.numbers"]}})",
                       {{"sum", "sum"}});
  EXPECT_EQ(state(log, "sum"), done);
  EXPECT_EQ(log.threads_allowed, 2);
  EXPECT_EQ(log.threads_used, 2);
}

TEST_F(Evaluate, LoopsInsideNodesUseTheThreadsAndGiveTheSameBytes) {
  const auto plan = plan_of(R"("loop": {"type": "Loop"})");
  options.threads = 1;
  auto log = run(plan, {{"loop", "numbers"}});
  const auto one = numbers(evaluator().value(plan, "loop", "numbers"));
  const auto key = log.nodes.at("loop").outputs.at("numbers").key;
  EXPECT_EQ(log.threads_used, 1);
  const auto notes = log.nodes.at("loop").diagnostics;
  for (int threads : {2, 4}) {
    options.threads = threads;
    log = run(plan, {{"loop", "numbers"}});
    EXPECT_EQ(numbers(evaluator().value(plan, "loop", "numbers")), one);
    EXPECT_EQ(log.nodes.at("loop").outputs.at("numbers").key, key);
    ASSERT_EQ(log.nodes.at("loop").diagnostics.size(), notes.size());
    for (std::size_t i = 0; i < notes.size(); ++i)
      EXPECT_EQ(to_text(log.nodes.at("loop").diagnostics[i]), to_text(notes[i]));
  }
}

TEST_F(Evaluate, TheSecondRunIsServedFromMemory) {
  memory.emplace(1 << 20);
  const auto plan = plan_of(diamond);
  const auto cold = run(plan, {{"top", "sum"}});
  trace.counts.clear();
  const auto warm = run(plan, {{"top", "sum"}});
  EXPECT_EQ(trace.times(), 0);
  EXPECT_EQ(warm.nodes.at("top").outputs.at("sum").cached, "memory");
  EXPECT_EQ(warm.nodes.at("top").outputs.at("sum").key, cold.nodes.at("top").outputs.at("sum").key);
  EXPECT_EQ(state(warm, "a"), skipped) << "nothing asked for it";
  EXPECT_EQ(numbers(evaluator().value(plan, "top", "sum")), std::vector<double>{109});
}

TEST_F(Evaluate, ChangingAParameterRecomputesOnlyWhatDependsOnIt) {
  memory.emplace(1 << 20);
  run(plan_of(diamond), {{"top", "sum"}});
  trace.counts.clear();
  const auto plan = plan_of(diamond, {{"c.value", "5"}});
  const auto log = run(plan, {{"top", "sum"}});
  EXPECT_EQ(numbers(evaluator().value(plan, "top", "sum")), std::vector<double>{110});
  EXPECT_EQ(trace.times(), 3);
  for (const char* tag : {"c", "right", "top"}) EXPECT_EQ(trace.times(tag), 1) << tag;
  EXPECT_EQ(log.nodes.at("left").outputs.at("sum").cached, "memory");
  EXPECT_EQ(log.nodes.at("right").outputs.at("sum").cached, "no");
  trace.counts.clear();
  run(plan_of(diamond), {{"top", "sum"}});
  EXPECT_EQ(trace.times(), 0) << "the first result is still there";
}

TEST_F(Evaluate, ADisabledNodePassesOnAndAnOptionalInputOfAnAbsentOutputCountsAsOpen) {
  const auto plan = plan_of(R"(
    "n": {"type": "Count", "params": {"value": 3}},
    "off": {"type": "Add", "enabled": false, "params": {"plus": 50}, "inputs": {"terms": ["n.numbers"]}},
    "gone": {"type": "Split", "enabled": false, "inputs": {"numbers": "n.numbers"}},
    "sum": {"type": "Add", "inputs": {"terms": ["off.sum"], "extra": "gone.rest"}},
    "plain": {"type": "Add", "inputs": {"terms": ["n.numbers"]}},
    "stuck": {"type": "Add", "inputs": {"terms": ["gone.rest"]}})");
  options.keep_going = true;
  const auto log = run(plan, {{"sum", "sum"}, {"plain", "sum"}, {"stuck", "sum"}, {"off", ""}});
  EXPECT_EQ(numbers(evaluator().value(plan, "sum", "sum")), std::vector<double>{3});
  EXPECT_EQ(log.nodes.at("sum").outputs.at("sum").key, log.nodes.at("plain").outputs.at("sum").key);
  EXPECT_EQ(state(log, "off"), disabled);
  EXPECT_EQ(state(log, "stuck"), blocked);
  EXPECT_EQ(numbers(evaluator().value(plan, "off", "sum")), std::vector<double>{3});
}

TEST_F(Evaluate, AnOutputThatCannotBeGivenFailsWhoNeedsIt) {
  options.keep_going = true;
  const std::string nodes = R"(
    "n": {"type": "Count", "params": {"value": 2.5}},
    "split": {"type": "Split", "inputs": {"numbers": "n.numbers"}},
    "sum": {"type": "Add", "inputs": {"terms": ["split.never", "split.rest"]}})";
  memory.emplace(1 << 20);
  for (const char* when : {"cold", "warm"}) {
    auto log = run(nodes, {{"sum", "sum"}});
    EXPECT_EQ(state(log, "sum"), failed) << when;
    EXPECT_EQ(first_code(log, "sum"), "absent-output");
    EXPECT_EQ(log.nodes.at("sum").diagnostics.front().port, "terms");
    EXPECT_NE(log.nodes.at("sum").diagnostics.front().hint.find("rest"), std::string::npos);
    log = run(nodes, {{"split", "never"}});
    EXPECT_EQ(state(log, "split"), failed);
    log = run(nodes, {{"split", ""}});
    EXPECT_EQ(state(log, "split"), done) << "all outputs are those there are";
    EXPECT_FALSE(log.nodes.at("split").outputs.at("never").computed);
  }
}

TEST_F(Evaluate, ATargetThatIsNotThereIsAnErrorAndNothingRuns) {
  for (const Target& target : {Target{"tpo", ""}, Target{"top", "smu"}}) {
    const auto log = run(diamond, {target, {"a", ""}});
    ASSERT_EQ(log.diagnostics.size(), 1u);
    EXPECT_EQ(log.diagnostics[0].code, "unknown-target");
    EXPECT_FALSE(log.diagnostics[0].hint.empty());
    EXPECT_EQ(trace.times(), 0);
  }
}

TEST_F(Evaluate, ADryRunTellsHitOrRunAndComputesNothing) {
  memory.emplace(1 << 20);
  run(plan_of(diamond), {{"left", "sum"}});
  trace.counts.clear();
  options.dry_run = true;
  const auto log = run(diamond, {{"top", "sum"}});
  EXPECT_EQ(trace.times(), 0);
  EXPECT_EQ(log.nodes.at("left").forecast, Forecast::hit);
  EXPECT_EQ(log.nodes.at("top").forecast, Forecast::run);
  EXPECT_EQ(log.nodes.at("b").forecast, Forecast::hit);
  EXPECT_EQ(log.nodes.at("c").forecast, Forecast::run);
  EXPECT_EQ(log.nodes.at("a").forecast, Forecast::none) << "left is there, so a is not needed";
}

TEST_F(Evaluate, TellsProgressAndStates) {
  std::mutex mutex;
  std::map<std::string, std::vector<std::string>> told;
  callbacks.progress = [&](const std::string& node, std::string_view what, double) {
    std::lock_guard lock(mutex);
    told[node].emplace_back(what);
  };
  run(diamond, {{"left", "sum"}});
  EXPECT_EQ(told.size(), 3u);
  EXPECT_EQ(told["a"], (std::vector<std::string>{"running", "done"}));
}

TEST_F(Evaluate, TellsBeforehandWhatHasToBeComputed) {
  memory.emplace(1 << 20);
  std::vector<std::string> waiting;
  callbacks.waiting = [&](const std::vector<std::string>& nodes) { waiting = nodes; };
  run(plan_of(diamond), {{"left", "sum"}});
  EXPECT_THAT(waiting, testing::UnorderedElementsAre("a", "b", "left"));
  run(plan_of(diamond), {{"top", "sum"}});
  EXPECT_THAT(waiting, testing::UnorderedElementsAre("c", "right", "top")) << "left is in the cache";
  run(plan_of(diamond), {{"top", "sum"}});
  EXPECT_TRUE(waiting.empty());
}

}  // namespace
}  // namespace kinegraph
