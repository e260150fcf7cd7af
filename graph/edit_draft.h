// A document on its way to its next state, which remembers every unit it changes: how edits of many units are made.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "graph/diagnostic.h"
#include "graph/edit.h"

namespace kinegraph {

class EditDraft {
 public:
  EditDraft(const Document& document, std::string title) : document_(document), edit_{std::move(title), {}} {}

  const Document& document() const { return document_; }
  void set(const Unit& unit, std::optional<Json> after);
  void add_node(const std::string& name, const Node& node);
  void remove_node(const std::string& name);
  // Gives every link of the port to `change`, which returns what stands there instead, or nothing. What a missing node
  // has there that isn't a link stays.
  void change_links(const std::string& node, const std::string& port,
                    const std::function<std::optional<Link>(const Link&)>& change);
  // The same for all ports of all nodes.
  void change_links(const std::function<std::optional<Link>(const std::string& node, const std::string& port, const Link&)>& change);
  // The same for everything published.
  void change_published(const std::function<std::optional<Link>(Unit::Kind, const Link&)>& change);
  // Names in ui: the node's own entry and the frames it is in. Nothing: it is gone.
  void change_in_ui(const std::string& name, const std::optional<std::string>& instead);
  Edit take() { return std::move(edit_); }

 private:
  Document document_;
  Edit edit_;
};

// The node, or Failure ("unknown-node") that names the nearest.
const Node& node_or_fail(const Document& document, const std::string& name);
// Its type, or Failure ("missing-node").
const NodeType& type_or_fail(const Document& document, const Registry& registry, const std::string& name);
// What an output of `link.node` passes on when the node is out of the way, followed through all nodes for which
// `is_gone`; nothing where there is none.
std::optional<Link> link_past(const Document& document, const Registry& registry, const Link& link,
                              const std::function<bool(const std::string&)>& is_gone);

}  // namespace kinegraph
