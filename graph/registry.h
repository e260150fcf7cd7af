// All node types and port types that a program knows. Made once in main, then only read; no global state.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "graph/node_type.h"

namespace kinegraph {

class Registry {
 public:
  // Throws std::logic_error for a duplicate name, an unknown port type, a `passes` that names no input, a default
  // outside its own range: a description is checked when it is added.
  void add(ValueType type);
  void add(NodeType type);

  const NodeType* find(std::string_view name) const;
  const ValueType* find_value(std::string_view name) const;
  std::vector<std::string> names() const;        // sorted
  std::vector<std::string> value_names() const;  // sorted
  // Whether an output of type `from` may be linked to an input that accepts `port.types`; the type it arrives as, or "".
  std::string arrives_as(std::string_view from, const InputPort& port) const;

 private:
  std::map<std::string, NodeType, std::less<>> nodes_;
  std::map<std::string, ValueType, std::less<>> values_;
};

}  // namespace kinegraph
