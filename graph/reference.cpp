#include "graph/reference.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace kinegraph {

namespace {

using Kind = ParamType::Kind;

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::number:
      return "number";
    case Kind::integer:
      return "integer";
    case Kind::boolean:
      return "boolean";
    case Kind::text:
      return "text";
    case Kind::pattern:
      return "pattern";
    case Kind::choice:
      return "choice";
    case Kind::range:
      return "range";
    case Kind::unit:
      return "unit";
    case Kind::open_file:
      return "open_file";
    case Kind::save_file:
      return "save_file";
    case Kind::list:
      return "list";
    case Kind::tuple:
      return "tuple";
    case Kind::object:
      return "object";
    case Kind::table:
      return "table";
    case Kind::either:
      return "either";
  }
  return "";
}

std::string types_of(const InputPort& port) {
  if (port.types.empty()) return "any";
  return fmt::format("{}", fmt::join(port.types, " or "));
}
std::string type_of(const OutputPort& port) {
  return port.type.empty() ? "as linked" : port.type;
}
std::string remarks(const InputPort& port) {
  if (port.list) return ", several links";
  return port.optional ? ", optional" : "";
}
std::string when_disabled(const OutputPort& port) {
  if (!port.passes.empty()) return "passes on " + port.passes;
  return port.constant ? "a constant" : "absent";
}
std::string default_of(const Param& param) {
  return param.fallback ? compact(*param.fallback) : "required";
}

// Choices and fields, below a parameter: each with its depth, name and text.
template <class Put>
void for_each_detail(const ParamType& type, int depth, const Put& put) {
  for (const auto& choice : type.choices) put(depth, choice.key, choice.help);
  if (type.kind == Kind::object)
    for (const ParamType& field : type.parts) {
      std::string text = field.help + " — " + described(field);
      if (!field.fallback)
        text += ", required";
      else if (!field.fallback->is_null())
        text += ", default " + compact(*field.fallback);
      put(depth, field.name, text);
      for_each_detail(field, depth + 1, put);
    }
  else
    for (const ParamType& part : type.parts) for_each_detail(part, depth, put);
}

std::string in_cell(std::string text) {
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2))
    text.insert(i, "\\");
  return text;
}

std::map<std::string, std::vector<const NodeType*>> by_family(const Registry& registry) {
  std::map<std::string, std::vector<const NodeType*>> families;
  for (const std::string& name : registry.names()) {
    const NodeType* type = registry.find(name);
    families[type->category].push_back(type);
  }
  return families;
}

// Families write their help with or without a full stop; before another sentence it needs one.
std::string sentence(const std::string& help) {
  return help.empty() || help.ends_with('.') ? help : help + ".";
}

}  // namespace

std::string reference_list(const Registry& registry) {
  std::size_t width = 0;
  for (const std::string& name : registry.names()) width = std::max(width, name.size());
  std::string out;
  for (const auto& [family, types] : by_family(registry)) {
    out += fmt::format("{}{}\n", out.empty() ? "" : "\n", family);
    for (const NodeType* type : types) out += fmt::format("  {:<{}}  {}\n", type->name, width, type->help);
  }
  return out;
}

std::string reference_text(const NodeType& type) {
  std::string out = fmt::format("{} ({})\n{}\n", type.name, type.category, type.help);
  if (!type.source.empty()) out += fmt::format("Source: {}\n", type.source);
  if (!type.inputs.empty()) out += "\nInputs\n";
  for (const InputPort& port : type.inputs)
    out += fmt::format("  {}: {}{}\n      {}\n", port.name, types_of(port), remarks(port), port.help);
  if (!type.outputs.empty()) out += "\nOutputs\n";
  for (const OutputPort& port : type.outputs)
    out += fmt::format("  {}: {}\n      {} When disabled: {}.\n", port.name, type_of(port),
                       sentence(port.help), when_disabled(port));
  if (!type.params.empty()) out += "\nParameters\n";
  for (const Param& param : type.params) {
    out +=
        fmt::format("  {} = {}: {}\n      {}\n", param.name, default_of(param), described(param), param.help);
    for_each_detail(param, 0, [&](int depth, const std::string& name, const std::string& text) {
      out += fmt::format("      {:{}}{}{}{}\n", "", 2 * depth, name, text.empty() ? "" : ": ", text);
    });
  }
  return out;
}

std::string reference_markdown(const NodeType& type) {
  std::string out = fmt::format("### {}\n\n{}\n", type.name, type.help);
  if (!type.source.empty()) out += fmt::format("\nSource: {}\n", type.source);
  if (!type.inputs.empty()) out += "\n| input | takes | |\n|---|---|---|\n";
  for (const InputPort& port : type.inputs)
    out +=
        fmt::format("| `{}` | {}{} | {} |\n", port.name, types_of(port), remarks(port), in_cell(port.help));
  if (!type.outputs.empty()) out += "\n| output | gives | | when disabled |\n|---|---|---|---|\n";
  for (const OutputPort& port : type.outputs)
    out += fmt::format("| `{}` | {} | {} | {} |\n", port.name, type_of(port), in_cell(port.help),
                       when_disabled(port));
  if (!type.params.empty()) out += "\n| parameter | default | takes | |\n|---|---|---|---|\n";
  for (const Param& param : type.params) {
    std::string help = param.help;
    for_each_detail(param, 0, [&](int, const std::string& name, const std::string& text) {
      help += fmt::format("<br>`{}`{}{}", name, text.empty() ? "" : ": ", text);
    });
    out += fmt::format("| `{}` | `{}` | {} | {} |\n", param.name, in_cell(default_of(param)),
                       in_cell(described(param)), in_cell(help));
  }
  return out;
}

std::string reference_markdown(const Registry& registry) {
  std::string out = "# Nodes\n\n| family | nodes |\n|---|---|\n";
  for (const auto& [family, types] : by_family(registry)) {
    out += fmt::format("| {} |", family);
    for (const NodeType* type : types)
      out += fmt::format(" [{}](#{})", type->name, [&] {
        std::string anchor = type->name;
        for (char& c : anchor)
          if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        return anchor;
      }());
    out += " |\n";
  }
  out += "\n| port type | |\n|---|---|\n";
  for (const std::string& name : registry.value_names())
    out += fmt::format("| {} | {} |\n", name, in_cell(registry.find_value(name)->help));
  for (const auto& [family, types] : by_family(registry)) {
    out += fmt::format("\n## {}\n", family);
    for (const NodeType* type : types) out += "\n" + reference_markdown(*type);
  }
  return out;
}

namespace {

void put_text(Json::Object& object, const char* key, const std::string& text) {
  if (!text.empty()) object[key] = text;
}

Json param_json(const ParamType& type) {
  Json::Object object;
  put_text(object, "name", type.name);
  object["kind"] = name_of(type.kind);
  put_text(object, "help", type.help);
  put_text(object, "unit", type.unit);
  if (type.fallback) object["default"] = *type.fallback;
  const auto limit = [&](const char* key, double value) {
    if (std::isfinite(value)) object[key] = value;
  };
  limit("min", type.min);
  limit("max", type.max);
  limit("soft_min", type.soft_min);
  limit("soft_max", type.soft_max);
  Json::Array choices;
  for (const auto& choice : type.choices) {
    Json::Object one{{"key", choice.key}};
    put_text(one, "help", choice.help);
    choices.push_back(std::move(one));
  }
  if (!choices.empty()) object["choices"] = std::move(choices);
  Json::Array parts;
  for (const ParamType& part : type.parts) parts.push_back(param_json(part));
  if (!parts.empty()) object["parts"] = std::move(parts);
  return object;
}

}  // namespace

Json reference_json(const NodeType& type) {
  Json::Object object;
  object["name"] = type.name;
  put_text(object, "category", type.category);
  put_text(object, "help", type.help);
  put_text(object, "source", type.source);
  object["version"] = type.version;
  object["code_version"] = type.code_version;
  if (type.effect != Effect::none) object["effect"] = type.effect == Effect::writes ? "writes" : "checks";
  Json::Array keywords, inputs, outputs, params;
  for (const std::string& word : type.keywords) keywords.push_back(word);
  for (const InputPort& port : type.inputs) {
    Json::Array types;
    for (const std::string& one : port.types) types.push_back(one);
    Json::Object input{{"name", port.name}, {"types", std::move(types)}, {"help", port.help}};
    if (port.optional) input["optional"] = true;
    if (port.list) input["list"] = true;
    inputs.push_back(std::move(input));
  }
  for (const OutputPort& port : type.outputs)
    outputs.push_back(Json::Object{
        {"name", port.name}, {"type", port.type}, {"help", port.help}, {"disabled", when_disabled(port)}});
  for (const Param& param : type.params) params.push_back(param_json(param));
  if (!keywords.empty()) object["keywords"] = std::move(keywords);
  if (!inputs.empty()) object["inputs"] = std::move(inputs);
  if (!outputs.empty()) object["outputs"] = std::move(outputs);
  if (!params.empty()) object["params"] = std::move(params);
  return object;
}

Json reference_json(const Registry& registry) {
  Json::Object nodes, port_types;
  for (const std::string& name : registry.names()) nodes[name] = reference_json(*registry.find(name));
  for (const std::string& name : registry.value_names()) {
    const ValueType* type = registry.find_value(name);
    Json::Object one{{"help", type->help}};
    put_text(one, "converts_from", type->convert_from);
    port_types[name] = std::move(one);
  }
  return Json::Object{{"format", "kinegraph-reference"},
                      {"schema", 1},
                      {"port_types", std::move(port_types)},
                      {"nodes", std::move(nodes)}};
}

}  // namespace kinegraph
