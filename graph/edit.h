// Edits of a document and their inverses. Undo lives here, without any window: a gesture makes one Edit, History keeps
// them. Every Edit is a list of unit changes, so its inverse is the same list turned round.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "graph/document.h"
#include "graph/registry.h"

namespace kinegraph {

struct Change {
  Unit unit;
  std::optional<Json> before;
  std::optional<Json> after;
};

struct Edit {
  std::string title;  // for the undo menu: "Rename walk to stroll"
  std::vector<Change> changes;
  bool empty() const { return changes.empty(); }
};

void apply(Document& document, const Edit& edit);
Edit inverse(const Edit& edit);
// `second` after `first` as one step; changes of one unit fold together (a slider's drag), and what ends as it began goes.
Edit combined(Edit first, const Edit& second);

// Each returns the edit without applying it. They throw Failure where the document or registry does not allow it:
// "unknown-node", "unknown-type", "unknown-param", "unknown-port", "bad-name", "name-taken", "missing-node" (a missing
// node's parameters and ports can't be changed, links to it can be cut), the codes of check() and objection_to_link().
Edit add_node(const Document&, const Registry&, const std::string& name, const std::string& type);
// Links, publishing and layout of the nodes go too. `reconnect`: what was linked behind them is linked to what they pass on.
Edit remove_nodes(const Document&, const Registry&, const std::vector<std::string>& names, bool reconnect);
Edit rename_node(const Document&, const std::string& from, const std::string& to);  // links, publish and ui follow
Edit set_param(const Document&, const Registry&, const std::string& node, const std::string& param, const Json& value);
Edit reset_param(const Document&, const std::string& node, const std::string& param);
Edit connect(const Document&, const Registry&, const Link& from, const std::string& node, const std::string& port);  // appends on a list port
Edit disconnect(const Document&, const Registry&, const std::string& node, const std::string& port, std::size_t index = 0);
Edit set_enabled(const Document&, const std::string& node, bool enabled);
Edit set_note(const Document&, const std::string& node, const std::string& note);
Edit set_unit(const Document&, const Unit&, std::optional<Json> value, std::string title);  // variables, publish, ui
// `middle` takes the link's source at its first input that fits, and gives from its first output that fits.
Edit insert_on_link(const Document&, const Registry&, const std::string& middle, const std::string& node, const std::string& port, std::size_t index = 0);
Edit take_out(const Document&, const Registry&, const std::string& node);  // of its wires, which are joined past it
// Adds a copied part of a graph under fresh names, moved by dx, dy; links to nodes outside it are kept where those still
// exist and the link fits. Variables that it brings and the document lacks are added. `names` receives the new names.
Edit paste(const Document&, const Registry&, const Document& part, int dx, int dy, std::vector<std::string>* names = nullptr);
// A document of these nodes alone, with their layout and the variables they use.
Document copied(const Document&, const Registry&, const std::vector<std::string>& names);

// A name for a new node of `type`: lower-case, ending in four random letters or digits so that two people's additions
// don't clash in a merge.
std::string fresh_name(const Document&, std::string_view type);

class History {
 public:
  void push(Edit edit);              // already applied; clears what could be redone
  // Folds into the newest step while a slider is dragged; a step of its own where that one was saved or undone.
  void extend(const Edit& edit);
  bool can_undo() const { return position_ > 0; }
  bool can_redo() const { return position_ < steps_.size(); }
  const Edit& undo(Document& document);  // applies the inverse and returns the step that was undone
  const Edit& redo(Document& document);
  // Changes what the steps hold, never how many they are: when paths move with the file, see move_paths.h.
  void rewrite(const std::function<void(Change&)>& with);
  void mark_saved() { saved_ = position_; }
  bool is_saved() const { return saved_ == position_; }
  const std::vector<Edit>& steps() const { return steps_; }
  std::size_t position() const { return position_; }

 private:
  static constexpr std::size_t never = static_cast<std::size_t>(-1);  // what was saved can't be reached any more
  std::vector<Edit> steps_;
  std::size_t position_ = 0;
  std::size_t saved_ = 0;
};

}  // namespace kinegraph
