// Components so small that their numbers can be followed by hand.
#pragma once
#include <memory>
#include <utility>

#include "nodes/components/components.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

// Two points that move by two components, in two segments of 40 and 50 frames: numbers that can be followed
// by hand.
inline Components small() {
  Components c;
  c.space.of_motions = false;
  c.space.heading = false;
  c.space.labels = {"p", "q"};
  c.fps = 60;
  c.mean = {1, 2, 3, 4, 5, 6};
  c.mixing = Rows(6, 2);
  c.mixing.data = {1, 0, 0, 2, 0.5, 0, 0, 0, 1, 1, 0, -1};
  c.unmixing = Rows(2, 6);
  // (MᵀM)⁻¹Mᵀ with MᵀM = [2.25 1; 1 6]
  const double determinant = 2.25 * 6 - 1;
  for (std::size_t d = 0; d < 6; ++d) {
    c.unmixing(0, d) = (6 * c.mixing(d, 0) - c.mixing(d, 1)) / determinant;
    c.unmixing(1, d) = (2.25 * c.mixing(d, 1) - c.mixing(d, 0)) / determinant;
  }
  c.signals = Rows(2, 90);
  for (std::size_t t = 0; t < 90; ++t) {
    c.signals(0, t) = sine(0.2 * static_cast<double>(t)) + (t < 40 ? 1 : -1);
    c.signals(1, t) = cosine(0.3 * static_cast<double>(t));
  }
  c.shares = {0.6, 0.4};
  c.unique = {true, true};
  for (const auto& [start, end] : {std::pair<std::size_t, std::size_t>{0, 40}, {40, 90}}) {
    Points clip(c.space.labels, 60, end - start);
    for (std::size_t t = start; t < end; ++t)
      for (int i = 0; i < 2; ++i) {
        Vec3 at;
        for (int axis = 0; axis < 3; ++axis) {
          const auto d = static_cast<std::size_t>(3 * i + axis);
          at[axis] = c.mean[d] + c.mixing(d, 0) * c.signals(0, t) + c.mixing(d, 1) * c.signals(1, t);
        }
        clip.track(i).set(t - start, at);
      }
    c.segments.push_back({start, end, nullptr, std::make_shared<const Points>(std::move(clip)), {}});
  }
  return c;
}

}  // namespace kinegraph
