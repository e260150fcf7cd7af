// The same keys and the same bytes, however a graph is run: cold, warm from the disk, warm from memory, with
// one thread or several, from another folder, with its nodes renamed. And what one parameter changes.
#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "program.h"
#include "tests/mocap.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// What a report tells of a run.
struct Told {
  std::map<std::string, std::string> keys;    // "node.port"
  std::map<std::string, std::string> cached;  // likewise
  std::map<std::string, std::string> files;   // node -> SHA-256
  int threads = 0;
};

bool writes_alone(const fs::path& graph) {
  std::ifstream file(graph);
  bool writes = false;
  const json report = json::parse(file);
  for (const auto& node : report["nodes"]) {
    writes = writes || node["type"] == "Export";
    if (node["type"] == "Graph") return false;
  }
  return writes;
}

class Sameness : public ProgramTest {
 protected:
  Told told(const std::string& graph, std::vector<std::string> options = {}) {
    std::vector<std::string> words{"run", graph, "--report", "r.json", "--progress", "none"};
    if (std::find(options.begin(), options.end(), "--out") == options.end())
      options.insert(options.end(), {"--out", "out"});
    words.insert(words.end(), options.begin(), options.end());
    if (auto clips = mocap(); !clips.empty()) words.insert(words.end(), {"--var", "mocap=" + clips});
    Ran ran = run(words);
    EXPECT_TRUE(ran.exit == 0 || ran.exit == 4) << graph << ": " << ran.err;  // a failed Check is a result
    Told result;
    json report = read_json("r.json");
    for (const auto& [name, node] : report["nodes"].items())
      for (const auto& [port, output] : node["outputs"].items()) {
        result.keys[name + "." + port] = output["key"];
        result.cached[name + "." + port] = output["cached"];
      }
    for (const auto& file : report["files"]) result.files[file["node"]] = file["sha256"];
    result.threads = report["threads"]["used"];
    return result;
  }

  // Graphs that write files as they stand, under path("graphs"), with the clips they read beside them. One
  // that uses other graphs has keys of inner nodes too, which keep their names when the outer ones are
  // renamed: nested_test covers it.
  std::vector<std::string> graphs() {
    fs::copy(source_folder() + "/graphs", path("graphs"), fs::copy_options::recursive);
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(path("graphs")))
      if (entry.path().string().ends_with(".kg.json") && writes_alone(entry.path()))
        all.push_back("graphs/" + entry.path().filename().string());
    if (fs::exists(mocap("README.md")))
      for (const auto& entry : fs::directory_iterator(source_folder() + "/tests/main_job"))
        if (entry.path().string().ends_with(".kg.json")) {
          fs::copy(entry.path(), path("graphs"));
          all.push_back("graphs/" + entry.path().filename().string());
        }
    std::sort(all.begin(), all.end());
    return all;
  }
};

using Rename = std::function<std::string(const std::string&)>;

// The nodes of a graph under other names, with their links.
json renamed_nodes(const json& nodes, const Rename& rename) {
  auto relinked = [&](const json& link) {
    auto text = link.get<std::string>();
    auto dot = text.find('.');
    return json(rename(text.substr(0, dot)) + text.substr(dot));
  };
  json result = json::object();
  for (const auto& [name, node] : nodes.items()) {
    json copy = node;
    if (copy.contains("inputs"))
      for (auto& [port, link] : copy["inputs"].items()) {
        if (link.is_array())
          for (auto& one : link) one = relinked(one);
        else
          link = relinked(link);
      }
    result[rename(name)] = copy;
  }
  return result;
}

// Alike where both were told: a warm run doesn't ask for what only a cold one needs.
void expect_alike(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b,
                  const std::string& what) {
  std::size_t common = 0;
  for (const auto& [name, value] : a)
    if (auto found = b.find(name); found != b.end()) {
      EXPECT_EQ(value, found->second) << what << ": " << name;
      ++common;
    }
  EXPECT_EQ(common, std::min(a.size(), b.size())) << what;
}

TEST_F(Sameness, ColdWarmAndOnAnyNumberOfThreads) {
  int most_threads = 0;
  for (const auto& graph : graphs()) {
    SCOPED_TRACE(graph);
    Told cold = told(graph, {"--threads", "1"});
    ASSERT_FALSE(cold.keys.empty());
    ASSERT_FALSE(cold.files.empty());
    EXPECT_EQ(cold.threads, 1);
    Told many = told(graph, {"--threads", "4"});
    EXPECT_EQ(many.keys, cold.keys);
    EXPECT_EQ(many.files, cold.files);
    most_threads = std::max(most_threads, many.threads);

    Told filling = told(graph, {"--cache", "cache"});
    Told warm = told(graph, {"--cache", "cache"});
    EXPECT_EQ(filling.files, cold.files);
    EXPECT_EQ(warm.files, cold.files);
    expect_alike(warm.keys, cold.keys, "warm from disk");
    for (const auto& [output, from] : warm.cached) EXPECT_EQ(from, "disk") << output;
  }
  EXPECT_GT(most_threads, 1);
}

TEST_F(Sameness, InAnotherFolderAndWithNodesRenamed) {
  auto all = graphs();
  fs::create_directories(path("far"));
  fs::copy(path("graphs"), path("far/away"), fs::copy_options::recursive);
  // Names that sort the other way round, so that nothing can hang on their order.
  Rename other = [](const std::string& name) {
    std::string turned = "n";
    for (char c : name) turned += c >= 'a' && c <= 'z' ? static_cast<char>('a' + 'z' - c) : c;
    return turned;
  };
  for (const auto& graph : all) {
    SCOPED_TRACE(graph);
    Told here = told(graph);
    Told there = told("far/away/" + fs::path(graph).filename().string());
    EXPECT_EQ(there.keys, here.keys);
    EXPECT_EQ(there.files, here.files);

    json text = read_json(graph);
    text["nodes"] = renamed_nodes(text["nodes"], other);
    text.erase("publish");
    text.erase("ui");
    write("graphs/renamed.kg.json", text.dump());
    Told renamed = told("graphs/renamed.kg.json");
    std::map<std::string, std::string> keys, files;
    for (const auto& [output, key] : here.keys)
      keys[other(output.substr(0, output.find('.'))) + output.substr(output.find('.'))] = key;
    for (const auto& [node, digest] : here.files) files[other(node)] = digest;
    EXPECT_EQ(renamed.keys, keys);
    EXPECT_EQ(renamed.files, files);
  }
}

// Every node stands twice in one graph: the second of each pair comes from memory.
TEST_F(Sameness, WarmFromMemory) {
  for (const auto& graph : graphs()) {
    SCOPED_TRACE(graph);
    json text = read_json(graph);
    json twins = renamed_nodes(text["nodes"], [](const std::string& name) { return name + "_twin"; });
    for (auto& [name, twin] : twins.items())
      if (twin["type"] == "Export")
        twin["params"]["file"] = "twin/" + twin["params"]["file"].get<std::string>();
    text["nodes"].update(twins);
    write("graphs/twins.kg.json", text.dump());
    Told both = told("graphs/twins.kg.json", {"--threads", "1"});
    std::size_t pairs = 0;
    for (const auto& [output, key] : both.keys) {
      auto dot = output.find('.');
      if (output.substr(0, dot).ends_with("_twin")) continue;
      auto twin = output.substr(0, dot) + "_twin" + output.substr(dot);
      ASSERT_TRUE(both.keys.contains(twin)) << twin;
      EXPECT_EQ(both.keys[twin], key) << output;
      EXPECT_NE(both.cached[output] == "memory", both.cached[twin] == "memory") << output;
      ++pairs;
    }
    EXPECT_GT(pairs, 0u);
    for (const auto& [node, digest] : both.files)
      if (!node.ends_with("_twin")) {
        EXPECT_EQ(both.files[node + "_twin"], digest) << node;
      }
  }
}

TEST_F(Sameness, OneParameterRecomputesOnlyWhatDependsOnIt) {
  graphs();
  const std::string graph = "graphs/style_transfer.kg.json";
  Told before = told(graph, {"--cache", "cache"});
  Told after = told(graph, {"--cache", "cache", "--set", "feet.stretch=0.021"});
  std::set<std::string> computed;
  for (const auto& [output, from] : after.cached) {
    auto node = output.substr(0, output.find('.'));
    if (from == "no") computed.insert(node);
    EXPECT_EQ(from == "no", after.keys[output] != before.keys[output]) << output;
  }
  EXPECT_EQ(computed, (std::set<std::string>{"after", "feet"}));
}

}  // namespace
}  // namespace kinegraph
