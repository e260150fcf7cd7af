// The two inner loops of dynamic time warping, compiled for each instruction set and chosen when the program
// runs. Every lane does the same operations in the same order whatever the vector's width, so that results
// are the same to the bit.
#pragma once
#include <cstddef>
#include <cstdint>

namespace kinegraph {

// Frames are packed in tiles of this many, each tile dimension after dimension.
inline constexpr std::size_t warp_tile = 16;

// out[i * stride + f] = Σ_d (tiles[f][d] − rows[i][d])² for rows i of [0, row_count) and the tiles [first,
// last). `rows` holds `dims` numbers a row.
void squared_distances(const double* tiles, std::size_t first_tile, std::size_t last_tile, std::size_t dims,
                       const double* rows, std::size_t row_count, double* out, std::size_t stride);

// One row of the search over frames [begin, end), both multiples of 8. held[n * held_stride + f] is the least
// cost of being at frame f for the (n+1)-th row, n = 0 … holds − 2, and is brought up to this row; `before`
// is the least over all runs at the row before (readable from begin − steps on), `best` becomes that of this
// row. codes[f] = (advance − 1) + ((run − 1)
// << code_shift): the advance by which a run of 1 best came here, and the run that is best here.
struct WarpRow {
  std::size_t begin, end;
  std::size_t steps;  // largest advance, at least 1
  std::size_t holds;  // longest run, at least 2
  const double* cost;
  double* held;
  std::size_t held_stride;
  const double* before;
  double* best;
  std::uint32_t* wide_codes;  // used when narrow_codes is null
  std::uint8_t* narrow_codes;
  int code_shift;
};
void advance_row(const WarpRow& row);

}  // namespace kinegraph
