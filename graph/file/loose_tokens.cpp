#include "graph/file/loose_tokens.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/file/json_mistake.h"
#include "graph/shortened.h"

namespace kinegraph {

namespace {

constexpr std::size_t none = std::string_view::npos;
constexpr std::size_t most_tried = std::size_t{32}
                                   << 20;      // bytes read to find the places of all missing quotes
constexpr std::size_t most_lines_joined = 40;  // of one string

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_separator(char c) {
  return is_blank(c) || std::string_view("{}[],:\"").find(c) != none;
}

// What a piece of text holds, read as it stands.
struct Row {
  std::vector<LooseToken> tokens;
  std::size_t unclosed = none;  // the byte a string begins at that doesn't end
  std::size_t comment = none;   // the byte a comment begins at that goes on past the piece
};

// `text`: one line, or several where a string may hold line breaks.
Row row_of(std::string_view text) {
  Row row;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t start = i;
    char kind = 'w';
    if (is_blank(c)) {
      ++i;
      continue;
    }
    if (c == '#' || text.substr(i, 2) == "//") break;
    if (text.substr(i, 2) == "/*") {
      const std::size_t end = text.find("*/", i + 2);
      if (end == none) {
        row.comment = i;
        break;
      }
      i = end + 2;
      continue;
    }
    if (c == '"') {
      kind = 's';
      for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
      if (i >= text.size()) row.unclosed = start;
      i = std::min(i + 1, text.size());
    } else if (const std::size_t end = c == '\'' ? text.find_first_of("'\"", i + 1) : none;
               end != none && text[end] == '\'') {
      kind = 's';
      i = end + 1;
    } else if (is_separator(c)) {
      kind = c;
      ++i;
    } else {
      while (i < text.size() && !is_separator(text[i])) ++i;
    }
    row.tokens.push_back({kind, start, i, row.tokens.empty(), 0, 0});
  }
  return row;
}

// How many tokens of a line can't stand where they do, whatever the lines around it hold.
int clashes(const Row& row, std::string_view text) {
  int count = row.unclosed != none ? 100 : 0;
  const auto& tokens = row.tokens;
  const auto kind = [&](std::size_t i) { return i < tokens.size() ? tokens[i].kind : '\0'; };
  // What each bracket opened in the line is; below them, what the line itself lies in, '?' where it isn't
  // known.
  std::string open(1, kind(0) == 's' && kind(1) == ':' ? '{' : '?');
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const LooseToken& token = tokens[i];
    const char before = i > 0 ? kind(i - 1) : '\0', last = open.back();
    const bool value_starts = token.kind == 's' || token.kind == 'w' || token.opens();
    const bool value_ended = i > 0 && (before == 's' || before == 'w' || tokens[i - 1].closes());
    const bool key_wanted = last == '{' && (before == '{' || before == ',' || i == 0);
    const std::string_view word = text.substr(token.at, token.end - token.at);
    count += value_starts && value_ended;
    count += (token.kind == ',' || token.kind == ':') && i > 0 && !value_ended;
    count += before == ':' && !value_starts;
    count += key_wanted && value_starts && !(token.kind == 's' && kind(i + 1) == ':');
    count += token.kind == ':' &&
             (last == '[' || !(before == 's' && (i < 2 || kind(i - 2) == ',' || kind(i - 2) == '{')));
    count +=
        token.kind == 'w' && !is_json_number(word) && word != "true" && word != "false" && word != "null";
    if (token.opens()) open += token.kind;
    if (token.closes()) {
      if (open.size() > 1)
        open.pop_back();
      else
        open = "?";
    }
  }
  return count;
}

// A string as JSON holds it, of what was meant to be one.
std::string quoted(std::string_view content) {
  std::string text = "\"";
  for (const char c : content)
    if (c == '\\' || c == '"')
      (text += '\\') += c;
    else
      text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return text + '"';
}

// Where a line whose last string doesn't end reads best with one more quote: before the first such word, else
// at the first such byte.
struct Requoted {
  std::size_t at = 0;  // of the quote
  int clashes = 0;
};
Requoted requoted(std::string_view line, std::size_t& may_try) {
  std::size_t end = line.size();
  while (end > 0 && is_blank(line[end - 1])) --end;
  Requoted best{end, 1000};
  const auto try_at = [&](std::size_t at) {
    const std::string whole = std::string(line.substr(0, at)) + '"' + std::string(line.substr(at));
    if (const int found = clashes(row_of(whole), whole); found < best.clashes) best = {at, found};
  };
  if (end * end > may_try) {
    while (end > 0 && (is_blank(line[end - 1]) || std::string_view(",]}").find(line[end - 1]) != none)) --end;
    try_at(end);
    return best;
  }
  may_try -= end * end;
  for (std::size_t at = 0; at < end; ++at)
    if (!is_separator(line[at]) && (at == 0 || is_separator(line[at - 1]))) try_at(at);
  for (std::size_t at = 1; at <= end; ++at)
    if (!is_blank(line[at - 1]) && (at == end || is_separator(line[at]) || is_separator(line[at - 1])))
      try_at(at);
  return best;
}

class LooseReader {
 public:
  explicit LooseReader(std::string_view text) : text_(text) {}

  LooseText read() {
    for (std::size_t at = 0; at < text_.size(); ++line_) at = read_line(at);
    return std::move(result_);
  }

 private:
  std::size_t end_of_line(std::size_t at) const { return std::min(text_.find('\n', at), text_.size()); }

  // Where the next one begins.
  std::size_t read_line(std::size_t at) {
    const std::size_t end = end_of_line(at);
    const std::string_view line = text_.substr(at, end - at);
    const Row row = row_of(line);
    if (row.comment != none) return read_comment(at, row);
    if (row.unclosed != none) return read_unclosed(at, line, row);
    keep(row, at, at);
    return end + 1;
  }

  std::size_t read_comment(std::size_t at, const Row& row) {
    keep(row, at, at);
    const std::size_t start = at + row.comment, end = text_.find("*/", start + 2);
    if (end != none) return end + 2;
    const std::size_t line_end = end_of_line(start);
    result_.mends.push_back({start, line_end - start, " "});
    result_.slips.push_back({start, error("comment", "a comment that never ends")
                                        .hinting("JSON has no comments; a node's \"note\" holds text")});
    return line_end + 1;
  }

  std::size_t read_unclosed(std::size_t at, std::string_view line, const Row& row) {
    const Requoted alone = requoted(line, may_try_);
    if (const std::size_t end = end_of_string_over_lines(at, row, alone.clashes); end != none) {
      const Row joined = row_of(text_.substr(at, end - at));
      keep(joined, at, at);
      const std::size_t start = at + row.unclosed;
      for (const LooseToken& token : joined.tokens)
        if (at + token.at == start) mend_string(start, at + token.end, 1, 1);
      result_.slips.push_back({start, error("syntax", "a string that doesn't end in its line")
                                          .hinting(R"(write \n for a line break, \t for a tab)")});
      line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at),
                                                   text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      return end + 1;
    }
    const std::string whole =
        std::string(line.substr(0, alone.at)) + '"' + std::string(line.substr(alone.at));
    Row mended = row_of(whole);
    for (LooseToken& token : mended.tokens) {
      const bool begins = token.at == alone.at, ends = token.end == alone.at + 1;
      token.at -= token.at > alone.at;
      token.end -= token.end > alone.at;
      if (!begins && !ends) continue;
      const std::size_t start = at + token.at, end = at + token.end;
      mend_string(start, end, begins ? 0 : 1, begins ? 1 : 0);
      result_.slips.push_back(
          {start, error("syntax", begins ? "a string that doesn't begin" : "a string that doesn't end")
                      .hinting(fmt::format("a \" is missing {} {}", begins ? "before" : "after",
                                           shortened(std::string(text_.substr(start, end - start)))))});
    }
    keep(mended, at, at);
    return at + line.size() + 1;
  }

  // The end of the line in which the string ends that `row` leaves open, where that reads better than two
  // mistakes; npos otherwise.
  std::size_t end_of_string_over_lines(std::size_t at, const Row& row, int clashes_alone) {
    std::size_t start = end_of_line(at) + 1;
    for (std::size_t lines = 0; start < text_.size() && lines < most_lines_joined; ++lines) {
      const std::size_t end = end_of_line(start);
      const std::string_view line = text_.substr(start, end - start);
      if (line.find('"') != none) {
        const Row other = row_of(line);
        if (other.unclosed == none) return none;
        const std::string_view both = text_.substr(at, end - at);
        const Row joined = row_of(both);
        if (joined.comment != none || joined.unclosed != none || joined.tokens.size() < row.tokens.size())
          return none;
        const int apart = clashes_alone + requoted(line, may_try_).clashes + 2;
        return clashes(joined, both) + 1 < apart ? end : none;
      }
      start = end + 1;
    }
    return none;
  }

  // What a string holds lies between `before` bytes of its token's start and `after` bytes of its end.
  void mend_string(std::size_t start, std::size_t end, std::size_t before, std::size_t after) {
    const std::size_t length = end - start;
    const std::string_view content =
        length < before + after ? "" : text_.substr(start + before, length - before - after);
    result_.mends.push_back({start, length, quoted(content)});
  }

  void keep(const Row& row, std::size_t at, std::size_t line_start) {
    std::size_t indent = 0;
    while (line_start + indent < text_.size() &&
           (text_[line_start + indent] == ' ' || text_[line_start + indent] == '\t'))
      ++indent;
    for (LooseToken token : row.tokens) {
      token.at += at;
      token.end += at;
      token.indent = indent;
      token.line = line_;
      result_.tokens.push_back(token);
    }
  }

  std::string_view text_;
  std::size_t line_ = 0, may_try_ = most_tried;
  LooseText result_;
};

}  // namespace

LooseText loose_tokens(std::string_view text) {
  return LooseReader(text).read();
}

}  // namespace kinegraph
