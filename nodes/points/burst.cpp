#include "nodes/points/burst.h"

#include <cmath>
#include <string>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// SplitMix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

struct Particle {
  bool stem = false;
  double around = 0;     // angle about the vertical
  double over = 0;       // of the cap: angle round the ring's core at the start
  double from_core = 0;  // 0 in the core, 1 on the skin
  double pace = 1;       // how fast it bursts, times the speed
  double height = 0;     // of the stem: share of the cap's height
};

constexpr double heating = 0.9;  // s until the rise has fully begun
constexpr double folding = 4.2;  // rad/s of the core's circling at first
constexpr double ring = 0.6;     // the core's radius, as a share of the girth
constexpr double stem_share = 0.25;

Particle particle(Random& random) {
  Particle one;
  one.stem = random.between(0, 1) < stem_share;
  one.around = random.between(0, 2 * pi);
  one.over = random.between(0, 2 * pi);
  one.from_core = std::sqrt(random.between(0.02, 1));  // even over the ring's cross-section
  one.pace = random.between(0.75, 1.25);
  one.height = random.between(0.02, 0.95);
  return one;
}

Vec3 place(const Particle& one, const BurstParams& params, double time) {
  const double spread = 1 - exponential(-one.pace * params.speed * time / params.girth);
  const double whole_spread = 1 - exponential(-params.speed * time / params.girth);
  // Starts at rest, then climbs ever more slowly towards its height.
  const double warmth = time / heating;
  const double climbed = params.rise * (1 - exponential(-warmth * warmth / (1 + warmth)));
  const double thickness = (1 - ring) * params.girth;
  const double middle = climbed + thickness * whole_spread;
  const SinCos turned = sin_cos(one.around + 0.15 * time);
  double radius = 0, height = 0;
  if (one.stem) {
    // Narrow in the middle, wider where it leaves the ground and where it meets the cap.
    const double waist = 2 * one.height - 1;
    radius = params.girth * spread * one.from_core * (0.12 + 0.16 * waist * waist);
    height = middle * one.height * spread;
  } else {
    const double circled = folding * (time - heating * (1 - exponential(-time / heating))) /
                           (1 + 0.35 * time) * (1.2 - 0.5 * one.from_core);
    const SinCos over = sin_cos(one.over - circled);
    radius = params.girth * ring * whole_spread + thickness * spread * one.from_core * over.cos;
    height = middle + thickness * spread * one.from_core * 0.8 * over.sin;
  }
  return {radius * turned.cos, std::max(height, 0.0), radius * turned.sin};
}

}  // namespace

Points burst(const BurstParams& params, Work& work) {
  std::vector<std::string> labels;
  for (int i = 1; i <= params.particles; ++i) labels.push_back("p" + std::to_string(i));
  const auto frames = static_cast<std::size_t>(std::floor(params.seconds * params.fps + 0.5)) + 1;
  Points points(std::move(labels), params.fps, frames);
  Random random(params.seed);
  for (int i = 0; i < params.particles; ++i) {
    work.check();
    const Particle one = particle(random);
    const auto track = points.track(i);
    for (std::size_t t = 0; t < frames; ++t)
      track.set(t, place(one, params, static_cast<double>(t) / params.fps));
  }
  return points;
}

}  // namespace kinegraph
