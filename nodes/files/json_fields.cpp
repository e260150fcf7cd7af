#include "nodes/files/json_fields.h"

#include <fmt/format.h>

#include <cmath>

#include "graph/diagnostic.h"

namespace kinegraph {

void bad_analysis(const Json& where, std::string what) {
  throw Failure(error("bad-analysis", std::move(what)).in_file({}, where.place));
}

const Json& member(const Json& object, std::string_view key) {
  const Json* found = object.find(key);
  if (!found) bad_analysis(object, fmt::format("there is no \"{}\"", key));
  return *found;
}

double number_member(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  if (!value.is_number())
    bad_analysis(value, fmt::format("\"{}\" must be a number, not {}", key, name_of(value.kind())));
  return value.number();
}

namespace {

std::uint64_t count_of(const Json& value) {
  if (!value.is_number() || value.number() < 0 || value.number() > 9007199254740991.0 ||
      value.number() != std::floor(value.number()))
    bad_analysis(value, "a whole number from 0 on is wanted");
  return static_cast<std::uint64_t>(value.number());
}

}  // namespace

std::uint64_t count_member(const Json& object, std::string_view key) {
  return count_of(member(object, key));
}

bool flag_member(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  if (!value.is_boolean()) bad_analysis(value, fmt::format("\"{}\" must be true or false", key));
  return value.boolean();
}

const std::string& text_member(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  if (!value.is_string()) bad_analysis(value, fmt::format("\"{}\" must be a string", key));
  return value.string();
}

const Json::Array& list_member(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  if (!value.is_array()) bad_analysis(value, fmt::format("\"{}\" must be a list", key));
  return value.array();
}

std::vector<double> numbers_of(const Json& list) {
  if (!list.is_array()) bad_analysis(list, "a list of numbers is wanted");
  std::vector<double> numbers;
  numbers.reserve(list.array().size());
  for (const Json& value : list.array()) {
    if (!value.is_number()) bad_analysis(value, "a number is wanted");
    numbers.push_back(value.number());
  }
  return numbers;
}

std::vector<double> numbers_of(const Json& list, std::size_t count) {
  auto numbers = numbers_of(list);
  if (numbers.size() != count)
    bad_analysis(list, fmt::format("{} numbers are wanted, {} are there", count, numbers.size()));
  return numbers;
}

std::vector<std::uint32_t> counts_of(const Json& list) {
  if (!list.is_array()) bad_analysis(list, "a list of whole numbers is wanted");
  std::vector<std::uint32_t> counts;
  counts.reserve(list.array().size());
  for (const Json& value : list.array()) {
    const auto count = count_of(value);
    if (count > 0xFFFFFFFFu) bad_analysis(value, "a frame number past 2^32");
    counts.push_back(static_cast<std::uint32_t>(count));
  }
  return counts;
}

Json json_list(const double* values, std::size_t count) {
  return Json::Array(values, values + count);
}
Json json_of(Vec3 v) {
  return Json::Array{v.x, v.y, v.z};
}
Json json_of(Quat q) {
  return Json::Array{q.x, q.y, q.z, q.w};
}
Vec3 vec3_of(const Json& list) {
  auto n = numbers_of(list, 3);
  return {n[0], n[1], n[2]};
}
Quat quat_of(const Json& list) {
  auto n = numbers_of(list, 4);
  return {n[0], n[1], n[2], n[3]};
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

}  // namespace kinegraph
