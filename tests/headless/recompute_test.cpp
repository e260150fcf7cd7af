// The example graphs after one parameter changed: what depends on it is computed anew, all else comes from
// the cache.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "program.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

const std::string graphs = source_folder() + "/graphs/";

// A parameter of each type of node, and a value that no example gives it.
const std::map<std::string, std::string> changes{
    {"Blend", "weight=0.35"},
    {"Burst", "speed=5"},
    {"CartoonFilter", "strength=1.7"},
    {"ComponentEdit", "lowpass=5"},
    {"ComponentMotion", "segment=1"},
    {"Concatenate", "blend=0.15"},
    {"DetectContacts", "height=0.05"},
    {"Exaggerate", "omega=3.3"},
    {"Footskate", "stretch=0.04"},
    {"Gait", "lean=0.1"},
    {"Graph", "amount=0.7"},
    {"ICA", "seed=7"},
    {"Load", "unit=0.011"},
    {"MarkerMesh", "rest_frame=1"},
    {"Pin", "fade=0.2"},
    {"QuatStats", "mean=slerp"},
    {"Retarget", "scale=0.9"},
    {"RubberJoints", "link=500"},
    {"Segment", "sensitivity=1.1"},
    {"StyleTransfer", "max_gain=3"},
    {"TimeWarp", "offset_smoothness=80"},
};

// Where a node of an example lacks its type's, or breaks by it: a mask and markers of other sizes don't fit.
const std::map<std::string, std::string> changes_of_nodes{
    {"rubber.Graph", "omega=1.8"}, {"jaw.Load", "unit=1.001"}, {"mask.Load", "unit=1.001"}};

// What keeps an example's runs short.
std::vector<std::string> shortened(const std::string& file) {
  return file == "explosion.kg.json" ? std::vector<std::string>{"--set", "burst.particles=40"}
                                     : std::vector<std::string>{};
}

std::vector<std::string> every_example() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(graphs))
    if (const auto name = entry.path().filename().string(); name.ends_with(".kg.json")) files.push_back(name);
  std::sort(files.begin(), files.end());
  return files;
}

nlohmann::json example(const std::string& file) {
  return nlohmann::json::parse(std::ifstream(graphs + file));
}

const nlohmann::json& member(const nlohmann::json& object, const char* name) {
  static const auto none = nlohmann::json::object();
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

// The nodes that each node has links from.
std::map<std::string, Names> links_of(const nlohmann::json& document) {
  std::map<std::string, Names> from;
  for (const auto& [name, node] : document["nodes"].items()) {
    from[name];
    for (const auto& [port, links] : member(node, "inputs").items()) {
      const auto list = links.is_array() ? links : nlohmann::json::array({links});
      for (const auto& link : list) {
        const auto text = link.get<std::string>();
        from[name].insert(text.substr(0, text.find('.')));
      }
    }
  }
  return from;
}

Names downstream_of(const std::string& start, const std::map<std::string, Names>& from) {
  Names reached{start};
  for (std::size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (const auto& [name, sources] : from)
      for (const auto& source : sources)
        if (reached.contains(source)) reached.insert(name);
  }
  return reached;
}

// For each node of the file that gave outputs: where they came from. What stands inside a Graph counts as its
// own.
std::map<std::string, Names> sources_of_outputs(const nlohmann::json& report) {
  std::map<std::string, Names> came_from;
  for (const auto& [name, node] : report["nodes"].items())
    for (const auto& [port, output] : member(node, "outputs").items())
      came_from[name.substr(0, name.find('/'))].insert(output["cached"].get<std::string>());
  return came_from;
}

Names computed(const std::map<std::string, Names>& came_from) {
  Names names;
  for (const auto& [name, words] : came_from)
    if (words.contains("no")) names.insert(name);
  return names;
}

class Recompute : public ProgramTest, public testing::WithParamInterface<std::string> {
 protected:
  std::map<std::string, Names> run_with(const std::vector<std::string>& set) {
    std::vector<std::string> words{
        "run",    graphs + GetParam(), "--out", path("out"), "--cache", "cache", "--report",
        "r.json", "--progress",        "none",  "--threads", "1"};
    for (const auto& more : {shortened(GetParam()), set}) words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words);
    EXPECT_THAT(ran.exit, testing::AnyOf(0, 4))
        << testing::PrintToString(set) << ran.err;  // 4: a Check of it
    return sources_of_outputs(read_json("r.json"));
  }
};

TEST_P(Recompute, OnlyWhatDependsOnTheChangedParameter) {
  const auto document = example(GetParam());
  const auto from = links_of(document);

  const auto cold = run_with({});
  ASSERT_THAT(cold, Not(IsEmpty()));
  for (const auto& [name, words] : cold) EXPECT_THAT(words, ElementsAre("no")) << name;
  EXPECT_THAT(computed(run_with({})), IsEmpty()) << "nothing changed";

  // Each change finds what the cold run left, not what changes before it left.
  fs::rename(path("cache"), path("cold"));
  int changed = 0;
  for (const auto& [name, was] : cold) {
    const auto type = document["nodes"][name]["type"].get<std::string>();
    const auto own = changes_of_nodes.find(name + "." + type), usual = changes.find(type);
    if (usual == changes.end()) continue;
    const std::string set = name + "." + (own == changes_of_nodes.end() ? usual : own)->second;
    fs::remove_all(path("cache"));
    fs::copy(path("cold"), path("cache"), fs::copy_options::recursive);
    const auto warm = run_with({"--set", set});
    ++changed;

    Names expected;
    for (const auto& reached : downstream_of(name, from))
      if (cold.contains(reached)) expected.insert(reached);
    EXPECT_EQ(computed(warm), expected) << set;
    // What they are computed from was not left out of the run: it was found. Inside a Graph that may lie at
    // nodes of its own.
    for (const auto& one : expected)
      if (document["nodes"][one]["type"] != "Graph")
        for (const auto& source : from.at(one))
          if (!expected.contains(source) && cold.contains(source)) {
            EXPECT_TRUE(warm.contains(source)) << set << ": " << source << " for " << one;
          }
  }
  EXPECT_GT(changed, 0);
}

INSTANTIATE_TEST_SUITE_P(Examples, Recompute, testing::ValuesIn(every_example()),
                         [](const auto& file) { return file.param.substr(0, file.param.find('.')); });

class RecomputeTable : public ProgramTest {};

// The others have nothing but names, rules and keys to change.
TEST_F(RecomputeTable, HasEveryTypeOfTheExamplesWithANumberOrChoice) {
  const auto reference = nlohmann::json::parse(run({"nodes", "--json"}).out)["nodes"];
  Names missing;
  for (const auto& file : every_example()) {
    const auto document = example(file);
    for (const auto& node : document["nodes"]) {
      const auto type = node["type"].get<std::string>();
      if (!reference[type].contains("outputs") || changes.contains(type)) continue;
      for (const auto& param : member(reference[type], "params"))
        if (const auto kind = param["kind"].get<std::string>();
            kind == "number" || kind == "integer" || kind == "choice" || kind == "boolean")
          missing.insert(type + "." + param["name"].get<std::string>());
    }
  }
  EXPECT_THAT(missing, IsEmpty());
}

}  // namespace
}  // namespace kinegraph
