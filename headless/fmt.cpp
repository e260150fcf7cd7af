#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/version_of_graph.h"

namespace kinegraph {

namespace {

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int write_back(const Program& program, const std::string& path, const std::string& text) {
  try {
    write_file_atomically(absolute_path(path), text);
    return exit_code::done;
  } catch (const Failure& failure) {
    program.terminal.say(failure.diagnostic());
    return exit_code::cannot_write;
  }
}

}  // namespace

int fmt_command(const Program& program, const std::vector<std::string>& graphs, bool check) {
  using exit_code::graver;
  int code = exit_code::done;
  std::size_t others = 0;  // not canonical
  for (const auto& graph : graphs) {
    bool piped = graph == "-";
    Opened opened;
    std::string before;
    if (piped) {
      before.assign(std::istreambuf_iterator<char>(std::cin), {});
      auto read = read_document(before, "<stdin>", program.registry, false);
      opened.shown = "<stdin>";
      opened.document = std::move(read.document);
      opened.problems = std::move(read.problems);
    } else {
      opened = open_graph(graph, program.registry, false);
    }
    if (!usable_version(program, opened, true)) {
      code = graver(code, exit_code::invalid);
      continue;
    }
    if (!piped) before = text_of(graph);
    auto after = write_document(opened.document, program.registry);
    if (check) {
      if (before == after) continue;
      program.terminal.result(opened.shown + "\n");
      ++others;
      code = graver(code, exit_code::failed);
    } else if (piped) {
      program.terminal.result(after);
    } else if (before != after) {
      code = graver(code, write_back(program, graph, after));
    }
  }
  if (others > 0)
    program.terminal.message(
        fmt::format("{} of {} not in canonical form; `kinegraph fmt` without --check writes it\n", others,
                    graphs.size()));
  return code;
}

int upgrade_command(const Program& program, const std::vector<std::string>& graphs, bool in_place) {
  if (!in_place && graphs.size() > 1)
    throw UsageError(Diagnostic(error("bad-option", "several graphs can't all go to standard output")
                                    .hinting("upgrade them with --in-place")));
  int code = exit_code::done;
  for (const auto& graph : graphs) {
    Opened opened = open_graph(graph, program.registry);
    if (!usable_version(program, opened, true)) {
      code = exit_code::graver(code, exit_code::invalid);
      continue;
    }
    auto text = write_document(opened.document, program.registry);
    if (!in_place)
      program.terminal.result(text);
    else if (opened.migrated)
      code = exit_code::graver(code, write_back(program, graph, text));
    if (in_place && opened.migrated) program.terminal.message(fmt::format("upgraded {}\n", graph));
  }
  return code;
}

}  // namespace kinegraph
