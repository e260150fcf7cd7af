#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "graph/evaluate/file_store.h"
#include "graph/file/write.h"
#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/loaded_file.h"
#include "nodes/files/formats.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/motion_file.h"

namespace kinegraph {

namespace {

// As a node's parameter of that name would take it.
Json unit_param(const Program& program, const char* type, const std::string& text, const char* option) {
  const Param& param = *program.registry.find(type)->find_param("unit");
  if (text.empty()) return *param.fallback;
  try {
    Json value = parse_value(param, text);
    for (const Diagnostic& problem : check(param, value, option))
      if (problem.severity == Severity::error) throw Failure(problem);
    return value;
  } catch (const Failure& failure) {
    throw UsageError(failure.diagnostic());
  }
}

// Lengths would be metres, whatever is asked for.
void refuse_unit_of_format(const Json& unit, const ConvertArguments& arguments) {
  const std::string format = write_format_of(arguments.out);
  if (arguments.out_unit.empty() || format.empty() || format == "bvh") return;
  const LengthUnit wanted = unit_from_param(unit, {0, "source"});
  if (format == "c3d" || format == "trc") {
    if (!wanted.name.empty()) return;
    throw UsageError(
        Diagnostic(error("no-unit", fmt::format("--out-unit {}: files of the format {} name their unit, "
                                                "and this one has no name",
                                                arguments.out_unit, format))
                       .hinting("name one: m, cm, mm, in, cmu; or write bvh, which says none")));
  }
  if (wanted.metres == 1) return;
  throw UsageError(
      Diagnostic(error("no-unit", fmt::format("--out-unit {}: lengths in files of the format {} are metres",
                                              arguments.out_unit, format))
                     .hinting("leave --out-unit out, or write a format that has a unit: bvh, c3d, trc")));
}

// As a run refuses to write onto what it reads: the one that was captured would be gone.
void refuse_onto_input(const std::vector<std::string>& read, const std::string& written) {
  for (const std::string& path : read) {
    std::error_code missing;
    if (!std::filesystem::equivalent(path, written, missing) || missing) continue;
    throw Failure(error("writes-onto-input", "'" + written + "' is a file that this reads")
                      .hinting("name another one to write"));
  }
}

}  // namespace

int convert_command(const Program& program, const ConvertArguments& arguments) {
  namespace fs = std::filesystem;
  FileStore files;
  Alone work;
  ReadOptions read;
  read.fps = arguments.fps;
  read.unit = unit_param(program, "Load", arguments.unit, "--unit");
  WriteOptions write;
  write.unit = unit_param(program, "Export", arguments.out_unit, "--out-unit");
  refuse_unit_of_format(write.unit, arguments);
  const std::string in = absolute_path(arguments.in), out = absolute_path(arguments.out);
  files.allow(in);
  EncodedFile encoded;
  try {
    const MotionFile file = read_motion_file(in, read, files, work);
    encoded = encode_motion_file(out, "auto", contents_for(out, file.contents, work), write, work);
    std::vector<std::string> inputs = file.companions;
    inputs.push_back(in);
    refuse_onto_input(inputs, out);
    for (const auto& [name, bytes] : encoded.companions)
      refuse_onto_input(inputs, (fs::path(out).parent_path() / name).string());
  } catch (const Failure& failure) {
    Diagnostic problem = failure.diagnostic();
    if (problem.file.empty() && (problem.code == "unknown-format" || problem.code == "wrong-content")) {
      problem.param.clear();
      problem.file = arguments.out;
    }
    throw Failure(as_typed(std::move(problem), in, arguments.in));
  }
  for (Diagnostic one : work.reported) {
    if (one.file.empty()) one.file = arguments.in;
    program.terminal.say(one);
  }
  try {
    const fs::path folder = fs::path(out).parent_path();
    std::error_code ignored;  // writing tells what is wrong with the folder
    fs::create_directories(folder, ignored);
    for (const auto& [name, bytes] : encoded.companions)
      write_file_atomically((folder / name).string(), bytes);
    write_file_atomically(out, encoded.bytes);
  } catch (const Failure& failure) {
    program.terminal.say(failure.diagnostic());
    return exit_code::cannot_write;
  }
  program.terminal.message(fmt::format("wrote {} ({})\n", arguments.out, size_text(encoded.bytes.size())));
  return exit_code::done;
}

}  // namespace kinegraph
