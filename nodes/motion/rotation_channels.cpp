#include "nodes/motion/rotation_channels.h"

namespace kinegraph {

std::vector<double> as_channels(std::span<const Quat> rotations) {
  const std::size_t n = rotations.size();
  std::vector<double> channels(4 * n);
  const QuatTrack track = track_of(channels);
  for (std::size_t t = 0; t < n; ++t) track.set(t, rotations[t]);
  return channels;
}

ConstQuatTrack track_of(const std::vector<double>& channels) {
  const std::size_t n = channels.size() / 4;
  const std::span<const double> all(channels);
  return {all.subspan(0, n), all.subspan(n, n), all.subspan(2 * n, n), all.subspan(3 * n, n)};
}
QuatTrack track_of(std::vector<double>& channels) {
  const std::size_t n = channels.size() / 4;
  const std::span<double> all(channels);
  return {all.subspan(0, n), all.subspan(n, n), all.subspan(2 * n, n), all.subspan(3 * n, n)};
}

}  // namespace kinegraph
