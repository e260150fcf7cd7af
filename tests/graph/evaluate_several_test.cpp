// Several runs of one evaluator at once: what one is computing another waits for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/graph/evaluate_toys.h"

namespace kinegraph {
namespace {

using namespace toys;

struct SeveralRuns : World {
  SeveralRuns() {
    memory.emplace(1 << 20);
    options.keep_going = true;
    // Goes on until "go" has run, or it is stopped.
    registry.add(toy("Hold", trace,
                     [this](Compute& node) {
                       while (trace.times("go") == 0) {
                         node.work().check();
                         std::this_thread::sleep_for(std::chrono::milliseconds(1));
                       }
                       node.output("numbers", Numbers({node.params().number("value")}));
                     })
                     .param("value", number(0), "the number")
                     .output("numbers", "Numbers", "one number"));
    graph = plan_of(R"(
    "hold": {"type": "Hold", "params": {"tag": "hold", "value": 3}},
    "other": {"type": "Hold", "params": {"tag": "other", "value": 4}},
    "quick": {"type": "Count", "params": {"tag": "quick", "value": 2}},
    "a": {"type": "Add", "params": {"tag": "a"}, "inputs": {"terms": ["hold.numbers"]}},
    "b": {"type": "Add", "params": {"tag": "b", "plus": 1}, "inputs": {"terms": ["hold.numbers", "quick.numbers"]}},
    "c": {"type": "Add", "params": {"tag": "c"}, "inputs": {"terms": ["hold.numbers", "other.numbers"]}})");
    evaluator();
  }
  // A run on a thread of its own, of which the test knows once its node "hold" is at work.
  std::thread begin(const Plan& plan, const Target& target, StopToken& token, RunLog& log) {
    std::thread thread([&, target] { log = evaluator().run(plan, {target}, options, {}, &token); });
    EXPECT_TRUE(trace.wait_for("hold"));
    return thread;
  }
  std::set<Key> keys_wanted(const Plan& plan, const Target& target) {
    std::set<Key> keys;
    for (const auto& [node, key] : evaluator().wanted_under_way(plan, {target}, {})) keys.insert(key);
    return keys;
  }
  Plan graph;
};

TEST_F(SeveralRuns, ANodeThatIsStillWantedRunsOnAndTheNewerRunTakesWhatItGives) {
  StopToken first_stop, second_stop;
  RunLog first, second;
  std::thread older = begin(graph, {"a", "sum"}, first_stop, first);
  const std::set<Key> kept = keys_wanted(graph, {"b", "sum"});
  EXPECT_EQ(kept.size(), 1u);
  first_stop.stop_all_but(kept);
  std::thread newer([&] { second = evaluator().run(graph, {{"b", "sum"}}, options, {}, &second_stop); });
  EXPECT_TRUE(trace.wait_for("quick")) << "what doesn't need it doesn't wait for it";
  trace.ran("go");
  older.join();
  newer.join();
  EXPECT_EQ(trace.times("hold"), 1);
  EXPECT_EQ(trace.times("a"), 0) << "the older run begins nothing any more";
  EXPECT_EQ(first.nodes.at("a").state, NodeState::cancelled);
  EXPECT_EQ(second.nodes.at("b").state, NodeState::done);
  EXPECT_EQ(numbers(evaluator().value(graph, "b", "sum")), std::vector<double>{6});
}

TEST_F(SeveralRuns, WithOneThreadEachTheyComeToTheirEndToo) {
  options.threads = 1;
  StopToken first_stop, second_stop;
  RunLog first, second;
  std::thread older = begin(graph, {"a", "sum"}, first_stop, first);
  first_stop.stop_all_but(keys_wanted(graph, {"b", "sum"}));
  std::thread newer([&] { second = evaluator().run(graph, {{"b", "sum"}}, options, {}, &second_stop); });
  EXPECT_TRUE(trace.wait_for("quick"));
  trace.ran("go");
  older.join();
  newer.join();
  EXPECT_EQ(second.nodes.at("b").state, NodeState::done);
}

TEST_F(SeveralRuns, WhatIsNotWantedAnyMoreStops) {
  StopToken wanted;
  RunLog log;
  std::thread run = begin(graph, {"c", "sum"}, wanted, log);
  EXPECT_TRUE(trace.wait_for("other"));
  const std::set<Key> kept = keys_wanted(graph, {"a", "sum"});
  EXPECT_EQ(kept.size(), 1u);
  wanted.stop_all_but(kept);
  wanted.stop_all_but({});
  run.join();  // without "go"
  EXPECT_EQ(log.nodes.at("hold").state, NodeState::cancelled);
  EXPECT_EQ(log.nodes.at("other").state, NodeState::cancelled);
  EXPECT_TRUE(log.stopped);
  EXPECT_FALSE(evaluator().is_computing());
}

TEST_F(SeveralRuns, ARunThatIsStoppedWhileItWaitsEndsAtOnce) {
  StopToken first_stop, second_stop;
  RunLog first, second;
  std::thread older = begin(graph, {"a", "sum"}, first_stop, first);
  std::thread newer([&] { second = evaluator().run(graph, {{"b", "sum"}}, options, {}, &second_stop); });
  EXPECT_TRUE(trace.wait_for("quick"));
  second_stop.stop();
  evaluator().wake();
  newer.join();
  EXPECT_EQ(second.nodes.at("b").state, NodeState::cancelled);
  EXPECT_TRUE(evaluator().is_computing()) << "the other one goes on";
  trace.ran("go");
  older.join();
  EXPECT_EQ(first.nodes.at("a").state, NodeState::done);
}

TEST_F(SeveralRuns, WhereTheOtherOneIsStoppedTheRunComputesItself) {
  StopToken first_stop, second_stop;
  RunLog first, second;
  std::thread older = begin(graph, {"a", "sum"}, first_stop, first);
  std::thread newer([&] { second = evaluator().run(graph, {{"b", "sum"}}, options, {}, &second_stop); });
  EXPECT_TRUE(trace.wait_for("quick"));
  first_stop.stop();
  older.join();
  trace.ran("go");
  newer.join();
  EXPECT_EQ(second.nodes.at("b").state, NodeState::done);
  EXPECT_EQ(trace.times("hold"), 2);
}

}  // namespace
}  // namespace kinegraph
