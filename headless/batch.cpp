// One graph over many clips: items in parallel, each with a record of what it made, so that a batch that was
// cut short goes on where it was.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "graph/file/parse_json.h"
#include "graph/file/write.h"
#include "headless/batch_items.h"
#include "headless/commands.h"
#include "headless/exit_code.h"
#include "headless/html_page.h"
#include "headless/interruption.h"
#include "headless/outcome.h"
#include "headless/report_paths.h"
#include "headless/sha256.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}
Json stamp(double seconds) {
  return Json(std::round(seconds * 1e3) / 1e3);
}

struct ItemRun {
  const BatchItem* item = nullptr;
  int exit = exit_code::done;
  bool skipped = false;  // its files are there already
  bool begun = false;
  double started = 0, ended = 0;
  std::string cause;  // the first thing that went wrong
  Json report;
  std::string junit;
};

// Of an item's report, what its record keeps.
constexpr const char* parts_kept[] = {"files", "checks", "metrics"};

const char* state_of(const ItemRun& run) {
  if (!run.begun) return "not begun";
  if (run.skipped) return "skipped";
  return run.exit == exit_code::done            ? "done"
         : run.exit == exit_code::checks_failed ? "checks failed"
         : run.exit == exit_code::timed_out     ? "timed out"
                                                : "failed";
}

class Batch {
 public:
  Batch(const Program& program, const BatchArguments& arguments)
      : program_(program),
        arguments_(arguments),
        out_(absolute_path(arguments.run.out)),
        all_(batch_items({arguments.each, arguments.cross, arguments.table})),
        shard_(shard_of(arguments.shard)),
        items_(items_of(shard_, all_)) {}

  int go() {
    const double started = now();
    Interruption interruption;
    stop_ = interruption.token();
    int code = exit_code::done;
    // What is wrong with the graph or the command line is told once, before anything runs.
    if (!all_.empty()) {
      Session first = session_of(all_.front(), 1);
      program_.terminal.say(first.problems());
      check_report_paths(arguments_.run, first);
      if (!first.valid()) return exit_code::invalid;
      if (targets_of(first).empty())
        throw UsageError(Diagnostic(
            error("nothing-to-run", "the graph has no enabled Export or Check and publishes no output")));
    }
    runs_.resize(items_.size());
    for (std::size_t i = 0; i < items_.size(); ++i) runs_[i].item = &items_[i];
    if (arguments_.run.dry_run) return dry_run();
    run_all();
    for (const ItemRun& run : runs_) code = exit_code::graver(code, run.exit);
    if (interruption.exit_code() != 0) {
      program_.terminal.message("kinegraph: interrupted; --resume goes on from here\n");
      code = exit_code::graver(code, interruption.exit_code());
    }
    tell_summary();
    return exit_code::graver(code, write_reports(started, code));
  }

 private:
  Opened opened() const { return open_graph(arguments_.run.graph, program_.registry); }

  RunArguments arguments_of(const BatchItem& item, int workers) const {
    RunArguments arguments = arguments_.run;
    arguments.started = std::chrono::steady_clock::now();
    arguments.out = out_;
    arguments.item = item.name;
    for (const std::string& set : item.sets) arguments.sets.push_back(set);
    arguments.vars.push_back("item=" + item.name);
    arguments.vars.push_back(fmt::format("index={}", item.index));
    arguments.threads = std::max(1, threads() / workers);
    return arguments;
  }
  // What is wrong with an item's values is told of the table's line, or of --each, not of a --set that nobody
  // wrote.
  Session session_of(const BatchItem& item, int workers) const {
    try {
      return Session(program_, arguments_of(item, workers), opened());
    } catch (const UsageError& wrong) {
      Diagnostic problem = wrong.diagnostic();
      const auto is_named = [&](const std::string& set) {
        const std::string name = set.substr(0, set.find('='));
        return problem.node + "." + problem.param == name || problem.message.find(name) != std::string::npos;
      };
      if (std::none_of(item.sets.begin(), item.sets.end(), is_named)) throw;
      if (problem.message.starts_with("--set "))
        problem.message.replace(0, 6, item.table.empty() ? "--each " : "column ");
      if (!item.table.empty()) {
        problem.file = item.table;
        problem.place = {item.line, 1};
      }
      throw UsageError(std::move(problem));
    }
  }
  int threads() const {
    return arguments_.run.threads > 0 ? arguments_.run.threads
                                      : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  std::vector<Target> targets_of(const Session& session) const {
    std::vector<Target> targets;
    for (const std::string& text : arguments_.run.targets) targets.push_back(session.target(text));
    return arguments_.run.targets.empty() ? session.usual_targets() : targets;
  }

  void run_all() {
    Progress progress(Progress::form_of(arguments_.run.progress, program_.terminal), program_.terminal);
    progress.expect(items_.size());
    const int workers = std::max(1, std::min(threads(), static_cast<int>(items_.size())));
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i; (i = next++) < runs_.size() && !stop_->stopped();) {
        ItemRun& run = runs_[i];
        progress.tell(run.item->name, "running", 0);
        run.started = now();
        run.begun = true;
        try {
          run_item(run, workers);
        } catch (const Failure& failure) {
          say(run, failure.diagnostic());
          run.exit = exit_code::invalid;
        } catch (const std::exception& problem) {
          say(run, error("internal", problem.what()));
          run.exit = exit_code::internal;
        }
        run.ended = now();
        progress.tell(run.item->name, state_of(run), 1);
      }
    };
    std::vector<std::thread> pool;
    for (int i = 1; i < workers; ++i) pool.emplace_back(work);
    work();
    for (std::thread& thread : pool) thread.join();
    progress.finish();
  }

  // Over hundreds of clips a warning that many of them have would hide the rest: told for a few, then
  // counted.
  void say(ItemRun& run, Diagnostic diagnostic) {
    const BatchItem& item = *run.item;
    const std::string part = diagnostic.port.empty() ? diagnostic.param : diagnostic.port;
    const std::string at = part.empty() ? diagnostic.node : diagnostic.node + "." + part;
    if (diagnostic.severity == Severity::error && run.cause.empty())
      run.cause = at.empty() ? diagnostic.message : at + ": " + diagnostic.message;
    std::lock_guard lock(mutex_);
    if (diagnostic.severity == Severity::warning) {
      std::set<std::string>& warned = warned_[fmt::format("{}: {}", diagnostic.code, at)];
      warned.insert(item.name);
      if (warned.size() > items_warned_of) return;
    }
    diagnostic.file = diagnostic.file.empty() ? item.name : item.name + ": " + diagnostic.file;
    program_.terminal.say(diagnostic);
  }

  void run_item(ItemRun& run, int workers) {
    Session session = session_of(*run.item, workers);
    session.options().memory /= static_cast<std::uint64_t>(workers);
    Progress quiet(Progress::Form::none, program_.terminal);
    Outcome outcome;
    outcome.problems = session.problems();
    if (!session.valid()) {
      for (const Diagnostic& problem : session.problems()) say(run, problem);
      run.exit = exit_code::invalid;
      return;
    }
    if (const auto other = taken_by_another(*run.item, session); !other.empty()) {
      say(run, error("shared-file", fmt::format("{} writes the same file", other))
                   .hinting("use ${item} or ${index} in the Export's path, or leave it relative"));
      run.exit = exit_code::invalid;
      return;
    }
    const auto targets = targets_of(session);
    const std::string record = (fs::path(out_) / ".kinegraph" / (run.item->name + ".json")).string();
    if (arguments_.resume && is_done(session, targets, record, run, quiet)) {
      run.skipped = true;
      return;
    }
    std::error_code ignored;
    fs::remove(record, ignored);
    outcome.log = session.run(targets, quiet, stop_);
    for (const auto& [name, node] : outcome.log.nodes)
      for (Diagnostic diagnostic : node.diagnostics) {
        // Over hundreds of clips the cause is enough; the report has what it blocked.
        if (diagnostic.severity == Severity::info || diagnostic.code == "blocked") continue;
        if (diagnostic.node.empty()) diagnostic.node = name;
        say(run, std::move(diagnostic));
      }
    for (const Diagnostic& diagnostic : outcome.log.diagnostics) say(run, diagnostic);
    outcome.exit = exit_of(outcome.log, false);
    for (const RuleRun& rule : outcome.log.rules)
      if (!rule.passed && run.cause.empty())
        run.cause = fmt::format(
            "{}: {} {}", rule.node, rule.rule,
            std::isfinite(rule.value) ? fmt::format("measured {:.6g}", rule.value) : "could not be measured");
    for (const Target& target : session.needed_by(targets).metrics)
      if (auto value = session.evaluator().value(session.plan(), target.node, target.port))
        outcome.metrics[target.node] = std::dynamic_pointer_cast<const Metrics>(value);
    run.exit = outcome.exit;
    run.report = report_of(outcome, program_, session.opened(), out_);
    run.junit = junit_of(outcome, program_, session.opened());
    if (outcome.exit == exit_code::done || outcome.exit == exit_code::checks_failed)
      write_record(record, run, keys_of(outcome.log, targets));
  }

  std::string taken_by_another(const BatchItem& item, const Session& session) {
    std::lock_guard lock(mutex_);
    for (const auto& use : session.files_written()) {
      const auto [at, fresh] = taken_.emplace(use.path, item.name);
      if (!fresh && at->second != item.name) return at->second;
    }
    return {};
  }

  static Json::Object keys_of(const RunLog& log, const std::vector<Target>& targets) {
    Json::Object keys;
    for (const Target& target : targets)
      if (const auto node = log.nodes.find(target.node); node != log.nodes.end())
        keys[target.node] = node->second.key;
    return keys;
  }

  // What a later --resume needs: to see that the item is done, and to tell of it as if it had run.
  void write_record(const std::string& path, const ItemRun& run, Json::Object keys) {
    Json::Object record{{"format", "kinegraph-item"}, {"schema", 1},
                        {"item", run.item->name},     {"exit", run.exit},
                        {"keys", std::move(keys)},    {"junit", run.junit}};
    for (const char* part : parts_kept) record[part] = *run.report.find(part);
    fs::create_directories(fs::path(path).parent_path());
    write_file_atomically(path, indented(Json(std::move(record))));
  }

  // Whether the record's keys are those that the graph has now, and its files are there as they were written.
  bool is_done(Session& session, const std::vector<Target>& targets, const std::string& path, ItemRun& run,
               Progress& quiet) {
    std::ifstream in(path, std::ios::binary);
    if (!in.is_open()) return false;
    Diagnostics problems;
    const Json record = parse_json(std::string(std::istreambuf_iterator<char>(in), {}), path, problems);
    const Json *keys = record.find("keys"), *files = record.find("files"), *exit = record.find("exit");
    if (has_error(problems) || !keys || !files || !files->is_array() || !exit || !exit->is_number())
      return false;
    session.options().dry_run = true;
    const RunLog log = session.run(targets, quiet, stop_);
    session.options().dry_run = false;
    if (!(Json(keys_of(log, targets)) == *keys)) return false;
    std::set<std::string> there;
    for (const Json& file : files->array()) {
      const Json *name = file.find("path"), *sum = file.find("sha256");
      if (!name || !name->is_string() || !sum || !sum->is_string()) return false;
      const std::string whole = (fs::path(out_) / name->string()).lexically_normal().string();
      std::ifstream bytes(whole, std::ios::binary);
      if (!bytes.is_open() || sha256(std::string(std::istreambuf_iterator<char>(bytes), {})) != sum->string())
        return false;
      std::error_code failed;
      there.insert(fs::weakly_canonical(whole, failed).string());
    }
    for (const std::string& planned : log.planned_files) {
      std::error_code failed;
      if (!there.contains(fs::weakly_canonical(planned, failed).string())) return false;
    }
    run.exit = static_cast<int>(exit->number());
    Json::Object told;
    for (const char* part : parts_kept)
      if (const Json* kept = record.find(part)) told[part] = *kept;
    run.report = std::move(told);
    if (const Json* junit = record.find("junit"); junit && junit->is_string()) run.junit = junit->string();
    return true;
  }

  int dry_run() {
    for (const BatchItem& item : items_) {
      Session session = session_of(item, 1);
      program_.terminal.result(fmt::format("item  {}\n", item.name));
      for (const std::string& set : item.sets) program_.terminal.result(fmt::format("      {}\n", set));
      for (const auto& use : session.files_written())
        program_.terminal.result(fmt::format(
            "      write {}\n", fs::path(use.path).lexically_relative(fs::current_path()).generic_string()));
    }
    return exit_code::done;
  }

  std::map<std::string, std::size_t> counts() const {
    std::map<std::string, std::size_t> all;
    for (const ItemRun& run : runs_) ++all[state_of(run)];
    return all;
  }

  void tell_summary() {
    const auto tint = [](const std::string& state) {
      return state == "done" || state == "skipped" ? Tint::green
             : state == "checks failed"            ? Tint::yellow
                                                   : Tint::red;
    };
    for (const ItemRun& run : runs_)
      if (const std::string state = state_of(run); state != "done" && state != "skipped")
        program_.terminal.result(fmt::format("{}  {}{}\n", program_.terminal.tinted(state, tint(state)),
                                             run.item->name, run.cause.empty() ? "" : "   " + run.cause));
    for (const auto& [what, items] : warned_)
      if (items.size() > items_warned_of)
        program_.terminal.message(fmt::format("{}: {}: {} more items have it; their reports tell it all\n",
                                              program_.terminal.tinted_message("warning", Tint::yellow), what,
                                              items.size() - items_warned_of));
    std::string text = fmt::format("{} item{}", items_.size(), items_.size() == 1 ? "" : "s");
    if (shard_.count > 1) text += fmt::format(" of {}, shard {}/{}", all_.size(), shard_.index, shard_.count);
    text += ":";
    for (const auto& [state, count] : counts())
      text += fmt::format(" {} {},", count, program_.terminal.tinted(state, tint(state)));
    text.pop_back();
    program_.terminal.result(text + "\n");
  }

  int write_reports(double started, int exit) {
    int code = exit_code::done;
    const auto write = [&](std::string path, const std::string& text) {
      if (path.empty()) return;
      if (shard_.from_slurm)
        path = fs::path(path)
                   .replace_extension(fmt::format(".{}{}", shard_.index, fs::path(path).extension().string()))
                   .string();
      code = exit_code::graver(code, write_report(program_, path, text));
    };
    Json::Object items;
    std::string suites;
    for (const ItemRun& run : runs_) {
      Json::Object one{{"index", run.item->index}, {"state", state_of(run)}, {"exit", run.exit}};
      if (run.begun) {
        one["started"] = stamp(run.started);
        one["ended"] = stamp(run.ended);
      }
      if (!run.cause.empty()) one["cause"] = run.cause;
      if (!run.report.is_null()) one["report"] = run.report;
      items[run.item->name] = std::move(one);
      // The suite inside, named after the item.
      const auto begin = run.junit.find("  <testsuite "), end = run.junit.rfind("</testsuites>");
      if (begin == std::string::npos || end == std::string::npos) continue;
      std::string suite = run.junit.substr(begin, end - begin);
      if (const auto name = suite.find("name=\""); name != std::string::npos)
        suite.insert(name + 6, run.item->name + ": ");
      suites += suite;
    }
    const Json report = Json::Object{{"format", "kinegraph-batch-report"},
                                     {"schema", 1},
                                     {"graph", arguments_.run.graph},
                                     {"version", program_.version},
                                     {"exit", exit},
                                     {"started", stamp(started)},
                                     {"ended", stamp(now())},
                                     {"items", std::move(items)}};
    if (!arguments_.run.html.empty()) write(arguments_.run.html, html_page(Json::Object{{"report", report}}));
    write(arguments_.run.report, indented(report));
    write(arguments_.run.junit,
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n");
    return code;
  }

  const Program& program_;
  const BatchArguments& arguments_;
  const std::string out_;
  const std::vector<BatchItem> all_;
  const Shard shard_;
  const std::vector<BatchItem> items_;
  std::vector<ItemRun> runs_;
  StopToken* stop_ = nullptr;
  static constexpr std::size_t items_warned_of = 3;
  std::map<std::string, std::set<std::string>> warned_;  // what and where -> items
  std::mutex mutex_;
  std::map<std::string, std::string> taken_;  // file -> item
};

// Of several shards, one report: every item once, the earliest start, the latest end, the gravest exit.
int merge_batch_reports(const Program& program, const std::vector<std::string>& files,
                        const std::string& to) {
  Json::Object merged, items;
  for (const std::string& file : files) {
    std::ifstream in(file, std::ios::binary);
    if (!in.is_open() || fs::is_directory(file))
      throw Failure(Diagnostic(error("missing-file", fmt::format("'{}' can't be read", file))
                                   .hinting("is it there? --merge-reports takes what --report wrote")));
    Diagnostics problems;
    const Json report = parse_json(std::string(std::istreambuf_iterator<char>(in), {}), file, problems);
    const Json* format = report.find("format");
    const Json* of_file = report.find("items");
    if (has_error(problems) || !format || !(*format == Json("kinegraph-batch-report")) || !of_file ||
        !of_file->is_object())
      throw Failure(error("not-a-report", fmt::format("'{}' is no report of a batch", file))
                        .in_file(file)
                        .hinting("--merge-reports takes what a batch's --report wrote"));
    const Json::Object& one = report.object();
    const auto number = [](const Json::Object& object, const char* key, double otherwise) {
      const auto found = object.find(key);
      return found != object.end() && found->second.is_number() ? found->second.number() : otherwise;
    };
    if (merged.empty()) {
      merged = one;
    } else {
      merged["started"] = std::min(number(merged, "started", 0), number(one, "started", 0));
      merged["ended"] = std::max(number(merged, "ended", 0), number(one, "ended", 0));
      merged["exit"] = exit_code::graver(static_cast<int>(number(merged, "exit", 0)),
                                         static_cast<int>(number(one, "exit", 0)));
    }
    for (const auto& [name, item] : of_file->object()) {
      // Of an item that ran twice what came last counts.
      const auto [at, fresh] = items.emplace(name, item);
      if (!fresh && number(item.object(), "ended", 0) >= number(at->second.object(), "ended", 0))
        at->second = item;
    }
  }
  merged["items"] = std::move(items);
  return write_report(program, to, indented(Json(std::move(merged))));
}

}  // namespace

int batch_command(const Program& program, const BatchArguments& arguments) {
  if (!arguments.merge_reports.empty()) {
    if (arguments.merged.empty()) throw UsageError(error("bad-option", "--merge-reports needs -o FILE.json"));
    return merge_batch_reports(program, arguments.merge_reports, arguments.merged);
  }
  if (arguments.run.graph.empty()) throw UsageError(error("bad-option", "a batch needs a graph"));
  if (arguments.run.out.empty()) throw UsageError(error("bad-option", "a batch needs --out DIR"));
  return Batch(program, arguments).go();
}

}  // namespace kinegraph
