#include "nodes/files/formats.h"

#include <algorithm>

#include "nodes/files/acclaim_motion.h"
#include "nodes/files/analysis_file.h"
#include "nodes/files/bvh_read.h"
#include "nodes/files/bvh_write.h"
#include "nodes/files/c3d.h"
#include "nodes/files/fbx_read.h"
#include "nodes/files/gltf_file.h"
#include "nodes/files/gltf_read.h"
#include "nodes/files/gltf_write.h"
#include "nodes/files/points_table.h"
#include "nodes/files/text_place.h"
#include "nodes/files/trc.h"

namespace kinegraph {

namespace {

MotionFile with_motion(Motion motion) {
  MotionFile file;
  file.contents.push_back({"motion", std::make_shared<const Motion>(std::move(motion))});
  return file;
}

MotionFile read_bvh_file(const FileToRead& file, Work& work) {
  return with_motion(read_bvh(file.bytes, file.options, work));
}

bool ends_with(std::string_view path, std::string_view ending) {
  return path.size() > ending.size() && path[path.size() - ending.size() - 1] == '.' &&
         lower_case(path.substr(path.size() - ending.size())) == ending;
}

std::string asf_of(const std::string& path, const ReadOptions& options, FileAccess& files) {
  return options.skeleton.empty() ? find_asf(path, files) : options.skeleton;
}

MotionFile read_acclaim_file(const FileToRead& file, Work& work) {
  if (ends_with(file.path, "asf"))
    return with_motion(acclaim_motion(read_asf(file.bytes, work), {}, file.options, work));
  const std::string asf_path = asf_of(file.path, file.options, file.files);
  const FileBytes asf = file.files.read(asf_path);
  AcclaimSkeleton skeleton;
  try {
    skeleton = read_asf(*asf, work);
  } catch (const Failure& failure) {
    Diagnostic problem = failure.diagnostic();
    problem.file = asf_path;
    throw Failure(problem);
  }
  if (file.bytes.empty()) throw Failure(error("bad-frame-number", "the file is empty"));
  MotionFile result = with_motion(acclaim_motion(skeleton, file.bytes, file.options, work));
  result.companions.push_back(asf_path);
  return result;
}

std::vector<std::string> acclaim_companions(const std::string& path, const ReadOptions& options,
                                            FileAccess& files) {
  if (ends_with(path, "asf")) return {};
  return {asf_of(path, options, files)};
}

MotionFile read_json_file(const FileToRead& file, Work& work) {
  AnalysisFile analysis = read_analysis(file.bytes, work);
  MotionFile result;
  result.contents.push_back({std::string(analysis.kind->port), analysis.value});
  return result;
}

EncodedFile write_bvh_file(const FileToWrite& file, Work& work) {
  return {write_bvh(dynamic_cast<const Motion&>(*file.contents.front().value), file.options, work), {}};
}

EncodedFile write_json_file(const FileToWrite& file, Work& work) {
  const FileContent& content = file.contents.front();
  return {write_analysis(*kind_of_port(content.port), *content.value, work), {}};
}

MotionFile with_points(Points points) {
  MotionFile file;
  file.contents.push_back({"points", std::make_shared<const Points>(std::move(points))});
  return file;
}

MotionFile read_c3d_file(const FileToRead& file, Work& work) {
  return with_points(read_c3d(file.bytes, file.options, work));
}
MotionFile read_trc_file(const FileToRead& file, Work& work) {
  return with_points(read_trc(file.bytes, file.options, work));
}
MotionFile read_csv_file(const FileToRead& file, Work& work) {
  return with_points(read_points_table(file.bytes, file.options, work));
}

MotionFile with_contents(GltfContents gltf) {
  MotionFile result = with_motion(std::move(gltf.motion));
  if (gltf.character) result.contents.push_back({"character", gltf.character});
  result.companions = gltf.companions;
  return result;
}

MotionFile read_gltf_contents(const FileToRead& file, Work& work) {
  return with_contents(read_gltf(file.bytes, file.path, file.options, file.files, work));
}
MotionFile read_fbx_file(const FileToRead& file, Work& work) {
  return with_contents(read_fbx(file.bytes, file.options, file.files, work));
}

std::vector<std::string> companions_of_gltf(const std::string& path, const ReadOptions&, FileAccess& files) {
  if (!files.exists(path)) return {};
  const FileBytes bytes = files.read(path);
  try {
    return gltf_companions(*bytes, path);
  } catch (const Failure& failure) {
    Diagnostic problem = failure.diagnostic();
    problem.file = path;
    throw Failure(problem);
  }
}

const Points& points_of(const FileToWrite& file) {
  return dynamic_cast<const Points&>(*file.contents.front().value);
}

EncodedFile write_c3d_file(const FileToWrite& file, Work& work) {
  return {write_c3d(points_of(file), file.options, work), {}};
}
EncodedFile write_trc_file(const FileToWrite& file, Work& work) {
  const std::size_t folder = file.path.find_last_of('/');
  return {write_trc(points_of(file), file.path.substr(folder + 1), file.options, work), {}};
}

GltfOut gltf_to_write(const FileToWrite& file, Work& work) {
  const Motion* motion = nullptr;
  const Character* character = nullptr;
  for (const FileContent& content : file.contents) {
    if (content.port == "motion") motion = dynamic_cast<const Motion*>(content.value.get());
    if (content.port == "character") character = dynamic_cast<const Character*>(content.value.get());
  }
  return gltf_of(motion, character, file.options, work);
}

EncodedFile write_glb_file(const FileToWrite& file, Work& work) {
  return {gltf_to_write(file, work).glb(work), {}};
}

EncodedFile write_gltf_file(const FileToWrite& file, Work& work) {
  GltfOut out = gltf_to_write(file, work);
  const std::string name = gltf_buffer_name(file.path);
  std::string text = out.text(name);
  return {std::move(text), {{name, std::move(out).binary()}}};
}

EncodedFile write_csv_file(const FileToWrite& file, Work& work) {
  const FileContent& content = file.contents.front();
  if (content.port == "points") return {write_points_table(points_of(file), work), {}};
  return {kind_of_port(content.port)->to_csv(*content.value, work), {}};
}

std::vector<std::string_view> analysis_ports() {
  std::vector<std::string_view> ports;
  for (const AnalysisKind& kind : analysis_kinds()) ports.push_back(kind.port);
  return ports;
}

std::vector<std::string_view> table_ports() {
  std::vector<std::string_view> ports = analysis_ports();
  ports.push_back("points");
  return ports;
}

template <class Format>
std::string format_of(const std::vector<Format>& formats, std::string_view path) {
  for (const Format& format : formats)
    for (std::string_view ending : format.endings)
      if (ends_with(path, ending)) return std::string(format.key);
  return {};
}

}  // namespace

const std::vector<ReadFormat>& read_formats() {
  static const std::vector<ReadFormat> formats = {
      {"bvh", "Biovision hierarchy", {"bvh"}, read_bvh_file},
      {"asf-amc", "Acclaim skeleton and motion", {"amc", "asf"}, read_acclaim_file, acclaim_companions},
      {"gltf", "glTF 2.0, text or binary", {"glb", "gltf"}, read_gltf_contents, companions_of_gltf},
      {"c3d", "C3D markers", {"c3d"}, read_c3d_file},
      {"trc", "TRC markers", {"trc"}, read_trc_file},
      {"csv", "Points as a table", {"csv"}, read_csv_file},
      {"json", "An analysis that Export wrote", {"json"}, read_json_file},
      {"fbx", "FBX: skeleton, animation, skin", {"fbx"}, read_fbx_file},
  };
  return formats;
}

const std::vector<WriteFormat>& write_formats() {
  static const std::vector<WriteFormat> formats = {
      {"bvh", "Biovision hierarchy", {"bvh"}, {"motion"}, write_bvh_file},
      {"glb", "glTF 2.0, one binary file", {"glb"}, {"motion", "character"}, write_glb_file},
      {"gltf",
       "glTF 2.0, text with its buffer beside it",
       {"gltf"},
       {"motion", "character"},
       write_gltf_file},
      {"c3d", "C3D markers", {"c3d"}, {"points"}, write_c3d_file},
      {"trc", "TRC markers", {"trc"}, {"points"}, write_trc_file},
      {"csv", "A table", {"csv"}, table_ports(), write_csv_file},
      {"json", "An analysis, without loss", {"json"}, analysis_ports(), write_json_file},
  };
  return formats;
}

std::string read_format_of(std::string_view path) {
  return format_of(read_formats(), path);
}
std::string write_format_of(std::string_view path) {
  return format_of(write_formats(), path);
}

void resolve_format(Json::Object& params, std::string (*format_of)(std::string_view path)) {
  const auto format = params.find("format"), file = params.find("file");
  if (format == params.end() || file == params.end() || !format->second.is_string() ||
      !file->second.is_string() || format->second.string() != "auto")
    return;
  const std::string found = format_of(file->second.string());
  if (!found.empty()) format->second = found;
}

std::string gltf_buffer_name(std::string_view path) {
  std::string_view name = path.substr(path.find_last_of('/') + 1);
  if (const std::size_t dot = name.find_last_of('.'); dot != std::string_view::npos && dot > 0)
    name = name.substr(0, dot);
  return std::string(name) + ".bin";
}

}  // namespace kinegraph
