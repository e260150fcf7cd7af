// What a saved file depends on: names of node types, ports and parameters, defaults, and what parameters
// take. A change of those must raise the type's version (and bring a migration). What stood when this was
// last looked at is in tests/nodes/golden/registry.json; see golden_files.h for writing it anew. What changed
// under the same version is not written: it fails until the version is raised.
#include <gtest/gtest.h>

#include "graph/reference.h"
#include "nodes/all_nodes.h"
#include "tests/nodes/golden_files.h"

namespace kinegraph {
namespace {

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

// What files of the same version would miss, read otherwise, or refuse; "" where nothing does.
std::string difference(const Json& was, const Json& is) {
  if (was == is || !(*was.find("version") == *is.find("version"))) return "";
  for (const char* part : {"params", "inputs"}) {
    const Json::Object &before = was.find(part)->object(), &now = is.find(part)->object();
    for (const auto& [name, form] : before) {
      const auto there = now.find(name);
      if (there == now.end()) return name + " is gone";
      if (!(there->second == form))
        return name + " was " + compact(form) + " and is " + compact(there->second);
    }
    for (const auto& [name, form] : now)
      if (!before.contains(name)) return name + " is new";
  }
  return "its outputs were " + compact(*was.find("outputs")) + " and are " + compact(*is.find("outputs"));
}

TEST(Golden, WhatFilesDependOnChangesOnlyWithATypesVersion) {
  const Registry registry = all_nodes();
  const Json before = golden::json("registry.json");
  ASSERT_TRUE(before.is_object());
  Json::Object now;
  for (const std::string& name : registry.names()) {
    Json is = saved_form(*registry.find(name));
    const Json* was = before.find(name);
    if (!was && !golden::updating()) ADD_FAILURE() << name << " is new: update";
    if (const std::string what = was ? difference(*was, is) : ""; !what.empty()) {
      ADD_FAILURE()
          << name << ": " << what
          << ". Raise the type's version, add a migration, then update: older files must give what they "
             "gave, and older programs keep a newer node as it is instead of refusing its file";
      is = *was;
    } else if (was && !golden::updating() && !(*was == is)) {
      ADD_FAILURE() << name << " has another version: update";
    }
    now[name] = std::move(is);
  }
  for (const auto& [name, was] : before.object())
    if (!now.contains(name)) {
      ADD_FAILURE() << name << " is gone: graphs that use it can't run any more";
      now[name] = was;
    }
  if (golden::updating()) golden::write("registry.json", indented(Json(std::move(now))) + "\n");
}

}  // namespace
}  // namespace kinegraph
