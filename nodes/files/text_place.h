// Where in a text something stands, and the errors that say so.
#pragma once
#include <string>
#include <string_view>

#include "graph/diagnostic.h"

namespace kinegraph {

// Line and column of a byte of `text`, both from 1; a column counts bytes. Slow: for messages.
Place place_in(std::string_view text, const char* at);
// A Failure at that place, in no file yet: read_motion_file adds the name.
[[noreturn]] void fail_at(std::string_view text, const char* at, std::string code, std::string message,
                          std::string hint = {});
// Bytes of a file in quotes, for messages: cut to 40, ? for what can't be printed.
std::string shown(std::string_view bytes);
// The same of the word that starts at `at`.
std::string word_at(std::string_view text, const char* at);
// Bytes that aren't UTF-8 taken as Latin-1; `changed` is set when there were any.
std::string as_utf8(std::string_view bytes, bool& changed);

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
inline bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}
inline const char* skip_blanks(const char* at, const char* end) {
  while (at < end && is_blank(*at)) ++at;
  return at;
}
std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);  // ASCII

}  // namespace kinegraph
