#include "graph/file/merge.h"

#include <fmt/format.h>

#include <filesystem>

#include "graph/file/write.h"
#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/version_of_graph.h"

namespace kinegraph {

int merge_command(const Program& program, const MergeArguments& arguments) {
  Opened base = version_of_graph(arguments.base, program.registry);
  Opened ours = version_of_graph(arguments.ours, program.registry);
  Opened theirs = version_of_graph(arguments.theirs, program.registry);
  bool good = true;
  for (const Opened* side : {&base, &ours, &theirs}) good = usable_version(program, *side) && good;
  if (!good) return exit_code::invalid;
  FileStore files(std::vector<std::string>{});
  const std::string path = absolute_path(arguments.path.empty() ? arguments.out : arguments.path);
  const auto open_inside = [&](Document& document) {
    Opened place;
    place.path = path;
    place.folder = std::filesystem::path(path).parent_path().string();
    place.document = std::move(document);
    open_graphs_inside(place, program.registry, {}, {}, files);
    document = std::move(place.document);
  };
  const Merge merged = merge(std::move(base.document), std::move(ours.document), std::move(theirs.document),
                             program.registry, "ours", "theirs", open_inside);
  for (const MergeConflict& conflict : merged.conflicts)
    program.terminal.message(
        fmt::format("{}: {}: {}\n", arguments.path.empty() ? arguments.out : arguments.path,
                    program.terminal.tinted_message("conflict", Tint::red), conflict.what));
  try {
    write_file_atomically(absolute_path(arguments.out), merged.text);
  } catch (const Failure& failure) {
    program.terminal.say(failure.diagnostic());
    return exit_code::cannot_write;
  }
  return merged.conflicts.empty() ? exit_code::done : exit_code::failed;
}

}  // namespace kinegraph
