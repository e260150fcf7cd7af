#include "headless/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "headless/commands.h"

namespace kinegraph {
namespace {

// Where a word that nobody takes may have been meant to go: "OPTION …; ", or nothing.
std::string place_of_word(const CLI::App& command) {
  if (command.get_parent() && command.get_parent()->get_name() == "cache")
    return "the folder goes after --cache; ";
  for (const char* repeated : {"--target", "--set", "--var", "--each", "--rule", "--assets"})
    if (const auto* option = command.get_option_no_throw(repeated); option && option->count() > 0)
      return fmt::format("{0} takes one word: repeat {0} before each; ", repeated);
  return {};
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
  std::string last = colon == message.npos ? "" : message.substr(colon + 2);
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&problem) != nullptr;
  // Of several words that nobody takes, the option: the others may be its value.
  if (const std::size_t option = (" " + last).find(" -"); is_extra && option < last.size())
    last = last.substr(option, last.find(' ', option) - option);
  if (is_extra && last.starts_with("-")) {
    const std::string near = nearest(last.substr(0, last.find_first_of(" =")), options);
    message = fmt::format("there is no option {}", last);
    if (!near.empty()) hint = fmt::format("did you mean {}? ", near);
  } else if (is_extra) {
    message = fmt::format("{} is one word too many", last);
    hint = place_of_word(*command);
  } else if (!commands.empty()) {
    message = fmt::format("{} needs a command", name);
    hint = fmt::format("{}; ", fmt::join(commands, ", "));
  } else if (const std::size_t equals = last.find(" = "); equals != last.npos) {
    message = fmt::format("{}: {} can't be read", last.substr(0, equals), in_quotes(last.substr(equals + 3)));
    hint = "wanted is a number; ";
  }
  return error("bad-option", message).hinting(fmt::format("{}{} --help tells how it is used", hint, name));
}

// CLI11 would only say that a command is missing.
void check_that_commands_are_known(const CLI::App& app, int argc, char** argv) {
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
}

// Without CLI11's "Excludes: --other" between an option and what it does: the descriptions say it in words.
class HelpFormat : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = Formatter::make_option_opts(option);
    return text.substr(0, text.find(" Excludes:"));
  }
};

}  // namespace

Choice read_command_line(const Program& program, int argc, char** argv) {
  CLI::App app{"Kinegraph: a compositor for character motion.", "kinegraph"};
  app.set_version_flag("--version", "kinegraph " + program.version);
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormat>());
  app.footer(
      "Exit codes: 0 done, 1 a node failed, 2 wrong usage, 3 a graph or file is invalid or a write refused,\n"
      "4 checks failed, 5 writing failed, 70 internal error, 124 timed out, 130 and 143 interrupted.");
  Choice choice;
  offer_commands(app, choice);
  check_that_commands_are_known(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() != 0) throw UsageError(misused(app, problem));
    const int code = app.exit(problem);  // it was asked for help or the version
    return [code](const Program&) { return code; };
  }
  return choice;
}

}  // namespace kinegraph
