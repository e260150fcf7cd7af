// Positions or rotations of all joints over a few frames, each joint's series contiguous.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "nodes/motion/motion.h"

namespace kinegraph {

class JointPositions {
 public:
  JointPositions() = default;
  JointPositions(std::size_t joints, std::size_t frames) : frames_(frames), data_(3 * joints * frames) {}
  std::size_t frames() const { return frames_; }
  Vec3Track operator[](int joint) { return {axis(joint, 0), axis(joint, 1), axis(joint, 2)}; }
  ConstVec3Track operator[](int joint) const { return {axis(joint, 0), axis(joint, 1), axis(joint, 2)}; }

 private:
  std::size_t at(int joint, std::size_t n) const {
    return (3 * static_cast<std::size_t>(joint) + n) * frames_;
  }
  std::span<double> axis(int joint, std::size_t n) { return {data_.data() + at(joint, n), frames_}; }
  std::span<const double> axis(int joint, std::size_t n) const {
    return {data_.data() + at(joint, n), frames_};
  }
  std::size_t frames_ = 0;
  std::vector<double> data_;
};

class JointRotations {
 public:
  JointRotations() = default;
  JointRotations(std::size_t joints, std::size_t frames) : frames_(frames), data_(4 * joints * frames) {}
  std::size_t frames() const { return frames_; }
  QuatTrack operator[](int joint) {
    return {number(joint, 0), number(joint, 1), number(joint, 2), number(joint, 3)};
  }
  ConstQuatTrack operator[](int joint) const {
    return {number(joint, 0), number(joint, 1), number(joint, 2), number(joint, 3)};
  }

 private:
  std::size_t at(int joint, std::size_t n) const {
    return (4 * static_cast<std::size_t>(joint) + n) * frames_;
  }
  std::span<double> number(int joint, std::size_t n) { return {data_.data() + at(joint, n), frames_}; }
  std::span<const double> number(int joint, std::size_t n) const {
    return {data_.data() + at(joint, n), frames_};
  }
  std::size_t frames_ = 0;
  std::vector<double> data_;
};

}  // namespace kinegraph
