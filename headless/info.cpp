#include "graph/evaluate/file_store.h"
#include "headless/commands.h"
#include "headless/exit_code.h"
#include "nodes/files/file_facts.h"

namespace kinegraph {

int info_command(const Program& program, const InfoArguments& arguments) {
  FileStore files;
  Alone work;
  const std::string path = absolute_path(arguments.file);
  try {
    const MotionFile file = read_motion_file(path, {}, files, work);
    if (arguments.json) {
      program.terminal.result(indented(facts_json(file, arguments.file, work.reported)));
    } else {
      program.terminal.result(facts_text(file, arguments.file, work.reported));
    }
  } catch (const Failure& failure) {
    Diagnostic problem = failure.diagnostic();
    if (problem.file.empty() || problem.file == path) problem.file = arguments.file;
    throw Failure(problem);
  }
  return exit_code::done;
}

}  // namespace kinegraph
