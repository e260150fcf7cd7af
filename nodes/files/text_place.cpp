#include "nodes/files/text_place.h"

#include <algorithm>
#include <cstdint>

namespace kinegraph {

Place place_in(std::string_view text, const char* at) {
  Place place{1, 1};
  const char* line = text.data();
  for (const char* c = text.data(); c < at; ++c)
    if (*c == '\n' || (*c == '\r' && (c + 1 == text.data() + text.size() || c[1] != '\n'))) {
      ++place.line;
      line = c + 1;
    }
  place.column = static_cast<int>(at - line) + 1;
  return place;
}

void fail_at(std::string_view text, const char* at, std::string code, std::string message, std::string hint) {
  throw Failure(
      error(std::move(code), std::move(message)).hinting(std::move(hint)).in_file({}, place_in(text, at)));
}

std::string shown(std::string_view bytes) {
  bool changed = false;
  const std::string text = as_utf8(bytes.substr(0, 40), changed);
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<std::uint8_t>(text[i]);
    const bool high = c == 0xC2 && static_cast<std::uint8_t>(text[i + 1]) < 0xA0;
    if (c < ' ' || c == 127 || high)  // what a terminal would obey
      out += '?';
    else
      out += text[i];
    i += high;
  }
  return '"' + out + '"';
}

std::string word_at(std::string_view text, const char* at) {
  const char* end = text.data() + text.size();
  const char* stop = at;
  while (stop < end && stop - at < 40 && !is_blank(*stop) && !is_line_end(*stop)) ++stop;
  if (stop == at) return at >= end ? "the end of the file" : "the end of the line";
  return shown({at, static_cast<std::size_t>(stop - at)});
}

namespace {

// Length of the UTF-8 sequence at the start of `bytes`, 0 when there is none.
std::size_t sequence_length(std::string_view bytes) {
  auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  std::uint8_t lead = byte(0);
  std::size_t length = lead < 0x80                   ? 1
                       : lead >= 0xC2 && lead < 0xE0 ? 2
                       : (lead & 0xF0) == 0xE0       ? 3
                       : lead >= 0xF0 && lead < 0xF5 ? 4
                                                     : 0;
  if (length == 0 || length > bytes.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  if (lead == 0xE0 && byte(1) < 0xA0) return 0;  // overlong
  if (lead == 0xED && byte(1) > 0x9F) return 0;  // surrogates
  if (lead == 0xF0 && byte(1) < 0x90) return 0;
  if (lead == 0xF4 && byte(1) > 0x8F) return 0;
  return length;
}

}  // namespace

std::string as_utf8(std::string_view bytes, bool& changed) {
  std::string out;
  while (!bytes.empty()) {
    std::size_t length = sequence_length(bytes);
    if (length) {
      out.append(bytes.substr(0, length));
      bytes.remove_prefix(length);
      continue;
    }
    auto byte = static_cast<std::uint8_t>(bytes[0]);
    out += static_cast<char>(0xC0 | byte >> 6);
    out += static_cast<char>(0x80 | (byte & 0x3F));
    bytes.remove_prefix(1);
    changed = true;
  }
  return out;
}

std::string_view trimmed(std::string_view text) {
  auto blank = [](char c) { return is_blank(c) || is_line_end(c) || c == '\v' || c == '\f'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return lower;
}

}  // namespace kinegraph
