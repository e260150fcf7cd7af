#include <fmt/format.h>

#include "headless/command_line.h"
#include "headless/commands.h"
#include "headless/cpu_choice.h"
#include "headless/exit_code.h"
#include "headless/interruption.h"
#include "nodes/all_nodes.h"

using namespace kinegraph;

int main(int argc, char** argv) {
  Terminal terminal;
  end_on_signals();
  try {
    choose_cpu_from_environment();
    Registry registry = all_nodes();
    Program program{registry, terminal, KINEGRAPH_VERSION};
    int code = read_command_line(program, argc, argv)(program);
    if (!terminal.results_written()) {
      if (code == exit_code::done) terminal.message("kinegraph: standard output can't be written\n");
      code = exit_code::graver(code, exit_code::cannot_write);
    }
    return code;
  } catch (const UsageError& problem) {
    terminal.say(problem.diagnostic());
    return exit_code::usage;
  } catch (const Failure& problem) {
    terminal.say(problem.diagnostic());
    return exit_code::invalid;
  } catch (const std::exception& problem) {
    terminal.message(fmt::format("kinegraph: internal error: {}\n", problem.what()));
    return exit_code::internal;
  }
}
