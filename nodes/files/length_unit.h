// Units of length that motion files are in.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"
#include "graph/param.h"

namespace kinegraph {

struct LengthUnit {
  double metres = 1;
  std::string name;  // m, cm, mm, in, cmu; "" = given as a number
};

inline constexpr double cmu_metres = 0.0254 / 0.45;  // CMU's files: 1/0.45 inch

const std::vector<LengthUnit>& known_units();  // m, cm, mm, in, cmu
// The unit of that size, with its name where it has one.
LengthUnit unit_of_metres(double metres);
// A `unit` parameter: a key of known_units, or a number of metres. `otherwise` for any other word ("auto",
// "source").
LengthUnit unit_from_param(const Json& value, const LengthUnit& otherwise);
bool names_a_unit(const Json& value);
// The one of known_units that brings `height` nearest to 1.7 m in ratio; metres where the height is 0.
LengthUnit unit_by_height(double height);
// "cmu (0.05644 m)", "0.0123 m"
std::string to_text(const LengthUnit& unit);

}  // namespace kinegraph
