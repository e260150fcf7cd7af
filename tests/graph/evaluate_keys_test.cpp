// What keys are made of, and that bytes and keys don't depend on threads, caches, folders or names.
#include "tests/graph/evaluate_toys.h"

namespace kinegraph {
namespace {

using toys::numbers;

class EvaluateKeys : public toys::World {
 protected:
  Key key(const Plan& plan, const std::string& node, const std::string& port = "") {
    const auto told = evaluator().explain(plan, node, port);
    EXPECT_TRUE(told.has_key) << told.why;
    return told.key;
  }
  Key key(const std::string& nodes, const std::string& node) { return key(plan_of(nodes), node); }
};

const std::string sum_of_file = R"(
  "clip": {"type": "Read", "params": {"tag": "clip", "file": "clip.txt"}},
  "loop": {"type": "Loop", "params": {"tag": "loop"}, "inputs": {"numbers": "clip.numbers"}},
  "sum": {"type": "Add", "params": {"tag": "sum", "plus": 0.5}, "inputs": {"terms": ["loop.numbers", "clip.numbers"]}})";

TEST_F(EvaluateKeys, BytesAndKeysAreTheSameForAnyThreadsCacheFolderAndNames) {
  toys::write(folder / "clip.txt", "walk");
  struct Seen {
    std::vector<double> bytes, loop;
    std::string key, loop_key;
    bool operator==(const Seen&) const = default;
  };
  const auto see = [&](const Plan& plan, const std::string& sum, const std::string& loop) {
    const auto log = run(plan, {{sum, "sum"}, {loop, "numbers"}});
    return Seen{numbers(evaluator().value(plan, sum, "sum")),
                numbers(evaluator().value(plan, loop, "numbers")), log.nodes.at(sum).outputs.at("sum").key,
                log.nodes.at(loop).outputs.at("numbers").key};
  };
  options.threads = 1;
  const auto first = see(plan_of(sum_of_file), "sum", "loop");
  EXPECT_EQ(first.key.size(), 32u);
  options.threads = 4;
  forget();
  EXPECT_EQ(see(plan_of(sum_of_file), "sum", "loop"), first) << "four threads";

  disk.emplace(folder / "cache", 0, registry);
  memory.emplace(1 << 24);
  forget();
  memory.emplace(1 << 24);
  EXPECT_EQ(see(plan_of(sum_of_file), "sum", "loop"), first) << "cold";
  EXPECT_EQ(see(plan_of(sum_of_file), "sum", "loop"), first) << "from memory";
  forget();
  EXPECT_EQ(see(plan_of(sum_of_file), "sum", "loop"), first) << "from disk";
  EXPECT_EQ(trace.times(), 0);

  std::string renamed = sum_of_file;
  for (const auto& [from, to] : {std::pair{"\"clip\"", "\"walk\""},
                                 {"\"clip.numbers\"", "\"walk.numbers\""},
                                 {"\"sum\":", "\"total\":"},
                                 {"clip.txt", "elsewhere/renamed.txt"}}) {
    for (auto at = renamed.find(from); at != std::string::npos; at = renamed.find(from, at + 1))
      renamed.replace(at, std::string(from).size(), to);
  }
  toys::write(folder / "elsewhere/renamed.txt", "walk");
  EXPECT_EQ(see(plan_of(renamed), "total", "loop"), first) << "another name, folder and file name";
  EXPECT_EQ(trace.times(), 0) << "all of it is still in the cache";
}

TEST_F(EvaluateKeys, HoldTheParametersThatMatterAndNoOthers) {
  const auto count = [&](const std::string& params) {
    return key(R"("n": {"type": "Count", "params": {)" + params + "}}", "n");
  };
  const auto plain = count("");
  EXPECT_EQ(count(R"("value": 0)"), plain) << "the default, written or not";
  EXPECT_EQ(count(R"("value": -0.0)"), plain);
  EXPECT_EQ(count(R"("tag": "other")"), plain) << "outside the key";
  EXPECT_NE(count(R"("value": 1)"), plain);
  EXPECT_NE(count(R"("mib": 1)"), plain);

  const auto save = [&](const std::string& params) {
    return key(
        R"("n": {"type": "Count"}, "save": {"type": "Save", "inputs": {"numbers": "n.numbers"}, "params": {)" +
            params + "}}",
        "save");
  };
  EXPECT_EQ(save(R"("file": "a.txt")"), save(R"("file": "b.txt")"));
  EXPECT_NE(save(R"("file": "a.txt")"), save(R"("file": "a.txt", "companion": "x")"));
}

TEST_F(EvaluateKeys, HoldTheContentOfFilesAndNotTheirPaths) {
  const auto read = [&](const std::string& params) {
    return key(R"("r": {"type": "Read", "params": {)" + params + "}}", "r");
  };
  toys::write(folder / "a.txt", "walk");
  toys::write(folder / "sub/b.txt", "walk");
  toys::write(folder / "c.txt", "sneak");
  const auto walk = read(R"("file": "a.txt")");
  EXPECT_EQ(read(R"("file": "sub/b.txt")"), walk);
  EXPECT_EQ(read(R"("file": "./sub/../a.txt")"), walk);
  EXPECT_NE(read(R"("file": "c.txt")"), walk);
  EXPECT_NE(read(R"("file": "gone.txt")"), walk);

  const auto beside = read(R"("file": "a.txt", "beside": ["c.txt"])");
  EXPECT_NE(beside, walk);
  EXPECT_NE(read(R"("file": "a.txt", "beside": ["a.txt"])"), beside);
  EXPECT_NE(read(R"("file": "c.txt", "beside": ["a.txt"])"), beside);

  toys::write(folder / "a.txt.more", "companion");
  const auto more = read(R"("file": "a.txt")");
  EXPECT_NE(more, walk);
  toys::write(folder / "a.txt.more", "other one");
  EXPECT_NE(read(R"("file": "a.txt")"), more);
  toys::write(folder / "a.txt", "dance");
  EXPECT_NE(read(R"("file": "a.txt")"), more);
}

TEST_F(EvaluateKeys, HoldInputsInTheirOrderAndPorts) {
  const auto add = [&](const std::string& inputs) {
    return key(
        R"("a": {"type": "Count", "params": {"value": 1}}, "b": {"type": "Count", "params": {"value": 2}},
                  "s": {"type": "Split", "inputs": {"numbers": "a.numbers"}},
                  "n": {"type": "Add", "inputs": {)" +
            inputs + "}}",
        "n");
  };
  const auto ab = add(R"("terms": ["a.numbers", "b.numbers"])");
  EXPECT_NE(add(R"("terms": ["b.numbers", "a.numbers"])"), ab);
  EXPECT_NE(add(R"("terms": ["a.numbers"], "extra": "b.numbers")"), ab);
  EXPECT_NE(add(R"("terms": ["a.numbers"])"), ab);
  EXPECT_NE(add(R"("terms": ["s.whole"])"), add(R"("terms": ["s.rest"])"));
}

TEST_F(EvaluateKeys, HoldTypeAndCodeVersionAndWhereItMattersTheCpu) {
  const std::string nodes = R"("n": {"type": "Count"}, "cpu": {"type": "Cpu"}, "loop": {"type": "Loop"})";
  const auto before = key(nodes, "n"), cpu = key(nodes, "cpu"), loop = key(nodes, "loop");
  EXPECT_NE(loop, before);
  evaluator().set_cpu_path("another");
  EXPECT_EQ(key(nodes, "n"), before);
  EXPECT_NE(key(nodes, "cpu"), cpu);

  auto mended = *registry.find("Count");
  mended.code_version = 2;
  Plan plan = plan_of(nodes);
  plan.nodes[static_cast<std::size_t>(plan.by_name.at("n"))].type = &mended;
  EXPECT_NE(key(plan, "n"), before);
}

TEST_F(EvaluateKeys, SwitchDotAndDisabledNodesHaveNone) {
  const auto direct =
      key(R"("a": {"type": "Count"}, "n": {"type": "Add", "inputs": {"terms": ["a.numbers"]}})", "n");
  EXPECT_EQ(key(R"("a": {"type": "Count"}, "dot": {"type": "Dot", "inputs": {"input": "a.numbers"}},
                  "off": {"type": "Add", "enabled": false, "inputs": {"terms": ["dot.output"]}},
                  "b": {"type": "Count", "params": {"value": 9}},
                  "pick": {"type": "Switch", "params": {"index": 1}, "inputs": {"inputs": ["b.numbers", "off.sum"]}},
                  "n": {"type": "Add", "inputs": {"terms": ["pick.output"]}})",
                "n"),
            direct);
}

TEST_F(EvaluateKeys, WhatIsKnownOfManyNodesIsWhatExplainAndValueTellOfEach) {
  toys::write(folder / "clip.txt", "walk");
  disk.emplace(folder / "cache", 0, registry);
  memory.emplace(1 << 24);
  const auto plan = plan_of(sum_of_file);
  EXPECT_EQ(Evaluator::Known(evaluator(), plan, {"sum"}).cached("sum", "sum"), "no");
  run(plan, {{"sum", "sum"}});
  const Evaluator::Known known(evaluator(), plan, {"sum"});
  EXPECT_EQ(known.cached("sum", "sum"), "memory");
  EXPECT_TRUE(known.value("sum", "sum"));
  EXPECT_EQ(known.value("sum", "sum"), evaluator().value(plan, "sum", "sum"));
  EXPECT_EQ(known.cached("smu", "sum"), "no");
  EXPECT_FALSE(known.value("smu", "sum"));
  forget();
  EXPECT_EQ(Evaluator::Known(evaluator(), plan, {"sum"}).cached("sum", "sum"), "disk");
}

TEST_F(EvaluateKeys, ExplainNamesThePartsAndWhetherItIsCached) {
  toys::write(folder / "clip.txt", "walk");
  disk.emplace(folder / "cache", 0, registry);
  memory.emplace(1 << 24);
  const auto plan = plan_of(sum_of_file);
  auto told = evaluator().explain(plan, "sum", "");
  EXPECT_EQ(told.cached, "no");
  EXPECT_FALSE(told.why.empty());
  std::set<std::string> parts;
  for (const auto& part : told.parts) parts.insert(part.what);
  for (const char* what : {"type", "code version", "param plus", "input terms", "port"})
    EXPECT_TRUE(parts.contains(what)) << what;
  EXPECT_FALSE(parts.contains("param tag"));
  const auto log = run(plan, {{"sum", "sum"}});
  told = evaluator().explain(plan, "sum", "sum");
  EXPECT_EQ(told.cached, "memory");
  EXPECT_EQ(to_text(told.key), log.nodes.at("sum").outputs.at("sum").key);
  forget();
  EXPECT_EQ(evaluator().explain(plan, "sum", "sum").cached, "disk");
  EXPECT_EQ(trace.times(), 0);
  EXPECT_THROW(evaluator().explain(plan, "smu", ""), Failure);
  EXPECT_THROW(evaluator().explain(plan, "sum", "smu"), Failure);
}

}  // namespace
}  // namespace kinegraph
