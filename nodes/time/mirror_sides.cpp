#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/diagnostic.h"
#include "nodes/motion/elementary.h"
#include "nodes/node_params.h"
#include "nodes/time/mirror.h"

namespace kinegraph {

Vec3 reflected(Vec3 v, Vec3 across) {
  return v - 2 * dot(v, across) * across;
}

Quat reflected(Quat q, Vec3 across) {
  Vec3 axis = -reflected(Vec3{q.x, q.y, q.z}, across);
  return {axis.x, axis.y, axis.z, q.w};
}

namespace {

// The joint whose name has the other side's word or letter in one place; -1: none.
int named_partner(const Skeleton& skeleton, const std::string& name) {
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"Left", "Right"}, {"left", "right"}, {"LEFT", "RIGHT"}, {"l", "r"}, {"L", "R"}};
  for (auto [left, right] : words) {
    for (auto [from, to] : {std::pair{left, right}, std::pair{right, left}}) {
      for (auto at = name.find(from); at != name.npos; at = name.find(from, at + 1)) {
        std::string other = name;
        other.replace(at, from.size(), to);
        if (int joint = skeleton.find(other); joint >= 0) return joint;
      }
    }
  }
  return -1;
}

// From right to left: of all pairs, else of the legs' shape, else x. Close to an axis it is that axis.
Vec3 direction_across(const Skeleton& skeleton, const RestPose& pose, const std::vector<int>& partner) {
  Vec3 sum;
  auto legs = find_legs(skeleton);
  for (const Leg& leg : legs) sum += (leg.left ? 1 : -1) * pose.positions[leg.hip];
  if (legs.size() != 2) sum = {};
  sum.y = 0;
  double least = 1e-3 * rest_height(skeleton);
  if (norm(sum) <= least) {
    // Without legs the sign doesn't matter: any pair shows the line.
    for (int j = 0; j < skeleton.size(); ++j) {
      Vec3 way = pose.positions[j] - pose.positions[partner[j]];
      way.y = 0;
      if (norm(way) > norm(sum)) sum = way;
    }
  }
  if (norm(sum) <= least) return {1, 0, 0};
  Vec3 across = normalized(sum);
  if (std::fabs(across.x) > 0.996) return {std::copysign(1, across.x), 0, 0};  // within 5°
  if (std::fabs(across.z) > 0.996) return {0, 0, std::copysign(1, across.z)};
  return across;
}

// From the root down, children of partners are paired by their reflected places.
void pair_by_shape(const Skeleton& skeleton, const RestPose& pose, Vec3 across, std::vector<int>& partner) {
  double near = 0.05 * rest_height(skeleton);
  double middle = dot(pose.positions[0], across);
  auto distance = [&](int a, int b) {
    Vec3 image = reflected(pose.positions[a] - middle * across, across) + middle * across;
    return norm(image - pose.positions[b]);
  };
  std::vector<bool> done(partner.size());
  done[0] = true;
  for (int j = 1; j < skeleton.size(); ++j) {
    if (done[j]) continue;
    int best = -1;
    for (int k : skeleton.children(partner[skeleton.joints[j].parent])) {
      // Equally near (links without length): the one with as many joints below, the first of them.
      bool fits =
          !done[k] && skeleton.children(k).size() == skeleton.children(j).size() && distance(j, k) < near;
      if (fits && (best < 0 || distance(j, k) < distance(j, best))) best = k;
    }
    if (best < 0) best = j;
    if (best != j && partner[skeleton.joints[best].parent] != skeleton.joints[j].parent) best = j;
    partner[j] = best;
    partner[best] = j;
    done[j] = done[best] = true;
  }
}

// The turn, starting from the parent's, that takes the ways to the children of `joint` to the reflections of
// the ways to theirs from the partner: the longest way exactly, the others as well as turning about it can.
Quat frame_of(const Skeleton& skeleton, const RestPose& pose, const Sides& sides, int joint, Quat start) {
  struct Ways {
    Vec3 from, to;
    bool middle;  // of a joint in the middle to one in the middle: exact before any to a side
  };
  std::vector<Ways> ways;
  double size = 0;
  for (int child : skeleton.children(joint)) {
    int other = sides.partner[child];
    if (skeleton.joints[other].parent != sides.partner[joint]) continue;
    Vec3 from = pose.positions[child] - pose.positions[joint];
    Vec3 to = reflected(pose.positions[other] - pose.positions[sides.partner[joint]], sides.across);
    if (norm(from) == 0 || norm(to) == 0) continue;
    ways.push_back({from, to, other == child});
    size += norm(from) * norm(to);
  }
  if (ways.empty()) return start;
  const Ways& main = *std::max_element(ways.begin(), ways.end(), [](const Ways& a, const Ways& b) {
    return a.middle != b.middle ? b.middle : norm(a.from) < norm(b.from);
  });
  Vec3 axis = normalized(main.to);
  Vec3 now = normalized(rotate(start, main.from));
  // Straight back: about an axis in the mirror's plane, so that the turn undoes itself in the mirror.
  bool back = norm(axis + now) < 1e-6 && norm(cross(axis, {0, 1, 0})) > 0.1;
  Quat frame =
      (back ? axis_angle(normalized(Vec3{0, 1, 0} - axis.y * axis), pi) : smallest_turn(now, axis)) * start;
  double sin = 0, cos = 0;
  for (const Ways& way : ways) {
    Vec3 a = rotate(frame, way.from), b = way.to;
    a -= dot(a, axis) * axis;
    b -= dot(b, axis) * axis;
    sin += dot(axis, cross(a, b));
    cos += dot(a, b);
  }
  bool tells = std::sqrt(sin * sin + cos * cos) > 1e-3 * size;  // there are ways aside from the axis
  if (tells) frame = axis_angle(axis, arc_tangent2(sin, cos)) * frame;
  return frame;
}

void find_frames(const Skeleton& skeleton, const RestPose& pose, Sides& sides) {
  sides.frames.assign(skeleton.joints.size(), Quat{});
  for (int j = 0; j < skeleton.size(); ++j) {
    int other = sides.partner[j], parent = skeleton.joints[j].parent;
    if (other < j) {  // mirroring twice must undo it
      sides.frames[j] = inverse(reflected(sides.frames[other], sides.across));
      continue;
    }
    Quat frame = frame_of(skeleton, pose, sides, j, parent < 0 ? Quat{} : sides.frames[parent]);
    if (other == j) {  // likewise: only turns about axes in the mirror's plane do
      Vec3 v{frame.x, frame.y, frame.z};
      v -= dot(v, sides.across) * sides.across;
      frame = normalized(Quat{v.x, v.y, v.z, frame.w});
    }
    sides.frames[j] = frame;
  }
}

int joint_named(const Skeleton& skeleton, std::string_view name, const std::string& entry,
                std::size_t index) {
  int joint = skeleton.find(name);
  if (joint >= 0) return joint;
  std::vector<std::string> names;
  for (const Joint& one : skeleton.joints) names.push_back(one.name);
  throw Failure(error("unknown-joint", fmt::format("\"{}\": there is no joint \"{}\"", entry, name))
                    .at_param(fmt::format("pairs[{}]", index))
                    .at_joint(std::string(name))
                    .hinting(suggestion(name, names)));
}

void pair_as_told(const Skeleton& skeleton, const std::vector<std::string>& pairs, std::vector<int>& partner,
                  std::vector<bool>& told) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::string& entry = pairs[i];
    auto refuse = [&](std::string what) {
      throw Failure(error("bad-map", fmt::format("\"{}\" {}", entry, what))
                        .at_param(fmt::format("pairs[{}]", i))
                        .hinting("write a left joint, = and its right one, each joint once"));
    };
    auto equals = entry.find('=');
    if (equals == entry.npos || equals == 0 || equals + 1 == entry.size())
      refuse("is not of the form LEFT=RIGHT");
    int a = joint_named(skeleton, std::string_view(entry).substr(0, equals), entry, i);
    int b = joint_named(skeleton, std::string_view(entry).substr(equals + 1), entry, i);
    if (told[a] || told[b]) refuse("names a joint a second time");
    partner[a] = b;
    partner[b] = a;
    told[a] = told[b] = true;
  }
}

}  // namespace

Sides find_sides(const Skeleton& skeleton, const std::vector<std::string>& pairs, Work& work) {
  Sides sides;
  for (int j = 0; j < skeleton.size(); ++j) sides.partner.push_back(j);
  if (skeleton.joints.empty()) return sides;
  std::vector<bool> told(sides.partner.size());
  pair_as_told(skeleton, pairs, sides.partner, told);
  bool names_say = !pairs.empty();
  for (int j = 0; j < skeleton.size(); ++j) {
    if (told[j]) continue;
    int other = named_partner(skeleton, skeleton.joints[j].name);
    if (other < 0 || told[other]) continue;
    sides.partner[j] = other;
    sides.partner[other] = j;
    told[j] = told[other] = names_say = true;
  }
  RestPose pose = rest_pose(skeleton);
  sides.across = direction_across(skeleton, pose, sides.partner);
  if (!names_say) pair_by_shape(skeleton, pose, sides.across, sides.partner);

  find_frames(skeleton, pose, sides);

  // A rest pose that shows no body doesn't say who stands beside the middle.
  bool shows_body =
      std::all_of(sides.frames.begin(), sides.frames.end(), [](Quat q) { return turn(q) < pi / 6; });
  std::vector<std::string> alone;
  for (int j = 0; j < skeleton.size(); ++j) {
    double beside = std::fabs(dot(pose.positions[j] - pose.positions[0], sides.across));
    if (shows_body && sides.partner[j] == j && !told[j] && beside > 0.05 * rest_height(skeleton))
      alone.push_back(skeleton.joints[j].name);
  }
  if (!alone.empty()) {
    work.report(warning("no-mirror-partner", fmt::format("no joint on the other side belongs to {}", listed(alone)))
                    .at_param("pairs")
                    .hinting("name pairs as LEFT=RIGHT"));
  }
  return sides;
}

}  // namespace kinegraph
