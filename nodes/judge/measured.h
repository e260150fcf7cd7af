// What every measure returns: a number for each joint asked for, and one for all of them. Nothing where it
// can't be had.
#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace kinegraph {

struct Measured {
  std::optional<double> all;
  std::vector<std::optional<double>> joints;  // one a joint of the motion
};

// Frames looked at: [start, end).
struct Window {
  std::size_t start = 0, end = 0;
  std::size_t size() const { return end - start; }
};

inline std::optional<double> mean_of(const std::vector<std::optional<double>>& values) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& value : values) {
    if (!value) continue;
    sum += *value;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

inline std::optional<double> largest_of(const std::vector<std::optional<double>>& values) {
  std::optional<double> largest;
  for (const auto& value : values) {
    if (value && (!largest || *value > *largest)) largest = value;
  }
  return largest;
}

}  // namespace kinegraph
