// `kinegraph run`: what it does, what it writes, and the exit code that tells how it went.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <regex>
#include <thread>

#include "program.h"

namespace kinegraph {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Run : public ProgramTest {};

TEST_F(Run, WritesTheExportsOfAGraphBesideIt) {
  write("graphs/g.kg.json", walk_and_export());
  Ran ran = run({"run", "graphs/g.kg.json"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(read("graphs/walk.bvh"), HasSubstr("HIERARCHY"));
  EXPECT_THAT(ran.out, HasSubstr("wrote"));
  EXPECT_THAT(ran.out, HasSubstr("graphs/walk.bvh"));
}

TEST_F(Run, WritesIntoTheOutFolderAndMakesIt) {
  write("g.kg.json", walk_and_export());
  EXPECT_EQ(run({"run", "g.kg.json", "--out", "deep/er"}).exit, 0);
  EXPECT_TRUE(exists("deep/er/walk.bvh"));
  EXPECT_FALSE(exists("walk.bvh"));
}

TEST_F(Run, WithoutExportsRunsPublishedOutputs) {
  write("g.kg.json", graph(R"("walk": {"type": "Gait"}, "other": {"type": "Gait"})",
                           R"("outputs": {"result": "walk.motion"})"));
  ASSERT_EQ(run({"run", "g.kg.json", "--report", "r.json"}).exit, 0);
  auto report = read_json("r.json");
  EXPECT_EQ(report["nodes"]["walk"]["state"], "done");
  EXPECT_EQ(report["nodes"]["other"]["state"], "skipped");
}

TEST_F(Run, WithNothingToDoIsWrongUsageAndWritesNoReport) {
  write("g.kg.json", graph(R"("walk": {"type": "Gait"})"));
  Ran ran = run({"run", "g.kg.json", "--report", "r.json"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("--target"));
  EXPECT_FALSE(exists("r.json"));
}

TEST_F(Run, TargetRunsOnlyWhatIsNamed) {
  write("g.kg.json", walk_and_export());
  EXPECT_EQ(run({"run", "g.kg.json", "--target", "walk.motion"}).exit, 0);
  EXPECT_FALSE(exists("walk.bvh"));
}

// Of a Load all that its file holds.
TEST_F(Run, TargetOfAWholeNodeTakesWhatItGives) {
  write("make.kg.json", walk_and_export());
  ASSERT_EQ(run({"run", "make.kg.json"}).exit, 0);
  write("g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": "walk.bvh"}})"));
  const Ran ran = run({"run", "g.kg.json", "--target", "clip", "--report", "r.json"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(read_json("r.json")["nodes"]["clip"]["state"], "done");
  const Ran points = run({"run", "g.kg.json", "--target", "clip.points"});
  EXPECT_EQ(points.exit, 1);
  EXPECT_THAT(points.err, HasSubstr("the file holds motion, no points"));
}

TEST_F(Run, UnknownNamesOnTheCommandLineAreWrongUsageAndNameTheNearest) {
  write("g.kg.json", walk_and_export());
  struct Slip {
    std::vector<std::string> words;
    std::string says;
  };
  for (const Slip& slip :
       {Slip{{"--target", "wlk"}, "\"walk\""}, Slip{{"--target", "walk.motoin"}, "\"motion\""},
        Slip{{"--set", "wakl.speed=1"}, "\"walk\""}, Slip{{"--set", "walk.sped=1"}, "\"speed\""},
        Slip{{"--set", "pce=1"}, "\"pace\""}, Slip{{"--set", "walk.speed=fast"}, "speed"},
        Slip{{"--set", "walk.speed"}, "NODE.PARAM=VALUE"}, Slip{{"--var", "x"}, "NAME=VALUE"},
        Slip{{"--memory", "lots"}, "512M"}, Slip{{"--progress", "loud"}, "auto, bar, json or none"},
        Slip{{"--thread", "2"}, "--thread"}}) {
    std::vector<std::string> words{"run", "g.kg.json", "--report", "r.json"};
    words.insert(words.end(), slip.words.begin(), slip.words.end());
    Ran ran = run(words);
    EXPECT_EQ(ran.exit, 2) << slip.words[0] << " " << slip.words[1] << ": " << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(slip.says));
    EXPECT_FALSE(exists("r.json"));
    EXPECT_FALSE(exists("walk.bvh"));
  }
}

TEST_F(Run, UnknownCommandsNameTheNearest) {
  Ran inner = run({"cache", "stats"});
  EXPECT_EQ(inner.exit, 2);
  EXPECT_THAT(inner.err, HasSubstr("there is no command \"cache stats\" (did you mean \"stat\"?)"));
  Ran ran = run({"rnu"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("\"run\""));
  EXPECT_EQ(run({}).exit, 2);
}

TEST_F(Run, SetReachesParametersAndPublishedOnes) {
  write("g.kg.json", walk_and_export());
  ASSERT_EQ(run({"run", "g.kg.json", "--report", "a.json"}).exit, 0);
  ASSERT_EQ(run({"run", "g.kg.json", "--set", "walk.speed=1.7", "--report", "b.json"}).exit, 0);
  ASSERT_EQ(run({"run", "g.kg.json", "--set", "pace=1.7", "--report", "c.json"}).exit, 0);
  auto key = [&](const char* file) { return read_json(file)["nodes"]["walk"]["outputs"]["motion"]["key"]; };
  EXPECT_NE(key("a.json"), key("b.json"));
  EXPECT_EQ(key("b.json"), key("c.json"));
}

TEST_F(Run, DryRunWritesNothingNotEvenTheCache) {
  write("g.kg.json", walk_and_export());
  Ran ran = run({"run", "g.kg.json", "--dry-run", "--cache", "cache"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_THAT(ran.out, HasSubstr("run  walk"));
  EXPECT_THAT(ran.out, HasSubstr("walk.bvh"));
  EXPECT_THAT(files(), ElementsAre("g.kg.json"));
}

TEST_F(Run, DryRunTellsHitsOfTheCache) {
  write("g.kg.json", walk_and_export());
  ASSERT_EQ(run({"run", "g.kg.json", "--cache", "cache"}).exit, 0);
  EXPECT_THAT(run({"run", "g.kg.json", "--dry-run", "--cache", "cache"}).out, HasSubstr("hit  walk"));
  EXPECT_THAT(run({"run", "g.kg.json", "--dry-run", "--cache", "cache", "--no-cache"}).out,
              HasSubstr("run  walk"));
  EXPECT_THAT(run({"run", "g.kg.json", "--dry-run"}, {"KINEGRAPH_CACHE=cache"}).out, HasSubstr("hit  walk"));
}

TEST_F(Run, ReportHasTheContractsForm) {
  write("g.kg.json", walk_and_export());
  ASSERT_EQ(run({"run", "g.kg.json", "--out", "out", "--report", "r.json"}).exit, 0);
  auto report = read_json("r.json");
  std::vector<std::string> members;
  for (const auto& [key, value] : report.items()) members.push_back(key);
  EXPECT_THAT(members, ElementsAre("checks", "exit", "files", "format", "graph", "metrics", "nodes", "schema",
                                   "seconds", "threads", "version"));
  EXPECT_EQ(report["format"], "kinegraph-report");
  EXPECT_EQ(report["schema"], 1);
  EXPECT_EQ(report["graph"], "g.kg.json");
  EXPECT_EQ(report["exit"], 0);
  EXPECT_GE(report["threads"]["allowed"], 1);
  EXPECT_GE(report["threads"]["used"], 1);
  auto walk = report["nodes"]["walk"];
  EXPECT_EQ(walk["type"], "Gait");
  EXPECT_EQ(walk["state"], "done");
  EXPECT_EQ(walk["outputs"]["motion"]["cached"], "no");
  EXPECT_EQ(walk["outputs"]["motion"]["key"].get<std::string>().size(), 32u);
  EXPECT_GT(walk["outputs"]["motion"]["bytes"], 1000);
  ASSERT_EQ(report["files"].size(), 1u);
  EXPECT_EQ(report["files"][0]["node"], "out");
  EXPECT_EQ(report["files"][0]["path"], "walk.bvh");
  EXPECT_EQ(report["files"][0]["bytes"], read("out/walk.bvh").size());
  auto digest = read_json("r.json")["files"][0]["sha256"].get<std::string>();
  EXPECT_EQ(
      std::system(
          ("cd " + path("out") + " && echo '" + digest + "  walk.bvh' | sha256sum -c --status").c_str()),
      0);
}

TEST_F(Run, ReportTellsWhereOutputsCameFrom) {
  write("g.kg.json", walk_and_export());
  ASSERT_EQ(run({"run", "g.kg.json", "--cache", "cache"}).exit, 0);
  ASSERT_EQ(run({"run", "g.kg.json", "--cache", "cache", "--report", "r.json"}).exit, 0);
  EXPECT_EQ(read_json("r.json")["nodes"]["walk"]["outputs"]["motion"]["cached"], "disk");
}

TEST_F(Run, AMissingFileFailsItsNodeAndBlocksWhatNeedsIt) {
  write("g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": "none.bvh"}},
                             "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "clip.motion"}},
                             "walk": {"type": "Gait", "params": {"seconds": 1}},
                             "good": {"type": "Export", "params": {"file": "good.bvh"}, "inputs": {"motion": "walk.motion"}})"));
  Ran ran = run({"run", "g.kg.json", "--keep-going", "--report", "r.json", "--junit", "j.xml"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_THAT(ran.err, HasSubstr("none.bvh"));
  auto report = read_json("r.json");
  EXPECT_EQ(report["exit"], 1);
  EXPECT_EQ(report["nodes"]["clip"]["state"], "failed");
  EXPECT_EQ(report["nodes"]["clip"]["diagnostics"][0]["severity"], "error");
  EXPECT_EQ(report["nodes"]["out"]["state"], "blocked");
  EXPECT_EQ(report["nodes"]["good"]["state"], "done");
  EXPECT_TRUE(exists("good.bvh"));
  EXPECT_THAT(read("j.xml"), HasSubstr("errors=\"2\""));
}

TEST_F(Run, AFailedCheckExits4AndStandsInTheJUnitFileWithItsValue) {
  write("metrics.json", metrics_file(0.02));
  write("good.kg.json", check_of("skate < 0.05"));
  write("bad.kg.json", check_of("skate < 0.01"));
  write("null.kg.json", check_of("aligned_distance < 1"));
  EXPECT_EQ(run({"run", "good.kg.json"}).exit, 0);
  Ran ran = run({"run", "bad.kg.json", "--report", "r.json", "--junit", "j.xml"});
  EXPECT_EQ(ran.exit, 4);
  EXPECT_THAT(ran.out, HasSubstr("failed  judge: skate < 0.01"));
  auto check = read_json("r.json")["checks"][0];
  EXPECT_EQ(check["node"], "judge");
  EXPECT_EQ(check["rule"], "skate < 0.01");
  EXPECT_DOUBLE_EQ(check["value"].get<double>(), 0.02);
  EXPECT_DOUBLE_EQ(check["limit"].get<double>(), 0.01);
  EXPECT_EQ(check["passed"], false);
  EXPECT_DOUBLE_EQ(read_json("r.json")["metrics"]["numbers"]["skate"].get<double>(), 0.02);
  auto junit = read("j.xml");
  EXPECT_THAT(junit, HasSubstr("<testcase classname=\"judge\" name=\"skate &lt; 0.01\""));
  EXPECT_THAT(junit, HasSubstr("measured 0.02, limit 0.01"));
  EXPECT_THAT(junit, HasSubstr("failures=\"1\""));
  EXPECT_EQ(
      std::system(("python3 -c \"import xml.dom.minidom as m; m.parse('" + path("j.xml") + "')\"").c_str()),
      0);

  EXPECT_EQ(run({"run", "null.kg.json", "--report", "n.json"}).exit, 4);
  EXPECT_TRUE(read_json("n.json")["checks"][0]["value"].is_null());
}

TEST_F(Run, AnInvalidGraphExits3RunsNothingAndStillReports) {
  write("g.kg.json", graph(R"("walk": {"type": "Gait", "params": {"sped": 1}},
                             "out": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "wlk.motion"}})"));
  Ran ran = run({"run", "g.kg.json", "--report", "r.json", "--junit", "j.xml"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, HasSubstr("g.kg.json:"));
  EXPECT_THAT(ran.err, HasSubstr("\"speed\""));
  EXPECT_EQ(read_json("r.json")["exit"], 3);
  EXPECT_THAT(read("j.xml"), HasSubstr("<error"));
  EXPECT_FALSE(exists("walk.bvh"));
  EXPECT_EQ(run({"run", "none.kg.json", "--report", "n.json"}).exit, 3);
  EXPECT_EQ(read_json("n.json")["exit"], 3);
}

TEST_F(Run, AMissingNodeInATargetsWayExits3OtherTargetsRunWithKeepGoing) {
  write("g.kg.json", graph(R"("odd": {"type": "Telepathy", "inputs": {"motion": "walk.motion"}},
                             "walk": {"type": "Gait", "params": {"seconds": 1}},
                             "one": {"type": "Export", "params": {"file": "one.bvh"}, "inputs": {"motion": "odd.motion"}},
                             "two": {"type": "Export", "params": {"file": "two.bvh"}, "inputs": {"motion": "walk.motion"}})"));
  EXPECT_EQ(run({"run", "g.kg.json", "--target", "two"}).exit, 0);
  std::filesystem::remove(path("two.bvh"));
  Ran ran = run({"run", "g.kg.json", "--keep-going", "--report", "r.json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(read_json("r.json")["nodes"]["odd"]["state"], "missing");
  EXPECT_TRUE(exists("two.bvh"));
}

TEST_F(Run, RefusesToWriteOutsideTheOutFolder) {
  for (const std::string& file : {std::string("../escaped.bvh"), path("elsewhere/absolute.bvh")}) {
    write("in/g.kg.json", graph(R"("walk": {"type": "Gait", "params": {"seconds": 1}},
                                  "out": {"type": "Export", "params": {"file": ")" +
                                file + R"("}, "inputs": {"motion": "walk.motion"}})"));
    EXPECT_EQ(run({"run", "in/g.kg.json"}).exit, 3) << file;
    EXPECT_THAT(files(), ElementsAre("in", "in/g.kg.json")) << file;
  }
  EXPECT_EQ(run({"run", "in/g.kg.json", "--allow-outside"}).exit, 0);
  EXPECT_TRUE(exists("elsewhere/absolute.bvh"));
}

TEST_F(Run, APathGivenWithSetMayLieOutside) {
  write("in/g.kg.json", walk_and_export());
  Ran ran = run({"run", "in/g.kg.json", "--set", "out.file=" + path("mine.bvh")});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("mine.bvh"));
}

TEST_F(Run, ALinkThatLeadsOutIsRefused) {
  write("in/g.kg.json", walk_and_export());
  write("secret.txt", "untouched");
  std::filesystem::create_symlink(path("secret.txt"), path("in/walk.bvh"));
  EXPECT_EQ(run({"run", "in/g.kg.json"}).exit, 3);
  EXPECT_EQ(read("secret.txt"), "untouched");
}

TEST_F(Run, SandboxReadsOnlyBelowTheGraphAndWhatWasNamed) {
  write("metrics.json", metrics_file(0.02));
  write("in/g.kg.json", graph(R"("numbers": {"type": "Load", "params": {"file": "../metrics.json"}})",
                              R"("outputs": {"result": "numbers.metrics"})"));
  EXPECT_EQ(run({"run", "in/g.kg.json"}).exit, 0);
  EXPECT_EQ(run({"run", "in/g.kg.json", "--sandbox"}).exit, 1);
  EXPECT_EQ(run({"run", "in/g.kg.json", "--sandbox", "--assets", "."}).exit, 0);
  EXPECT_EQ(run({"run", "in/g.kg.json", "--sandbox", "--set", "numbers.file=metrics.json"}).exit, 0);
}

TEST_F(Run, WritingThatFailsExits5) {
  write("g.kg.json", walk_and_export());
  write("taken", "a file where a folder should be");
  EXPECT_EQ(run({"run", "g.kg.json", "--out", "taken"}).exit, 5);
  EXPECT_EQ(run({"run", "g.kg.json", "--report", "taken/r.json"}).exit, 5);
}

TEST_F(Run, TimesOutInsideALongNode) {
  write("g.kg.json", long_warp());
  Ran ran = run({"run", "g.kg.json", "--timeout", "0.3", "--report", "r.json"});
  EXPECT_EQ(ran.exit, 124);
  EXPECT_EQ(read_json("r.json")["exit"], 124);
  EXPECT_EQ(read_json("r.json")["nodes"]["warp"]["state"], "cancelled");
}

TEST_F(Run, SignalsStopItWithAReport) {
  write("g.kg.json", long_warp());
  for (int signal : {SIGINT, SIGTERM}) {
    auto running = start({"run", "g.kg.json", "--report", "r.json", "--progress", "json"});
    // The signal must find the long node at work.
    for (int i = 0; i < 500; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      std::error_code none;
      if (const auto size = std::filesystem::file_size(running.err, none); !none && size > 0) break;
    }
    kill(running.process, signal);
    Ran ran = wait(running);
    EXPECT_EQ(ran.exit, 128 + signal);
    EXPECT_EQ(read_json("r.json")["exit"], 128 + signal);
    std::filesystem::remove(path("r.json"));
  }
}

TEST_F(Run, UsesTheThreadsItMay) {
  write(
      "g.kg.json",
      graph(
          R"("a": {"type": "Gait", "params": {"seconds": 60}}, "b": {"type": "Gait", "params": {"seconds": 61}},
                             "c": {"type": "Gait", "params": {"seconds": 62}}, "d": {"type": "Gait", "params": {"seconds": 63}})",
          R"("outputs": {"a": "a.motion", "b": "b.motion", "c": "c.motion", "d": "d.motion"})"));
  ASSERT_EQ(run({"run", "g.kg.json", "--threads", "1", "--report", "one.json"}).exit, 0);
  ASSERT_EQ(run({"run", "g.kg.json", "--threads", "2", "--report", "two.json"}).exit, 0);
  EXPECT_EQ(read_json("one.json")["threads"], nlohmann::json({{"allowed", 1}, {"used", 1}}));
  EXPECT_EQ(read_json("two.json")["threads"], nlohmann::json({{"allowed", 2}, {"used", 2}}));
  EXPECT_EQ(read_json("one.json")["nodes"]["a"]["outputs"]["motion"]["key"],
            read_json("two.json")["nodes"]["a"]["outputs"]["motion"]["key"]);
}

TEST_F(Run, ProgressForProgramsIsAnObjectALine) {
  write("g.kg.json", walk_and_export());
  Ran ran = run({"run", "g.kg.json", "--progress", "json"});
  ASSERT_EQ(ran.exit, 0);
  std::istringstream lines(ran.err);
  bool done = false;
  for (std::string line; std::getline(lines, line);) {
    auto told = nlohmann::json::parse(line);
    EXPECT_TRUE(told.contains("node") && told.contains("state") && told.contains("progress")) << line;
    done = done || (told["node"] == "walk" && told["state"] == "done");
  }
  EXPECT_TRUE(done);
}

// The most that a bar told of the whole run, in percent; -1 where none was drawn.
int most_told(const std::string& messages) {
  const std::regex share(R"( ([ 0-9]{3}) %  [0-9.]+ s )");
  int most = -1;
  for (std::sregex_iterator at(messages.begin(), messages.end(), share), end; at != end; ++at)
    most = std::max(most, std::stoi((*at)[1]));
  return most;
}

TEST_F(Run, TheBarOfARunThatIsStoppedStaysWhereItCameTo) {
  write("g.kg.json", long_warp());
  Ran late = run({"run", "g.kg.json", "--timeout", "0.6", "--progress", "bar"});
  EXPECT_EQ(late.exit, 124);
  EXPECT_LT(most_told(late.err), 100);

  auto running = start({"run", "g.kg.json", "--progress", "bar"});
  int seen = -1;
  for (int i = 0; i < 3000 && seen < 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::ifstream told(running.err);
    seen = most_told({std::istreambuf_iterator<char>(told), {}});
  }
  EXPECT_GE(seen, 0);
  kill(running.process, SIGINT);
  Ran stopped = wait(running);
  EXPECT_EQ(stopped.exit, 130);
  EXPECT_LT(most_told(stopped.err), 100);
}

TEST_F(Run, NoColoursAndNoBarIntoAPipe) {
  write("g.kg.json", walk_and_export());
  Ran ran = run({"run", "g.kg.json"});
  EXPECT_THAT(ran.out + ran.err, Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace kinegraph
