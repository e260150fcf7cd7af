// How far a torso leans, and what a transfer of components makes of it.
#pragma once
#include <cmath>
#include <vector>

#include "nodes/components/component_edit.h"
#include "nodes/components/rebuild.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// Degrees by which root to lowerneck leans forwards of upright, mean over the frames; forwards is square to
// the line through the hips. Of motions with CMU's joint names.
inline double mean_pitch(const Motion& motion) {
  const WorldMotion world = world_motion(motion);
  const auto at = [&](const char* joint, std::size_t t) {
    return world.position(motion.skeleton().find(joint))[t];
  };
  double sum = 0;
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    const Vec3 across = at("lfemur", t) - at("rfemur", t), torso = at("lowerneck", t) - at("root", t);
    const double forwards =
        (torso.z * across.x - torso.x * across.z) / std::sqrt(across.x * across.x + across.z * across.z);
    sum += std::atan2(forwards, torso.y);
  }
  return sum / static_cast<double>(motion.frames()) * 180 / M_PI;
}

// Segment `to` with these components of segment `from`, as ComponentEdit gives it.
inline Motion transferred(const Components& components, const std::vector<int>& which, std::int64_t from,
                          std::int64_t to, Work& work) {
  edits::Transfer transfer;
  for (int component : which) transfer.components.push_back({component, ""});
  transfer.from = from;
  transfer.to = to;
  ComponentEditParams params;
  params.edits = {transfer};
  const ComponentEditResult result = edit_components(components, params, {}, work);
  return motion_of(result.components, result.channels, result.components.segments[result.segment], {}, work);
}

}  // namespace kinegraph
