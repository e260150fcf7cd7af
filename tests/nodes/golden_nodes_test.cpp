// Old files give the same results, and old cache entries are right.
//
// tests/nodes/golden/nodes/TYPE.VERSION.WHAT.kg.json is a graph around one node, "it", as the program of that
// version saved it. Together the files of a version move every parameter of the type away from its default,
// and stay when the type's version is raised: then each opens, is migrated, is saved as
// TYPE.VERSION.WHAT.upgraded.kg.json says, and gives the bits that it gave. Those are in
// tests/nodes/golden/digests.json beside the code versions under which they came out: other bits need another
// code version. See golden_files.h for writing new ones.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "graph/compute.h"
#include "graph/evaluate/evaluator.h"
#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/validate.h"
#include "nodes/all_nodes.h"
#include "nodes/motion/resample.h"
#include "tests/nodes/golden_files.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

const std::string nodes_folder = golden::folder + "nodes";

struct Fixture {
  std::string name;  // "Trim.1.all"
  std::string type;
  int version = 0;
  std::string text() const { return golden::text("nodes/" + name + ".kg.json"); }
};

std::vector<Fixture> fixtures() {
  const std::string ending = ".kg.json";
  std::vector<Fixture> all;
  for (const auto& entry : fs::directory_iterator(nodes_folder)) {
    std::string name = entry.path().filename().string();
    if (!name.ends_with(ending)) continue;
    name.resize(name.size() - ending.size());
    if (name.ends_with(".upgraded")) continue;
    const std::size_t dot = name.find('.');
    all.push_back({name, name.substr(0, dot), std::atoi(name.c_str() + dot + 1)});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return all;
}

// Export's bytes and Check's verdicts count like outputs: keys stand for them when a batch is resumed.
bool has_results(const NodeType& type) {
  return type.role == Role::compute;
}

Document opened(const std::string& name, const std::string& text, const Registry& registry) {
  ReadResult read = read_document(text, name, registry);
  for (Diagnostic& problem :
       validate(read.document, registry, {.file = name, .folder = nodes_folder, .allow_outside = false}))
    read.problems.push_back(std::move(problem));
  for (const Diagnostic& problem : read.problems)
    if (problem.code != "old-version") ADD_FAILURE() << to_text(problem);
  return std::move(read.document);
}

// Of all that comes out of "it" (of its published outputs where it publishes some), or "fails: " and why.
std::string digest_of(const Document& document, const Registry& registry) {
  const fs::path out = fs::temp_directory_path() / ("kinegraph_golden_" + std::to_string(::getpid()));
  Diagnostics problems;
  const Plan plan = make_plan(document, registry, {.folder = nodes_folder, .out = out.string()}, problems);
  std::vector<std::string> ports;
  for (const auto& [name, source] : plan.published) ports.push_back(source.port);
  if (ports.empty())
    for (const OutputPort& port : registry.find(document.nodes.at("it").type)->outputs)
      ports.push_back(port.name);
  std::vector<Target> targets;
  if (plan.published.empty())
    targets.push_back({"it", ""});
  else
    for (const std::string& port : ports) targets.push_back({"it", port});
  FileStore files;
  MemoryCache memory(1u << 30);
  Evaluator evaluator(registry, files, &memory, nullptr);
  const RunLog log = evaluator.run(plan, targets, {.threads = 1, .out = out.string()});
  fs::remove_all(out);
  const NodeRun& run = log.nodes.at("it");
  if (run.state != NodeState::done)
    return "fails: " + (run.diagnostics.empty() ? name_of(run.state) : to_text(run.diagnostics.front()));
  KeyMaker maker;
  for (const std::string& port : ports) {
    const ValuePtr value = evaluator.value(plan, "it", port);
    Encoder encoder;
    if (value) value->encode(encoder);
    maker.add(port, encoder.take());
  }
  for (const WrittenFile& file : log.files) maker.add(fs::path(file.path).filename().string(), file.content);
  for (const RuleRun& rule : log.rules) {
    Encoder encoder;
    encoder.f64(rule.value);
    encoder.f64(rule.limit);
    maker.add(rule.rule + (rule.passed ? " passed" : " failed"), encoder.take());
  }
  return to_text(maker.finish());
}

Json code_versions_in(const Document& document, const Registry& registry) {
  Json::Object all;
  for (const auto& [name, node] : document.nodes)
    if (const NodeType* type = registry.find(node.type)) all[node.type] = type->code_version;
  return Json(std::move(all));
}

TEST(Golden, EveryVersionOfEveryTypeHasFilesThatMoveAllItsParameters) {
  const Registry registry = all_nodes();
  std::map<std::pair<std::string, int>, std::set<std::string>> moved;
  for (const Fixture& fixture : fixtures()) {
    const NodeType* type = registry.find(fixture.type);
    ASSERT_TRUE(type) << fixture.name << ": " << fixture.type
                      << " is gone: graphs that use it can't run any more";
    ASSERT_TRUE(fixture.version >= 1 && fixture.version <= type->version) << fixture.name;
    std::set<std::string>& params = moved[{fixture.type, fixture.version}];
    const ReadResult read = read_document(fixture.text(), fixture.name, registry, false);
    ASSERT_TRUE(read.document.nodes.contains("it")) << fixture.name;
    const Node& it = read.document.nodes.at("it");
    EXPECT_EQ(it.type, fixture.type) << fixture.name;
    EXPECT_EQ(it.version, fixture.version) << fixture.name;
    for (const auto& [param, value] : it.params) params.insert(param);
  }
  for (const std::string& name : registry.names()) {
    const NodeType& type = *registry.find(name);
    if (!has_results(type)) continue;
    for (int version = 1; version <= type.version; ++version)
      EXPECT_TRUE((moved.contains({name, version})))
          << "tests/nodes/golden/nodes has no " << name << "." << version << ".all.kg.json";
    for (const Param& param : type.params)
      EXPECT_TRUE((moved[{name, type.version}].contains(param.name)))
          << "no " << name << "." << type.version << ".*.kg.json gives " << param.name << " another value";
  }
}

TEST(Golden, OpenAreSavedAsTheyStandOrUpgradedAndGiveTheBitsTheyGave) {
  const Registry registry = all_nodes();
  const Json before = golden::json("digests.json");
  Json::Object now;
  for (const Fixture& fixture : fixtures()) {
    const NodeType* type = registry.find(fixture.type);
    if (!type) continue;
    const std::string text = fixture.text();
    const Document document = opened(fixture.name, text, registry);
    const bool current = fixture.version == type->version;
    const std::string upgraded = "nodes/" + fixture.name + ".upgraded.kg.json";
    const std::string saved = write_document(document, registry);
    if (!current && golden::updating() && !fs::exists(golden::folder + upgraded))
      golden::write(upgraded, saved);
    EXPECT_EQ(saved, current ? text : golden::text(upgraded)) << fixture.name;

    const std::string digest = digest_of(document, registry);
    if (digest.find("no-fbx") != digest.npos) {  // built without Assimp: what was remembered stays
      now[fixture.name] = *before.find(fixture.name);
      continue;
    }
    EXPECT_FALSE(digest.starts_with("fails")) << fixture.name << " " << digest;
    const Json code_versions = code_versions_in(document, registry);
    now[fixture.name] = Json::Object{{"code_versions", code_versions}, {"digest", digest}};
    const Json* was = before.find(fixture.name);
    if (!was) {
      if (!golden::updating()) ADD_FAILURE() << fixture.name << " has no digest: update";
      continue;
    }
    const bool same_bits = *was->find("digest") == Json(digest);
    const bool same_code = *was->find("code_versions") == code_versions;
    if (!same_bits && same_code) {
      ADD_FAILURE() << fixture.name << " gives other bits for the same parameters: raise the code_version of "
                    << fixture.type << ", or of the node before it that changed, then update";
      now[fixture.name] = *was;
    } else if (!same_code && !golden::updating()) {
      ADD_FAILURE() << fixture.name << " has nodes of other code versions: update";
    }
  }
  for (const auto& [name, was] : before.object())
    if (!now.contains(name)) {
      ADD_FAILURE() << "tests/nodes/golden/nodes/" << name << ".kg.json is gone: files of old versions stay";
      now[name] = was;
    }
  if (golden::updating()) golden::write("digests.json", indented(Json(std::move(now))) + "\n");
}

// A new code version that changes no file's bits throws everybody's caches away for nothing, or no file shows
// the change. Told by all files of a type together.
TEST(Golden, FilesOfATypeDontAllGiveWhatTheyAreGiven) {
  const Registry registry = all_nodes();
  std::map<std::string, std::set<std::string>> digests;
  const Json known = golden::json("digests.json");
  for (const auto& [name, entry] : known.object())
    digests[name.substr(0, name.find('.'))].insert(entry.find("digest")->string());
  const Document walk =
      opened("walk", R"({"format": "kinegraph", "schema": 1, "nodes": {"it": {"type": "Gait",
    "params": {"fps": 60, "seconds": 1.2, "seed": 3}}}})",
             registry);
  const std::string given = digest_of(walk, registry);
  for (const auto& [type, all] : digests)
    EXPECT_FALSE(all.size() == 1 && all.contains(given)) << type << " only passes its input on";
}

// The registry that a later program might have: real types whose parameters, defaults and ports have changed.
Registry aged() {
  const Registry today = all_nodes();
  Registry later;
  for (const std::string& name : today.value_names()) later.add(*today.find_value(name));
  for (const std::string& name : today.names()) {
    NodeType type = *today.find(name);
    const auto param = [&](std::string_view wanted) {
      return std::find_if(type.params.begin(), type.params.end(),
                          [&](const Param& p) { return p.name == wanted; });
    };
    if (name == "Filter") {  // another default
      param("cutoff")->fallback = Json(8);
      type.migrations = {{1, [](Json::Object& params, Json::Object&) { params.try_emplace("cutoff", 6); }}};
    } else if (name == "Resample") {  // a new name; then what it is counted in, and an input's name
      Param& rate = *param("fps");
      rate.name = "milliseconds";
      rate.fallback = Json(1000.0 / 120);
      type.inputs[0].name = "clip";
      type.outputs[0].passes = "clip";
      type.migrations = {{1,
                          [](Json::Object& params, Json::Object&) {
                            if (auto fps = params.extract("fps")) {
                              fps.key() = "rate";
                              params.insert(std::move(fps));
                            }
                          }},
                         {2, [](Json::Object& params, Json::Object& inputs) {
                            const auto given = params.extract("rate");
                            params["milliseconds"] = 1000 / (given ? given.mapped().number() : 120);
                            if (auto link = inputs.extract("motion")) {
                              link.key() = "clip";
                              inputs.insert(std::move(link));
                            }
                          }}};
      type.compute = [](Compute& compute) {
        compute.output("motion", resampled(compute.input<Motion>("clip"),
                                           1000 / compute.params().number("milliseconds"), compute.work()));
      };
    } else {
      later.add(std::move(type));
      continue;
    }
    type.version = static_cast<int>(type.migrations.size()) + 1;
    later.add(std::move(type));
  }
  return later;
}

TEST(Golden, ALaterProgramOpensTodaysFilesUpgradesThemAndGivesTheSameResults) {
  const Registry today = all_nodes(), later = aged();
  const std::string old = golden::text("aged/today.kg.json");
  const ReadResult read = read_document(old, "today.kg.json", later);
  EXPECT_TRUE(read.migrated);
  EXPECT_FALSE(has_error(read.problems));
  EXPECT_EQ(std::count_if(read.problems.begin(), read.problems.end(),
                          [](const Diagnostic& problem) { return problem.code == "old-version"; }),
            3);
  const std::string upgraded = write_document(read.document, later);
  EXPECT_EQ(upgraded, golden::text("aged/later.kg.json"));
  EXPECT_EQ(write_document(read_document(upgraded, "later.kg.json", later).document, later), upgraded);
  EXPECT_FALSE(read_document(upgraded, "later.kg.json", later).migrated);
  // fmt never migrates.
  EXPECT_EQ(write_document(read_document(old, "today.kg.json", later, false).document, later), old);
  EXPECT_EQ(digest_of(opened("later", upgraded, later), later),
            digest_of(opened("today", old, today), today));
  // And today's program keeps what the later one saved, digit for digit, without running it.
  const ReadResult newer = read_document(upgraded, "later.kg.json", today);
  EXPECT_FALSE(has_error(newer.problems));
  EXPECT_EQ(write_document(newer.document, today), upgraded);
}

}  // namespace
}  // namespace kinegraph
