// Failing, blocking, stopping and running out of time or memory.
#include <atomic>
#include <thread>

#include "graph/evaluate/node_work.h"
#include "tests/graph/evaluate_toys.h"

namespace kinegraph {
namespace {

using toys::numbers;
using enum NodeState;

class EvaluateFailures : public toys::World {};

const std::string half_bad = R"(
  "good": {"type": "Count", "params": {"tag": "good", "value": 1}},
  "bad": {"type": "Bad", "params": {"tag": "bad"}},
  "after": {"type": "Add", "params": {"tag": "after"}, "inputs": {"terms": ["bad.numbers", "good.numbers"]}},
  "later": {"type": "Add", "params": {"tag": "later"}, "inputs": {"terms": ["good.numbers"], "extra": "after.sum"}},
  "rest": {"type": "Add", "params": {"tag": "rest"}, "inputs": {"terms": ["good.numbers"]}})";

TEST_F(EvaluateFailures, AFailedNodeNamesItselfJointFrameAndWhatToDo) {
  const auto log = run(half_bad, {{"bad", "numbers"}});
  EXPECT_EQ(state(log, "bad"), failed);
  ASSERT_EQ(log.nodes.at("bad").diagnostics.size(), 1u);
  const auto& told = log.nodes.at("bad").diagnostics[0];
  EXPECT_EQ(told.node, "bad");
  EXPECT_EQ(told.joint, "LeftFoot");
  EXPECT_EQ(told.frame, 7);
  EXPECT_EQ(told.hint, "do else");
}

TEST_F(EvaluateFailures, WhatDependsOnItIsBlockedAndTheRestRunsWithKeepGoing) {
  options.keep_going = true;
  for (int threads : {1, 4}) {
    trace.counts.clear();
    options.threads = threads;
    const auto log = run(half_bad, {{"later", "sum"}, {"rest", "sum"}});
    EXPECT_EQ(state(log, "bad"), failed);
    EXPECT_EQ(state(log, "after"), blocked);
    EXPECT_EQ(state(log, "later"), blocked) << "also where the input is optional";
    EXPECT_EQ(log.nodes.at("later").diagnostics.front().port, "extra");
    EXPECT_EQ(state(log, "rest"), done);
    EXPECT_EQ(trace.times("after") + trace.times("later"), 0);
  }
}

TEST_F(EvaluateFailures, WithoutItTheFirstFailureStopsWhatHasNotBegun) {
  options.threads = 1;
  std::string nodes = half_bad;
  std::vector<Target> targets{{"later", "sum"}};
  for (int i = 0; i < 30; ++i) {
    const auto n = std::to_string(i);
    nodes += ", \"m" + n + R"(": {"type": "Count", "params": {"tag": "many", "value": )" + n + "}}";
    nodes += ", \"k" + n +
             R"(": {"type": "Add", "params": {"tag": "many"}, "inputs": {"terms": ["bad.numbers", "m)" + n +
             ".numbers\"]}}";
    targets.push_back({"k" + n, ""});
  }
  const auto log = run(nodes, targets);
  EXPECT_EQ(state(log, "bad"), failed);
  EXPECT_EQ(state(log, "later"), blocked);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(state(log, "k" + std::to_string(i)), blocked);
  EXPECT_LT(trace.times("many"), 31);
  EXPECT_FALSE(log.stopped);
}

TEST_F(EvaluateFailures, AFailedCheckStopsAndBlocksNothing) {
  const auto log = run(R"(
    "n": {"type": "Count", "params": {"value": 5}},
    "one": {"type": "Judge", "params": {"limit": 3}, "inputs": {"numbers": "n.numbers"}},
    "two": {"type": "Judge", "params": {"limit": 7}, "inputs": {"numbers": "n.numbers"}})",
                       {{"one", ""}, {"two", ""}});
  EXPECT_EQ(state(log, "one"), done);
  EXPECT_EQ(state(log, "two"), done);
  ASSERT_EQ(log.rules.size(), 2u);
  EXPECT_EQ(log.rules[0].node, "one");
  EXPECT_FALSE(log.rules[0].passed);
  EXPECT_EQ(log.rules[0].value, 5);
  EXPECT_TRUE(log.rules[1].passed);
}

TEST_F(EvaluateFailures, WhateverANodeThrowsIsADiagnostic) {
  const std::vector<std::pair<std::string, std::string>> cases = {{"failure", "bad"},
                                                                  {"exception", "internal"},
                                                                  {"no memory", "out-of-memory"},
                                                                  {"number", "internal"},
                                                                  {"cancelled", "internal"},
                                                                  {"reported", "told"},
                                                                  {"not finite", "not-finite"},
                                                                  {"type", "internal"},
                                                                  {"port", "internal"},
                                                                  {"loop", "piece"},
                                                                  {"undeclared", "undeclared-file"}};
  for (const auto& [how, code] : cases) {
    const auto log =
        run(R"("bad": {"type": "Bad", "params": {"how": ")" + how + "\"}}", {{"bad", "numbers"}});
    EXPECT_EQ(state(log, "bad"), failed) << how;
    EXPECT_EQ(first_code(log, "bad"), code) << how;
    EXPECT_FALSE(log.nodes.at("bad").diagnostics.front().message.empty());
  }
}

TEST_F(EvaluateFailures, AResultThatIsNotFiniteNamesPortJointAndFrame) {
  const auto log = run(R"("bad": {"type": "Bad", "params": {"how": "not finite"}})", {{"bad", "numbers"}});
  const auto& told = log.nodes.at("bad").diagnostics.front();
  EXPECT_EQ(told.port, "numbers");
  EXPECT_EQ(told.joint, "Hips");
  EXPECT_EQ(told.frame, 1);
}

TEST_F(EvaluateFailures, OfSeveralFailingPiecesTheFirstIsToldForAnyThreads) {
  for (int threads : {1, 2, 4}) {
    options.threads = threads;
    const auto log = run(R"("bad": {"type": "Bad", "params": {"how": "loop"}})", {{"bad", "numbers"}});
    EXPECT_EQ(log.nodes.at("bad").diagnostics.front().message, "17");
  }
}

TEST_F(EvaluateFailures, TwoNodesOfOneKeyFailAlike) {
  options.keep_going = true;
  const auto log =
      run(R"("a": {"type": "Bad", "params": {"tag": "x"}}, "b": {"type": "Bad", "params": {"tag": "x"}})",
          {{"a", ""}, {"b", ""}});
  EXPECT_EQ(state(log, "a"), failed);
  EXPECT_EQ(state(log, "b"), failed);
  EXPECT_EQ(log.nodes.at("b").diagnostics.front().node, "b");
}

TEST_F(EvaluateFailures, AMissingNodeInATargetsWayRunsNothingOrOnlyTheOthers) {
  const std::string nodes = R"(
    "odd": {"type": "FromTheFuture", "params": {"x": 1}},
    "after": {"type": "Add", "inputs": {"terms": ["odd.numbers"]}},
    "n": {"type": "Count", "params": {"tag": "n"}},
    "rest": {"type": "Add", "inputs": {"terms": ["n.numbers"]}})";
  auto log = run(nodes, {{"rest", "sum"}});
  EXPECT_EQ(state(log, "rest"), done) << "it stands in nobody's way";
  EXPECT_EQ(state(log, "odd"), missing);
  EXPECT_FALSE(log.missing);
  trace.counts.clear();
  log = run(nodes, {{"after", "sum"}, {"rest", "sum"}});
  EXPECT_TRUE(log.missing);
  EXPECT_EQ(trace.times(), 0);
  EXPECT_EQ(state(log, "odd"), missing);
  EXPECT_EQ(state(log, "after"), blocked);
  EXPECT_EQ(state(log, "rest"), cancelled);
  options.keep_going = true;
  log = run(nodes, {{"after", "sum"}, {"rest", "sum"}});
  EXPECT_TRUE(log.missing);
  EXPECT_EQ(state(log, "after"), blocked);
  EXPECT_EQ(state(log, "rest"), done);
}

// Nodes that never end by themselves: these tests would hang if stopping did not reach into them.
TEST_F(EvaluateFailures, StoppingReachesIntoNodesAndTheirLoops) {
  for (const char* type : {"Spin", "SpinInLoop"}) {
    for (int threads : {1, 4}) {
      StopToken token;
      trace.counts.clear();
      options.threads = threads;
      std::thread other([&] {
        trace.wait_for("spin");
        token.stop();
      });
      const auto plan =
          plan_of(std::string(R"("spin": {"type": ")") + type + R"(", "params": {"tag": "spin"}},
        "after": {"type": "Add", "inputs": {"terms": ["spin.numbers"]}})");
      const auto log = evaluator().run(plan, {{"after", "sum"}}, options, callbacks, &token);
      other.join();
      EXPECT_EQ(state(log, "spin"), cancelled) << type;
      EXPECT_EQ(state(log, "after"), cancelled) << type;
      EXPECT_TRUE(log.stopped);
      EXPECT_FALSE(log.timed_out);
    }
  }
}

TEST_F(EvaluateFailures, ATimeOutReachesIntoNodes) {
  options.timeout = 0.05;
  auto log = run(R"("spin": {"type": "Spin"})", {{"spin", ""}});
  EXPECT_EQ(state(log, "spin"), cancelled);
  EXPECT_TRUE(log.timed_out);
  EXPECT_FALSE(log.stopped);
  options.timeout = 1000;
  log = run(R"("n": {"type": "Count"})", {{"n", ""}});
  EXPECT_FALSE(log.timed_out);
  EXPECT_EQ(state(log, "n"), done);
}

// What went before the run, such as opening the graph, is part of the user's time.
TEST_F(EvaluateFailures, TheTimeoutCountsFromWhereTheCommandBegan) {
  const auto now = std::chrono::steady_clock::now();
  EXPECT_TRUE(Halt(nullptr, 5, now - std::chrono::seconds(6)).asked());
  EXPECT_FALSE(Halt(nullptr, 500, now - std::chrono::seconds(6)).asked());
  EXPECT_FALSE(Halt(nullptr, 0, now - std::chrono::seconds(6)).asked());
}

// One question to Work is all that lies between a stop and its effect: a node that asks every few
// milliseconds stops within 50.
TEST_F(EvaluateFailures, TheNextCheckAfterAStopThrows) {
  StopToken token;
  Halt halt(&token, 0);
  MemoryLedger ledger(nullptr);
  ThreadsUsed used(1);
  NodeWork work(halt, ledger, used, {});
  work.check();
  work.progress(0.5);
  token.stop();
  EXPECT_THROW(work.check(), Cancelled);
  EXPECT_THROW(work.progress(0.5), Cancelled);
  int pieces = 0;
  EXPECT_THROW(work.parallel(100, 1, [&](std::size_t, std::size_t) { ++pieces; }), Cancelled);
  EXPECT_EQ(pieces, 0);
}

TEST_F(EvaluateFailures, AStopBeforeTheRunComputesNothing) {
  stop.stop();
  const auto log = run(half_bad, {{"rest", "sum"}});
  EXPECT_EQ(trace.times(), 0);
  EXPECT_EQ(state(log, "rest"), cancelled);
  EXPECT_TRUE(log.stopped);
}

TEST_F(EvaluateFailures, ProgressIsShownAtMostTwentyTimesASecond) {
  std::atomic<int> shown{0};
  callbacks.progress = [&](const std::string&, std::string_view, double progress) {
    if (progress > 0) ++shown;
  };
  options.timeout = 0.3;
  const auto log = run(R"("spin": {"type": "Spin"})", {{"spin", ""}});
  EXPECT_GE(shown, 1);
  EXPECT_LE(shown, 2 + static_cast<int>(log.seconds / 0.05));
}

TEST_F(EvaluateFailures, WorkingMemoryPastTheLimitIsAClearFailure) {
  options.memory = 100 << 20;
  auto log = run(R"("h": {"type": "Hungry", "params": {"mib": 99}})", {{"h", ""}});
  EXPECT_EQ(state(log, "h"), done);
  log = run(R"("h": {"type": "Hungry", "params": {"mib": 101}})", {{"h", ""}});
  EXPECT_EQ(state(log, "h"), failed);
  EXPECT_EQ(first_code(log, "h"), "out-of-memory");
  EXPECT_NE(log.nodes.at("h").diagnostics.front().hint.find("--memory"), std::string::npos);
}

TEST_F(EvaluateFailures, ValuesCountWithWorkingMemory) {
  options.memory = 100 << 20;
  const std::string nodes = R"(
    "n": {"type": "Count", "params": {"mib": 60}},
    "fits": {"type": "Add", "inputs": {"terms": ["n.numbers"]}},
    "large": {"type": "Count", "params": {"mib": 101}},
    "h": {"type": "Hungry", "params": {"mib": 50}},
    "both": {"type": "Add", "inputs": {"terms": ["n.numbers", "m.numbers"]}},
    "m": {"type": "Count", "params": {"mib": 60, "value": 1}})";
  EXPECT_EQ(state(run(nodes, {{"fits", "sum"}}), "fits"), done);
  EXPECT_EQ(first_code(run(nodes, {{"large", ""}}), "large"), "out-of-memory");
  options.keep_going = true;
  const auto log = run(nodes, {{"both", "sum"}});
  EXPECT_EQ(state(log, "both"), blocked) << "two values of 60 MiB are needed at once";
}

TEST_F(EvaluateFailures, ValuesThatNoPendingNodeNeedsAreLetGo) {
  options.memory = 100 << 20;
  options.threads = 1;
  std::string nodes = R"("c0": {"type": "Keep", "params": {"mib": 40}})";
  auto keep = toys::toy("Keep", trace,
                        [](Compute& node) {
                          node.output("numbers",
                                      toys::Numbers(
                                          {1}, static_cast<std::size_t>(node.params().integer("mib")) << 20));
                        })
                  .optional_input("numbers", {"Numbers"}, "the one before")
                  .param("mib", integer(0), "pretended size")
                  .output("numbers", "Numbers", "one");
  registry.add(std::move(keep));
  for (int i = 1; i < 10; ++i) {
    nodes += ", \"c" + std::to_string(i) +
             R"(": {"type": "Keep", "params": {"mib": 40}, "inputs": {"numbers": "c)" +
             std::to_string(i - 1) + ".numbers\"}}";
  }
  memory.emplace(std::size_t{1} << 30);  // keeps what it may, but gives way
  const auto log = run(nodes, {{"c9", "numbers"}});
  EXPECT_EQ(state(log, "c9"), done) << "a chain of 400 MiB, of which two links are needed at a time";
}

// Two nodes that fit one after the other, but not side by side: which runs first must not decide whether they
// fail.
TEST_F(EvaluateFailures, ANodeShortOfMemoryBesideOthersIsTriedAgainAlone) {
  options.memory = 100 << 20;
  options.threads = 2;
  auto greedy = toys::toy("Greedy", trace,
                          [this](Compute& node) {
                            const bool first = trace.times("g") == 1;
                            auto held = node.work().reserve(60 << 20);
                            if (first) trace.wait_for("refused");
                            node.output("numbers", toys::Numbers({1}));
                          })
                    .param("value", number(0), "tells keys apart")
                    .output("numbers", "Numbers", "one");
  greedy.compute = [inner = greedy.compute, this](Compute& node) {
    try {
      inner(node);
    } catch (const Failure&) {
      trace.ran("refused");
      throw;
    }
  };
  registry.add(std::move(greedy));
  const auto log = run(R"(
    "a": {"type": "Greedy", "params": {"tag": "g", "value": 1}},
    "b": {"type": "Greedy", "params": {"tag": "g", "value": 2}},
    "sum": {"type": "Add", "inputs": {"terms": ["a.numbers", "b.numbers"]}})",
                       {{"sum", "sum"}});
  EXPECT_EQ(trace.times("refused"), 1);
  EXPECT_EQ(state(log, "sum"), done);
}

}  // namespace
}  // namespace kinegraph
