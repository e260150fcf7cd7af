#include "graph/file/migrate.h"

namespace kinegraph {

namespace {
Json::Object taken(Json::Object& node, const char* key) {
  const auto found = node.find(key);
  if (found == node.end() || !found->second.is_object()) return {};
  return found->second.object();
}
void put_back(Json::Object& node, const char* key, Json::Object members) {
  const auto found = node.find(key);
  if (members.empty() && found == node.end()) return;
  if (found == node.end())
    node[key] = std::move(members);
  else if (found->second.is_object())
    found->second.object() = std::move(members);
}
}  // namespace

void migrate_node(const NodeType& type, int from, Json::Object& node) {
  Json::Object params = taken(node, "params"), inputs = taken(node, "inputs");
  for (int version = from; version < type.version; ++version)
    for (const Migration& step : type.migrations)
      if (step.from == version) step.apply(params, inputs);
  put_back(node, "params", std::move(params));
  put_back(node, "inputs", std::move(inputs));
  node["version"] = type.version;
}

}  // namespace kinegraph
