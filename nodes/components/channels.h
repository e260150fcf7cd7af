// Poses as columns of numbers and back: the representations in which motions are decomposed [Shapiro §3.2,
// Cao §3]. The root's position and, with `heading`, R_y(-ψ) are taken out of every frame first; the way back
// takes them from a base motion. Without taking the heading out, differences of walking direction would swamp
// the style.
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
// What is taken out of every frame of Points, and put back later.
enum class Stabilise { none, centroid, rigid };
const char* name_of(Representation representation);
Representation representation_from(const std::string& name);

// Everything that the numbers depend on besides the clip itself; fixed when components are made.
struct ChannelSpace {
  Representation representation = Representation::points;
  bool of_motions = true;  // false: of Points
  bool heading = true;     // R_y(-ψ) is taken out of motions
  std::shared_ptr<const Skeleton>
      skeleton;                     // the first motion's: all take its bone lengths; empty for Points
  std::vector<int> joints;          // of the skeleton, whose channels are used, rising; empty for Points
  std::vector<std::string> labels;  // of those joints, or of the points
  std::vector<Quat>
      reference;  // per entry of `joints`: q̄ (logarithm), or what signs are turned to (quaternions)
  std::vector<std::string> orders;  // per entry of `joints`: Euler axes, "ZYX"
  std::vector<std::string> map;  // "FROM=TO" for motions with other joint names; empty: equal or known names
  Stabilise stabilise = Stabilise::none;  // Points only
  std::vector<std::string> stable;        // the labels by which they are stabilised
  std::vector<Vec3> shape;                // rigid: where those lie in the first frame, about their centroid

  std::size_t per_label() const { return representation == Representation::quaternions ? 4 : 3; }
  std::size_t channels() const { return labels.size() * per_label(); }
  std::vector<std::string> channel_names() const;  // "LeftArm.x"
};

// A space for these motions (the first gives skeleton and Euler orders; the references are means over all
// frames). Motions need the chosen joints by name or by `map`; throws Failure ("joint-missing") naming the
// first that lacks one.
ChannelSpace space_of_motions(Representation representation,
                              const std::vector<std::shared_ptr<const Motion>>& motions,
                              const std::vector<bool>& chosen, bool heading,
                              const std::vector<std::string>& map, Work& work);
// `chosen`: of the first clip's labels. With Stabilise::none those are the channels; else all labels are, and
// the chosen ones say what is taken out. Throws Failure: "label-missing", "gaps" (naming label and frames),
// "too-few-labels".
ChannelSpace space_of_points(const std::vector<std::shared_ptr<const Points>>& points, Stabilise stabilise,
                             const std::vector<bool>& chosen);

// For each joint of the space's skeleton the motion's, or -1.
std::vector<int> joints_of(const ChannelSpace& space, const Skeleton& skeleton);

// The numbers: channels() rows, a column a frame. Radians, metres. A link's direction is the motion's own,
// its length the first motion's. `before`: the last column of the motion before, to shift Euler angles by
// full turns at a seam; may be empty. Throws as the spaces above where the clip lacks what is needed.
Rows channels_of(const ChannelSpace& space, const Motion& motion, const std::vector<double>& before,
                 Work& work);
// Of Euler angles the first column of that, on which, beside the motion, all the others depend. The motion
// has frames and all joints; `before` isn't empty.
std::vector<double> first_angles_of(const ChannelSpace& space, const Motion& motion,
                                    const std::vector<double>& before, Work& work);
Rows channels_of(const ChannelSpace& space, const Points& points, Work& work);
// Of points that stand on a motion's path, as points_from_channels puts them there; the space is of positions
// of motions. Throws as space_of_points where the clip lacks what is needed.
Rows channels_on_path(const ChannelSpace& space, const Points& points, const Motion& base, Work& work);

struct WayBack {
  bool limbs = true;  // bones keep the base's rest lengths, only directions are taken from the points
  bool root = true;   // path and heading of the base; false: on the spot (motions), stabilised (Points)
};
// The way back. The base gives path, heading, height, rate, source facts and what the channels don't say
// (joints that aren't chosen, turns about single links); it has as many frames as `channels` columns.
Motion motion_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base,
                            const WayBack& way, Work& work);
// Positions as the numbers say, put on the base's path (points representation; with limbs, from the root
// outwards, child = parent + rest length × direction), else the joints of motion_from_channels.
Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Motion& base,
                            const WayBack& way, Work& work);
Points points_from_channels(const ChannelSpace& space, const Rows& channels, const Points& base,
                            const WayBack& way);

}  // namespace kinegraph
