// Old graphs give the same results, and old cache entries are right: a default that changes must raise its
// type's version (and bring a migration), results that change must raise its code version. What stood when
// this was last looked at is in tests/nodes/golden/; after a deliberate change
//   KINEGRAPH_UPDATE_GOLDEN=1 build/release/bin/test_nodes --gtest_filter='Golden.*'
// writes it anew. Types that aren't in it yet are let be, so that a new node needs nothing here.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

#include "graph/evaluate/evaluator.h"
#include "graph/file/parse_json.h"
#include "graph/file/read.h"
#include "graph/reference.h"
#include "nodes/all_nodes.h"

namespace kinegraph {
namespace {

const std::string folder = KINEGRAPH_SOURCE_DIR "/tests/nodes/golden/";

bool updating() {
  const char* asked = std::getenv("KINEGRAPH_UPDATE_GOLDEN");
  return asked && *asked;
}

Json golden(const std::string& name) {
  std::ifstream in(folder + name, std::ios::binary);
  Diagnostics problems;
  return parse_json(std::string(std::istreambuf_iterator<char>(in), {}), name, problems);
}
void update(const std::string& name, const Json& now) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder + name, std::ios::binary) << indented(now) << "\n";
}

// Defaults and forms of the parameters, names of the ports: what a saved file depends on.
Json saved_form(const NodeType& type) {
  Json::Object params, inputs;
  for (const Param& param : type.params) params[param.name] = Json::Array{described(param), *param.fallback};
  for (const InputPort& port : type.inputs) inputs[port.name] = port.list ? "list" : "one";
  Json::Array outputs;
  for (const OutputPort& port : type.outputs) outputs.push_back(port.name);
  return Json::Object{{"version", type.version},
                      {"params", std::move(params)},
                      {"inputs", std::move(inputs)},
                      {"outputs", std::move(outputs)}};
}

TEST(Golden, ADefaultChangesOnlyWithItsTypesVersion) {
  const Registry registry = all_nodes();
  Json::Object now;
  for (const std::string& name : registry.names()) now[name] = saved_form(*registry.find(name));
  if (updating()) return update("registry.json", Json(std::move(now)));
  const Json before = golden("registry.json");
  ASSERT_TRUE(before.is_object());
  for (const auto& [name, was] : before.object()) {
    const auto is = now.find(name);
    if (is == now.end()) {
      ADD_FAILURE() << name << " is gone: graphs that use it can't run any more";
      continue;
    }
    if (!(*was.find("version") == *is->second.find("version")))
      continue;  // a migration is there: the registry asks for it
    for (const auto& [param, form] : was.find("params")->object()) {
      const Json* there = is->second.find("params")->find(param);
      if (!there)
        ADD_FAILURE() << name << "." << param << " is gone, and the version of " << name << " is the same";
      else if (!(there->array()[1] == form.array()[1]))
        ADD_FAILURE() << "the default of " << name << "." << param << " was " << compact(form.array()[1])
                      << " and is " << compact(there->array()[1])
                      << ": raise the type's version, add a migration, then update";
    }
    for (const auto& [port, form] : was.find("inputs")->object()) {
      const Json* there = is->second.find("inputs")->find(port);
      if (!there || !(*there == form))
        ADD_FAILURE() << "the input " << name << "." << port << " is gone or of another form";
    }
    for (const Json& port : was.find("outputs")->array())
      if (!registry.find(name)->find_output(port.string()))
        ADD_FAILURE() << "the output " << name << "." << port.string() << " is gone";
  }
}

// A graph around one node: each input gets a value of its type from nodes with fixed parameters.
class Around {
 public:
  explicit Around(const Registry& registry) : registry_(registry) {}

  // The graph's text, or "" where an input can't be given.
  std::string graph(const NodeType& type) {
    nodes_.clear();
    nodes_["walk"] = gait("walk");
    nodes_["sneak"] = gait("sneak");
    std::set<std::string> on_the_way;
    if (!add("it", type, on_the_way)) return "";
    return compact(Json(Json::Object{{"format", "kinegraph"}, {"schema", 1}, {"nodes", nodes_}}));
  }

 private:
  static Json gait(const char* kind) {
    return Json::Object{{"type", "Gait"}, {"params", Json::Object{{"gait", kind}, {"seconds", 1.5}}}};
  }
  bool add(const std::string& name, const NodeType& type, std::set<std::string>& on_the_way) {
    if (!on_the_way.insert(type.name).second) return false;
    Json::Object inputs;
    int motions = 0;
    bool good = true;
    for (const InputPort& port : type.inputs) {
      if (port.optional) continue;
      std::string link;
      for (const std::string& wanted : port.types) {
        if (!link.empty()) break;
        link = registry_.arrives_as("Motion", port) == wanted || wanted == "Motion"
                   ? (motions++ ? "sneak.motion" : "walk.motion")
                   : made(wanted, on_the_way);
      }
      if (link.empty()) good = false;
      inputs[port.name] =
          port.list
              ? Json(Json::Array{Json(link),
                                 Json(std::string(port.types.front() == "Motion" ? "sneak.motion" : link))})
              : Json(link);
    }
    on_the_way.erase(type.name);
    Json::Object node{{"type", type.name}};
    if (!inputs.empty()) node["inputs"] = std::move(inputs);
    nodes_[name] = std::move(node);
    return good;
  }
  std::string made(const std::string& wanted, std::set<std::string>& on_the_way) {
    for (const std::string& name : registry_.names()) {
      const NodeType& type = *registry_.find(name);
      if (type.role != Role::compute || name == "Load") continue;
      for (const OutputPort& port : type.outputs)
        if (port.type == wanted && add("a_" + name, type, on_the_way)) return "a_" + name + "." + port.name;
    }
    return "";
  }

  const Registry& registry_;
  Json::Object nodes_;
};

// The bits of all outputs, or the code of the error.
std::string digest_of(const NodeType& type, const Registry& registry) {
  const std::string text = Around(registry).graph(type);
  if (text.empty()) return "no input";
  const ReadResult read = read_document(text, "golden", registry);
  Diagnostics problems;
  const Plan plan = make_plan(read.document, registry, {.folder = "/"}, problems);
  FileStore files;
  MemoryCache memory(1u << 30);
  Evaluator evaluator(registry, files, &memory, nullptr);
  const RunLog log = evaluator.run(plan, {{"it", ""}}, {.threads = 1});
  const NodeRun& run = log.nodes.at("it");
  if (run.state != NodeState::done)
    return "fails: " +
           (run.diagnostics.empty() ? std::string(name_of(run.state)) : run.diagnostics.front().code);
  KeyMaker maker;
  for (const OutputPort& port : type.outputs) {
    const ValuePtr value = evaluator.value(plan, "it", port.name);
    Encoder encoder;
    if (value) value->encode(encoder);
    maker.add(port.name, encoder.take());
  }
  return to_text(maker.finish());
}

TEST(Golden, ResultsChangeOnlyWithTheirTypesCodeVersion) {
  const Registry registry = all_nodes();
  const Json before = golden("digests.json");
  Json::Object now;
  for (const std::string& name : registry.names()) {
    const NodeType& type = *registry.find(name);
    if (type.role != Role::compute || type.effect != Effect::none || name == "Load") continue;
    if (!updating() && !before.find(name)) continue;
    now[name] = Json::Object{{"version", type.version},
                             {"code_version", type.code_version},
                             {"digest", digest_of(type, registry)}};
  }
  if (updating()) return update("digests.json", Json(std::move(now)));
  ASSERT_TRUE(before.is_object());
  for (const auto& [name, was] : before.object()) {
    const auto is = now.find(name);
    if (is == now.end() || !(*is->second.find("version") == *was.find("version"))) continue;
    const bool same_bits = *is->second.find("digest") == *was.find("digest");
    const bool same_code = *is->second.find("code_version") == *was.find("code_version");
    if (!same_bits && same_code)
      ADD_FAILURE() << name << " gives other bits (" << compact(*is->second.find("digest"))
                    << ") for the same parameters: raise its code_version, then update";
    if (same_bits && !same_code)
      ADD_FAILURE() << name
                    << " has another code_version and gives the same bits: caches would be thrown away for "
                       "nothing, or the input here doesn't show it";
  }
}

}  // namespace
}  // namespace kinegraph
