// One graph opened with run's options: read, validated, planned, with its caches and its evaluator. Every
// command that computes something goes through it.
#pragma once
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "graph/evaluate/evaluator.h"
#include "graph/evaluate/run_log.h"
#include "graph/plan.h"
#include "graph/registry.h"
#include "graph/validate.h"
#include "headless/progress.h"
#include "headless/terminal.h"

namespace kinegraph {

// What every command is given.
struct Program {
  const Registry& registry;
  const Terminal& terminal;
  std::string version;
};

// The command line is wrong: exit 2.
class UsageError : public Failure {
 public:
  using Failure::Failure;
};

// The options that run, get, picture, explain, files and compare share.
struct RunArguments {
  std::string graph;
  std::vector<std::string> sets, vars, targets, assets;
  std::string out, cache, cache_limit, memory;
  bool no_cache = false, keep_going = false, dry_run = false, allow_outside = false, sandbox = false;
  int threads = 0;
  double timeout = 0;
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();  // its time counts from here
  std::string report, junit, html;
  std::string item;  // of a batch: see PlanOptions
  std::string progress = "auto";
  bool infos = true;  // whether what is worth knowing, and no warning, is told
};

struct Opened {
  Document document;
  std::string shown;   // as the user named it
  std::string path;    // absolute
  std::string folder;  // absolute
  Diagnostics problems;
  bool migrated = false;
  Doubt doubt;  // as ReadResult's
};
// Reads a graph file; a file that is missing or unreadable is a problem like any other.
Opened open_graph(const std::string& argument, const Registry& registry, bool migrate = true);
// Everything wrong with a graph: what reading found and what validating finds beyond it, each once, in file
// order.
Diagnostics all_problems(const Opened& opened, const Registry& registry, const ValidateOptions& options);
// Opens the graphs inside it (see graph/nested.h). `sets` as --set has them, of which those that name a Graph
// node's file count; `files` reads, and says what may be read.
void open_graphs_inside(Opened& opened, const Registry& registry,
                        const std::map<std::string, Json>& variables,
                        const std::vector<std::pair<std::string, std::string>>& sets, FileStore& files);
// "NAME=VALUE" of --var. Throws UsageError.
std::map<std::string, Json> parsed_variables(const std::vector<std::string>& vars);
// A warning for each variable that was given and that neither the graph nor one inside it asks for or
// declares. `sets`: of the command line, which may ask for variables too.
Diagnostics unused_variables(const Opened& opened, const std::map<std::string, Json>& variables,
                             const std::vector<std::string>& sets);
// Whether a file is a graph and not a clip or an analysis: by its ending, or by its "format" member.
bool is_graph_file(const std::string& path);
std::string absolute_path(const std::string& path);

class Session {
 public:
  // Throws UsageError for what is wrong on the command line. Problems of the graph are kept, not thrown.
  Session(const Program& program, const RunArguments& arguments, Opened opened);
  ~Session();

  const Document& document() const { return opened_.document; }
  const Opened& opened() const { return opened_; }
  const Diagnostics& problems() const { return problems_; }
  bool valid() const { return !has_error(problems_); }
  Plan& plan() { return plan_; }
  const Plan& plan() const { return plan_; }
  RunOptions& options() { return options_; }
  FileStore& files() { return *files_; }
  Evaluator& evaluator() { return *evaluator_; }
  const RunArguments& arguments() const { return arguments_; }

  // "NODE" or "NODE.PORT", or the name of a published output. Throws UsageError naming the nearest.
  Target target(const std::string& text) const;
  // The type that an output has, what passes it on followed back to its source; "" where it has none.
  std::string type_of(const Target& target) const;
  // What `run` does without --target: Exports and Checks, else the published outputs.
  std::vector<Target> usual_targets() const;

  struct Need {                   // what targets need
    std::vector<bool> nodes;      // by index into the plan
    std::vector<Target> metrics;  // Metrics outputs on the way
  };
  Need needed_by(const std::vector<Target>& targets) const;

  struct FileUse {
    std::string node, param, path;  // absolute
    bool writes = false, exists = false;
    bool companion = false;  // read or written beside the one that the parameter names
  };
  // What the enabled nodes read (of all nodes, needed or not), and what enabled Exports write.
  std::vector<FileUse> files_read() const;
  std::vector<FileUse> files_written() const;

  // Runs, telling `progress`.
  RunLog run(const std::vector<Target>& targets, Progress& progress, StopToken* stop);

 private:
  const Program& program_;
  RunArguments arguments_;
  Opened opened_;
  Diagnostics problems_;
  RunOptions options_;
  Plan plan_;
  std::unique_ptr<FileStore> files_;
  std::unique_ptr<MemoryCache> memory_;
  std::unique_ptr<DiskCache> disk_;
  std::unique_ptr<Evaluator> evaluator_;
};

}  // namespace kinegraph
