#include "nodes/files/gltf_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "graph/file/parse_json.h"
#include "nodes/files/text_place.h"

namespace kinegraph {

namespace {

std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}
void put_u32(std::string& out, std::size_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> 8 * i & 0xFF);
}

bool is_glb(std::string_view bytes) {
  return bytes.substr(0, 4) == "glTF";
}

// %20 and the like.
std::string decoded_uri(std::string_view uri) {
  std::string out;
  auto digit = [](char c) { return c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10; };
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
        std::isxdigit(static_cast<unsigned char>(uri[i + 2]))) {
      out += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
      i += 2;
    } else {
      out += uri[i];
    }
  }
  return out;
}

bool is_plain_uri(const Json* uri) {
  return uri && uri->is_string() && uri->string().compare(0, 5, "data:") != 0 &&
         uri->string().find("://") == std::string::npos;
}

std::string beside(const std::string& path, std::string_view uri) {
  return (std::filesystem::path(path).parent_path() / decoded_uri(uri)).lexically_normal().string();
}

Json json_of_gltf(std::string_view text) {
  Diagnostics problems;
  Json json = parse_json(text, "", problems);
  for (const Diagnostic& problem : problems)
    if (problem.severity == Severity::error) throw Failure(problem);
  if (!json.is_object()) bad_gltf("the JSON is no object");
  return json;
}

template <class Each>
void each_uri(const Json& json, std::string_view list, Each each) {
  const Json* all = json.find(list);
  if (!all || !all->is_array()) return;
  for (const Json& one : all->array())
    if (const Json* uri = one.find("uri"); is_plain_uri(uri)) each(uri->string());
}

struct Reader {
  FileAccess& files;
  std::exception_ptr failure;
};

bool read_whole(std::vector<unsigned char>* out, std::string* problem, const std::string& path, void* data) {
  Reader& reader = *static_cast<Reader*>(data);
  try {
    const FileBytes bytes = reader.files.read(std::filesystem::path(path).lexically_normal().string());
    out->assign(bytes->begin(), bytes->end());
    return true;
  } catch (...) {
    reader.failure = std::current_exception();
    *problem = "unreadable";
    return false;
  }
}

bool keep_image_undecoded(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                          const unsigned char*, int, void*) {
  return true;
}

}  // namespace

void bad_gltf(std::string what) {
  throw Failure(error("bad-gltf", std::move(what)).hinting("check the file with Khronos' glTF validator"));
}

std::string_view gltf_json_of(std::string_view bytes) {
  if (!is_glb(bytes)) {
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
    if (trimmed(bytes).substr(0, 1) != "{")
      throw Failure(
          error("not-gltf", "the file begins neither with { as a .gltf does nor with glTF as a .glb")
              .hinting("check whether the file is whole and a glTF"));
    return bytes;
  }
  if (bytes.size() < 20) throw Failure(error("truncated", "the file ends within its header"));
  if (u32_at(bytes, 4) != 2) bad_gltf(fmt::format("the file is glTF {}, not 2", u32_at(bytes, 4)));
  const std::size_t length = u32_at(bytes, 12);
  if (u32_at(bytes, 8) > bytes.size() || length > bytes.size() - 20)
    throw Failure(
        error("truncated", fmt::format("the file has {} bytes and says {}", bytes.size(), u32_at(bytes, 8)))
            .hinting("check whether the file is whole"));
  if (bytes.substr(16, 4) != "JSON") bad_gltf("the file doesn't begin with JSON");
  return bytes.substr(20, length);
}

std::string glb_of(std::string json, std::string_view binary, Work& work) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t length = (binary.size() + 3) / 4 * 4,
                    whole = 20 + json.size() + (length > 0 ? 8 + length : 0);
  std::string out = "glTF";
  out.reserve(whole);
  put_u32(out, 2);
  put_u32(out, whole);
  put_u32(out, json.size());
  out += "JSON" + json;
  if (binary.empty()) return out;
  put_u32(out, length);
  out += std::string_view("BIN\0", 4);
  constexpr std::size_t piece = std::size_t{1} << 20;
  for (std::size_t at = 0; at < binary.size(); at += piece) {
    work.check();
    out += binary.substr(at, piece);
  }
  out.resize(whole, '\0');
  return out;
}

std::vector<std::string> gltf_companions(std::string_view bytes, const std::string& path) {
  const Json json = json_of_gltf(gltf_json_of(bytes));
  std::vector<std::string> all;
  for (std::string_view list : {"buffers", "images"})
    each_uri(json, list, [&](const std::string& uri) {
      std::string file = beside(path, uri);
      if (std::find(all.begin(), all.end(), file) == all.end()) all.push_back(std::move(file));
    });
  return all;
}

GltfFile read_gltf_file(std::string_view bytes, const std::string& path, FileAccess& files) {
  GltfFile file;
  file.json = gltf_json_of(bytes);
  const Json json = json_of_gltf(file.json);
  file.companions = gltf_companions(bytes, path);
  each_uri(json, "images",
           [&](const std::string& uri) { file.images.emplace_back(uri, *files.read(beside(path, uri))); });
  Reader reader{files, {}};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(
      {[](const std::string&, void*) { return true; }, [](const std::string& name, void*) { return name; },
       read_whole,
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; },
       &reader});
  loader.SetImageLoader(keep_image_undecoded, nullptr);
  auto model = std::make_shared<tinygltf::Model>();
  std::string problem, told;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  bool read = false;
  try {
    read = is_glb(bytes) ? loader.LoadBinaryFromMemory(model.get(), &problem, &told,
                                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                                       static_cast<unsigned>(bytes.size()), folder)
                         : loader.LoadASCIIFromString(model.get(), &problem, &told, file.json.data(),
                                                      static_cast<unsigned>(file.json.size()), folder);
  } catch (const std::exception& thrown) {
    bad_gltf(thrown.what());
  }
  if (reader.failure) std::rethrow_exception(reader.failure);
  if (!read) {
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    bad_gltf(problem.empty() ? "the file can't be parsed" : problem);
  }
  for (tinygltf::Buffer& buffer : model->buffers) {
    file.buffers.emplace_back(buffer.data.begin(), buffer.data.end());
    std::vector<unsigned char>().swap(buffer.data);  // held once
  }
  file.model = std::move(model);
  return file;
}

namespace {

struct Numbers {  // where numbers lie in a buffer
  std::string_view bytes;
  std::size_t stride = 0, width = 0;
  int type = 0;
};

// `count` elements of `components` numbers from a view; throws where they don't fit.
Numbers numbers_in(const GltfFile& file, int view_index, std::size_t offset, std::size_t count,
                   std::size_t components, int type, int accessor) {
  const tinygltf::Model& model = *file.model;
  auto refuse = [&](const char* what) { bad_gltf(fmt::format("accessor {} {}", accessor, what)); };
  if (view_index < 0 || view_index >= static_cast<int>(model.bufferViews.size()))
    refuse("names no bufferView that is there");
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  if (view.buffer < 0 || view.buffer >= static_cast<int>(file.buffers.size())) refuse("lies in no buffer");
  const std::string& buffer = file.buffers[static_cast<std::size_t>(view.buffer)];
  const int width = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
  if (width < 1 || type == TINYGLTF_COMPONENT_TYPE_DOUBLE) refuse("has an unknown component type");
  Numbers numbers;
  numbers.width = static_cast<std::size_t>(width);
  numbers.type = type;
  const std::size_t element = numbers.width * components;
  numbers.stride = view.byteStride ? view.byteStride : element;
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
    refuse("lies outside its buffer");
  if (offset > view.byteLength) refuse("lies outside its bufferView");
  numbers.bytes = std::string_view(buffer).substr(view.byteOffset + offset, view.byteLength - offset);
  if (count > 0 &&
      (numbers.bytes.size() < element || (count - 1) > (numbers.bytes.size() - element) / numbers.stride))
    refuse("is longer than its bufferView");
  return numbers;
}

template <class T>
double at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double number_at(const Numbers& numbers, std::size_t element, std::size_t component, bool normalized) {
  const char* bytes = numbers.bytes.data() + element * numbers.stride + component * numbers.width;
  auto over = [&](double value, double most) { return normalized ? std::max(value / most, -1.0) : value; };
  switch (numbers.type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return over(at<std::int8_t>(bytes), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return over(at<std::uint8_t>(bytes), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return over(at<std::int16_t>(bytes), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return over(at<std::uint16_t>(bytes), 65535);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return at<std::int32_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return at<std::uint32_t>(bytes);
    default:
      return at<float>(bytes);
  }
}

const tinygltf::Accessor& accessor_at(const GltfFile& file, int index) {
  if (index < 0 || index >= static_cast<int>(file.model->accessors.size()))
    bad_gltf(fmt::format("there is no accessor {}", index));
  return file.model->accessors[static_cast<std::size_t>(index)];
}

}  // namespace

std::size_t gltf_count(const GltfFile& file, int index) {
  return accessor_at(file, index).count;
}

std::vector<double> gltf_numbers(const GltfFile& file, int index, int components) {
  const tinygltf::Accessor& accessor = accessor_at(file, index);
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
    bad_gltf(fmt::format("accessor {} has not {} components", index, components));
  if (accessor.count > (std::size_t{1} << 31) / static_cast<std::size_t>(components))
    bad_gltf(fmt::format("accessor {} says {} elements", index, accessor.count));
  const auto width = static_cast<std::size_t>(components);
  const bool fill = accessor.bufferView < 0;
  if (fill && accessor.count > (std::size_t{1} << 24))
    bad_gltf(fmt::format("accessor {} has {} elements and no data", index, accessor.count));
  std::vector<double> values;
  if (fill) {
    values.resize(accessor.count * width);
  } else {
    const Numbers numbers = numbers_in(file, accessor.bufferView, accessor.byteOffset, accessor.count, width,
                                       accessor.componentType, index);
    values.reserve(accessor.count * width);
    for (std::size_t i = 0; i < accessor.count; ++i)
      for (std::size_t k = 0; k < width; ++k) values.push_back(number_at(numbers, i, k, accessor.normalized));
  }
  if (accessor.sparse.isSparse) {
    const auto count = static_cast<std::size_t>(std::max(accessor.sparse.count, 0));
    const Numbers where = numbers_in(file, accessor.sparse.indices.bufferView,
                                     static_cast<std::size_t>(accessor.sparse.indices.byteOffset), count, 1,
                                     accessor.sparse.indices.componentType, index);
    const Numbers what = numbers_in(file, accessor.sparse.values.bufferView,
                                    static_cast<std::size_t>(accessor.sparse.values.byteOffset), count, width,
                                    accessor.componentType, index);
    for (std::size_t i = 0; i < count; ++i) {
      const double element = number_at(where, i, 0, false);
      if (!(element >= 0) || element >= static_cast<double>(accessor.count))
        bad_gltf(fmt::format("accessor {} has a sparse entry for element {:g}", index, element));
      for (std::size_t k = 0; k < width; ++k)
        values[static_cast<std::size_t>(element) * width + k] = number_at(what, i, k, accessor.normalized);
    }
  }
  return values;
}

}  // namespace kinegraph
