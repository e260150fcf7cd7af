// Positions or rotations of all joints over a few frames, each joint's series contiguous.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

// So many numbers a joint, each of them a series of its own.
template <std::size_t N>
class JointSeries {
 public:
  JointSeries() = default;
  JointSeries(std::size_t joints, std::size_t frames) : frames_(frames), data_(N * joints * frames) {}
  std::size_t frames() const { return frames_; }

 protected:
  std::span<double> series(int joint, std::size_t n) { return {data_.data() + at(joint, n), frames_}; }
  std::span<const double> series(int joint, std::size_t n) const {
    return {data_.data() + at(joint, n), frames_};
  }

 private:
  std::size_t at(int joint, std::size_t n) const {
    return (N * static_cast<std::size_t>(joint) + n) * frames_;
  }
  std::size_t frames_ = 0;
  std::vector<double> data_;
};

class JointPositions : public JointSeries<3> {
 public:
  using JointSeries::JointSeries;
  Vec3Track operator[](int joint) { return {series(joint, 0), series(joint, 1), series(joint, 2)}; }
  ConstVec3Track operator[](int joint) const {
    return {series(joint, 0), series(joint, 1), series(joint, 2)};
  }
};

class JointRotations : public JointSeries<4> {
 public:
  using JointSeries::JointSeries;
  QuatTrack operator[](int joint) {
    return {series(joint, 0), series(joint, 1), series(joint, 2), series(joint, 3)};
  }
  ConstQuatTrack operator[](int joint) const {
    return {series(joint, 0), series(joint, 1), series(joint, 2), series(joint, 3)};
  }
};

}  // namespace kinegraph
