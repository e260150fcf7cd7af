// Strict JSON text -> Json with places and number spellings.
#pragma once
#include <string>
#include <string_view>

#include "graph/diagnostic.h"
#include "graph/json.h"

namespace kinegraph {

inline constexpr std::size_t largest_json = std::size_t{64} << 20;  // bytes
inline constexpr int deepest_json = 64;                             // levels of lists and objects

// Refuses what RFC 8259 doesn't allow (codes "syntax", "bad-number", "trailing-comma", "comment"), duplicate keys
// ("duplicate-key"), invalid UTF-8 ("bad-utf8"), a byte-order mark ("byte-order-mark"), numbers that aren't finite
// ("not-finite"), more than 64 levels ("too-deep"), more than 64 MiB ("too-large") and git's conflict markers
// ("conflict-markers"). Problems go to `problems`, each with line and column (both from 1, columns in characters); on
// one that stops the reading the result is null. `file` is how messages name the text.
Json parse_json(std::string_view text, const std::string& file, Diagnostics& problems);

}  // namespace kinegraph
