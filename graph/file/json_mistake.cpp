#include "graph/file/json_mistake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace kinegraph {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_number_character(char c) {
  return is_digit(c) || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

Diagnostic bad_number(std::string_view token) {
  return error("bad-number", fmt::format("{} isn't a number as JSON spells it", token))
      .hinting("such as 0.5, -3 or 1e-6");
}

// As much of what stands there as is told: a word, a whole short string, or one sign.
std::string_view word_at(std::string_view rest) {
  constexpr std::size_t longest = 24;
  std::size_t length = 1;
  if (rest.front() == '"') {
    const std::size_t end = rest.find('"', 1);
    if (end != std::string_view::npos && end < longest) length = end + 1;
  } else {
    const auto is_word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
    };
    for (std::size_t i = 0; i < std::min(rest.size(), longest) && is_word(rest[i]); ++i) length = i + 1;
  }
  while (length < rest.size() && (static_cast<unsigned char>(rest[length]) & 0xC0) == 0x80) ++length;
  return rest.substr(0, length);
}

const char* belongs(Wanted wanted) {
  switch (wanted) {
    case Wanted::end:
      return "the graph ends before it: remove what follows, or a bracket closes too early";
    case Wanted::name:
      return "a name in double quotes belongs here";
    case Wanted::colon:
      return "a : belongs between a name and its value";
    case Wanted::member_end:
      return "a , before the next member, or a } is missing";
    case Wanted::element_end:
      return "a , before the next element, or a ] is missing";
    case Wanted::value:
      break;
  }
  return "a value belongs here: a string in double quotes, a number, true, false, null, a list or an object";
}

bool is_pair(std::string_view rest) {  // uD8xx\uDCxx
  const auto is_one_of = [](char c, std::string_view set) { return set.find(c) != std::string_view::npos; };
  return rest.size() > 10 && is_one_of(rest[2], "89abAB") && rest[5] == '\\' && rest[6] == 'u' &&
         is_one_of(rest[7], "dD") && is_one_of(rest[8], "cCdDeEfF");
}

class Explanation {
 public:
  Explanation(std::string_view text, std::size_t offset) : text_(text), offset_(offset) {}

  Diagnostic of(Wanted wanted, bool inside) {
    skip_space();
    if (peek() == ',') {
      const std::size_t comma = offset_++;
      skip_space();
      if (peek() == '}' || peek() == ']')
        return at(comma, error("trailing-comma", "a comma with nothing after it").hinting("remove it"));
    } else if (peek() == ':') {
      ++offset_;
      skip_space();
    }
    const std::string_view rest = text_.substr(offset_);
    if (rest.empty())
      return at(offset_, error("syntax", text_.empty() ? "the file is empty" : "the file ends too early")
                             .hinting(inside ? "a } or ] is missing"
                                             : R"(the least a graph holds is {"format": "kinegraph", )"
                                               R"("schema": 1})"));
    if (rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with("#"))
      return at(offset_, error("comment", "JSON has no comments").hinting("a node's \"note\" holds text"));
    for (const char* word :
         {"NaN", "nan", "Infinity", "-Infinity", "+Infinity", "inf", "-inf", "Inf", "-NaN"})
      if (rest.starts_with(word))
        return at(offset_, error("not-finite", fmt::format("{} is no number a graph can hold", word))
                               .hinting("leave the parameter out for its default"));
    if (rest.front() == '\'')
      return at(offset_, error("syntax", "a string stands in double quotes, not in single")
                             .hinting(R"(write " for each ')"));
    if (rest.front() == '"') {
      if (auto wrong = in_string()) return std::move(*wrong);
    } else if (is_number_character(rest.front()) && rest.front() != 'e' && rest.front() != 'E') {
      const std::string_view token = number_token(text_, offset_);
      if (!is_json_number(token)) return at(offset_, bad_number(token));
      if (wanted == Wanted::value)
        return at(offset_, error("not-finite", fmt::format("{} is too large for a number", token))
                               .hinting("the largest is about 1.8e308"));
    }
    return at(offset_,
              error("syntax", fmt::format("{} doesn't belong here", word_at(rest))).hinting(belongs(wanted)));
  }

 private:
  char peek() const { return offset_ < text_.size() ? text_[offset_] : '\0'; }
  void skip_space() {
    while (is_space(peek())) ++offset_;
  }
  Diagnostic at(std::size_t offset, Diagnostic diagnostic) const {
    diagnostic.place = place_in(text_, offset);
    return diagnostic;
  }

  // A string that never ends, or holds what it must not. Nothing: it is whole, so it only stands in the wrong
  // place.
  std::optional<Diagnostic> in_string() const {
    std::size_t i = offset_ + 1;
    for (; i < text_.size() && text_[i] != '"'; ++i) {
      if (static_cast<unsigned char>(text_[i]) < 0x20)
        return at(text_[i] == '\n' ? offset_ : i,
                  error("syntax", text_[i] == '\n' ? "a string that doesn't end in its line"
                                                   : "a control character inside a string")
                      .hinting(R"(write \n for a line break, \t for a tab)"));
      if (text_[i] != '\\') continue;
      const std::size_t escape = i++;
      const std::string_view rest = text_.substr(i);
      const bool unicode =
          rest.starts_with("u") && rest.size() > 4 &&
          rest.substr(1, 4).find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
      const bool surrogate = unicode && (rest[1] == 'd' || rest[1] == 'D') && rest[2] >= '8';
      if (rest.empty() ||
          (std::string_view("\"\\/bfnrt").find(rest.front()) == std::string_view::npos && !unicode) ||
          (surrogate && !is_pair(rest)))
        return at(escape, error("syntax", fmt::format("\\{} is no escape of JSON", rest.substr(0, 1)))
                              .hinting(R"(a backslash itself is \\; paths use forward slashes)"));
      if (surrogate) i += 6;
    }
    if (i < text_.size()) return {};
    return at(offset_, error("syntax", "a string that doesn't end").hinting("a \" is missing"));
  }

  std::string_view text_;
  std::size_t offset_;
};

}  // namespace

Diagnostic json_mistake(std::string_view text, std::size_t offset, Wanted wanted, bool inside) {
  return Explanation(text, offset).of(wanted, inside);
}

std::string_view number_token(std::string_view text, std::size_t offset) {
  std::size_t end = offset;
  while (end < text.size() && is_number_character(text[end])) ++end;
  return text.substr(offset, end - offset);
}

bool is_json_number(std::string_view token) {
  std::size_t i = token.starts_with('-') ? 1 : 0;
  const auto digits = [&] {
    const std::size_t first = i;
    while (i < token.size() && is_digit(token[i])) ++i;
    return i - first;
  };
  const bool zero = i < token.size() && token[i] == '0';
  const std::size_t whole = digits();
  if (whole == 0 || (zero && whole > 1)) return false;
  if (i < token.size() && token[i] == '.') {
    ++i;
    if (digits() == 0) return false;
  }
  if (i < token.size() && (token[i] == 'e' || token[i] == 'E')) {
    ++i;
    if (i < token.size() && (token[i] == '+' || token[i] == '-')) ++i;
    if (digits() == 0) return false;
  }
  return i == token.size();
}

Place place_in(std::string_view text, std::size_t offset) {
  Place place{1, 1};
  for (const char c : text.substr(0, offset)) {
    if (c == '\n')
      place = {place.line + 1, 1};
    else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80)
      ++place.column;
  }
  return place;
}

}  // namespace kinegraph
