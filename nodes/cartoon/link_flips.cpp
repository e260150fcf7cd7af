#include "nodes/cartoon/link_flips.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

constexpr double within = 0.98;     // of what it may, so that rounding in files doesn't pass it
constexpr double opposite = -0.99;  // cosine beyond which the middle of two directions isn't known
constexpr double at_ease = 0.5;     // of what it may, how fast a flip is spread

double angle_between(Vec3 a, Vec3 b) {
  return arc_tangent2(norm(cross(a, b)), dot(a, b));
}

// `from` turned towards `to` by at most so much; unit vectors.
Vec3 towards(Vec3 from, Vec3 to, double most) {
  if (dot(from, to) >= cosine(std::min(most, pi))) return to;
  Vec3 side = to - dot(from, to) * from;
  if (norm(side) < 1e-9) side = cross(from, std::fabs(from.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const SinCos part = sin_cos(most);
  return normalized(part.cos * from + part.sin * normalized(side));
}

class OneLink {
 public:
  OneLink(const WorldMotion& from, const WorldMotion& moved, const LinkFlipParams& params, int joint,
          int parent, double rest)
      : from_(from), params_(params), joint_(joint), parent_(parent), free_(params.free_below * rest) {
    const std::size_t frames = moved.frames();
    const auto child = moved.position(joint), above = moved.position(parent);
    for (std::size_t t = 0; t < frames; ++t) link_.push_back(child[t] - above[t]);
  }

  bool flips() const {
    const double cosine_squared = cosine(most()) * cosine(most());
    for (std::size_t t = 1; t < link_.size(); ++t) {
      const Vec3 a = link_[t - 1], b = link_[t];
      const double along = dot(a, b);
      if (most() < pi / 2 && along > 0 && along * along >= cosine_squared * dot(a, a) * dot(b, b)) continue;
      if (is_free(t)) continue;
      if (angle_between(a, b) > allowed(t)) return true;
    }
    return false;
  }

  // The links, turned no faster than they may.
  std::vector<Vec3> held() const {
    const std::size_t frames = link_.size();
    std::vector<Vec3> aim(frames), forward, backward;
    std::vector<double> most(frames);  // from the frame before; 2 π: as it likes
    for (std::size_t t = 0; t < frames; ++t) aim[t] = normalized(link_[t]);
    for (std::size_t t = 1; t < frames; ++t)
      most[t] = is_free(t) ? 2 * pi
                           : std::max(at_ease * this->most(),
                                      std::min(allowed(t), angle_between(link_[t - 1], link_[t])));
    const auto follow = [&](std::vector<Vec3>& way) {
      for (std::size_t t = 1; t < frames; ++t) way[t] = towards(way[t - 1], way[t], most[t]);
    };
    forward = backward = aim;
    follow(forward);
    for (std::size_t t = frames - 1; t-- > 0;)
      backward[t] = towards(backward[t + 1], backward[t], most[t + 1]);
    for (std::size_t t = 0; t < frames; ++t)
      aim[t] = dot(forward[t], backward[t]) > opposite ? normalized(forward[t] + backward[t]) : forward[t];
    soften(aim);
    for (std::size_t t = 1; t < frames; ++t) most[t] = is_free(t) ? 2 * pi : allowed(t);
    follow(aim);  // the middle of two that go within the limit may pass it where they are far apart
    for (std::size_t t = 0; t < frames; ++t) aim[t] = norm(link_[t]) * aim[t];
    return aim;
  }

 private:
  // Starts and ends turning gently, where it was made to.
  void soften(std::vector<Vec3>& aim) const {
    if (params_.softening == 0 || aim.size() < 3) return;
    const auto reach = static_cast<std::size_t>(std::ceil(2 * std::sqrt(0.5 * params_.softening)));
    std::vector<bool> turned(aim.size());
    for (std::size_t t = 0; t < aim.size(); ++t)
      if (dot(aim[t], normalized(link_[t])) < 1 - 1e-9)
        for (std::size_t u = t - std::min(t, reach); u < std::min(t + reach + 1, aim.size()); ++u)
          turned[u] = true;
    std::vector<Vec3> before;
    for (int pass = 0; pass < params_.softening; ++pass) {
      before = aim;
      for (std::size_t t = 1; t + 1 < aim.size(); ++t)
        if (turned[t] && dot(before[t - 1], before[t + 1]) > 0)
          aim[t] = normalized(before[t - 1] + 2 * before[t] + before[t + 1]);
    }
  }
  double most() const { return within * params_.most_turn; }
  bool is_free(std::size_t t) const { return norm(link_[t - 1]) <= free_ || norm(link_[t]) <= free_; }
  double allowed(std::size_t t) const {
    const auto child = from_.position(joint_), above = from_.position(parent_);
    const double input = angle_between(child[t - 1] - above[t - 1], child[t] - above[t]);
    return std::max(most(), within * params_.times_input * input);
  }

  const WorldMotion& from_;
  const LinkFlipParams& params_;
  int joint_, parent_;
  double free_;
  std::vector<Vec3> link_;
};

}  // namespace

void hold_link_flips(const Skeleton& skeleton, const std::vector<double>& lengths, const WorldMotion& from,
                     const LinkFlipParams& params, WorldMotion& moved, Work& work) {
  const std::size_t frames = moved.frames();
  for (int j = 1; j < skeleton.size(); ++j) {
    work.check();
    const int parent = skeleton.joints[j].parent;
    const double* v = lengths.data() + static_cast<std::size_t>(j) * frames;
    double rest = skeleton.link_length(j) * skeleton.above_scale;
    if (!(rest > 0)) rest = *std::max_element(v, v + frames);
    if (!(rest > 0)) continue;
    const OneLink link(from, moved, params, j, parent, rest);
    if (!link.flips()) continue;
    const std::vector<Vec3> held = link.held();
    std::vector<Vec3> shift(frames);
    for (std::size_t t = 0; t < frames; ++t)
      shift[t] = (std::as_const(moved).position(parent)[t] + held[t]) - std::as_const(moved).position(j)[t];
    for (int below = j; below < skeleton.size(); ++below) {
      if (!skeleton.is_below(below, j)) continue;
      const auto at = moved.position(below);
      for (std::size_t t = 0; t < frames; ++t) at.set(t, std::as_const(moved).position(below)[t] + shift[t]);
    }
  }
}

}  // namespace kinegraph
