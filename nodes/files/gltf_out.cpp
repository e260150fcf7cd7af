#include "nodes/files/gltf_out.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "nodes/files/gltf_file.h"

namespace kinegraph {

namespace {

constexpr int type_u16 = 5123, type_u32 = 5125, type_float = 5126;

std::size_t components_of(std::string_view type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "MAT4" ? 16 : 4;
}

Json* member_of(Json& object, std::string_view key) {
  if (!object.is_object()) return nullptr;
  auto found = object.object().find(key);
  return found == object.object().end() ? nullptr : &found->second;
}

template <class Each>
void each_of(Json& object, std::string_view key, Each each) {
  if (Json* list = member_of(object, key); list && list->is_array())
    for (Json& one : list->array()) each(one);
}

template <class Each>
void each_member(Json* object, Each each) {
  if (object && object->is_object())
    for (auto& [name, value] : object->object()) each(value);
}

// Calls use(index, target) on every place that names an accessor.
template <class Use>
void each_accessor(Json& root, Use use) {
  auto one = [&](Json* index, GltfTarget target) {
    if (index && index->is_number()) use(*index, target);
  };
  each_of(root, "meshes", [&](Json& mesh) {
    each_of(mesh, "primitives", [&](Json& primitive) {
      each_member(member_of(primitive, "attributes"),
                  [&](Json& index) { one(&index, GltfTarget::vertices); });
      one(member_of(primitive, "indices"), GltfTarget::indices);
      each_of(primitive, "targets", [&](Json& morph) {
        each_member(&morph, [&](Json& index) { one(&index, GltfTarget::vertices); });
      });
    });
  });
  each_of(root, "nodes", [&](Json& node) {
    if (Json* extensions = member_of(node, "extensions"))
      if (Json* instances = member_of(*extensions, "EXT_mesh_gpu_instancing"))
        each_member(member_of(*instances, "attributes"), [&](Json& index) { one(&index, GltfTarget::none); });
  });
  each_of(root, "skins", [&](Json& skin) { one(member_of(skin, "inverseBindMatrices"), GltfTarget::none); });
  each_of(root, "animations", [&](Json& animation) {
    each_of(animation, "samplers", [&](Json& sampler) {
      one(member_of(sampler, "input"), GltfTarget::none);
      one(member_of(sampler, "output"), GltfTarget::none);
    });
  });
}

// And on every place that names a bufferView.
template <class Use>
void each_view(Json& root, Use use) {
  auto one = [&](Json& object) {
    if (Json* index = member_of(object, "bufferView"); index && index->is_number()) use(*index);
  };
  each_of(root, "accessors", [&](Json& accessor) {
    one(accessor);
    if (Json* sparse = member_of(accessor, "sparse"))
      for (const char* part : {"indices", "values"})
        if (Json* place = member_of(*sparse, part)) one(*place);
  });
  each_of(root, "images", one);
  each_of(root, "meshes", [&](Json& mesh) {
    each_of(mesh, "primitives", [&](Json& primitive) {
      if (Json* extensions = member_of(primitive, "extensions"))
        each_member(extensions, [&](Json& extension) { one(extension); });
    });
  });
}

// Keeps the elements of a list that are used, in their order; returns where each went.
std::map<std::size_t, int> keep_used(Json& root, const char* name, const std::set<std::size_t>& used) {
  std::map<std::size_t, int> now;
  Json* list = member_of(root, name);
  Json::Array kept;
  if (list && list->is_array())
    for (std::size_t index : used)
      if (index < list->array().size()) {
        now[index] = static_cast<int>(kept.size());
        kept.push_back(std::move(list->array()[index]));
      }
  if (kept.empty()) {
    root.object().erase(name);
  } else {
    *list = std::move(kept);
  }
  return now;
}

std::size_t index_of(const Json& number) {
  return number.number() < 0 ? static_cast<std::size_t>(-1) : static_cast<std::size_t>(number.number());
}

std::size_t size_member(Json& object, std::string_view key) {
  const Json* value = member_of(object, key);
  return value && value->is_number() && value->number() > 0 ? static_cast<std::size_t>(value->number()) : 0;
}

std::string mime_type(std::string_view bytes) {
  return bytes.substr(0, 3) == "\xFF\xD8\xFF" ? "image/jpeg" : "image/png";
}

}  // namespace

void GltfOut::carry_over(const CharacterSource& source, bool set_targets) {
  std::set<std::size_t> accessors, views;
  each_accessor(root, [&](Json& index, GltfTarget) { accessors.insert(index_of(index)); });
  const std::map<std::size_t, int> accessor_now = keep_used(root, "accessors", accessors);
  each_accessor(root, [&](Json& index, GltfTarget) {
    auto found = accessor_now.find(index_of(index));
    if (found == accessor_now.end()) bad_gltf("the source refers to an accessor that isn't there");
    index = found->second;
  });
  each_view(root, [&](Json& index) { views.insert(index_of(index)); });
  const std::map<std::size_t, int> view_now = keep_used(root, "bufferViews", views);
  each_view(root, [&](Json& index) {
    auto found = view_now.find(index_of(index));
    if (found == view_now.end()) bad_gltf("the source refers to a bufferView that isn't there");
    index = found->second;
  });
  each_of(root, "bufferViews", [&](Json& view) {
    const std::size_t buffer = size_member(view, "buffer"), offset = size_member(view, "byteOffset"),
                      length = size_member(view, "byteLength");
    if (buffer >= source.buffers.size() || offset > source.buffers[buffer].size() ||
        length > source.buffers[buffer].size() - offset)
      bad_gltf("a bufferView of the source lies outside its buffer");
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    view.object()["buffer"] = 0;
    view.object()["byteOffset"] = binary_.size();
    binary_.append(source.buffers[buffer], offset, length);
  });
  if (set_targets)
    each_accessor(root, [&](Json& index, GltfTarget target) {
      Json& accessor = list("accessors")[index_of(index)];
      Json* view = member_of(accessor, "bufferView");
      if (target == GltfTarget::none || !view) return;
      list("bufferViews")[index_of(*view)].object().emplace("target", static_cast<int>(target));
    });
  each_of(root, "images", [&](Json& image) {
    const Json* uri = member_of(image, "uri");
    if (!uri || !uri->is_string()) return;
    for (const auto& [name, bytes] : source.files)
      if (name == uri->string()) {
        image.object()["mimeType"] = mime_type(bytes);
        image.object()["bufferView"] = add_view(bytes, GltfTarget::none);
        image.object().erase("uri");
        return;
      }
  });
}

Json::Array& GltfOut::list(const char* name) {
  Json& json = root.object()[name];
  if (!json.is_array()) json = Json::Array{};
  return json.array();
}

int GltfOut::add_view(std::string_view bytes, GltfTarget target) {
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  Json::Object view;
  view["buffer"] = 0;
  view["byteOffset"] = binary_.size();
  view["byteLength"] = bytes.size();
  if (target != GltfTarget::none) view["target"] = static_cast<int>(target);
  binary_ += bytes;
  list("bufferViews").push_back(std::move(view));
  return static_cast<int>(list("bufferViews").size()) - 1;
}

int GltfOut::add_accessor(int view, int component_type, std::size_t count, const char* type) {
  Json::Object accessor;
  accessor["bufferView"] = view;
  accessor["componentType"] = component_type;
  accessor["count"] = count;
  accessor["type"] = type;
  list("accessors").push_back(std::move(accessor));
  return static_cast<int>(list("accessors").size()) - 1;
}

namespace {

// Little-endian, whatever the machine.
template <class T>
std::string bytes_of(std::span<const T> values) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(T));
  for (T value : values) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof value);
    for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>(bits >> 8 * i & 0xFF);
  }
  return bytes;
}

}  // namespace

int GltfOut::add_floats(std::span<const float> values, const char* type, bool bounds, GltfTarget target) {
  const std::size_t width = components_of(type);
  const int accessor =
      add_accessor(add_view(bytes_of(values), target), type_float, values.size() / width, type);
  if (!bounds || values.empty()) return accessor;
  Json::Array low, high;
  for (std::size_t k = 0; k < width; ++k) {
    float least = values[k], most = values[k];
    for (std::size_t i = k; i < values.size(); i += width) {
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
    }
    low.push_back(static_cast<double>(least));
    high.push_back(static_cast<double>(most));
  }
  list("accessors").back().object()["min"] = std::move(low);
  list("accessors").back().object()["max"] = std::move(high);
  return accessor;
}

int GltfOut::add_indices(std::span<const std::uint32_t> values) {
  return add_accessor(add_view(bytes_of(values), GltfTarget::indices), type_u32, values.size(), "SCALAR");
}

int GltfOut::add_joints(std::span<const std::uint32_t> values) {
  std::vector<std::uint16_t> narrow(values.begin(), values.end());
  return add_accessor(add_view(bytes_of(std::span<const std::uint16_t>(narrow)), GltfTarget::vertices),
                      type_u16, values.size() / 4, "VEC4");
}

void GltfOut::set_buffer(const std::string& uri) {
  for (const char* name : {"accessors", "bufferViews", "nodes", "skins", "meshes", "animations", "images"}) {
    auto found = root.object().find(name);
    if (found != root.object().end() && found->second.is_array() && found->second.array().empty())
      root.object().erase(found);
  }
  root.object().erase("buffers");
  if (binary_.empty()) return;
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  Json::Object buffer;
  buffer["byteLength"] = binary_.size();
  if (!uri.empty()) buffer["uri"] = uri;
  root.object()["buffers"] = Json::Array{std::move(buffer)};
}

std::string GltfOut::glb(Work& work) {
  set_buffer("");
  return glb_of(compact(root, true), binary_, work);
}

std::string GltfOut::text(const std::string& buffer_name) {
  std::string uri;
  for (char c : buffer_name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= '0' && byte <= '9') || ((byte | 0x20) >= 'a' && (byte | 0x20) <= 'z') ||
                       byte >= 0x80 || c == '-' || c == '_' || c == '.';
    if (plain) {
      uri += c;
    } else {
      uri += '%';
      uri += "0123456789ABCDEF"[byte >> 4];
      uri += "0123456789ABCDEF"[byte & 15];
    }
  }
  set_buffer(uri);
  return compact(root, true) + '\n';
}

}  // namespace kinegraph
