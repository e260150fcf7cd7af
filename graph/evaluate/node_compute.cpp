#include "graph/evaluate/node_compute.h"

#include <filesystem>
#include <stdexcept>

namespace kinegraph {

namespace {

std::logic_error against_description(const PlannedNode& node, const std::string& what) {
  return std::logic_error(node.type->name + " " + what);
}

}  // namespace

NodeCompute::NodeCompute(World world, std::map<std::string, std::vector<ValuePtr>> inputs,
                         std::set<std::string> wanted)
    : world_(world),
      params_(world.node.params),
      inputs_(std::make_move_iterator(inputs.begin()), std::make_move_iterator(inputs.end())),
      wanted_(std::make_move_iterator(wanted.begin()), std::make_move_iterator(wanted.end())) {}

std::span<const ValuePtr> NodeCompute::values(std::string_view port) const {
  if (!world_.node.type->find_input(port)) {
    throw against_description(world_.node,
                              "asks for an input '" + std::string(port) + "' that it doesn't declare");
  }
  const auto found = inputs_.find(port);
  if (found == inputs_.end()) return {};
  return found->second;
}

bool NodeCompute::wanted(std::string_view output) const {
  if (!world_.node.type->find_output(output)) {
    throw against_description(world_.node, "has no output '" + std::string(output) + "'");
  }
  return wanted_.contains(output);
}

void NodeCompute::set_output(std::string_view port, ValuePtr value) {
  const auto* output = world_.node.type->find_output(port);
  if (!output) throw against_description(world_.node, "has no output '" + std::string(port) + "'");
  if (value) {
    if (!output->type.empty() && value->type() != output->type) {
      throw against_description(world_.node, "gives " + std::string(value->type()) + " at '" +
                                                 std::string(port) + "', which is " + output->type);
    }
    if (const auto bad = value->non_finite()) {
      auto failure = error("not-finite", "the result's " + bad->what + " is not a finite number")
                         .at_port(std::string(port))
                         .at_joint(bad->joint)
                         .hinting("look at the node's inputs and parameters there");
      failure.frame = bad->frame;
      throw Failure(std::move(failure));
    }
  }
  outputs_[std::string(port)] = world_.ledger.hold(std::move(value));
}

void NodeCompute::write_file(std::string_view param, std::string_view bytes, std::string_view companion) {
  if (world_.node.type->effect != Effect::writes)
    throw against_description(world_.node, "writes, but doesn't say so");
  const std::string& file = params_.text(param);
  if (file.empty()) {
    throw Failure(error("no-file-name", "there is no file to write to")
                      .at_param(std::string(param))
                      .hinting("give the file a name"));
  }
  std::string path = file;
  if (!companion.empty()) path = (std::filesystem::path(file).parent_path() / companion).string();
  try {
    work().check();
    staged_.add(world_.rules.take(world_.node.name, path, file), bytes, [this] { work().check(); });
  } catch (const Failure& failure) {
    throw Failure(Diagnostic(failure.diagnostic()).at_param(std::string(param)));
  }
}

void NodeCompute::rule(std::string_view text, double value, double limit, bool passed) {
  if (world_.node.type->effect != Effect::checks)
    throw against_description(world_.node, "checks, but doesn't say so");
  rules_.push_back({world_.node.name, std::string(text), value, limit, passed});
}

FileBytes NodeCompute::read(const std::string& absolute_path) {
  for (const auto& file : world_.files) {
    if (file.path != absolute_path) continue;
    FileStore::Content content;
    try {
      content = world_.store.read_hashed(absolute_path,
                                         {file.shown, [this] { work().check(); },
                                          [this](std::size_t bytes) { return work().reserve(bytes); }});
    } catch (const Failure& failure) {
      auto told = failure.diagnostic();
      if (told.param.empty()) told.param = file.param;
      throw Failure(std::move(told));
    }
    if (file.digest != content.digest) {
      changed_ = &file;
      throw FileChanged();
    }
    return content.bytes;
  }
  if (!world_.store.exists(absolute_path)) return world_.store.read(absolute_path);  // says what is wrong
  undeclared_ = absolute_path;
  throw FileChanged();
}

bool NodeCompute::exists(const std::string& absolute_path) {
  work().check();
  return world_.store.exists(absolute_path);
}

std::vector<std::string> NodeCompute::list(const std::string& absolute_folder) {
  work().check();
  return world_.store.list(absolute_folder);
}

}  // namespace kinegraph
