// Edits as lists of unit changes: applying, turning round, folding, and the history of them.
#include "graph/edit.h"

#include <algorithm>
#include <stdexcept>

namespace kinegraph {

void apply(Document& document, const Edit& edit) {
  for (const Change& change : edit.changes) set(document, change.unit, change.after);
}

Edit inverse(const Edit& edit) {
  Edit result{edit.title, {}};
  for (auto change = edit.changes.rbegin(); change != edit.changes.rend(); ++change)
    result.changes.push_back({change->unit, change->after, change->before});
  return result;
}

namespace {

bool is_whole_node(const Unit& unit) {
  return unit.kind == Unit::Kind::node || unit.kind == Unit::Kind::missing_node;
}
bool is_of_node(const Unit& unit) {
  switch (unit.kind) {
    case Unit::Kind::node_type:
    case Unit::Kind::node_enabled:
    case Unit::Kind::node_note:
    case Unit::Kind::node_param:
    case Unit::Kind::node_input:
    case Unit::Kind::node_extra:
      return true;
    default:
      return is_whole_node(unit);
  }
}

// Whether two changes of different units may not change places: one of them makes or removes the node of the
// other.
bool in_the_way(const Unit& a, const Unit& b) {
  return a.name == b.name && is_of_node(a) && is_of_node(b) && (is_whole_node(a) || is_whole_node(b));
}

}  // namespace

Edit combined(Edit first, const Edit& second) {
  for (const Change& change : second.changes) {
    auto earlier = first.changes.end();
    for (auto other = first.changes.end(); other != first.changes.begin();) {
      --other;
      if (other->unit == change.unit) {
        earlier = other;
        break;
      }
      if (in_the_way(other->unit, change.unit)) break;
    }
    if (earlier == first.changes.end()) {
      first.changes.push_back(change);
      continue;
    }
    earlier->after = change.after;
    if (earlier->before == earlier->after) first.changes.erase(earlier);
  }
  return first;
}

void History::push(Edit edit) {
  if (edit.empty()) return;
  steps_.resize(position_);
  if (saved_ > position_) saved_ = never;
  steps_.push_back(std::move(edit));
  position_ = steps_.size();
}

void History::extend(const Edit& edit) {
  if (position_ == 0 || position_ == saved_ || position_ < steps_.size()) return push(edit);
  Edit folded = combined(std::move(steps_.back()), edit);
  if (folded.empty()) {
    steps_.pop_back();
    --position_;
  } else {
    steps_.back() = std::move(folded);
  }
}

void History::rewrite(const std::function<void(Change&)>& with) {
  for (Edit& step : steps_)
    for (Change& change : step.changes) with(change);
}

const Edit& History::undo(Document& document) {
  if (!can_undo()) throw std::logic_error("there is nothing to undo");
  const Edit& step = steps_[--position_];
  apply(document, inverse(step));
  return step;
}

const Edit& History::redo(Document& document) {
  if (!can_redo()) throw std::logic_error("there is nothing to redo");
  const Edit& step = steps_[position_++];
  apply(document, step);
  return step;
}

}  // namespace kinegraph
