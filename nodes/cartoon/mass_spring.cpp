#include "nodes/cartoon/mass_spring.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {

// Steps a second at least: some 40 to a swing of the defaults, which is of second order.
constexpr double usual_rate = 120;
constexpr double exact_enough = 1e-11;  // of r⁺, in parts of the link's length
constexpr int most_repetitions = 40;
// The push of a squashed link, as part of the system's diagonal, beyond which the step is halved, and how
// often.
constexpr double strongest_push = -0.3;
constexpr int most_halvings = 8;

class Chain {
 public:
  Chain(const std::vector<int>& parents, const MassSpringParams& params)
      : parents_(parents), params_(params) {
    const std::size_t n = parents.size();
    for (auto* list : {&x_, &v_, &u_, &right_, &free_, &to_parent_, &s_, &next_s_}) list->resize(n);
    for (auto* list : {&r_, &next_r_, &length_, &next_length_, &diagonal_, &coupling_}) list->resize(n);
  }

  void start(std::span<const Vec3> s, std::span<const Vec3> velocity) {
    std::copy(s.begin(), s.end(), s_.begin());
    x_ = s_;
    std::copy(velocity.begin(), velocity.end(), v_.begin());
    for (std::size_t i = 0; i < s_.size(); ++i) {
      if (parents_[i] < 0) continue;
      length_[i] = r_[i] = norm(s_[i] - s_[parents_[i]]);
    }
  }

  std::vector<Vec3>& next_driven() { return next_s_; }
  const std::vector<Vec3>& positions() const { return x_; }
  const std::vector<Vec3>& velocities() const { return v_; }

  // One step of h seconds, to next_driven().
  void step(double h, int halvings = 0) {
    if (!solved(h, halvings == most_halvings)) {
      const std::vector<Vec3> end = next_s_;
      for (std::size_t i = 0; i < end.size(); ++i) next_s_[i] = 0.5 * (s_[i] + end[i]);
      step(0.5 * h, halvings + 1);
      next_s_ = end;
      step(0.5 * h, halvings + 1);
      return;
    }
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_[i] += h * u_[i];
      v_[i] = 2 * u_[i] - v_[i];
    }
    std::swap(r_, next_r_);
    std::swap(length_, next_length_);
    std::swap(s_, next_s_);
  }

 private:
  // Finds the mean velocities of a step; false: the step is too long for how squashed a link is.
  bool solved(double h, bool whatever) {
    const std::size_t n = x_.size();
    const Vec3 drag = (h * params_.drag) * (params_.drag_in_root ? (1 / h) * (next_s_[0] - s_[0]) : Vec3{});
    for (std::size_t i = 0; i < n; ++i) {
      free_[i] = 2 * v_[i] + (h * params_.hook) * (0.5 * ((s_[i] - x_[i]) + (next_s_[i] - x_[i]))) + drag;
      if (parents_[i] < 0) continue;
      const std::size_t p = parents_[i];
      to_parent_[i] = x_[p] - x_[i];
      next_length_[i] = norm(next_s_[i] - next_s_[p]);
      // First guess of the new length: as the masses fly, their velocities changing as in the step before.
      next_r_[i] = norm(h * ((2 * v_[i] - u_[i]) - (2 * v_[p] - u_[p])) - to_parent_[i]);
    }
    for (int repetition = 0; repetition < most_repetitions; ++repetition) {
      if (!solve(h) && !whatever) return false;
      double change = 0;
      for (std::size_t i = 0; i < n; ++i) {
        if (parents_[i] < 0) continue;
        const double r = norm(h * (u_[i] - u_[parents_[i]]) - to_parent_[i]);
        const double moved = std::fabs(r - next_r_[i]) - exact_enough * (r + length_[i]);
        change = moved > change ? moved : change;
        next_r_[i] = r;
      }
      if (!(change > 0)) return true;
    }
    return whatever;
  }

  // The mean velocities u over the step for the present guess of the new lengths:
  //   u_i (2 + h drag + h² hook/2) + Σ_n (h²/2) c_in (u_i − u_n)
  //     = 2 v_i + h [hook (s̄_i − x_i) + Σ_n c_in (x_n − x_i) + drag v_drag],  c = link (1 − 2 ℓ̄ / (r⁺ + r)).
  // Leaves to root, then back.
  // False: a link's push was held to the strongest.
  bool solve(double h) {
    bool within = true;
    const std::size_t n = x_.size();
    const double half_square = 0.5 * h * h;
    const double own = 2 + h * params_.drag + half_square * params_.hook;
    std::fill(diagonal_.begin(), diagonal_.end(), own);
    std::copy(free_.begin(), free_.end(), right_.begin());
    for (std::size_t i = 0; i < n; ++i) {
      if (parents_[i] < 0) continue;
      const std::size_t p = parents_[i];
      const double sum = next_r_[i] + r_[i];
      double c = sum > 0 ? params_.link * (1 - (length_[i] + next_length_[i]) / sum) : 0;
      if (half_square * c < strongest_push) {
        c = strongest_push / half_square;
        within = false;
      }
      coupling_[i] = half_square * c;
      diagonal_[i] += coupling_[i];
      diagonal_[p] += coupling_[i];
      const Vec3 pull = (h * c) * to_parent_[i];
      right_[i] += pull;
      right_[p] -= pull;
    }
    for (std::size_t i = n; i-- > 0;) {
      diagonal_[i] = 1 / diagonal_[i];
      if (parents_[i] < 0) continue;
      const std::size_t p = parents_[i];
      const double factor = coupling_[i] * diagonal_[i];
      diagonal_[p] -= coupling_[i] * factor;
      right_[p] += factor * right_[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
      Vec3 value = right_[i];
      if (parents_[i] >= 0) value += coupling_[i] * u_[parents_[i]];
      u_[i] = diagonal_[i] * value;
    }
    return within;
  }

  const std::vector<int>& parents_;
  const MassSpringParams& params_;
  std::vector<Vec3> x_, v_, u_, right_, free_, to_parent_, s_, next_s_;
  std::vector<double> r_, next_r_, length_, next_length_, diagonal_, coupling_;
};

// The driven particles between two frames: a C1 cubic (Catmull-Rom), continued by odd reflection at the ends.
// Written in differences, so that what rests stays exactly where it is.
class Driven {
 public:
  explicit Driven(const ParticlePath& path) : path_(path) {}
  Vec3 velocity_at_start(std::size_t particle, double fps) const {
    return path_.frames() > 1 ? fps * (at(1, particle) - at(0, particle)) : Vec3{};
  }
  void between(std::size_t frame, double part, std::vector<Vec3>& out) const {
    const double f = part, f2 = f * f, f3 = f2 * f;
    const double before = 0.5 * (2 * f2 - f - f3), next = 0.5 * (f + 4 * f2 - 3 * f3),
                 after = 0.5 * (f3 - f2);
    const std::size_t last = path_.frames() - 1;
    for (std::size_t i = 0; i < path_.particles; ++i) {
      const Vec3 here = at(frame, i), there = at(frame + 1, i);
      const Vec3 to_before = frame > 0 ? at(frame - 1, i) - here : here - there;
      const Vec3 to_after = frame + 2 <= last ? at(frame + 2, i) - here : 2 * (there - here);
      out[i] = here + (before * to_before + next * (there - here) + after * to_after);
    }
  }
  void at_frame(std::size_t frame, std::vector<Vec3>& out) const {
    for (std::size_t i = 0; i < path_.particles; ++i) out[i] = at(frame, i);
  }

 private:
  Vec3 at(std::size_t frame, std::size_t particle) const {
    return path_.at[frame * path_.particles + particle];
  }
  const ParticlePath& path_;
};

int steps_of_a_frame(const MassSpringParams& params, double fps) {
  const double for_links = 2 * std::sqrt(params.link);
  const double rate =
      params.substeps > 0 ? for_links : std::max({usual_rate, for_links, std::sqrt(params.hook)});
  return std::max({1, params.substeps, static_cast<int>(std::ceil(rate / fps - 1e-9))});
}

}  // namespace

MassSpringResult simulate(const std::vector<int>& parents, const ParticlePath& driven, double fps,
                          const MassSpringParams& params, bool with_velocities, Work& work) {
  MassSpringResult result;
  result.positions.particles = driven.particles;
  result.velocities.particles = with_velocities ? driven.particles : 0;
  if (driven.frames() == 0) return result;
  const Driven path(driven);
  Chain chain(parents, params);
  std::vector<Vec3> start(driven.particles), velocity(driven.particles);
  path.at_frame(0, start);
  for (std::size_t i = 0; i < driven.particles; ++i) velocity[i] = path.velocity_at_start(i, fps);
  chain.start(start, velocity);
  const auto keep = [&] {
    auto& at = result.positions.at;
    at.insert(at.end(), chain.positions().begin(), chain.positions().end());
    if (!with_velocities) return;
    result.velocities.at.insert(result.velocities.at.end(), chain.velocities().begin(),
                                chain.velocities().end());
  };
  result.positions.at.reserve(driven.at.size());
  keep();
  const int steps = steps_of_a_frame(params, fps);
  const double h = 1 / (fps * steps);
  for (std::size_t frame = 0; frame + 1 < driven.frames(); ++frame) {
    for (int step = 1; step <= steps; ++step) {
      if (step % 64 == 1) work.check();
      if (step < steps)
        path.between(frame, static_cast<double>(step) / steps, chain.next_driven());
      else
        path.at_frame(frame + 1, chain.next_driven());
      chain.step(h);
    }
    keep();
  }
  return result;
}

double energy_of(const std::vector<int>& parents, std::span<const Vec3> rest, std::span<const Vec3> x,
                 std::span<const Vec3> v, const MassSpringParams& params) {
  double energy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    energy += 0.5 * dot(v[i], v[i]) + 0.5 * params.hook * dot(rest[i] - x[i], rest[i] - x[i]);
    if (parents[i] < 0) continue;
    const double longer = norm(x[i] - x[parents[i]]) - norm(rest[i] - rest[parents[i]]);
    energy += 0.5 * params.link * longer * longer;
  }
  return energy;
}

}  // namespace kinegraph
