#include "graph/file/text_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

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

namespace {

constexpr std::string_view replaced = "\xEF\xBF\xBD";  // U+FFFD
constexpr int most_told = 50;

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
}

// '<': UTF-16 of Windows, '>': of the other byte order, '\0': neither. A graph begins with a { or a blank.
char order_of_utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE")) return '<';
  if (text.starts_with("\xFE\xFF")) return '>';
  if (text.size() < 4) return '\0';
  if (text[0] != 0 && text[1] == 0 && text[2] != 0 && text[3] == 0) return '<';
  if (text[0] == 0 && text[1] != 0 && text[2] == 0 && text[3] != 0) return '>';
  return '\0';
}

std::string from_utf16(std::string_view text, char order) {
  std::string whole;
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(text[i]), b = static_cast<unsigned char>(text[i + 1]);
    return order == '<' ? a | b << 8 : a << 8 | b;
  };
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    auto code = static_cast<unsigned>(unit(i));
    if (i == 0 && code == 0xFEFF) continue;
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    const unsigned low = surrogate && i + 3 < text.size() ? static_cast<unsigned>(unit(i + 2)) : 0;
    if (surrogate && code < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      i += 2;
    }
    append_utf8(whole, surrogate && code < 0x10000 ? 0xFFFD : code);
  }
  return whole;
}

// The length of a blank that other programs write and JSON doesn't know, which nobody sees; 0: none.
std::size_t foreign_blank(std::string_view text) {
  for (const std::string_view blank : {"\xC2\xA0", "\xC2\x85", "\xEF\xBB\xBF", "\xE3\x80\x80", "\xE2\x80\xA8",
                                       "\xE2\x80\xA9", "\xE2\x80\xAF", "\xE2\x81\x9F", "\xE2\x81\xA0"})
    if (text.starts_with(blank)) return blank.size();
  const bool in_block = text.size() > 2 && text.starts_with("\xE2\x80") &&
                        static_cast<unsigned char>(text[2]) >= 0x80 &&
                        static_cast<unsigned char>(text[2]) <= 0x8F;
  return in_block ? 3 : 0;  // U+2000 to U+200F
}

// The length of a quote that a word processor made of ", 0: none.
std::size_t foreign_quote(std::string_view text) {
  for (const std::string_view quote :
       {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E", "\xC2\xAB", "\xC2\xBB"})
    if (text.starts_with(quote)) return quote.size();
  return 0;
}

class Cleaner {
 public:
  Cleaner(std::string_view text, Diagnostics& found) : text_(text), found_(found) {}

  std::string clean() {
    next_bad_ = first_bad_utf8(text_);
    while (at_ < text_.size()) step();
    if (untold_ > 0)
      found_.back().hint += fmt::format("; {} more lines hold such bytes or characters", untold_);
    return std::move(whole_);
  }

 private:
  void step() {
    const char c = text_[at_];
    if (at_ == next_bad_) {
      tell(told_bad_utf8_, not_utf8(c));
      replace(1);
      const std::size_t further = first_bad_utf8(text_.substr(at_));
      next_bad_ = further == text_.npos ? further : at_ + further;
      return;
    }
    if (is_control(c)) {
      tell(told_character_,
           error("bad-character", fmt::format("the control character U+{:04X}", static_cast<int>(c)))
               .hinting("remove it"));
      return replace(1);
    }
    if (const std::size_t length = in_string_ ? 0 : foreign_blank(text_.substr(at_)); length > 0) {
      tell(told_character_,
           error("bad-character", "a blank that JSON doesn't know, copied from elsewhere perhaps")
               .hinting("write a space instead"));
      return replace(length);
    }
    // One that opened a string closes it.
    const bool may_be_quote = !in_string_ || in_foreign_;
    if (const std::size_t length = may_be_quote ? foreign_quote(text_.substr(at_)) : 0; length > 0) {
      tell(
          told_character_,
          error("bad-character", fmt::format("the quote {}", text_.substr(at_, length))).hinting("write \""));
      in_string_ = in_foreign_ = !in_string_;
      whole_ += '"';
      at_ += length;
      ++column_;
      return;
    }
    if (c == '\n') {
      ++line_;
      column_ = 0;
      in_string_ = in_foreign_ = told_bad_utf8_ = told_character_ = false;
    } else if (c == '"') {
      in_string_ = !in_string_;
      in_foreign_ = false;
    } else if (c == '\\' && in_string_ && at_ + 1 < text_.size() &&
               (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\')) {
      whole_ += c;
      ++column_;
      ++at_;
    }
    column_ += (static_cast<unsigned char>(text_[at_]) & 0xC0) != 0x80 && c != '\n';
    whole_ += text_[at_++];
  }

  void replace(std::size_t length) {
    whole_ += in_string_ ? replaced : " ";
    at_ += length;
    ++column_;
  }
  void tell(bool& told, Diagnostic problem) {
    if (std::exchange(told, true)) return;
    if (told_ == most_told) {
      ++untold_;
      return;
    }
    ++told_;
    problem.place = {line_, column_ + 1};
    found_.push_back(std::move(problem));
  }

  std::string_view text_;
  Diagnostics& found_;
  std::string whole_;
  std::size_t at_ = 0, next_bad_ = 0;
  int line_ = 1, column_ = 0, told_ = 0, untold_ = 0;
  bool in_string_ = false, in_foreign_ = false, told_bad_utf8_ = false, told_character_ = false;
};

}  // namespace

Diagnostic not_utf8(char byte) {
  return error("bad-utf8", fmt::format("byte 0x{:02x} isn't UTF-8", static_cast<unsigned char>(byte)))
      .hinting("save the file as UTF-8");
}

bool is_plain(std::string_view text) {
  if (std::any_of(text.begin(), text.end(), is_control) || first_bad_utf8(text) != text.npos) return false;
  for (const char lead : {'\xC2', '\xE2', '\xE3', '\xEF'})
    for (std::size_t at = text.find(lead); at != text.npos; at = text.find(lead, at + 1))
      if (foreign_blank(text.substr(at)) > 0 || foreign_quote(text.substr(at)) > 0) return false;
  return true;
}

bool is_text(std::string_view text) {
  if (order_of_utf16(text) != '\0') return true;
  const std::size_t end = text.find_last_not_of('\0');  // what a crash can leave behind
  if (end == text.npos) return text.empty();
  text = text.substr(0, std::min<std::size_t>(end + 1, 4096));
  return 10 * std::count_if(text.begin(), text.end(), is_control) <= static_cast<std::ptrdiff_t>(text.size());
}

std::string as_text(std::string_view text, Diagnostics& found) {
  if (const char order = order_of_utf16(text); order != '\0') {
    found.push_back(error("bad-utf8", "the file is UTF-16").hinting("save it as UTF-8"));
    found.back().place = {1, 1};
    return from_utf16(text, order);
  }
  return Cleaner(text, found).clean();
}

void append_utf8(std::string& text, unsigned code) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 63));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 63));
    put(0x80 | (code >> 6 & 63));
  }
  put(0x80 | (code & 63));
}

bool has_replaced(std::string_view text) {
  return text.find(replaced) != text.npos;
}

}  // namespace kinegraph
