#include "headless/draws/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "graph/file/write.h"
#include "headless/commands.h"
#include "headless/draws/strip.h"
#include "headless/exit_code.h"
#include "headless/loaded_file.h"
#include "headless/run_outcome.h"

namespace kinegraph {

namespace {

struct Drawn {
  std::string name;
  ValuePtr value;
  ValuePtr
      beside;  // a motion's contacts, the motion that contacts were found in or a character makes; or none
};

// An output's value, or none where it can't be had.
ValuePtr value_of(Session& session, const Program& program, const std::string& node,
                  const std::string& port) {
  Progress silent(Progress::Form::none, program.terminal);
  session.run({{node, port}}, silent, nullptr);
  return session.evaluator().value(session.plan(), node, port);
}

// What a picture shows beside a value. It is an extra: where it can't be had, the picture does without.
ValuePtr beside(Session& session, const Program& program, const Target& target) {
  Plan& plan = session.plan();
  auto source = plan.find_output(target.node, target.port);
  if (!source || source->node < 0) return {};
  auto type = session.type_of(target);
  if (type == "Contacts") {
    const auto& inputs = plan.nodes[static_cast<std::size_t>(source->node)].inputs;
    auto motion = inputs.find("motion");
    if (motion == inputs.end() || motion->second.empty() || motion->second.front().node < 0) return {};
    const auto& from = motion->second.front();
    return value_of(session, program, plan.nodes[static_cast<std::size_t>(from.node)].name, from.port);
  }
  if (type == "Character") {
    const PlannedNode& node = plan.nodes[static_cast<std::size_t>(source->node)];
    return node.type && node.type->find_output("motion") ? value_of(session, program, node.name, "motion")
                                                         : ValuePtr();
  }
  const NodeType* detect = program.registry.find("DetectContacts");
  if (type != "Motion" || !detect) return {};
  PlannedNode node;
  node.name = "contacts of " + target.node + "." + target.port;
  node.type = detect;
  node.type_name = detect->name;
  for (const auto& param : detect->params) node.params[param.name] = *param.fallback;
  node.inputs["motion"] = {*source};
  auto name = node.name;
  plan.by_name[name] = static_cast<int>(plan.nodes.size());
  plan.nodes.push_back(std::move(node));
  return value_of(session, program, name, "contacts");
}

// Whether a motion moves any of a character's joints.
bool fits(const Character& character, const Motion& motion) {
  const auto& joints = character.skeleton->joints;
  return std::any_of(joints.begin(), joints.end(),
                     [&](const Joint& joint) { return motion.skeleton().find(joint.name) >= 0; });
}

Canvas drawing_of(const std::vector<Drawn>& all, const PictureArguments& arguments,
                  const std::string& title) {
  if (all.size() == 1) {
    PictureOptions options{.title = title, .moments = arguments.moments};
    options.contacts = dynamic_cast<const Contacts*>(all[0].beside.get());
    options.motion = dynamic_cast<const Motion*>(all[0].beside.get());
    return picture_of(*all[0].value, options);
  }
  StripOptions options{.title = title, .subtitle = "", .moments = arguments.moments, .contact_bars = false};
  std::vector<StripRow> rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Drawn& one = all[i];
    if (auto motion = dynamic_cast<const Motion*>(one.value.get())) {
      rows.push_back({motion, one.name, dynamic_cast<const Contacts*>(one.beside.get())});
    } else if (auto character = dynamic_cast<const Character*>(one.value.get())) {
      // It is dressed in the motion named before it, else in its own.
      auto own = dynamic_cast<const Motion*>(one.beside.get());
      const auto* before = i > 0 ? dynamic_cast<const Motion*>(all[i - 1].value.get()) : nullptr;
      if (before && fits(*character, *before))
        rows.back().label += ", " + one.name;
      else if (own)
        rows.push_back({own, one.name});
      else
        throw UsageError(Diagnostic(error("no-picture", fmt::format("{} has no motion of its own", one.name))
                                        .hinting("name the motion to dress it in before it")));
      rows.back().character = character;
    } else {
      throw UsageError(
          error("no-picture",
                fmt::format("{} is no Motion and no Character; only those are drawn together", one.name)));
    }
  }
  if (rows.size() > 1)
    options.subtitle = fmt::format("{} motions at one scale", rows.size());
  else
    rows[0].label.clear();  // the title says it
  return draw_strips(rows, options);
}

int write_drawing(const Program& program, const std::vector<Drawn>& all, const PictureArguments& arguments,
                  std::string title) {
  if (!arguments.title.empty()) title = arguments.title;
  auto bytes = encoded_picture(drawing_of(all, arguments, title), arguments.file, title);
  try {
    write_file_atomically(absolute_path(arguments.file), bytes);
  } catch (const Failure& failure) {
    program.terminal.say(failure.diagnostic());
    return exit_code::cannot_write;
  }
  program.terminal.message(fmt::format("wrote {} ({})\n", arguments.file, size_text(bytes.size())));
  return exit_code::done;
}

// The files' names without extension, after as many of their folders as tell them apart.
std::vector<std::string> names_of(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) {
    const std::filesystem::path path = absolute_path(file);
    std::string name = path.stem().string();
    const auto is_shared = [&] {
      return std::any_of(files.begin(), files.end(), [&](const std::string& other) {
        const std::filesystem::path elsewhere = absolute_path(other);
        return elsewhere != path &&
               ("/" + (elsewhere.parent_path() / elsewhere.stem()).string()).ends_with("/" + name);
      });
    };
    for (auto folder = path.parent_path(); folder.has_filename() && is_shared();
         folder = folder.parent_path())
      name = folder.filename().string() + "/" + name;
    names.push_back(is_shared() ? path.filename().string() : name);  // walk.bvh beside walk.trc
  }
  return names;
}

int picture_of_files(const Program& program, const PictureArguments& arguments) {
  std::vector<std::string> files{arguments.run.graph};
  std::string port;
  for (const auto& word : arguments.ports) {  // an output of Load, or a further file for a row of its own
    const NodeType* load = program.registry.find("Load");
    if (load && load->find_output(word))
      port = word;
    else
      files.push_back(word);
  }
  const std::vector<std::string> names = names_of(files);
  std::vector<Drawn> all;
  for (const auto& file : files) {
    Session session(program, arguments.run, graph_of_file(file));
    program.terminal.say(session.problems());
    if (!session.valid()) return exit_code::invalid;
    auto loaded = load_file(session, program, port);
    if (port.empty() && loaded.port == "motion")  // a file with a mesh shows it
      if (auto character = value_of(session, program, "load", "character")) loaded = {character, "character"};
    all.push_back({names[all.size()], loaded.value, beside(session, program, {"load", loaded.port})});
  }
  std::string title;
  for (const auto& one : all) title += (title.empty() ? "" : ", ") + one.name;
  return write_drawing(program, all, arguments, title);
}

}  // namespace

int picture_command(const Program& program, const PictureArguments& arguments) {
  if (!arguments.file.ends_with(".svg") && !arguments.file.ends_with(".png"))
    throw UsageError(Diagnostic(
        error("unknown-picture-format", fmt::format("'{}' ends neither in .svg nor in .png", arguments.file))
            .hinting("name the picture FILE.svg or FILE.png")));
  if (!is_graph_file(arguments.run.graph)) return picture_of_files(program, arguments);
  if (arguments.ports.empty())
    throw UsageError(error(
        "no-port", fmt::format("{} is a graph: name the output to draw, NODE.PORT", arguments.run.graph)));

  std::vector<Target> targets;
  RunArguments options = arguments.run;
  options.infos = false;  // `kinegraph run` tells those; a picture is looked at often
  return run_to_outcome(
      program, options, open_graph(arguments.run.graph, program.registry),
      [&](Session& session) {
        for (const auto& text : arguments.ports) {
          targets.push_back(session.target(text));
          if (targets.back().port.empty())
            throw UsageError(Diagnostic(error("no-port", fmt::format("{} names a node and no output", text))
                                            .hinting("write NODE.PORT")));
        }
        return targets;
      },
      [&](Session& session, const Outcome&) {
        if (arguments.run.dry_run) return exit_code::done;
        std::vector<Drawn> all;
        for (std::size_t i = 0; i < targets.size(); ++i) {
          auto value = session.evaluator().value(session.plan(), targets[i].node, targets[i].port);
          if (!value) return exit_code::failed;  // the run has said why
          all.push_back({arguments.ports[i], value, {}});
        }
        for (std::size_t i = 0; i < targets.size(); ++i) all[i].beside = beside(session, program, targets[i]);
        try {
          return write_drawing(program, all, arguments,
                               all.size() == 1
                                   ? all[0].name
                                   : std::filesystem::path(arguments.run.graph).stem().stem().string());
        } catch (const UsageError&) {
          throw;
        } catch (const Failure& failure) {
          program.terminal.say(failure.diagnostic());
          return exit_code::failed;
        }
      });
}

}  // namespace kinegraph
