// A motion made ready for drawing: where everything is at every frame, in floats, frame after frame. Made
// once a value on another thread; drawing only picks a frame.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "graph/value.h"
#include "graph/work.h"
#include "nodes/motion/contacts.h"

namespace kinegraph {

struct ShownMotion {
  enum class Side : unsigned char { middle, left, right };
  struct Point3 {
    float x = 0, y = 0, z = 0;
  };
  // A bone leads from one point to another; its thickness is that of a body of this size.
  struct Bone {
    int from = 0, to = 0;
    float radius = 0.03f;  // m
    Side side = Side::middle;
    float rest_length = 0;  // m
    int joint = -1;         // whose link it is: the joint `to` is, -1 for an End Site
    bool head = false;      // drawn as a head: thick, and off the neck
    float beyond = 0;       // m: a head whose tip isn't known goes on past `to` by so much
  };

  ValuePtr value;  // what it was made from, kept alive
  double fps = 120;
  int frames = 0;
  bool markers = false;            // Points: balls without bones, but for their links
  std::vector<std::string> names;  // of the points: joints, then End Sites (""), or labels
  std::vector<int> parents;        // of joints; -1 elsewhere
  std::vector<Side> sides;         // of the points
  std::vector<Bone> bones;
  int points = 0;
  std::vector<Point3> positions;                  // frame * points + point; NaN where a marker is missing
  static constexpr float least_stretch = 0.002f;  // of which anything is seen
  // frame * bones + bone: length over rest length; empty where none changes as much.
  std::vector<float> stretch;
  double size = 1.7;                               // m, of the body, for thickness and the camera
  Point3 low, high;                                // box around all frames
  double floor = 0;                                // m
  Contacts contacts;                               // found in the motion; no points where it has no feet
  std::vector<std::vector<Point3>> contact_spots;  // of each contact point a frame

  const Point3& at(int frame, int point) const {
    return positions[static_cast<std::size_t>(frame) * static_cast<std::size_t>(points) +
                     static_cast<std::size_t>(point)];
  }
  Point3 root(int frame) const;  // of the root joint, or the middle of all markers
  int frame_at(double seconds) const;
};

// Of a Motion or Points; null for any other value, or one without frames.
std::shared_ptr<const ShownMotion> make_shown_motion(ValuePtr value, Work& work);

}  // namespace kinegraph
