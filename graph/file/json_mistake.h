// What is wrong where a reader of JSON stopped, in a person's words, and what was meant, where that is beyond
// doubt.
#pragma once
#include <optional>
#include <string_view>

#include "graph/diagnostic.h"
#include "graph/file/mended_text.h"

namespace kinegraph {

// What the reader was waiting for.
enum class Wanted { value, name, colon, member_end, element_end, end };

struct JsonMistake {
  // With its place; codes "syntax", "bad-number", "not-finite", "trailing-comma", "comment".
  Diagnostic problem;
  std::optional<Mend> mend;
};

// `cursor` stands behind the last token that was understood, and the reader stopped at the byte `stopped`, a
// comma or a colon further perhaps. `nothing_open`: no list or object is open there.
JsonMistake explain_json(JsonCursor cursor, std::size_t stopped, Wanted wanted, bool nothing_open);

bool is_number_character(char c);
// Whether a whole token is a number as RFC 8259 spells it.
bool is_json_number(std::string_view token);

}  // namespace kinegraph
