#include "nodes/files/length_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinegraph {

const std::vector<LengthUnit>& known_units() {
  static const std::vector<LengthUnit> units = {
      {1, "m"}, {0.01, "cm"}, {0.001, "mm"}, {0.0254, "in"}, {cmu_metres, "cmu"}};
  return units;
}

LengthUnit unit_of_metres(double metres) {
  for (const auto& unit : known_units())
    if (std::fabs(unit.metres / metres - 1) < 1e-12) return unit;
  return {metres, ""};
}

bool names_a_unit(const Json& value) {
  if (value.is_number()) return true;
  const auto& units = known_units();
  return value.is_string() && std::any_of(units.begin(), units.end(),
                                          [&](const auto& unit) { return unit.name == value.string(); });
}

LengthUnit unit_from_param(const Json& value, const LengthUnit& otherwise) {
  if (value.is_number()) return unit_of_metres(value.number());
  if (value.is_string())
    for (const auto& unit : known_units())
      if (unit.name == value.string()) return unit;
  return otherwise;
}

LengthUnit unit_by_height(double height) {
  constexpr double person = 1.7;  // m
  if (!(height > 0)) return known_units().front();
  auto ratio = [&](const LengthUnit& unit) {
    double r = height * unit.metres / person;
    return std::max(r, 1 / r);
  };
  return *std::min_element(known_units().begin(), known_units().end(),
                           [&](const auto& a, const auto& b) { return ratio(a) < ratio(b); });
}

std::string to_text(const LengthUnit& unit) {
  return unit.name.empty() || unit.name == "m" ? fmt::format("{:.6g} m", unit.metres)
                                               : fmt::format("{} ({:.6g} m)", unit.name, unit.metres);
}

}  // namespace kinegraph
