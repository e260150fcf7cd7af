#include "graph/file/write.h"

#include <algorithm>

namespace kinegraph {

namespace {

// Numbers in the shortest form, or as they were spelled (in what this program doesn't understand).
enum class Numbers { shortest, as_read };

class Writer {
 public:
  explicit Writer(const Registry& registry) : registry_(registry) {}

  std::string write(const Document& document) {
    open();
    text("format", "kinegraph");
    key("schema");
    out_ += std::to_string(document.schema);
    members("variables", document.variables, Numbers::shortest);
    nodes(document);
    publish(document.publish);
    ui(document.ui);
    extras(document.extras);
    close();
    return std::move(out_) + '\n';
  }

 private:
  // An object's frame: every key on a line of its own.
  void open() {
    out_ += '{';
    ++depth_;
    first_ = true;
  }
  void key(std::string_view name) {
    out_ += first_ ? "\n" : ",\n";
    first_ = false;
    margin();
    out_ += in_quotes(name) + ": ";
  }
  void close() {
    --depth_;
    out_ += '\n';
    margin();
    out_ += '}';
    first_ = false;
  }
  void margin() { out_.append(2 * depth_, ' '); }

  void text(std::string_view name, std::string_view value) {
    key(name);
    out_ += in_quotes(value);
  }

  void lines(const Json::Array& elements, Numbers numbers) {
    out_ += '[';
    ++depth_;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      out_ += i ? ",\n" : "\n";
      margin();
      out_ += compact(elements[i], numbers == Numbers::as_read);
    }
    --depth_;
    out_ += '\n';
    margin();
    out_ += ']';
  }
  void value(const Json& json, Numbers numbers) {
    if (json.is_object() && !json.object().empty()) {
      open();
      for (const auto& [name, member] : json.object()) {
        key(name);
        value(member, numbers);
      }
      close();
      return;
    }
    const bool objects =
        json.is_array() && !json.array().empty() &&
        std::all_of(json.array().begin(), json.array().end(), [](const Json& e) { return e.is_object(); });
    if (objects)
      lines(json.array(), numbers);
    else
      out_ += compact(json, numbers == Numbers::as_read);
  }
  // The value of an input: a list of links has one a line.
  void links(const Json& json, Numbers numbers) {
    if (json.is_array() && !json.array().empty())
      lines(json.array(), numbers);
    else
      value(json, numbers);
  }

  template <class Map>
  void members(std::string_view name, const Map& map, Numbers numbers) {
    if (map.empty()) return;
    key(name);
    open();
    for (const auto& [member, json] : map) {
      key(member);
      value(json, numbers);
    }
    close();
  }
  void extras(const std::map<std::string, Json, std::less<>>& all) {
    for (const auto& [name, json] : all) {
      key(name);
      value(json, Numbers::as_read);
    }
  }

  void nodes(const Document& document) {
    if (document.nodes.empty()) return;
    key("nodes");
    open();
    for (const auto& [name, node] : document.nodes) {
      key(name);
      if (node.missing)
        missing_node(*node.missing);
      else
        known_node(node);
    }
    close();
  }

  void known_node(const Node& node) {
    open();
    text("type", node.type);
    if (node.version != 1) {
      key("version");
      out_ += std::to_string(node.version);
    }
    if (!node.enabled) {
      key("enabled");
      out_ += "false";
    }
    if (!node.note.empty()) text("note", node.note);
    params(node);
    const bool linked = std::any_of(node.inputs.begin(), node.inputs.end(),
                                    [](const auto& input) { return !input.second.links.empty(); });
    if (linked) {
      key("inputs");
      open();
      for (const auto& [port, inputs] : node.inputs) {
        if (inputs.links.empty()) continue;
        key(port);
        if (inputs.list)
          targets(inputs.links);
        else
          out_ += in_quotes(to_text(inputs.links.front()));
      }
      close();
    }
    extras(node.extras);
    close();
  }

  void params(const Node& node) {
    const NodeType* type = registry_.find(node.type);
    const auto is_left_out = [&](const std::string& name, const Json& json) {
      const Param* param = type ? type->find_param(name) : nullptr;
      return param && is_default(*param, json);
    };
    bool opened = false;
    for (const auto& [name, json] : node.params) {
      if (is_left_out(name, json)) continue;
      if (!opened) {
        key("params");
        open();
        opened = true;
      }
      key(name);
      value(json, Numbers::shortest);
    }
    if (opened) close();
  }

  void missing_node(const Json& json) {
    if (!json.is_object() || json.object().empty()) return value(json, Numbers::as_read);
    static constexpr const char* order[] = {"type", "version", "enabled", "note", "params", "inputs"};
    const auto member = [&](const std::string& name, const Json& part) {
      key(name);
      if (name != "inputs" || !part.is_object() || part.object().empty())
        return value(part, Numbers::as_read);
      open();
      for (const auto& [port, links_of_port] : part.object()) {
        key(port);
        links(links_of_port, Numbers::as_read);
      }
      close();
    };
    open();
    for (const char* name : order)
      if (const Json* part = json.find(name)) member(name, *part);
    for (const auto& [name, part] : json.object())
      if (std::find(std::begin(order), std::end(order), name) == std::end(order)) member(name, part);
    close();
  }

  void targets(const std::vector<Link>& all) {
    Json::Array elements;
    for (const Link& link : all) elements.push_back(to_text(link));
    lines(elements, Numbers::shortest);
  }
  void published(std::string_view name, const std::map<std::string, std::vector<Link>, std::less<>>& map) {
    if (map.empty()) return;
    key(name);
    open();
    for (const auto& [published_name, links] : map) {
      key(published_name);
      if (links.size() == 1)
        out_ += in_quotes(to_text(links.front()));
      else
        targets(links);
    }
    close();
  }
  void publish(const Publish& all) {
    if (all.params.empty() && all.inputs.empty() && all.outputs.empty() && all.extras.empty()) return;
    key("publish");
    open();
    published("inputs", all.inputs);
    published("outputs", all.outputs);
    published("params", all.params);
    extras(all.extras);
    close();
  }

  using Entries = std::map<std::string, Json, std::less<>>;
  static bool has_entry(const Entries& entries) {
    return std::any_of(entries.begin(), entries.end(),
                       [](const auto& e) { return !e.second.is_object() || !e.second.object().empty(); });
  }
  void ui_part(std::string_view name, const Entries& entries) {
    if (!has_entry(entries)) return;
    key(name);
    open();
    for (const auto& [entry, json] : entries) {
      if (!json.is_object() || json.object().empty()) continue;
      key(entry);
      open();
      for (const auto& [member, part] : json.object()) {
        key(member);
        value(part, is_extra_key(member) ? Numbers::as_read : Numbers::shortest);
      }
      close();
    }
    close();
  }
  void ui(const Ui& all) {
    if (!has_entry(all.nodes) && !has_entry(all.frames) && !has_entry(all.notes) && all.extras.empty())
      return;
    key("ui");
    open();
    ui_part("frames", all.frames);
    ui_part("nodes", all.nodes);
    ui_part("notes", all.notes);
    extras(all.extras);
    close();
  }

  const Registry& registry_;
  std::string out_;
  std::size_t depth_ = 0;
  bool first_ = true;
};

}  // namespace

std::string write_document(const Document& document, const Registry& registry) {
  if (document.read_only) return document.newer_text;
  return Writer(registry).write(document);
}

}  // namespace kinegraph
