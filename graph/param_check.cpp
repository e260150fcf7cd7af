// Whether a value fits its description, and values from the command line.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "graph/file/parse_json.h"
#include "graph/param.h"
#include "graph/shortened.h"

namespace kinegraph {

namespace {

using Kind = ParamType::Kind;

constexpr double largest_integer = 9007199254740991;  // 2^53 - 1: above it not every integer is a double

std::vector<std::string> keys_of(const std::vector<ParamType::Choice>& choices) {
  std::vector<std::string> keys;
  for (const auto& choice : choices) keys.push_back(choice.key);
  return keys;
}

std::string shown(const Json& value) {
  return shortened(compact(value, true));
}

class Checker {
 public:
  void check(const ParamType& type, const Json& value, const std::string& where) {
    switch (type.kind) {
      case Kind::number:
      case Kind::integer:
        return check_number(type, value, where);
      case Kind::boolean:
        if (!value.is_boolean()) wrong_type(type, value, where);
        return;
      case Kind::text:
      case Kind::pattern:
        if (!value.is_string()) return wrong_type(type, value, where);
        return check_text(type, value, where);
      case Kind::open_file:
      case Kind::save_file:
        if (!value.is_string()) return wrong_type(type, value, where);
        if (value.string().find('\0') != std::string::npos)  // the system would read no further
          add(error("bad-path", fmt::format("{} has a zero in it, which no path can hold", shown(value)))
                  .hinting("leave out the \\u0000"),
              value, where);
        return;
      case Kind::choice:
        return check_choice(type, value, where);
      case Kind::unit:
        if (!value.is_number()) return check_choice(type, value, where);
        if (!(value.number() > 0) || !std::isfinite(value.number()))
          add(error("out-of-range", fmt::format("{} is no length in metres", shown(value)))
                  .hinting("above 0"),
              value, where);
        return;
      case Kind::range:
        return check_range(type, value, where);
      case Kind::list:
        if (!value.is_array()) return wrong_type(type, value, where);
        for (std::size_t i = 0; i < value.array().size(); ++i)
          check(type.parts[0], value.array()[i], fmt::format("{}[{}]", where, i));
        return;
      case Kind::tuple:
        return check_tuple(type, value, where);
      case Kind::object:
        return check_object(type, value, where);
      case Kind::table:
        if (!value.is_object()) return wrong_type(type, value, where);
        for (const auto& [key, member] : value.object()) {
          if (key.empty())
            add(error("bad-name", "an empty name in a table"), member.key_place, where);
          else
            check(type.parts[0], member, where + "." + key);
        }
        return;
      case Kind::either:
        return check_either(type, value, where);
    }
  }
  Diagnostics take() { return std::move(problems_); }

 private:
  void add(Diagnostic diagnostic, Place place, const std::string& where) {
    diagnostic.place = place;
    diagnostic.param = where;
    problems_.push_back(std::move(diagnostic));
  }
  void add(Diagnostic diagnostic, const Json& value, const std::string& where) {
    add(std::move(diagnostic), value.place, where);
  }
  void wrong_type(const ParamType& type, const Json& value, const std::string& where) {
    const bool tells_itself = value.is_null() || value.is_boolean();
    add(error("wrong-type", tells_itself ? fmt::format("{} stands here", shown(value))
                                         : fmt::format("{} is {}", shown(value), name_of(value.kind())))
            .hinting("wanted is " + described(type)),
        value, where);
  }

  void check_text(const ParamType& type, const Json& value, const std::string& where) {
    if (!type.check_text) return;
    try {
      type.check_text(value.string());
    } catch (const Failure& failure) {
      add(failure.diagnostic(), value, where);
    }
  }

  void check_number(const ParamType& type, const Json& value, const std::string& where) {
    if (!value.is_number()) return wrong_type(type, value, where);
    const double x = value.number();
    if (!std::isfinite(x)) return add(error("not-finite", "not a finite number"), value, where);
    if (type.kind == Kind::integer) {
      if (x != std::floor(x))
        return add(error("not-an-integer", fmt::format("{} is not a whole number", shown(value)))
                       .hinting("wanted is " + described(type)),
                   value, where);
      if (std::fabs(x) > largest_integer)
        return add(
            error("out-of-range", fmt::format("{} is too large for an exact whole number", shown(value)))
                .hinting("at most 9007199254740991"),
            value, where);
    }
    if (x < type.min || x > type.max)
      add(error("out-of-range", fmt::format("{} is out of range", shown(value)))
              .hinting("wanted is " + described(type)),
          value, where);
  }

  void check_choice(const ParamType& type, const Json& value, const std::string& where) {
    if (!value.is_string()) return wrong_type(type, value, where);
    const auto keys = keys_of(type.choices);
    if (std::find(keys.begin(), keys.end(), value.string()) == keys.end())
      add(error("bad-choice", fmt::format("{} is none of the choices", shown(value)))
              .hinting(suggestion(value.string(), keys) +
                       (type.kind == Kind::unit ? ", or a number of metres" : "")),
          value, where);
  }

  void check_range(const ParamType& type, const Json& value, const std::string& where) {
    if (!value.is_array() || value.array().size() != 2) return wrong_type(type, value, where);
    const auto& ends = value.array();
    const auto bad = [&](const Json& at, std::string message) {
      add(error("bad-range", std::move(message))
              .hinting("[start, end] in frames from 0, end above start or null for the end"),
          at, where);
    };
    const auto is_frame = [](const Json& end) {
      return end.is_number() && end.number() >= 0 && end.number() <= largest_integer &&
             end.number() == std::floor(end.number());
    };
    const bool start_fits = is_frame(ends[0]), end_fits = ends[1].is_null() || is_frame(ends[1]);
    if (!start_fits) bad(ends[0], fmt::format("{} is no first frame", shown(ends[0])));
    if (!end_fits) bad(ends[1], fmt::format("{} is no end of a range", shown(ends[1])));
    if (start_fits && end_fits && ends[1].is_number() && ends[1].number() <= ends[0].number())
      bad(value, fmt::format("{} holds no frame", shown(value)));
  }

  void check_tuple(const ParamType& type, const Json& value, const std::string& where) {
    if (!value.is_array()) return wrong_type(type, value, where);
    if (value.array().size() != type.parts.size())
      return add(error("wrong-length", fmt::format("{} values stand here", value.array().size()))
                     .hinting("wanted is " + described(type)),
                 value, where);
    for (std::size_t i = 0; i < type.parts.size(); ++i)
      check(type.parts[i], value.array()[i], fmt::format("{}[{}]", where, i));
  }

  void check_object(const ParamType& type, const Json& value, const std::string& where) {
    if (!value.is_object()) return wrong_type(type, value, where);
    std::vector<std::string> names;
    for (const ParamType& field : type.parts) names.push_back(field.name);
    for (const auto& [key, member] : value.object()) {
      const auto field = std::find_if(type.parts.begin(), type.parts.end(),
                                      [&](const ParamType& f) { return f.name == key; });
      if (field == type.parts.end())
        add(error("unknown-key", fmt::format("there is no {}", in_quotes(key)))
                .hinting(suggestion(key, names)),
            member.key_place, where);
      else if (!(member.is_null() && field->fallback && field->fallback->is_null()))
        check(*field, member, where + "." + key);
    }
    for (const ParamType& field : type.parts)
      if (!field.fallback && !value.find(field.name))
        add(error("missing-key", fmt::format("{} is missing", in_quotes(field.name)))
                .hinting("wanted is " + described(field)),
            value, where);
  }

  // The name of the choice by which all alternatives that are objects are told apart; empty: there is none.
  static std::string telling_choice(const ParamType& type) {
    for (const ParamType& candidate : type.parts[0].parts) {
      const bool everywhere = std::all_of(type.parts.begin(), type.parts.end(), [&](const ParamType& part) {
        return part.kind == Kind::object &&
               std::any_of(part.parts.begin(), part.parts.end(), [&](const ParamType& field) {
                 return field.kind == Kind::choice && !field.fallback && field.name == candidate.name;
               });
      });
      if (everywhere) return candidate.name;
    }
    return "";
  }

  // Whether an object says which of the alternatives it is; what it could say is told once, of all of them.
  bool tells_which(const ParamType& type, const Json& value, const std::string& where) {
    const std::string name = telling_choice(type);
    if (name.empty() || !value.is_object()) return true;
    std::vector<std::string> keys;
    for (const ParamType& part : type.parts)
      for (const ParamType& field : part.parts)
        if (field.name == name)
          for (const std::string& key : keys_of(field.choices)) keys.push_back(key);
    const Json* said = value.find(name);
    if (said && said->is_string() && std::find(keys.begin(), keys.end(), said->string()) != keys.end())
      return true;
    if (said && !said->is_string())
      add(error("wrong-type", fmt::format("{} is {}", shown(*said), name_of(said->kind())))
              .hinting(fmt::format("wanted is one of {}", fmt::join(keys, ", "))),
          *said, where + "." + name);
    else if (said)
      add(error("bad-choice", fmt::format("{} is none of the choices", shown(*said)))
              .hinting(suggestion(said->string(), keys)),
          *said, where + "." + name);
    else
      add(error("missing-key", fmt::format("{} is missing", in_quotes(name)))
              .hinting(fmt::format("one of {}", fmt::join(keys, ", "))),
          value, where);
    return false;
  }

  void check_either(const ParamType& type, const Json& value, const std::string& where) {
    if (!tells_which(type, value, where)) return;
    // The complaint of the alternative that the value comes nearest to: one that takes its kind at all, and
    // among objects that a choice tells apart the one whose choice it has.
    std::optional<Diagnostics> nearest_complaint;
    bool nearest_has_choice = false;
    for (const ParamType& part : type.parts) {
      Diagnostics complaint = kinegraph::check(part, value, where);
      if (complaint.empty()) return;
      const bool right_kind = complaint.front().param != where || complaint.front().code != "wrong-type";
      if (!right_kind) continue;
      const bool has_choice = std::none_of(complaint.begin(), complaint.end(),
                                           [](const Diagnostic& d) { return d.code == "bad-choice"; });
      if (nearest_complaint && (nearest_has_choice || !has_choice)) continue;
      nearest_complaint = std::move(complaint);
      nearest_has_choice = has_choice;
    }
    if (!nearest_complaint) return wrong_type(type, value, where);
    for (Diagnostic& diagnostic : *nearest_complaint) problems_.push_back(std::move(diagnostic));
  }

  Diagnostics problems_;
};

std::string interval(const ParamType& type) {
  const bool low = std::isfinite(type.min), high = std::isfinite(type.max);
  if (low && high) return fmt::format(" from {} to {}", shortest_number(type.min), shortest_number(type.max));
  if (low) return fmt::format(" of at least {}", shortest_number(type.min));
  if (high) return fmt::format(" of at most {}", shortest_number(type.max));
  return "";
}

bool takes_bare_text(Kind kind) {
  return kind == Kind::text || kind == Kind::pattern || kind == Kind::choice || kind == Kind::unit ||
         kind == Kind::open_file || kind == Kind::save_file;
}

// "10:200", "10:", ":200".
std::optional<Json> frames_with_colon(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || text.find_first_not_of("0123456789:") != std::string_view::npos ||
      text.find(':', colon + 1) != std::string_view::npos || text.size() == 1)
    return {};
  const std::string_view start = text.substr(0, colon), end = text.substr(colon + 1);
  double frames[2] = {};
  for (const auto& [digits, frame] : {std::pair{start, &frames[0]}, std::pair{end, &frames[1]}})
    if (!digits.empty() &&
        std::from_chars(digits.data(), digits.data() + digits.size(), *frame).ec != std::errc())
      return {};  // more than a number can be: what is wanted here is said as of any other text
  return Json(Json::Array{frames[0], end.empty() ? Json() : Json(frames[1])});
}

}  // namespace

std::string described(const ParamType& type) {
  std::string text;
  switch (type.kind) {
    case Kind::number:
      text = "a number" + interval(type);
      break;
    case Kind::integer:
      text = "a whole number" + interval(type);
      break;
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "a string";
    case Kind::pattern:
      return "a pattern of names, a string";
    case Kind::open_file:
    case Kind::save_file:
      return "a path, a string";
    case Kind::choice:
    case Kind::unit:
      text = "one of " + fmt::format("{}", fmt::join(keys_of(type.choices), ", "));
      if (type.kind == Kind::unit) text += ", or a number of metres";
      break;
    case Kind::range:
      return "[start, end] in frames, end null for the end";
    case Kind::list:
      return "a list, each element " + described(type.parts[0]);
    case Kind::tuple: {
      text = fmt::format("a list of {}: ", type.parts.size());
      for (std::size_t i = 0; i < type.parts.size(); ++i) text += (i ? "; " : "") + described(type.parts[i]);
      break;
    }
    case Kind::object: {
      text = "an object with ";
      for (std::size_t i = 0; i < type.parts.size(); ++i) text += (i ? ", " : "") + type.parts[i].name;
      break;
    }
    case Kind::table:
      return "an object, name to " + described(type.parts[0]);
    case Kind::either:
      for (std::size_t i = 0; i < type.parts.size(); ++i)
        text += (i ? ", or " : "") + described(type.parts[i]);
      break;
  }
  if (!type.unit.empty() && type.kind != Kind::unit) text += " (" + type.unit + ")";
  return text;
}

Diagnostics check(const ParamType& type, const Json& value, const std::string& where) {
  Checker checker;
  checker.check(type, value, where);
  return checker.take();
}

Json parse_value(const ParamType& type, std::string_view text) {
  const auto json = [&]() -> std::optional<Json> {
    Diagnostics problems;
    Json value = parse_json(text, "", problems);
    if (!problems.empty()) return {};
    return value;
  };
  if (takes_bare_text(type.kind)) {
    const bool could_be_json = text.starts_with('"') || type.kind == Kind::unit;
    if (could_be_json)
      if (const auto value = json();
          value && (value->is_string() || (type.kind == Kind::unit && value->is_number())))
        return *value;
    return Json(text);
  }
  if (type.kind == Kind::range)
    if (auto value = frames_with_colon(text)) return *value;
  if (type.kind == Kind::either) {
    for (const ParamType& part : type.parts) {
      try {
        Json value = parse_value(part, text);
        if (check(part, value, "").empty()) return value;
      } catch (const Failure&) {
      }
    }
  }
  if (auto value = json()) return *value;
  throw Failure(error("bad-value", fmt::format("{} can't be read", shortened(in_quotes(text))))
                    .hinting("wanted is " + described(type)));
}

}  // namespace kinegraph
