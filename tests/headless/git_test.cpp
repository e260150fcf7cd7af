// diff and merge as git uses them, in a real repository.
#include <cstdlib>

#include "program.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string base = graph(R"("walk": {"type": "Gait", "params": {"seconds": 1}},
  "smooth": {"type": "Filter", "inputs": {"motion": "walk.motion"}},
  "out": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "smooth.motion"}})");

std::string changed(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

class Git : public ProgramTest {
 protected:
  void SetUp() override {
    if (std::system("git --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no git";
    write(".gitattributes", "*.kg.json text eol=lf merge=kinegraph diff=kinegraph\n");
    git("init -q -b main . && git config user.name T && git config user.email t@example.org && "
        "git config merge.kinegraph.name 'Kinegraph graphs' && "
        "git config merge.kinegraph.driver '" +
        bin_folder() +
        "/kinegraph merge %O %A %B -o %A --path %P' && "
        "git config diff.kinegraph.textconv '" +
        bin_folder() + "/kinegraph diff --textconv'");
    commit(base, "base");
  }
  // `git ARGUMENTS`; what it says is in "../said" of the folder.
  int git(const std::string& arguments) {
    const std::string command = "cd '" + path("") + "' && { git " + arguments + "; } >.git-said 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string said() { return read(".git-said"); }
  void commit(const std::string& text, const std::string& message) {
    write("g.kg.json", text);
    EXPECT_EQ(run({"fmt", "g.kg.json"}).exit, 0);
    EXPECT_EQ(git("add .gitattributes g.kg.json && git commit -q -m " + message), 0) << said();
  }
  // Two branches from the base, merged: git's exit code.
  int merged(const std::string& ours, const std::string& theirs) {
    git("checkout -q -b theirs main");
    commit(theirs, "theirs");
    git("checkout -q -b ours main");
    commit(ours, "ours");
    return git("merge -q -m merged theirs");
  }
};

TEST_F(Git, TwoBranchesThatEachAddNodes) {
  const std::string ours =
      changed(base, "\"walk\": {",
              R"("trim_a1b2": {"type": "Trim", "inputs": {"motion": "walk.motion"}}, "walk": {)");
  const std::string theirs =
      changed(base, "\"walk\": {",
              R"("trim_c3d4": {"type": "Trim", "inputs": {"motion": "smooth.motion"}}, "walk": {)");
  EXPECT_EQ(merged(ours, theirs), 0) << said();
  EXPECT_EQ(run({"fmt", "--check", "g.kg.json"}).exit, 0);
  EXPECT_EQ(run({"validate", "g.kg.json"}).exit, 0);
  EXPECT_THAT(read("g.kg.json"), HasSubstr("trim_a1b2"));
  EXPECT_THAT(read("g.kg.json"), HasSubstr("trim_c3d4"));
}

TEST_F(Git, NeighbouringParametersOfOneNodeWhereLinesWouldConflict) {
  EXPECT_EQ(merged(changed(base, "\"seconds\": 1", "\"seconds\": 2"),
                   changed(base, "\"seconds\": 1", "\"seconds\": 1, \"seed\": 7")),
            0)
      << said();
  EXPECT_THAT(read("g.kg.json"), HasSubstr("\"seconds\": 2,\n        \"seed\": 7\n"));
}

TEST_F(Git, TheSameParameterConflictsWithMarkersThatCanBeResolved) {
  EXPECT_EQ(merged(changed(base, "\"seconds\": 1", "\"seconds\": 2"),
                   changed(base, "\"seconds\": 1", "\"seconds\": 3")),
            1);
  EXPECT_THAT(said(), HasSubstr("g.kg.json: conflict: walk.seconds: 2 here, 3 there"));
  EXPECT_THAT(
      read("g.kg.json"),
      HasSubstr("<<<<<<< ours\n        \"seconds\": 2\n=======\n        \"seconds\": 3\n>>>>>>> theirs\n"));
  Ran validated = run({"validate", "g.kg.json"});
  EXPECT_EQ(validated.exit, 3);
  EXPECT_THAT(validated.out, HasSubstr("conflict-markers"));
  EXPECT_EQ(git("checkout --theirs g.kg.json && git add g.kg.json && git commit -q -m resolved"), 0)
      << said();
  EXPECT_THAT(read("g.kg.json"), HasSubstr("\"seconds\": 3"));
}

TEST_F(Git, ARenameAgainstAnEdit) {
  EXPECT_EQ(merged(changed(changed(base, "walk.motion", "stroll.motion"), "\"walk\": {", "\"stroll\": {"),
                   changed(base, "\"seconds\": 1", "\"seconds\": 3, \"gait\": \"sneak\"")),
            0)
      << said();
  EXPECT_EQ(run({"validate", "g.kg.json"}).exit, 0);
  EXPECT_THAT(read("g.kg.json"), HasSubstr("\"stroll\": {\n      \"type\": \"Gait\",\n      \"params\": {\n  "
                                           "      \"gait\": \"sneak\",\n        \"seconds\": 3"));
  EXPECT_THAT(read("g.kg.json"), Not(HasSubstr("\"walk\"")));
}

TEST_F(Git, ARemovalAgainstAnEdit) {
  const std::string removed = graph(R"("walk": {"type": "Gait", "params": {"seconds": 1}},
    "out": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "walk.motion"}})");
  EXPECT_EQ(merged(removed, changed(base, "\"Filter\"", "\"Filter\", \"enabled\": false")), 1);
  EXPECT_THAT(said(), HasSubstr("smooth is removed here and changed there"));
}

TEST_F(Git, TheSameListGrowsOnBothSides) {
  const auto checks = [](const std::string& rules) {
    return graph(R"("walk": {"type": "Gait"}, "m": {"type": "Metrics", "inputs": {"motion": "walk.motion"}},
      "check": {"type": "Check", "inputs": {"metrics": "m.metrics"}, "params": {"rules": [)" +
                 rules + "]}}");
  };
  commit(checks(R"("skate.max < 1")"), "rules");
  EXPECT_EQ(
      merged(checks(R"("skate.max < 1", "skate.mean < 2")"), checks(R"("skate.max < 1", "jerk.mean < 3")")),
      0)
      << said();
  EXPECT_THAT(read("g.kg.json"), HasSubstr("skate.mean < 2"));
  EXPECT_THAT(read("g.kg.json"), HasSubstr("jerk.mean < 3"));
}

TEST_F(Git, GraphsInAFolderThatUseOthers) {
  // The list parameter that lib/judge.kg.json publishes merges by element; a link to what it doesn't publish
  // that only both together make is a conflict.
  std::filesystem::create_directories(path("graphs/lib"));
  write(
      "graphs/lib/judge.kg.json",
      graph(
          R"("m": {"type": "Metrics"}, "c": {"type": "Check", "inputs": {"metrics": "m.metrics"}})",
          R"("inputs": {"motion": "m.motion"}, "params": {"rules": "c.rules"}, "outputs": {"metrics": "m.metrics"})"));
  const auto main = [](const std::string& rules, const std::string& rest = {}) {
    return graph(
        R"("walk": {"type": "Gait"}, "judge": {"type": "Graph", "params": {"file": "lib/judge.kg.json", "rules": [)" +
        rules + R"(]}, "inputs": {"motion": "walk.motion"}})" + rest);
  };
  write("graphs/main.kg.json", main(R"("skate < 1")"));
  ASSERT_EQ(run({"fmt", "graphs/main.kg.json", "graphs/lib/judge.kg.json"}).exit, 0);
  ASSERT_EQ(git("add graphs && git commit -q -m nested && git checkout -q -b mine"), 0) << said();
  write("graphs/main.kg.json", main(R"("skate < 1", "jerk < 3")"));
  ASSERT_EQ(run({"fmt", "graphs/main.kg.json"}).exit, 0);
  ASSERT_EQ(git("commit -q -am mine && git checkout -q main"), 0) << said();
  write("graphs/main.kg.json", main(R"("skate < 1", "sparc > -4")"));
  ASSERT_EQ(run({"fmt", "graphs/main.kg.json"}).exit, 0);
  ASSERT_EQ(git("commit -q -am yours"), 0) << said();
  EXPECT_EQ(git("merge -q -m merged mine"), 0) << said();
  EXPECT_THAT(read("graphs/main.kg.json"), HasSubstr(R"(["skate < 1", "sparc > -4", "jerk < 3"])"));
  EXPECT_EQ(run({"validate", "--strict", "graphs/main.kg.json"}).exit, 0);
}

TEST_F(Git, DiffIsColouredOnATerminalAndNeverUnderNoColor) {
  if (std::system("script --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no script(1)";
  write("a.kg.json", base);
  write("b.kg.json", changed(base, "\"seconds\": 1", "\"seconds\": 2"));
  const auto on_terminal = [&](const std::string& setting) {
    const std::string command = "cd '" + path("") + "' && " + setting + " script -qec '" + bin_folder() +
                                "/kinegraph diff a.kg.json b.kg.json' /dev/null >said 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return read("said");
  };
  EXPECT_THAT(on_terminal("TERM=xterm"), HasSubstr("\x1b["));
  EXPECT_THAT(on_terminal("NO_COLOR=1 TERM=xterm"), Not(HasSubstr("\x1b[")));
}

TEST_F(Git, GitDiffShowsUnits) {
  commit(changed(base, "\"seconds\": 1", "\"seconds\": 2"), "longer");
  EXPECT_EQ(git("diff --no-color HEAD~1 HEAD -- g.kg.json"), 0);
  EXPECT_THAT(said(), HasSubstr("-walk.seconds = 1\n+walk.seconds = 2\n"));
}

TEST_F(Git, GitDiffShowsARangeOnOneLineAndAListByItsElements) {
  const auto trimmed = [](const std::string& range, const std::string& rules) {
    return graph(R"("walk": {"type": "Gait"}, "trim": {"type": "Trim", "params": {"range": )" + range +
                 R"(}, "inputs": {"motion": "walk.motion"}},
      "m": {"type": "Metrics", "inputs": {"motion": "trim.motion"}},
      "check": {"type": "Check", "params": {"rules": [)" +
                 rules + R"(]}, "inputs": {"metrics": "m.metrics"}})");
  };
  commit(trimmed("[0, 50]", R"("skate < 1")"), "trim");
  commit(trimmed("[5, null]", R"("skate < 1", "jerk < 9")"), "longer");
  EXPECT_EQ(git("diff --no-color HEAD~1 HEAD -- g.kg.json"), 0);
  EXPECT_THAT(said(), HasSubstr("-trim.range = [0, 50]\n+trim.range = [5, null]\n"));
  EXPECT_THAT(said(), HasSubstr(" check.rules: \"skate < 1\"\n+check.rules: \"jerk < 9\"\n"));
}

TEST_F(Git, DiffTellsNodesLinksAndParameters) {
  write("a.kg.json", base);
  write("b.kg.json", graph(R"("stroll": {"type": "Gait", "params": {"seconds": 1, "seed": 3}},
    "out": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "stroll.motion"}})"));
  Ran ran = run({"diff", "a.kg.json", "b.kg.json"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_THAT(ran.out, HasSubstr("~ walk → stroll (Gait)  renamed\n    seed: default → 3\n"));
  EXPECT_THAT(ran.out, HasSubstr("- smooth (Filter)\n"));
  EXPECT_THAT(ran.out, HasSubstr("~ out (Export)\n    motion ← smooth.motion → stroll.motion\n"));
  EXPECT_EQ(run({"diff", "--check", "a.kg.json", "b.kg.json"}).exit, 1);
  EXPECT_EQ(run({"diff", "--check", "a.kg.json", "a.kg.json"}).exit, 0);
  auto told = nlohmann::json::parse(run({"diff", "--json", "a.kg.json", "b.kg.json"}).out);
  EXPECT_EQ(told["renamed"]["walk"], "stroll");
  EXPECT_EQ(told["changes"].size(), 3u);
  EXPECT_EQ(run({"diff", "a.kg.json"}).exit, 2);
  EXPECT_EQ(run({"diff", "a.kg.json", "none.kg.json"}).exit, 3);
}

TEST_F(Git, MergeRefusesWhatItCantRead) {
  write("new.kg.json", R"({"format": "kinegraph", "schema": 99})");
  EXPECT_EQ(run({"merge", "g.kg.json", "g.kg.json", "new.kg.json", "-o", "m.kg.json"}).exit, 3);
  write("bad.kg.json", "{");
  EXPECT_EQ(run({"merge", "g.kg.json", "bad.kg.json", "g.kg.json", "-o", "m.kg.json"}).exit, 3);
  EXPECT_FALSE(exists("m.kg.json"));
  // Both sides made the file: git gives an empty base.
  write("empty.kg.json", "");
  EXPECT_EQ(run({"merge", "empty.kg.json", "g.kg.json", "g.kg.json", "-o", "m.kg.json"}).exit, 0);
  EXPECT_EQ(read("m.kg.json"), read("g.kg.json"));
}

}  // namespace
}  // namespace kinegraph
