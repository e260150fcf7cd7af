// A motion laid out as a BVH's channels: which joints have which, and each channel's numbers over time.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/write_options.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct BvhChannel {
  std::string name;                // "Xposition", "Zrotation"
  std::span<const double> values;  // one a frame, in the file's unit or degrees
};

struct BvhLayout {
  struct Joint {
    std::string name;
    int parent = -1;  // index into joints
    Vec3 offset;      // in the file's unit and axes
    std::vector<BvhChannel> channels;
    std::vector<Vec3> ends;
  };
  std::vector<Joint> joints;               // depth first, as the text has them
  std::vector<std::vector<double>> owned;  // what the channels look at, unless it is the source's own numbers
};

// The source's layout: channels, OFFSETs and End Sites as read, with position channels added where a
// translation varies and there were none, and rotation channels where there are too few to hold a turn
// ("channels-added" info). Without a source layout: the root has Xposition Yposition Zposition Zrotation
// Yrotation Xrotation, every other joint the last three. BVH's rest pose has no turns: where the skeleton's
// has (glTF), or something stands above the root, joints are turned so that the world positions are the same
// and the rest pose still is one. Angles are the source's own where they still give the rotation; else the
// solution nearest to the source's at that frame while the motion has as many frames, else nearest to the
// previous frame. `motion` must outlive the result.
BvhLayout bvh_layout(const Motion& motion, const WriteOptions& options, const LengthUnit& unit, Work& work);

}  // namespace kinegraph
