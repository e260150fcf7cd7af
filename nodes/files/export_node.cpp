#include <fmt/format.h>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/files/file_ports.h"
#include "nodes/files/formats.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/motion_file.h"

namespace kinegraph {
namespace {

WriteOptions write_options(const Params& params) {
  WriteOptions options;
  options.euler = params.text("euler");
  options.precision = static_cast<int>(params.integer("precision"));
  options.repair = params.boolean("repair");
  options.stretch = params.text("stretch");
  options.unit = params.json("unit");
  return options;
}

void export_file(Compute& compute) {
  const Params& params = compute.params();
  const std::string& path = params.text("file");
  if (path.empty()) throw Failure(error("no-file", "no file is named").hinting("set file").at_param("file"));
  std::vector<FileContent> contents;
  for (const FilePort& port : file_ports())
    if (auto values = compute.values(port.name); !values.empty())
      contents.push_back({std::string(port.name), values.front()});
  const EncodedFile file =
      encode_motion_file(path, params.text("format"), contents, write_options(params), compute.work());
  for (const auto& [name, bytes] : file.companions) compute.write_file("file", bytes, name);
  compute.write_file("file", file.bytes);
}

}  // namespace

NodeType export_node() {
  const WriteOptions defaults;
  NodeType type;
  type.name = "Export";
  type.code_version = 2;
  type.category = "files";
  type.help = "Writes a motion, points, a character or an analysis to a file, when it is asked to.";
  type.keywords = {"save", "write", "output", "bvh", "file"};
  type.effect = Effect::writes;
  for (const FilePort& port : file_ports())
    type.optional_input(std::string(port.name), {std::string(port.type)}, std::string(port.what));
  type.param("file", save_file().outside_key(), "The file to write.");
  std::vector<ParamType::Choice> formats = {{"auto", "By the file's ending."}};
  for (const WriteFormat& format : write_formats())
    formats.push_back({std::string(format.key), std::string(format.help)});
  type.param("format", choice(std::move(formats)), "The file's format.");
  std::vector<ParamType::Choice> orders = {{"source", "As the source file has it; ZYX without one."}};
  for (const char* order : {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"})
    orders.push_back({order, fmt::format("R = R{} R{} R{}", order[0], order[1], order[2])});
  type.param("euler", choice(std::move(orders)), "Order of a BVH's rotation channels.");
  type.param("precision", integer(defaults.precision).between(0, 17), "Decimals of numbers in text.");
  type.param("repair", boolean(false), "glTF: normalises weights and puts the skinned mesh at the root.");
  type.param("stretch",
             choice({{"keep", "Writes them: six channels in BVH, translations in glTF."},
                     {"error", "Fails where a bone's length varies."},
                     {"drop", "Puts joints back to their rest offsets."}}),
             "What to do with bone lengths that vary.");
  std::vector<ParamType::Choice> units = {
      {"source", "The unit of the file that the motion came from; metres without one."}};
  for (const LengthUnit& unit : known_units()) units.push_back({unit.name, to_text(unit)});
  type.param("unit", unit_of(std::move(units)), "The unit of the file's lengths; a number is metres.");
  type.resolve = [](Json::Object& params) { resolve_format(params, write_format_of); };
  type.misfits = [](const Params& params, const std::vector<std::string>& linked) {
    std::vector<Diagnostic> found;
    // Neither a file nor an input: told as such.
    if (params.text("file").empty() || linked.empty()) return found;
    if (auto objection = objection_to_writing(params.text("file"), params.text("format"), linked))
      found.push_back(std::move(*objection));
    return found;
  };
  type.also_writes = [](const Params& params) {
    const std::string& path = params.text("file");
    const std::string& named = params.text("format");
    std::vector<std::string> files;
    if (!path.empty() && (named == "auto" ? write_format_of(path) : named) == "gltf")
      files.push_back(path.substr(0, path.find_last_of('/') + 1) + gltf_buffer_name(path));
    return files;
  };
  type.compute = export_file;
  return type;
}

}  // namespace kinegraph
