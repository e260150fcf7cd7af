// A document made ready to run: variables replaced, --set applied, nested graphs expanded, and Graph, Switch, Dot and
// disabled nodes replaced by what they pass on. What is left has keys.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

// Where a planned input comes from: an output of a planned node, or a constant (of a disabled node).
struct Source {
  int node = -1;  // index into Plan::nodes; -1 with a constant
  std::string port;
  ValuePtr constant;        // made once by the plan
  std::string constant_id;  // "TimeWarp.warp": the node type and port whose constant it is, what it is keyed as
};

struct PlannedNode {
  std::string name;  // "outer/inner" inside nested graphs
  const NodeType* type = nullptr;  // null: missing
  std::string type_name;
  bool enabled = true;
  Json::Object params;  // complete, variables replaced, resolved; paths absolute
  std::map<std::string, std::string> shown_paths;  // param -> the path as the user wrote it, for messages
  std::map<std::string, std::vector<Source>> inputs;
  // Why this node can't run although nothing failed yet: a required input is absent. Empty = can.
  std::string blocked;
  std::string missing_because;  // of a Graph node: why its file can't be used
};

struct Plan {
  // Computing nodes, disabled ones among them (nothing leads to those), and missing ones. Graph, Switch and Dot are not
  // here: `passed` says what they stand for.
  std::vector<PlannedNode> nodes;
  std::map<std::string, int> by_name;
  std::string file;    // how messages name the graph
  std::string folder;  // absolute
  std::vector<std::string> graph_files;  // absolute: this file, where it is one, and the nested ones; never written to
  // What a "node.port" stands for after expansion (also of Graph, Switch, Dot and disabled nodes); nothing: absent.
  std::optional<Source> find_output(const std::string& node, const std::string& port) const;
  // Node -> port -> source, for nodes without a key (Graph, Switch, Dot, disabled nodes). Every such node is in it; a port
  // that is absent is not.
  std::map<std::string, std::map<std::string, Source>> passed;
  std::map<std::string, Source> published;                      // publish.outputs
  std::vector<std::string> effects;    // enabled Export and Check nodes of this file, not of nested ones
  std::vector<std::string> set_paths;  // absolute paths given with --set: they may lie outside
};

struct PlanOptions {
  std::string file;
  std::string folder;    // absolute folder of the graph file
  std::string set_folder;  // absolute folder that paths given with --set start from
  std::string out;       // absolute folder that save_file parameters start from
  std::string item;      // of a batch: its folder below `out`, where paths go that name no ${item} or ${index}
  std::map<std::string, Json> variables;  // given with --var: a string is read as the parameter's type asks
  std::vector<std::pair<std::string, std::string>> sets;  // "NODE.PARAM" (or a published name) and the text
};
// Graph nodes have been opened (see nested.h); those that were not are missing. `document` has passed validate() without errors. Adds problems; the plan is usable without errors among them. Those of
// a --set are wrong usage and their codes start "usage:" ("usage:unknown-node", "usage:unknown-param",
// "usage:bad-value", and "usage:" before the codes of check()).
Plan make_plan(const Document& document, const Registry& registry, const PlanOptions& options, Diagnostics& problems);

}  // namespace kinegraph
