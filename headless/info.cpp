#include "graph/evaluate/file_store.h"
#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/loaded_file.h"
#include "nodes/judge/file_facts.h"

namespace kinegraph {

int info_command(const Program& program, const InfoArguments& arguments) {
  FileStore files;
  Alone work;
  const std::string path = absolute_path(arguments.file);
  files.allow(path);
  try {
    ReadOptions as_it_is;
    as_it_is.max_gap = 0;
    const MotionFile file = read_motion_file(path, as_it_is, files, work);
    const FileFacts facts = facts_of(file, path, files, work.reported, work);
    program.terminal.result(arguments.json ? indented(facts_json(file, facts, arguments.file))
                                           : facts_text(file, facts, arguments.file));
  } catch (const Failure& failure) {
    Diagnostic problem = as_typed(failure.diagnostic(), path, arguments.file);
    if (problem.file.empty()) problem.file = arguments.file;
    throw Failure(problem);
  }
  return exit_code::done;
}

}  // namespace kinegraph
