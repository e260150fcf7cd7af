#include "graph/evaluate/compute_node.h"

#include <algorithm>
#include <chrono>

#include "graph/evaluate/caught.h"
#include "graph/evaluate/demand.h"
#include "graph/evaluate/note_paths.h"

namespace kinegraph {

namespace {

Diagnostic changed_while_read(const NodeCompute& compute) {
  if (const auto* file = compute.file_changed()) {
    return error("file-changed", "'" + file->shown + "' keeps changing while it is read")
        .at_param(file->param)
        .hinting("run again when it is written");
  }
  return error("undeclared-file",
               "reads '" + compute.undeclared() + "', which its parameters and companions don't name")
      .hinting("this is a fault of the node type");
}

}  // namespace

Attempt compute_node(const NodeCompute::World& world, NodeWork& work, const Halt& halt,
                     std::map<std::string, std::vector<ValuePtr>> inputs,
                     const std::set<std::string>& wanted) {
  using End = Attempt::End;
  const auto start = std::chrono::steady_clock::now();
  NodeCompute compute(world, std::move(inputs), wanted);
  Attempt attempt;
  const auto changed = [&] { return compute.file_changed() || !compute.undeclared().empty(); };
  try {
    work.check();
    world.node.type->compute(compute);
    const auto notes = work.reported();
    const auto told = std::find_if(notes.begin(), notes.end(),
                                   [](const auto& note) { return note.severity == Severity::error; });
    if (told != notes.end()) throw Failure(*told);
    if (!changed()) compute.staged().put_in_place();
  } catch (const Cancelled&) {
    attempt.end = halt.asked() ? End::cancelled : End::failed;
    attempt.failure = error("internal", "stopped, though nobody asked it to");
  } catch (...) {
    attempt.end = End::failed;
    attempt.failure = caught();
  }
  // A node may have caught the exception that told it of the change.
  if (attempt.end != End::cancelled && changed()) {
    attempt.end = End::file_changed;
    attempt.failure = changed_while_read(compute);
  }
  attempt.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const auto& note : work.reported()) {
    if (note.severity != Severity::error) merge_notes(attempt.notes, {without_paths(note, world.files)});
  }
  // Files that are in place are told of even if a later one failed.
  for (auto& file : compute.staged().files()) {
    if (!file.placed) continue;
    const auto bytes = file.content.size();
    attempt.files.push_back({world.node.name, file.path, bytes, std::move(file.content)});
  }
  if (attempt.end != End::done) return attempt;
  attempt.failure.reset();
  attempt.outputs = std::move(compute.outputs());
  for (const auto& port : wanted) attempt.outputs.try_emplace(port);
  attempt.rules = std::move(compute.rules());
  return attempt;
}

}  // namespace kinegraph
