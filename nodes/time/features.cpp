#include "nodes/time/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/motion/joint_pattern.h"
#include "nodes/motion/quaternion_mean.h"
#include "nodes/motion/rotation_channels.h"

namespace kinegraph {
namespace {

constexpr double least_joint_spread = 0.05;  // rad: stiller joints are mostly noise and must not be blown up
constexpr double least_root_spread = 1e-3;   // m/s, m, rad/s
constexpr double stillness = 1e-9;           // what moves less is constant: rounding only

struct Token {
  bool minus = false;
  std::string text;  // still escaped
};

std::vector<Token> tokens_of(std::string_view pattern) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] == ',') {
      parts.emplace_back();
      continue;
    }
    parts.back() += pattern[i];
    if (pattern[i] == '\\' && i + 1 < pattern.size()) parts.back() += pattern[++i];
  }
  std::vector<Token> tokens;
  for (std::string& part : parts) {
    const std::size_t first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    if (first == std::string::npos) continue;
    part = part.substr(first, last - first + 1);
    const bool minus = part[0] == '-';
    tokens.push_back({minus, part.substr(minus ? 1 : 0)});
  }
  return tokens;
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double sum_of_squares(std::span<const double> values, double mean) {
  double sum = 0;
  for (double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

double largest_from(std::span<const double> values, double mean) {
  double largest = 0;
  for (double value : values) largest = std::max(largest, std::abs(value - mean));
  return largest;
}

// 2 log(difference(joint, q)) of every joint and frame; the root's q is ρ.
template <class Difference>
Series vectors_of(const Motion& motion, const EncodedRoot& root, const Difference& difference, Work& work) {
  const std::size_t frames = motion.frames(), joints = static_cast<std::size_t>(motion.joints());
  Series v(frames, 3 * joints);
  work.parallel(
      joints, 1 + 20'000 / std::max<std::size_t>(frames, 1), [&](std::size_t begin, std::size_t end) {
        for (std::size_t joint = begin; joint < end; ++joint) {
          work.check();
          const ConstQuatTrack track = motion.rotation(static_cast<int>(joint));
          for (std::size_t t = 0; t < frames; ++t) {
            const Vec3 half = log(nearer(difference(joint, joint == 0 ? root.rho[t] : track[t]), Quat{}));
            for (int axis = 0; axis < 3; ++axis)
              v.dim(3 * joint + static_cast<std::size_t>(axis))[t] = 2 * half[axis];
          }
        }
      });
  return v;
}

}  // namespace

const char* name_of_root_axis(int axis) {
  constexpr std::array names{"root.travel_x", "root.travel_z", "root.height", "root.heading"};
  return names.at(static_cast<std::size_t>(axis));
}

std::string name_of(const Dof& dof, const Skeleton& skeleton) {
  if (dof.joint < 0) return name_of_root_axis(dof.axis);
  return skeleton.joints[dof.joint].name + "." + "xyz"[dof.axis];
}

std::vector<Dof> all_dofs(const Skeleton& skeleton) {
  std::vector<Dof> dofs;
  for (int joint = 0; joint < skeleton.size(); ++joint)
    for (int axis = 0; axis < 3; ++axis) dofs.push_back({joint, axis});
  for (int axis = 0; axis < root_axes; ++axis) dofs.push_back({-1, axis});
  return dofs;
}

const std::vector<double>& root_axis(const EncodedRoot& root, int axis) {
  switch (axis) {
    case 0:
      return root.d_x;
    case 1:
      return root.d_z;
    case 2:
      return root.height;
    default:
      return root.d_heading;
  }
}
std::vector<double>& root_axis(EncodedRoot& root, int axis) {
  return const_cast<std::vector<double>&>(root_axis(static_cast<const EncodedRoot&>(root), axis));
}

RotationVectors rotation_vectors(const Motion& motion, const EncodedRoot& root, Work& work) {
  RotationVectors result;
  const auto joints = static_cast<std::size_t>(motion.joints());
  result.means.resize(joints);
  const std::vector<double> rho = as_channels(root.rho);
  work.parallel(joints, 1 + 20'000 / std::max<std::size_t>(motion.frames(), 1),
                [&](std::size_t begin, std::size_t end) {
                  for (std::size_t joint = begin; joint < end; ++joint) {
                    work.check();
                    const ConstQuatTrack own = motion.rotation(static_cast<int>(joint));
                    result.means[joint] = karcher_mean(joint == 0 ? track_of(rho) : own).mean;
                  }
                });
  result.v = vectors_of(
      motion, root, [&](std::size_t joint, Quat q) { return inverse(result.means[joint]) * q; }, work);
  return result;
}

std::vector<Quat> bases_of(const RotationVectors& vectors, const Skeleton& skeleton) {
  std::vector<Quat> bases = vectors.means;
  bases[0] = skeleton.above * skeleton.joints[0].rest;
  return bases;
}

Series carried_vectors(const std::vector<Quat>& bases, const Motion& motion, const EncodedRoot& root,
                       Work& work) {
  const auto difference = [&](std::size_t joint, Quat q) {
    return joint == 0 ? q * inverse(bases[0]) : inverse(bases[joint]) * q;
  };
  return vectors_of(motion, root, difference, work);
}

Quat carried_rotation(const std::vector<Quat>& bases, std::size_t joint, Vec3 v) {
  return joint == 0 ? exp(0.5 * v) * bases[0] : bases[joint] * exp(0.5 * v);
}

std::vector<bool> chosen_dofs(std::string_view pattern, const Skeleton& skeleton, std::string_view param,
                              Work& work) {
  const auto dofs = all_dofs(skeleton);
  const std::vector<Token> tokens = tokens_of(pattern);
  std::vector<bool> chosen(dofs.size(), !tokens.empty() && tokens.front().minus);
  for (const Token& token : tokens) {
    bool known = false;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
      const bool named =
          name_of(dofs[d], skeleton) == token.text || (dofs[d].joint < 0 && token.text == "root");
      if (!named) continue;
      chosen[d] = !token.minus;
      known = true;
    }
    if (known && skeleton.find(token.text) < 0) continue;
    const std::vector<bool> joints = chosen_joints(token.text, skeleton, param, work);
    for (std::size_t d = 0; d < dofs.size(); ++d)
      if (dofs[d].joint >= 0 && joints[dofs[d].joint]) chosen[d] = !token.minus;
  }
  return chosen;
}

Features features_of(const RotationVectors& source, const EncodedRoot& source_root,
                     const RotationVectors& reference, const EncodedRoot& reference_root,
                     const std::vector<int>& partner, const std::vector<bool>& chosen, Work& work) {
  struct Pick {
    Dof dof;
    std::span<const double> s, r;
    double s_mean, r_mean, scale;
  };
  std::vector<Pick> picks;
  const auto frames = static_cast<double>(source.v.frames + reference.v.frames);
  const auto add = [&](Dof dof, std::span<const double> s, std::span<const double> r, double s_mean,
                       double r_mean, double spread) {
    if (largest_from(s, s_mean) <= stillness && largest_from(r, r_mean) <= stillness) return;
    picks.push_back({dof, s, r, s_mean, r_mean, 1 / spread});
  };
  for (std::size_t joint = 0; joint < partner.size(); ++joint) {
    if (partner[joint] < 0) continue;
    work.check();
    const auto other = static_cast<std::size_t>(partner[joint]);
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      squares += sum_of_squares(source.v.dim(3 * joint + axis), 0) +
                 sum_of_squares(reference.v.dim(3 * other + axis), 0);
    const double half_angle = 0.5 * std::sqrt(squares / frames);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (chosen[3 * joint + axis])
        add({static_cast<int>(joint), static_cast<int>(axis)}, source.v.dim(3 * joint + axis),
            reference.v.dim(3 * other + axis), 0, 0, std::max(least_joint_spread, half_angle));
  }
  for (int axis = 0; axis < root_axes; ++axis) {
    if (!chosen[3 * partner.size() + static_cast<std::size_t>(axis)]) continue;
    const auto &s = root_axis(source_root, axis), &r = root_axis(reference_root, axis);
    const double s_mean = mean_of(s), r_mean = mean_of(r);
    const double spread = std::sqrt((sum_of_squares(s, s_mean) + sum_of_squares(r, r_mean)) / frames);
    add({-1, axis}, s, r, s_mean, r_mean, std::max(least_root_spread, spread));
  }

  Features features;
  features.source = Series(source.v.frames, picks.size());
  features.reference = Series(reference.v.frames, picks.size());
  for (std::size_t d = 0; d < picks.size(); ++d) {
    work.check();
    const Pick& pick = picks[d];
    features.dofs.push_back(pick.dof);
    for (std::size_t t = 0; t < pick.s.size(); ++t)
      features.source.dim(d)[t] = pick.scale * (pick.s[t] - pick.s_mean);
    for (std::size_t t = 0; t < pick.r.size(); ++t)
      features.reference.dim(d)[t] = pick.scale * (pick.r[t] - pick.r_mean);
  }
  return features;
}

}  // namespace kinegraph
