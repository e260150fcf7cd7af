// What a person reads after `kinegraph run`: results first, then notes, warnings and errors.
#include "program.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::Not;

class Messages : public ProgramTest {};

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

// A walk, the same calmed, and what both measure.
std::string two_measured() {
  return graph(R"("walk": {"type": "Gait", "params": {"seconds": 2}},
                  "calm": {"type": "Filter", "inputs": {"motion": "walk.motion"}},
                  "after": {"type": "Metrics", "inputs": {"motion": "calm.motion", "reference": "walk.motion"}},
                  "before": {"type": "Metrics", "inputs": {"motion": "walk.motion"}},
                  "judge": {"type": "Check", "params": {"rules": ["jerk < 1.05 * baseline.jerk"]},
                            "inputs": {"metrics": "after.metrics", "baseline": "before.metrics"}})");
}

TEST_F(Messages, MetricsStandSideBySideInTheOrderOfTheGraph) {
  write("g.kg.json", two_measured());
  Ran ran = run({"run", "g.kg.json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  auto before = ran.out.find("before"), after = ran.out.find("after");
  EXPECT_LT(before, after);
  EXPECT_LT(after, ran.out.find('\n'));
  EXPECT_THAT(ran.out, testing::ContainsRegex("\njerk +[0-9.]+ +[0-9.]+  m/s3\n"));
  EXPECT_THAT(ran.out, testing::ContainsRegex("\nstyle_distance +- +[0-9.e-]+  deg\n"));  // no reference
  EXPECT_THAT(ran.out, Not(HasSubstr("jerk.")));
  EXPECT_LT(ran.out.find("style_distance"), ran.out.find("passed  judge"));
}

TEST_F(Messages, OnlyTheMetricsThatWereNeededAreTold) {
  write("g.kg.json", two_measured());
  Ran ran = run({"run", "g.kg.json", "--target", "before"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("before"));
  EXPECT_THAT(ran.out, Not(HasSubstr("after")));
  EXPECT_THAT(run({"run", "g.kg.json", "--dry-run"}).out, Not(HasSubstr("style_distance")));
}

TEST_F(Messages, NodesThatSayTheSameShareALine) {
  write("g.kg.json", walk_and_export());
  ASSERT_EQ(run({"run", "g.kg.json"}).exit, 0);
  write("two.kg.json", graph(R"("a": {"type": "Load", "params": {"file": "walk.bvh"}},
                               "b": {"type": "Load", "params": {"file": "walk.bvh"}},
                               "both": {"type": "Blend", "inputs": {"motion": "a.motion", "other": "b.motion"}})"));
  Ran ran = run({"run", "two.kg.json", "--target", "both"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("info: unit-found: a.unit, b.unit:"));
  EXPECT_EQ(count_of(ran.err, "unit-found"), 1u);
}

TEST_F(Messages, WhatFailedStandsBeforeWhatItBlocked) {
  write("g.kg.json", graph(R"("z": {"type": "Load", "params": {"file": "none.bvh"}},
                             "a": {"type": "Export", "params": {"file": "a.bvh"}, "inputs": {"motion": "z.motion"}})"));
  Ran ran = run({"run", "g.kg.json"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_LT(ran.err.find("missing-file: z.file"), ran.err.find("blocked: a.motion"));
}

TEST_F(Messages, ARuleTellsWhyNothingCouldBeMeasured) {
  write("metrics.json", metrics_file(0.02));
  write("unknown.kg.json", check_of("skat < 1"));
  write("null.kg.json", check_of("aligned_distance < 1"));
  write("base.kg.json", check_of("skate < baseline.skate"));
  Ran ran = run({"run", "unknown.kg.json", "--junit", "j.xml"});
  EXPECT_EQ(ran.exit, 4);
  EXPECT_THAT(read("j.xml"), HasSubstr("\"skat &lt; 1: not measured, limit 1\""));
  EXPECT_THAT(ran.out, HasSubstr("failed  judge: skat < 1   not measured, limit 1"));
  EXPECT_THAT(ran.err, HasSubstr("warning: unknown-metric: judge.rules"));
  EXPECT_THAT(ran.err, HasSubstr("did you mean \"skate\"?"));
  EXPECT_THAT(run({"run", "null.kg.json"}).err, HasSubstr("aligned_distance could not be measured"));
  EXPECT_THAT(run({"run", "base.kg.json"}).err, HasSubstr("link baseline"));
}

TEST_F(Messages, AReportKeepsEveryNodesOwnWords) {
  write("metrics.json", metrics_file(0.02));
  write("g.kg.json", check_of("nope < 1"));
  ASSERT_EQ(run({"run", "g.kg.json", "--report", "r.json"}).exit, 4);
  auto said = read_json("r.json")["nodes"]["judge"]["diagnostics"];
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0]["severity"], "warning");
  EXPECT_EQ(said[0]["param"], "rules");
}

TEST_F(Messages, ARefusedLinkIsNamedWithWhereItLeads) {
  std::filesystem::create_directories(path("in"));
  std::filesystem::create_directories(path("other"));
  std::filesystem::create_directory_symlink(path("other"), path("in/sub"));
  write("in/l.kg.json", graph(R"("w": {"type": "Gait", "params": {"seconds": 1}},
                                "o": {"type": "Export", "params": {"file": "sub/o.bvh"}, "inputs": {"motion": "w.motion"}})"));
  Ran ran = run({"run", "in/l.kg.json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, HasSubstr("is linked to"));
  EXPECT_THAT(ran.err, HasSubstr("other/o.bvh"));
}

// A graph in "in" that reads a clip, and one that uses it.
class MessagesOnArguments : public Messages {
 protected:
  void SetUp() override {
    write("in/g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": "zebra.bvh"}})",
                                R"("outputs": {"o": "clip.motion"}, "params": {"source": "clip.file"})"));
    write("in/outer.kg.json", graph(R"("inner": {"type": "Graph", "params": {"file": "g.kg.json"}})",
                                    R"("outputs": {"o": "inner.o"})"));
  }
};

TEST_F(MessagesOnArguments, AVariableThatNothingUsesIsWarnedOf) {
  write("walk.kg.json", graph(R"("walk": {"type": "Gait", "params": {"seconds": "${length}"}})",
                              R"("outputs": {"o": "walk.motion"})"));
  Ran ran = run({"run", "walk.kg.json", "--var", "length=1", "--var", "lenght=2", "--report", "r.json"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_THAT(ran.err, HasSubstr("walk.kg.json: warning: unused-variable: --var lenght: the graph has no "
                                 "${lenght} (did you mean \"length\"?)"));
  EXPECT_EQ(count_of(ran.err, "unused-variable"), 1u);
  EXPECT_EQ(count_of(read("r.json"), "unused-variable"), 1u);
  EXPECT_THAT(run({"validate", "walk.kg.json", "--var", "length=1", "--var", "lenght=2"}).out,
              HasSubstr("unused-variable: --var lenght"));
  EXPECT_EQ(run({"validate", "--strict", "walk.kg.json", "--var", "length=1", "--var", "lenght=2"}).exit, 3);
}

TEST_F(MessagesOnArguments, AFileThatIsMissingIsNamedAsItWasTyped) {
  for (const std::string typed : {"none.bvh", "in/none.bvh", "./in/../none.amc"})
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"convert", typed, "o.bvh"}, std::vector<std::string>{"info", typed}}) {
      Ran ran = run(command);
      EXPECT_EQ(ran.exit, 3);
      EXPECT_THAT(ran.err, HasSubstr("missing-file: there is no file '" + typed + "'"));
      EXPECT_THAT(ran.err, Not(HasSubstr(path(""))));
      EXPECT_THAT(ran.err, HasSubstr("current folder"));
    }
  EXPECT_FALSE(exists("o.bvh"));
}

TEST_F(MessagesOnArguments, AMissingPathOfSetIsLookedForInTheCurrentFolder) {
  for (const char* set : {"clip.file=none.bvh", "source=none.bvh"}) {
    Ran ran = run({"run", "in/g.kg.json", "--set", set});
    EXPECT_EQ(ran.exit, 1);
    EXPECT_THAT(ran.err, HasSubstr("there is no file 'none.bvh' (check the path: one on the command line "
                                   "starts at the current folder)"));
  }
  Ran own = run({"run", "in/g.kg.json"});
  EXPECT_EQ(own.exit, 1);
  EXPECT_THAT(own.err, HasSubstr("'zebra.bvh' (check the path: a graph's own start at its folder"));
}

TEST_F(MessagesOnArguments, AMissingGraphFileOfSetIsLookedForInTheCurrentFolder) {
  Ran ran = run({"run", "in/outer.kg.json", "--set", "inner.file=none.kg.json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, HasSubstr("there is no file '" + path("none.kg.json") +
                                 "' (a path on the command line starts at the current folder)"));
  EXPECT_THAT(ran.err, Not(HasSubstr("no parameter")));
  write("in/lost.kg.json", graph(R"("inner": {"type": "Graph", "params": {"file": "none.kg.json"}})",
                                 R"("outputs": {"o": "inner.o"})"));
  EXPECT_THAT(run({"run", "in/lost.kg.json"}).err, HasSubstr("(paths are relative to the graph file)"));
}

}  // namespace
}  // namespace kinegraph
