// The ports that Load and Export have in common: what a file can hold. One line a port.
#pragma once
#include <string_view>
#include <vector>

namespace kinegraph {

struct FilePort {
  std::string_view name;  // "motion"
  std::string_view type;  // the port type, registered in all_nodes.cpp
  std::string_view what;  // "The motion"
};
inline const std::vector<FilePort>& file_ports() {
  static const std::vector<FilePort> ports = {
      {"motion", "Motion", "A motion, in metres and Y up."},
      {"points", "Points", "Labelled points over time, in metres and Y up."},
      {"character", "Character", "A skinned mesh on its skeleton."},
      {"stats", "Stats", "The statistics that carry a motion's style."},
      {"components", "Components", "Independent components of one or several clips."},
      {"warp", "Warp", "A time warp between two motions."},
      {"contacts", "Contacts", "When which part of a foot is planted."},
      {"metrics", "Metrics", "Named numbers."},
  };
  return ports;
}

}  // namespace kinegraph
