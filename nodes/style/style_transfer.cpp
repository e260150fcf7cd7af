#include "nodes/style/style_transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "nodes/motion/elementary.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/half_angle.h"
#include "nodes/motion/rotation_channels.h"
#include "nodes/node_params.h"
#include "nodes/style/euler_channels.h"
#include "nodes/style/travel_factor.h"

namespace kinegraph {

namespace {

// Past a half-turn from the mean the sphere wraps; warned about a little before.
constexpr double fold_limit = 170 / degrees_per_radian;

struct Gain {
  double value = 1;
  bool bounded = false;
};

// σr/σs. A source that hardly moves has no deviations worth magnifying.
Gain gain_of(double source_spread, double reference_spread, const StyleTransferParams& params) {
  if (params.transfer == TransferredPart::mean || source_spread < 0.001) return {};
  const double gain = reference_spread / source_spread;
  if (params.max_gain > 0 && gain > params.max_gain) return {params.max_gain, true};
  return {gain, false};
}

// Eq. 4 and, on an Euler DOF, eq. 5: x′ = μr + (σr/σs)(x − μs).
struct Linear {
  double source_mean, target_mean, gain;
  double operator()(double x) const { return target_mean + gain * (x - source_mean); }
};
Linear linear(double source_mean, double source_spread, double reference_mean, double reference_spread,
              const StyleTransferParams& params) {
  const double target = params.transfer == TransferredPart::spread ? source_mean : reference_mean;
  return {source_mean, target, gain_of(source_spread, reference_spread, params).value};
}

// The joint of `style` and of `own` that belong to a joint of the motion.
struct Source {
  const JointStats* style = nullptr;
  const JointStats* own = nullptr;
};

Skeleton skeleton_of(const Stats& stats) {
  Skeleton skeleton;
  for (std::size_t j = 0; j < stats.joints.size(); ++j) {
    skeleton.joints.push_back({stats.joints[j].joint, stats.parents[j], stats.offsets[j], stats.rests[j]});
  }
  return skeleton;
}

void check_space(const Stats& stats, StyleSpace space, const char* port) {
  if (stats.space == name_of(space)) return;
  throw Failure(error("space-mismatch",
                      fmt::format("the statistics at {} are in {} space, and the transfer is in {} space",
                                  port, stats.space, name_of(space)))
                    .at_port(port)
                    .hinting("give QuatStats and StyleTransfer the same space"));
}

void check_order(const JointStats& stats, const std::string& order, const std::string& joint,
                 const char* port) {
  if (stats.order == order) return;
  throw Failure(error("euler-order-mismatch",
                      fmt::format("{} turns in Euler order {} here and {} is measured in order {}", joint,
                                  order, stats.joint, stats.order))
                    .at_port(port)
                    .at_joint(joint)
                    .hinting("use space quaternion, which knows no order, or leave the joint out of joints"));
}

// `chosen`: empty = all. A transfer onto none of them would only be a copy.
void check_any_partner(const Skeleton& measured, const Skeleton& skeleton, const std::vector<int>& partner,
                       const std::vector<bool>& chosen) {
  std::vector<std::string> alone, others;
  for (std::size_t j = 0; j < partner.size(); ++j) {
    if (!chosen.empty() && !chosen[j]) continue;
    if (partner[j] >= 0) return;
    alone.push_back(skeleton.joints[j].name);
  }
  for (const Joint& joint : measured.joints) others.push_back(joint.name);
  throw Failure(
      error("no-partner", fmt::format("no joint has a partner in the style, so there is nothing to "
                                      "transfer: the motion has {}, the style {}",
                                      listed(alone), listed(others)))
          .at_port("style")
          .hinting("put a Retarget node onto this motion's skeleton before the style's QuatStats, or "
                   "name partners with the parameter map, as FROM=TO"));
}

// Which statistics each joint is changed by; none for joints that aren't chosen or have no partner.
std::vector<Source> sources_of(const Motion& motion, const Stats& style, const Stats& own,
                               const StyleTransferParams& params, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  const Skeleton measured = skeleton_of(style);
  const std::vector<int> partner = partners(measured, skeleton, params.map);
  check_any_partner(measured, skeleton, partner, params.joints);
  Alone told;
  warn_about_partners(measured, skeleton, partner, told);
  for (Diagnostic& one : told.reported) {
    if (one.code == "rest-pose-differs") one.hint = "put a Retarget node before the style's QuatStats";
    work.report(std::move(one));
  }

  std::vector<Source> sources(skeleton.joints.size());
  for (std::size_t j = 0; j < sources.size(); ++j) {
    if (partner[j] < 0 || (!params.joints.empty() && !params.joints[j])) continue;
    const std::string& name = skeleton.joints[j].name;
    if ((j == 0) != (partner[j] == 0)) {
      throw Failure(error("bad-map", fmt::format("{} is mapped to {}: a root goes with a root only", name,
                                                 style.joints[static_cast<std::size_t>(partner[j])].joint))
                        .at_param("map")
                        .at_joint(name)
                        .hinting("a root's statistics leave its heading out; take this entry out of map"));
    }
    const JointStats* from = &style.joints[static_cast<std::size_t>(partner[j])];
    const auto mine = std::find_if(own.joints.begin(), own.joints.end(),
                                   [&](const JointStats& stats) { return stats.joint == name; });
    if (!from->chosen || mine == own.joints.end() || !mine->chosen) continue;
    if (params.space == StyleSpace::euler) {
      const std::string order = euler_order_of(motion, static_cast<int>(j));
      check_order(*from, order, name, "style");
      check_order(*mine, order, name, "own");
    }
    sources[j] = {from, &*mine};
  }
  return sources;
}

// Eq. 7: q′ = q q̄s⁻¹ q̄r keeps the deviation q q̄⁻¹ in the parent's frame; Slerp(σr/σs, q̄r, q′) scales it. Both
// at once: (q q̄s⁻¹)^(σr/σs) q̄r.
JointGain transfer_quaternions(const ConstQuatTrack& from, const Source& source,
                               const StyleTransferParams& params, const QuatTrack& to) {
  const Gain gain = gain_of(source.own->spread, source.style->spread, params);
  const Quat target = params.transfer == TransferredPart::spread ? source.own->mean : source.style->mean;
  const Quat back = inverse(source.own->mean);
  JointGain out;
  out.gain = gain.value;
  out.bounded = gain.bounded;
  double largest = 0;
  for (std::size_t t = 0; t < from.x.size(); ++t) {
    Quat deviation = from[t] * back;
    if (deviation.w < 0) deviation = -deviation;
    // The log of the deviation, scaled, and its exponential: only the length of the vector part changes.
    const double sine2 = deviation.x * deviation.x + deviation.y * deviation.y + deviation.z * deviation.z;
    const double sine = std::sqrt(sine2);
    const double angle = sine * angle_over_sine(sine2, deviation.w);
    const SinCos scaled = sin_cos(gain.value * angle);
    const double size = sine > 1e-9 ? scaled.sin / sine : gain.value;
    if (angle > largest && (params.weights.empty() || params.weights[t] != 0)) {
      largest = angle;
      out.frame = t;
    }
    to.set(t,
           normalized(Quat{size * deviation.x, size * deviation.y, size * deviation.z, scaled.cos} * target));
  }
  out.largest_turn = 2 * largest;
  return out;
}

// Eq. 5, the linear transfer that jerks where the angles turn fast [Wu Fig. 2].
void transfer_angles(const ConstQuatTrack& from, const Source& source, const StyleTransferParams& params,
                     const QuatTrack& to) {
  const auto channels = euler_channels(from, source.own->order);
  std::array<Linear, 3> change{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    change[axis] = linear(source.own->euler_mean[axis], source.own->euler_spread[axis],
                          source.style->euler_mean[axis], source.style->euler_spread[axis], params);
  }
  for (std::size_t t = 0; t < from.x.size(); ++t) {
    std::array<double, 3> angles{};
    for (std::size_t axis = 0; axis < 3; ++axis) angles[axis] = change[axis](channels[axis][t]);
    to.set(t, from_euler(source.own->order, angles.data()));
  }
}

JointGain transfer_joint(const ConstQuatTrack& from, const Source& source, const StyleTransferParams& params,
                         const QuatTrack& to) {
  JointGain gain;
  if (params.space == StyleSpace::quaternion) {
    gain = transfer_quaternions(from, source, params, to);
  } else {
    transfer_angles(from, source, params, to);
  }
  make_continuous(to.x, to.y, to.z, to.w);
  return gain;
}

double weight_at(const StyleTransferParams& params, std::size_t frame) {
  return params.weights.empty() ? 1.0 : params.weights[frame];
}

// ρ at full strength. The twist about up that it gets is taken out again, so that the heading stays the
// source's (ρ itself has one only where the heading was bridged). Half of it is taken out on either side: the
// lean, x and z of the quaternion, then stays put, and with it the mean. All of it on the left would turn the
// lean, and means move by up to 1.4° between CMU walks and dances; so they stay within 0.05°.
JointGain transfer_rho(EncodedRoot& root, const Skeleton& skeleton, const Source& source,
                       const StyleTransferParams& params) {
  const std::vector<double> from = as_channels(root.rho);
  std::vector<double> to(from.size());
  const std::size_t n = root.rho.size();
  const QuatTrack track = track_of(to);
  const JointGain gain = transfer_joint(track_of(from), source, params, track);
  const Quat rest = skeleton.above * skeleton.joints.front().rest;
  const Quat unrest = inverse(rest);
  for (std::size_t t = 0; t < n; ++t) {
    const Quat q = track[t];
    const double gained = heading_of(q * unrest) - heading_of(root.rho[t] * unrest);
    const Quat half = about_y(-0.5 * gained);
    const Quat stripped = half * (q * unrest) * half * rest;
    root.rho[t] = t == 0 ? stripped : nearer(stripped, root.rho[t - 1]);
  }
  return gain;
}

// Eq. 4 on the path, but for travel that feet set. Lengths of the reference are brought to the source's size
// by their legs.
void transfer_path(EncodedRoot& root, const Motion& motion, const Stats& style, const Stats& own,
                   const StyleTransferParams& params) {
  const double leg = leg_length(motion.skeleton());
  const double scale = leg > 0 && style.leg_length > 0 ? leg / style.leg_length : 1.0;
  const auto change = [&](std::size_t axis, double size, std::vector<double>& values) {
    const Linear eq4 = linear(own.root_mean[axis], own.root_spread[axis], size * style.root_mean[axis],
                              size * style.root_spread[axis], params);
    for (double& value : values) value = eq4(value);
  };
  const bool travels = params.root == TransferredRoot::both || params.root == TransferredRoot::travel;
  if (travels && params.travel == TravelKind::printed) {
    change(0, scale, root.d_x);
    change(1, scale, root.d_z);
  }
  if (params.root == TransferredRoot::both || params.root == TransferredRoot::height)
    change(2, scale, root.height);
  if (params.heading == HeadingKind::transfer) change(3, 1.0, root.d_heading);
}

void decode(const EncodedRoot& root, const StyleTransferParams& params, Motion& motion) {
  if (params.heading == HeadingKind::transfer) {
    decode_root(root, motion);
  } else {
    decode_root_keeping_heading(root, motion);
  }
}

// `changed` has its joints at full strength and travels as the source does. In a motion that comes out of
// TimeWarp the root goes on while feet are held, so its factor is that of the sweep of its feet.
double factor_for_planted_feet(const Motion& motion, const Motion& changed, const StyleTransferParams& params,
                               Work& work) {
  std::vector<bool> counted;
  for (double weight : params.weights) counted.push_back(weight != 0);
  const bool holds = frames_shown(motion).size() < motion.frames();
  std::optional<double> factor;
  if (!find_legs(motion.skeleton()).empty()) {
    const Contacts contacts = plants_of(motion, work);
    const bool plants = std::any_of(contacts.points.begin(), contacts.points.end(),
                                    [](const FootPoint& point) { return !runs_of(point.planted).empty(); });
    if (plants && holds) factor = sweep_factor(motion, changed, contacts, counted, work);
    if (plants && !holds) factor = travel_factor(changed, contacts, counted, work);
  }
  if (!factor) {
    work.report(warning("no-plants", "no planted feet to set the speed of travel by; it stays as it is")
                    .at_param("travel")
                    .hinting("set travel to printed for the reference's speed"));
    return 1;
  }
  const char* why = holds ? "as the steps of its feet became longer or shorter, in frames that a warp holds"
                          : "so that planted feet slide least";
  work.report(info("travel-factor", fmt::format("travel is {:.3f} times the motion's own, {}", *factor, why))
                  .at_param("travel"));
  return *factor;
}

void blend(std::vector<double>& values, const std::vector<double>& from, double factor,
           const StyleTransferParams& params) {
  for (std::size_t t = 0; t < values.size(); ++t) {
    const double weight = weight_at(params, t);
    values[t] = weight == 1 ? factor * values[t] : from[t] + weight * (factor * values[t] - from[t]);
  }
}

// The root's rotation, travel and height. `changed` has all other joints at full strength, for the feet.
JointGain transfer_root(const Motion& motion, const EncodedRoot& source, const Stats& style, const Stats& own,
                        const Source& stats, const StyleTransferParams& params, Motion& changed,
                        double& travel, Work& work) {
  EncodedRoot root = source;
  const JointGain gain = transfer_rho(root, motion.skeleton(), stats, params);
  transfer_path(root, motion, style, own, params);

  const bool travels = params.root == TransferredRoot::both || params.root == TransferredRoot::travel;
  const bool turns = params.heading == HeadingKind::transfer;
  if (travels && params.travel == TravelKind::feet && motion.frames() > 1) {
    decode(root, params, changed);
    travel = factor_for_planted_feet(motion, changed, params, work);
  }
  blend(root.d_x, source.d_x, travel, params);
  blend(root.d_z, source.d_z, travel, params);
  blend(root.height, source.height, 1, params);
  blend(root.d_heading, source.d_heading, 1, params);
  for (std::size_t t = 0; t < root.rho.size(); ++t) {
    const double weight = weight_at(params, t);
    if (weight != 1) root.rho[t] = slerp(weight, source.rho[t], root.rho[t]);
  }
  const bool rises = params.root == TransferredRoot::both || params.root == TransferredRoot::height;
  if (!travels && !rises && !turns) {
    const Quat below = inverse(motion.skeleton().above);
    const QuatTrack to = changed.rotation(0);
    for (std::size_t t = 0; t < root.rho.size(); ++t)
      to.set(t, below * about_y(root.heading[t]) * root.rho[t]);
    return gain;
  }
  decode(root, params, changed);
  // What isn't transferred stays to the last bit.
  if (motion.translates(0)) {
    const ConstVec3Track from = motion.translation(0);
    const Vec3Track to = changed.translation(0);
    const bool upright = motion.skeleton().above == Quat{};
    if (!travels && !turns && upright) {
      std::copy(from.x.begin(), from.x.end(), to.x.begin());
      std::copy(from.z.begin(), from.z.end(), to.z.begin());
    }
    if (!rises && upright) std::copy(from.y.begin(), from.y.end(), to.y.begin());
  }
  return gain;
}

void report_gains(const std::vector<JointGain>& gains, const Skeleton& skeleton, double max_gain,
                  Work& work) {
  std::string bounded;
  for (const JointGain& gain : gains) {
    const std::string& name = skeleton.joints[static_cast<std::size_t>(gain.joint)].name;
    if (gain.bounded) bounded += (bounded.empty() ? "" : ", ") + name;
    const double reach = gain.gain * gain.largest_turn;
    // A gain of 1 turns deviations as they are, however far they go.
    if (reach < fold_limit || gain.gain == 1) continue;
    const char* what =
        reach < pi ? "comes near the half-turn where rotations fold over" : "folds over past a half-turn";
    work.report(
        warning("fold-over",
                fmt::format("{} {}: gain {:.3g} takes its {:.1f}° from the mean in frame {} to {:.0f}°", name,
                            what, gain.gain, gain.largest_turn * degrees_per_radian, gain.frame,
                            reach * degrees_per_radian))
            .at_joint(name)
            .at_frame(static_cast<std::int64_t>(gain.frame))
            .hinting("set max_gain lower, or leave the joint out of joints"));
  }
  if (!bounded.empty()) {
    work.report(info("gain-bounded",
                     fmt::format("the reference moves these joints over {:g} times as much, and max_gain "
                                 "holds them to that: {}",
                                 max_gain, bounded))
                    .at_param("max_gain"));
  }
}

}  // namespace

StyleTransferResult style_transfer(const Motion& motion, const Stats& style, const Stats* own,
                                   const StyleTransferParams& params, Work& work) {
  check_space(style, params.space, "style");
  if (own) check_space(*own, params.space, "own");
  const EncodedRoot root = encode_root(motion, work);
  std::optional<Stats> measured;
  if (!own) {
    QuatStatsParams settings;
    settings.mean = style.mean_kind == name_of(MeanKind::slerp) ? MeanKind::slerp : MeanKind::karcher;
    settings.space = params.space;
    settings.joints = params.joints;
    measured = quat_stats(motion, root, settings, work);
    own = &*measured;
  }
  const std::vector<Source> sources = sources_of(motion, style, *own, params, work);
  if (!params.weights.empty() &&
      std::all_of(params.weights.begin(), params.weights.end(), [](double weight) { return weight == 0; })) {
    StyleTransferResult unchanged;
    unchanged.motion = motion;
    return unchanged;
  }

  const bool moves_root = sources.front().style &&
                          (params.root != TransferredRoot::none || params.heading == HeadingKind::transfer);
  Motion changed = moves_root && !motion.translates(0) ? motion.with_translation(0) : motion;
  std::vector<JointGain> gains(sources.size());
  work.parallel(sources.size() - 1, 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first + 1; j < last + 1; ++j) {
      work.check();
      if (!sources[j].style) continue;
      const int joint = static_cast<int>(j);
      gains[j] = transfer_joint(motion.rotation(joint), sources[j], params, changed.rotation(joint));
    }
  });

  StyleTransferResult result;
  if (sources.front().style) {
    gains.front() = transfer_root(motion, root, style, *own, sources.front(), params, changed,
                                  result.travel_factor, work);
  }
  for (std::size_t j = 0; j < sources.size(); ++j) {
    if (!sources[j].style) continue;
    const int joint = static_cast<int>(j);
    const ConstQuatTrack from = motion.rotation(joint);
    const QuatTrack to = changed.rotation(joint);
    for (std::size_t t = 0; j > 0 && t < params.weights.size(); ++t) {
      const double weight = params.weights[t];
      if (weight == 0) {
        to.set(t, from[t]);
      } else if (weight != 1) {
        to.set(t, slerp(weight, from[t], to[t]));
      }
    }
    make_continuous(to.x, to.y, to.z, to.w);
    if (params.space == StyleSpace::euler) continue;
    gains[j].joint = joint;
    result.gains.push_back(gains[j]);
  }
  report_gains(result.gains, motion.skeleton(), params.max_gain, work);
  result.motion = std::move(changed);
  return result;
}

}  // namespace kinegraph
