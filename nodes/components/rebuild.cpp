#include "nodes/components/rebuild.h"

#include <algorithm>
#include <numeric>

#include "nodes/components/ica_kernels.h"

namespace kinegraph {

Rows signals_of(const Components& components, const ComponentSegment& segment) {
  Rows out(components.count(), segment.frames());
  for (std::size_t i = 0; i < out.rows; ++i)
    std::copy_n(components.signals.row(i) + segment.start, out.columns, out.row(i));
  return out;
}

Rows channels_from_signals(const Components& components, const Rows& signals,
                           const std::vector<std::size_t>& entries) {
  Rows chosen_mixing(components.mixing.rows, entries.size()), chosen(entries.size(), signals.columns);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t d = 0; d < chosen_mixing.rows; ++d)
      chosen_mixing(d, i) = components.mixing(d, entries[i]);
    std::copy_n(signals.row(entries[i]), signals.columns, chosen.row(i));
  }
  Rows out(components.mixing.rows, signals.columns);
  if (!entries.empty())
    mix_rows(chosen_mixing.data.data(), out.rows, entries.size(), chosen.data.data(), out.columns,
             out.columns, out.data.data(), out.columns);
  for (std::size_t d = 0; d < out.rows; ++d)
    for (std::size_t t = 0; t < out.columns; ++t) out(d, t) += components.mean[d];
  return out;
}

Rows channels_from_signals(const Components& components, const Rows& signals) {
  std::vector<std::size_t> all(signals.rows);
  std::iota(all.begin(), all.end(), 0);
  return channels_from_signals(components, signals, all);
}

Rows signals_from_channels(const Components& components, const Rows& channels) {
  Rows centred = channels;
  for (std::size_t d = 0; d < centred.rows; ++d)
    for (std::size_t t = 0; t < centred.columns; ++t) centred(d, t) -= components.mean[d];
  Rows out(components.unmixing.rows, channels.columns);
  mix_rows(components.unmixing.data.data(), out.rows, centred.rows, centred.data.data(), out.columns,
           out.columns, out.data.data(), out.columns);
  return out;
}

Rows channels_of_segment(const Components& components, const ComponentSegment& segment, Work& work) {
  if (!segment.motion) return channels_of(components.space, *segment.points, work);
  std::vector<double> near = components.mean;
  if (segment.frames() > 0)
    for (std::size_t d = 0; d < near.size(); ++d)
      for (std::size_t i = 0; i < components.count(); ++i)
        near[d] += components.mixing(d, i) * components.signals(i, segment.start);
  return channels_of(components.space, *segment.motion, near, work);
}

Motion motion_of(const Components& components, const Rows& channels, const ComponentSegment& base,
                 const WayBack& way, Work& work) {
  if (!base.motion)
    throw Failure(error("no-motion", "components of points give points, not a motion")
                      .at_port("motion")
                      .hinting("link the output `points`"));
  return motion_from_channels(components.space, channels, *base.motion, way, work);
}

Points points_of(const Components& components, const Rows& channels, const ComponentSegment& base,
                 const WayBack& way, Work& work) {
  return base.motion ? points_from_channels(components.space, channels, *base.motion, way, work)
                     : points_from_channels(components.space, channels, *base.points, way);
}

}  // namespace kinegraph
