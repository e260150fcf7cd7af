// A text line by line, and a line cell by cell, whatever ends the lines.
#pragma once
#include <string_view>
#include <vector>

namespace kinegraph {

class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text), rest_(text) {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  }
  std::string_view text() const { return text_; }
  bool at_end() const { return rest_.empty(); }
  const char* here() const { return rest_.data(); }
  // The next line without its end.
  std::string_view next() {
    const std::size_t end = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, end);
    if (end == std::string_view::npos) {
      rest_.remove_prefix(rest_.size());
    } else {
      const bool two = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
      rest_.remove_prefix(end + (two ? 2 : 1));
    }
    return line;
  }

 private:
  std::string_view text_, rest_;
};

// Cells between separators, untrimmed; one where there is no separator.
inline std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t end = line.find(separator);
    cells.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

}  // namespace kinegraph
