// The loops over the links of a chain of springs that need no link before another, for the widest vectors the
// CPU has. Every lane does the same arithmetic whatever the width, so results are the same on every CPU.
#pragma once
#include <cstddef>

namespace kinegraph {

// Rows have room for this many numbers beyond the last link, which the kernels write too.
inline constexpr std::size_t spring_room = 8;

// Rows of numbers, one a particle; links are known by their lower end, and are those from `first` to `end`.
struct SpringRows {
  std::size_t first = 0, end = 0;
  const double* to_parent[3] = {};  // upper end less lower, x, y, z
  const double* velocity[3] = {};   // lower end less upper: mean over the step
  const double* free[3] = {};       // what drives a particle but its links
  const double* r = nullptr;        // present lengths
  const double* lengths = nullptr;  // ℓ + ℓ⁺
  const double* next_r = nullptr;   // r⁺: as guessed
  double* reached = nullptr;        // r⁺ as it follows
  double* share = nullptr;          // 1 / (1 + 2 κ)
  double* missed = nullptr;         // (reached − next_r) share
  double* push = nullptr;           // κ missed
  double* coupling = nullptr;       // c h²/2
  double* pull = nullptr;           // c h
  double* diagonal = nullptr;
  double* right[3] = {};
};
struct SpringStep {
  double h = 0, link = 0, own = 0, least = 0, exact = 0;
};

// c = link (1 − 2 ℓ̄ / (r⁺ + r)), not below `least`, and what a link gives to its lower end alone: own + c
// h²/2 on the diagonal, free + c h Δ on the right. Returns the smallest c before it was held, at most 0.
double spring_couplings(const SpringRows& rows, const SpringStep& step);

// What follows from the velocities, |h u − Δ|, and by how much r⁺ missed it.
//   κ = link h² (ℓ + ℓ⁺) / (2 own (r⁺ + r))
// is the part of a length's error that moving one end by the link's changed pull would give back. Returns the
// largest miss beyond exact (r + r⁺), or 0.
double spring_misses(const SpringRows& rows, const SpringStep& step);

}  // namespace kinegraph
