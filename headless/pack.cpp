// A graph to hand on: the file itself, the graphs inside it and the clips they read, in one folder, with
// paths that lead to them there.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/file/write_atomically.h"
#include "graph/nested.h"
#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

using Kind = ParamType::Kind;

class Packing {
 public:
  Packing(const Program& program, Session& session, std::string folder)
      : program_(program), session_(session), folder_(std::move(folder)) {}

  int go() {
    // Companions keep their place beside the file they belong to, which they name by themselves.
    std::string file;
    for (const auto& use : session_.files_read()) {
      if (!use.companion) file = use.path;
      if (use.companion) companions_[file].insert(use.path);
    }
    place_graph(session_.opened().path, session_.document());
    for (const auto& [path, text] : graphs_) write_file_atomically(path, text);
    for (const auto& [from, to] : copies_) {
      fs::create_directories(fs::path(to).parent_path());
      write_file_atomically(to, *session_.files().read(from));
    }
    for (const auto& [from, to] : places_)
      program_.terminal.result(
          fmt::format("packed  {}\n", fs::path(to).lexically_relative(folder_).generic_string()));
    return code_;
  }

 private:
  // A place of its own below the folder, under the file's name.
  std::string place(const std::string& path, const char* below) {
    if (const auto known = places_.find(path); known != places_.end()) return known->second;
    const fs::path name = fs::path(path).filename();
    std::string text = name.string(), stem = text.substr(0, text.find('.')),
                ending = text.substr(stem.size());
    fs::path to = fs::path(folder_) / below / text;
    for (int n = 2; !taken_.insert(to.string()).second; ++n)
      to = fs::path(folder_) / below / fmt::format("{}-{}{}", stem, n, ending);
    return places_[path] = to.string();
  }

  std::string place_graph(const std::string& path, const Document& document) {
    if (const auto known = places_.find(path); known != places_.end()) return known->second;
    const bool outermost = places_.empty();
    const std::string to = place(path, outermost ? "" : "graphs");
    fs::create_directories(fs::path(to).parent_path());
    Document packed = document;
    const fs::path from_folder = fs::path(path).parent_path(), to_folder = fs::path(to).parent_path();
    for (auto& [name, node] : packed.nodes) {
      const NodeType* type = known_type(program_.registry, node);
      if (!type) continue;
      for (auto& [key, value] : node.params) {
        const Param* param = type->find_param(key);
        if (!param) continue;
        const bool graph = type->role == Role::graph && key == "file";
        relink(*param, value, from_folder, to_folder, graph ? &node : nullptr);
      }
    }
    graphs_[to] = write_document(packed, program_.registry);
    return to;
  }

  void relink(const ParamType& type, Json& value, const fs::path& from, const fs::path& to,
              const Node* graph) {
    if (type.kind == Kind::list && value.is_array())
      for (Json& element : value.array()) relink(type.parts[0], element, from, to, nullptr);
    if (type.kind == Kind::object && value.is_object())
      for (const ParamType& field : type.parts)
        if (value.find(field.name)) relink(field, value.object()[field.name], from, to, nullptr);
    if (type.kind != Kind::open_file || !value.is_string() || value.string().empty()) return;
    if (value.string().find("${") != std::string::npos) {
      program_.terminal.say(warning(
          "variable-path",
          fmt::format("{} holds a variable: its file is left where it is", in_quotes(value.string()))));
      return;
    }
    const std::string path = (from / value.string()).lexically_normal().string();
    std::string there;
    if (graph && graph->nested && graph->nested->document) {
      there = place_graph(path, *graph->nested->document);
    } else if (!session_.files().exists(path)) {
      program_.terminal.say(
          error("missing-file", fmt::format("there is no file {}", in_quotes(value.string()))));
      code_ = exit_code::failed;
      return;
    } else {
      there = place(path, "clips");
      copies_[path] = there;
      const auto beside = companions_.find(path);
      if (beside != companions_.end())
        for (const std::string& companion : beside->second) {
          const fs::path relative = fs::path(companion).lexically_relative(fs::path(path).parent_path());
          copies_[companion] = (fs::path(there).parent_path() / relative.filename()).string();
        }
    }
    value = Json(fs::path(there).lexically_relative(to).generic_string());
  }

  const Program& program_;
  Session& session_;
  const std::string folder_;
  std::map<std::string, std::set<std::string>> companions_;
  std::map<std::string, std::string> places_;  // from -> to
  std::set<std::string> taken_;
  std::map<std::string, std::string> graphs_;  // to -> text
  std::map<std::string, std::string> copies_;  // from -> to
  int code_ = exit_code::done;
};

}  // namespace

int pack_command(const Program& program, const RunArguments& arguments, const std::string& folder) {
  Session session(program, arguments, open_graph(arguments.graph, program.registry));
  program.terminal.say(session.problems());
  if (!session.valid()) return exit_code::invalid;
  try {
    return Packing(program, session, absolute_path(folder)).go();
  } catch (const fs::filesystem_error& problem) {
    program.terminal.say(error("cannot-write", problem.what()));
    return exit_code::cannot_write;
  } catch (const Failure& failure) {
    program.terminal.say(failure.diagnostic());
    return failure.diagnostic().code == "cannot-write" ? exit_code::cannot_write : exit_code::failed;
  }
}

}  // namespace kinegraph
