#include "nodes/files/bvh_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/files/channel_rotations.h"
#include "nodes/files/up_axis.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

constexpr double stands_still = 2e-7;  // of the file's unit: what six decimals can't tell
constexpr double no_angle = 1e-7;      // degrees: an axis without a channel may hold that much
const char* const default_order = "ZYX";

// Turns and places of joints as a BVH without rest turns needs them: q' = before q after, p' = scale * before
// p, the root's moved by `above`.
struct Aligned {
  bool plain = true;  // nothing to do
  double scale = 1;
  Vec3 above;
  std::vector<Quat> before, after;
};

Aligned align(const Skeleton& skeleton) {
  Aligned aligned;
  aligned.scale = skeleton.above_scale;
  aligned.above = skeleton.above_offset;
  std::vector<Quat> world;
  for (const Joint& joint : skeleton.joints) {
    const Quat parent = joint.parent < 0 ? skeleton.above : world[joint.parent];
    world.push_back(parent * joint.rest);
    aligned.before.push_back(parent);
    aligned.after.push_back(inverse(world.back()));
    aligned.plain &= parent == Quat{} && joint.rest == Quat{};
  }
  aligned.plain &= aligned.scale == 1 && aligned.above == Vec3{};
  return aligned;
}

double rounded_offset(double value) {
  return std::round(value * 1e9) / 1e9;
}

std::vector<int> depth_first(const Skeleton& skeleton) {
  std::vector<std::vector<int>> children(skeleton.joints.size());
  for (int j = skeleton.size() - 1; j > 0; --j) children[std::max(skeleton.joints[j].parent, 0)].push_back(j);
  std::vector<int> order, open;
  if (skeleton.size() > 0) open.push_back(0);
  while (!open.empty()) {
    int joint = open.back();
    open.pop_back();
    order.push_back(joint);
    open.insert(open.end(), children[joint].begin(), children[joint].end());
  }
  return order;
}

// The distinct axes of `axes` in order, then those it lacks.
std::string three_axes(std::string_view axes) {
  std::string all;
  for (char axis : std::string(axes) + default_order)
    if (all.find(axis) == std::string::npos) all += axis;
  return all;
}

class Layouter {
 public:
  Layouter(const Motion& motion, const WriteOptions& options, const LengthUnit& unit, Work& work)
      : motion_(motion),
        skeleton_(motion.skeleton()),
        facts_(motion.source()),
        options_(options),
        unit_(unit),
        work_(work),
        aligned_(align(skeleton_)),
        frames_(motion.frames()),
        from_bvh_(facts_.bvh.size() == skeleton_.joints.size() && aligned_.plain) {
    std::size_t channels = 0;
    for (const BvhJoint& joint : facts_.bvh) {
      first_channel_.push_back(channels);
      channels += joint.channels.size();
    }
    if (from_bvh_ && facts_.read && facts_.read_frames == frames_ && channels > 0 &&
        facts_.read->size() % channels == 0) {
      read_stride_ = facts_.read->size() / channels;
      has_read_ = facts_.first_read + frames_ <= read_stride_;
    }
  }

  BvhLayout lay_out() {
    const std::vector<int> order = depth_first(skeleton_);
    std::vector<int> index(skeleton_.joints.size());
    for (std::size_t i = 0; i < order.size(); ++i) index[order[i]] = static_cast<int>(i);
    out_.joints.resize(order.size());
    std::vector<Store> stores(order.size());
    work_.parallel(order.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        work_.check();
        BvhLayout::Joint& joint = out_.joints[i];
        joint.name = skeleton_.joints[order[i]].name;
        joint.parent = i == 0 ? -1 : index[skeleton_.joints[order[i]].parent];
        add_channels(order[i], joint, stores[i]);
      }
    });
    std::string grown;
    for (std::size_t i = 0; i < stores.size(); ++i) {
      if (stores[i].grew) grown += (grown.empty() ? "" : ", ") + out_.joints[i].name;
      for (auto& series : stores[i].series) out_.owned.push_back(std::move(series));
    }
    if (from_bvh_ && !grown.empty())
      work_.report(info("channels-added", "channels that the source file lacks are added to " + grown));
    for (std::size_t e = 0; e < skeleton_.ends.size(); ++e)
      out_.joints[index[skeleton_.ends[e].joint]].ends.push_back(end_offset(e));
    if (!from_bvh_)  // other programs want to know where a last bone ends
      for (std::size_t i = 0; i < order.size(); ++i)
        if (out_.joints[i].ends.empty() && skeleton_.children(order[i]).empty())
          out_.joints[i].ends.push_back({});
    return std::move(out_);
  }

 private:
  struct Store {
    std::vector<std::vector<double>> series;  // moved later; the numbers stay where they are
    bool grew = false;
  };

  std::span<const double> keep(Store& store, std::vector<double> series) {
    store.series.push_back(std::move(series));
    return store.series.back();
  }

  Vec3 in_file(Vec3 metres) const { return with_up(metres / unit_.metres, facts_.up); }

  Vec3 place(int joint, Vec3 local) const {
    if (aligned_.plain) return in_file(local);
    Vec3 turned = aligned_.scale * rotate(aligned_.before[joint], local);
    return in_file(joint == 0 ? aligned_.above + turned : turned);
  }

  // An OFFSET as written, where the skeleton still has it.
  Vec3 offset_or(const Vec3& written, Vec3 metres, Vec3 otherwise) const {
    const Vec3 apart = facts_.unit * y_up(written, facts_.up) - metres;
    const double slack = 1e-9 * std::max(1.0, norm(metres));
    if (norm(apart) > slack)
      return {rounded_offset(otherwise.x), rounded_offset(otherwise.y), rounded_offset(otherwise.z)};
    if (unit_.metres == facts_.unit) return written;
    const double factor = facts_.unit / unit_.metres;
    return {rounded_offset(written.x * factor), rounded_offset(written.y * factor),
            rounded_offset(written.z * factor)};
  }

  Vec3 end_offset(std::size_t e) const {
    const EndSite& end = skeleton_.ends[e];
    Vec3 turned = end.offset;
    if (!aligned_.plain) turned = aligned_.scale * rotate(inverse(aligned_.after[end.joint]), turned);
    if (from_bvh_ && facts_.bvh_ends.size() == skeleton_.ends.size())
      return offset_or(facts_.bvh_ends[e], end.offset, in_file(turned));
    turned = in_file(turned);
    return {rounded_offset(turned.x), rounded_offset(turned.y), rounded_offset(turned.z)};
  }

  void add_channels(int j, BvhLayout::Joint& out, Store& store) {
    std::string axes;
    std::array<bool, 3> positions{};
    std::vector<std::string> names;  // in order; rotations as read
    if (from_bvh_) {
      names = facts_.bvh[j].channels;
    } else {
      if (j == 0) names = {"Xposition", "Yposition", "Zposition"};
      for (const char* axis = default_order; *axis; ++axis)
        names.push_back(std::string(1, *axis) + "rotation");
    }
    for (const std::string& name : names) {
      if (name[1] == 'p')
        positions[name[0] - 'X'] = true;
      else
        axes += name[0];
    }

    std::vector<BvhChannel> rotation_channels = rotations(j, axes, store);
    std::vector<BvhChannel> position_channels = place_channels(j, positions, out.offset, store);

    // The source's order: positions and rotations as they were mixed; what is new goes before the rotations.
    bool same_rotations = rotation_channels.size() == axes.size();
    bool same_positions = position_channels.size() ==
                          static_cast<std::size_t>(std::count(positions.begin(), positions.end(), true));
    if (same_rotations && same_positions) {
      std::size_t next_rotation = 0;
      for (const std::string& name : names) {
        if (name[1] == 'r') {
          out.channels.push_back(rotation_channels[next_rotation++]);
        } else {
          out.channels.push_back(*std::find_if(position_channels.begin(), position_channels.end(),
                                               [&](const auto& channel) { return channel.name == name; }));
        }
      }
    } else {
      store.grew = true;
      out.channels = position_channels;
      out.channels.insert(out.channels.end(), rotation_channels.begin(), rotation_channels.end());
    }
  }

  // Position channels of a joint and its OFFSET.
  std::vector<BvhChannel> place_channels(int j, std::array<bool, 3> positions, Vec3& offset, Store& store) {
    const Vec3 rest = skeleton_.joints[j].offset;
    const Vec3 rest_in_file = place(j, rest);
    offset = from_bvh_ ? offset_or(facts_.bvh[j].offset, rest, rest_in_file)
                       : Vec3{rounded_offset(rest_in_file.x), rounded_offset(rest_in_file.y),
                              rounded_offset(rest_in_file.z)};
    const bool had = positions[0] || positions[1] || positions[2];
    // The rest offset of a joint whose channels stand for it may be all it has: the zeros stay as they were
    // written.
    if (from_bvh_ && had && facts_.bvh[j].offset == Vec3{}) offset = {};
    if (!had && !motion_.translates(j)) return {};

    std::array<std::vector<double>, 3> series;
    for (auto& values : series) values.resize(frames_);
    for (std::size_t t = 0; t < frames_; ++t) {
      const Vec3 p = place(j, motion_.local_offset(j, t));
      for (int axis = 0; axis < 3; ++axis) series[axis][t] = p[axis];
    }
    Vec3 middle;
    bool moves = false;
    for (int axis = 0; axis < 3 && frames_ > 0; ++axis) {
      auto [low, high] = std::minmax_element(series[axis].begin(), series[axis].end());
      middle[axis] = (*low + *high) / 2;
      moves |= *high - *low > stands_still;
      // An axis without a channel keeps its OFFSET; a reader that takes 0 there agrees only where the OFFSET
      // is 0.
      if (had && !positions[axis] &&
          std::max(std::fabs(*high - offset[axis]), std::fabs(*low - offset[axis])) > stands_still)
        positions = {true, true, true};
    }
    if (!had && !moves) {  // bones of another length, but a constant one
      if (frames_ > 0 && norm(middle - offset) > stands_still)
        offset = {rounded_offset(middle.x), rounded_offset(middle.y), rounded_offset(middle.z)};
      return {};
    }
    if (!had) positions = {true, true, true};
    std::vector<BvhChannel> channels;
    for (int axis = 0; axis < 3; ++axis)
      if (positions[axis])
        channels.push_back({std::string(1, static_cast<char>('X' + axis)) + "position",
                            keep(store, std::move(series[axis]))});
    return channels;
  }

  // The local rotations in the file's axes; a copy only where they differ from the motion's.
  ConstQuatTrack file_rotation(int j, std::vector<double>& buffer) const {
    auto track = motion_.rotation(j);
    if (aligned_.plain && facts_.up == UpAxis::y) return track;
    buffer.resize(4 * frames_);
    QuatTrack turned = track_in(buffer);
    for (std::size_t t = 0; t < frames_; ++t) {
      Quat q = track[t];
      if (!aligned_.plain) q = aligned_.before[j] * q * aligned_.after[j];
      turned.set(t, with_up(q, facts_.up));
    }
    return {turned.x, turned.y, turned.z, turned.w};
  }

  QuatTrack track_in(std::vector<double>& buffer) const {
    std::span<double> all(buffer);
    return {all.subspan(0, frames_), all.subspan(frames_, frames_), all.subspan(2 * frames_, frames_),
            all.subspan(3 * frames_, frames_)};
  }

  std::vector<BvhChannel> rotations(int j, const std::string& axes, Store& store) {
    std::vector<double> buffer;
    const ConstQuatTrack q = file_rotation(j, buffer);

    std::vector<const double*> read;  // of the rotation channels, at this motion's first frame
    if (has_read_)
      for (std::size_t c = 0; c < facts_.bvh[j].channels.size(); ++c)
        if (facts_.bvh[j].channels[c][1] == 'r')
          read.push_back(facts_.read->data() + (first_channel_[j] + c) * read_stride_ + facts_.first_read);

    std::string order = axes;  // wanted in the file
    if (options_.euler != "source" && !axes.empty()) order = options_.euler;
    std::vector<char> same;
    if (order == axes && !axes.empty() && !read.empty()) {
      std::vector<double> scratch(4 * frames_);
      if (same_rotations(axes, read, q, track_in(scratch), same)) {
        std::vector<BvhChannel> channels;
        for (std::size_t i = 0; i < axes.size(); ++i)
          channels.push_back({std::string(1, axes[i]) + "rotation", {read[i], frames_}});
        return channels;
      }
    }

    const bool three = order.size() == 3 && three_axes(order) == order;
    const std::string full = three_axes(order);
    const bool read_is_near = full == axes && !read.empty();
    std::array<std::vector<double>, 3> angles;
    for (auto& series : angles) series.resize(frames_);
    std::array<double, 3> last{};
    std::array<double, 3> largest{};
    for (std::size_t t = 0; t < frames_; ++t) {
      std::array<double, 3> near = last;
      if (read_is_near)
        for (int i = 0; i < 3; ++i) near[i] = read[i][t] / degrees_per_radian;
      if (read_is_near && t < same.size() && same[t]) {
        for (int i = 0; i < 3; ++i) angles[i][t] = read[i][t];
        last = near;
        continue;
      }
      last = to_euler(q[t], full, &near[0]);
      for (int i = 0; i < 3; ++i) angles[i][t] = last[i] * degrees_per_radian;
      for (int i = 0; i < 3; ++i) largest[i] = std::max(largest[i], std::fabs(angles[i][t]));
    }
    // Fewer channels than axes do where the axes without one hold nothing.
    std::size_t count = 3;
    if (!three && order.size() < 3) {
      bool enough = true;
      for (std::size_t i = order.size(); i < 3; ++i) enough &= largest[i] <= no_angle;
      if (enough && full.compare(0, order.size(), order) == 0) count = order.size();
    }
    std::vector<BvhChannel> channels;
    for (std::size_t i = 0; i < count; ++i)
      channels.push_back({std::string(1, full[i]) + "rotation", keep(store, std::move(angles[i]))});
    return channels;
  }

  const Motion& motion_;
  const Skeleton& skeleton_;
  const SourceFacts& facts_;
  const WriteOptions& options_;
  const LengthUnit unit_;
  Work& work_;
  const Aligned aligned_;
  const std::size_t frames_;
  const bool from_bvh_;
  std::vector<std::size_t> first_channel_;
  std::size_t read_stride_ = 0;
  bool has_read_ = false;
  BvhLayout out_;
};

}  // namespace

BvhLayout bvh_layout(const Motion& motion, const WriteOptions& options, const LengthUnit& unit, Work& work) {
  return Layouter(motion, options, unit, work).lay_out();
}

}  // namespace kinegraph
