// A multi-dimensional time series: what time warping compares. No units: whoever fills it scales its
// dimensions.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace kinegraph {

struct Series {
  std::size_t frames = 0;
  std::size_t dims = 0;
  std::vector<double> values;  // dimension after dimension, each `frames` long

  Series() = default;
  Series(std::size_t frame_count, std::size_t dimensions)
      : frames(frame_count), dims(dimensions), values(frame_count * dimensions) {}
  std::span<double> dim(std::size_t d) { return {values.data() + d * frames, frames}; }
  std::span<const double> dim(std::size_t d) const { return {values.data() + d * frames, frames}; }
  double at(std::size_t d, std::size_t frame) const { return values[d * frames + frame]; }
};

}  // namespace kinegraph
