// Builds a glTF file: JSON and one buffer. What comes from a source file is carried over byte for byte, only
// what is still referred to.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"
#include "graph/work.h"
#include "nodes/motion/character.h"

namespace kinegraph {

enum class GltfTarget { none = 0, vertices = 34962, indices = 34963 };

class GltfOut {
 public:
  Json root = Json::Object{};

  // The source's JSON stands in `root` and may have lost meshes, skins or animations since: lays out anew the
  // accessors and bufferViews that the rest refers to, and takes images of their own files into the buffer.
  // `set_targets`: bufferViews that lack a target get the one of their use. Call it before adding.
  void carry_over(const CharacterSource& source, bool set_targets);

  Json::Array& list(const char* name);  // of `root`, made where it is missing
  // Index of the new accessor. `type`: "SCALAR", "VEC3", "VEC4", "MAT4"; `bounds`: writes min and max.
  int add_floats(std::span<const float> values, const char* type, bool bounds,
                 GltfTarget target = GltfTarget::none);
  int add_indices(std::span<const std::uint32_t> values);
  int add_joints(std::span<const std::uint32_t> values);  // four a vertex, as 16 bits

  std::string glb(Work& work);
  // As text; its buffer goes beside it under `buffer_name`.
  std::string text(const std::string& buffer_name);
  const std::string& binary() const& { return binary_; }
  std::string binary() && { return std::move(binary_); }

 private:
  int add_view(std::string_view bytes, GltfTarget target);
  int add_accessor(int view, int component_type, std::size_t count, const char* type);
  void set_buffer(const std::string& uri);
  std::string binary_;
};

}  // namespace kinegraph
