// How far a run is, on standard error: a bar on a terminal, one JSON object a line for programs, or nothing.
#pragma once
#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "headless/terminal.h"

namespace kinegraph {

class Progress {
 public:
  enum class Form { none, bar, json };
  // "auto" is a bar where messages go to a terminal. Throws Failure ("bad-progress") for another word.
  static Form form_of(std::string_view word, const Terminal& terminal);

  Progress(Form form, const Terminal& terminal);
  ~Progress();  // takes the bar away
  // What will run, so that the bar knows the whole.
  void expect(std::size_t nodes);
  // From any thread.
  void tell(const std::string& node, std::string_view state, double fraction);
  void finish();

 private:
  void draw(bool now);

  const Form form_;
  const Terminal& terminal_;
  std::mutex mutex_;
  std::map<std::string, double> running_;
  std::size_t expected_ = 0, finished_ = 0;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point started_, last_drawn_;
};

}  // namespace kinegraph
