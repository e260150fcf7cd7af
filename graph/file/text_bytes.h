// What is wrong with a graph's text before it is read as JSON: bytes that aren't UTF-8 and characters that no
// text holds.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "graph/diagnostic.h"

namespace kinegraph {

// The offset of the first byte that isn't UTF-8 (RFC 3629: no overlong forms, no surrogates), or npos.
std::size_t first_bad_utf8(std::string_view text);
Diagnostic not_utf8(char byte);  // "bad-utf8"
// Whether the text's beginning is one that a person or a program may have meant as text.
bool is_text(std::string_view text);
// Whether as_text() would leave it as it is.
bool is_plain(std::string_view text);
// The text as JSON can be read from it: with U+FFFD for each byte that isn't UTF-8 ("bad-utf8") and for each
// control character inside a string, with a blank for such outside of strings and for blanks that JSON
// doesn't know ("bad-character"); the first of a kind is told in each line, and of a file that is UTF-16,
// that. Tabs inside strings are left. Columns stay, bytes move.
std::string as_text(std::string_view text, Diagnostics& found);
void append_utf8(std::string& text, unsigned code_point);
// Whether a message speaks of a text in which a byte or character was replaced.
bool has_replaced(std::string_view text);

}  // namespace kinegraph
