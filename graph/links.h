// What flows along the links of a document: port types through Switch and Dot, whether a link fits, cycles.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

// The port type that comes out of `link`, followed through nodes that pass on what they get. Nothing where
// that can't be told: the node is missing or isn't there, the port is unknown, nothing is linked to a Dot, or
// the nodes form a cycle.
std::optional<std::string> type_of_output(const Document& document, const Registry& registry,
                                          const Link& link);

// The same for many links of one document, which lives as long and doesn't change: each node is followed
// once.
class OutputTypes {
 public:
  OutputTypes(const Document& document, const Registry& registry)
      : document_(document), registry_(registry) {}
  std::optional<std::string> of(const Link& link);

 private:
  const Document& document_;
  const Registry& registry_;
  // Of nodes that pass on what they get.
  std::map<std::string, std::optional<std::string>, std::less<>> passed_;
};

// What speaks against a link from `from` to the port, whatever is linked there now: "unknown-node",
// "unknown-port", "missing-node", "type-mismatch" (also further on, behind a Switch or Dot), "cycle". Nothing
// when it fits.
std::optional<Diagnostic> objection_to_link(const Document& document, const Registry& registry,
                                            const Link& from, const std::string& node,
                                            const std::string& port);

// Each cycle once, as the names of its nodes in the direction of flow, starting with the smallest name.
std::vector<std::vector<std::string>> cycles(const Document& document);
// Whether what `node` gives depends on `on` (or is it).
bool depends_on(const Document& document, const std::string& node, const std::string& on);

}  // namespace kinegraph
