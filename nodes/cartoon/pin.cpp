#include "nodes/cartoon/pin.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "nodes/cartoon/chain_bend.h"
#include "nodes/cartoon/groups.h"
#include "nodes/cartoon/link_turns.h"
#include "nodes/cartoon/planted_limbs.h"
#include "nodes/cartoon/world_to_local.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {
namespace {

constexpr std::size_t most_goals =
    8;  // joints of one chain that are pinned: every set of them has its own curve

// Where a joint shall be, and how much of the way it goes there, at every frame.
struct Goal {
  std::vector<double> part;
  std::vector<Vec3> target;
};

// A stretch of time in which a joint has one target.
struct Hold {
  std::size_t start, end;
  std::vector<Vec3> target;  // one a frame of the whole clip, or a single one
  std::string param;
  Vec3 at(std::size_t frame) const { return target.size() == 1 ? target[0] : target[frame]; }
};

Goal goal_of(std::vector<Hold> holds, const Motion& motion, const std::string& joint, double fade) {
  const std::size_t frames = motion.frames();
  std::sort(holds.begin(), holds.end(), [](const Hold& a, const Hold& b) { return a.start < b.start; });
  for (std::size_t i = 1; i < holds.size(); ++i)
    if (holds[i].start < holds[i - 1].end)
      throw Failure(
          error("pins-overlap", fmt::format("{} is pinned twice at frame {}", joint, holds[i].start))
              .at_param(holds[i].param)
              .at_joint(joint)
              .at_frame(static_cast<std::int64_t>(holds[i].start))
              .hinting("end one pin before the other starts"));
  Goal goal{std::vector<double>(frames), std::vector<Vec3>(frames)};
  std::vector<double> total(frames);
  for (std::size_t i = 0; i < holds.size(); ++i) {
    const Hold& hold = holds[i];
    double before = fade, after = fade;
    if (i > 0) before = std::min(fade, static_cast<double>(hold.start - holds[i - 1].end + 1));
    if (i + 1 < holds.size()) after = std::min(fade, static_cast<double>(holds[i + 1].start - hold.end + 1));
    for (std::size_t t = 0; t < frames; ++t) {
      double part = 1;
      if (t < hold.start)
        part = smoothest_step(1 - static_cast<double>(hold.start - t) / std::max(before, 1.0));
      if (t >= hold.end)
        part = smoothest_step(1 - static_cast<double>(t + 1 - hold.end) / std::max(after, 1.0));
      if (part == 0) continue;
      goal.target[t] = (total[t] * goal.target[t] + part * hold.at(t)) / (total[t] + part);
      total[t] += part;
      goal.part[t] = 1 - (1 - goal.part[t]) * (1 - part);
    }
  }
  return goal;
}

std::map<int, std::vector<Hold>> holds_of(const Motion& motion, const WorldMotion& world,
                                          const PinParams& params, const Contacts* contacts) {
  const Skeleton& skeleton = motion.skeleton();
  std::map<int, std::vector<Hold>> holds;
  for (std::size_t i = 0; i < params.pins.size(); ++i) {
    const PinnedJoint& pinned = params.pins[i];
    const std::string param = fmt::format("pins[{}]", i);
    const int joint = skeleton.find(pinned.joint);
    if (joint < 0) {
      std::vector<std::string> names;
      for (const Joint& one : skeleton.joints) names.push_back(one.name);
      throw Failure(error("unknown-joint", fmt::format("there is no joint '{}'", pinned.joint))
                        .at_param(param)
                        .hinting(suggestion(pinned.joint, names)));
    }
    if (pinned.start >= pinned.end || pinned.end > motion.frames())
      throw Failure(error("bad-range", fmt::format("[{}, {}) holds no frames of the motion's {}",
                                                   pinned.start, pinned.end, motion.frames()))
                        .at_param(param)
                        .hinting("a range is [start, end) within the motion"));
    holds[joint].push_back({pinned.start, pinned.end, {pinned.position}, param});
  }
  if (!contacts) return holds;
  for (const FootPoint& point : contacts->points) {
    const int joint = skeleton.find(point.joint_name);
    if (joint < 0) continue;
    for (const Run& run : runs_of(point.planted)) {
      if (run.end > motion.frames()) break;
      Vec3 mean;
      for (std::size_t t = run.start; t < run.end; ++t)
        mean += point_at(world, joint, point.local, t) / static_cast<double>(run.end - run.start);
      // The joint keeps its orientation, so the point stands still when the joint makes up for what it turns.
      std::vector<Vec3> target(motion.frames());
      for (std::size_t t = 0; t < motion.frames(); ++t)
        target[t] = mean + (world.position(joint)[t] - point_at(world, joint, point.local, t));
      holds[joint].push_back({run.start, run.end, std::move(target), "contacts"});
    }
  }
  return holds;
}

// From the joint below the next branching down to `joint`.
std::vector<int> chain_to(const Skeleton& skeleton, int joint, const std::vector<bool>& pruned) {
  std::vector<int> children(skeleton.joints.size());
  for (int j = 1; j < skeleton.size(); ++j)
    if (!pruned[j]) ++children[skeleton.joints[j].parent];
  std::vector<int> chain{joint};
  for (int p = skeleton.joints[joint].parent; p >= 0 && children[p] <= 1; p = skeleton.joints[p].parent)
    chain.push_back(p);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

// One chain, its pinned joints, and what lies below it.
struct PinnedChain {
  std::vector<int> joints;
  std::vector<std::pair<std::size_t, Goal>> goals;  // index into joints
};

void bend(const Skeleton& skeleton, const PinnedChain& chain, const WorldMotion& world, WorldMotion& moved,
          const TurnLimits& limits, Work& work) {
  const std::size_t frames = world.frames();
  std::vector<double> places{0};
  for (std::size_t i = 1; i < chain.joints.size(); ++i)
    places.push_back(places.back() + std::max(skeleton.link_length(chain.joints[i]), 1e-9));
  // Every set of pins that may hold at once has its curve; between them the parts blend.
  const std::size_t sets = std::size_t{1} << chain.goals.size();
  std::vector<std::vector<std::vector<double>>> curves(sets);
  for (std::size_t set = 1; set < sets; ++set) {
    std::vector<double> given;
    for (std::size_t g = 0; g < chain.goals.size(); ++g)
      if (set >> g & 1) given.push_back(places[chain.goals[g].first]);
    curves[set] = bend_weights(given, places);
  }
  for (std::size_t t = 0; t < frames; ++t) {
    if (t % 256 == 0) work.check();
    std::vector<Vec3> shift(chain.joints.size()), now;
    for (std::size_t set = 1; set < sets; ++set) {
      double part = 1;
      for (std::size_t g = 0; g < chain.goals.size(); ++g)
        part *= set >> g & 1 ? chain.goals[g].second.part[t] : 1 - chain.goals[g].second.part[t];
      if (part == 0) continue;
      if (now.empty())
        for (int joint : chain.joints) now.push_back(world.position(joint)[t]);
      std::vector<std::size_t> given;
      std::vector<Vec3> targets;
      for (std::size_t g = 0; g < chain.goals.size(); ++g) {
        if (!(set >> g & 1)) continue;
        given.push_back(chain.goals[g].first);
        targets.push_back(chain.goals[g].second.target[t]);
      }
      const std::vector<Vec3> bent = bent_chain(now, places, curves[set], given, targets);
      for (std::size_t i = 1; i < shift.size(); ++i) shift[i] += part * (bent[i] - now[i]);
    }
    // What hangs on the chain rides with its joint.
    for (int j = chain.joints.front(); j < skeleton.size(); ++j) {
      if (!skeleton.is_below(j, chain.joints.front())) continue;
      int on = j;
      auto at = std::find(chain.joints.begin(), chain.joints.end(), on);
      while (at == chain.joints.end()) {
        on = skeleton.joints[on].parent;
        at = std::find(chain.joints.begin(), chain.joints.end(), on);
      }
      moved.position(j).set(
          t, world.position(j)[t] + shift[static_cast<std::size_t>(at - chain.joints.begin())]);
    }
  }
  const RestPose rest = rest_pose(skeleton);
  for (std::size_t i = 0; i + 1 < chain.joints.size(); ++i) {
    const int j = chain.joints[i], next = chain.joints[i + 1];
    aim_link(rest_link(rest, j, j, next), world.position(j), world.position(next),
             std::as_const(moved).position(j), std::as_const(moved).position(next), world.orientation(j),
             limits, moved.orientation(j));
    // A pinned joint keeps its orientation, also where the chain goes on to another.
    for (const auto& [index, goal] : chain.goals) {
      if (index != i) continue;
      const auto turned = moved.orientation(j);
      for (std::size_t t = 0; t < frames; ++t)
        turned.set(t, normalized(slerp(goal.part[t], turned[t], world.orientation(j)[t])));
      make_continuous(turned.x, turned.y, turned.z, turned.w);
    }
  }
}

}  // namespace

Motion pin(const Motion& motion, const PinParams& params, const Contacts* contacts, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  if (motion.frames() == 0 || skeleton.size() == 0) return motion;
  const WorldMotion world = world_motion(motion, work);
  const auto holds = holds_of(motion, world, params, contacts);
  if (holds.empty()) return motion;
  const std::vector<bool> pruned = small_ends(skeleton);
  std::map<int, PinnedChain> chains;  // by their first joint
  for (const auto& [joint, list] : holds) {
    const std::vector<int> chain = chain_to(skeleton, joint, pruned);
    if (chain.size() < 2)
      throw Failure(error("no-chain", fmt::format("no chain of joints leads to {}, so nothing could bend",
                                                  skeleton.joints[joint].name))
                        .at_param(list.front().param)
                        .at_joint(skeleton.joints[joint].name)
                        .hinting("pin a joint further down a limb"));
    PinnedChain& known = chains[chain.front()];
    if (chain.size() > known.joints.size()) known.joints = chain;
    known.goals.emplace_back(chain.size() - 1,
                             goal_of(list, motion, skeleton.joints[joint].name, params.fade * motion.fps()));
    if (known.goals.size() > most_goals)
      throw Failure(
          error("too-many-pins", fmt::format("more than {} joints of one chain are pinned", most_goals))
              .at_param(list.front().param));
  }
  WorldMotion moved = world;
  for (auto& [first, chain] : chains) {
    std::sort(chain.goals.begin(), chain.goals.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    bend(skeleton, chain, world, moved, turn_limits(motion.fps()), work);
  }
  return motion_from_world(motion.shared_skeleton(), motion.shared_source(), motion.fps(),
                           motion.translating(), moved, work);
}

}  // namespace kinegraph
