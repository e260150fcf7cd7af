#include "nodes/components/substitution.h"

#include <fmt/format.h>

#include <utility>

#include "nodes/components/rebuild.h"
#include "nodes/components/shown_channels.h"

namespace kinegraph {
namespace {

Rows difference(Rows a, const Rows& b) {
  for (std::size_t i = 0; i < a.data.size(); ++i) a.data[i] -= b.data[i];
  return a;
}

void check(const Components& components, const ComponentSegment& base, std::size_t frames,
           const ComponentEditInputs& inputs, const std::string& param) {
  const bool is_motion = inputs.edited_motion != nullptr;
  if (!is_motion && !inputs.edited_points)
    throw Failure(error("no-input", "this edit needs the input `edited`")
                      .at_port("edited")
                      .at_param(param)
                      .hinting("link a changed ComponentMotion"));
  const std::size_t given = is_motion ? inputs.edited_motion->frames() : inputs.edited_points->frames;
  if (given != frames)
    throw Failure(
        error("wrong-length", fmt::format("the edited clip has {} frames, the segment {}", given, frames))
            .at_port("edited")
            .at_param(param)
            .hinting("its nodes must keep the number of frames"));
  const bool is_right = is_motion ? base.motion != nullptr
                                  : base.points || components.space.representation == Representation::points;
  if (!is_right)
    throw Failure(error("wrong-kind",
                        fmt::format("the edited clip is {}, the components are of {}",
                                    is_motion ? "a motion" : "points", base.points ? "points" : "rotations"))
                      .at_port("edited")
                      .at_param(param)
                      .hinting(fmt::format("link what came of ComponentMotion's output `{}`",
                                           base.points ? "points" : "motion")));
}

// `alone`: these entries as channels.
Rows change_of_motion(const Components& components, const Motion& base, const Rows& alone, ShownKey key,
                      const std::shared_ptr<const Motion>& edited, Work& work) {
  const ChannelSpace& space = components.space;
  const auto shown = components.memory->shown.get(
      key, [&](Work& part) { return channels_as_shown(space, alone, base, part); }, work);
  std::vector<double> near, first;  // only Euler angles have turns to count
  if (space.representation == Representation::euler && alone.columns > 0) {
    for (std::size_t d = 0; d < alone.rows; ++d) near.push_back(alone(d, 0));
    first = first_angles_of(space, *edited, near, work);
  }
  const auto now = components.memory->edited.get(
      {{edited}, first}, [&](Work& part) { return channels_of(space, *edited, near, part); }, work);
  return difference(*now, *shown);
}

}  // namespace

Rows substitution(const Components& components, const ComponentSegment& base, const Rows& u,
                  const std::vector<std::size_t>& entries, const ComponentEditInputs& inputs,
                  const std::string& param, Work& work) {
  check(components, base, u.columns, inputs, param);
  const Rows alone = channels_from_signals(components, u, entries);
  if (inputs.edited_motion) {
    ShownKey key{{base.motion}, entries, {}};
    for (std::size_t i : entries) key.signals.insert(key.signals.end(), u.row(i), u.row(i) + u.columns);
    return change_of_motion(components, *base.motion, alone, std::move(key), inputs.edited_motion, work);
  }
  const ChannelSpace& space = components.space;
  if (base.points) return difference(channels_of(space, *inputs.edited_points, work), alone);
  const Points shown = points_from_channels(space, alone, *base.motion, {}, work);
  return difference(channels_on_path(space, *inputs.edited_points, *base.motion, work),
                    channels_on_path(space, shown, *base.motion, work));
}

}  // namespace kinegraph
