// How much of its liveliness something has lost, at every frame.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace kinegraph {

// Nothing at first; more_at() takes some around a frame, smoothly coming and going, settle() makes it count.
class Calm {
 public:
  Calm(std::size_t frames, double fps);
  double left(std::size_t frame) const { return 1 - lost_[frame]; }
  // Of all, from frame − 1 to frame.
  bool is_full(std::size_t frame) const { return lost_[frame] >= 1 && lost_[frame - 1] >= 1; }
  // Half of what is left goes from frame − 1 to frame.
  void more_at(std::size_t frame);
  void settle();

 private:
  std::vector<double> lost_;
  std::vector<std::pair<std::size_t, double>> wanted_;
  double fade_;  // frames
};

}  // namespace kinegraph
