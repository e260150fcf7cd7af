// Parameters: their description, from which the editor's panel, the command line, validation, the reference and the
// keys all come, and their checked values.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/json.h"

namespace kinegraph {

// Half-open [start, end) in frames; without an end it goes to the end.
struct FrameRange {
  std::int64_t start = 0;
  std::optional<std::int64_t> end;
  bool operator==(const FrameRange&) const = default;
};

// The form of a parameter's value, or of a part of a structured one.
struct ParamType {
  enum class Kind {
    number,    // finite double within [min, max]
    integer,   // whole double within [min, max], at most 2^53 - 1 in size
    boolean,
    text,      // any string
    pattern,   // joint pattern, a string
    choice,    // one of `choices`, by key
    range,     // [start, end], end may be null
    unit,      // one of `choices`, or a number of metres > 0
    open_file, // path of a file that is read; "" = none
    save_file, // path of a file that is written; "" = none
    list,      // of parts[0]
    tuple,     // a list of exactly parts.size() values, the i-th of type parts[i]
    object,    // the fields in parts, each with its name
    table,     // name or pattern -> parts[0]
    either,    // the first of parts that fits
  };
  struct Choice {
    std::string key;
    std::string help;
  };

  Kind kind = Kind::number;
  double min = -std::numeric_limits<double>::infinity();  // hard: outside is an error, never clamped
  double max = std::numeric_limits<double>::infinity();
  std::vector<Choice> choices;
  std::vector<ParamType> parts;

  // Of a field of an object (and of a whole Param).
  std::string name;
  std::string help;
  std::string unit;          // shown beside the number: "s", "m", "Hz", "frames"; "" = none
  std::optional<Json> fallback;  // a field that may be left out; a Param always has its default here
  double soft_min = std::numeric_limits<double>::quiet_NaN();  // of the slider; NaN = no slider
  double soft_max = std::numeric_limits<double>::quiet_NaN();
  bool in_key = true;  // false: never changes a result (an Export's file name)
  // Of a text or pattern with a grammar of its own (a Check's rule): throws Failure that says what is wrong with it.
  void (*check_text)(std::string_view) = nullptr;

  // Builders, so that a node's description reads as a list: number(0.5).between(0, 1).in("s").slider(0, 2)
  ParamType&& between(double low, double high) && { min = low; max = high; return std::move(*this); }
  ParamType&& in(std::string text) && { unit = std::move(text); return std::move(*this); }
  ParamType&& slider(double low, double high) && { soft_min = low; soft_max = high; return std::move(*this); }
  ParamType&& outside_key() && { in_key = false; return std::move(*this); }
  ParamType&& checked_by(void (*check)(std::string_view)) && { check_text = check; return std::move(*this); }
  // Name and help of a field inside object(...).
  ParamType&& as(std::string field, std::string text) && { name = std::move(field); help = std::move(text); return std::move(*this); }
  // Makes a field of an object one that may be left out.
  ParamType&& optional(Json value = nullptr) && { fallback = std::move(value); return std::move(*this); }
};
using Param = ParamType;

// Each takes the default where a Param needs one.
ParamType number(double fallback);
ParamType integer(std::int64_t fallback);
ParamType boolean(bool fallback);
ParamType text(std::string fallback);
ParamType pattern(std::string fallback);
ParamType choice(std::vector<ParamType::Choice> choices);  // the first is the default
ParamType range();                                         // default [0, null]
ParamType unit_of(std::vector<ParamType::Choice> choices);
ParamType open_file();
ParamType save_file();
ParamType list(ParamType element);      // default []
ParamType tuple(std::vector<ParamType> elements);
ParamType object(std::vector<ParamType> fields);
ParamType table(ParamType value);       // default {}
ParamType either(std::vector<ParamType> alternatives);
ParamType required(ParamType type);     // as a field: no default

// What a value of the type looks like, in words: "a number from 0 to 1 (s)". For hints.
std::string described(const ParamType& type);
// Everything wrong with `value` as a `type`, each with its place and `where` ("edits[2].factor") as param.
// A whole-value "${name}" must have been replaced before.
Diagnostics check(const ParamType& type, const Json& value, const std::string& where);
// The value with every field that was left out filled in and numbers normalised (-0 to 0): equal meaning, equal Json.
Json completed(const ParamType& type, const Json& value);
// Whether a stored value means the same as the parameter's default, so that it needn't be saved.
bool is_default(const Param& param, const Json& value);
// A value from the command line: JSON, or bare text for strings, choices, patterns, paths and units; `10:200` or `10:` for a range.
// Throws Failure ("bad-value") when it is neither; whether it fits is for check() to say.
Json parse_value(const ParamType& type, std::string_view text);

// A node's parameters, checked and complete. Asking for a name or kind that the description lacks is a programming
// error and throws std::logic_error.
class Params {
 public:
  Params() = default;
  explicit Params(Json::Object values) : values_(std::move(values)) {}
  double number(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  bool boolean(std::string_view name) const;
  const std::string& text(std::string_view name) const;  // text, pattern, choice, path
  FrameRange range(std::string_view name) const;
  const Json& json(std::string_view name) const;
  std::vector<std::string> texts(std::string_view name) const;  // a list of text
  const Json::Object& all() const { return values_; }

 private:
  Json::Object values_;
};

}  // namespace kinegraph
