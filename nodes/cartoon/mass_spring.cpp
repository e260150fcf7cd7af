#include "nodes/cartoon/mass_spring.h"

#include <algorithm>
#include <cmath>

#include "nodes/cartoon/mass_spring_kernels.h"

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

// Frames in which the driven jump, by how much their speed changes, in parts of the tree's height a second,
// and for how long the swing that starts there is gone through in twice as many steps.
constexpr double jump_speed = 8, jump_seconds = 0.5;

// A number a particle, or three, apart by axis, so that a loop over links takes several at once.
using Row = std::vector<double>;
struct Axes {
  Row x, y, z;
  explicit Axes(std::size_t count) : x(count), y(count), z(count) {}
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3 v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

// Inside, particles stand by their depth in the tree: neighbours in memory are on different limbs, so that a
// sweep over the tree needn't end one before it takes up the next. First the roots, then the links' lower
// ends.
class Chain {
 public:
  Chain(const std::vector<int>& parents, const MassSpringParams& params)
      : params_(params), count_(parents.size()), order_(count_), parent_(count_) {
    for (Axes* axes : {&x_, &v_, &u_, &right_, &free_, &s_, &next_s_, &to_parent_, &link_v_, &link_u_})
      *axes = Axes(count_ + spring_room);
    for (Row* row : {&r_, &next_r_, &reached_, &length_, &next_length_, &lengths_, &diagonal_, &coupling_,
                     &pull_, &share_, &missed_, &push_, &along_, &answer_})
      row->resize(count_ + spring_room);
    std::vector<int> depth(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      order_[i] = i;
      if (parents[i] < 0)
        ++roots_;
      else
        depth[i] = depth[static_cast<std::size_t>(parents[i])] + 1;
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return depth[a] < depth[b]; });
    std::vector<std::size_t> place(count_);
    for (std::size_t i = 0; i < count_; ++i) place[order_[i]] = i;
    for (std::size_t i = roots_; i < count_; ++i)
      parent_[i] = place[static_cast<std::size_t>(parents[order_[i]])];
  }

  void start(std::span<const Vec3> s, std::span<const Vec3> velocity) {
    for (std::size_t i = 0; i < count_; ++i) {
      s_.set(i, s[order_[i]]);
      x_.set(i, s_[i]);
      v_.set(i, velocity[order_[i]]);
    }
    for (std::size_t i = roots_; i < count_; ++i) {
      length_[i] = r_[i] = norm(s_[i] - s_[parent_[i]]);
      link_v_.set(i, v_[i] - v_[parent_[i]]);
    }
  }

  void set_next_driven(std::span<const Vec3> s) {
    for (std::size_t i = 0; i < count_; ++i) next_s_.set(i, s[order_[i]]);
  }
  void positions(std::span<Vec3> out) const {
    for (std::size_t i = 0; i < count_; ++i) out[order_[i]] = x_[i];
  }
  void velocities(std::span<Vec3> out) const {
    for (std::size_t i = 0; i < count_; ++i) out[order_[i]] = v_[i];
  }

  // One step of h seconds, to the next driven positions.
  void step(double h, int halvings = 0) {
    if (!solved(h, halvings == most_halvings)) {
      const Axes end = next_s_;
      for (std::size_t i = 0; i < count_; ++i) next_s_.set(i, 0.5 * (s_[i] + end[i]));
      step(0.5 * h, halvings + 1);
      next_s_ = end;
      step(0.5 * h, halvings + 1);
      return;
    }
    const auto advance = [&](const Row& u, Row& x, Row& v, const Row& of_link, Row& v_of_link) {
      for (std::size_t i = 0; i < count_; ++i) {
        x[i] += h * u[i];
        v[i] = 2 * u[i] - v[i];
        v_of_link[i] = 2 * of_link[i] - v_of_link[i];
      }
    };
    advance(u_.x, x_.x, v_.x, link_u_.x, link_v_.x);
    advance(u_.y, x_.y, v_.y, link_u_.y, link_v_.y);
    advance(u_.z, x_.z, v_.z, link_u_.z, link_v_.z);
    std::swap(r_, reached_);
    std::swap(length_, next_length_);
    std::swap(s_, next_s_);
  }

 private:
  // Finds the mean velocities of a step; false: the step is too long for how squashed a link is.
  bool solved(double h, bool whatever) {
    SpringStep step;
    step.h = h;
    step.link = params_.link;
    step.own = 2 + h * params_.drag + 0.5 * h * h * params_.hook;
    step.least = strongest_push / (0.5 * h * h);
    step.exact = exact_enough;
    prepare(h);
    const SpringRows all = rows();
    for (int repetition = 0; repetition < most_repetitions; ++repetition) {
      const bool within = spring_couplings(all, step) >= step.least;
      if (!within && !whatever) return false;
      solve(step.own);
      if (!(spring_misses(all, step) > 0)) return true;
      guess_again();
    }
    return whatever;
  }

  SpringRows rows() {
    SpringRows all;
    all.first = roots_;
    all.end = count_;
    const auto of = [](Axes& axes, auto* out) {
      out[0] = axes.x.data();
      out[1] = axes.y.data();
      out[2] = axes.z.data();
    };
    of(to_parent_, all.to_parent);
    of(link_u_, all.velocity);
    of(free_, all.free);
    of(right_, all.right);
    all.r = r_.data();
    all.lengths = lengths_.data();
    all.next_r = next_r_.data();
    all.reached = reached_.data();
    all.missed = missed_.data();
    all.push = push_.data();
    all.share = share_.data();
    all.coupling = coupling_.data();
    all.pull = pull_.data();
    all.diagonal = diagonal_.data();
    return all;
  }

  // What stays the same through the repetitions, and the first guess of the new lengths.
  void prepare(double h) {
    const double of_hook = h * params_.hook;
    const auto forces = [&](const Row& v, const Row& s, const Row& next, const Row& x, Row& out) {
      const double drag = h * params_.drag * (params_.drag_in_root ? (1 / h) * (next[0] - s[0]) : 0.0);
      for (std::size_t i = 0; i < count_; ++i)
        out[i] = 2 * v[i] + of_hook * (0.5 * ((s[i] - x[i]) + (next[i] - x[i]))) + drag;
    };
    forces(v_.x, s_.x, next_s_.x, x_.x, free_.x);
    forces(v_.y, s_.y, next_s_.y, x_.y, free_.y);
    forces(v_.z, s_.z, next_s_.z, x_.z, free_.z);
    // First guess of the new lengths: as the masses fly, their velocities changing as in the step before.
    for (std::size_t i = roots_; i < count_; ++i) {
      const std::size_t p = parent_[i];
      const Vec3 to_parent = x_[p] - x_[i];
      to_parent_.set(i, to_parent);
      next_length_[i] = norm(next_s_[i] - next_s_[p]);
      lengths_[i] = length_[i] + next_length_[i];
      next_r_[i] = norm(h * (2 * link_v_[i] - link_u_[i]) - to_parent);
      const double both = r_[i] * r_[p];
      along_[i] = p >= roots_ && both > 0 ? dot(to_parent, to_parent_[p]) / both : 0;
    }
  }

  // The mean velocities u over the step for the present guess of the new lengths:
  //   u_i (2 + h drag + h² hook/2) + Σ_n (h²/2) c_in (u_i − u_n)
  //     = 2 v_i + h [hook (s̄_i − x_i) + Σ_n c_in (x_n − x_i) + drag v_drag],  c = link (1 − 2 ℓ̄ / (r⁺ + r)).
  // Leaves to root, then back.
  void solve(double own) {
    for (std::size_t i = 0; i < roots_; ++i) {
      diagonal_[i] = own;
      right_.set(i, free_[i]);
    }
    for (std::size_t i = count_; i-- > roots_;) {
      const std::size_t p = parent_[i];
      const double inverse = 1 / diagonal_[i], factor = coupling_[i] * inverse;
      diagonal_[i] = inverse;
      diagonal_[p] += coupling_[i] - coupling_[i] * factor;
      right_.x[p] += factor * right_.x[i] - pull_[i] * to_parent_.x[i];
      right_.y[p] += factor * right_.y[i] - pull_[i] * to_parent_.y[i];
      right_.z[p] += factor * right_.z[i] - pull_[i] * to_parent_.z[i];
    }
    for (std::size_t i = 0; i < roots_; ++i) u_.set(i, (1 / diagonal_[i]) * right_[i]);
    for (std::size_t i = roots_; i < count_; ++i) {
      const Vec3 above = u_[parent_[i]];
      const Vec3 u = diagonal_[i] * (right_[i] + coupling_[i] * above);
      u_.set(i, u);
      link_u_.set(i, u - above);
    }
  }

  // A link that turns out longer than guessed pulls more: half of what that takes back from its own length it
  // adds to that of the links above and below, as far as they lie in one line. Newton's method with the
  // links' own answers, its system solved by one round of Jacobi's.
  void guess_again() {
    std::copy(missed_.begin(), missed_.end(), answer_.begin());
    for (std::size_t i = roots_; i < count_; ++i) {
      const std::size_t p = parent_[i];
      answer_[i] += share_[i] * (along_[i] * push_[p]);
      answer_[p] += share_[p] * (along_[i] * push_[i]);
    }
    for (std::size_t i = roots_; i < count_; ++i) next_r_[i] = std::max(next_r_[i] + answer_[i], 0.0);
  }

  const MassSpringParams& params_;
  std::size_t count_, roots_ = 0;
  std::vector<std::size_t> order_;   // outside number of each particle
  std::vector<std::size_t> parent_;  // of a link's lower end
  Axes x_{0}, v_{0}, u_{0}, right_{0}, free_{0}, s_{0}, next_s_{0};
  Axes to_parent_{0}, link_v_{0}, link_u_{0};  // lower end less upper
  Row r_, next_r_, reached_, length_, next_length_, lengths_;
  Row diagonal_, coupling_, pull_, share_, missed_, push_, answer_;
  Row along_;  // cosine between a link and the one above it
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
  std::span<const Vec3> at_frame(std::size_t frame) const {
    return std::span(path_.at).subspan(frame * path_.particles, path_.particles);
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

// Whether each frame, up to the next, lies in the swing that a jump of the driven particles starts.
std::vector<bool> after_jumps(const std::vector<int>& parents, const ParticlePath& driven, double fps) {
  const std::size_t frames = driven.frames(), count = driven.particles;
  std::vector<double> way(count);  // from the root, in the first frame
  double longest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (parents[i] < 0) continue;
    const auto p = static_cast<std::size_t>(parents[i]);
    way[i] = way[p] + norm(driven.at[i] - driven.at[p]);
    longest = std::max(longest, way[i]);
  }
  const double most = jump_speed * longest / fps;
  const auto last = static_cast<std::size_t>(std::ceil(jump_seconds * fps));
  std::vector<bool> after(frames);
  std::size_t until = 0;
  for (std::size_t t = 0; t < frames; ++t) {
    double square = 0;
    for (std::size_t i = 0; i < count && t + 2 < frames; ++i) {
      const Vec3* here = &driven.at[t * count + i];
      const Vec3 change = (here[2 * count] - here[count]) - (here[count] - here[0]);
      square = std::max(square, dot(change, change));
    }
    if (longest > 0 && square > most * most) until = t + last;
    after[t] = t < until;
  }
  return after;
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
  std::vector<Vec3> velocity(driven.particles), between(driven.particles);
  for (std::size_t i = 0; i < driven.particles; ++i) velocity[i] = path.velocity_at_start(i, fps);
  chain.start(path.at_frame(0), velocity);
  result.positions.at.resize(driven.at.size());
  if (with_velocities) result.velocities.at.resize(driven.at.size());
  const auto keep = [&](std::size_t frame) {
    const auto of = [&](ParticlePath& all) {
      return std::span(all.at).subspan(frame * driven.particles, driven.particles);
    };
    chain.positions(of(result.positions));
    if (with_velocities) chain.velocities(of(result.velocities));
  };
  keep(0);
  const int usual = steps_of_a_frame(params, fps);
  const std::vector<bool> jumps = after_jumps(parents, driven, fps);
  for (std::size_t frame = 0; frame + 1 < driven.frames(); ++frame) {
    const int steps = jumps[frame] ? 2 * usual : usual;
    const double h = 1 / (fps * steps);
    for (int step = 1; step <= steps; ++step) {
      if (step % 64 == 1) work.check();
      if (step < steps) {
        path.between(frame, static_cast<double>(step) / steps, between);
        chain.set_next_driven(between);
      } else {
        chain.set_next_driven(path.at_frame(frame + 1));
      }
      chain.step(h);
    }
    keep(frame + 1);
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
