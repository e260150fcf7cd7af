#include "graph/validate_nested.h"

#include <filesystem>
#include <set>

#include "graph/missing.h"
#include "graph/nested.h"

namespace kinegraph {

namespace {

namespace fs = std::filesystem;
using Spot = std::pair<std::string, std::string>;  // node and parameter, or node and port

class Inside {
 public:
  Inside(const Registry& registry, const ValidateOptions& options) : registry_(registry), options_(options) {
    variables_ = options.outer_variables;
  }

  // `given`, `linked`: parameters and inputs of the document's nodes that come from the file around it;
  // `needed`: null where all are.
  void look_into(const Document& document, const std::string& prefix, const std::set<Spot>& given,
                 const std::set<Spot>& linked, const std::set<std::string>* needed) {
    variables_.push_back(&document.variables);
    for (const auto& [name, node] : document.nodes) {
      if (!node.enabled || !node.nested || !node.nested->document) continue;
      if (needed && !needed->contains(name)) continue;
      const Document& inner = *node.nested->document;
      std::set<Spot> inner_given, inner_linked;
      for (const auto& [published, targets] : inner.publish.params)
        if (node.params.contains(published) || given.contains({name, published}))
          for (const Link& target : targets) inner_given.insert({target.node, target.port});
      for (const auto& [published, targets] : inner.publish.inputs)
        if (node.inputs.contains(published) || linked.contains({name, published}))
          for (const Link& target : targets) inner_linked.insert({target.node, target.port});
      const auto inner_needed = needed_of(inner, inner_linked);
      const std::string path = prefix + name + "/";
      tell(*node.nested, path, inner_given, inner_needed);
      look_into(inner, path, inner_given, inner_linked, &inner_needed);
    }
    variables_.pop_back();
  }
  Diagnostics problems() { return std::move(problems_); }

 private:
  static std::set<std::string> needed_of(const Document& document, const std::set<Spot>& linked) {
    std::set<std::string> needed;
    std::vector<std::string> next;
    for (const auto& [published, targets] : document.publish.outputs)
      for (const Link& target : targets) next.push_back(target.node);
    while (!next.empty()) {
      const std::string name = std::move(next.back());
      next.pop_back();
      const auto node = document.nodes.find(name);
      if (node == document.nodes.end() || !needed.insert(name).second) continue;
      for (const auto& [port, inputs] : node->second.inputs)
        if (!linked.contains({name, port}))
          for (const Link& link : inputs.links) next.push_back(link.node);
    }
    return needed;
  }

  void tell(const Nested& nested, const std::string& path, const std::set<Spot>& given,
            const std::set<std::string>& needed) {
    const Document& document = *nested.document;
    const std::string shown =
        (fs::path(options_.file).parent_path() / fs::path(nested.path).lexically_proximate(options_.folder))
            .lexically_normal()
            .generic_string();
    for (const std::string& name : needed) {
      const Node& node = document.nodes.at(name);
      if (auto why = why_missing(registry_, node)) {
        const Json* type = node.missing->find("type");
        why->node = path + name;
        problems_.push_back(std::move(*why).in_file(shown, type ? type->place : node.place));
      }
    }
    if (!options_.check_files) return;
    ValidateOptions options{.file = shown, .folder = nested.folder, .allow_outside = true};
    options.variables = options_.variables;
    options.outer_variables = variables_;
    for (Diagnostic& problem : validate(document, registry_, options)) {
      const bool of_a_file =
          problem.code == "missing-file" || problem.code == "not-a-regular-file" || problem.code == "no-file";
      if (!of_a_file || !needed.contains(problem.node) || given.contains({problem.node, problem.param}))
        continue;
      problem.node = path + problem.node;
      problems_.push_back(std::move(problem));
    }
  }

  const Registry& registry_;
  const ValidateOptions& options_;
  std::vector<const std::map<std::string, Json, std::less<>>*>
      variables_;  // of the files around, outermost first
  Diagnostics problems_;
};

}  // namespace

Diagnostics validate_nested(const Document& document, const Registry& registry,
                            const ValidateOptions& options) {
  Inside inside(registry, options);
  inside.look_into(document, "", {}, {}, nullptr);
  return inside.problems();
}

}  // namespace kinegraph
