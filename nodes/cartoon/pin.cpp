#include "nodes/cartoon/pin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "nodes/cartoon/above_ground.h"
#include "nodes/cartoon/contact_joints.h"
#include "nodes/cartoon/groups.h"
#include "nodes/cartoon/pinned_chain.h"
#include "nodes/cartoon/planted_limbs.h"
#include "nodes/cartoon/world_to_local.h"
#include "nodes/motion/kinematics.h"
#include "nodes/quiet_work.h"

namespace kinegraph {
namespace {

constexpr std::size_t most_goals =
    8;  // joints of one chain that are pinned: every set of them has its own curve

constexpr double longest_link = 3;  // of its rest length; beyond it a pin is told of

// Legs of sub-joints, bent at rest, are up to 8.5 % longer.
constexpr double same_legs = 0.1;

// A stretch of time in which a joint has one target.
struct Hold {
  std::size_t start, end;
  std::vector<Vec3> target;  // one a frame of the whole clip, or a single one
  std::string param;         // the pin; empty: of the contacts
  Vec3 at(std::size_t frame) const { return target.size() == 1 ? target[0] : target[frame]; }
};

// What is held for one frame only is a point on the joint's way: it goes through it as fast as it would have
// passed beside it, and the whole way about it is shifted by as much.
Hold passing(const Hold& hold, const ConstVec3Track& joint, std::size_t frames) {
  Hold shifted = hold;
  const Vec3 offset = hold.at(hold.start) - joint[hold.start];
  shifted.target.assign(frames, {});
  for (std::size_t t = 0; t < frames; ++t) shifted.target[t] = joint[t] + offset;
  return shifted;
}

Goal goal_of(std::vector<Hold> holds, const Motion& motion, const std::string& joint, double fade) {
  const std::size_t frames = motion.frames();
  std::sort(holds.begin(), holds.end(), [](const Hold& a, const Hold& b) { return a.start < b.start; });
  // Heel and ball of a foot without toes are on one joint: where both are planted it stands between.
  const auto overlaps = [&](std::size_t i) { return holds[i].start < holds[i - 1].end; };
  for (std::size_t i = 1; i < holds.size(); ++i)
    if (overlaps(i) && !(holds[i].param.empty() && holds[i - 1].param.empty()))
      throw Failure(
          error("pins-overlap", fmt::format("{} is pinned twice at frame {}", joint, holds[i].start))
              .at_param(holds[i].param.empty() ? holds[i - 1].param : holds[i].param)
              .at_joint(joint)
              .at_frame(static_cast<std::int64_t>(holds[i].start))
              .hinting(holds[i].param.empty() || holds[i - 1].param.empty()
                           ? "the linked contacts plant it there: pin it before or after"
                           : "end one pin before the other starts"));
  Goal goal{std::vector<double>(frames), std::vector<Vec3>(frames)};
  std::vector<double> total(frames);
  for (std::size_t i = 0; i < holds.size(); ++i) {
    const Hold& hold = holds[i];
    double before = fade, after = fade;
    if (i > 0 && !overlaps(i))
      before = std::min(fade, static_cast<double>(hold.start - holds[i - 1].end + 1));
    if (i + 1 < holds.size() && !overlaps(i + 1))
      after = std::min(fade, static_cast<double>(holds[i + 1].start - hold.end + 1));
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

std::map<int, std::vector<Hold>> holds_of_pins(const Motion& motion, const WorldMotion& world,
                                               const PinParams& params) {
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
      throw Failure(error("bad-range", fmt::format("[{}, {}) isn't within the motion, which has {} frames",
                                                   pinned.start, pinned.end, motion.frames()))
                        .at_param(param)
                        .hinting("a range is [start, end) within the motion"));
    Hold hold{pinned.start, pinned.end, {pinned.position}, param};
    if (pinned.end == pinned.start + 1) hold = passing(hold, world.position(joint), motion.frames());
    holds[joint].push_back(std::move(hold));
  }
  return holds;
}

// Heights at which plants were found are the ground's, on a body of the same size.
bool knows_ground(const Contacts& contacts, const Skeleton& skeleton) {
  return contacts.leg > 0 && std::fabs(leg_length(skeleton) - contacts.leg) < same_legs * contacts.leg;
}

// Adds what planted points hold. A planted joint that no chain leads to stays as it is, with a warning.
void add_plants(const Motion& motion, const WorldMotion& world, const Contacts& contacts,
                std::map<int, std::vector<Hold>>& holds, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  const std::vector<int> joints = contact_joints(contacts, motion, work);
  const std::vector<bool> pruned = small_ends(skeleton);
  const bool ground = knows_ground(contacts, skeleton);
  for (std::size_t i = 0; i < contacts.points.size(); ++i) {
    const FootPoint& point = contacts.points[i];
    const int joint = joints[i];
    const std::vector<Run> runs = runs_of(point.planted);
    if (joint < 0 || runs.empty()) continue;
    if (chain_to(skeleton, joint, chain_ends(skeleton, pruned, {joint})).size() < 2) {
      work.report(warning("no-chain", fmt::format("no chain of joints leads to {}, so its planted point "
                                                  "isn't held",
                                                  point.joint_name))
                      .at_port("contacts")
                      .at_joint(point.joint_name)
                      .hinting("let heels and balls of DetectContacts choose joints further down a leg"));
      continue;
    }
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const Run& run = runs[r];
      Vec3 mean;
      for (std::size_t t = run.start; t < run.end; ++t)
        mean += point_at(world, joint, point.local, t) / static_cast<double>(run.end - run.start);
      if (ground && r < point.heights.size()) mean.y = point.heights[r];
      // The joint keeps its orientation, so the point stands still when the joint makes up for what it turns.
      std::vector<Vec3> target(motion.frames());
      for (std::size_t t = 0; t < motion.frames(); ++t)
        target[t] = mean + (world.position(joint)[t] - point_at(world, joint, point.local, t));
      holds[joint].push_back({run.start, run.end, std::move(target), ""});
    }
  }
}

// Why no chain leads to a pinned joint: none does, or its chain ends where the way to another one parts.
[[noreturn]] void refuse_short_chain(const Skeleton& skeleton, int joint, const Hold& hold,
                                     const std::set<int>& pinned) {
  const std::string& name = skeleton.joints[joint].name;
  Diagnostic diagnostic =
      error("no-chain", fmt::format("no chain of joints leads to {}, so nothing could bend", name))
          .hinting("pin a joint further down a limb");
  const int parent = skeleton.joints[joint].parent;
  if (chain_to(skeleton, joint, chain_ends(skeleton, small_ends(skeleton), {joint})).size() > 1)
    for (int other : pinned) {
      if (other == parent || !skeleton.is_below(other, parent) || skeleton.is_below(other, joint)) continue;
      diagnostic = error("pins-apart",
                         fmt::format("{} and {} are pinned and part at {}, so no chain leads to {} alone",
                                     name, skeleton.joints[other].name, skeleton.joints[parent].name, name))
                       .hinting(fmt::format("pin {}, one of the two, or joints further down both",
                                            skeleton.joints[parent].name));
      break;
    }
  diagnostic.joint = name;
  diagnostic.param = hold.param;
  if (hold.param.empty()) diagnostic.port = "contacts";
  throw Failure(diagnostic);
}

// Lifts what planted chains let sink under the ground between their plants; pins say for themselves where
// they are.
void lift(const Motion& motion, const Contacts& contacts, const std::map<int, std::vector<Hold>>& holds,
          std::map<int, PinnedChain>& chains, WorldMotion& moved, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  if (!knows_ground(contacts, skeleton)) return;
  std::map<int, std::vector<double>> lifts;  // of joints
  QuietWork quiet(work);
  const std::vector<int> joints = contact_joints(contacts, motion, quiet);
  for (std::size_t i = 0; i < contacts.points.size(); ++i) {
    if (joints[i] < 0 || !holds.contains(joints[i])) continue;
    const std::vector<double> up = lift_above_ground(contacts.points[i], moved, joints[i], contacts.leg);
    std::vector<double>& most = lifts[joints[i]];
    most.resize(up.size());
    for (std::size_t t = 0; t < up.size(); ++t) most[t] = std::max(most[t], up[t]);
  }
  for (auto& [first, chain] : chains) {
    std::vector<double> part(motion.frames());
    bool planted = true;
    for (const auto& [index, goal] : chain.goals) {
      const int joint = chain.joints[index];
      for (const Hold& hold : holds.at(joint)) planted = planted && hold.param.empty();
      for (std::size_t t = 0; t < part.size(); ++t)
        if (lifts.contains(joint) && lifts[joint][t] > 0) part[t] = 1;
    }
    if (!planted || std::all_of(part.begin(), part.end(), [](double p) { return p == 0; })) continue;
    for (auto& [index, goal] : chain.goals) {
      const int joint = chain.joints[index];
      goal.part = part;
      for (std::size_t t = 0; t < part.size(); ++t)
        goal.target[t] = moved.position(joint)[t] + Vec3{0, lifts.contains(joint) ? lifts[joint][t] : 0, 0};
    }
    bend(skeleton, chain, moved, turn_limits(motion.fps()), work);
  }
}

// Tells of the link that pins have stretched most, where that is beyond reason.
void warn_of_stretch(const Skeleton& skeleton, const std::map<int, std::vector<Hold>>& holds,
                     const std::map<int, PinnedChain>& chains, const WorldMotion& before,
                     const WorldMotion& after, Work& work) {
  double most = longest_link;
  int joint = -1;
  std::size_t frame = 0;
  std::string param;
  for (const auto& [first, chain] : chains) {
    const std::string& pinned_by = holds.at(chain.joints[chain.goals.back().first]).front().param;
    if (pinned_by.empty()) continue;
    for (std::size_t i = 1; i < chain.joints.size(); ++i) {
      const int j = chain.joints[i], parent = chain.joints[i - 1];
      const double rest = skeleton.link_length(j) * skeleton.above_scale;
      if (!(rest > 0)) continue;
      const auto length = [&](const WorldMotion& world, std::size_t t) {
        return norm(world.position(j)[t] - world.position(parent)[t]);
      };
      for (std::size_t t = 0; t < after.frames(); ++t)
        if (const double now = length(after, t); now > most * rest && now > 1.01 * length(before, t)) {
          most = now / rest;
          joint = j;
          frame = t;
          param = pinned_by;
        }
    }
  }
  if (joint >= 0)
    work.report(
        warning("stretched-link",
                fmt::format("the link to the joint has {:.3g} times its length, to reach the pin", most))
            .at_param(param)
            .at_joint(skeleton.joints[joint].name)
            .at_frame(static_cast<std::int64_t>(frame))
            .hinting("bring the position nearer to where the joint is"));
}

}  // namespace

Motion pin(const Motion& motion, const PinParams& params, const Contacts* contacts, Work& work) {
  const Skeleton& skeleton = motion.skeleton();
  if (motion.frames() == 0 || skeleton.size() == 0) return motion;
  const WorldMotion world = world_motion(motion, work);
  auto holds = holds_of_pins(motion, world, params);
  if (contacts) add_plants(motion, world, *contacts, holds, work);
  if (holds.empty()) return motion;
  std::set<int> pinned;
  for (const auto& [joint, list] : holds) pinned.insert(joint);
  const std::vector<bool> ends = chain_ends(skeleton, small_ends(skeleton), pinned);
  // By their first joint: those nearer to the root come first, and what they move is where the others start.
  std::map<int, PinnedChain> chains;
  for (const auto& [joint, list] : holds) {
    const std::vector<int> chain = chain_to(skeleton, joint, ends);
    if (chain.size() < 2) refuse_short_chain(skeleton, joint, list.front(), pinned);
    PinnedChain& known = chains[chain.front()];
    if (chain.size() > known.joints.size()) known.joints = chain;
    known.goals.emplace_back(chain.size() - 1,
                             goal_of(list, motion, skeleton.joints[joint].name, params.fade * motion.fps()));
    if (known.goals.size() > most_goals)
      throw Failure(
          error("too-many-pins", fmt::format("more than {} joints of one chain are pinned", most_goals))
              .at_joint(skeleton.joints[joint].name)
              .at_param(list.front().param));
  }
  WorldMotion moved = world;
  for (auto& [first, chain] : chains) {
    std::sort(chain.goals.begin(), chain.goals.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    bend(skeleton, chain, moved, turn_limits(motion.fps()), work);
  }
  if (contacts) lift(motion, *contacts, holds, chains, moved, work);
  warn_of_stretch(skeleton, holds, chains, world, moved, work);
  return motion_from_world(motion.shared_skeleton(), motion.shared_source(), motion.fps(),
                           motion.translating(), moved, work);
}

}  // namespace kinegraph
