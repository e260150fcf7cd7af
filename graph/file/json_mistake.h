// What is wrong where a JSON text stops making sense, in a person's words.
#pragma once
#include <string>
#include <string_view>

#include "graph/diagnostic.h"
#include "graph/json.h"

namespace kinegraph {

// What the reader was waiting for.
enum class Wanted { value, name, colon, member_end, element_end, end };

// `offset`: where the last token that made sense ended. `inside`: a list or an object is open. The diagnostic
// has its place ("syntax", "bad-number", "not-finite", "trailing-comma", "comment") but not yet its file.
Diagnostic json_mistake(std::string_view text, std::size_t offset, Wanted wanted, bool inside);

// A number's text, which starts at `offset`: as far as characters go that numbers are made of.
std::string_view number_token(std::string_view text, std::size_t offset);
bool is_json_number(std::string_view token);

// Line and column of a byte, both from 1, columns in characters.
Place place_in(std::string_view text, std::size_t offset);

}  // namespace kinegraph
