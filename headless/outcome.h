// What a run came to: its exit code, its report and its JUnit file.
#pragma once
#include <map>
#include <string>

#include "headless/session.h"
#include "nodes/motion/metrics.h"

namespace kinegraph {

struct Outcome {
  int exit = 0;
  RunLog log;
  Diagnostics problems;  // of the graph as a whole, found before anything ran
  std::map<std::string, std::shared_ptr<const Metrics>> metrics;  // by node
};

// The exit code that the log alone asks for (not signals, not what was found before it ran).
int exit_of(const RunLog& log, bool dry_run);

// The contract's report. Problems of no node, and those of caches, are in "diagnostics", which is left out
// when empty.
Json report_of(const Outcome& outcome, const Program& program, const Opened& opened, const std::string& out);
// A suite for the graph; a case for each Export and each rule.
std::string junit_of(const Outcome& outcome, const Program& program, const Opened& opened);

// Writes a report where it was asked for, making missing folders; "" = nowhere. Tells and returns
// exit_code::cannot_write when it can't be written, else 0.
int write_report(const Program& program, const std::string& path, const std::string& text);
// Writes --report and --junit where they were asked for; tells and returns exit_code::cannot_write when one
// can't be written, else 0.
int write_reports(const Outcome& outcome, const Program& program, const RunArguments& arguments,
                  const Opened& opened, const std::string& out);

}  // namespace kinegraph
