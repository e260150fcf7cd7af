#include "nodes/style/euler_channels.h"

#include <cstddef>

namespace kinegraph {

std::string euler_order_of(const Motion& motion, int joint) {
  const auto& bvh = motion.source().bvh;
  const auto at = static_cast<std::size_t>(joint);
  std::string order;
  if (at < bvh.size()) {
    for (const std::string& channel : bvh[at].channels) {
      if (channel.find("rotation") == std::string::npos || channel.empty()) continue;
      if (order.find(channel.front()) != std::string::npos) return "ZYX";
      order += channel.front();
    }
  }
  for (char axis : {'Z', 'Y', 'X'}) {
    if (order.find(axis) == std::string::npos) order += axis;
  }
  return order.size() == 3 ? order : "ZYX";
}

std::array<std::vector<double>, 3> euler_channels(const ConstQuatTrack& rotations, std::string_view order) {
  const std::size_t frames = rotations.x.size();
  std::array<std::vector<double>, 3> angles;
  for (auto& channel : angles) channel.resize(frames);
  std::array<double, 3> previous{};
  for (std::size_t t = 0; t < frames; ++t) {
    previous = to_euler(rotations[t], order, previous.data());
    for (std::size_t axis = 0; axis < 3; ++axis) angles[axis][t] = previous[axis];
  }
  return angles;
}

}  // namespace kinegraph
