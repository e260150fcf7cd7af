#include "headless/progress.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/evaluate/run_log.h"
#include "graph/json.h"

namespace kinegraph {

Progress::Form Progress::form_of(std::string_view word, const Terminal& terminal) {
  if (word == "auto") return terminal.messages_on_terminal() ? Form::bar : Form::none;
  if (word == "bar") return Form::bar;
  if (word == "json") return Form::json;
  if (word == "none") return Form::none;
  throw Failure(error("bad-progress", fmt::format("--progress can't be '{}'", word))
                    .hinting("auto, bar, json or none"));
}

Progress::Progress(Form form, const Terminal& terminal)
    : form_(form), terminal_(terminal), started_(std::chrono::steady_clock::now()), last_drawn_(started_) {}

Progress::~Progress() {
  finish();
}

void Progress::expect(std::size_t nodes) {
  std::lock_guard lock(mutex_);
  expected_ = nodes;
}

void Progress::tell(const std::string& node, std::string_view state, double fraction) {
  if (form_ == Form::none) return;
  std::lock_guard lock(mutex_);
  if (form_ == Form::json) {
    terminal_.message(compact(Json(Json::Object{
                          {"node", Json(node)}, {"state", Json(state)}, {"progress", Json(fraction)}})) +
                      "\n");
    return;
  }
  if (state == name_of(NodeState::cancelled)) return;  // the bar stays where the node came to
  if (state == "running") {
    running_[node] = fraction;
    draw(false);
  } else {
    running_.erase(node);
    ++finished_;
    draw(finished_ == expected_);
  }
}

void Progress::draw(bool now) {
  using namespace std::chrono_literals;
  auto time = std::chrono::steady_clock::now();
  // What is over in a blink needs no bar; twenty times a second is as fast as an eye follows.
  if (time - started_ < 150ms || (!now && drawn_ && time - last_drawn_ < 50ms)) return;
  last_drawn_ = time;
  drawn_ = true;
  double whole = static_cast<double>(std::max(expected_, finished_ + running_.size()));
  double part = static_cast<double>(finished_);
  std::string names;
  for (const auto& [node, fraction] : running_) {
    part += fraction;
    names += fmt::format("{}{}{}", names.empty() ? "" : ", ", node,
                         fraction > 0 ? fmt::format(" {:.0f} %", 100 * fraction) : "");
  }
  double share = whole > 0 ? std::min(1.0, part / whole) : 0;
  const int cells = 28;
  int full = static_cast<int>(share * cells);
  std::string done, rest;
  for (int i = 0; i < cells; ++i) (i < full ? done : rest) += "━";
  double seconds = std::chrono::duration<double>(time - started_).count();
  std::string tail = fmt::format(" {:3.0f} %  {:.1f} s  ", 100 * share, seconds);
  int room = terminal_.columns() - cells - static_cast<int>(tail.size()) - 2;
  if (static_cast<int>(names.size()) > room)
    names = names.substr(0, static_cast<std::size_t>(std::max(0, room)));
  terminal_.message("\r\x1b[K" + terminal_.tinted_message(done, Tint::blue) +
                    terminal_.tinted_message(rest, Tint::faint) + tail + names);
}

void Progress::finish() {
  std::lock_guard lock(mutex_);
  if (drawn_) terminal_.message("\r\x1b[K");
  drawn_ = false;
}

}  // namespace kinegraph
