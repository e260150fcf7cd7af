// JSON as Kinegraph needs it: every value knows where it stood in the file and keeps a number's own spelling,
// so that messages can point and foreign data can be saved back digit for digit.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace kinegraph {

// A position in a text, from 1. Line 0: not from a text.
struct Place {
  int line = 0;
  int column = 0;
};

class Json {
 public:
  enum class Kind { null, boolean, number, string, array, object };
  using Array = std::vector<Json>;
  using Object = std::map<std::string, Json, std::less<>>;  // sorted by bytes, as the canonical form wants it

  Json() = default;
  Json(std::nullptr_t) {}
  Json(bool value) : kind_(Kind::boolean), boolean_(value) {}
  Json(double value) : kind_(Kind::number), number_(value) {}
  Json(int value) : Json(static_cast<double>(value)) {}
  Json(std::int64_t value) : Json(static_cast<double>(value)) {}
  Json(std::size_t value) : Json(static_cast<double>(value)) {}
  Json(std::string value) : kind_(Kind::string), text_(std::move(value)) {}
  Json(std::string_view value) : Json(std::string(value)) {}
  Json(const char* value) : Json(std::string(value)) {}
  Json(Array value) : kind_(Kind::array), array_(std::make_unique<Array>(std::move(value))) {}
  Json(Object value) : kind_(Kind::object), object_(std::make_unique<Object>(std::move(value))) {}
  Json(const Json& other);
  Json(Json&& other) noexcept;  // leaves null
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json() = default;
  // A number read from a text: `spelling` is how it stood there.
  static Json number_as_read(double value, std::string spelling);

  Kind kind() const { return kind_; }
  bool is_null() const { return kind_ == Kind::null; }
  bool is_boolean() const { return kind_ == Kind::boolean; }
  bool is_number() const { return kind_ == Kind::number; }
  bool is_string() const { return kind_ == Kind::string; }
  bool is_array() const { return kind_ == Kind::array; }
  bool is_object() const { return kind_ == Kind::object; }

  // The caller has checked the kind; asking for another throws std::logic_error.
  bool boolean() const;
  double number() const;
  const std::string& spelling() const {
    return text_;
  }  // of a number as read; empty when made by the program
  const std::string& string() const;
  const Array& array() const;
  Array& array();
  const Object& object() const;
  Object& object();

  const Json* find(std::string_view key) const;  // a member of an object, or null (also when not an object)

  // Same meaning: numbers by value (-0 equals 0), members in any order, places ignored.
  bool operator==(const Json& other) const;

  Place place;      // of the value
  Place key_place;  // of its key, where it is a member of an object

 private:
  Kind kind_ = Kind::null;
  bool boolean_ = false;
  double number_ = 0;
  std::string text_;  // a string's text, or a number's spelling
  // Elsewhere, so that values are small: graphs hold many and most are a word or a number.
  std::unique_ptr<Array> array_;    // of an array, never null
  std::unique_ptr<Object> object_;  // of an object, never null
};

const char* name_of(
    Json::Kind kind);  // "null", "true or false", "a number", "a string", "a list", "an object"

// The shortest decimal that reads back the same double; -0 as "0". The value is finite.
std::string shortest_number(double value);
// A string with quotes and the escapes that JSON asks for; everything else stays UTF-8.
std::string in_quotes(std::string_view text);
// One line, no spaces but after ':' and ',': `{"a": 1, "b": [2, 3]}`. For messages, reports and lists in a
// graph file. `as_read`: numbers stand as they were spelled.
std::string compact(const Json& value, bool as_read = false);
// Two spaces, every member and element on a line of its own. For reports and JSON that others read.
std::string indented(const Json& value);

}  // namespace kinegraph
