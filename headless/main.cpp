#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>

#include "headless/commands.h"
#include "headless/cpu_choice.h"
#include "headless/exit_code.h"
#include "nodes/all_nodes.h"

namespace {

using namespace kinegraph;

void add_variables(CLI::App& app, RunArguments& arguments) {
  app.add_option("--var", arguments.vars, "Set a variable")->type_name("NAME=VALUE")->allow_extra_args(false);
}

void add_inputs(CLI::App& app, RunArguments& arguments) {
  app.add_option("--set", arguments.sets, "Set a parameter, or a published one by its name")
      ->type_name("NODE.PARAM=VALUE")
      ->allow_extra_args(false);
  add_variables(app, arguments);
}

void add_cache(CLI::App& app, RunArguments& arguments) {
  app.add_option("--cache", arguments.cache, "Keep results in this folder (also $KINEGRAPH_CACHE)")
      ->type_name("DIR");
  app.add_flag("--no-cache", arguments.no_cache, "No disk cache, whatever the environment says");
  app.add_option("--cache-limit", arguments.cache_limit, "Most that the folder may hold, such as 10G")
      ->type_name("SIZE");
}

void add_sandbox(CLI::App& app, RunArguments& arguments) {
  app.add_flag("--sandbox", arguments.sandbox,
               "Read only below the graph's folder, --assets and paths given here");
  app.add_option("--assets", arguments.assets, "A folder that may be read too")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

// What everything that computes takes.
void add_run_options(CLI::App& app, RunArguments& arguments) {
  add_inputs(app, arguments);
  app.add_option("--out", arguments.out, "Folder that exports go to; the graph's own by default")
      ->type_name("DIR");
  add_cache(app, arguments);
  app.add_option("--threads", arguments.threads, "Most threads; 0 = as many as the machine has")
      ->type_name("N");
  app.add_option("--memory", arguments.memory, "Most memory for values and work, such as 2G")
      ->type_name("SIZE");
  app.add_option("--timeout", arguments.timeout, "Give up after so many seconds")->type_name("S");
  app.add_flag("--keep-going", arguments.keep_going, "Run what doesn't depend on a failed node");
  app.add_flag("--dry-run", arguments.dry_run, "Write nothing; tell what would run, be read and be written");
  app.add_flag("--allow-outside", arguments.allow_outside, "Exports may lead out of --out");
  add_sandbox(app, arguments);
  app.add_option("--report", arguments.report, "Write what happened as JSON")->type_name("FILE.json");
  app.add_option("--junit", arguments.junit, "Write Exports and rules as JUnit XML")->type_name("FILE.xml");
  app.add_option("--html", arguments.html, "Write a page with the graph, times, metrics and a player")
      ->type_name("FILE.html");
  app.add_option("--progress", arguments.progress, "auto, bar, json or none, on standard error")
      ->type_name("FORM");
}

void add_graph(CLI::App& app, std::string& graph) {
  app.add_option("GRAPH", graph, "A graph file, *.kg.json")->required()->type_name("");
}

// What CLI11 says of a wrong command line, as every other mistake is told.
Diagnostic misused(const CLI::App& app, const CLI::ParseError& problem) {
  const CLI::App* command = &app;
  std::string name = "kinegraph";
  for (auto within = app.get_subcommands(); !within.empty(); within = command->get_subcommands()) {
    command = within.front();
    name += " " + command->get_name();
  }
  std::string message = problem.what(), hint;
  std::vector<std::string> options, commands;
  for (const auto* option : command->get_options())
    for (const std::string& one : option->get_lnames()) options.push_back("--" + one);
  for (const auto* one : command->get_subcommands({})) commands.push_back(one->get_name());
  const std::size_t colon = message.rfind(": ");
  const std::string last = colon == message.npos ? "" : message.substr(colon + 2);
  if (dynamic_cast<const CLI::ExtrasError*>(&problem) && last.starts_with("-")) {
    const std::string near = nearest(last.substr(0, last.find_first_of(" =")), options);
    message = fmt::format("there is no option {}", last);
    if (!near.empty()) hint = fmt::format("did you mean {}? ", near);
  } else if (dynamic_cast<const CLI::ExtrasError*>(&problem)) {
    message = fmt::format("{} is one word too many", last);
  } else if (!commands.empty()) {
    message = fmt::format("{} needs a command", name);
    hint = fmt::format("{}; ", fmt::join(commands, ", "));
  } else if (const std::size_t equals = last.find(" = "); equals != last.npos) {
    message = fmt::format("{}: {} can't be read", last.substr(0, equals), in_quotes(last.substr(equals + 3)));
    hint = "wanted is a number; ";
  }
  return error("bad-option", message).hinting(fmt::format("{}{} --help tells how it is used", hint, name));
}

// The command line as CLI11 sees it, and what the chosen command will do.
int chosen(const Program& program, int argc, char** argv) {
  CLI::App app{"Kinegraph: a compositor for character motion.", "kinegraph"};
  app.set_version_flag("--version", "kinegraph " + program.version);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a node failed, 2 wrong usage, 3 a graph or file is invalid or a write refused,\n"
      "4 checks failed, 5 writing failed, 70 internal error, 124 timed out, 130 and 143 interrupted.");
  std::function<int()> act;

  RunArguments run;
  {
    auto& command = *app.add_subcommand("run", "Run a graph's Exports and Checks, or its published outputs");
    add_graph(command, run.graph);
    add_run_options(command, run);
    command.add_option("--target", run.targets, "Run only what this needs")
        ->type_name("NODE[.PORT]")
        ->allow_extra_args(false);
    command.callback([&] { act = [&] { return run_command(program, run); }; });
  }
  std::string port, file;
  {
    auto& command = *app.add_subcommand("get", "Write one output in any of Export's formats");
    add_graph(command, run.graph);
    command.add_option("NODE.PORT", port, "The output")->required()->type_name("");
    command.add_option("-o", file, "Where to; its ending names the format")->required()->type_name("FILE");
    add_run_options(command, run);
    command.callback([&] { act = [&] { return get_command(program, run, port, file); }; });
  }
  ValidateArguments validation;
  {
    auto& command = *app.add_subcommand("validate", "Check graphs without running them");
    command.add_option("GRAPH", validation.graphs, "Graph files")->required()->type_name("");
    command.add_flag("--json", validation.json, "Tell the problems as JSON");
    command.add_flag("--strict", validation.strict, "Warnings count as errors");
    command.add_flag("--no-files", validation.no_files, "Input files may be missing");
    command.add_option("--var", validation.vars, "Set a variable")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command.callback([&] { act = [&] { return validate_command(program, validation); }; });
  }
  std::vector<std::string> graphs;
  bool check = false, in_place = false, json = false, markdown = false;
  {
    auto& command = *app.add_subcommand("fmt", "Rewrite graphs in canonical form");
    command.add_option("GRAPH", graphs, "Graph files; - reads standard input and writes standard output")
        ->required()
        ->type_name("");
    command.add_flag("--check", check, "Only name those that aren't canonical, and exit 1");
    command.callback([&] { act = [&] { return fmt_command(program, graphs, check); }; });
  }
  {
    auto& command =
        *app.add_subcommand("upgrade", "Migrate old graphs to the current versions of their nodes");
    command.add_option("GRAPH", graphs, "Graph files")->required()->type_name("");
    command.add_flag("--in-place", in_place, "Rewrite the files");
    command.callback([&] { act = [&] { return upgrade_command(program, graphs, in_place); }; });
  }
  DiffArguments difference;
  {
    auto& command = *app.add_subcommand("diff", "What changed in meaning: nodes, links, parameters");
    command.add_option("A", difference.a, "A graph file")->required()->type_name("");
    command.add_option("B", difference.b, "Another, or a later state of it")->type_name("");
    command.add_flag("--check", difference.check, "Exit 1 when they differ");
    auto as_json = command.add_flag("--json", difference.json, "As JSON");
    command
        .add_flag("--textconv", difference.textconv, "A alone, one line for each thing it says, for git diff")
        ->excludes(as_json);
    command.callback([&] { act = [&] { return diff_command(program, difference); }; });
  }
  MergeArguments merging;
  {
    auto& command = *app.add_subcommand("merge", "Put two people's changes together, as git's merge driver");
    command.add_option("BASE", merging.base, "What both started from")->required()->type_name("");
    command.add_option("OURS", merging.ours, "One side")->required()->type_name("");
    command.add_option("THEIRS", merging.theirs, "The other")->required()->type_name("");
    command.add_option("-o", merging.out, "Where to; on a conflict with git's markers")
        ->required()
        ->type_name("OUT");
    command.add_option("--path", merging.path, "Where the graph stands (git's %P), for the graphs it uses")
        ->type_name("FILE");
    command.callback([&] { act = [&] { return merge_command(program, merging); }; });
  }
  std::string graph, node;
  {
    auto& command = *app.add_subcommand("dot", "A graph for Graphviz");
    add_graph(command, graph);
    command.callback([&] { act = [&] { return dot_command(program, graph); }; });
  }
  {
    auto& command =
        *app.add_subcommand("explain", "What a node's keys are made of, and whether its results are cached");
    add_graph(command, run.graph);
    command.add_option("NODE", node, "A node, or NODE.PORT")->required()->type_name("");
    add_inputs(command, run);
    add_cache(command, run);
    command.callback([&] { act = [&] { return explain_command(program, run, node); }; });
  }
  {
    auto& command = *app.add_subcommand("files", "What a graph reads and writes");
    add_graph(command, run.graph);
    command.add_flag("--json", json, "As JSON");
    add_inputs(command, run);
    command.add_option("--out", run.out, "Folder that exports go to")->type_name("DIR");
    command.callback([&] { act = [&] { return files_command(program, run, json); }; });
  }
  {
    auto& command = *app.add_subcommand("nodes", "The node reference");
    command.add_option("TYPE", node, "One type")->type_name("");
    auto as_json = command.add_flag("--json", json, "As JSON");
    command.add_flag("--markdown", markdown, "As Markdown")->excludes(as_json);
    command.callback([&] {
      act = [&] {
        return nodes_command(program, node,
                             json       ? ReferenceForm::json
                             : markdown ? ReferenceForm::markdown
                                        : ReferenceForm::text);
      };
    });
  }
  PictureArguments picture;
  {
    auto& command = *app.add_subcommand("picture", "Draw an output, or a motion file");
    command.add_option("GRAPH", picture.run.graph, "A graph, or a file of a motion or an analysis")
        ->required()
        ->type_name("");
    command.add_option("NODE.PORT", picture.ports, "The output; several motions stand one below the other")
        ->type_name("");
    command.add_option("-o", picture.file, "Where to")->required()->type_name("FILE.svg|.png");
    command.add_option("--title", picture.title, "Instead of the output's name")->type_name("TEXT");
    command.add_option("--moments", picture.moments, "How many moments a strip shows")
        ->type_name("N")
        ->check(CLI::Range(1, 60));
    add_run_options(command, picture.run);
    command.callback([&] { act = [&] { return picture_command(program, picture); }; });
  }
  CompareArguments comparison;
  {
    auto& command = *app.add_subcommand("compare", "How two motions, or two files of metrics, differ");
    command.add_option("A", comparison.a, "A motion file")->required()->type_name("");
    command.add_option("B", comparison.b, "Another")->required()->type_name("");
    command.add_flag("--json", comparison.json, "As JSON");
    command
        .add_option("--rule", comparison.rules, "What must hold, such as 'difference.position_max < 0.001'")
        ->type_name("RULE")
        ->allow_extra_args(false);
    command.callback([&] { act = [&] { return compare_command(program, comparison); }; });
  }
  InfoArguments about;
  {
    auto& command =
        *app.add_subcommand("info", "What a motion file holds: skeleton, frames, rate, unit, oddities");
    command.add_option("FILE", about.file, "The file")->required()->type_name("");
    command.add_flag("--json", about.json, "As JSON");
    command.callback([&] { act = [&] { return info_command(program, about); }; });
  }
  ConvertArguments conversion;
  {
    auto& command = *app.add_subcommand("convert", "A motion file in another format, rate or unit");
    command.add_option("IN", conversion.in, "The file to read")->required()->type_name("");
    command.add_option("OUT", conversion.out, "The file to write; its ending tells the format")
        ->required()
        ->type_name("");
    command.add_option("--fps", conversion.fps, "Resample to so many frames a second")
        ->type_name("N")
        ->check(CLI::Range(0.001, 100000.0));
    command.add_option("--unit", conversion.unit, "The unit that IN is in: m, cm, mm, in, cmu, or metres")
        ->type_name("U");
    command.add_option("--out-unit", conversion.out_unit, "The unit for OUT; the source's without it")
        ->type_name("U");
    command.callback([&] { act = [&] { return convert_command(program, conversion); }; });
  }
  BatchArguments batch;
  {
    auto& command =
        *app.add_subcommand("batch", "Run a graph over many clips, or put reports of shards together");
    command.add_option("GRAPH", batch.run.graph, "A graph file, *.kg.json")->type_name("");
    command.add_option("--each", batch.each, "Run once for each file; several go in step")
        ->type_name("NODE.PARAM=GLOB")
        ->allow_extra_args(false);
    command.add_flag("--cross", batch.cross, "Run every combination instead");
    command.add_option("--table", batch.table, "Run once for each row; the header names NODE.PARAM")
        ->type_name("FILE.csv");
    command
        .add_option("--shard", batch.shard,
                    "Run only this part, counted from 0; Slurm's arrays need no telling")
        ->type_name("I/N");
    command.add_flag("--resume", batch.resume, "Skip items whose files are there and still right");
    command.add_option("--target", batch.run.targets, "Run only what this needs")
        ->type_name("NODE[.PORT]")
        ->allow_extra_args(false);
    add_run_options(command, batch.run);
    command.add_option("--merge-reports", batch.merge_reports, "Make one report of those of several shards")
        ->type_name("FILE.json");
    command.add_option("-o", batch.merged, "Where that goes")->type_name("FILE.json");
    command.callback([&] { act = [&] { return batch_command(program, batch); }; });
  }
  std::string folder;
  {
    auto& command =
        *app.add_subcommand("pack", "The graph, nested graphs and clips in one folder, to hand on");
    add_graph(command, run.graph);
    command.add_option("-o", folder, "The folder")->required()->type_name("DIR");
    add_variables(command, run);
    command.callback([&] { act = [&] { return pack_command(program, run, folder); }; });
  }
  CacheArguments cache;
  {
    auto& command = *app.add_subcommand("cache", "Look after a cache folder");
    command.require_subcommand(1);
    auto add = [&](const char* name, const char* help,
                   int (*function)(const Program&, const CacheArguments&)) {
      auto& sub = *command.add_subcommand(name, help);
      sub.add_option("--cache", cache.folder, "The folder (also $KINEGRAPH_CACHE)")->type_name("DIR");
      sub.callback(
          [&act, &cache, &program, function] { act = [&, function] { return function(program, cache); }; });
      return &sub;
    };
    add("stat", "How much it holds", cache_stat_command);
    add("gc", "Remove what was used longest ago, and what killed writers left", cache_gc_command)
        ->add_option("--cache-limit", cache.limit, "Most that may stay, such as 10G")
        ->type_name("SIZE");
    add("clear", "Remove everything", cache_clear_command);
    add("verify", "Read every entry and check it", cache_verify_command);
  }

  // CLI11 would only say that a command is missing.
  const CLI::App* within = &app;
  for (int i = 1; i < argc && argv[i][0] != '-' && !within->get_subcommands({}).empty(); ++i) {
    std::vector<std::string> names;
    const CLI::App* found = nullptr;
    for (const auto* command : within->get_subcommands({})) {
      names.push_back(command->get_name());
      if (command->get_name() == argv[i]) found = command;
    }
    if (!found)
      throw UsageError(Diagnostic(
          error("unknown-command", fmt::format("there is no command \"{}{}\"",
                                               within == &app ? "" : within->get_name() + " ", argv[i]))
              .hinting(suggestion(argv[i], names))));
    within = found;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // it was asked for help or the version
    throw UsageError(misused(app, problem));
  }
  return act();
}

}  // namespace

int main(int argc, char** argv) {
  Terminal terminal;
  try {
    choose_cpu_from_environment();
    Registry registry = all_nodes();
    Program program{registry, terminal, KINEGRAPH_VERSION};
    int code = chosen(program, argc, argv);
    if (!terminal.results_written()) code = exit_code::graver(code, exit_code::cannot_write);
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
