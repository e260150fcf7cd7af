#include "headless/offer_commands.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "headless/commands.h"

namespace kinegraph {
namespace {

void chooses(CLI::App& command, Choice& choice, const Choice& act) {
  command.callback([&choice, act] { choice = act; });
}

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

void offer_run(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<RunArguments>();
  auto& command = *app.add_subcommand("run", "Run a graph's Exports and Checks, or its published outputs");
  add_graph(command, given->graph);
  add_run_options(command, *given);
  command.add_option("--target", given->targets, "Run only what this needs")
      ->type_name("NODE[.PORT]")
      ->allow_extra_args(false);
  chooses(command, choice, [given](const Program& program) { return run_command(program, *given); });
}

void offer_get(CLI::App& app, Choice& choice) {
  struct Given {
    RunArguments run;
    std::string port;
    std::string file;
  };
  const auto given = std::make_shared<Given>();
  auto& command = *app.add_subcommand("get", "Write one output in any of Export's formats");
  add_graph(command, given->run.graph);
  command.add_option("NODE.PORT", given->port, "The output")->required()->type_name("");
  command.add_option("-o", given->file, "Where to; its ending names the format")
      ->required()
      ->type_name("FILE");
  add_run_options(command, given->run);
  chooses(command, choice, [given](const Program& program) {
    return get_command(program, given->run, given->port, given->file);
  });
}

void offer_validate(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<ValidateArguments>();
  auto& command = *app.add_subcommand("validate", "Check graphs without running them");
  command.add_option("GRAPH", given->graphs, "Graph files")->required()->type_name("");
  command.add_flag("--json", given->json, "Tell the problems as JSON");
  command.add_flag("--strict", given->strict, "Warnings count as errors");
  command.add_flag("--no-files", given->no_files, "Input files may be missing");
  command.add_option("--var", given->vars, "Set a variable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  chooses(command, choice, [given](const Program& program) { return validate_command(program, *given); });
}

void offer_fmt(CLI::App& app, Choice& choice) {
  struct Given {
    std::vector<std::string> graphs;
    bool check = false;
  };
  const auto given = std::make_shared<Given>();
  auto& command = *app.add_subcommand("fmt", "Rewrite graphs in canonical form");
  command
      .add_option("GRAPH", given->graphs, "Graph files; - reads standard input and writes standard output")
      ->required()
      ->type_name("");
  command.add_flag("--check", given->check, "Only name those that aren't canonical, and exit 1");
  chooses(command, choice,
          [given](const Program& program) { return fmt_command(program, given->graphs, given->check); });
}

void offer_upgrade(CLI::App& app, Choice& choice) {
  struct Given {
    std::vector<std::string> graphs;
    bool in_place = false;
  };
  const auto given = std::make_shared<Given>();
  auto& command = *app.add_subcommand("upgrade", "Migrate old graphs to the current versions of their nodes");
  command.add_option("GRAPH", given->graphs, "Graph files")->required()->type_name("");
  command.add_flag("--in-place", given->in_place, "Rewrite the files");
  chooses(command, choice, [given](const Program& program) {
    return upgrade_command(program, given->graphs, given->in_place);
  });
}

void offer_diff(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<DiffArguments>();
  auto& command = *app.add_subcommand("diff", "What changed in meaning: nodes, links, parameters");
  command.add_option("A", given->a, "A graph file")->required()->type_name("");
  command.add_option("B", given->b, "Another, or a later state of it")->type_name("");
  command.add_flag("--check", given->check, "Exit 1 when they differ");
  auto as_json = command.add_flag("--json", given->json, "As JSON; not with --textconv");
  command.add_flag("--textconv", given->textconv, "A alone, one line for each thing it says, for git diff")
      ->excludes(as_json);
  chooses(command, choice, [given](const Program& program) { return diff_command(program, *given); });
}

void offer_merge(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<MergeArguments>();
  auto& command = *app.add_subcommand("merge", "Put two people's changes together, as git's merge driver");
  command.add_option("BASE", given->base, "What both started from")->required()->type_name("");
  command.add_option("OURS", given->ours, "One side")->required()->type_name("");
  command.add_option("THEIRS", given->theirs, "The other")->required()->type_name("");
  command.add_option("-o", given->out, "Where to; on a conflict with git's markers")
      ->required()
      ->type_name("OUT");
  command.add_option("--path", given->path, "Where the graph stands (git's %P), for the graphs it uses")
      ->type_name("FILE");
  chooses(command, choice, [given](const Program& program) { return merge_command(program, *given); });
}

void offer_dot(CLI::App& app, Choice& choice) {
  struct Given {
    std::string graph;
  };
  const auto given = std::make_shared<Given>();
  auto& command = *app.add_subcommand("dot", "A graph for Graphviz");
  add_graph(command, given->graph);
  chooses(command, choice, [given](const Program& program) { return dot_command(program, given->graph); });
}

void offer_explain(CLI::App& app, Choice& choice) {
  struct Given {
    RunArguments run;
    std::string node;
  };
  const auto given = std::make_shared<Given>();
  auto& command =
      *app.add_subcommand("explain", "What a node's keys are made of, and whether its results are cached");
  add_graph(command, given->run.graph);
  command.add_option("NODE", given->node, "A node, or NODE.PORT")->required()->type_name("");
  add_inputs(command, given->run);
  add_cache(command, given->run);
  chooses(command, choice,
          [given](const Program& program) { return explain_command(program, given->run, given->node); });
}

void offer_files(CLI::App& app, Choice& choice) {
  struct Given {
    RunArguments run;
    bool json = false;
  };
  const auto given = std::make_shared<Given>();
  auto& command = *app.add_subcommand("files", "What a graph reads and writes");
  add_graph(command, given->run.graph);
  command.add_flag("--json", given->json, "As JSON");
  add_inputs(command, given->run);
  command.add_option("--out", given->run.out, "Folder that exports go to")->type_name("DIR");
  chooses(command, choice,
          [given](const Program& program) { return files_command(program, given->run, given->json); });
}

void offer_nodes(CLI::App& app, Choice& choice) {
  struct Given {
    std::string node;
    bool json = false;
    bool markdown = false;
  };
  const auto given = std::make_shared<Given>();
  auto& command = *app.add_subcommand("nodes", "The node reference");
  command.add_option("TYPE", given->node, "One type")->type_name("");
  auto as_json = command.add_flag("--json", given->json, "As JSON; not with --markdown");
  command.add_flag("--markdown", given->markdown, "As Markdown")->excludes(as_json);
  chooses(command, choice, [given](const Program& program) {
    return nodes_command(program, given->node,
                         given->json       ? ReferenceForm::json
                         : given->markdown ? ReferenceForm::markdown
                                           : ReferenceForm::text);
  });
}

void offer_picture(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<PictureArguments>();
  auto& command = *app.add_subcommand("picture", "Draw an output, or a motion file");
  command.add_option("GRAPH", given->run.graph, "A graph, or a file of a motion or an analysis")
      ->required()
      ->type_name("");
  command.add_option("NODE.PORT", given->ports, "The output; several motions stand one below the other")
      ->type_name("");
  command.add_option("-o", given->file, "Where to")->required()->type_name("FILE.svg|.png");
  command.add_option("--title", given->title, "Instead of the output's name")->type_name("TEXT");
  command.add_option("--moments", given->moments, "How many moments a strip shows")
      ->type_name("N")
      ->check(CLI::Range(1, 60));
  add_run_options(command, given->run);
  chooses(command, choice, [given](const Program& program) { return picture_command(program, *given); });
}

void offer_compare(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<CompareArguments>();
  auto& command =
      *app.add_subcommand("compare", "How two motions of one rate, or two files of metrics, differ");
  command.add_option("A", given->a, "A motion file; rules judge it")->required()->type_name("");
  command.add_option("B", given->b, "Another, the baseline of rules: baseline.NAME is its metric")
      ->required()
      ->type_name("");
  command.add_flag("--json", given->json, "As JSON");
  command
      .add_option(
          "--rule", given->rules,
          "What must hold of A, such as 'difference.position_max < 0.001' or 'skate <= baseline.skate'")
      ->type_name("RULE")
      ->allow_extra_args(false);
  chooses(command, choice, [given](const Program& program) { return compare_command(program, *given); });
}

void offer_info(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<InfoArguments>();
  auto& command =
      *app.add_subcommand("info", "What a motion file holds: skeleton, frames, rate, unit, oddities");
  command.add_option("FILE", given->file, "The file")->required()->type_name("");
  command.add_flag("--json", given->json, "As JSON");
  chooses(command, choice, [given](const Program& program) { return info_command(program, *given); });
}

void offer_convert(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<ConvertArguments>();
  auto& command = *app.add_subcommand("convert", "A motion file in another format, rate or unit");
  command.add_option("IN", given->in, "The file to read")->required()->type_name("");
  command.add_option("OUT", given->out, "The file to write; its ending tells the format")
      ->required()
      ->type_name("");
  command.add_option("--fps", given->fps, "Resample to so many frames a second")
      ->type_name("N")
      ->check(CLI::Range(0.001, 100000.0));
  command.add_option("--unit", given->unit, "The unit that IN is in: m, cm, mm, in, cmu, or metres")
      ->type_name("U");
  command
      .add_option("--out-unit", given->out_unit,
                  "The unit for OUT, of bvh, c3d and trc; the source's without it. The others are in metres")
      ->type_name("U");
  chooses(command, choice, [given](const Program& program) { return convert_command(program, *given); });
}

void offer_batch(CLI::App& app, Choice& choice) {
  const auto given = std::make_shared<BatchArguments>();
  auto& command =
      *app.add_subcommand("batch", "Run a graph over many clips, or put reports of shards together");
  command.add_option("GRAPH", given->run.graph, "A graph file, *.kg.json")->type_name("");
  command.add_option("--each", given->each, "Run once for each file; several go in step")
      ->type_name("NODE.PARAM=GLOB")
      ->allow_extra_args(false);
  command.add_flag("--cross", given->cross, "Run every combination instead");
  command.add_option("--table", given->table, "Run once for each row; the header names NODE.PARAM")
      ->type_name("FILE.csv");
  command
      .add_option("--shard", given->shard,
                  "Run only this part, counted from 0; Slurm's arrays need no telling")
      ->type_name("I/N");
  command.add_flag("--resume", given->resume, "Skip items whose files are there and still right");
  command.add_option("--target", given->run.targets, "Run only what this needs")
      ->type_name("NODE[.PORT]")
      ->allow_extra_args(false);
  add_run_options(command, given->run);
  command.add_option("--merge-reports", given->merge_reports, "Make one report of those of several shards")
      ->type_name("FILE.json");
  command.add_option("-o", given->merged, "Where that goes")->type_name("FILE.json");
  chooses(command, choice, [given](const Program& program) { return batch_command(program, *given); });
}

void offer_pack(CLI::App& app, Choice& choice) {
  struct Given {
    RunArguments run;
    std::string folder;
  };
  const auto given = std::make_shared<Given>();
  auto& command = *app.add_subcommand("pack", "The graph, nested graphs and clips in one folder, to hand on");
  add_graph(command, given->run.graph);
  command.add_option("-o", given->folder, "The folder")->required()->type_name("DIR");
  add_variables(command, given->run);
  chooses(command, choice,
          [given](const Program& program) { return pack_command(program, given->run, given->folder); });
}

void offer_cache(CLI::App& app, Choice& choice) {
  auto& command = *app.add_subcommand("cache", "Look after a cache folder");
  command.require_subcommand(1);
  const auto given = std::make_shared<CacheArguments>();
  auto add = [&](const char* name, const char* help, int (*function)(const Program&, const CacheArguments&)) {
    auto& sub = *command.add_subcommand(name, help);
    sub.add_option("--cache", given->folder, "The folder (also $KINEGRAPH_CACHE)")->type_name("DIR");
    chooses(sub, choice, [given, function](const Program& program) { return function(program, *given); });
    return &sub;
  };
  add("stat", "How much it holds", cache_stat_command);
  add("gc", "Remove what was used longest ago, and what killed writers left", cache_gc_command)
      ->add_option("--cache-limit", given->limit, "Most that may stay, such as 10G")
      ->type_name("SIZE");
  add("clear", "Remove everything", cache_clear_command);
  add("verify", "Read every entry and check it", cache_verify_command);
}

}  // namespace

void offer_commands(CLI::App& app, Choice& choice) {
  offer_run(app, choice);
  offer_get(app, choice);
  offer_validate(app, choice);
  offer_fmt(app, choice);
  offer_upgrade(app, choice);
  offer_diff(app, choice);
  offer_merge(app, choice);
  offer_dot(app, choice);
  offer_explain(app, choice);
  offer_files(app, choice);
  offer_nodes(app, choice);
  offer_picture(app, choice);
  offer_compare(app, choice);
  offer_info(app, choice);
  offer_convert(app, choice);
  offer_batch(app, choice);
  offer_pack(app, choice);
  offer_cache(app, choice);
}

}  // namespace kinegraph
