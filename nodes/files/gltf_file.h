// A glTF file as bytes: its JSON, its buffers, the files beside it; and the numbers of its accessors.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "graph/compute.h"
#include "graph/json.h"
#include "graph/work.h"
#include "nodes/motion/character.h"

namespace tinygltf {
class Model;
}

namespace kinegraph {

struct GltfFile {
  std::shared_ptr<const tinygltf::Model> model;
  std::string json;
  std::vector<std::string> buffers;                         // in the file's order, whole
  std::vector<std::pair<std::string, std::string>> images;  // of their own files: uri, bytes
  std::vector<std::string> companions;                      // absolute paths that were read
};

// GLB or text. Buffers may be embedded, beside the file, or the GLB's own. Images are carried, never decoded.
// Throws Failure ("bad-gltf", "truncated", and what reading a companion throws).
GltfFile read_gltf_file(std::string_view bytes, const std::string& path, FileAccess& files);
// The files that one will read, absolute: buffers and images with a plain uri.
std::vector<std::string> gltf_companions(std::string_view bytes, const std::string& path);

// The JSON of a GLB or of a text file. Throws Failure ("bad-gltf").
std::string_view gltf_json_of(std::string_view bytes);
// A GLB of a JSON text and the bytes of buffer 0.
std::string glb_of(std::string json, std::string_view binary, Work& work);

// All numbers of an accessor, `components` an element: normalised where it says so, sparse entries put in,
// strides followed. Throws Failure ("bad-gltf") naming the accessor where it leads out of its buffer or has
// another number of components.
std::vector<double> gltf_numbers(const GltfFile& file, int accessor, int components);
std::size_t gltf_count(const GltfFile& file, int accessor);

[[noreturn]] void bad_gltf(std::string what);

}  // namespace kinegraph
