// Small BVHs for tests.
#pragma once
#include <string>

namespace kinegraph {

// Hips and a Leg with an End Site; nine channels.
inline std::string small_bvh(const std::string& motion,
                             const std::string& root_channels =
                                 "6 Xposition Yposition Zposition "
                                 "Zrotation Yrotation Xrotation",
                             const std::string& leg_channels = "3 Zrotation Yrotation Xrotation") {
  return "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 0 0\n\tCHANNELS " + root_channels +
         "\n\tJOINT Leg\n\t{\n\t\tOFFSET 0 -0.8 0.1\n\t\tCHANNELS " + leg_channels +
         "\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -0.9 0\n\t\t}\n\t}\n}\nMOTION\n" + motion;
}
inline std::string two_frames() {
  return "Frames: 2\nFrame Time: 0.04\n1 2 3 10 20 30 -5 6 7\n1.5 2 3 11 21 31 -6 7 8\n";
}

}  // namespace kinegraph
