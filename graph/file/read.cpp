#include "graph/file/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/file/conflict_sides.h"
#include "graph/file/migrate.h"
#include "graph/file/parse_json.h"
#include "graph/file/text_bytes.h"
#include "graph/missing.h"
#include "graph/shortened.h"

namespace kinegraph {

namespace {

// Whether a version could be one: a whole number from 1.
std::optional<int> version_in(const Json& value) {
  if (!value.is_number() || value.number() < 1 || value.number() > 1e9 ||
      value.number() != std::floor(value.number()))
    return {};
  return static_cast<int>(value.number());
}

// What a motion file or a program's text begins with, and JSON's lists and objects don't; "" of any other.
std::string_view first_word(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::size_t length = 0;
  while (length < std::min<std::size_t>(text.size(), 24) && is_letter(text[length])) ++length;
  if (text.starts_with('<'))
    length = std::min<std::size_t>(text.find_first_of(" >\r\n"), 24);  // <?xml, <html
  return text.substr(0, length);
}

// Takes the parsed text apart: what goes into the document is moved there.
class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const Registry& registry, bool migrate)
      : text_(text), file_(file), registry_(registry), migrate_(migrate) {}

  ReadResult read() {
    if (const std::string_view word = first_word(text_); !word.empty()) {
      add(error("not-a-graph", fmt::format("the file starts with {}, and a graph with {{", word))
              .hinting("kinegraph info FILE looks at a motion file, and a Load in a graph reads it"),
          {1, 1});
      return std::move(result_);
    }
    if (!is_text(text_)) {
      add(error("not-a-graph", "the file isn't text").hinting("is it a graph file?"), {1, 1});
      return std::move(result_);
    }
    ReadPast parsed = parse_json_past_mistakes(text_, file_, result_.problems);
    result_.doubt.anywhere = parsed.in_doubt;
    Json& top = parsed.json;
    if (top.is_null() && has_error(result_.problems)) return std::move(result_);
    if (!top.is_object()) {
      add(error("not-a-graph", fmt::format("the file holds {}", name_of(top.kind())))
              .hinting(R"(a graph starts with {"format": "kinegraph", "schema": 1)"),
          top.place);
      return std::move(result_);
    }
    const Json* format = top.find("format");
    if (!format || *format != Json("kinegraph")) {
      add(error("not-a-graph", R"(the file doesn't say "format": "kinegraph")")
              .hinting("is it a graph file?"),
          format ? format->place : top.place);
      // Of any other kind of file nothing more can be judged; a slip of the hand is still a graph's.
      if (!format || !format->is_string() || nearest(format->string(), {"kinegraph"}).empty())
        return std::move(result_);
    }
    const bool known = read_schema(top);
    const std::size_t told = result_.problems.size();
    read_top(top);
    // What a newer program writes can't be judged; what is understood of it can be looked at.
    if (!known) result_.problems.resize(told);
    return std::move(result_);
  }

 private:
  Document& document() { return result_.document; }

  void add(Diagnostic diagnostic, Place place, const std::string& node = {}) {
    diagnostic.node = node;
    result_.problems.push_back(std::move(diagnostic).in_file(file_, place));
  }
  void wrong_type(const Json& value, std::string_view what, const char* wanted,
                  const std::string& node = {}) {
    add(error("wrong-type", fmt::format("{} is {}", what, name_of(value.kind())))
            .hinting(fmt::format("wanted is {}", wanted)),
        value.place, node);
  }
  Json::Object* object_in(Json& value, std::string_view what, const std::string& node = {}) {
    if (value.is_object()) return &value.object();
    wrong_type(value, what, "an object", node);
    return nullptr;
  }
  void unknown_key(const std::string& key, const Json& value, const std::vector<std::string>& known,
                   std::string_view where, const std::string& node = {}) {
    add(error("unknown-key", fmt::format("{} has no key {}", where, in_quotes(key)))
            .hinting(suggestion(key, known)),
        value.key_place, node);
  }
  bool name_is_good(const std::string& name, Place place, std::string_view what) {
    if (is_node_name(name)) return true;
    add(error("bad-name", fmt::format("{} is no name of a {}", in_quotes(name), what))
            .hinting("a letter or _, then letters, digits, _ and -, at most 64 characters"),
        place);
    return false;
  }

  // False: of a newer schema.
  bool read_schema(const Json& top) {
    const Json* schema = top.find("schema");
    if (!schema) {
      add(error("missing-key", "the file has no \"schema\"").hinting("this program writes \"schema\": 1"),
          top.place);
      return true;
    }
    const auto version = version_in(*schema);
    if (!version) {
      add(error("bad-version", fmt::format("{} is no schema", shortened(compact(*schema, true))))
              .hinting("a whole number from 1"),
          schema->place);
      return true;
    }
    document().schema = *version;
    if (*version <= current_schema) return true;
    document().read_only = true;
    document().newer_text = std::string(text_);
    add(warning("newer-schema",
                fmt::format("the file has schema {}, this program knows {}", *version, current_schema))
            .hinting("it can be looked at; a newer Kinegraph can run and change it"),
        schema->place);
    return false;
  }

  void read_top(Json& top) {
    for (auto& [key, value] : top.object()) {
      if (key == "format" || key == "schema") continue;
      if (key == "variables")
        read_variables(value);
      else if (key == "nodes")
        read_nodes(value);
      else if (key == "publish")
        read_publish(value);
      else if (key == "ui")
        read_ui(value);
      else if (is_extra_key(key))
        document().extras[key] = std::move(value);
      else
        unknown_key(key, value, {"format", "schema", "variables", "nodes", "publish", "ui"}, "the file");
    }
  }

  void read_variables(Json& value) {
    if (auto* variables = object_in(value, "\"variables\""))
      for (auto& [name, variable] : *variables)
        if (name_is_good(name, variable.key_place, "variable"))
          document().variables[name] = std::move(variable);
  }

  void read_nodes(Json& value) {
    auto& nodes = document().nodes;
    if (auto* found = object_in(value, "\"nodes\""))
      for (auto& [name, node] : *found) {
        name_is_good(name, node.key_place, "node");
        if (!object_in(node, "a node", name)) continue;
        const Place place = node.key_place;
        nodes.emplace_hint(nodes.end(), name, read_node(name, node))->second.place = place;
      }
  }

  Node read_node(const std::string& name, Json& json) {
    const Json* type_name = json.find("type");
    if (!type_name || !type_name->is_string()) {
      if (type_name)
        wrong_type(*type_name, "\"type\"", "the name of a node type", name);
      else
        add(error("missing-key", "the node has no \"type\"")
                .hinting("`kinegraph nodes` lists the types there are"),
            json.place, name);
      return node_from_json(json);
    }
    const NodeType* type = registry_.find(type_name->string());
    if (!type) {
      add(unknown_type(registry_, type_name->string()), type_name->place, name);
      return missing_node_from_json(std::move(json));
    }
    int version = 1;
    if (const Json* stored = json.find("version")) {
      if (const auto read = version_in(*stored))
        version = *read;
      else
        add(error("bad-version", fmt::format("{} is no version", shortened(compact(*stored, true))))
                .hinting("a whole number from 1"),
            stored->place, name);
    }
    if (version > type->version) {
      add(newer_version(*type, version), json.find("version")->place, name);
      return missing_node_from_json(std::move(json));
    }
    if (version == type->version) return read_known_node(name, json, *type);

    Json current = json;
    migrate_node(*type, version, current.object());
    Node migrated = read_known_node(name, current, *type);
    if (!migrate_) {
      Node as_it_stands = missing_node_from_json(std::move(json));
      as_it_stands.older = true;
      return as_it_stands;
    }
    result_.migrated = true;
    add(info("old-version",
             fmt::format("{} of version {} is read as version {}", type->name, version, type->version))
            .hinting("`kinegraph upgrade` writes it so"),
        json.key_place, name);
    return migrated;
  }

  Node read_known_node(const std::string& name, Json& json, const NodeType& type) {
    Node node;
    node.type = type.name;
    node.version = type.version;
    for (auto& [key, value] : json.object()) {
      if (key == "type" || key == "version") continue;
      if (key == "enabled") {
        if (value.is_boolean())
          node.enabled = value.boolean();
        else
          wrong_type(value, "\"enabled\"", "true or false", name);
      } else if (key == "note") {
        if (value.is_string())
          node.note = value.string();
        else
          wrong_type(value, "\"note\"", "a string", name);
      } else if (key == "params") {
        if (auto* params = object_in(value, "\"params\"", name)) {
          node.params.merge(*params);
          read_params(name, type, node);
        }
      } else if (key == "inputs") {
        if (const auto* inputs = object_in(value, "\"inputs\"", name)) read_inputs(name, *inputs, type, node);
      } else if (is_extra_key(key)) {
        node.extras[key] = std::move(value);
      } else {
        unknown_key(key, value, {"type", "version", "enabled", "note", "params", "inputs"}, "the node", name);
      }
    }
    return node;
  }

  // Leaves those that are known and differ from their default.
  void read_params(const std::string& name, const NodeType& type, Node& node) {
    std::erase_if(node.params, [&](const auto& entry) {
      const auto& [key, value] = entry;
      if (const Param* param = type.find_param(key)) return is_default(*param, value);
      if (type.role == Role::graph) return false;  // its further parameters are what the other file publishes
      Diagnostic problem =
          error("unknown-param", fmt::format("{} has no parameter {}", type.name, in_quotes(key)))
              .at_param(key)
              .hinting(type.find_input(key) ? "it is an input: write it under \"inputs\""
                                            : suggestion(key, type.param_names()));
      add(std::move(problem), value.key_place, name);
      if (type.find_input(key)) node.inputs.try_emplace(key, Inputs{{}, false, value.key_place});  // as meant
      return true;
    });
  }

  void read_inputs(const std::string& name, const Json::Object& inputs, const NodeType& type, Node& node) {
    for (const auto& [key, value] : inputs) {
      const InputPort* port = type.find_input(key);
      if (!port && type.role != Role::graph) {
        add(error("unknown-port", fmt::format("{} has no input {}", type.name, in_quotes(key)))
                .at_port(key)
                .hinting(type.find_param(key) ? "it is a parameter: write it under \"params\""
                                              : suggestion(key, type.input_names())),
            value.key_place, name);
        if (type.find_param(key)) node.params.emplace(key, value);  // as meant
        // The port that was meant isn't open as well: one mistake, one message.
        if (const std::string meant = nearest(key, type.input_names()); !meant.empty())
          node.inputs.try_emplace(meant, Inputs{{}, false, value.key_place});
        continue;
      }
      Inputs read{{}, value.is_array(), value.key_place};
      const bool empty_list = value.is_array() && value.array().empty();
      if (value.is_array()) {
        for (const Json& element : value.array()) read_link(name, key, element, read.links);
      } else {
        read_link(name, key, value, read.links);
      }
      if (port && port->list && !value.is_array() && value.is_string()) {
        add(error("needs-list", fmt::format("{} takes several links: it has a list, also of one", key))
                .at_port(key)
                .hinting(fmt::format("[{}]", compact(value))),
            value.place, name);
        read.list = true;
      } else if (port && !port->list && value.is_array()) {
        add(error("one-link", fmt::format("{} takes one link, and no list", key))
                .at_port(key)
                .hinting("\"node.port\""),
            value.place, name);
        read.list = false;
        if (read.links.size() > 1) read.links.resize(1);
      }
      if (!empty_list) node.inputs[key] = std::move(read);
    }
  }

  void read_link(const std::string& name, const std::string& port, const Json& value,
                 std::vector<Link>& links) {
    auto link = value.is_string() ? link_from_text(value.string()) : std::nullopt;
    if (!link) {
      add(error("bad-link", fmt::format("{} is no link", shortened(compact(value, true))))
              .at_port(port)
              .hinting("\"node.port\""),
          value.place, name);
      return;
    }
    link->place = value.place;
    links.push_back(std::move(*link));
  }

  void read_publish(Json& value) {
    auto* publish = object_in(value, "\"publish\"");
    if (!publish) return;
    for (auto& [key, part] : *publish) {
      if (key == "params")
        read_targets(part, key, true, document().publish.params);
      else if (key == "inputs")
        read_targets(part, key, true, document().publish.inputs);
      else if (key == "outputs")
        read_targets(part, key, false, document().publish.outputs);
      else if (is_extra_key(key))
        document().publish.extras[key] = std::move(part);
      else
        unknown_key(key, part, {"params", "inputs", "outputs"}, "\"publish\"");
    }
  }

  void read_targets(Json& value, const std::string& part, bool several,
                    std::map<std::string, std::vector<Link>, std::less<>>& targets) {
    const auto* names = object_in(value, fmt::format("\"publish.{}\"", part));
    if (!names) return;
    for (const auto& [name, target] : *names) {
      if (name == "file") {
        add(error("bad-name", "nothing can be published as \"file\"")
                .hinting("that is the Graph node's own parameter"),
            target.key_place);
        continue;
      }
      if (!name_is_good(name, target.key_place, "published " + part.substr(0, part.size() - 1))) continue;
      const std::string where = fmt::format("publish.{}.{}", part, name);
      std::vector<Link> links;
      const auto read = [&](const Json& one) {
        auto link = one.is_string() ? link_from_text(one.string()) : std::nullopt;
        if (!link) {
          add(error("bad-link",
                    fmt::format("{} is nothing that can be published", shortened(compact(one, true))))
                  .at_param(where)
                  .hinting(part == "params" ? "\"node.param\"" : "\"node.port\""),
              one.place);
          return;
        }
        link->place = one.place;
        links.push_back(std::move(*link));
      };
      if (!target.is_array()) {
        read(target);
      } else if (!several) {
        add(error("one-link", "an output is published from one port")
                .at_param(where)
                .hinting("\"node.port\""),
            target.place);
      } else if (target.array().empty()) {
        add(error("bad-link", "an empty list publishes nothing")
                .at_param(where)
                .hinting("leave the name out"),
            target.place);
      } else {
        for (const Json& one : target.array()) read(one);
      }
      if (!links.empty()) targets[name] = std::move(links);
    }
  }

  void read_ui(Json& value) {
    auto* ui = object_in(value, "\"ui\"");
    if (!ui) return;
    for (auto& [key, part] : *ui) {
      if (key == "nodes")
        read_ui_part(part, key, {{"pos", UiForm::point}, {"color", UiForm::text}}, document().ui.nodes);
      else if (key == "frames")
        read_ui_part(part, key, {{"title", UiForm::text}, {"color", UiForm::text}, {"nodes", UiForm::texts}},
                     document().ui.frames);
      else if (key == "notes")
        read_ui_part(part, key, {{"text", UiForm::text}, {"pos", UiForm::point}, {"size", UiForm::point}},
                     document().ui.notes);
      else if (is_extra_key(key))
        document().ui.extras[key] = std::move(part);
      else
        unknown_key(key, part, {"nodes", "frames", "notes"}, "\"ui\"");
    }
  }

  enum class UiForm { point, text, texts };

  void read_ui_part(Json& value, const std::string& part,
                    const std::vector<std::pair<std::string, UiForm>>& fields,
                    std::map<std::string, Json, std::less<>>& entries) {
    auto* named = object_in(value, fmt::format("\"ui.{}\"", part));
    if (!named) return;
    std::vector<std::string> known;
    for (const auto& [field, form] : fields) known.push_back(field);
    for (auto& [name, entry] : *named) {
      const std::string where = fmt::format("ui.{}.{}", part, name);
      const bool good = name_is_good(name, entry.key_place,
                                     part == "nodes"    ? "node"
                                     : part == "frames" ? "frame"
                                                        : "note");
      const auto* members = object_in(entry, where);
      if (!good || !members) continue;
      for (const auto& [key, member] : *members) {
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.first == key; });
        if (field != fields.end())
          check_ui(member, field->second, where + "." + key);
        else if (!is_extra_key(key))
          unknown_key(key, member, known, where);
      }
      entries.emplace_hint(entries.end(), name, std::move(entry));
    }
  }

  void check_ui(const Json& value, UiForm form, const std::string& where) {
    if (form == UiForm::text) {
      if (!value.is_string()) wrong_type(value, where, "a string");
      return;
    }
    if (form == UiForm::texts) {
      if (!value.is_array()) return wrong_type(value, where, "a list of node names");
      for (const Json& element : value.array())
        if (!element.is_string()) wrong_type(element, where, "a list of node names");
      return;
    }
    if (!value.is_array() || value.array().size() != 2) return wrong_type(value, where, "two whole numbers");
    for (const Json& element : value.array()) {
      if (!element.is_number())
        wrong_type(element, where, "two whole numbers");
      else if (element.number() != std::floor(element.number()) || std::fabs(element.number()) > 1e9)
        add(error("not-an-integer", fmt::format("{} is {}", where, shortened(compact(element, true))))
                .hinting("positions are whole numbers"),
            element.place);
    }
  }

  std::string_view text_;
  const std::string& file_;
  const Registry& registry_;
  const bool migrate_;
  ReadResult result_;
};

// Each side of git's conflicts, the problems of the first and those that stand outside the conflicts, with
// which the second hasn't to do either.
ReadResult read_sides(ConflictSides sides, const std::string& file, const Registry& registry, bool migrate) {
  ReadResult result = Reader(sides.first, file, registry, migrate).read();
  ReadResult other = Reader(sides.second, file, registry, migrate).read();
  result.doubt.conflicts = std::move(sides.blocks);
  result.doubt.torn_at = sides.torn_at;
  if (!other.doubt.anywhere && !other.document.nodes.empty())
    result.doubt.other_side = std::make_shared<const Document>(std::move(other.document));
  drop_other_side(result.problems, other.problems, result.doubt);
  for (Diagnostic& problem : sides.problems) {
    problem.file = file;
    result.problems.push_back(std::move(problem));
  }
  std::stable_sort(result.problems.begin(), result.problems.end(), stands_before);
  return result;
}

}  // namespace

ReadResult read_document(std::string_view text, const std::string& file, const Registry& registry,
                         bool migrate) {
  auto sides = conflict_sides(text);
  ReadResult result = sides ? read_sides(std::move(*sides), file, registry, migrate)
                            : Reader(text, file, registry, migrate).read();
  drop_consequences(result.problems, result.doubt);
  return result;
}

}  // namespace kinegraph
