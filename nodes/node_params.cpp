#include "nodes/node_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/motion/cut_links.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/motion/moving_root.h"

namespace kinegraph {

void add_joints_param(NodeType& type) {
  type.param("joints", pattern("*").checked_by(check_pattern),
             "The joints it acts on: names, *, -Name, Name> with commas between.");
}
void add_range_param(NodeType& type) {
  type.param("range", range(), "The frames it acts on, from the first up to but without the second.");
}
void add_fade_param(NodeType& type) {
  type.param(
      "fade", number(0).between(0, 1e6).in("s").slider(0, 2),
      "How long the change takes to come in at the start of the range and to go out at its end, inside the "
      "range; not at an end that is the motion's own.");
}
void add_amount_param(NodeType& type) {
  type.param("amount", number(1).between(0, 10).slider(0, 1),
             "How much of the change: 0 is the input, 1 the whole change, more goes beyond it.");
}
void add_map_param(NodeType& type) {
  type.param(
      "map", list(text("")),
      "Joints that belong together, each as FROM=TO: a joint of the second input and one of the main input. "
      "Empty: equal names, then CMU's ASF and BVH names.");
}

Frames checked_range(const FrameRange& range, std::size_t frames, std::string_view param) {
  auto count = static_cast<std::int64_t>(frames);
  std::int64_t end = range.end.value_or(count);
  auto refuse = [&](std::string what) {
    throw Failure(error("bad-range", std::move(what))
                      .at_param(std::string(param))
                      .hinting(fmt::format(
                          "the motion has frames 0 to {}; the range is [start, end) and null goes to the "
                          "end",
                          count - 1)));
  };
  if (count == 0)
    throw Failure(
        error("no-frames", "the motion has no frames")
            .hinting("its file may hold a skeleton alone, as an .asf does: load the clip, such as an "
                     ".amc beside it"));
  if (range.start < 0) refuse(fmt::format("the range starts at frame {}", range.start));
  if (range.start >= count) refuse(fmt::format("the range starts at frame {}, past the last", range.start));
  if (end > count) refuse(fmt::format("the range ends at frame {}, past the motion's {} frames", end, count));
  if (end <= range.start) refuse(fmt::format("the range [{}, {}) is empty", range.start, end));
  return {static_cast<std::size_t>(range.start), static_cast<std::size_t>(end)};
}

namespace {

double smooth_step(double x) {
  return x >= 1 ? 1 : x <= 0 ? 0 : x * x * (3 - 2 * x);
}

double optional_number(const Params& params, std::string_view name, double otherwise) {
  return params.all().find(name) == params.all().end() ? otherwise : params.number(name);
}

}  // namespace

std::vector<double> change_weights(const Params& params, std::size_t frames, double fps) {
  std::vector<double> weights(frames);
  if (frames == 0) return weights;
  Frames range = checked_range(params.range("range"), frames, "range");
  double fade = optional_number(params, "fade", 0) * fps;  // in frames
  double amount = optional_number(params, "amount", 1);
  for (std::size_t t = range.start; t < range.end; ++t) {
    // The frame before the range has 0 and the one `fade` frames in has 1; without a fade the first frame
    // has 1.
    double in = range.start == 0 ? 1 : smooth_step(static_cast<double>(t - range.start + 1) / (fade + 1));
    double out = range.end == frames ? 1 : smooth_step(static_cast<double>(range.end - t) / (fade + 1));
    weights[t] = amount * in * out;
  }
  return weights;
}

Motion blended_change(const Motion& input, const Motion& changed, const std::vector<bool>& joints,
                      const std::vector<double>& weights) {
  auto translates = input.translating();
  for (int j = 0; j < input.joints(); ++j)
    if (changed.translates(j) && joints[j]) translates[j] = true;
  Motion result(input.shared_skeleton(), input.shared_source(), input.fps(), input.frames(), translates);
  for (int j = 0; j < input.joints(); ++j) {
    auto from = input.rotation(j);
    auto to = changed.rotation(j);
    auto out = result.rotation(j);
    for (std::size_t t = 0; t < input.frames(); ++t) {
      double w = joints[j] ? weights[t] : 0;
      out.set(t, w == 0 ? from[t] : w == 1 ? to[t] : slerp(w, from[t], to[t]));
    }
    if (joints[j]) make_continuous(out.x, out.y, out.z, out.w);
    if (!result.translates(j)) continue;
    auto place = result.translation(j);
    for (std::size_t t = 0; t < input.frames(); ++t) {
      double w = joints[j] ? weights[t] : 0;
      Vec3 a = input.local_offset(j, t);
      if (w == 0) {
        place.set(t, a);
        continue;
      }
      Vec3 b = changed.local_offset(j, t);
      place.set(t, w == 1 ? b : a + w * (b - a));
    }
  }
  return result;
}

void check_same_rate(double a, double b, std::string_view port_a, std::string_view port_b) {
  // A BVH's frame time is often cut short: 0.008333 stands for 1/120. 29.97 and 30 differ by more than this.
  if (std::fabs(a - b) <= 5e-4 * std::max(std::fabs(a), std::fabs(b))) return;
  throw Failure(error("rate-mismatch",
                      fmt::format("{} has {:.6g} frames per second and {} has {:.6g}", port_a, a, port_b, b))
                    .at_port(std::string(port_b))
                    .hinting(fmt::format("put a Resample node with fps {:.6g} before {}", a, port_b)));
}

namespace {

// The way from an ancestor to a joint, in the ancestor's frame at rest: with equal ways, equal local
// rotations give equal poses.
Vec3 rest_way(const RestPose& pose, int ancestor, int joint) {
  return rotate(inverse(pose.orientations[ancestor]), pose.positions[joint] - pose.positions[ancestor]);
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), shown); ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

void warn_about_partners(const Skeleton& from, const Skeleton& to, const std::vector<int>& partner_of_to,
                         Work& work, const std::vector<bool>* chosen) {
  auto counts = [&](int joint) { return !chosen || (*chosen)[joint]; };
  std::vector<std::string> alone;
  for (int j = 0; j < to.size(); ++j)
    if (partner_of_to[j] < 0 && counts(j)) alone.push_back(to.joints[j].name);
  if (!alone.empty()) {
    work.report(warning("no-partner",
                        fmt::format("{} of {} joints have no partner in the other motion and stay as they "
                                    "are: {}",
                                    alone.size(), to.size(), listed(alone)))
                    .hinting("name partners with the parameter map, as FROM=TO"));
  }
  RestPose from_pose = rest_pose(from), to_pose = rest_pose(to);
  const std::vector<bool> from_cut = on_cut_links(from), to_cut = on_cut_links(to);
  const auto passes_cut = [](const Skeleton& skeleton, const std::vector<bool>& cut, int joint) {
    const int parent = skeleton.joints[joint].parent;
    return cut[joint] || (parent >= 0 && cut[parent]);
  };
  constexpr double limit = 5 / degrees_per_radian;
  std::vector<std::string> differing;
  double largest = 0;
  for (int j = 0; j < to.size(); ++j) {
    int partner = partner_of_to[j];
    if (partner < 0 || !counts(j)) continue;
    int ancestor = to.joints[j].parent;
    while (ancestor >= 0 && partner_of_to[ancestor] < 0) ancestor = to.joints[ancestor].parent;
    if (ancestor < 0 || (ancestor == 0 && carries_the_legs(to, j))) continue;
    if (partner_of_to[ancestor] == partner || !from.is_below(partner, partner_of_to[ancestor])) continue;
    Vec3 a = rest_way(from_pose, partner_of_to[ancestor], partner);
    Vec3 b = rest_way(to_pose, ancestor, j);
    // A cut link starts along a curve: where it leads to is the same, its first joint's frame is turned.
    if (passes_cut(from, from_cut, partner) || passes_cut(to, to_cut, j)) {
      a = from_pose.positions[partner] - from_pose.positions[partner_of_to[ancestor]];
      b = to_pose.positions[j] - to_pose.positions[ancestor];
    }
    if (norm(a) < 1e-6 || norm(b) < 1e-6) continue;
    double angle = turn(smallest_turn(a, b));
    largest = std::max(largest, angle);
    if (angle > limit) differing.push_back(to.joints[j].name);
  }
  if (differing.empty()) return;
  work.report(
      warning("rest-pose-differs", fmt::format("the rest poses differ by up to {:.0f}° on the way to {}",
                                               largest * degrees_per_radian, listed(differing)))
          .hinting("put a Retarget node before the other input"));
}

}  // namespace kinegraph
