#include "graph/file/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

namespace kinegraph {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool is_number_character(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

// A cursor that knows its line and column; it only goes forward, so that one long line costs no more than
// many.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}
  std::size_t offset() const { return offset_; }
  Place place() const { return place_; }
  bool at_end() const { return offset_ >= text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[offset_]; }
  std::string_view rest() const { return text_.substr(offset_); }
  void advance() {
    const char c = text_[offset_++];
    if (c == '\n')
      place_ = {place_.line + 1, 1};
    else if (!at_end() && (static_cast<unsigned char>(text_[offset_]) & 0xC0) == 0x80)
      return;  // the next byte continues this character
    else
      ++place_.column;
  }
  void advance_to(std::size_t offset) {
    while (offset_ < offset && !at_end()) advance();
  }
  void skip_space() {
    while (!at_end() && is_space(peek())) advance();
  }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  Place place_{1, 1};
};

// The offset of the first byte that isn't UTF-8 (RFC 3629: no overlong forms, no surrogates), or npos.
std::size_t first_bad_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
  for (std::size_t i = 0; i < text.size();) {
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

// Git's markers begin a line, where JSON can hold no text of its own: a string has no raw line break in it.
void find_conflict_markers(std::string_view text, const std::string& file, Diagnostics& problems) {
  bool inside = false;
  int line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view row = text.substr(start, end - start);
    const bool opens = row.starts_with("<<<<<<<");
    if (opens || row.starts_with(">>>>>>>") || row.starts_with("=======") || row.starts_with("|||||||")) {
      if (opens || !inside)
        problems.push_back(
            error("conflict-markers", fmt::format("git's conflict marker {}", row.substr(0, 7)))
                .in_file(file, {line, 1})
                .hinting("finish the merge: keep a side at each marker, take the markers out, then kinegraph "
                         "fmt"));
      inside = !row.starts_with(">>>>>>>");
    }
    start = end + 1;
  }
}

// Receives nlohmann's events and builds a Json. The library gives no positions; since its events come in the
// text's order, each token is found by walking on from the end of the one before.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(std::string_view text, const std::string& file, Diagnostics& problems)
      : text_(text), file_(file), problems_(problems), cursor_(text) {}

  bool null() override { return scalar(Json(), 4); }
  bool boolean(bool value) override { return scalar(Json(value), value ? 4 : 5); }
  bool number_integer(number_integer_t) override { return number(); }
  bool number_unsigned(number_unsigned_t) override { return number(); }
  bool number_float(number_float_t, const string_t&) override { return number(); }
  bool string(string_t& value) override {
    to_token();
    const Place place = cursor_.place();
    skip_string();
    put(Json(std::move(value)), place);
    return true;
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json(Json::Object{})); }
  bool start_array(std::size_t) override { return open(Json(Json::Array{})); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    to_token();
    key_place_ = cursor_.place();
    skip_string();
    key_ = std::move(value);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& exception) override {
    explain(exception.what());
    return false;
  }

  Json take() { return std::move(root_); }

 private:
  void to_token() {
    while (!cursor_.at_end() && (is_space(cursor_.peek()) || cursor_.peek() == ',' || cursor_.peek() == ':'))
      cursor_.advance();
  }
  void skip_string() {
    cursor_.advance();
    while (!cursor_.at_end() && cursor_.peek() != '"') {
      if (cursor_.peek() == '\\') cursor_.advance();
      cursor_.advance();
    }
    if (!cursor_.at_end()) cursor_.advance();
  }
  std::string_view number_token() const {
    const std::string_view rest = cursor_.rest();
    std::size_t length = 0;
    while (length < rest.size() && is_number_character(rest[length])) ++length;
    return rest.substr(0, length);
  }
  bool number() {
    to_token();
    const std::string_view token = number_token();
    // The library takes the 0 of 012, or the 1 of 1-2, for a whole number; nobody meant that.
    const std::size_t digit = token.starts_with('-') ? 1 : 0;
    const bool leading_zero =
        token.size() > digit + 1 && token[digit] == '0' && token[digit + 1] >= '0' && token[digit + 1] <= '9';
    double value = 0;
    const auto end = std::from_chars(token.data(), token.data() + token.size(), value).ptr;
    if (leading_zero || end != token.data() + token.size()) {
      bad_number(token);
      return false;
    }
    return scalar(Json::number_as_read(value, std::string(token)), token.size());
  }
  void bad_number(std::string_view token) {
    problem(error("bad-number", fmt::format("{} isn't a number as JSON spells it", token))
                .hinting("such as 0.5, -3 or 1e-6"),
            cursor_.place());
  }
  bool scalar(Json value, std::size_t length) {
    to_token();
    const Place place = cursor_.place();
    cursor_.advance_to(cursor_.offset() + length);
    put(std::move(value), place);
    return true;
  }
  bool open(Json container) {
    to_token();
    const Place place = cursor_.place();
    if (static_cast<int>(open_.size()) == deepest_json) {
      problem(error("too-deep", fmt::format("more than {} levels of lists and objects", deepest_json))
                  .hinting("no graph needs so many; is a bracket left open?"),
              place);
      return false;
    }
    cursor_.advance();
    open_.push_back(put(std::move(container), place));
    return true;
  }
  bool close() {
    to_token();
    cursor_.advance();
    open_.pop_back();
    return true;
  }

  // Puts a value where it belongs and returns where it stands. That stays valid while it is open: its parent
  // grows only after it is closed.
  Json* put(Json value, Place place) {
    value.place = place;
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Json& parent = *open_.back();
    if (parent.is_array()) return &parent.array().emplace_back(std::move(value));
    value.key_place = key_place_;
    // Canonical files hold their keys in order, so the end is the likeliest place.
    const std::size_t members = parent.object().size();
    const auto member = parent.object().try_emplace(parent.object().end(), key_);
    if (parent.object().size() == members) {
      problem(error("duplicate-key", fmt::format("{} stands here a second time", in_quotes(key_)))
                  .hinting(fmt::format("the first is in line {}; keep one", member->second.key_place.line)),
              key_place_);
      return duplicates_.emplace_back(std::make_unique<Json>(std::move(value))).get();
    }
    member->second = std::move(value);
    return &member->second;
  }

  void problem(Diagnostic diagnostic, Place place) {
    problems_.push_back(std::move(diagnostic).in_file(file_, place));
  }

  // Says in a person's words what stands where the library stopped.
  void explain(std::string_view message) {
    cursor_.skip_space();
    if (cursor_.peek() == ',') {
      const Place comma = cursor_.place();
      cursor_.advance();
      cursor_.skip_space();
      if (cursor_.peek() == '}' || cursor_.peek() == ']')
        return problem(error("trailing-comma", "a comma with nothing after it").hinting("remove it"), comma);
    } else if (cursor_.peek() == ':') {
      cursor_.advance();
      cursor_.skip_space();
    }
    const Place place = cursor_.place();
    const std::string_view rest = cursor_.rest();
    if (rest.empty())
      return problem(
          error("syntax", text_.empty() ? "the file is empty" : "the file ends too early")
              .hinting(open_.empty() ? R"(the least a graph holds is {"format": "kinegraph", "schema": 1})"
                                     : "a } or ] is missing"),
          place);
    if (rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with("#"))
      return problem(error("comment", "JSON has no comments").hinting("a node's \"note\" holds text"), place);
    for (const char* word :
         {"NaN", "nan", "Infinity", "-Infinity", "+Infinity", "inf", "-inf", "Inf", "-NaN"})
      if (rest.starts_with(word))
        return problem(error("not-finite", fmt::format("{} is no number a graph can hold", word))
                           .hinting("leave the parameter out for its default"),
                       place);
    if (rest.front() == '\'')
      return problem(
          error("syntax", "a string stands in double quotes, not in single").hinting(R"(write " for each ')"),
          place);
    if (rest.front() == '"') {
      if (explain_string()) return;
    } else if (is_number_character(rest.front())) {
      const std::string token(number_token());
      if (message.find("out_of_range") != std::string_view::npos)
        return problem(error("not-finite", fmt::format("{} is too large for a number", token))
                           .hinting("the largest is about 1.8e308"),
                       place);
      if (message.find("invalid number") != std::string_view::npos || rest.front() == '+' ||
          rest.front() == '.')
        return bad_number(token);
    }
    problem(error("syntax", fmt::format("{} doesn't belong here", word_at(rest))).hinting(belongs(message)),
            place);
  }
  // As much of what stands there as is told: a word, a whole short string, or one sign.
  static std::string_view word_at(std::string_view rest) {
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
  // What the library was waiting for, as its message ends.
  static std::string belongs(std::string_view message) {
    const auto waits_for = [&](std::string_view what) {
      const std::size_t at = message.rfind("expected ");
      return at != std::string_view::npos && message.substr(at + 9).starts_with(what);
    };
    if (waits_for("end of input"))
      return "the graph ends before it: remove what follows, or a bracket closes too early";
    if (waits_for("string literal")) return "a name in double quotes belongs here";
    if (waits_for("':'")) return "a : belongs between a name and its value";
    if (waits_for("'}'")) return "a , before the next member, or a } is missing";
    if (waits_for("']'")) return "a , before the next element, or a ] is missing";
    return "a value belongs here: a string in double quotes, a number, true, false, null, a list or an "
           "object";
  }
  // A string that never ends, or holds what it must not. False: it is whole, so it only stands in the wrong
  // place.
  bool explain_string() {
    const Place start = cursor_.place();
    cursor_.advance();
    for (; !cursor_.at_end() && cursor_.peek() != '"'; cursor_.advance()) {
      if (static_cast<unsigned char>(cursor_.peek()) < 0x20) {
        problem(error("syntax", cursor_.peek() == '\n' ? "a string that doesn't end in its line"
                                                       : "a control character inside a string")
                    .hinting(R"(write \n for a line break, \t for a tab)"),
                cursor_.peek() == '\n' ? start : cursor_.place());
        return true;
      }
      if (cursor_.peek() != '\\') continue;
      const Place escape = cursor_.place();
      cursor_.advance();
      const std::string_view rest = cursor_.rest();
      const bool unicode =
          rest.starts_with("u") && rest.size() > 4 &&
          rest.substr(1, 4).find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
      const bool surrogate = unicode && (rest[1] == 'd' || rest[1] == 'D') && rest[2] >= '8';
      if (rest.empty() ||
          (std::string_view("\"\\/bfnrt").find(rest.front()) == std::string_view::npos && !unicode) ||
          (surrogate && !is_pair(rest))) {
        problem(error("syntax", fmt::format("\\{} is no escape of JSON", rest.substr(0, 1)))
                    .hinting(R"(a backslash itself is \\; paths use forward slashes)"),
                escape);
        return true;
      }
      if (surrogate) cursor_.advance_to(cursor_.offset() + 6);
      if (cursor_.at_end()) break;
    }
    if (!cursor_.at_end()) return false;
    problem(error("syntax", "a string that doesn't end").hinting("a \" is missing"), start);
    return true;
  }
  static bool is_pair(std::string_view rest) {  // uD8xx\uDCxx
    const auto is_one_of = [](char c, std::string_view set) { return set.find(c) != std::string_view::npos; };
    return rest.size() > 10 && is_one_of(rest[2], "89abAB") && rest[5] == '\\' && rest[6] == 'u' &&
           is_one_of(rest[7], "dD") && is_one_of(rest[8], "cCdDeEfF");
  }

  std::string_view text_;
  const std::string& file_;
  Diagnostics& problems_;
  Cursor cursor_;
  Json root_;
  std::vector<Json*> open_;
  std::vector<std::unique_ptr<Json>> duplicates_;  // values of keys that stood there already
  std::string key_;
  Place key_place_;
};

}  // namespace

Json parse_json(std::string_view text, const std::string& file, Diagnostics& problems) {
  const auto refuse = [&](Diagnostic diagnostic, std::size_t offset) {
    Cursor cursor(text);
    cursor.advance_to(offset);
    problems.push_back(std::move(diagnostic).in_file(file, cursor.place()));
    return Json();
  };
  if (text.size() > largest_json)
    return refuse(error("too-large", fmt::format("{} bytes; a graph file has at most 64 MiB", text.size())),
                  0);
  if (text.starts_with("\xEF\xBB\xBF"))
    return refuse(error("byte-order-mark", "the file starts with a byte-order mark")
                      .hinting("save it as UTF-8 without one"),
                  0);
  const std::size_t before = problems.size();
  find_conflict_markers(text, file, problems);
  if (problems.size() > before) return Json();
  if (const std::size_t bad = first_bad_utf8(text); bad != std::string_view::npos)
    return refuse(
        error("bad-utf8", fmt::format("byte 0x{:02x} isn't UTF-8", static_cast<unsigned char>(text[bad])))
            .hinting("save the file as UTF-8"),
        bad);
  Builder builder(text, file, problems);
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return Json();
  return builder.take();
}

}  // namespace kinegraph
