#include "nodes/components/held_frames.h"

#include <cmath>

namespace kinegraph {
namespace {

constexpr double same = 1e-9;

bool repeats(const Rows& signals, std::size_t t) {
  for (std::size_t i = 0; i < signals.rows; ++i)
    if (!(std::fabs(signals(i, t) - signals(i, t - 1)) <= same)) return false;
  return true;
}

}  // namespace

double own_share_of_frames(const Rows& signals, std::size_t longest) {
  std::size_t shown = 0, counted = 0;
  for (std::size_t start = 0; start < signals.columns;) {
    std::size_t end = start + 1;
    while (end < signals.columns && repeats(signals, end)) ++end;
    if (end - start <= longest) {
      ++shown;
      counted += end - start;
    }
    start = end;
  }
  return counted == 0 ? 1 : static_cast<double>(shown) / static_cast<double>(counted);
}

}  // namespace kinegraph
