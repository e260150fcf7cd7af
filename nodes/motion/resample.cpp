#include "nodes/motion/resample.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

// Between p1 (u = 0) and p2 (u = 1), with the slopes of the chords around them.
double catmull_rom(double p0, double p1, double p2, double p3, double u) {
  const double a = 2 * p1, b = p2 - p0, c = 2 * p0 - 5 * p1 + 4 * p2 - p3, d = 3 * (p1 - p2) + p3 - p0;
  return 0.5 * (a + u * (b + u * (c + u * d)));
}

double sampled(std::span<const double> series, std::size_t before, double u) {
  if (u == 0) return series[before];
  const std::size_t last = series.size() - 1;
  const double p1 = series[before], p2 = series[before + 1];
  // Past an end the motion goes on as it came.
  const double p0 = before > 0 ? series[before - 1] : 2 * p1 - p2;
  const double p3 = before + 2 <= last ? series[before + 2] : 2 * p2 - p1;
  return catmull_rom(p0, p1, p2, p3, u);
}

}  // namespace

Motion resampled(const Motion& motion, double fps, Work& work) {
  if (fps == motion.fps()) return motion;
  const std::size_t frames = motion.frames();
  std::size_t count = 0;
  if (frames > 0)
    count =
        static_cast<std::size_t>(std::floor(static_cast<double>(frames - 1) / motion.fps() * fps + 1e-6)) + 1;
  auto memory = work.reserve(count * static_cast<std::size_t>(motion.joints()) * 4 * sizeof(double));
  Motion out(motion.shared_skeleton(), motion.shared_source(), fps, count, motion.translating());
  std::vector<std::size_t> before(count);
  std::vector<double> part(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) * motion.fps() / fps;
    double whole = std::floor(at + 1e-9);
    if (whole >= static_cast<double>(frames - 1)) whole = static_cast<double>(frames - 1);
    before[i] = static_cast<std::size_t>(whole);
    part[i] = before[i] == frames - 1 || at - whole < 1e-9 ? 0 : at - whole;
  }
  work.parallel(static_cast<std::size_t>(motion.joints()), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      work.check();
      const int joint = static_cast<int>(j);
      auto from = motion.rotation(joint);
      auto to = out.rotation(joint);
      for (std::size_t i = 0; i < count; ++i) {
        Quat q = from[before[i]];
        if (part[i] != 0) q = slerp(part[i], q, from[before[i] + 1]);
        to.set(i, i > 0 ? nearer(q, to[i - 1]) : q);
      }
      if (!motion.translates(joint)) continue;
      auto track = motion.translation(joint);
      auto moved = out.translation(joint);
      for (std::size_t i = 0; i < count; ++i)
        moved.set(i, {sampled(track.x, before[i], part[i]), sampled(track.y, before[i], part[i]),
                      sampled(track.z, before[i], part[i])});
    }
  });
  return out;
}

}  // namespace kinegraph
