#include "graph/json.h"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "graph/json_text.h"

namespace kinegraph {

Json::Json(const Json& other)
    : place(other.place),
      key_place(other.key_place),
      kind_(other.kind_),
      boolean_(other.boolean_),
      number_(other.number_),
      text_(other.text_),
      array_(other.array_ ? std::make_unique<Array>(*other.array_) : nullptr),
      object_(other.object_ ? std::make_unique<Object>(*other.object_) : nullptr) {}

Json::Json(Json&& other) noexcept
    : place(other.place),
      key_place(other.key_place),
      kind_(std::exchange(other.kind_, Kind::null)),
      boolean_(other.boolean_),
      number_(other.number_),
      text_(std::move(other.text_)),
      array_(std::move(other.array_)),
      object_(std::move(other.object_)) {}

Json& Json::operator=(const Json& other) {
  if (this != &other) *this = Json(other);
  return *this;
}

// What is given may lie inside what is there, so that goes last.
Json& Json::operator=(Json&& other) noexcept {
  Json taken(std::move(other));
  place = taken.place;
  key_place = taken.key_place;
  kind_ = taken.kind_;
  boolean_ = taken.boolean_;
  number_ = taken.number_;
  text_.swap(taken.text_);
  array_.swap(taken.array_);
  object_.swap(taken.object_);
  return *this;
}

Json Json::number_as_read(double value, std::string spelling) {
  Json json(value);
  json.text_ = std::move(spelling);
  return json;
}

namespace {
void expect(bool holds, Json::Kind found, const char* wanted) {
  if (!holds) throw std::logic_error(std::string("asked ") + name_of(found) + " for " + wanted);
}
}  // namespace

bool Json::boolean() const {
  expect(is_boolean(), kind_, "true or false");
  return boolean_;
}
double Json::number() const {
  expect(is_number(), kind_, "a number");
  return number_;
}
const std::string& Json::string() const {
  expect(is_string(), kind_, "a string");
  return text_;
}
const Json::Array& Json::array() const {
  expect(is_array(), kind_, "a list");
  return *array_;
}
Json::Array& Json::array() {
  expect(is_array(), kind_, "a list");
  return *array_;
}
const Json::Object& Json::object() const {
  expect(is_object(), kind_, "an object");
  return *object_;
}
Json::Object& Json::object() {
  expect(is_object(), kind_, "an object");
  return *object_;
}

const Json* Json::find(std::string_view key) const {
  if (!is_object()) return nullptr;
  const auto found = object_->find(key);
  return found == object_->end() ? nullptr : &found->second;
}

bool Json::operator==(const Json& other) const {
  if (kind_ != other.kind_) return false;
  switch (kind_) {
    case Kind::null:
      return true;
    case Kind::boolean:
      return boolean_ == other.boolean_;
    case Kind::number:
      return number_ == other.number_;
    case Kind::string:
      return text_ == other.text_;
    case Kind::array:
      return *array_ == *other.array_;
    case Kind::object:
      return *object_ == *other.object_;
  }
  return false;
}

const char* name_of(Json::Kind kind) {
  switch (kind) {
    case Json::Kind::null:
      return "null";
    case Json::Kind::boolean:
      return "true or false";
    case Json::Kind::number:
      return "a number";
    case Json::Kind::string:
      return "a string";
    case Json::Kind::array:
      return "a list";
    case Json::Kind::object:
      return "an object";
  }
  return "";
}

std::string shortest_number(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a number that isn't finite has no JSON form");
  if (value == 0) return "0";
  // The fewest digits that read back the same, d.ddd…e±xx, then laid out as ECMAScript does (RFC 8785):
  // people write 100000 and 0.001, not 1e+05 and 1e-03.
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific).ptr;
  const std::string_view text(buffer, static_cast<std::size_t>(end - buffer));
  std::string out;
  std::string digits;
  std::size_t i = 0;
  if (text[i] == '-') out += text[i++];
  for (; text[i] != 'e'; ++i)
    if (text[i] != '.') digits += text[i];
  int exponent = 0;
  const std::size_t sign = i + 1;
  std::from_chars(buffer + sign + 1, end, exponent);
  if (text[sign] == '-') exponent = -exponent;

  const int count = static_cast<int>(digits.size());
  const int point = exponent + 1;  // digits before the decimal point
  if (point > 21 || point < -5) {
    out += digits[0];
    if (count > 1) out += "." + digits.substr(1);
    out += exponent < 0 ? "e-" : "e+";
    out += std::to_string(std::abs(exponent));
  } else if (point <= 0) {
    out += "0." + std::string(static_cast<std::size_t>(-point), '0') + digits;
  } else if (point >= count) {
    out += digits + std::string(static_cast<std::size_t>(point - count), '0');
  } else {
    out += digits.substr(0, static_cast<std::size_t>(point)) + "." +
           digits.substr(static_cast<std::size_t>(point));
  }
  return out;
}

namespace {
// Asks at least once in each 64 KiB of text.
class Asking {
 public:
  explicit Asking(Work* work = nullptr) : work_(work) {}
  static constexpr std::size_t piece = std::size_t{64} << 10;
  void at(std::size_t written) {
    if (!work_ || written - asked_at_ < piece) return;
    asked_at_ = written;
    work_->check();
  }

 private:
  Work* work_;
  std::size_t asked_at_ = 0;
};

void put_escaped(std::string_view text, std::string& out) {
  static constexpr char hex[] = "0123456789abcdef";
  const auto is_plain = [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\'; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t start = i;
    while (i < text.size() && is_plain(text[i])) ++i;
    out.append(text, start, i - start);
    if (i == text.size()) break;
    const char c = text[i];
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\b':
        out += "\\b";
        break;
      case '\f':
        out += "\\f";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\r':
        out += "\\r";
        break;
      case '\t':
        out += "\\t";
        break;
      default:
        out += "\\u00";
        out += hex[static_cast<unsigned char>(c) >> 4];
        out += hex[static_cast<unsigned char>(c) & 15];
    }
  }
}
void put_quoted(std::string_view text, std::string& out, Asking asking = Asking()) {
  out += '"';
  for (std::size_t from = 0; from < text.size(); from += Asking::piece) {
    put_escaped(text.substr(from, Asking::piece), out);
    asking.at(out.size());
  }
  out += '"';
}
}  // namespace

std::string in_quotes(std::string_view text) {
  std::string out;
  out.reserve(text.size() + 2);
  put_quoted(text, out);
  return out;
}

namespace {

void put_scalar(const Json& value, bool as_read, std::string& out, Asking& asking) {
  switch (value.kind()) {
    case Json::Kind::null:
      out += "null";
      break;
    case Json::Kind::boolean:
      out += value.boolean() ? "true" : "false";
      break;
    case Json::Kind::number:
      out += as_read && !value.spelling().empty() ? value.spelling() : shortest_number(value.number());
      break;
    default:
      put_quoted(value.string(), out, asking);
  }
}

void put_compact(const Json& value, bool as_read, std::string& out, Asking& asking) {
  asking.at(out.size());
  const char* separator = "";
  if (value.is_array()) {
    out += '[';
    for (const Json& element : value.array()) {
      out += separator;
      put_compact(element, as_read, out, asking);
      separator = ", ";
    }
    out += ']';
  } else if (value.is_object()) {
    out += '{';
    for (const auto& [key, member] : value.object()) {
      out += separator + in_quotes(key) + ": ";
      put_compact(member, as_read, out, asking);
      separator = ", ";
    }
    out += '}';
  } else {
    put_scalar(value, as_read, out, asking);
  }
}

void put_indented(const Json& value, std::size_t depth, std::string& out, Asking& asking) {
  const std::string margin(2 * depth, ' ');
  const char* separator = "\n";
  if (value.is_array() && !value.array().empty()) {
    out += '[';
    for (const Json& element : value.array()) {
      out += separator + margin + "  ";
      put_indented(element, depth + 1, out, asking);
      separator = ",\n";
    }
    out += '\n' + margin + ']';
  } else if (value.is_object() && !value.object().empty()) {
    out += '{';
    for (const auto& [key, member] : value.object()) {
      out += separator + margin + "  " + in_quotes(key) + ": ";
      put_indented(member, depth + 1, out, asking);
      separator = ",\n";
    }
    out += '\n' + margin + '}';
  } else {
    put_compact(value, false, out, asking);
  }
}

}  // namespace

std::string compact(const Json& value, bool as_read) {
  std::string out;
  Asking nobody;
  put_compact(value, as_read, out, nobody);
  return out;
}

std::string indented(const Json& value) {
  std::string out;
  Asking nobody;
  put_indented(value, 0, out, nobody);
  return out + '\n';
}

namespace {

// At most so many bytes but for escapes: so that a large text isn't moved as it grows, which nothing can
// stop.
std::size_t room_for(const Json& value, std::size_t depth) {
  const std::size_t margin = 2 * depth + 4;
  std::size_t room = value.is_string() ? value.string().size() + margin : 26 + margin;
  if (value.is_array())
    for (const Json& element : value.array()) room += room_for(element, depth + 1);
  if (value.is_object())
    for (const auto& [key, member] : value.object()) room += key.size() + 4 + room_for(member, depth + 1);
  return room;
}

}  // namespace

std::string indented(const Json& value, Work& work) {
  std::string out;
  out.reserve(room_for(value, 0));
  Asking asking(&work);
  put_indented(value, 0, out, asking);
  return out += '\n';
}

}  // namespace kinegraph
