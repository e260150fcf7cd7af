// The tokens of a text that isn't JSON as it stands: whatever the bytes, every one belongs to a token, a
// blank or a comment, and no string runs on past what can be meant by it.
#pragma once
#include <string_view>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/file/mended_text.h"

namespace kinegraph {

struct LooseToken {
  char kind = 0;                // { } [ ] , : or s, a string, or w, anything else up to a separator
  std::size_t at = 0, end = 0;  // bytes of the text
  bool first = false;           // of its line
  std::size_t indent = 0;       // blanks that its line begins with
  std::size_t line = 0;         // from 0

  bool opens() const { return kind == '{' || kind == '['; }
  bool closes() const { return kind == '}' || kind == ']'; }
};

// Something to tell, and the byte it stands at.
struct Slip {
  std::size_t at = 0;
  Diagnostic problem;
};

struct LooseText {
  std::vector<LooseToken> tokens;
  std::vector<Mend> mends;  // of strings without their first or last quote, or over several lines, and of
                            // comments that never end
  std::vector<Slip> slips;  // what is told of each, code "syntax" or "comment"
};
// A string that doesn't end in its line ends where the rest of the line then reads best as JSON; if nothing
// but its end can be what the following lines hold, there.
LooseText loose_tokens(std::string_view text);

}  // namespace kinegraph
