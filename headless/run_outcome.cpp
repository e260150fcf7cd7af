#include "headless/run_outcome.h"

#include <fmt/format.h>

#include "headless/exit_code.h"
#include "headless/html_report.h"
#include "headless/interruption.h"
#include "headless/messages.h"
#include "headless/report_paths.h"

namespace kinegraph {

namespace {

Progress::Form form_of(const RunArguments& arguments, const Terminal& terminal) {
  try {
    return Progress::form_of(arguments.progress, terminal);
  } catch (const Failure& failure) {
    throw UsageError(failure.diagnostic());
  }
}

}  // namespace

int run_to_outcome(const Program& program, const RunArguments& arguments, Opened opened,
                   const std::function<std::vector<Target>(Session&)>& targets,
                   const std::function<int(Session&, const Outcome&)>& after) {
  using exit_code::graver;
  Progress progress(form_of(arguments, program.terminal), program.terminal);
  Session session(program, arguments, std::move(opened));
  Interruption interruption;  // what came before leaves nothing behind, and ends at once
  Outcome outcome;
  std::string page;
  outcome.problems = session.problems();
  program.terminal.say(session.problems());
  if (!session.valid()) {
    check_report_paths(arguments, session);
    outcome.exit = exit_code::invalid;
  } else {
    auto wanted = targets(session);
    check_report_paths(arguments, session);
    try {
      std::vector<BeforeAfter> shown;
      auto asked = wanted;
      if (!arguments.html.empty() && !arguments.dry_run) {
        shown = motions_to_show(session, wanted);
        for (const auto& one : shown)
          for (const Target& target : {one.before, one.after})
            if (!target.node.empty()) asked.push_back(target);
      }
      outcome.log = session.run(asked, progress, interruption.token());
      outcome.exit = exit_of(outcome.log, arguments.dry_run);
      if (!arguments.dry_run)
        for (const auto& target : session.needed_by(wanted).metrics)
          if (auto value = session.evaluator().value(session.plan(), target.node, target.port))
            outcome.metrics[target.node] = std::dynamic_pointer_cast<const Metrics>(value);
      int after_it = after(session, outcome);
      program.terminal.results_written();  // results stand before messages where both go to one terminal
      say_log(program.terminal, outcome.log, session.opened().shown, arguments.infos);
      outcome.exit = graver(outcome.exit, after_it);
      if (!arguments.html.empty()) page = html_of(outcome, program, session, shown);
    } catch (const UsageError&) {
      throw;
    } catch (const std::exception& problem) {  // a report is due even when the program itself is at fault
      program.terminal.message(fmt::format("kinegraph: internal error: {}\n", problem.what()));
      outcome.exit = exit_code::internal;
    }
  }
  if (interruption.exit_code() != 0) {
    program.terminal.message("kinegraph: interrupted\n");
    outcome.exit = graver(outcome.exit, interruption.exit_code());
  }
  if (!program.terminal.results_written()) {
    program.terminal.message("kinegraph: standard output can't be written\n");
    outcome.exit = graver(outcome.exit, exit_code::cannot_write);
  }
  if (!arguments.html.empty()) {
    if (page.empty()) page = html_of(outcome, program, session, {});
    outcome.exit = graver(outcome.exit, write_report(program, arguments.html, page));
  }
  int reports = write_reports(outcome, program, arguments, session.opened(), session.options().out);
  const int code = graver(outcome.exit, reports);
  if (outcome.log.stopped || outcome.log.timed_out) leave(code);
  return code;
}

}  // namespace kinegraph
