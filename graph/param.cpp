#include "graph/param.h"

#include <cmath>
#include <stdexcept>

namespace kinegraph {

namespace {

ParamType made(ParamType::Kind kind, Json fallback) {
  ParamType type;
  type.kind = kind;
  type.fallback = std::move(fallback);
  return type;
}

ParamType made(ParamType::Kind kind, Json fallback, std::vector<ParamType> parts) {
  ParamType type = made(kind, std::move(fallback));
  type.parts = std::move(parts);
  return type;
}

}  // namespace

ParamType number(double fallback) {
  return made(ParamType::Kind::number, fallback);
}
ParamType integer(std::int64_t fallback) {
  return made(ParamType::Kind::integer, fallback);
}
ParamType boolean(bool fallback) {
  return made(ParamType::Kind::boolean, fallback);
}
ParamType text(std::string fallback) {
  return made(ParamType::Kind::text, std::move(fallback));
}
ParamType pattern(std::string fallback) {
  return made(ParamType::Kind::pattern, std::move(fallback));
}
ParamType choice(std::vector<ParamType::Choice> choices) {
  ParamType type = made(ParamType::Kind::choice, choices.empty() ? std::string() : choices.front().key);
  type.choices = std::move(choices);
  return type;
}
ParamType range() {
  return made(ParamType::Kind::range, Json::Array{0, nullptr});
}
ParamType unit_of(std::vector<ParamType::Choice> choices) {
  ParamType type = choice(std::move(choices));
  type.kind = ParamType::Kind::unit;
  return type;
}
ParamType open_file() {
  return made(ParamType::Kind::open_file, "");
}
ParamType save_file() {
  return made(ParamType::Kind::save_file, "");
}
ParamType list(ParamType element) {
  return made(ParamType::Kind::list, Json::Array{}, {std::move(element)});
}
ParamType tuple(std::vector<ParamType> elements) {
  Json::Array defaults;
  for (const ParamType& element : elements) defaults.push_back(element.fallback.value_or(Json()));
  return made(ParamType::Kind::tuple, std::move(defaults), std::move(elements));
}
ParamType object(std::vector<ParamType> fields) {
  return made(ParamType::Kind::object, Json::Object{}, std::move(fields));
}
ParamType table(ParamType value) {
  return made(ParamType::Kind::table, Json::Object{}, {std::move(value)});
}
ParamType either(std::vector<ParamType> alternatives) {
  Json fallback = alternatives.empty() ? Json() : alternatives.front().fallback.value_or(Json());
  return made(ParamType::Kind::either, std::move(fallback), std::move(alternatives));
}
ParamType required(ParamType type) {
  type.fallback.reset();
  return type;
}

Json completed(const ParamType& type, const Json& value) {
  Json result = value;
  switch (type.kind) {
    case ParamType::Kind::list:
      for (Json& element : result.array()) element = completed(type.parts[0], element);
      break;
    case ParamType::Kind::tuple:
      for (std::size_t i = 0; i < type.parts.size(); ++i)
        result.array()[i] = completed(type.parts[i], result.array()[i]);
      break;
    case ParamType::Kind::object:
      for (const ParamType& field : type.parts) {
        const auto found = result.object().find(field.name);
        if (found == result.object().end()) {
          if (field.fallback)
            result.object()[field.name] =
                field.fallback->is_null() ? Json() : completed(field, *field.fallback);
        } else if (!(field.fallback && field.fallback->is_null() && found->second.is_null())) {
          found->second = completed(field, found->second);
        }
      }
      break;
    case ParamType::Kind::table:
      for (auto& [key, member] : result.object()) member = completed(type.parts[0], member);
      break;
    case ParamType::Kind::either:
      for (const ParamType& part : type.parts)
        if (check(part, value, "").empty()) return completed(part, value);
      break;
    case ParamType::Kind::range:
      for (Json& end : result.array())
        if (end.is_number()) end = Json(end.number() + 0.0);  // -0 becomes 0
      break;
    default:
      if (result.is_number()) result = Json(result.number() + 0.0);
  }
  return result;
}

bool is_default(const Param& param, const Json& value) {
  if (!param.fallback) return false;
  if (value == *param.fallback) return true;
  // Only fields that were left out are filled in: the kind stays, and the length of a list.
  if (value.kind() != param.fallback->kind()) return false;
  if (value.is_array() && value.array().size() != param.fallback->array().size()) return false;
  const bool structured = value.is_array() || value.is_object();
  return structured && check(param, value, "").empty() &&
         completed(param, value) == completed(param, *param.fallback);
}

namespace {

[[noreturn]] void wrong(std::string_view name, const char* kind) {
  throw std::logic_error("parameter \"" + std::string(name) + "\" is not described as " + kind);
}

}  // namespace

const Json& Params::json(std::string_view name) const {
  const auto found = values_.find(name);
  if (found == values_.end())
    throw std::logic_error("no parameter \"" + std::string(name) + "\" is described");
  return found->second;
}
double Params::number(std::string_view name) const {
  const Json& value = json(name);
  if (!value.is_number()) wrong(name, "a number");
  return value.number();
}
std::int64_t Params::integer(std::string_view name) const {
  const double value = number(name);
  if (value != std::floor(value)) wrong(name, "an integer");
  return static_cast<std::int64_t>(value);
}
bool Params::boolean(std::string_view name) const {
  const Json& value = json(name);
  if (!value.is_boolean()) wrong(name, "true or false");
  return value.boolean();
}
const std::string& Params::text(std::string_view name) const {
  const Json& value = json(name);
  if (!value.is_string()) wrong(name, "text");
  return value.string();
}
FrameRange Params::range(std::string_view name) const {
  const Json& value = json(name);
  if (!value.is_array() || value.array().size() != 2 || !value.array()[0].is_number()) wrong(name, "a range");
  FrameRange range;
  range.start = static_cast<std::int64_t>(value.array()[0].number());
  if (value.array()[1].is_number()) range.end = static_cast<std::int64_t>(value.array()[1].number());
  return range;
}
std::vector<std::string> Params::texts(std::string_view name) const {
  const Json& value = json(name);
  if (!value.is_array()) wrong(name, "a list of text");
  std::vector<std::string> all;
  for (const Json& element : value.array()) {
    if (!element.is_string()) wrong(name, "a list of text");
    all.push_back(element.string());
  }
  return all;
}

}  // namespace kinegraph
