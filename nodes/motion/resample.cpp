#include "nodes/motion/resample.h"

#include <fmt/format.h>

#include <cmath>

namespace kinegraph {

namespace {

double whole_rate(double fps) {
  double whole = std::floor(fps + 0.5);
  return whole > 0 && std::fabs(fps - whole) <= 5e-5 * whole ? whole : fps;
}

// Between b and c, u from 0 to 1; a and d are the samples before and after.
Vec3 catmull_rom(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double u) {
  Vec3 from = 0.5 * (c - a), to = 0.5 * (d - b);
  Vec3 step = c - b;
  Vec3 square = 3 * step - 2 * from - to, cube = from + to - 2 * step;
  return b + u * (from + u * (square + u * cube));
}

// The sample after an end, on the parabola through the last three.
Vec3 beyond(ConstVec3Track p, std::ptrdiff_t end, std::ptrdiff_t inwards) {
  auto frames = static_cast<std::ptrdiff_t>(p.x.size());
  std::size_t a = end, b = end + inwards;
  if (frames < 3) return 2 * p[a] - p[b];
  std::size_t c = end + 2 * inwards;
  return 3 * (p[a] - p[b]) + p[c];
}

struct Moment {
  std::size_t frame;  // at or before it
  double part;        // of the way to the next; 0 = the frame itself
};

Vec3 placed(ConstVec3Track p, Moment moment) {
  std::size_t t = moment.frame;
  if (moment.part == 0) return p[t];
  auto last = static_cast<std::ptrdiff_t>(p.x.size()) - 1;
  Vec3 before = t > 0 ? p[t - 1] : beyond(p, 0, 1);
  Vec3 after = static_cast<std::ptrdiff_t>(t) + 2 <= last ? p[t + 2] : beyond(p, last, -1);
  return catmull_rom(before, p[t], p[t + 1], after, moment.part);
}

// Where the new samples lie among the old ones. Ratios of whole rates meet their common moments exactly.
std::vector<Moment> moments(std::size_t frames, double from, double to) {
  std::vector<Moment> all;
  constexpr double nothing = 1e-9;  // of a frame: rounding, not a place between frames
  double last = static_cast<double>(frames - 1);
  for (std::size_t k = 0;; ++k) {
    double place = static_cast<double>(k) * from / to;
    if (place > last + nothing) return all;
    double frame = std::floor(place + nothing);
    double part = place - frame;
    if (part < nothing || frame >= last) part = 0;
    all.push_back({static_cast<std::size_t>(frame), part});
  }
}

void check_count(std::size_t frames, double from, double to) {
  double count = static_cast<double>(frames - 1) * to / from + 1;
  if (count > 1e8) {
    throw Failure(error("too-many-frames", fmt::format("{:.0f} frames would come out", count))
                      .at_param("fps")
                      .hinting("choose a lower rate"));
  }
}

std::shared_ptr<const SourceFacts> facts_at(const Motion& motion) {
  auto facts = std::make_shared<SourceFacts>(*without_read(motion.shared_source()));
  facts->frame_time_text.clear();  // the file's spelling of another rate
  return facts;
}

}  // namespace

Motion resampled(const Motion& motion, double fps, Work& work) {
  double from = whole_rate(motion.fps()), to = whole_rate(fps);
  if (motion.frames() == 0 || from == to) {
    if (motion.fps() == fps) return motion;
    Motion same(motion.shared_skeleton(), motion.shared_source(), fps, motion.frames(), motion.translating());
    for (int j = 0; j < motion.joints(); ++j) {
      for (std::size_t t = 0; t < motion.frames(); ++t) same.rotation(j).set(t, motion.rotation(j)[t]);
      if (!motion.translates(j)) continue;
      for (std::size_t t = 0; t < motion.frames(); ++t) same.translation(j).set(t, motion.translation(j)[t]);
    }
    return same;
  }
  check_count(motion.frames(), from, to);
  auto samples = moments(motion.frames(), from, to);
  Motion result(motion.shared_skeleton(), facts_at(motion), fps, samples.size(), motion.translating());
  work.parallel(static_cast<std::size_t>(motion.joints()), 1, [&](std::size_t begin, std::size_t end) {
    for (int j = static_cast<int>(begin); j < static_cast<int>(end); ++j) {
      work.check();
      auto q = motion.rotation(j);
      auto out = result.rotation(j);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        auto [t, part] = samples[k];
        out.set(k, part == 0 ? q[t] : slerp(part, q[t], q[t + 1]));
        if (k % 4096 == 0) work.check();
      }
      make_continuous(out.x, out.y, out.z, out.w);
      if (!motion.translates(j)) continue;
      auto p = motion.translation(j);
      auto place = result.translation(j);
      for (std::size_t k = 0; k < samples.size(); ++k) place.set(k, placed(p, samples[k]));
    }
  });
  return result;
}

Points resampled(const Points& points, double fps, Work& work) {
  double from = whole_rate(points.fps), to = whole_rate(fps);
  if (points.frames == 0 || from == to) {
    Points same = points;
    same.fps = fps;
    return same;
  }
  check_count(points.frames, from, to);
  auto samples = moments(points.frames, from, to);
  Points result(points.labels, fps, samples.size());
  result.unit = points.unit;
  result.unit_name = points.unit_name;
  result.up = points.up;
  result.links = points.links;
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
    work.check();
    auto p = points.track(label);
    auto out = result.track(label);
    auto gone = [&](std::ptrdiff_t t) {
      return t < 0 || t >= static_cast<std::ptrdiff_t>(points.frames) ||
             points.is_missing(label, static_cast<std::size_t>(t));
    };
    for (std::size_t k = 0; k < samples.size(); ++k) {
      auto [t, part] = samples[k];
      auto frame = static_cast<std::ptrdiff_t>(t);
      if (gone(frame) || (part > 0 && gone(frame + 1))) {
        result.set_missing(label, k);
        continue;
      }
      if (part == 0) {
        out.set(k, p[t]);
        continue;
      }
      const Vec3 b = p[t], c = p[t + 1];
      const bool no_a = gone(frame - 1), no_d = gone(frame + 2);
      const Vec3 a = !no_a ? p[t - 1] : no_d ? 2 * b - c : 3 * (b - c) + p[t + 2];
      const Vec3 d = !no_d ? p[t + 2] : no_a ? 2 * c - b : 3 * (c - b) + p[t - 1];
      out.set(k, catmull_rom(a, b, c, d, part));
    }
  }
  return result;
}

}  // namespace kinegraph
