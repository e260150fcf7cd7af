#include "graph/file/json_mistake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "graph/shortened.h"

namespace kinegraph {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.' || c == '/' ||
         (static_cast<unsigned char>(c) & 0x80);
}
template <class Is>
std::string_view leading(std::string_view text, Is is) {
  return text.substr(0,
                     static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is) - text.begin()));
}
std::string_view after_space(std::string_view text) {
  return text.substr(
      leading(text, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }).size());
}
// Whether a value or a key may end before `text`.
bool ends_before(std::string_view text) {
  return text.empty() || std::string_view(" \t\n\r,:]}").find(text.front()) != std::string_view::npos;
}

// A number as JSON spells it, from one that is spelled nearly so.
std::optional<std::string> respelled(std::string_view token) {
  std::string sign, digits(token);
  if (digits.starts_with('+') || digits.starts_with('-')) {
    if (digits.front() == '-') sign = "-";
    digits.erase(0, 1);
  }
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  if (digits.empty() || !is_digit(digits.front())) digits.insert(0, "0");
  if (digits.ends_with('.')) digits += '0';
  const std::string text = sign + digits;
  double value = 0;
  const bool whole =
      std::from_chars(text.data(), text.data() + text.size(), value).ptr == text.data() + text.size();
  const std::size_t point = text.find('.');
  if (!whole || (point != text.npos && !is_digit(text[point + 1]))) return {};
  return text;
}

class Explainer {
 public:
  Explainer(JsonCursor cursor, std::size_t stopped, Wanted wanted, bool nothing_open)
      : cursor_(cursor), stopped_(stopped), wanted_(wanted), nothing_open_(nothing_open) {}

  JsonMistake explain() {
    cursor_.skip_space();
    const JsonCursor separator = cursor_;
    const bool after_comma = cursor_.skip(','), after_colon = !after_comma && cursor_.skip(':');
    cursor_.skip_space();
    const char here = cursor_.peek();
    if (after_comma && (here == '}' || here == ']')) {
      cursor_ = separator;
      return told(error("trailing-comma", "a comma with nothing after it").hinting("remove it"),
                  instead(1, " "));
    }
    // The comma itself, where nothing stands before it.
    if (after_comma && separator.offset() == stopped_) cursor_ = separator;
    const std::string_view rest = cursor_.rest();
    if (rest.empty())
      return told(error("syntax", separator.offset() == 0 ? "the file is empty" : "the file ends too early")
                      .hinting(nothing_open_
                                   ? R"(the least a graph holds is {"format": "kinegraph", "schema": 1})"
                                   : "a } or ] is missing"));
    if (rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with("#")) return comment(rest);
    for (const std::string_view word :
         {"NaN", "nan", "Infinity", "-Infinity", "+Infinity", "inf", "-inf", "Inf", "-NaN"})
      if (rest.starts_with(word) && !wants_key())
        return told(error("not-finite", fmt::format("{} is no number a graph can hold", word))
                        .hinting("leave the parameter out for its default"),
                    unread(word.size()));
    if (rest.front() == '\'') return single_quotes(rest);
    if (rest.front() == '"') {
      if (auto mistake = broken_string()) return *mistake;
    } else if (is_number_character(rest.front())) {
      const std::string_view token = number_token(rest);
      if (!is_json_number(token)) return bad_number(rest);
      if (wanted_ == Wanted::value)
        return told(
            error("not-finite", fmt::format("{} is too large for a number", shortened(std::string(token))))
                .hinting("the largest is about 1.8e308"),
            unread(token.size()));
    }
    return misplaced(rest, separator, after_comma, after_colon);
  }

  // What was written as one number, with what sticks to it: 012, 1-2, 0x1f, 12px.
  static std::string_view number_token(std::string_view rest) {
    return leading(rest, [](char c) { return is_number_character(c) || is_word_character(c); });
  }
  JsonMistake bad_number(std::string_view rest) const {
    const std::string_view token = number_token(rest);
    const auto meant = respelled(token);
    return told(
        error("bad-number", fmt::format("{} isn't a number as JSON spells it", shortened(std::string(token))))
            .hinting(meant && *meant != token ? fmt::format("write {}", shortened(*meant))
                                              : "such as 0.5, -3 or 1e-6"),
        meant ? instead(token.size(), *meant) : unread(token.size()));
  }

 private:
  JsonMistake told(Diagnostic problem, std::optional<Mend> mend = {}) const {
    problem.place = cursor_.place();
    return {std::move(problem), std::move(mend)};
  }
  Mend instead(std::size_t length, std::string text) const {
    return {cursor_.offset(), length, std::move(text)};
  }
  Mend unread(std::size_t length) const { return {cursor_.offset(), length, "0", true}; }
  bool wants_key() const { return wanted_ == Wanted::name; }

  JsonMistake comment(std::string_view rest) {
    const bool spans = rest.starts_with("/*");
    const std::size_t end = spans ? rest.find("*/", 2) : std::min(rest.find('\n'), rest.size());
    std::optional<Mend> mend;
    if (end != rest.npos) mend = instead(end + (spans ? 2 : 0), " ");
    return told(error("comment", "JSON has no comments").hinting("a node's \"note\" holds text"), mend);
  }

  JsonMistake single_quotes(std::string_view rest) {
    const std::size_t end = rest.find_first_of("'\"\\\n", 1);
    std::optional<Mend> mend;
    if (end != rest.npos && rest[end] == '\'' && ends_before(rest.substr(end + 1)))
      mend = instead(end + 1, fmt::format("\"{}\"", rest.substr(1, end - 1)));
    return told(
        error("syntax", "a string stands in double quotes, not in single").hinting(R"(write " for each ')"),
        mend);
  }

  // A string that never ends, or holds what it must not. Nothing: it is whole, and only stands in the wrong
  // place.
  std::optional<JsonMistake> broken_string() {
    std::optional<JsonMistake> first;
    const std::size_t start = cursor_.offset();
    const JsonCursor at_start = cursor_;
    std::string meant = "\"";
    cursor_.advance();
    const auto say = [&](std::string message, const char* hint, const JsonCursor& at) {
      if (first) return;
      first = JsonMistake{error("syntax", std::move(message)).hinting(hint), {}};
      first->problem.place = at.place();
    };
    while (!cursor_.at_end() && cursor_.peek() != '"') {
      const char c = cursor_.peek();
      if (c == '\n') {
        say("a string that doesn't end in its line", R"(write \n for a line break, \t for a tab)", at_start);
        return first;
      }
      if (static_cast<unsigned char>(c) < 0x20) {
        say("a control character inside a string", R"(write \n for a line break, \t for a tab)", cursor_);
        meant += ' ';
      } else if (const std::size_t length = c == '\\' ? escape(cursor_.rest()) : 1; length > 0) {
        meant += cursor_.rest().substr(0, length);
        cursor_.advance_to(cursor_.offset() + length - 1);
      } else {
        say(fmt::format("\\{} is no escape of JSON", cursor_.rest().substr(1, 1)),
            R"(a backslash itself is \\; paths use forward slashes)", cursor_);
        meant += "\\\\";
      }
      cursor_.advance();
    }
    if (cursor_.at_end()) {
      say("a string that doesn't end", "a \" is missing", at_start);
      return first;
    }
    if (first) first->mend = Mend{start, cursor_.offset() + 1 - start, meant + '"'};
    cursor_ = at_start;
    return first;
  }

  // How long the escape is that `rest` begins with; 0: it is none.
  static std::size_t escape(std::string_view rest) {
    if (rest.size() < 2) return 0;
    if (std::string_view("\"\\/bfnrt").find(rest[1]) != std::string_view::npos) return 2;
    const auto unit = [&](std::size_t at) {  // \uXXXX, or nothing
      unsigned value = 0;
      const std::string_view digits = rest.size() >= at + 6 ? rest.substr(at + 2, 4) : "";
      const bool whole =
          digits.size() == 4 && rest[at] == '\\' && rest[at + 1] == 'u' &&
          std::from_chars(digits.data(), digits.data() + 4, value, 16).ptr == digits.data() + 4;
      return whole ? std::optional(value) : std::nullopt;
    };
    const auto first = unit(0);
    if (!first || (*first >= 0xDC00 && *first < 0xE000)) return 0;
    if (*first < 0xD800 || *first >= 0xE000) return 6;
    const auto second = unit(6);
    return second && *second >= 0xDC00 && *second < 0xE000 ? 12 : 0;
  }

  // Something whole, where the library waits for something else.
  JsonMistake misplaced(std::string_view rest, const JsonCursor& separator, bool after_comma,
                        bool after_colon) {
    const std::string_view word = leading(rest, is_word_character);
    const char here = rest.front();
    const bool in_list = wanted_ == Wanted::element_end;
    const bool spaced = separator.offset() != before_space_;
    const bool starts_value =
        here == '"' || here == '{' || here == '[' || (spaced && (!word.empty() || here == '\''));
    std::string hint = belongs();
    std::optional<Mend> mend;
    if (wanted_ == Wanted::end) {
    } else if (wants_key()) {
      if (here == ',') {
        mend = instead(1, " ");
      } else if (after_comma && is_digit(here) && ends_before(rest.substr(word.size())) &&
                 after_space(rest.substr(word.size())).substr(0, 1) != ":") {
        hint = "a decimal number has a point, no comma; " + hint;
        mend = Mend{separator.offset(), cursor_.offset() - separator.offset() + word.size(), " "};
      } else if (!word.empty() && ends_before(rest.substr(word.size()))) {
        mend = instead(word.size(), fmt::format("\"{}\"", word));
      }
    } else if (wanted_ == Wanted::colon) {
      if (here == '=')
        mend = instead(1, ":");
      else if (starts_value)
        mend = instead(0, ":");
    } else if (in_list || wanted_ == Wanted::member_end) {
      const std::string_view next = after_space(rest.substr(1)).substr(0, 1);
      if (here == ';')
        mend = instead(1, next == "}" || next == "]" ? " " : ",");
      else if (starts_value && (in_list || is_key(rest)))
        mend = instead(0, ",");
    } else if (here == ',' && !after_colon) {
      mend = instead(1, " ");
    } else if (here == ',' || (here == '}' && after_colon)) {
      mend = unread(0);
    } else if (!word.empty() && ends_before(rest.substr(word.size()))) {
      std::string lower(word);
      for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      const std::string meant = lower == "none" ? "null" : lower;
      const bool is_literal = meant == "true" || meant == "false" || meant == "null";
      if (is_literal) hint = fmt::format("write {}", meant);
      mend = instead(word.size(), is_literal ? meant : fmt::format("\"{}\"", word));
    }
    return told(error("syntax", fmt::format("{} doesn't belong here", word_at(rest))).hinting(hint), mend);
  }

  // Whether `rest` begins with a name and a colon.
  static bool is_key(std::string_view rest) {
    std::size_t end = leading(rest, is_word_character).size();
    if (rest.front() == '"' || rest.front() == '\'') {
      end = rest.find_first_of(std::string{rest.front(), '\n'}, 1);
      if (end == rest.npos) return false;
      ++end;
    }
    return after_space(rest.substr(end)).starts_with(':');
  }

  // As much of what stands there as is told: a word, a whole short string, or one sign.
  static std::string_view word_at(std::string_view rest) {
    constexpr std::size_t longest = 24;
    std::size_t length = 1;
    if (rest.front() == '"') {
      const std::size_t end = rest.find('"', 1);
      if (end != std::string_view::npos && end < longest) length = end + 1;
    } else {
      length = std::clamp<std::size_t>(leading(rest, is_word_character).size(), 1, longest);
    }
    while (length < rest.size() && (static_cast<unsigned char>(rest[length]) & 0xC0) == 0x80) ++length;
    return rest.substr(0, length);
  }

  const char* belongs() const {
    switch (wanted_) {
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
    return "a value belongs here: a string in double quotes, a number, true, false, null, a list or an "
           "object";
  }

  JsonCursor cursor_;
  const std::size_t stopped_;
  const Wanted wanted_;
  const bool nothing_open_;
  const std::size_t before_space_ = cursor_.offset();
};

}  // namespace

JsonMistake explain_json(JsonCursor cursor, std::size_t stopped, Wanted wanted, bool nothing_open) {
  return Explainer(cursor, stopped, wanted, nothing_open).explain();
}

bool is_number_character(char c) {
  return is_digit(c) || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
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

}  // namespace kinegraph
