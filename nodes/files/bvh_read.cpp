#include "nodes/files/bvh_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/files/bvh_hierarchy.h"
#include "nodes/files/bvh_numbers.h"
#include "nodes/files/channel_rotations.h"
#include "nodes/files/frame_rate.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/rest_frame.h"
#include "nodes/files/up_axis.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

constexpr double largest_value =
    1e9;  // degrees or lengths past it are damage, and lose the meaning of a turn
constexpr double stands_still = 2e-7;  // of the file's unit: what six decimals can't tell

// A joint's channels as series over the frames kept.
struct JointChannels {
  std::string axes;  // of the rotations, in order
  std::vector<const double*> rotations;
  std::array<const double*, 3> positions{};  // null: no such channel
  bool has_position() const { return positions[0] || positions[1] || positions[2]; }
};

std::vector<JointChannels> split_channels(const BvhHierarchy& file, const std::vector<double>& series,
                                          std::size_t frames, std::size_t first_frame) {
  std::vector<JointChannels> all(file.joints.size());
  const double* values = series.data();
  for (std::size_t j = 0; j < all.size(); ++j)
    for (const std::string& channel : file.joints[j].channels) {
      if (largest_size({values, frames}) > largest_value) {
        auto bad =
            std::find_if(values, values + frames, [](double v) { return !(std::fabs(v) <= largest_value); });
        throw Failure(
            error("too-large", fmt::format("{} of {} is {:g}", channel, file.names[j], *bad))
                .at_joint(file.names[j])
                .at_frame(static_cast<std::int64_t>(first_frame + static_cast<std::size_t>(bad - values))));
      }
      if (channel[1] == 'p') {
        all[j].positions[channel[0] - 'X'] = values;
      } else {
        all[j].axes += channel[0];
        all[j].rotations.push_back(values);
      }
      values += frames;
    }
  return all;
}

Vec3 local_position(const JointChannels& joint, Vec3 offset, std::size_t frame) {
  for (int axis = 0; axis < 3; ++axis)
    if (joint.positions[axis]) offset[axis] = joint.positions[axis][frame];
  return offset;
}

// How far the rest pose, or a frame (its values, in the channels' order), reaches along y and z of the file;
// in its unit, End Sites included.
struct Extents {
  double y = 0, z = 0;
};
Extents extents_of(const BvhHierarchy& file, const double* frame) {
  std::vector<Vec3> positions(file.joints.size());
  std::vector<Quat> turns(file.joints.size());
  std::vector<double> radians;
  Vec3 low, high;
  auto see = [&](Vec3 point, bool first) {
    low = first ? point : Vec3{0, std::min(low.y, point.y), std::min(low.z, point.z)};
    high = first ? point : Vec3{0, std::max(high.y, point.y), std::max(high.z, point.z)};
  };
  for (std::size_t j = 0; j < positions.size(); ++j) {
    Vec3 offset = file.joints[j].offset;
    std::string axes;
    radians.clear();
    for (const std::string& channel : file.joints[j].channels) {
      if (!frame) break;
      const double value = *frame++;
      if (channel[1] == 'p') {
        offset[channel[0] - 'X'] = value;
      } else {
        axes += channel[0];
        radians.push_back(value / degrees_per_radian);
      }
    }
    turns[j] = from_euler(axes, radians.data());
    if (int parent = file.parents[j]; parent >= 0) {
      positions[j] = positions[parent] + rotate(turns[parent], offset);
      turns[j] = turns[parent] * turns[j];
    } else {
      positions[j] = offset;
    }
    see(positions[j], j == 0);
  }
  for (const auto& end : file.ends) see(positions[end.joint] + rotate(turns[end.joint], end.offset), false);
  return {high.y - low.y, high.z - low.z};
}

// The longest way along links from one end of the rest pose to another, such as from a hand to a foot.
double longest_way(const BvhHierarchy& file) {
  std::vector<double> below(file.joints.size());  // from a joint to its farthest end
  double longest = 0;
  auto link = [&](int joint, double length) {
    longest = std::max(longest, below[joint] + length);
    below[joint] = std::max(below[joint], length);
  };
  for (const auto& end : file.ends) link(end.joint, norm(end.offset));
  for (std::size_t j = file.joints.size(); j-- > 1;)
    link(file.parents[j], norm(file.joints[j].offset) + below[j]);
  return longest;
}

LengthUnit find_unit(const BvhHierarchy& file, UpAxis up, const std::vector<double>& first_frame,
                     const ReadOptions& options, Work& work) {
  if (names_a_unit(options.unit)) return unit_from_param(options.unit, {});
  const Extents rest = extents_of(file, nullptr);
  auto upwards = [&](const Extents& of) { return up == UpAxis::y ? of.y : of.z; };
  double height = upwards(rest);
  std::string is = "the rest pose is {:.4g} units high";
  // Rest poses that are no pose: all joints in one place, or every bone along one axis of its own. People who
  // stand reach over 0.6 of the way from hand to foot, rigs of that kind up to 0.5.
  const bool usable = !first_frame.empty() && largest_size(first_frame) <= largest_value;
  const Extents first = usable ? extents_of(file, first_frame.data()) : rest;
  if (upwards(first) > height && (height < 0.8 * upwards(first) || height < 0.55 * longest_way(file))) {
    height = upwards(first);
    is = "the first frame is {:.4g} units high";
  }
  // A figure that lies, most often because the file has another axis up, is as tall as it is long.
  const double along = up == UpAxis::y ? rest.z : rest.y;
  if (height < 0.25 * along) {
    height = along;
    is = up == UpAxis::y ? "the rest pose lies along Z, {:.4g} units long"
                         : "the rest pose lies along Y, {:.4g} units long";
  }
  LengthUnit unit = unit_by_height(height);
  work.report(info("unit-found", fmt::format("unit {}: {}, {:.3g} m so", to_text(unit),
                                             fmt::format(fmt::runtime(is), height), height * unit.metres))
                  .hinting("where that is wrong, tell it by Load's unit or convert's --unit")
                  .at_param("unit"));
  return unit;
}

// Whether position channels make a track; where they don't, `offset` is what they stand for.
bool makes_track(const JointChannels& joint, bool is_root, std::size_t frames, Vec3& offset) {
  if (!joint.has_position() || frames == 0) return is_root && joint.has_position();
  Vec3 middle = offset;
  for (int axis = 0; axis < 3; ++axis)
    if (const double* values = joint.positions[axis]) {
      auto [low, high] = std::minmax_element(values, values + frames);
      if (*high - *low > stands_still) return true;
      middle[axis] = (*low + *high) / 2;
    }
  if (is_root) return true;
  const Vec3 apart = middle - offset;
  const bool equal = std::max({std::fabs(apart.x), std::fabs(apart.y), std::fabs(apart.z)}) <= stands_still;
  if (equal) return false;
  if (offset != Vec3{}) return true;
  offset = middle;
  return false;
}

void fill_translation(const JointChannels& joint, Vec3 offset, double unit, UpAxis up, Vec3Track out) {
  for (std::size_t t = 0; t < out.x.size(); ++t)
    out.set(t, unit * y_up(local_position(joint, offset, t), up));
}

void turn_up(UpAxis from, QuatTrack q) {
  if (from == UpAxis::y) return;
  for (std::size_t t = 0; t < q.x.size(); ++t) q.set(t, y_up(q[t], from));
}

}  // namespace

Motion read_bvh(std::string_view text, const ReadOptions& options, Work& work) {
  BvhHierarchy file = read_bvh_hierarchy(text, work);
  const FrameWindow window = frames_to_keep(options, file.frames);
  const std::size_t frames = window.last - window.first;
  const BvhNumbers numbers =
      read_bvh_numbers(text, file.numbers, file.channels, file.frames, window.first, window.last, work);
  const auto& series = numbers.series;
  const auto channels = split_channels(file, *series, frames, window.first);
  const UpAxis up = options.up == "z" ? UpAxis::z : UpAxis::y;
  const LengthUnit unit = find_unit(file, up, numbers.first_frame, options, work);

  auto skeleton = std::make_shared<Skeleton>();
  std::vector<bool> translates(file.joints.size());
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    Vec3 offset = file.joints[j].offset;
    translates[j] = makes_track(channels[j], j == 0, frames, offset);
    skeleton->joints.push_back({file.names[j], file.parents[j], unit.metres * y_up(offset, up), {}});
  }
  auto facts = std::make_shared<SourceFacts>();
  for (const auto& end : file.ends) {
    skeleton->ends.push_back({end.joint, unit.metres * y_up(end.offset, up), {}});
    facts->bvh_ends.push_back(end.offset);
  }
  facts->format = "bvh";
  facts->unit = unit.metres;
  facts->unit_name = unit.name;
  facts->up = up;
  facts->bvh = file.joints;
  facts->frame_time_text = file.frame_time;
  facts->frame_time = 1 / rate_of_frame_time(file.frame_time);
  facts->read = series;
  facts->read_frames = frames;

  Motion motion(skeleton, facts, rate_of_frame_time(file.frame_time), frames, translates);
  for (int j = 0; j < motion.joints() && frames > 0; ++j) {
    const JointChannels& joint = channels[j];
    if (!joint.axes.empty()) {
      rotations_from_degrees(joint.axes, joint.rotations, motion.rotation(j));
      make_track_continuous(motion.rotation(j));
      turn_up(up, motion.rotation(j));
    }
    if (motion.translates(j))
      fill_translation(joint, file.joints[j].offset, unit.metres, up, motion.translation(j));
    work.check();
  }
  if (frames == 0) work.report(warning("no-frames", "the file has a skeleton and no frames"));
  warn_about_rest_frame(motion, window.first, work);
  return motion;
}

}  // namespace kinegraph
