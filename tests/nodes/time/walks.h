// Walks for tests of time: made by Gait, bent in time and turned on their way.
#pragma once
#include <cmath>

#include "nodes/gait/gait.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

inline Motion gait(const std::string& name, double seconds, double fps = 60, std::uint64_t seed = 3) {
  Alone work;
  GaitParams params;
  params.gait = name;
  params.seconds = seconds;
  params.fps = fps;
  params.seed = seed;
  return make_gait(params, work);
}

// The motion at `frames` times, from `first` to `last`, running faster and slower by `bend` (under 1) twice.
inline Motion bent(const Motion& motion, std::size_t frames, double bend) {
  Motion out = motion.empty_like(frames);
  const double last = static_cast<double>(motion.frames() - 1);
  for (std::size_t f = 0; f < frames; ++f) {
    const double part = frames > 1 ? static_cast<double>(f) / static_cast<double>(frames - 1) : 0;
    const double time = std::min(last, last * (part + bend * sine(4 * pi * part) / (4 * pi)));
    const auto low = std::min(static_cast<std::size_t>(time), motion.frames() - 2);
    for (int j = 0; j < motion.joints(); ++j) {
      const auto rows = motion.rotation(j);
      out.rotation(j).set(f, slerp(time - static_cast<double>(low), rows[low], rows[low + 1]));
      if (!motion.translates(j)) continue;
      const auto at = motion.translation(j);
      out.translation(j).set(f, at[low] + (time - static_cast<double>(low)) * (at[low + 1] - at[low]));
    }
  }
  return out;
}

// The same walk along a circle: `radians` of turning in all.
inline Motion turning(const Motion& motion, double radians) {
  Alone work;
  Motion out = motion;
  EncodedRoot root = encode_root(motion, work);
  const double rate = radians / static_cast<double>(motion.frames() - 1) * motion.fps();
  for (double& turn : root.d_heading) turn += rate;
  root.start_heading = 0.7;
  decode_root(root, out);
  return out;
}

// A joint below the root that slides along its link, as six-channel BVH files have it.
inline Motion with_sliding_joint(const Motion& motion, int joint) {
  Motion out = motion.with_translation(joint);
  const auto track = out.translation(joint);
  for (std::size_t f = 0; f < out.frames(); ++f)
    track.set(f, track[f] * (1 + 0.1 * sine(0.13 * static_cast<double>(f))));
  return out;
}

struct Difference {
  double turn = 0, position = 0;  // largest over joints and frames: rad, m (of translations)
};
inline Difference difference(const Motion& a, const Motion& b) {
  Difference worst;
  for (int j = 0; j < a.joints(); ++j) {
    for (std::size_t f = 0; f < a.frames(); ++f) {
      worst.turn = std::max(worst.turn, turn(a.rotation(j)[f], b.rotation(j)[f]));
      worst.position = std::max(worst.position, norm(a.local_offset(j, f) - b.local_offset(j, f)));
    }
  }
  return worst;
}

}  // namespace kinegraph
