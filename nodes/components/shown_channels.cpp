#include "nodes/components/shown_channels.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/elementary.h"

namespace kinegraph {
namespace {

Rows all_the_way(const ChannelSpace& space, const Rows& channels, const Motion& base, Work& work) {
  std::vector<double> first;
  for (std::size_t d = 0; d < channels.rows; ++d) first.push_back(channels(d, 0));
  return channels_of(space, motion_from_channels(space, channels, base, {}, work), first, work);
}

// Of three angles the solution that is nearest to the frame before is the same again while no angle steps by
// more than 1 rad, as the other solution is π away in two of them; next to the singular middle angle the
// first and the last are one.
bool angles_come_back(const double* const angles[3], std::size_t frames) {
  constexpr double step = 1, singular = 1e-3;
  for (std::size_t t = 0; t < frames; ++t) {
    for (int i = 0; t > 0 && i < 3; ++i)
      if (!(std::fabs(angles[i][t] - angles[i][t - 1]) <= step)) return false;
    const double from_singular = angles[1][t] / pi - 0.5;
    if (!(pi * std::fabs(from_singular - std::floor(from_singular + 0.5)) >= singular)) return false;
  }
  return true;
}

// Rotation vectors of less than half a turn.
bool vectors_come_back(const double* const v[3], std::size_t frames) {
  constexpr double most = pi - 1e-6;
  for (std::size_t t = 0; t < frames; ++t)
    if (!(v[0][t] * v[0][t] + v[1][t] * v[1][t] + v[2][t] * v[2][t] < most * most)) return false;
  return true;
}

// A space of these of its joints alone, rising.
ChannelSpace part_of(const ChannelSpace& space, const std::vector<std::size_t>& entries) {
  ChannelSpace out = space;
  const auto keep = [&](auto& list) {
    if (list.empty()) return;
    auto all = std::move(list);
    list.clear();
    for (std::size_t entry : entries) list.push_back(std::move(all[entry]));
  };
  keep(out.joints);
  keep(out.labels);
  keep(out.reference);
  keep(out.orders);
  return out;
}

}  // namespace

Rows channels_as_shown(const ChannelSpace& space, const Rows& channels, const Motion& base, Work& work) {
  const bool is_euler = space.representation == Representation::euler;
  if (!is_euler && space.representation != Representation::logarithm)
    return all_the_way(space, channels, base, work);
  std::vector<std::size_t> changed;  // entries of the space's joints
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    const double* const three[3] = {channels.row(3 * i), channels.row(3 * i + 1), channels.row(3 * i + 2)};
    if (space.joints[i] == 0 ||
        !(is_euler ? angles_come_back(three, channels.columns) : vectors_come_back(three, channels.columns)))
      changed.push_back(i);
  }
  if (changed.empty()) return channels;
  Rows part(3 * changed.size(), channels.columns);
  for (std::size_t n = 0; n < part.rows; ++n)
    std::copy_n(channels.row(3 * changed[n / 3] + n % 3), part.columns, part.row(n));
  part = all_the_way(part_of(space, changed), part, base, work);
  Rows out = channels;
  for (std::size_t n = 0; n < part.rows; ++n)
    std::copy_n(part.row(n), part.columns, out.row(3 * changed[n / 3] + n % 3));
  return out;
}

}  // namespace kinegraph
