#include "graph/file/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "graph/file/json_mistake.h"

namespace kinegraph {

namespace {

// The offset of the first byte that isn't UTF-8 (RFC 3629: no overlong forms, no surrogates), or npos.
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

// Whether a number too large or too small for a double is too large: by the place of its first digit that
// isn't 0.
bool is_beyond(std::string_view token) {
  const std::size_t e = std::min(token.find_first_of("eE"), token.size());
  const std::string_view digits = token.substr(0, e);
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  const auto point = static_cast<double>(std::min(digits.find('.'), digits.size()));
  double exponent = 0;  // no int holds what people may write there
  const bool negative = e + 1 < token.size() && token[e + 1] == '-';
  for (const char c : token.substr(std::min(e + 1, token.size())))
    if (c >= '0' && c <= '9') exponent = 10 * exponent + (c - '0');
  return point - static_cast<double>(first) + (negative ? -exponent : exponent) > 0;
}

// One walk over the text, straight into the values.
class Parser {
 public:
  Parser(std::string_view text, const std::string& file, Diagnostics& problems)
      : text_(text), file_(file), problems_(problems) {}

  bool whole(Json& result) {
    if (!value(result)) return false;
    skip_space();
    return at_ == text_.size() || fail(Wanted::end);
  }

 private:
  // Tells of what stands behind the last token. False, for the caller to return.
  bool fail(Wanted wanted) {
    problems_.push_back(json_mistake(text_, token_end_, wanted, depth_ > 0));
    problems_.back().file = file_;
    return false;
  }
  void problem(Diagnostic diagnostic, Place place) {
    problems_.push_back(std::move(diagnostic).in_file(file_, place));
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  Place place() const { return {line_, static_cast<int>(at_ - line_start_) + 1}; }
  void skip_space() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        line_start_ = at_ + 1;
      } else if (c != ' ' && c != '\t' && c != '\r') {
        return;
      }
    }
  }
  void end_token() { token_end_ = at_; }

  bool value(Json& into) {
    skip_space();
    const Place here = place();
    const Place key_place = into.key_place;
    bool good = false;
    switch (peek()) {
      case '{':
        into = Json(Json::Object{});
        good = enter(here) && object(into.object());
        break;
      case '[':
        into = Json(Json::Array{});
        good = enter(here) && array(into.array());
        break;
      case '"': {
        std::string text;
        good = string(text) || fail(Wanted::value);
        into = Json(std::move(text));
        break;
      }
      case 't':
        good = word("true");
        into = Json(true);
        break;
      case 'f':
        good = word("false");
        into = Json(false);
        break;
      case 'n':
        good = word("null");
        into = Json();
        break;
      default:
        good = number(into);
    }
    into.place = here;
    into.key_place = key_place;
    return good;
  }

  bool enter(Place here) {
    if (depth_ == deepest_json) {
      problem(error("too-deep", fmt::format("more than {} levels of lists and objects", deepest_json))
                  .hinting("no graph needs so many; is a bracket left open?"),
              here);
      return false;
    }
    ++depth_;
    ++at_;
    end_token();
    skip_space();
    return true;
  }
  bool leave() {
    --depth_;
    ++at_;
    end_token();
    return true;
  }

  bool object(Json::Object& members) {
    if (peek() == '}') return leave();
    while (true) {
      skip_space();
      const Place here = place();
      std::string name;
      if (peek() != '"' || !string(name)) return fail(Wanted::name);
      skip_space();
      if (peek() != ':') return fail(Wanted::colon);
      ++at_;
      // Canonical files hold their keys in order, so the end is the likeliest place.
      const std::size_t before = members.size();
      const auto member = members.try_emplace(members.end(), std::move(name));
      if (members.size() > before) {
        member->second.key_place = here;
        if (!value(member->second)) return false;
      } else {
        problem(error("duplicate-key", fmt::format("{} stands here a second time", in_quotes(member->first)))
                    .hinting(fmt::format("the first is in line {}; keep one", member->second.key_place.line)),
                here);
        Json ignored;
        if (!value(ignored)) return false;
      }
      skip_space();
      if (peek() == '}') return leave();
      if (peek() != ',') return fail(Wanted::member_end);
      ++at_;
    }
  }

  bool array(Json::Array& elements) {
    if (peek() == ']') return leave();
    while (true) {
      if (!value(elements.emplace_back())) return false;
      skip_space();
      if (peek() == ']') return leave();
      if (peek() != ',') return fail(Wanted::element_end);
      ++at_;
    }
  }

  bool word(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return fail(Wanted::value);
    at_ += word.size();
    end_token();
    return true;
  }

  bool number(Json& into) {
    const std::string_view token = number_token(text_, at_);
    if (!is_json_number(token)) return fail(Wanted::value);
    double number = 0;
    const auto read = std::from_chars(token.data(), token.data() + token.size(), number);
    if (read.ec == std::errc::result_out_of_range && is_beyond(token)) return fail(Wanted::value);
    into = Json::number_as_read(number, std::string(token));
    at_ += token.size();
    end_token();
    return true;
  }

  // False where it is none: then nothing is taken, and fail() finds out why.
  bool string(std::string& out) {
    const std::size_t start = at_, line_start = line_start_;
    std::size_t i = at_ + 1;
    for (std::size_t plain = i;; plain = i) {
      while (i < text_.size() && text_[i] != '"' && text_[i] != '\\') {
        const auto c = static_cast<unsigned char>(text_[i]);
        if (c < 0x20) break;
        line_start_ += (c & 0xC0) == 0x80;  // columns count characters
        ++i;
      }
      out.append(text_, plain, i - plain);
      if (i < text_.size() && text_[i] == '"') break;
      if (i >= text_.size() || text_[i] != '\\' || !escape(i, out)) {
        at_ = start;
        line_start_ = line_start;
        return false;
      }
    }
    at_ = i + 1;
    end_token();
    return true;
  }

  // The escape at `i`, which goes past it.
  bool escape(std::size_t& i, std::string& out) {
    static constexpr std::string_view names = "\"\\/bfnrt", meant = "\"\\/\b\f\n\r\t";
    const char name = i + 1 < text_.size() ? text_[i + 1] : '\0';
    if (const std::size_t known = names.find(name); known != std::string_view::npos) {
      out += meant[known];
      i += 2;
      return true;
    }
    unsigned code = 0;
    if (!unit(i, code) || (code >= 0xDC00 && code < 0xE000)) return false;
    if (code >= 0xD800 && code < 0xDC00) {
      unsigned low = 0;
      if (!unit(i, low) || low < 0xDC00 || low >= 0xE000) return false;
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    }
    const auto put = [&](unsigned byte) { out += static_cast<char>(byte); };
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xC0 | code >> 6);
      put(0x80 | (code & 63));
    } else if (code < 0x10000) {
      put(0xE0 | code >> 12);
      put(0x80 | (code >> 6 & 63));
      put(0x80 | (code & 63));
    } else {
      put(0xF0 | code >> 18);
      put(0x80 | (code >> 12 & 63));
      put(0x80 | (code >> 6 & 63));
      put(0x80 | (code & 63));
    }
    return true;
  }
  bool unit(std::size_t& i, unsigned& code) const {  // \uXXXX
    const std::string_view rest = text_.substr(i);
    if (rest.size() < 6 || rest[0] != '\\' || rest[1] != 'u') return false;
    const auto read = std::from_chars(rest.data() + 2, rest.data() + 6, code, 16);
    i += 6;
    return read.ec == std::errc() && read.ptr == rest.data() + 6;
  }

  std::string_view text_;
  const std::string& file_;
  Diagnostics& problems_;
  std::size_t at_ = 0;
  std::size_t token_end_ = 0;
  int line_ = 1;
  std::size_t line_start_ = 0;  // later by every byte of the line, so far, that only continues a character
  int depth_ = 0;
};

}  // namespace

Json parse_json(std::string_view text, const std::string& file, Diagnostics& problems) {
  const auto refuse = [&](Diagnostic diagnostic, std::size_t offset) {
    problems.push_back(std::move(diagnostic).in_file(file, place_in(text, offset)));
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
  Json result;
  if (!Parser(text, file, problems).whole(result)) return Json();
  return result;
}

}  // namespace kinegraph
