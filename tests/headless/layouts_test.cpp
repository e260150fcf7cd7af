// The same graph where a studio keeps clips and pipelines in other folders: the same cache entries, the same
// bytes. And a job of CI whose motion was made worse.
#include <cstdlib>
#include <fstream>

#include "program.h"
#include "tests/mocap.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Layouts : public ProgramTest {
 protected:
  // The graph below `graphs`, what it nests below `lib`, clips below `clips`; `up`: from graphs to the
  // others.
  void lay_out(const std::string& graphs, const std::string& lib, const std::string& clips,
               const std::string& clip, const std::string& up) {
    fs::create_directories(path(clips));
    for (const char* name : {"cmu/asfamc/17.asf", "cmu/asfamc/17_03.amc"})
      fs::copy(mocap(name), path(clips), fs::copy_options::overwrite_existing);
    fs::copy(source_folder() + "/graphs/clips/sneak.bvh", path(clips + "/" + clip));
    for (const char* name : {"restyle", "clean_feet"}) {
      fs::create_directories(path(lib));
      fs::copy(source_folder() + "/graphs/pipelines/" + std::string(name) + ".kg.json", path(lib));
    }
    write(graphs + "/main.kg.json", graph(R"("walk": {"type": "Load", "params": {"file": ")" + up + clips +
                                          R"(/17_03.amc", "range": [0, 240]}},
      "sneak": {"type": "Load", "params": {"file": ")" +
                                          up + clips + "/" + clip + R"("}},
      "restyle": {"type": "Graph", "params": {"file": ")" +
                                          up + lib + R"(/restyle.kg.json", "amount": 0.5},
                  "inputs": {"motion": "walk.motion", "style": "sneak.motion"}},
      "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "restyle.motion"}},
      "glb": {"type": "Export", "params": {"file": "o.glb"}, "inputs": {"motion": "restyle.motion"}})"));
  }
};

TEST_F(Layouts, HitTheSameEntriesAndWriteTheSameBytes) {
  KINEGRAPH_NEEDS_MOCAP();
  lay_out("here", "pipelines", "clips", "sneak.bvh", "../");
  lay_out("deep/in/a/project", "studio/lib", "store/2026", "renamed.bvh", "../../../../");
  Ran first = run({"run", "here/main.kg.json", "--out", "a", "--cache", "cache", "--report", "a.json"});
  ASSERT_EQ(first.exit, 0) << first.err;
  Ran second =
      run({"run", "deep/in/a/project/main.kg.json", "--out", "b", "--cache", "cache", "--report", "b.json"});
  ASSERT_EQ(second.exit, 0) << second.err;
  EXPECT_EQ(read("a/o.bvh"), read("b/o.bvh"));
  EXPECT_EQ(read("a/o.glb"), read("b/o.glb"));
  const auto a = read_json("a.json"), b = read_json("b.json");
  int hits = 0;
  for (const auto& [name, node] : b["nodes"].items())
    for (const auto& [port, output] : node["outputs"].items()) {
      EXPECT_EQ(output["cached"], "disk") << name << "." << port;
      EXPECT_EQ(output["key"], a["nodes"][name]["outputs"][port]["key"]) << name << "." << port;
      ++hits;
    }
  EXPECT_GT(hits, 0);
}

class Ci : public ProgramTest {
 protected:
  // A repository's clip is cleaned and held to the numbers that were written when it was last looked at.
  void SetUp() override {
    make_clip(R"("walk": {"type": "Gait", "params": {"seconds": 2}})", "walk");
    const std::string measured = R"("clip": {"type": "Load", "params": {"file": "clip.bvh"}},
      "measures": {"type": "Metrics", "inputs": {"motion": "clip.motion"}},)";
    write("baseline.kg.json",
          graph(measured + R"("out": {"type": "Export", "params": {"file": "baseline.json"},
      "inputs": {"metrics": "measures.metrics"}})"));
    ASSERT_EQ(run({"run", "baseline.kg.json"}).exit, 0);
    write("ci.kg.json", graph(measured + R"("baseline": {"type": "Load", "params": {"file": "baseline.json"}},
      "check": {"type": "Check", "inputs": {"metrics": "measures.metrics", "baseline": "baseline.metrics"},
                "params": {"rules": ["skate <= 1.05 * baseline.skate", "jerk <= 1.5 * baseline.jerk"]}})"));
  }
  void make_clip(const std::string& nodes, const std::string& last) {
    write("make.kg.json",
          graph(nodes +
                R"(, "out": {"type": "Export", "params": {"file": "clip.bvh"}, "inputs": {"motion": ")" +
                last + R"(.motion"}})"));
    ASSERT_EQ(run({"run", "make.kg.json"}).exit, 0);
  }
  Ran job() {
    return run({"run", "ci.kg.json", "--out", "out", "--sandbox", "--keep-going", "--report",
                "out/report.json", "--junit", "out/junit.xml", "--html", "out/report.html"});
  }
};

TEST_F(Ci, AMotionThatIsAsItWasPasses) {
  const Ran ran = job();
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(read("out/junit.xml"), HasSubstr("failures=\"0\""));
}

TEST_F(Ci, AMotionMadeWorseFailsWithItsRuleValueAndLimit) {
  // Another gait laid half over the walk: its feet slide.
  make_clip(R"("walk": {"type": "Gait", "params": {"seconds": 2}},
    "run": {"type": "Gait", "params": {"seconds": 2, "gait": "sneak"}},
    "slides": {"type": "Blend", "params": {"weight": 0.5}, "inputs": {"motion": "walk.motion", "other": "run.motion"}})",
            "slides");
  const Ran ran = job();
  EXPECT_EQ(ran.exit, 4) << ran.err;
  const auto check = read_json("out/report.json")["checks"][0];
  EXPECT_EQ(check["passed"], false);
  EXPECT_GT(check["value"].get<double>(), check["limit"].get<double>());
  const std::string junit = read("out/junit.xml");
  EXPECT_THAT(junit, HasSubstr("<testcase classname=\"check\" name=\"skate &lt;= 1.05 * baseline.skate\""));
  EXPECT_THAT(
      junit,
      testing::ContainsRegex(
          "<failure message=\"skate &lt;= 1.05 \\* baseline.skate: measured [0-9.e-]+, limit [0-9.e-]+\">"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("skate <= 1.05 * baseline.skate"));
}

// Every line of docs/ci.yml that calls kinegraph, in a repository as it is meant for.
TEST_F(Ci, TheExampleWorkflowDoesWhatItSays) {
  fs::copy(source_folder() + "/graphs", path("graphs"), fs::copy_options::recursive);
  std::ifstream workflow(source_folder() + "/docs/ci.yml");
  int commands = 0;
  for (std::string line, command; std::getline(workflow, line);) {
    const auto begin = line.find("kinegraph ");
    const bool starts = begin != std::string::npos &&
                        (line.find_first_not_of(' ') == begin || line.find("run: ") + 5 == begin);
    if (command.empty() && !starts) continue;
    command += starts ? line.substr(begin) : line;
    if (command.ends_with("\\")) {
      command.pop_back();
      continue;
    }
    const std::string whole =
        "cd '" + path("") + "' && PATH='" + bin_folder() + ":'\"$PATH\" sh -c '" + command + "' >ci.log 2>&1";
    EXPECT_EQ(std::system(whole.c_str()), 0) << command << "\n" << read("ci.log");
    ++commands;
    command.clear();
  }
  EXPECT_EQ(commands, 4);
  for (const char* file : {"report.json", "junit.xml", "report.html", "walk_made_sneaky.bvh"})
    EXPECT_TRUE(exists(std::string("out/") + file)) << file;
}

TEST_F(Ci, CompareByARuleFailsLikewise) {
  fs::copy(path("clip.bvh"), path("old.bvh"));
  make_clip(R"("walk": {"type": "Gait", "params": {"seconds": 2, "seed": 5}})", "walk");
  EXPECT_EQ(run({"compare", "old.bvh", "old.bvh", "--rule", "difference.position_max < 0.001"}).exit, 0);
  const Ran ran = run({"compare", "old.bvh", "clip.bvh", "--rule", "difference.position_max < 0.001"});
  EXPECT_EQ(ran.exit, 4);
  EXPECT_THAT(ran.out + ran.err, HasSubstr("difference.position_max < 0.001"));
}

}  // namespace
}  // namespace kinegraph
