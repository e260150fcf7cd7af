#include "graph/file/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "graph/file/json_mistake.h"

namespace kinegraph {

namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

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
  explicit Parser(std::string_view text) : text_(text), whole_(text) {}
  // Of a text with mends: `mended` is mended(text, mends).
  Parser(std::string_view text, std::span<const Mend> mends, std::string_view mended)
      : text_(mended), whole_(text), mends_(mends) {}

  bool whole(Json& result) {
    if (!value(result)) return false;
    skip_space();
    return at_ == text_.size() || fail(Wanted::end);
  }
  const Diagnostics& duplicate_keys() const { return duplicate_keys_; }
  const std::optional<JsonMistake>& mistake() const { return mistake_; }  // that ended the reading

 private:
  // Explains what stands behind the last token. False, for the caller to return.
  bool fail(Wanted wanted) {
    JsonCursor token_end(whole_, mends_), stopped(whole_, mends_);
    token_end.advance_to_mended(token_end_);
    stopped.advance_to_mended(at_);
    mistake_ = explain_json(token_end, stopped.offset(), wanted, depth_ == 0);
    return false;
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  Place place() {
    if (mends_.empty()) return {line_, static_cast<int>(at_ - line_start_) + 1};
    cursor_.advance_to_mended(at_);
    return cursor_.place();
  }
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
      mistake_ = {error("too-deep", fmt::format("more than {} levels of lists and objects", deepest_json))
                      .hinting("no graph needs so many; is a bracket left open?"),
                  {}};
      mistake_->problem.place = here;
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
        duplicate_keys_.push_back(
            error("duplicate-key", fmt::format("{} stands here a second time", in_quotes(member->first)))
                .hinting(fmt::format("the first is in line {}; keep one", member->second.key_place.line)));
        duplicate_keys_.back().place = here;
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
    std::size_t end = at_;
    while (end < text_.size() && is_number_character(text_[end])) ++end;
    const std::string_view token = text_.substr(at_, end - at_);
    if (!is_json_number(token) || (end < text_.size() && is_letter(text_[end]))) return fail(Wanted::value);
    if (const Mend* mend = unread()) {
      const std::string_view spelling = whole_.substr(mend->at, mend->length);
      into = Json::number_as_read(std::numeric_limits<double>::quiet_NaN(),
                                  std::string(spelling.empty() ? "nothing" : spelling));
      at_ = end;
      end_token();
      return true;
    }
    double number = 0;
    const auto read = std::from_chars(token.data(), token.data() + token.size(), number);
    if (read.ec == std::errc::result_out_of_range && is_beyond(token)) return fail(Wanted::value);
    into = Json::number_as_read(number, std::string(token));
    at_ = end;
    end_token();
    return true;
  }
  // The mend here that stands for a value that isn't known.
  const Mend* unread() {
    if (mends_.empty()) return nullptr;
    cursor_.advance_to_mended(at_);
    const Mend* mend = cursor_.mend();
    return mend && mend->unread ? mend : nullptr;
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

  std::string_view text_, whole_;  // as it is read, and as it stands
  std::span<const Mend> mends_;
  JsonCursor cursor_{whole_, mends_};
  Diagnostics duplicate_keys_;
  std::optional<JsonMistake> mistake_;
  std::size_t at_ = 0;
  std::size_t token_end_ = 0;
  int line_ = 1;
  std::size_t line_start_ = 0;  // later by every byte of the line, so far, that only continues a character
  int depth_ = 0;
};

bool is_same(Place a, Place b) {
  return a.line == b.line && a.column == b.column;
}

// False: something else is mended there already, so that the reading wouldn't get on.
bool put_in(std::vector<Mend>& mends, const Mend& mend) {
  const auto next = std::find_if(mends.begin(), mends.end(), [&](const Mend& other) {
    return other.at > mend.at || (other.at == mend.at && other.length > 0 && mend.length == 0);
  });
  if (next != mends.end() && mend.at + mend.length > next->at) return false;
  if (next != mends.begin()) {
    const Mend& before = *std::prev(next);
    if (before.at + before.length > mend.at) return false;
    if (before.at == mend.at && mend.length == 0) return false;
  }
  mends.insert(next, mend);
  return true;
}

// The text with a ? for each byte that isn't UTF-8; the first of each line is told.
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

// The value, or null where the reading stopped: at the first problem, or, if it may go `past` them, at the
// first that leaves open what was meant.
Json parse(std::string_view text, bool past, Diagnostics& found) {
  const auto tell = [&](Diagnostic diagnostic, Place place) {
    diagnostic.place = place;
    found.push_back(std::move(diagnostic));
  };
  if (text.size() > largest_json) {
    tell(error("too-large", fmt::format("{} bytes; a graph file has at most 64 MiB", text.size())), {1, 1});
    return {};
  }
  if (text.starts_with("\xEF\xBB\xBF")) {
    tell(error("byte-order-mark", "the file starts with a byte-order mark")
             .hinting("save it as UTF-8 without one"),
         {1, 1});
    if (!past) return {};
    text.remove_prefix(3);
  }
  find_conflict_markers(text, found);
  if (!found.empty() && found.back().code == "conflict-markers") return {};
  std::string valid;
  if (first_bad_utf8(text) != std::string_view::npos) {
    valid = as_utf8(text, found);
    const bool is_text = text.find('\0') == std::string_view::npos;
    if (!past || !is_text) {
      found.resize(1);
      return {};
    }
    text = valid;
  }

  std::vector<Mend> mends;
  Place last;
  for (std::size_t read = 0;;) {
    const std::string as_meant = mends.empty() ? "" : mended(text, mends);
    Parser parser = mends.empty() ? Parser(text) : Parser(text, mends, as_meant);
    Json json;
    const bool whole_is_read = parser.whole(json);
    const auto& mistake = parser.mistake();
    if (mistake && !is_same(mistake->problem.place, last)) found.push_back(mistake->problem);
    read += text.size();
    if (!whole_is_read && past && read <= largest_json && mistake->mend && put_in(mends, *mistake->mend)) {
      last = mistake->problem.place;
      continue;
    }
    found.insert(found.end(), parser.duplicate_keys().begin(), parser.duplicate_keys().end());
    return whole_is_read ? std::move(json) : Json();
  }
}

Json parse(std::string_view text, const std::string& file, bool past, Diagnostics& problems) {
  Diagnostics found;
  Json json = parse(text, past, found);
  std::stable_sort(found.begin(), found.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  for (Diagnostic& problem : found) {
    problem.file = file;
    problems.push_back(std::move(problem));
  }
  return json;
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file, Diagnostics& problems) {
  return parse(text, file, false, problems);
}

Json parse_json_past_mistakes(std::string_view text, const std::string& file, Diagnostics& problems) {
  return parse(text, file, true, problems);
}

void drop_consequences(Diagnostics& problems) {
  const std::set<std::string_view> of_values = {"syntax", "bad-number", "not-finite"},
                                   of_keys = {"unknown-key", "unknown-param", "unknown-port", "bad-name",
                                              "duplicate-key"};
  std::set<std::tuple<std::string, int, int>> unread;
  const auto at = [](const Diagnostic& problem) {
    return std::tuple(problem.file, problem.place.line, problem.place.column);
  };
  std::erase_if(problems, [&](const Diagnostic& problem) {
    const bool of_value = of_values.contains(problem.code) && problem.node.empty();
    if (of_value) return !unread.insert(at(problem)).second;
    if (problem.code == "not-finite") return !unread.empty();  // by way of a variable
    return unread.contains(at(problem)) && !of_keys.contains(problem.code);
  });
}

}  // namespace kinegraph
