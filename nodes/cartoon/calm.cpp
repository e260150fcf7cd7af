#include "nodes/cartoon/calm.h"

#include <algorithm>

#include "nodes/cartoon/planted_limbs.h"

namespace kinegraph {
namespace {

constexpr double fade_seconds = 0.3;  // in which it is lost and comes back
constexpr double calm_enough = 0.9;   // more than that is all

}  // namespace

Calm::Calm(std::size_t frames, double fps) : lost_(frames), fade_(std::max(fade_seconds * fps, 1.0)) {}

void Calm::more_at(std::size_t frame) {
  double size = 0.5 * (1 + lost_[frame]);
  if (size > calm_enough) size = 1;
  const auto reach = static_cast<std::size_t>(fade_) + 1;
  const std::size_t first = frame > reach ? frame - reach : 0;
  for (std::size_t t = first; t < std::min(frame + reach, lost_.size()); ++t) {
    const double away = t >= frame ? static_cast<double>(t - frame) : static_cast<double>(frame - 1 - t);
    wanted_.emplace_back(t, size * smoothest_step(1 - away / fade_));
  }
}

void Calm::settle() {
  for (const auto& [t, size] : wanted_) lost_[t] = std::max(lost_[t], size);
  wanted_.clear();
}

}  // namespace kinegraph
