#include "nodes/gait/gait.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "nodes/gait/gait_body.h"
#include "nodes/gait/gait_foot.h"
#include "nodes/gait/gait_leg.h"
#include "nodes/gait/gait_skeleton.h"
#include "nodes/gait/gait_styles.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

GaitStyle adjusted_style(const GaitParams& params) {
  GaitStyle style = gait_style(params.gait);
  style.bob *= params.bounce;
  const double lean = params.lean / degrees_per_radian;
  style.lean += lean;
  style.tilt += 0.5 * lean;
  style.head_pitch += 0.3 * lean;
  style.crouch += params.crouch;
  style.arm_swing *= params.arm_swing;
  style.elbow_swing *= std::min(params.arm_swing, 1.5);
  style.limp = std::min(1.0, style.limp + params.limp);
  return style;
}

// The sore right leg stands for a shorter time, lands flat and pushes little; the left one makes up for it.
GaitStyle one_foot(GaitStyle style, bool left) {
  const double limp = style.limp;
  if (left) {
    style.duty += 0.05 * limp;
    style.flat_to += 0.06 * limp;
    style.lift += 0.012 * limp;
    return style;
  }
  style.duty -= 0.06 * limp;
  style.flat_to -= 0.03 * limp;
  style.flat_from *= 1 - 0.45 * limp;
  style.landing *= 1 - 0.55 * limp;
  style.push_off *= 1 - 0.3 * limp;
  style.toe_out += 0.15 * limp;
  style.circle += 0.03 * limp;
  return style;
}

// A whole gait: what is where at any time.
class Walker {
 public:
  Walker(const GaitParams& params, const GaitStyle& style, Work& work)
      : style_(style), seed_(params.seed), pace_(resolved_pace(params)), period_(2 / pace_.cadence) {
    seconds_ = params.seconds;
    settle_pelvis(work);
  }

  BodyPose body(double t) const {
    BodyPose pose = body_pose(style_, t / period_, t, pace_.speed, seed_);
    pose.hips.y += height_;
    return pose;
  }
  GaitFoot foot(bool left) const {
    const double start = left ? 0 : (0.5 + 0.05 * style_.limp) * period_;
    return GaitFoot(one_foot(style_, left), shape_, left, {period_, pace_.speed, start, lead_, seed_});
  }
  const GaitBody& shape() const { return shape_; }

 private:
  struct Line {
    double across2, ahead, rise,
        room;  // hip to ankle: sideways², forwards, hip's wave over the ankle; reach²
  };

  // Puts the prints so far ahead of the pelvis that it can be highest, and the pelvis as high as the longer
  // leg allows.
  void settle_pelvis(Work& work) {
    constexpr double fine = 160;  // samples a cycle
    const double reach = style_.reach * shape_.leg();
    const double span = seed_ == 0 ? 2 * period_ : std::max(seconds_, 2 * period_);
    std::vector<Line> lines;
    for (bool left : {true, false}) {
      const GaitFoot track = foot(left);
      for (double t = 0; t < span; t += period_ / fine) {
        if (lines.size() % 64 == 0) work.check();
        const BodyPose pose = body_pose(style_, t / period_, t, pace_.speed, seed_);
        const Vec3 hip = pose.hips + rotate(pose.pelvis, hip_offset(left));
        const Vec3 gap = track.at(t).ankle - hip;
        lines.push_back({gap.x * gap.x, gap.z, gap.y, reach * reach});
      }
    }
    // The height that all lines allow is concave in the lead: the search closes in on the one best.
    auto allowed = [&](double lead) {
      double height = std::numeric_limits<double>::infinity();
      for (const Line& line : lines) {
        const double ahead = line.ahead + lead;
        const double left_over = line.room - line.across2 - ahead * ahead;
        height = std::min(height, left_over > 0 ? line.rise + std::sqrt(left_over) : line.rise + left_over);
      }
      return height;
    };
    double low = -0.6, high = 0.6;
    for (int i = 0; i < 60; ++i) {
      work.check();
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (allowed(a) < allowed(b) ? low : high) = allowed(a) < allowed(b) ? a : b;
    }
    lead_ = (low + high) / 2;
    const double straight = shape_.ankle_height + shape_.leg() + shape_.hip_drop;
    height_ = allowed(lead_) - style_.crouch * shape_.leg();
    if (height_ < 0.62 * straight) {
      throw Failure(
          error("gait-out-of-reach",
                fmt::format(
                    "the pelvis would have to be at {:.2f} m, under {:.2f} m: steps of {:.2f} m at {:.2f} "
                    "steps/s are too long for a leg of {:.2f} m",
                    height_, 0.62 * straight, pace_.stride, pace_.cadence, shape_.leg()))
              .at_param("stride")
              .hinting(
                  "give a shorter stride or less speed, a higher cadence, less bounce or crouch, or choose "
                  "the gait run"));
    }
  }
  Vec3 hip_offset(bool left) const {
    return {left ? shape_.hip_half_width : -shape_.hip_half_width, -shape_.hip_drop, 0};
  }

  GaitStyle style_;
  GaitBody shape_;
  std::uint64_t seed_;
  Pace pace_;
  double period_, seconds_ = 0;
  double lead_ = 0, height_ = 0;
};

struct LocalPose {
  Vec3 root;
  std::array<Quat, gait_joint_count> rotations{};
};

LocalPose local_pose(const Walker& walker, const std::array<GaitFoot, 2>& feet, double t) {
  const GaitBody& shape = walker.shape();
  const BodyPose body = walker.body(t);
  LocalPose pose;
  pose.root = body.hips;
  pose.rotations[hips] = body.pelvis;
  pose.rotations[spine] = body.spine;
  pose.rotations[spine1] = body.spine1;
  pose.rotations[neck] = body.neck;
  pose.rotations[head] = body.head;
  for (int side = 0; side < 2; ++side) {
    const int arm = side == 0 ? left_shoulder : right_shoulder;
    pose.rotations[arm] = body.arms[side].shoulder;
    pose.rotations[arm + 1] = body.arms[side].arm;
    pose.rotations[arm + 2] = body.arms[side].fore_arm;
    pose.rotations[arm + 3] = body.arms[side].hand;

    const int leg = side == 0 ? left_up_leg : right_up_leg;
    const FootState state = feet[side].at(t);
    const Vec3 hip =
        body.hips + rotate(body.pelvis, {(side == 0 ? 1 : -1) * shape.hip_half_width, -shape.hip_drop, 0});
    // The knee points half way between where the pelvis and the foot look.
    const Quat facing = slerp(0.6, about_y(heading_of(body.pelvis)), about_y(state.yaw));
    const LegPose bent = reach_ankle(hip, state.ankle, shape.thigh, shape.shank, rotate(facing, {1, 0, 0}));
    pose.rotations[leg] = inverse(body.pelvis) * bent.thigh;
    pose.rotations[leg + 1] = inverse(bent.thigh) * bent.shank;
    pose.rotations[leg + 2] = inverse(bent.shank) * feet[side].orientation(state);
    pose.rotations[leg + 3] = axis_angle({1, 0, 0}, -state.toe_bend);
  }
  return pose;
}

}  // namespace

Pace resolved_pace(const GaitParams& params) {
  const GaitStyle& style = gait_style(params.gait);
  const double own = style.stride / style.cadence;
  const double speed = params.speed, cadence = params.cadence, stride = params.stride;
  const int given = (speed > 0) + (cadence > 0) + (stride > 0);
  if (given == 3) {
    throw Failure(error("gait-overdetermined",
                        fmt::format("speed {:g}, cadence {:g} and stride {:g} are all given, but "
                                    "speed is cadence times stride",
                                    speed, cadence, stride))
                      .at_param("stride")
                      .hinting("set one of speed, cadence and stride to 0"));
  }
  if (speed > 0 && cadence > 0) return {speed, cadence, speed / cadence};
  if (speed > 0 && stride > 0) return {speed, speed / stride, stride};
  if (cadence > 0 && stride > 0) return {cadence * stride, cadence, stride};
  double steps = style.cadence;
  if (speed > 0) steps = std::sqrt(speed / own);
  if (cadence > 0) steps = cadence;
  if (stride > 0) steps = stride / own;
  return {steps * steps * own, steps, steps * own};
}

Motion make_gait(const GaitParams& params, Work& work) {
  const Walker walker(params, adjusted_style(params), work);
  const auto skeleton = gait_skeleton(walker.shape());
  const auto frames = static_cast<std::size_t>(std::floor(params.seconds * params.fps + 0.5));
  std::vector<bool> translates(skeleton->joints.size(), false);
  translates[hips] = true;
  Motion motion(skeleton, gait_source_facts(*skeleton, params.fps), params.fps,
                std::max<std::size_t>(frames, 1), std::move(translates));
  const std::array<GaitFoot, 2> feet{walker.foot(true), walker.foot(false)};
  work.parallel(motion.frames(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (t % 64 == 0) work.check();
      const LocalPose pose = local_pose(walker, feet, static_cast<double>(t) / params.fps);
      motion.translation(hips).set(t, pose.root);
      for (int joint = 0; joint < gait_joint_count; ++joint)
        motion.rotation(joint).set(t, pose.rotations[joint]);
    }
  });
  for (int joint = 0; joint < gait_joint_count; ++joint) {
    work.check();
    const QuatTrack track = motion.rotation(joint);
    make_continuous(track.x, track.y, track.z, track.w);
  }
  work.progress(1);
  return motion;
}

}  // namespace kinegraph
