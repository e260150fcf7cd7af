// Reading the members of a JSON object that must be there, with errors that say where. All throw Failure
// ("bad-analysis").
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

[[noreturn]] void bad_analysis(const Json& where, std::string what);
const Json& member(const Json& object, std::string_view key);
double number_member(const Json& object, std::string_view key);
std::uint64_t count_member(const Json& object, std::string_view key);  // a whole number from 0 to 2^53 - 1
bool flag_member(const Json& object, std::string_view key);
const std::string& text_member(const Json& object, std::string_view key);
const Json::Array& list_member(const Json& object, std::string_view key);
std::vector<double> numbers_of(const Json& list);
std::vector<double> numbers_of(const Json& list, std::size_t count);  // exactly that many
std::vector<std::uint32_t> counts_of(const Json& list);

Json json_list(const double* values, std::size_t count);
Json json_of(Vec3 v);
Json json_of(Quat q);
Vec3 vec3_of(const Json& list);
Quat quat_of(const Json& list);

// A cell of a table: quoted where it has to be.
std::string csv_cell(std::string_view text);

}  // namespace kinegraph
