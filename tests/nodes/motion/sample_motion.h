// Small skeletons and motions for tests.
#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "graph/value.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// "Hips" with two legs of four joints, a spine with a head, and two arms; 1.7 m high, facing z.
inline Skeleton sample_skeleton() {
  Skeleton s;
  auto add = [&](std::string name, const char* parent, Vec3 offset) {
    s.joints.push_back({std::move(name), s.joints.empty() ? -1 : s.find(parent), offset, {}});
    return s.size() - 1;
  };
  add("Hips", "", {0, 0.95, 0});
  for (const char* side : {"Left", "Right"}) {
    double x = side[0] == 'L' ? 1 : -1;
    std::string n = side;
    add(n + "UpLeg", "Hips", {0.1 * x, -0.05, 0});
    add(n + "Leg", (n + "UpLeg").c_str(), {0, -0.42, 0});
    add(n + "Foot", (n + "Leg").c_str(), {0, -0.4, 0});
    int toe = add(n + "ToeBase", (n + "Foot").c_str(), {0, -0.06, 0.13});
    s.ends.push_back({toe, {0, 0, 0.07}, ""});
  }
  add("Spine", "Hips", {0, 0.2, 0});
  add("Neck", "Spine", {0, 0.3, 0});
  int head = add("Head", "Neck", {0, 0.1, 0});
  s.ends.push_back({head, {0, 0.15, 0}, ""});
  for (const char* side : {"Left", "Right"}) {
    double x = side[0] == 'L' ? 1 : -1;
    std::string n = side;
    add(n + "Arm", "Spine", {0.18 * x, 0.25, 0});
    add(n + "ForeArm", (n + "Arm").c_str(), {0.28 * x, 0, 0});
    int hand = add(n + "Hand", (n + "ForeArm").c_str(), {0.25 * x, 0, 0});
    s.ends.push_back({hand, {0.15 * x, 0, 0}, ""});
  }
  return s;
}

// Smooth, irregular, and all different: each joint swings about its own axis with two frequencies; the root
// wanders.
inline Motion sample_motion(std::size_t frames, double fps = 120, std::uint64_t seed = 1,
                            Skeleton skeleton = sample_skeleton(), double swing = 0.4) {
  std::mt19937_64 random(seed);
  auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<bool> translates(skeleton.joints.size());
  translates[0] = true;
  auto shared = std::make_shared<const Skeleton>(std::move(skeleton));
  Motion motion(shared, std::make_shared<const SourceFacts>(), fps, frames, translates);
  for (int j = 0; j < motion.joints(); ++j) {
    Vec3 a{draw(-1, 1), draw(-1, 1), draw(-1, 1)}, b{draw(-1, 1), draw(-1, 1), draw(-1, 1)};
    double fa = draw(0.3, 1.5), fb = draw(0.3, 1.5), phase = draw(0, 6);
    auto q = motion.rotation(j);
    for (std::size_t t = 0; t < frames; ++t) {
      double s = static_cast<double>(t) / fps;
      q.set(t, shared->joints[j].rest * exp(swing * std::sin(2 * pi * fa * s + phase) * a) *
                   exp(swing * std::cos(2 * pi * fb * s) * b));
    }
    make_continuous(q.x, q.y, q.z, q.w);
  }
  auto p = motion.translation(0);
  for (std::size_t t = 0; t < frames; ++t) {
    double s = static_cast<double>(t) / fps;
    p.set(t, {0.3 * std::sin(s), 0.95 + 0.03 * std::sin(9 * s), 1.2 * s});
  }
  return motion;
}

inline std::string encoded(const Value& value) {
  Encoder out;
  value.encode(out);
  return out.take();
}

}  // namespace kinegraph
