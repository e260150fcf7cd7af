#include "headless/session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "graph/nested.h"
#include "graph/validate.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

constexpr int most_threads = 1024;

std::uint64_t machine_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

std::uint64_t size_option(const char* option, const std::string& text, std::uint64_t otherwise) {
  if (text.empty()) return otherwise;
  try {
    return parse_size(text);
  } catch (const Failure& failure) {
    Diagnostic said = failure.diagnostic();
    said.message = fmt::format("{}: {}", option, said.message);
    throw UsageError(said);
  }
}

}  // namespace

Session::Session(const Program& program, const RunArguments& arguments, Opened opened)
    : program_(program), arguments_(arguments), opened_(std::move(opened)) {
  if (arguments.threads < 0) throw UsageError(error("bad-option", "--threads can't be negative"));
  // So many threads, or the tables for them, are more than a machine may have room for.
  if (arguments.threads > most_threads)
    throw UsageError(error("bad-option", fmt::format("--threads can't be more than {}", most_threads)));
  if (!(arguments.timeout >= 0))
    throw UsageError(error("bad-option", "--timeout can't be negative").hinting("seconds, such as 2.5"));
  options_.threads = arguments.threads;
  options_.memory = size_option("--memory", arguments.memory, machine_memory() / 2);
  std::uint64_t cache_limit = size_option("--cache-limit", arguments.cache_limit, 0);
  options_.timeout = arguments.timeout;
  options_.since = arguments.started;
  options_.keep_going = arguments.keep_going;
  options_.dry_run = arguments.dry_run;
  options_.allow_outside = arguments.allow_outside;
  options_.out = arguments.out.empty() ? opened_.folder : absolute_path(arguments.out);
  auto variables = parsed_variables(arguments.vars);

  PlanOptions planning{.file = opened_.shown,
                       .folder = opened_.folder,
                       .set_folder = fs::current_path().string(),
                       .out = options_.out,
                       .item = arguments.item,
                       .variables = variables};
  for (const auto& text : arguments.sets) {
    auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(error("bad-option", fmt::format("--set {} is not NODE.PARAM=VALUE", text)));
    planning.sets.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }

  std::vector<std::string> roots;
  if (arguments.sandbox) {
    roots.push_back(opened_.folder);
    for (const auto& folder : arguments.assets) roots.push_back(absolute_path(folder));
  }
  files_ = std::make_unique<FileStore>(roots);
  open_graphs_inside(opened_, program.registry, variables, planning.sets, *files_);

  problems_ = all_problems(opened_, program.registry,
                           {.file = opened_.shown,
                            .folder = opened_.folder,
                            .check_files = false,
                            .allow_outside = arguments.allow_outside,
                            .variables = variables});
  auto given = variables;  // by the user: a batch's own are there whether a graph asks for them or not
  if (!arguments.item.empty())
    for (const char* own : {"item", "index"}) given.erase(own);
  if (!has_error(opened_.problems))
    for (auto& unused : unused_variables(opened_, given, arguments.sets)) problems_.push_back(unused);
  if (opened_.document.read_only && !has_error(problems_))
    problems_.push_back(error("newer-schema", "a file of a newer schema can't be run")
                            .in_file(opened_.shown)
                            .hinting("use a newer version of kinegraph"));
  if (!has_error(problems_)) {
    Diagnostics planned;
    plan_ = make_plan(opened_.document, program.registry, planning, planned);
    for (auto& problem : planned) {
      if (!problem.code.starts_with("usage:")) {
        problems_.push_back(problem);
        continue;
      }
      problem.code.erase(0, 6);
      throw UsageError(problem);
    }
  }

  if (!opened_.path.empty()) plan_.graph_files.insert(plan_.graph_files.begin(), opened_.path);
  options_.outside_allowed = plan_.set_paths;
  for (const auto& path : plan_.set_paths) files_->allow(path);
  memory_ = std::make_unique<MemoryCache>(static_cast<std::size_t>(options_.memory));
  std::string cache = arguments.cache;
  if (const char* usual = std::getenv("KINEGRAPH_CACHE"); cache.empty() && usual) cache = usual;
  if (!cache.empty() && !arguments.no_cache)
    disk_ = std::make_unique<DiskCache>(absolute_path(cache), cache_limit, program.registry);
  evaluator_ = std::make_unique<Evaluator>(program.registry, *files_, memory_.get(), disk_.get());
}

Session::~Session() = default;

Target Session::target(const std::string& text) const {
  auto dot = text.find('.');
  Target target{text.substr(0, dot), dot == std::string::npos ? "" : text.substr(dot + 1)};
  if (dot == std::string::npos)
    if (auto published = document().publish.outputs.find(text);
        published != document().publish.outputs.end() && !document().nodes.contains(text))
      return {published->second.front().node, published->second.front().port};

  if (dot != std::string::npos && target.port.empty())
    throw UsageError(error("unknown-port", fmt::format("\"{}\" names no output after its point", text))
                         .hinting("write NODE or NODE.PORT"));
  const NodeType* type = nullptr;
  auto planned = plan_.by_name.find(target.node);
  auto written = document().nodes.find(target.node);
  if (planned != plan_.by_name.end()) {
    type = plan_.nodes[static_cast<std::size_t>(planned->second)].type;
  } else if (written != document().nodes.end()) {
    type = known_type(program_.registry, written->second);
  } else if (!plan_.passed.contains(target.node)) {
    std::vector<std::string> names;
    for (const auto& [name, node] : document().nodes) names.push_back(name);
    for (const auto& node : plan_.nodes) names.push_back(node.name);
    throw UsageError(Diagnostic(
        error("unknown-node", fmt::format("there is no node \"{}\" in {}", target.node, opened_.shown))
            .hinting(suggestion(target.node, names))));
  }
  if (type && !target.port.empty() && !type->find_output(target.port)) {
    auto names = type->output_names();
    throw UsageError(
        Diagnostic(error("unknown-port",
                         fmt::format("{} ({}) has no output \"{}\"", target.node, type->name, target.port))
                       .hinting(names.empty() ? "it has no outputs" : suggestion(target.port, names))));
  }
  return target;
}

std::string Session::type_of(const Target& target) const {
  auto source = plan_.find_output(target.node, target.port);
  if (!source) return {};
  if (source->constant) return std::string(source->constant->type());
  const NodeType* type = plan_.nodes[static_cast<std::size_t>(source->node)].type;
  const OutputPort* port = type ? type->find_output(source->port) : nullptr;
  return port ? port->type : std::string();
}

std::vector<Target> Session::usual_targets() const {
  std::vector<Target> targets;
  for (const auto& name : plan_.effects) targets.push_back({name, ""});
  if (!targets.empty()) return targets;
  for (const auto& [name, link] : document().publish.outputs)
    targets.push_back({link.front().node, link.front().port});
  return targets;
}

Session::Need Session::needed_by(const std::vector<Target>& targets) const {
  Need need;
  need.nodes.assign(plan_.nodes.size(), false);
  std::vector<Source> next;
  const auto follow = [&](const Source& source) {
    next.push_back(source);
    while (!next.empty()) {
      const Source at = std::move(next.back());
      next.pop_back();
      if (at.node < 0) continue;
      const auto& node = plan_.nodes[static_cast<std::size_t>(at.node)];
      if (node.type && !at.port.empty()) {
        const OutputPort* port = node.type->find_output(at.port);
        if (port && port->type == "Metrics") need.metrics.push_back({node.name, at.port});
      }
      if (need.nodes[static_cast<std::size_t>(at.node)]) continue;
      need.nodes[static_cast<std::size_t>(at.node)] = true;
      const auto before = static_cast<std::ptrdiff_t>(next.size());
      for (const auto& [port, sources] : node.inputs) next.insert(next.end(), sources.begin(), sources.end());
      std::reverse(next.begin() + before, next.end());
    }
  };
  for (const auto& target : targets) {
    if (auto found = plan_.by_name.find(target.node); found != plan_.by_name.end() && target.port.empty()) {
      Source whole;
      whole.node = found->second;
      follow(whole);
      const auto& node = plan_.nodes[static_cast<std::size_t>(found->second)];
      if (node.type && node.enabled)
        for (const auto& output : node.type->outputs)
          if (output.type == "Metrics") need.metrics.push_back({node.name, output.name});
    } else if (target.port.empty()) {
      if (auto passing = plan_.passed.find(target.node); passing != plan_.passed.end())
        for (const auto& [port, source] : passing->second) follow(source);
    } else if (auto source = plan_.find_output(target.node, target.port)) {
      follow(*source);
    }
  }
  return need;
}

RunLog Session::run(const std::vector<Target>& targets, Progress& progress, StopToken* stop) {
  auto need = needed_by(targets);
  progress.expect(static_cast<std::size_t>(std::count(need.nodes.begin(), need.nodes.end(), true)));
  auto wanted = targets;
  // The report tells the metrics that were measured on the way; they are computed anyway.
  if (!options_.dry_run)
    for (const auto& metrics : need.metrics) {
      const bool is_of_whole_node = std::any_of(targets.begin(), targets.end(), [&](const Target& target) {
        return target.node == metrics.node && target.port.empty();
      });
      if (!is_of_whole_node) wanted.push_back(metrics);  // to be asked for by name, it must be there
    }
  RunCallbacks callbacks;
  callbacks.progress = [&](const std::string& node, std::string_view state, double fraction) {
    progress.tell(node, state, fraction);
  };
  RunLog log = evaluator_->run(plan_, wanted, options_, callbacks, stop);
  progress.finish();
  return log;
}

}  // namespace kinegraph
