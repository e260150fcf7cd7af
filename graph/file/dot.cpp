#include "graph/file/dot.h"

#include <fmt/format.h>

#include <set>

#include "graph/nested.h"

namespace kinegraph {

namespace {

std::string escaped(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    if (special.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}
std::string quoted_id(std::string_view text) {
  return "\"" + escaped(text, "\"\\") + "\"";
}
std::string in_record(std::string_view text) {
  return escaped(text, "\"\\{}|<> ");
}

std::string ports(const std::set<std::string>& names, const char* prefix) {
  std::string out;
  for (const std::string& name : names)
    out += fmt::format("{}<{}_{}> {}", out.empty() ? "" : "|", prefix, name, in_record(name));
  return out;
}

class Drawing {
 public:
  Drawing(const Document& document, const Registry& registry) : document_(document), registry_(registry) {
    // A missing node's ports are those that links speak of.
    for (const auto& [name, node] : document.nodes)
      for (const auto& [port, inputs] : node.inputs) {
        inputs_[name].insert(port);
        for (const Link& link : inputs.links) outputs_[link.node].insert(link.port);
      }
  }

  std::string text() {
    out_ =
        "digraph kinegraph {\n  rankdir=LR;\n  node [shape=record, fontname=\"sans-serif\", fontsize=10];\n";
    for (const auto& [name, node] : document_.nodes) draw(name, node);
    int cluster = 0;
    for (const auto& [name, frame] : document_.ui.frames) draw_frame(name, frame, cluster++);
    for (const auto& [name, node] : document_.nodes)
      for (const auto& [port, inputs] : node.inputs)
        for (const Link& link : inputs.links)
          if (document_.nodes.count(link.node))
            out_ += fmt::format("  {}:\"o_{}\":e -> {}:\"i_{}\":w;\n", quoted_id(link.node), link.port,
                                quoted_id(name), port);
    return out_ + "}\n";
  }

 private:
  void draw(const std::string& name, const Node& node) {
    std::set<std::string> inputs = inputs_[name], outputs = outputs_[name];
    const NodeType* type = known_type(registry_, node);
    if (type) {
      for (const InputPort& port : type->inputs) inputs.insert(port.name);
      for (const OutputPort& port : type->outputs) outputs.insert(port.name);
    }
    std::string middle = in_record(name) + "\\n" + in_record(node.type);
    if (!node.note.empty()) middle += "\\n" + in_record(node.note);
    std::string style;
    if (!type)
      style = ", style=dashed, color=red";
    else if (!node.enabled)
      style = ", style=dashed, color=gray50, fontcolor=gray50";
    out_ += fmt::format("  {} [label=\"{{{{{}}}|{}|{{{}}}}}\"{}];\n", quoted_id(name), ports(inputs, "i"),
                        middle, ports(outputs, "o"), style);
  }

  void draw_frame(const std::string& name, const Json& frame, int cluster) {
    const Json* title = frame.find("title");
    const std::string label = title && title->is_string() ? title->string() : name;
    out_ += fmt::format("  subgraph cluster_{} {{\n    label={};\n", cluster, quoted_id(label));
    if (const Json* nodes = frame.find("nodes"); nodes && nodes->is_array())
      for (const Json& inside : nodes->array())
        if (inside.is_string() && document_.nodes.count(inside.string()))
          out_ += fmt::format("    {};\n", quoted_id(inside.string()));
    out_ += "  }\n";
  }

  const Document& document_;
  const Registry& registry_;
  std::map<std::string, std::set<std::string>> inputs_, outputs_;
  std::string out_;
};

}  // namespace

std::string dot_text(const Document& document, const Registry& registry) {
  return Drawing(document, registry).text();
}

}  // namespace kinegraph
