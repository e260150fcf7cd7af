// Graphs drawn from a grammar: every node type there is, its parameters of every form within their bounds,
// links that fit, variables, publishing, graphs inside graphs with what they publish, layout, a studio's own
// data, and nodes that this program doesn't know.
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

class RandomGraphs {
 public:
  // `files`: graph files, and what Graph nodes that name them look like.
  RandomGraphs(const Registry& registry, unsigned seed, std::map<std::string, NodeType> files = {})
      : registry_(registry), types_(registry.names()), files_(std::move(files)), random_(seed) {}

  Document next() {
    Document document;
    given_.clear();
    if (one_in(4)) document.variables = variables();
    variables_ = &document.variables;
    const std::size_t count = 1 + below(10);
    for (std::size_t i = 0; i < count; ++i) add_node(document);
    if (one_in(3)) publish(document);
    if (one_in(2)) layout(document);
    if (one_in(10)) document.extras["x-" + word()] = any_value(3);
    return document;
  }
  const std::map<std::string, int>& drawn() const { return drawn_; }  // node types, how often
  // "Type.param", how often it was set; of Graph nodes also "FILE.param", and "Graph.*" what no file is known
  // to publish.
  const std::map<std::string, int>& params() const { return params_; }

  // A value of the type; what a text's own grammar refuses is for the caller to drop.
  Json value_of(const ParamType& type) {
    using Kind = ParamType::Kind;
    switch (type.kind) {
      case Kind::number:
        return number_within(type.min, type.max);
      case Kind::integer: {
        const double low = std::max(type.min, -9007199254740991.0),
                     high = std::min(type.max, 9007199254740991.0);
        if (one_in(8)) return one_in(2) ? low : high;
        return std::clamp(std::floor(number_within(low, high)), low, high);
      }
      case Kind::boolean:
        return one_in(2);
      case Kind::text:
        return one_in(3)   ? Json("skate < 0.0" + std::to_string(1 + below(9)))
               : one_in(2) ? Json("u" + std::to_string(1 + below(9)))
                           : Json(text());
      case Kind::pattern:
        return one_of(std::vector<std::string>{"*", "LeftArm", "*Leg*,-Head", "Spine>", "a\\,b", "-*Toe*"});
      case Kind::choice:
        return one_of(type.choices).key;
      case Kind::unit:
        if (one_in(2)) return one_of(type.choices).key;
        return 0.001 * static_cast<double>(1 + below(5000));
      case Kind::range: {
        const auto start = static_cast<double>(below(1000));
        return Json::Array{start,
                           one_in(2) ? Json(nullptr) : Json(start + 1 + static_cast<double>(below(1000)))};
      }
      case Kind::open_file:
        return path(one_in(2) ? ".bvh" : ".kg.json");
      case Kind::save_file:
        return path(".bvh");
      case Kind::list: {
        Json::Array all;
        for (std::size_t i = below(4); i-- > 0;) all.push_back(value_of(type.parts[0]));
        return all;
      }
      case Kind::tuple: {
        Json::Array all;
        for (const ParamType& part : type.parts) all.push_back(value_of(part));
        return all;
      }
      case Kind::object: {
        Json::Object all;
        for (const ParamType& field : type.parts)
          if (!field.fallback || one_in(2)) all[field.name] = value_of(field);
        return all;
      }
      case Kind::table: {
        Json::Object all;
        for (std::size_t i = below(4); i-- > 0;)
          all[one_of(std::vector<std::string>{"*", "Left*", "Hips", "Spine>", "u1", "ü \"x\""})] =
              value_of(type.parts[0]);
        return all;
      }
      case Kind::either:
        return value_of(one_of(type.parts));
    }
    return nullptr;
  }

 private:
  struct Given {
    std::string node, port, type;
  };

  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  bool one_in(std::size_t count) { return below(count) == 0; }
  template <class List>
  const typename List::value_type& one_of(const List& list) {
    return list[below(list.size())];
  }

  std::string word() {
    static const std::vector<std::string> parts = {"walk", "_", "Left", "7", "-", "arm", "x", "0q", "Stats"};
    std::string text(1, one_of(std::string("abXYZ_")));
    for (std::size_t i = below(5); i-- > 0;) text += one_of(parts);
    return text;
  }
  std::string text() {
    static const std::vector<std::string> parts = {"a",     "Ünï", "漢字",         "🙂", "\"",        "\\",
                                                   "\n",    "\t",  "\x01",         "/",    "</script>", " ",
                                                   "$${x}", "*",   "\xE2\x80\xA8", "e"};
    std::string all;
    for (std::size_t i = below(7); i-- > 0;) all += one_of(parts);
    return all;
  }
  std::string path(const char* ending) {
    std::string all;
    for (std::size_t i = below(3); i-- > 0;) all += word() + "/";
    return all + word() + std::to_string(below(1000000)) + ending;
  }
  double number_within(double low, double high) {
    if (one_in(8)) return one_in(2) ? std::max(low, -1e300) : std::min(high, 1e300);
    low = std::max(low, -1e4), high = std::min(high, 1e4);
    const double value = std::uniform_real_distribution<double>(low, high)(random_);
    const double round = static_cast<double>(static_cast<long long>(value * 8)) / 8;
    return one_in(2) && round >= low && round <= high ? round : value;
  }

  Json any_value(int depth) {
    switch (below(depth > 0 ? 7 : 5)) {
      case 0:
        return nullptr;
      case 1:
        return one_in(2);
      case 2:
        return number_within(-1e6, 1e6);
      case 3:
        return static_cast<double>(below(1000));
      case 4:
        return text();
      case 5: {
        Json::Array all;
        for (std::size_t i = below(4); i-- > 0;) all.push_back(any_value(depth - 1));
        return all;
      }
      default: {
        Json::Object all;
        for (std::size_t i = below(4); i-- > 0;) all[text()] = any_value(depth - 1);
        return all;
      }
    }
  }

  std::map<std::string, Json, std::less<>> variables() {
    std::map<std::string, Json, std::less<>> all;
    for (std::size_t i = 1 + below(4); i-- > 0;) all[word()] = any_value(2);
    return all;
  }

  void add_node(Document& document) {
    std::string name = word() + "_" + std::to_string(document.nodes.size());
    if (one_in(12)) {
      document.nodes[name] = unknown_node();
      return;
    }
    const std::string& type_name = one_of(types_);
    const NodeType& type = *registry_.find(type_name);
    Node node;
    node.type = type_name;
    node.version = type.version;
    ++drawn_[type_name];
    node.enabled = !one_in(6);
    if (one_in(6)) node.note = text();
    if (one_in(12)) node.extras["x-" + word()] = any_value(2);
    set_params(node, type, type_name);
    link(node, type);
    if (type.role == Role::graph && !files_.empty() && one_in(2)) {
      auto file = files_.begin();
      std::advance(file, static_cast<long>(below(files_.size())));
      set_params(node, file->second, file->first);
      node.params["file"] = file->first;
      link(node, file->second);
      give(name, file->second);
    } else if (type.role == Role::graph) {
      of_an_unknown_file(node);
    }
    give(name, type);
    document.nodes[name] = std::move(node);
  }

  void set_params(Node& node, const NodeType& type, const std::string& counted_as) {
    for (const Param& param : type.params) {
      if (one_in(2)) continue;
      Json value = value_of(param);
      if (!variables_->empty() && one_in(10))
        value = Json("${" + variables_->begin()->first + "}");
      else if (!check(param, value, "").empty())
        continue;
      if (is_default(param, value)) continue;
      ++params_[counted_as + "." + param.name];
      node.params[param.name] = std::move(value);
    }
  }
  void link(Node& node, const NodeType& type) {
    for (const InputPort& port : type.inputs) {
      if (port.optional && one_in(3)) continue;
      Inputs inputs;
      inputs.list = port.list;
      for (std::size_t i = port.list ? 1 + below(3) : 1; i-- > 0;) {
        std::vector<const Given*> fitting;
        for (const Given& given : given_)
          if (!registry_.arrives_as(given.type, port).empty()) fitting.push_back(&given);
        if (fitting.empty()) break;
        const Given& from = *one_of(fitting);
        inputs.links.push_back({from.node, from.port, {}});
      }
      if (!inputs.links.empty()) node.inputs[port.name] = std::move(inputs);
    }
  }
  void give(const std::string& name, const NodeType& type) {
    for (const OutputPort& port : type.outputs)
      if (!port.type.empty()) given_.push_back({name, port.name, port.type});
  }
  // Nobody has opened the file: any parameter and port may be what it publishes.
  void of_an_unknown_file(Node& node) {
    for (std::size_t i = below(4); i-- > 0;) {
      node.params[word()] = any_value(3);
      ++params_["Graph.*"];
    }
    for (std::size_t i = given_.empty() ? 0 : below(3); i-- > 0;) {
      Inputs inputs;
      inputs.list = one_in(2);
      for (std::size_t k = inputs.list ? 1 + below(3) : 1; k-- > 0;) {
        const Given& from = one_of(given_);
        inputs.links.push_back({from.node, from.port, {}});
      }
      node.inputs[word()] = std::move(inputs);
    }
  }

  // Of a type or version that nobody here knows: kept as it stands, digit for digit.
  Node unknown_node() {
    Json::Object params{{"odd", Json::number_as_read(1000, "1.0e+3")}, {"deep", any_value(3)}};
    Json::Object json{{"type", one_in(2) ? Json("Of" + word()) : Json("Load")},
                      {"params", std::move(params)}};
    if (json["type"] == Json("Load")) json["version"] = 99;
    if (one_in(2) && !given_.empty()) {
      const Given& from = one_of(given_);
      json["inputs"] = Json::Object{{"anything", from.node + "." + from.port}};
    }
    return missing_node_from_json(Json(std::move(json)));
  }

  void publish(Document& document) {
    for (const auto& [name, node] : document.nodes) {
      const NodeType* type = node.missing ? nullptr : registry_.find(node.type);
      if (!type || !one_in(2)) continue;
      if (!type->params.empty()) {
        const Param& param = one_of(type->params);
        document.publish.params["p" + word()] = {{name, param.name, {}}};
      }
      if (!type->inputs.empty())
        document.publish.inputs["i" + word()] = {{name, one_of(type->inputs).name, {}}};
      if (!type->outputs.empty())
        document.publish.outputs["o" + word()] = {{name, one_of(type->outputs).name, {}}};
    }
    // One name for several parameters of one type.
    if (given_.size() > 1 && one_in(2)) {
      std::vector<Link> both;
      for (const auto& [name, node] : document.nodes)
        if (node.type == "Graph" && !node.missing) both.push_back({name, "file", {}});
      if (both.size() > 1) document.publish.params["graphs"] = both;
    }
    if (one_in(6)) document.publish.extras["x-" + word()] = any_value(2);
  }

  void layout(Document& document) {
    const auto whole = [&] { return Json(static_cast<double>(below(4000)) - 2000); };
    Json::Array names;
    for (const auto& [name, node] : document.nodes) {
      if (one_in(4)) continue;
      Json::Object entry{{"pos", Json::Array{whole(), whole()}}};
      if (one_in(5)) entry["color"] = "#ab34ef";
      if (one_in(20)) entry["x-" + word()] = any_value(1);
      document.ui.nodes[name] = std::move(entry);
      names.push_back(name);
    }
    if (one_in(3))
      document.ui.frames[word()] = Json::Object{{"title", text()}, {"color", "#123456"}, {"nodes", names}};
    if (one_in(3))
      document.ui.notes[word()] = Json::Object{
          {"text", text()}, {"pos", Json::Array{whole(), whole()}}, {"size", Json::Array{200, 80}}};
    if (one_in(10)) document.ui.extras["x-" + word()] = any_value(1);
  }

  const Registry& registry_;
  const std::vector<std::string> types_;
  const std::map<std::string, NodeType> files_;
  std::mt19937 random_;
  const std::map<std::string, Json, std::less<>>* variables_ = nullptr;
  std::vector<Given> given_;
  std::map<std::string, int> drawn_, params_;
};

}  // namespace kinegraph
