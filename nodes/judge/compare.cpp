#include "nodes/judge/compare.h"

#include <algorithm>
#include <optional>

#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/metric_name.h"

namespace kinegraph {

namespace {

JointDifference difference_of(const Motion& a, const Motion& b, const WorldMotion& world_a,
                              const WorldMotion& world_b, int joint, int other, std::size_t frames) {
  JointDifference out;
  const Joint& mine = a.skeleton().joints[static_cast<std::size_t>(joint)];
  const Joint& theirs = b.skeleton().joints[static_cast<std::size_t>(other)];
  out.joint = mine.name;
  out.other = theirs.name;
  out.offset = norm(mine.offset - theirs.offset);
  const ConstVec3Track position_a = world_a.position(joint);
  const ConstVec3Track position_b = world_b.position(other);
  const ConstQuatTrack rotation_a = a.rotation(joint);
  const ConstQuatTrack rotation_b = b.rotation(other);
  for (std::size_t t = 0; t < frames; ++t) {
    const double distance = norm(position_a[t] - position_b[t]);
    const double angle = turn(rotation_a[t], rotation_b[t]) * degrees_per_radian;
    out.position_mean += distance;
    out.rotation_mean += angle;
    if (distance > out.position_max) {
      out.position_max = distance;
      out.position_frame = t;
    }
    if (angle > out.rotation_max) {
      out.rotation_max = angle;
      out.rotation_frame = t;
    }
  }
  if (frames > 0) {
    out.position_mean /= static_cast<double>(frames);
    out.rotation_mean /= static_cast<double>(frames);
  }
  return out;
}

bool same_values(const Motion& a, const Motion& b) {
  for (int j = 0; j < a.joints(); ++j) {
    if (a.skeleton().joints[static_cast<std::size_t>(j)].name !=
            b.skeleton().joints[static_cast<std::size_t>(j)].name ||
        a.skeleton().joints[static_cast<std::size_t>(j)].offset !=
            b.skeleton().joints[static_cast<std::size_t>(j)].offset) {
      return false;
    }
    const ConstQuatTrack p = a.rotation(j);
    const ConstQuatTrack q = b.rotation(j);
    for (std::size_t t = 0; t < a.frames(); ++t) {
      if (!(p[t] == q[t] || p[t] == -q[t]) || !(a.local_offset(j, t) == b.local_offset(j, t))) return false;
    }
  }
  return true;
}

}  // namespace

Comparison compare_motions(const Motion& a, const Motion& b, const std::vector<std::string>& map,
                           Work& work) {
  Comparison out;
  out.frames_a = a.frames();
  out.frames_b = b.frames();
  out.fps_a = a.fps();
  out.fps_b = b.fps();
  out.compared = std::min(a.frames(), b.frames());
  const std::vector<int> partner = partners(b.skeleton(), a.skeleton(), map);
  const WorldMotion world_a = world_motion(a, work);
  const WorldMotion world_b = world_motion(b, work);
  std::vector<bool> met(b.skeleton().joints.size());
  for (int j = 0; j < a.joints(); ++j) {
    work.check();
    const int other = partner[static_cast<std::size_t>(j)];
    if (other < 0) {
      out.only_a.push_back(a.skeleton().joints[static_cast<std::size_t>(j)].name);
      continue;
    }
    met[static_cast<std::size_t>(other)] = true;
    out.joints.push_back(difference_of(a, b, world_a, world_b, j, other, out.compared));
  }
  for (std::size_t j = 0; j < met.size(); ++j) {
    if (!met[j]) out.only_b.push_back(b.skeleton().joints[j].name);
  }
  for (const JointDifference& joint : out.joints) {
    out.position_mean += joint.position_mean;
    out.rotation_mean += joint.rotation_mean;
    out.position_max = std::max(out.position_max, joint.position_max);
    out.rotation_max = std::max(out.rotation_max, joint.rotation_max);
  }
  if (!out.joints.empty()) {
    out.position_mean /= static_cast<double>(out.joints.size());
    out.rotation_mean /= static_cast<double>(out.joints.size());
  }
  out.identical =
      a.joints() == b.joints() && a.frames() == b.frames() && a.fps() == b.fps() && same_values(a, b);
  return out;
}

Metrics metrics_of(const Comparison& comparison) {
  Metrics out;
  const bool some = comparison.compared > 0 && !comparison.joints.empty();
  const auto add = [&](std::string name, double value, const char* unit) {
    out.all.push_back({std::move(name), some ? std::optional<double>(value) : std::nullopt, unit});
  };
  add("difference.position_mean", comparison.position_mean, "m");
  add("difference.position_max", comparison.position_max, "m");
  add("difference.rotation_mean", comparison.rotation_mean, "deg");
  add("difference.rotation_max", comparison.rotation_max, "deg");
  const double frames = static_cast<double>(comparison.frames_b) - static_cast<double>(comparison.frames_a);
  const auto lonely = static_cast<double>(comparison.only_a.size() + comparison.only_b.size());
  out.all.push_back({"difference.frames", frames, "frames"});
  out.all.push_back({"difference.fps", comparison.fps_b - comparison.fps_a, "1/s"});
  out.all.push_back({"difference.joints", lonely, ""});
  for (const JointDifference& joint : comparison.joints) {
    add(joint_metric_name("difference.position_mean", joint.joint), joint.position_mean, "m");
    add(joint_metric_name("difference.position_max", joint.joint), joint.position_max, "m");
    add(joint_metric_name("difference.rotation_mean", joint.joint), joint.rotation_mean, "deg");
    add(joint_metric_name("difference.rotation_max", joint.joint), joint.rotation_max, "deg");
  }
  return out;
}

}  // namespace kinegraph
