#include "graph/evaluate/node_key.h"

#include <fmt/format.h>

#include <filesystem>

#include "graph/evaluate/caught.h"

namespace kinegraph {

namespace {

using Kind = ParamType::Kind;

// A parameter's value as its key sees it: files by a number that stands for their content, what never changes
// a result left out. Files found are appended.
std::optional<Json> keyed(const ParamType& type, const Json& value, const std::string& where,
                          const PlannedNode& node, std::vector<NodeFile>& files) {
  if (!type.in_key || type.kind == Kind::save_file) return std::nullopt;
  switch (type.kind) {
    case Kind::open_file: {
      if (!value.is_string() || value.string().empty()) return Json(nullptr);
      const auto shown = node.shown_paths.find(where);
      files.push_back(
          {value.string(), shown == node.shown_paths.end() ? value.string() : shown->second, where, {}});
      return Json(files.size());
    }
    case Kind::list:
    case Kind::tuple: {
      if (!value.is_array()) return value;
      Json::Array out;
      for (std::size_t i = 0; i < value.array().size(); ++i) {
        const auto& part = type.parts.at(type.kind == Kind::list ? 0 : i);
        out.push_back(
            keyed(part, value.array()[i], fmt::format("{}[{}]", where, i), node, files).value_or(nullptr));
      }
      return Json(std::move(out));
    }
    case Kind::object: {
      if (!value.is_object()) return value;
      Json::Object out;
      for (const auto& field : type.parts) {
        const auto* member = value.find(field.name);
        if (!member) continue;
        if (auto part = keyed(field, *member, where + "." + field.name, node, files)) out[field.name] = *part;
      }
      return Json(std::move(out));
    }
    case Kind::table: {
      if (!value.is_object()) return value;
      Json::Object out;
      for (const auto& [name, member] : value.object())
        out[name] = keyed(type.parts.at(0), member, where + "." + name, node, files).value_or(nullptr);
      return Json(std::move(out));
    }
    case Kind::either:
      for (const auto& part : type.parts)
        if (check(part, value, where).empty()) return keyed(part, value, where, node, files);
      return value;
    default:
      return value;
  }
}

// Companions are told as lying where the user would look for them: from the graph's folder.
std::string shown_from(const std::string& folder, const std::string& path) {
  const auto near = std::filesystem::path(path).lexically_proximate(folder).generic_string();
  return near.empty() || near.starts_with("../..") ? path : near;
}

}  // namespace

Key output_key(const Key& node, std::string_view port) {
  KeyMaker maker;
  maker.add("output of", node);
  maker.add("port", port);
  return maker.finish();
}

Key constant_key(std::string_view id) {
  KeyMaker maker;
  maker.add("constant", id);
  return maker.finish();
}

NodeKeys::NodeKeys(const Plan& plan, const Registry& registry, FileStore& files, std::string cpu_path,
                   std::function<void()> check)
    : plan_(plan),
      registry_(registry),
      files_(files),
      cpu_path_(std::move(cpu_path)),
      check_(std::move(check)),
      keys_(plan.nodes.size()),
      looked_(plan.nodes.size()) {}

std::optional<Key> NodeKeys::of(const Source& source) const {
  if (source.node < 0) return constant_key(source.constant_id);
  const auto& node = of(source.node).key;
  if (!node) return std::nullopt;
  return output_key(*node, source.port);
}

void NodeKeys::look_at_files(int index) {
  const auto& node = plan_.nodes[static_cast<std::size_t>(index)];
  auto& made = keys_[static_cast<std::size_t>(index)];
  if (node.type->companions) {
    for (const auto& path : node.type->companions(Params(node.params), files_))
      made.files.push_back({path, shown_from(plan_.folder, path), "", {}});
  }
  for (auto& file : made.files) {
    try {
      file.digest = files_.digest_of(file.path, {file.shown, check_, {}});
    } catch (const Failure&) {
      file.digest.reset();  // computing reads it again and says what is wrong
    }
  }
}

void NodeKeys::make(int index, bool look) {
  const auto& node = plan_.nodes[static_cast<std::size_t>(index)];
  auto& made = keys_[static_cast<std::size_t>(index)];
  made.key.reset();
  made.parts.clear();
  if (!node.type) return;
  const auto& type = *node.type;

  std::vector<NodeFile> files;
  KeyMaker maker;
  const auto part = [&](const std::string& what, std::string value) {
    made.parts.push_back({what, std::move(value)});
  };
  maker.add("type", type.name);
  part("type", type.name);
  maker.add_integer("code version", static_cast<std::uint64_t>(type.code_version));
  part("code version", std::to_string(type.code_version));
  if (!type.same_on_every_cpu) {
    maker.add("cpu", cpu_path_);
    part("cpu", cpu_path_);
  }
  std::map<std::string, Json> params;
  for (const auto& param : type.params) {
    const auto value = node.params.find(param.name);
    if (value == node.params.end()) continue;
    if (auto for_key = keyed(param, value->second, param.name, node, files))
      params[param.name] = std::move(*for_key);
  }
  for (const auto& [name, value] : params) {
    maker.add("param", name);
    maker.add("value", value);
    if (type.find_param(name)->kind != Kind::open_file) part("param " + name, compact(value));
  }

  if (look || !looked_[static_cast<std::size_t>(index)]) {
    made.files = std::move(files);
    made.failure.reset();
    looked_[static_cast<std::size_t>(index)] = true;
    try {
      look_at_files(index);
    } catch (const Cancelled&) {
      looked_[static_cast<std::size_t>(index)] = false;
      throw;
    } catch (...) {
      made.failure = caught();
    }
  }
  if (made.failure) return;
  for (const auto& file : made.files) {
    if (file.digest) {
      maker.add("file", *file.digest);
    } else {
      maker.add("file", "none");
    }
    part(file.param.empty() ? "companion " + file.shown : "file " + file.param,
         file.digest ? to_text(*file.digest) : "can't be read");
  }

  for (const auto& [port, sources] : node.inputs) {
    const auto* input = type.find_input(port);
    if (!input || sources.empty()) continue;
    maker.add("input", port);
    maker.add_integer("links", sources.size());
    for (const auto& source : sources) {
      const auto key = of(source);
      if (!key) return;
      maker.add("from", *key);
      part("input " + port, to_text(*key));
    }
  }
  made.key = maker.finish();
}

std::vector<int> in_order(const Plan& plan, const std::vector<int>& wanted) {
  enum class Mark : char { unseen, open, placed };
  std::vector<Mark> marks(plan.nodes.size(), Mark::unseen);
  std::vector<int> order, stack(wanted.rbegin(), wanted.rend());
  while (!stack.empty()) {
    const int index = stack.back();
    auto& mark = marks[static_cast<std::size_t>(index)];
    if (mark != Mark::unseen) {
      stack.pop_back();
      if (mark == Mark::open) order.push_back(index);
      mark = Mark::placed;
      continue;
    }
    mark = Mark::open;
    for (const auto& [port, sources] : plan.nodes[static_cast<std::size_t>(index)].inputs) {
      for (const auto& source : sources) {
        if (source.node < 0) continue;
        const auto before = marks[static_cast<std::size_t>(source.node)];
        if (before == Mark::open) {
          throw Failure(error("cycle", "the graph runs in a circle")
                            .at_node(plan.nodes[static_cast<std::size_t>(source.node)].name)
                            .hinting("take out one of its links"));
        }
        if (before == Mark::unseen) stack.push_back(source.node);
      }
    }
  }
  return order;
}

}  // namespace kinegraph
