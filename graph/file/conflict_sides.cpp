#include "graph/file/conflict_sides.h"

#include <fmt/format.h>

#include <algorithm>

namespace kinegraph {

namespace {

constexpr std::size_t marker_length = 7;  // git writes longer ones for conflicts inside conflicts

// The sign that a line's marker is made of, or none.
char marker_of(std::string_view line) {
  const char sign = line.empty() ? '\0' : line.front();
  const bool known = sign == '<' || sign == '|' || sign == '=' || sign == '>';
  return known && std::min(line.find_first_not_of(sign), line.size()) >= marker_length ? sign : '\0';
}

// Calls what(line, its number from 1), line breaks left out.
template <class What>
void for_each_line(std::string_view text, const What& what) {
  int number = 1;
  for (std::size_t start = 0; start < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    what(text.substr(start, end - start), number);
    start = end + 1;
  }
}

enum class Part { first, ancestor, second };

class Splitter {
 public:
  void read(std::string_view line, int number) {
    const char marker = marker_of(line);
    if (marker == '<') {
      if (open_.empty()) {
        began_ = number;
        tell(line, number);
      }
      open_.push_back(Part::first);
    } else if (marker && open_.empty()) {
      tell(line, number);
      tear(number);
    } else if (marker == '>') {
      open_.pop_back();
      if (open_.empty()) sides_.blocks.emplace_back(began_, number);
    } else if (marker) {
      open_.back() = marker == '|' ? Part::ancestor : Part::second;
    }
    keep(marker ? "" : line);
  }

  ConflictSides sides_of(std::string_view text) {
    if (!open_.empty()) tear(began_);
    if (sides_.torn_at == 0) return std::move(sides_);
    Splitter again;  // to where it is torn
    for_each_line(text, [&](std::string_view line, int number) {
      if (number < sides_.torn_at) return again.read(line, number);
      again.open_.clear();
      again.keep(marker_of(line) ? "" : line);
    });
    again.sides_.problems = std::move(sides_.problems);
    again.sides_.torn_at = sides_.torn_at;
    return std::move(again.sides_);
  }

 private:
  void tell(std::string_view line, int number) {
    sides_.problems.push_back(
        error("conflict-markers", fmt::format("git's conflict marker {}", line.substr(0, marker_length)))
            .in_file("", {number, 1})
            .hinting("finish the merge: keep a side at each marker, take the markers out, then kinegraph "
                     "fmt"));
  }
  void tear(int number) {
    if (sides_.torn_at == 0) sides_.torn_at = number;
  }
  void keep(std::string_view line) {
    const auto add = [&](Part side, std::string& text) {
      if (std::all_of(open_.begin(), open_.end(), [&](Part part) { return part == side; })) text += line;
      text += '\n';
    };
    add(Part::first, sides_.first);
    add(Part::second, sides_.second);
  }

  std::vector<Part> open_;  // where in each open conflict, outermost first
  int began_ = 0;           // line
  ConflictSides sides_;
};

}  // namespace

std::optional<ConflictSides> conflict_sides(std::string_view text) {
  bool marked = marker_of(text.substr(0, text.find('\n')));
  for (std::size_t at = text.find('\n'); !marked && at != text.npos; at = text.find('\n', at + 1))
    marked = marker_of(text.substr(at + 1, text.find('\n', at + 1) - at - 1));
  if (!marked) return {};
  Splitter splitter;
  for_each_line(text, [&](std::string_view line, int number) { splitter.read(line, number); });
  return splitter.sides_of(text);
}

}  // namespace kinegraph
