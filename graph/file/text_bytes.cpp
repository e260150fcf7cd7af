#include "graph/file/text_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "graph/file/mended_text.h"

namespace kinegraph {

std::size_t first_bad_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
  for (std::size_t i = 0; i < text.size();) {
    std::uint64_t eight = 0;
    if (i + sizeof eight <= text.size()) {  // most of a graph is ASCII
      std::memcpy(&eight, text.data() + i, sizeof eight);
      if ((eight & 0x8080808080808080u) == 0) {
        i += sizeof eight;
        continue;
      }
    }
    const unsigned c = byte(i), next = byte(i + 1);
    if (c < 0x80) {
      i += 1;
    } else if (c >= 0xC2 && c <= 0xDF && continues(i + 1)) {
      i += 2;
    } else if (c >= 0xE0 && c <= 0xEF && continues(i + 1) && continues(i + 2) &&
               !(c == 0xE0 && next < 0xA0) && !(c == 0xED && next > 0x9F)) {
      i += 3;
    } else if (c >= 0xF0 && c <= 0xF4 && continues(i + 1) && continues(i + 2) && continues(i + 3) &&
               !(c == 0xF0 && next < 0x90) && !(c == 0xF4 && next > 0x8F)) {
      i += 4;
    } else {
      return i;
    }
  }
  return std::string_view::npos;
}

void find_conflict_markers(std::string_view text, Diagnostics& found) {
  bool inside = false;
  int line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view row = text.substr(start, end - start);
    const bool opens = row.starts_with("<<<<<<<");
    if (opens || row.starts_with(">>>>>>>") || row.starts_with("=======") || row.starts_with("|||||||")) {
      if (opens || !inside)
        found.push_back(
            error("conflict-markers", fmt::format("git's conflict marker {}", row.substr(0, 7)))
                .in_file("", {line, 1})
                .hinting("finish the merge: keep a side at each marker, take the markers out, then "
                         "kinegraph fmt"));
      inside = !row.starts_with(">>>>>>>");
    }
    start = end + 1;
  }
}

std::string as_utf8(std::string_view text, Diagnostics& found) {
  std::string whole(text);
  JsonCursor cursor(whole);
  for (int line = 0;;) {
    const std::size_t bad = first_bad_utf8(cursor.rest());
    if (bad == std::string_view::npos) return whole;
    const std::size_t at = cursor.offset() + bad;
    const char byte = std::exchange(whole[at], '?');
    cursor.advance_to(at);
    if (line == cursor.place().line) continue;
    line = cursor.place().line;
    found.push_back(
        error("bad-utf8", fmt::format("byte 0x{:02x} isn't UTF-8", static_cast<unsigned char>(byte)))
            .hinting("save the file as UTF-8"));
    found.back().place = cursor.place();
  }
}

}  // namespace kinegraph
