// Poses as columns of numbers and back: the representations in which motions are decomposed [Shapiro §3.2, Cao §3].
// The root's position and, with `heading`, R_y(-ψ) are taken out of every frame first; the way back takes them from a base
// motion. Without taking the heading out, differences of walking direction would swamp the style.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/components/rows.h"
#include "nodes/motion/motion.h"
#include "nodes/motion/points.h"

namespace kinegraph {

enum class Representation { points, quaternions, euler, logarithm };
const char* name_of(Representation representation);
Representation representation_from(const std::string& name);

// Everything that the numbers depend on besides the motion itself; fixed when components are made.
struct ChannelSpace {
  Representation representation = Representation::points;
  bool of_motions = true;                    // false: of Points, taken as they are
  bool heading = true;                       // R_y(-ψ) is taken out
  std::shared_ptr<const Skeleton> skeleton;  // the first motion's: all take its bone lengths; empty for Points
  std::vector<int> joints;                   // of the skeleton, whose channels are used, rising; empty for Points
  std::vector<std::string> labels;           // of those joints, or of the points
  std::vector<Quat> reference;               // per entry of `joints`: q̄ (logarithm), or what signs are turned to (quaternions)
  std::vector<std::string> orders;           // per entry of `joints`: Euler axes, "ZYX"

  std::size_t per_label() const { return representation == Representation::quaternions ? 4 : 3; }
  std::size_t channels() const { return labels.size() * per_label(); }
  std::vector<std::string> channel_names() const;  // "LeftArm.x"
};

// A space for these motions (the first gives skeleton and Euler orders; the references are means over all frames).
// Motions need the chosen joints by name; throws Failure ("joint-missing") naming the first that lacks one.
ChannelSpace space_of_motions(Representation representation, const std::vector<std::shared_ptr<const Motion>>& motions,
                              const std::vector<bool>& chosen, bool heading, Work& work);
ChannelSpace space_of_points(const std::vector<std::shared_ptr<const Points>>& points);

// The numbers: channels() rows of motion.frames() columns. Radians, metres.
// `before`: the last column of the motion before, to shift Euler angles by full turns at a seam; may be empty.
Rows channels_of(const ChannelSpace& space, const Motion& motion, const std::vector<double>& before, Work& work);
Rows channels_of(const ChannelSpace& space, const Points& points, Work& work);

// The way back. The base gives path, heading, height, rate, source facts and what the channels don't say (joints that
// aren't chosen, turns about single links); it has as many frames as `channels` columns, and its joints are looked up by
// name. `limbs`: lengths are the skeleton's, only directions are taken from the points.
Motion motion_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base, bool limbs,
                            Work& work);
// Positions as the numbers say, put on the base's path (points representation), or by kinematics of the motion.
Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base, Work& work);
Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Points& base);

}  // namespace kinegraph
