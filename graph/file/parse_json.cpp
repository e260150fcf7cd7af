#include "graph/file/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "graph/file/bracket_rescue.h"
#include "graph/file/conflict_sides.h"
#include "graph/file/doubt.h"
#include "graph/file/json_mistake.h"
#include "graph/file/text_bytes.h"

namespace kinegraph {

namespace {

constexpr std::size_t largest_rescued = std::size_t{4} << 20;  // bytes
constexpr int most_guesses = 64;
constexpr std::size_t asked_each = std::size_t{64} << 10;  // bytes

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
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
  explicit Parser(std::string_view text, Work* work = nullptr) : text_(text), whole_(text), work_(work) {}
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

  // Where and how the reading ended, as bytes of the text as it stands.
  struct Stop {
    Wanted wanted = Wanted::value;
    std::size_t at = 0;
    std::optional<std::size_t> scalar;  // where the last token begins, if it is a string, number or word
  };
  Stop stop() const {
    const auto offset = [&](std::size_t mended) {
      JsonCursor cursor(whole_, mends_);
      cursor.advance_to_mended(mended);
      return cursor.offset();
    };
    Stop stop{wanted_, offset(at_), {}};
    if (scalar_end_ == token_end_ && token_end_ > 0) stop.scalar = offset(scalar_start_);
    return stop;
  }

 private:
  // Explains what stands behind the last token. False, for the caller to return.
  bool fail(Wanted wanted) {
    wanted_ = wanted;
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
  void end_scalar(std::size_t start) {
    scalar_start_ = start;
    scalar_end_ = token_end_ = at_;
  }

  void ask() {
    if (!work_ || at_ - asked_at_ < asked_each) return;
    asked_at_ = at_;
    work_->check();
  }

  bool value(Json& into) {
    ask();
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
    end_scalar(at_ - word.size());
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
      end_scalar(std::exchange(at_, end));
      return true;
    }
    double number = 0;
    const auto read = std::from_chars(token.data(), token.data() + token.size(), number);
    if (read.ec == std::errc::result_out_of_range && is_beyond(token)) return fail(Wanted::value);
    into = Json::number_as_read(number, std::string(token));
    end_scalar(std::exchange(at_, end));
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
      const std::size_t end = std::min(text_.size(), i + asked_each);
      while (i < end && text_[i] != '"' && text_[i] != '\\') {
        const auto c = static_cast<unsigned char>(text_[i]);
        if (c < 0x20) break;
        line_start_ += (c & 0xC0) == 0x80;  // columns count characters
        ++i;
      }
      out.append(text_, plain, i - plain);
      if (i == end && end < text_.size()) {
        if (work_) work_->check();
        continue;
      }
      if (i < text_.size() && text_[i] == '"') break;
      if (i >= text_.size() || text_[i] != '\\' || !escape(i, out)) {
        at_ = start;
        line_start_ = line_start;
        return false;
      }
    }
    at_ = i + 1;
    end_scalar(start);
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
    append_utf8(out, code);
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
  Work* work_ = nullptr;
  std::size_t asked_at_ = 0;
  Diagnostics duplicate_keys_;
  std::optional<JsonMistake> mistake_;
  std::size_t at_ = 0;
  std::size_t token_end_ = 0;
  std::size_t scalar_start_ = 0, scalar_end_ = 0;
  Wanted wanted_ = Wanted::value;
  int line_ = 1;
  std::size_t line_start_ = 0;  // later by every byte of the line, so far, that only continues a character
  int depth_ = 0;
};

bool is_same(Place a, Place b) {
  return a.line == b.line && a.column == b.column;
}

struct Reading {
  Json json;
  Diagnostics problems;
  std::vector<Mend> mends;
  bool whole = false;  // to its end; otherwise there is no value
  bool in_doubt = false;
  std::optional<Parser::Stop> stop;
  bool stopped_by_depth = false;
};

// Reads on past what can only be meant in one way, if it may.
Reading read_with(std::vector<Mend> mends, std::string_view text, bool past,
                  std::size_t budget = largest_json, Work* work = nullptr) {
  Reading reading;
  Place last;
  for (std::size_t read = 0;;) {
    const std::string as_meant = mends.empty() ? "" : mended(text, mends);
    Parser parser = mends.empty() ? Parser(text, work) : Parser(text, mends, as_meant);
    reading.whole = parser.whole(reading.json);
    const auto& mistake = parser.mistake();
    if (mistake && !is_same(mistake->problem.place, last)) reading.problems.push_back(mistake->problem);
    read += text.size();
    if (!reading.whole && past && read <= budget && mistake->mend && put_in(mends, *mistake->mend)) {
      last = mistake->problem.place;
      continue;
    }
    const Diagnostics& again = parser.duplicate_keys();
    reading.problems.insert(reading.problems.end(), again.begin(), again.end());
    if (!reading.whole) {
      reading.stop = parser.stop();
      reading.stopped_by_depth = mistake->problem.code == "too-deep";
    }
    reading.mends = std::move(mends);
    return reading;
  }
}

Place place_of(std::string_view text, std::size_t offset) {
  JsonCursor cursor(text);
  cursor.advance_to(offset);
  return cursor.place();
}

// Where what can't be read at `at` ends: before the next comma or bracket that closes more than opened in it,
// or with its line.
std::size_t end_of_unread(std::string_view text, std::size_t at) {
  int open = 0;
  std::size_t i = at;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      const std::size_t end = text.find_first_of("\"\n", i + 1);
      if (end != text.npos && text[end] == '"') i = end;
    } else if (c == '{' || c == '[') {
      ++open;
    } else if (c == '}' || c == ']') {
      if (open-- == 0) break;
    } else if (open == 0 && (c == ',' || c == '\n')) {
      break;
    }
  }
  while (i > at && (text[i - 1] == ' ' || text[i - 1] == '\t' || text[i - 1] == '\r')) --i;
  return i;
}

// What to read instead of what nobody can tell the meaning of: a value that isn't known, or nothing. It
// begins where `at` then stands.
std::optional<Mend> leave_out(std::string_view text, const Parser::Stop& stop, std::size_t& at) {
  const std::size_t end = end_of_unread(text, stop.at);
  at = stop.at;
  switch (stop.wanted) {
    case Wanted::value:
      return Mend{at, end - at, "0", true};
    case Wanted::colon:
      return Mend{at, end - at, ": 0", true};
    case Wanted::member_end:
    case Wanted::element_end:
      if (stop.scalar) at = *stop.scalar;
      if (end == stop.at) return {};
      return stop.scalar ? Mend{at, end - at, "0", true} : Mend{at, end - at, " "};
    case Wanted::name:
      if (end == at) return {};
      return Mend{at, end - at, " "};
    case Wanted::end:
      return Mend{at, text.size() - at, " "};
  }
  return {};
}

// Reads what only guesses can read, for its problems to be told: of a line about which one was made, no
// further mistake of form is. Nothing: that doesn't get to the end either.
std::optional<Reading> read_rescued(std::string_view text) {
  Rescue rescue = rescue_brackets(text);
  std::set<int> guessed;  // lines
  Reading all;
  all.mends = std::move(rescue.mends);
  all.in_doubt = rescue.in_doubt;
  for (Slip& slip : rescue.slips) {
    slip.problem.place = place_of(text, slip.at);
    guessed.insert(slip.problem.place.line);
    all.problems.push_back(std::move(slip.problem));
  }
  for (int guesses = 0; guesses < most_guesses; ++guesses) {
    Reading next = read_with(std::move(all.mends), text, true, largest_json / most_guesses);
    std::optional<Diagnostic> stuck;
    if (!next.whole && !next.problems.empty()) {
      // Told last, before the keys that stand twice, which are told by the reading that gets to the end.
      std::erase_if(next.problems, [](const Diagnostic& problem) { return problem.code == "duplicate-key"; });
      if (!next.problems.empty()) {
        stuck = std::move(next.problems.back());
        next.problems.pop_back();
      }
    }
    for (Diagnostic& problem : next.problems) {
      const bool of_form = problem.code == "syntax" || problem.code == "trailing-comma";
      if (!of_form || !guessed.contains(problem.place.line)) all.problems.push_back(std::move(problem));
    }
    if (next.whole) {
      all.json = std::move(next.json);
      all.whole = true;
      return all;
    }
    std::size_t at = 0;
    const auto mend = leave_out(text, *next.stop, at);
    if (next.stopped_by_depth || !mend || !put_in(next.mends, *mend)) return {};
    if (next.stop->wanted == Wanted::end) all.in_doubt = true;
    const Place place = place_of(text, at);
    if (stuck && guessed.insert(place.line).second) {
      stuck->place = place;
      all.problems.push_back(std::move(*stuck));
    }
    all.mends = std::move(next.mends);
  }
  return {};
}

// The value, or null where the reading stopped: at the first problem, or, if it may go `past` them, where
// even guessing what was meant leads no further.
Json parse(std::string_view text, bool past, Diagnostics& found, bool& in_doubt, Work* work) {
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
  if (auto conflicts = conflict_sides(text)) {
    found = std::move(conflicts->problems);
    return {};
  }
  std::string cleaned;
  if (past && !is_plain(text)) {
    cleaned = as_text(text, found);
    text = cleaned;
  } else if (const std::size_t bad = past ? text.npos : first_bad_utf8(text); bad != text.npos) {
    tell(not_utf8(text[bad]), place_of(text, bad));
    return {};
  }

  Reading first = read_with({}, text, past, largest_json, work);
  const bool may_be_rescued =
      past && !first.whole && text.size() <= largest_rescued && !first.stopped_by_depth;
  if (may_be_rescued) {
    if (std::optional<Reading> rescued = read_rescued(text)) {
      first = std::move(*rescued);
    }
  }
  found.insert(found.end(), first.problems.begin(), first.problems.end());
  in_doubt = first.in_doubt;
  return first.whole ? std::move(first.json) : Json();
}

Json parse(std::string_view text, const std::string& file, bool past, Diagnostics& problems, bool& in_doubt,
           Work* work = nullptr) {
  Diagnostics found;
  Json json = parse(text, past, found, in_doubt, work);
  std::stable_sort(found.begin(), found.end(), stands_before);
  found.erase(std::unique(found.begin(), found.end(),
                          [](const Diagnostic& a, const Diagnostic& b) {
                            return is_same(a.place, b.place) && a.code == b.code;
                          }),
              found.end());
  for (Diagnostic& problem : found) {
    problem.file = file;
    problems.push_back(std::move(problem));
  }
  return json;
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file, Diagnostics& problems, Work* work) {
  bool in_doubt = false;
  return parse(text, file, false, problems, in_doubt, work);
}

ReadPast parse_json_past_mistakes(std::string_view text, const std::string& file, Diagnostics& problems) {
  ReadPast read;
  read.json = parse(text, file, true, problems, read.in_doubt);
  return read;
}

}  // namespace kinegraph
