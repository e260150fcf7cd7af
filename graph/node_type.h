// A node type, described once. Panel, command line, validation, reference and cache keys all come from this.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "graph/param.h"
#include "graph/value.h"

namespace kinegraph {

class Compute;

struct InputPort {
  std::string name;
  std::vector<std::string> types;  // accepted; the first is the usual one. None: any (Switch, Dot)
  std::string help;
  bool optional = false;
  bool list = false;  // takes several links, in order; always a list in the file
};

struct OutputPort {
  std::string name;
  std::string type;  // "" = that of the input it passes on (Switch, Dot)
  std::string help;
  // What this output is when the node is disabled: an input's name; or a constant; or, with neither, absent.
  std::string passes;
  std::function<ValuePtr()> constant;
};

// One step of a migration: rewrites the stored parameters and inputs of a node of version `from` to `from` + 1.
struct Migration {
  int from = 1;
  void (*apply)(Json::Object& params, Json::Object& inputs) = nullptr;
};

// A file a node will read beside the ones its open_file parameters name (an .amc's .asf, a glTF's buffers).
// Given the node's parameters and a reader of files (path relative to nothing: absolute), returns absolute paths in a
// fixed order. May throw Failure. Files that can't be found are for compute to complain about.
class FileAccess;
using Companions = std::function<std::vector<std::string>(const Params&, FileAccess&)>;

// Files that an Effect::writes node will write beside those its save_file parameters name (a .gltf's .bin): absolute
// paths in a fixed order, so that two nodes on one file are found before anything runs.
using AlsoWrites = std::function<std::vector<std::string>(const Params&)>;

// What parameters and links can't do together, such as a file format that can't hold what is linked: told before
// anything runs. `params` is checked and complete; `linked` names the inputs with links, in declared order. The param
// or port of a diagnostic says where it belongs in the graph file.
using Misfits = std::function<std::vector<Diagnostic>(const Params& params, const std::vector<std::string>& linked)>;

// Resolves parameters left to auto whose meaning depends on a file's name, so that keys hold what they resolved to.
using Resolve = std::function<void(Json::Object& params)>;

enum class Effect { none, writes, checks };  // Export writes and Check checks; both run only when asked for
enum class Role { compute, graph, select, pass };  // Graph, Switch and Dot are expanded before keys are made

struct NodeType {
  std::string name;
  std::string category;  // the family: "time", "style"
  std::string help;      // one or two sentences
  std::string source;    // paper and equations; "" = none
  std::vector<std::string> keywords;  // further words that search-to-add finds it by
  int version = 1;       // of the parameters
  int code_version = 1;  // of the bits that come out
  bool same_on_every_cpu = true;
  Effect effect = Effect::none;
  Role role = Role::compute;
  std::vector<InputPort> inputs;
  std::vector<OutputPort> outputs;
  std::vector<Param> params;
  std::vector<Migration> migrations;
  Companions companions;
  AlsoWrites also_writes;
  Resolve resolve;
  Misfits misfits;
  std::function<void(Compute&)> compute;  // stateless, sees only what is declared here

  NodeType& input(std::string port, std::vector<std::string> types, std::string port_help);
  NodeType& optional_input(std::string port, std::vector<std::string> types, std::string port_help);
  NodeType& list_input(std::string port, std::vector<std::string> types, std::string port_help);
  NodeType& output(std::string port, std::string type, std::string port_help, std::string passes = {});
  NodeType& param(std::string param_name, ParamType type, std::string param_help);

  const InputPort* find_input(std::string_view port) const;
  const OutputPort* find_output(std::string_view port) const;
  const Param* find_param(std::string_view param_name) const;
  std::vector<std::string> input_names() const;
  std::vector<std::string> output_names() const;
  std::vector<std::string> param_names() const;
};

}  // namespace kinegraph
