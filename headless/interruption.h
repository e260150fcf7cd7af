// SIGINT and SIGTERM ask the run to stop, so that it can leave everything whole and write its report; a
// second one ends the program at once.
#pragma once
#include "graph/evaluate/evaluator.h"

namespace kinegraph {

// From now on a signal ends the program at once with 130 or 143, while no Interruption lives.
void end_on_signals();

// Ends the program without giving back memory, which can take longer than whoever stopped it should wait. All
// is written, and nobody else is at work.
[[noreturn]] void leave(int code);

// While it lives the signals go to its token. At most one at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  StopToken* token() { return &token_; }
  int exit_code() const;  // 130 or 143 after a signal, else 0

 private:
  StopToken token_;
};

}  // namespace kinegraph
