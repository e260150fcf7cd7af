// A symmetric positive definite system whose entries lie within a few places of the diagonal: solved in time
// linear in its size, in a fixed order of operations.
#pragma once
#include <cstddef>
#include <vector>

namespace kinegraph {

class BandedSystem {
 public:
  BandedSystem(std::size_t size, std::size_t half_width);
  // Adds to entry (row, column), |row - column| <= half_width; the mirrored entry is understood.
  void add(std::size_t row, std::size_t column, double value) {
    if (column <= row) band_[row * (width_ + 1) + (row - column)] += value;
  }
  void factor();                                      // L D Lᵀ in place
  void solve(std::vector<double>& right_side) const;  // after factor()
  std::size_t size() const { return size_; }

 private:
  std::size_t size_, width_;
  std::vector<double> band_;  // row by row: the diagonal, then leftwards
};

}  // namespace kinegraph
