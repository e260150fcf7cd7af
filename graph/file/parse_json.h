// Strict JSON text -> Json with places and number spellings.
#pragma once
#include <string>
#include <string_view>

#include "graph/diagnostic.h"
#include "graph/json.h"
#include "graph/work.h"

namespace kinegraph {

inline constexpr std::size_t largest_json = std::size_t{64} << 20;  // bytes
inline constexpr int deepest_json = 64;                             // levels of lists and objects

// Refuses what RFC 8259 doesn't allow (codes "syntax", "bad-number", "trailing-comma", "comment"), duplicate
// keys ("duplicate-key"), invalid UTF-8 ("bad-utf8"), a byte-order mark ("byte-order-mark"), numbers that
// aren't finite ("not-finite"), more than 64 levels ("too-deep"), more than 64 MiB ("too-large") and git's
// conflict markers
// ("conflict-markers"). Problems go to `problems`, each with line and column (both from 1, columns in
// characters); on one that stops the reading the result is null. `file` is how messages name the text.
// `work` is asked at least once in each 64 KiB.
Json parse_json(std::string_view text, const std::string& file, Diagnostics& problems, Work* work = nullptr);

// What was read of a text that may hold mistakes. With an error among its problems it is only for judging.
struct ReadPast {
  Json json;  // null where the reading came to no end
  // A bracket is missing and nothing says where, or the text ends too early: of what is missing there, and of
  // where things stand, nothing is certain.
  bool in_doubt = false;
};
// Reads on past mistakes, telling each, so that the rest of the file can be judged as well: first those that
// can only be meant in one way (commas too many or missing, comments, single quotes, bare words, 012, NaN …);
// where that doesn't lead to the end, past brackets and quotes that are missing or too many, by what the text
// gives as evidence (bracket_rescue.h), and past what can't be read at all. A value that isn't known is the
// number NaN, spelled as it stood.
ReadPast parse_json_past_mistakes(std::string_view text, const std::string& file, Diagnostics& problems);

}  // namespace kinegraph
