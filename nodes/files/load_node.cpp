#include <fmt/format.h>

#include <algorithm>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/files/file_ports.h"
#include "nodes/files/formats.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/motion_file.h"

namespace kinegraph {
namespace {

ReadOptions read_options(const Params& params) {
  ReadOptions options;
  options.format = params.text("format");
  options.skeleton = params.text("skeleton");
  options.clip = params.text("clip");
  options.range = params.range("range");
  options.rate = params.number("rate");
  options.fps = params.number("fps");
  options.drop_rest_frame = params.text("rest_frame") == "drop";
  options.unit = params.json("unit");
  options.up = params.text("up");
  options.max_gap = params.integer("max_gap");
  return options;
}

void load(Compute& compute) {
  const Params& params = compute.params();
  if (params.text("file").empty())
    throw Failure(error("no-file", "no file is named").hinting("set file").at_param("file"));
  const MotionFile file =
      read_motion_file(params.text("file"), read_options(params), compute.files(), compute.work());
  for (const FileContent& content : file.contents) compute.set_output(content.port, content.value);
  const auto is_found = [&](const FilePort& port) {
    return compute.wanted(port.name) && file.find(port.name) != nullptr;
  };
  // Whoever wants all there is gets that; of a link to what isn't there its taker says so.
  if (std::any_of(file_ports().begin(), file_ports().end(), is_found)) return;
  for (const FilePort& port : file_ports())
    if (compute.wanted(port.name))
      throw Failure(error("no-such-content", fmt::format("the file holds {}, no {}", file.ports(), port.name))
                        .hinting("link what the file holds")
                        .at_port(std::string(port.name)));
}

}  // namespace

NodeType load_node() {
  const ReadOptions defaults;
  NodeType type;
  type.name = "Load";
  type.category = "files";
  type.code_version = 4;
  type.help = "Reads a motion, points, a character or an analysis from a file.";
  type.keywords = {"open", "read", "import", "clip", "bvh", "amc", "file"};
  for (const FilePort& port : file_ports())
    type.output(std::string(port.name), std::string(port.type), std::string(port.what));
  type.param("file", open_file(), "The file to read.");
  std::vector<ParamType::Choice> formats = {{"auto", "By the file's ending, else by its content."}};
  for (const ReadFormat& format : read_formats())
    formats.push_back({std::string(format.key), std::string(format.help)});
  type.param("format", choice(std::move(formats)), "The file's format.");
  type.param("skeleton", open_file(),
             "The .asf of an .amc. Empty: of the same name, else of the name up to its last _, else the "
             "folder's only one.");
  type.param("clip", text(""),
             "Of a glTF or FBX with several animations: a name, else an index from 0. Empty: the first.");
  type.param("range", range(), "The file's frames to keep, from the first up to but without the second.");
  type.param("rate", number(defaults.rate).between(0.001, 100000).in("frames/s").slider(24, 240),
             "Frames a second of a file that doesn't say, such as .amc.");
  type.param("fps", number(0).between(0, 100000).in("frames/s").slider(0, 240),
             "Resamples to this rate; 0 = as it is.");
  type.param("rest_frame",
             choice({{"keep", "Frame 0 is motion like any other."},
                     {"drop", "Leaves out frame 0: converters of CMU files put a T-pose there."}}),
             "What to do with the file's frame 0.");
  std::vector<ParamType::Choice> units = {
      {"auto", "What the file says; else the unit that brings the rest pose nearest to 1.7 m."}};
  for (const LengthUnit& unit : known_units()) units.push_back({unit.name, to_text(unit)});
  type.param("unit", unit_of(std::move(units)), "The unit of the file's lengths; a number is metres.");
  type.param("up",
             choice({{"auto", "What the file says, else Y."}, {"y", "Y points up."}, {"z", "Z points up."}}),
             "The axis that points up in the file.");
  type.param("max_gap", integer(defaults.max_gap).between(0, 1e9).in("frames").slider(0, 60),
             "Missing markers are filled over gaps of up to so many frames.");
  type.companions = [](const Params& params, FileAccess& files) {
    // A skeleton that is named is a file of its own parameter.
    if (!params.text("skeleton").empty()) return std::vector<std::string>{};
    return companions_of(params.text("file"), read_options(params), files);
  };
  type.resolve = [](Json::Object& params) { resolve_format(params, read_format_of); };
  type.compute = load;
  return type;
}

}  // namespace kinegraph
