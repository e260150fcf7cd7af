// A graph as it is saved: nodes, links, parameters, publishing, layout. Pure data; meaning is checked by
// validate.h and given by plan.h. Everything in it can be addressed as a Unit, and undo, diff and merge all
// speak in units.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "graph/json.h"

namespace kinegraph {

struct Link {
  std::string node;
  std::string port;
  Place place;
  bool operator==(const Link& other) const { return node == other.node && port == other.port; }
};
std::string to_text(const Link& link);                      // "node.port"
std::optional<Link> link_from_text(std::string_view text);  // nothing when it isn't NAME.NAME

// The links of one input port. `list`: stands as a list in the file, as it must on a port that takes several.
struct Inputs {
  std::vector<Link> links;
  bool list = false;
  Place place;
  bool operator==(const Inputs& other) const { return links == other.links && list == other.list; }
};

struct Nested;  // see nested.h

struct Node {
  std::string type;
  int version = 1;
  bool enabled = true;
  std::string note;
  std::map<std::string, Json, std::less<>> params;  // as stored: only those that differ from the default
  std::map<std::string, Inputs, std::less<>> inputs;
  std::map<std::string, Json, std::less<>> extras;  // keys starting "x-"
  // Set where the node's type is unknown or its version newer: the node's whole object as read. The fields
  // above hold what could be understood of it (type, inputs), for drawing and dependency; this is what is
  // written back.
  std::optional<Json> missing;
  // A known type's older version, read without migrating: kept in `missing` too, for writing only.
  bool older = false;
  Place place;  // of its name
  // Of a Graph node: its file, once open_nested() has read it; never saved.
  std::shared_ptr<const Nested> nested;
};

// Names -> "node.param" or "node.port" targets. One target is written as a string, several as a list.
struct Publish {
  std::map<std::string, std::vector<Link>, std::less<>> params;
  std::map<std::string, std::vector<Link>, std::less<>> inputs;
  std::map<std::string, std::vector<Link>, std::less<>> outputs;  // exactly one target each
  std::map<std::string, Json, std::less<>> extras;
};

// Only for the eye: never changes a result or a key.
struct Ui {
  std::map<std::string, Json, std::less<>> nodes;   // {pos: [x, y], color}
  std::map<std::string, Json, std::less<>> frames;  // {title, color, nodes}
  std::map<std::string, Json, std::less<>> notes;   // {text, pos, size}
  std::map<std::string, Json, std::less<>> extras;
};

struct Document {
  int schema = 1;
  std::map<std::string, Json, std::less<>> variables;
  std::map<std::string, Node, std::less<>> nodes;
  Publish publish;
  Ui ui;
  std::map<std::string, Json, std::less<>> extras;
  bool read_only = false;  // of a newer schema; whole text kept below, what is understood filled in
  std::string newer_text;
};
inline constexpr int current_schema = 1;

bool is_node_name(std::string_view name);  // [A-Za-z_][A-Za-z0-9_-]*, at most 64 characters
bool is_extra_key(std::string_view key);   // starts with "x-"

// The smallest thing an edit, a diff or a merge speaks of.
struct Unit {
  enum class Kind {
    node,          // a whole node: value as in the file
    missing_node,  // the same for a missing node, which is absent as a `node`: its value is kept as read
    node_type,     // type and version together: {"type", "version"}
    node_enabled,
    node_note,
    node_param,  // name = node, key = param
    node_input,  // name = node, key = port
    node_extra,
    variable,  // name
    publish_param,
    publish_input,
    publish_output,
    publish_extra,
    ui_node,
    ui_frame,
    ui_note,
    ui_extra,
    extra,  // of the document
  };
  Kind kind;
  std::string name;
  std::string key;
  auto operator<=>(const Unit&) const = default;
};
std::string to_text(const Unit& unit);  // "transfer.root", "publish.params.source"

// The unit's value in the file's form, or nothing where it is absent (a parameter at its default, an open
// port).
std::optional<Json> get(const Document& document, const Unit& unit);
// Sets or, given nothing, removes it. Throws std::logic_error for a unit of a node that isn't there. On a
// missing node the units of its parts read and change the object it is kept as.
void set(Document& document, const Unit& unit, std::optional<Json> value);

// A node's object in the file's form, and back. They do no checking: what doesn't have the file's form is
// left out, and read.h has complained of it.
Json to_json(const Node& node);
Node node_from_json(const Json& json);
Node missing_node_from_json(Json json);  // `missing` set, and what can be understood of it

}  // namespace kinegraph
