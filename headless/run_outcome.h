// The way of every command that computes: open, check, run, tell what was said, write the reports, find the
// exit code.
#pragma once
#include <functional>
#include <vector>

#include "headless/outcome.h"

namespace kinegraph {

// `targets` may change the session's plan and throws UsageError. `after` tells results on standard output and
// does what the command is for; its exit code counts with the run's. It is called whenever the run began.
int run_to_outcome(const Program& program, const RunArguments& arguments, Opened opened,
                   const std::function<std::vector<Target>(Session&)>& targets,
                   const std::function<int(Session&, const Outcome&)>& after);

}  // namespace kinegraph
