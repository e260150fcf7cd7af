// A graph to hand on: the file itself, the graphs inside it and the clips they read, in one folder, with
// paths that lead to them there.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "graph/file/parse_json.h"
#include "graph/file/write.h"
#include "graph/file/write_atomically.h"
#include "graph/nested.h"
#include "graph/variables.h"
#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

using Kind = ParamType::Kind;

class Packing {
 public:
  Packing(const Program& program, Session& session, std::string folder)
      : program_(program), session_(session), folder_(std::move(folder)) {
    variables_.given = parsed_variables(session.arguments().vars);
  }

  int go() {
    std::string file;
    for (const auto& use : session_.files_read()) {
      if (!use.companion) file = use.path;
      if (use.companion && use.path != file) companions_[file].insert(use.path);
    }
    Document whole = session_.document();
    for (const auto& [name, value] : variables_.given) whole.variables[name] = typed(value);
    place_graph(session_.opened().path, whole, "", "");
    if (code_ != exit_code::done) return code_;  // half of it would be no use to anybody
    for (const auto& [path, text] : graphs_) {
      fs::create_directories(fs::path(path).parent_path());
      write_file_atomically(path, text);
      tell(path);
    }
    std::vector<std::pair<std::string, std::string>> all(copies_.begin(), copies_.end());
    all.insert(all.end(), beside_.begin(), beside_.end());
    for (const auto& [from, to] : all) {
      fs::create_directories(fs::path(to).parent_path());
      write_file_atomically(to, *session_.files().read(from));
      tell(to);
    }
    return code_;
  }

 private:
  void tell(const std::string& path) {
    program_.terminal.result(
        fmt::format("packed  {}\n", fs::path(path).lexically_relative(folder_).generic_string()));
  }

  // What was typed after --var as the JSON that it looks like, as the parameter that uses it can't be asked
  // here.
  static Json typed(const Json& given) {
    Diagnostics problems;
    Json value = given.is_string() ? parse_json(given.string(), "", problems) : given;
    return has_error(problems) || value.is_array() || value.is_object() ? given : value;
  }

  // A name of its own below the folder: NAME, NAME-2, …
  std::string fresh_place(const fs::path& below, const std::string& name) {
    const std::string stem = name.substr(0, name.find('.')), ending = name.substr(stem.size());
    std::string to = (fs::path(folder_) / below / name).string();
    for (int n = 2; !taken_.insert(to).second; ++n)
      to = (fs::path(folder_) / below / fmt::format("{}-{}{}", stem, n, ending)).string();
    return to;
  }

  // Its graphs and clips are placed with it. A file that stands for different things at two places, by its
  // variables, is there twice.
  // `inside`: the names of the nodes that it is inside of, "outer/inner/".
  std::string place_graph(const std::string& path, const Document& document, const std::string& below,
                          const std::string& inside) {
    const fs::path from = fs::path(path).parent_path(), to = fs::path(folder_) / below;
    Document packed = document;
    variables_.files.push_back(&document.variables);
    for (auto& [name, node] : packed.nodes) {
      const NodeType* type = known_type(program_.registry, node);
      if (!type) continue;
      for (auto& [key, value] : node.params) {
        const Param* param = type->find_param(key);
        if (!param) continue;
        const bool graph = type->role == Role::graph && key == "file";
        relink(*param, value, {path, inside + name, from, to}, graph ? &node : nullptr);
      }
    }
    variables_.files.pop_back();
    std::string text = write_document(packed, program_.registry);
    const auto known = placed_graphs_.find({path, text});
    if (known != placed_graphs_.end()) return known->second;
    const std::string place = fresh_place(below, fs::path(path).filename().string());
    placed_graphs_[{path, text}] = place;
    graphs_[place] = std::move(text);
    return place;
  }

  // A file alone stands in clips/; one with companions in a folder of its own there, with all of them where
  // they are to one another, as it finds them by their paths from itself.
  std::string place_clip(const std::string& path) {
    if (const auto known = copies_.find(path); known != copies_.end()) return known->second;
    const auto companions = companions_.find(path);
    if (companions == companions_.end())
      return copies_[path] = fresh_place("clips", fs::path(path).filename().string());
    fs::path common = fs::path(path).parent_path();
    for (const std::string& companion : companions->second)
      while (!below(common, companion) && common != common.parent_path()) common = common.parent_path();
    const fs::path group = fresh_place("clips", fs::path(path).stem().string());
    const auto placed = [&](const std::string& file) {
      return (group / fs::path(file).lexically_relative(common)).string();
    };
    for (const std::string& companion : companions->second)
      if (session_.files().exists(companion)) beside_.emplace_back(companion, placed(companion));
    return copies_[path] = placed(path);
  }
  static bool below(const fs::path& folder, const fs::path& file) {
    const std::string relative = file.lexically_relative(folder).generic_string();
    return !relative.empty() && !relative.starts_with("..");
  }

  struct Spot {         // where a path stands
    std::string graph;  // the file that says it
    std::string node;
    fs::path from, to;  // the folders that it leads from: here, and in what is packed
  };
  void relink(const ParamType& type, Json& value, const Spot& spot, const Node* graph) {
    if (type.kind == Kind::list && value.is_array())
      for (Json& element : value.array()) relink(type.parts[0], element, spot, nullptr);
    if (type.kind == Kind::object && value.is_object())
      for (const ParamType& field : type.parts)
        if (value.find(field.name)) relink(field, value.object()[field.name], spot, nullptr);
    if (type.kind != Kind::open_file || !value.is_string() || value.string().empty()) return;
    Diagnostics problems;  // there are none: the graph is valid
    const Json meant = substituted(value, type, variables_, type.name, problems);
    if (has_error(problems) || !meant.is_string() || meant.string().empty()) return;
    const std::string path = (spot.from / meant.string()).lexically_normal().string();
    std::string there;
    if (graph && graph->nested && graph->nested->document) {
      there = place_graph(path, *graph->nested->document, "graphs", spot.node + "/");
    } else if (!session_.files().exists(path)) {
      const bool is_top = spot.graph == session_.opened().path;
      program_.terminal.say(
          error("missing-file", fmt::format("there is no file {}", in_quotes(meant.string())))
              .in_file(is_top ? session_.opened().shown : fs::proximate(spot.graph).generic_string(),
                       value.place)
              .at_node(spot.node)
              .at_param(type.name)
              .hinting("nothing was packed; `kinegraph validate` names everything that is missing"));
      code_ = exit_code::invalid;
      return;
    } else {
      there = place_clip(path);
    }
    value = Json(fs::path(there).lexically_relative(spot.to).generic_string());
  }

  const Program& program_;
  Session& session_;
  const std::string folder_;
  Variables variables_;
  std::map<std::string, std::set<std::string>> companions_;
  std::set<std::string> taken_;
  std::map<std::pair<std::string, std::string>, std::string> placed_graphs_;  // source and packed text -> to
  std::map<std::string, std::string> graphs_;                                 // to -> text
  std::map<std::string, std::string> copies_;                                 // from -> to
  std::vector<std::pair<std::string, std::string>> beside_;                   // companions, likewise
  int code_ = exit_code::done;
};

}  // namespace

int pack_command(const Program& program, const RunArguments& arguments, const std::string& folder) {
  Session session(program, arguments, open_graph(arguments.graph, program.registry));
  program.terminal.say(session.problems());
  if (!session.valid()) return exit_code::invalid;
  std::error_code not_there_yet;
  if (fs::exists(folder, not_there_yet) && !fs::is_directory(folder, not_there_yet))
    throw Failure(Diagnostic(error("not-a-folder", fmt::format("'{}' is not a folder", folder))
                                 .hinting("-o names the folder that everything goes to")));
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
