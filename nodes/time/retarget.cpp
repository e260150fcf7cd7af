#include "nodes/time/retarget.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "graph/diagnostic.h"
#include "nodes/motion/elementary.h"
#include "nodes/node_params.h"
#include "nodes/time/retarget_links.h"
#include "nodes/time/retarget_root.h"
#include "nodes/time/retarget_soles.h"

namespace kinegraph {

namespace {

using Orientations = std::vector<std::vector<Quat>>;  // world; a series a joint

// A joint without partner keeps its turn against the joint above, as the target stands.
Quat standing_turn(const Skeleton& skeleton, const Pose& pose, int j) {
  const int parent = skeleton.joints[j].parent;
  return inverse(parent < 0 ? skeleton.above : pose.orientations[parent]) * pose.orientations[j];
}

// The joints of spine and neck without partner share out what their neighbours with one do.
struct Shared {
  int below = -1, above = -1;  // joints of the target with partners
  double share = 0;            // of the way
};

std::vector<Shared> shares(const JointPairs& pairs) {
  std::vector<Shared> out(pairs.source_of.size());
  std::vector<int> chain = {pairs.target_pelvis};
  chain.insert(chain.end(), pairs.target.spine.begin(), pairs.target.spine.end());
  chain.insert(chain.end(), pairs.target.neck.begin(), pairs.target.neck.end());
  if (pairs.target.head >= 0) chain.push_back(pairs.target.head);
  const auto paired = [&](std::size_t k) { return pairs.source_of[chain[k]] >= 0; };
  for (std::size_t k = 1; k < chain.size(); ++k) {
    if (paired(k) || !paired(k - 1)) continue;
    std::size_t end = k;
    while (end < chain.size() && !paired(end)) ++end;
    if (end == chain.size()) break;
    for (std::size_t m = k; m < end; ++m)
      out[chain[m]] = {chain[k - 1], chain[end],
                       static_cast<double>(m - k + 1) / static_cast<double>(end - k + 1)};
  }
  return out;
}

class Turning {
 public:
  Turning(const WorldMotion& world, const Skeleton& target, const Pose& standing, const JointPairs& pairs,
          const std::vector<LinkPlan>& plans, const std::vector<Vec3>& offsets)
      : world_(world),
        target_(target),
        standing_(standing),
        plans_(plans),
        offsets_(offsets),
        shared_(shares(pairs)),
        pelvis_(pairs.target_pelvis),
        turned_(target.joints.size()) {}

  Orientations orientations(Work& work) {
    for (int j = 0; j < target_.size(); ++j) {
      work.check();
      if (!turned_[j].empty()) continue;  // on an aligned link, done with it
      turn(j);
      if (plans_[j].to >= 0) align(j);
    }
    return std::move(turned_);
  }

 private:
  Quat followed(int j, std::size_t t) const {
    return world_.orientation(plans_[j].source)[t] * plans_[j].follow;
  }

  void turn(int j) {
    const std::size_t frames = world_.frames();
    turned_[j].resize(frames);
    const int parent = target_.joints[j].parent;
    const Shared& shared = shared_[j];
    if (j == 0 && pelvis_ > 0) {
      // The root heads as the pelvis does.
      const Quat back = inverse(standing_.orientations[pelvis_]);
      for (std::size_t t = 0; t < frames; ++t)
        turned_[j][t] = about_y(heading_of(followed(pelvis_, t) * back)) * standing_.orientations[j];
    } else if (plans_[j].source >= 0) {
      for (std::size_t t = 0; t < frames; ++t) turned_[j][t] = followed(j, t);
    } else if (shared.below >= 0) {
      const Quat from = inverse(standing_.orientations[shared.below]),
                 to = inverse(standing_.orientations[shared.above]);
      for (std::size_t t = 0; t < frames; ++t)
        turned_[j][t] =
            slerp(shared.share, followed(shared.below, t) * from, followed(shared.above, t) * to) *
            standing_.orientations[j];
    } else {
      const Quat kept = standing_turn(target_, standing_, j);
      for (std::size_t t = 0; t < frames; ++t)
        turned_[j][t] = (parent < 0 ? target_.above : turned_[parent][t]) * kept;
    }
  }

  // Turns `j`, and what stands between it and the end of its link, so that the link points as the source's.
  void align(int j) {
    std::vector<int> way;  // from the link's end up to below j
    for (int k = plans_[j].to; k != j; k = target_.joints[k].parent) way.push_back(k);
    for (auto k = way.rbegin(); k != way.rend(); ++k)
      if (*k != plans_[j].to) turn(*k);
    const auto from = world_.position(plans_[j].source), to = world_.position(plans_[j].source_to);
    for (std::size_t t = 0; t < world_.frames(); ++t) {
      Vec3 link;
      for (int k : way) link += rotate(turned_[target_.joints[k].parent][t], offsets_[k]);
      const Quat by = smallest_turn(link, to[t] - from[t]);
      turned_[j][t] = by * turned_[j][t];
      for (int k : way)
        if (k != plans_[j].to) turned_[k][t] = by * turned_[k][t];
    }
  }

  const WorldMotion& world_;
  const Skeleton& target_;
  const Pose& standing_;
  const std::vector<LinkPlan>& plans_;
  const std::vector<Vec3>& offsets_;
  const std::vector<Shared> shared_;
  const int pelvis_;
  Orientations turned_;
};

// Offsets as the target stands: a BVH may keep them in its position channels alone.
std::vector<Vec3> standing_offsets(const Motion& target, std::vector<bool>& moves) {
  std::vector<Vec3> offsets;
  for (int j = 0; j < target.joints(); ++j) {
    const bool in_channels =
        j > 0 && target.frames() > 0 && target.translates(j) && target.skeleton().link_length(j) == 0;
    moves.push_back(in_channels);
    offsets.push_back(in_channels ? target.local_offset(j, 0) : target.skeleton().joints[j].offset);
  }
  return offsets;
}

void warn_not_upright(const StandingPose& pose, const char* port, Work& work) {
  if (pose.upright) return;
  work.report(
      warning("not-upright", fmt::format("the {} is upright neither at rest nor in any frame; what it "
                                         "does is aligned to the other as far as names go",
                                         port))
          .at_port(port)
          .hinting("if it lies on its side, its file has another axis up: set up of its Load"));
}

void tell_shapes(const std::vector<LinkPlan>& plans, const Skeleton& skeleton, Work& work) {
  constexpr double alike = 5 / degrees_per_radian;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < plans.size(); ++k)
    if (plans[k].shape_of >= 0 && plans[k].shape > alike)
      names.push_back(
          fmt::format("{} ({:.0f}°)", skeleton.joints[k].name, plans[k].shape * degrees_per_radian));
  if (names.empty()) return;
  work.report(
      info("shape-kept",
           fmt::format("where these sit on the joint before them is the body's shape, which keeps its "
                       "difference from the motion's: {}",
                       listed(names))));
}

std::shared_ptr<const SourceFacts> facts_of(const Motion& target, const Motion& motion) {
  auto facts = std::make_shared<SourceFacts>(*without_read(target.shared_source()));
  facts->frame_time = motion.source().frame_time > 0 ? motion.source().frame_time : 1 / motion.fps();
  facts->frame_time_text = motion.source().frame_time_text;
  return facts;
}

}  // namespace

RetargetResult retarget(const Motion& motion, const RetargetTarget& to, const RetargetParams& params,
                        Work& work) {
  const Motion& target = *to.motion;
  const Skeleton &from_skeleton = motion.skeleton(), &skeleton = target.skeleton();
  RetargetResult out;
  out.pairs = pair_joints(from_skeleton, skeleton, params.map, work);
  const WorldMotion world = world_motion(motion, work);
  const StandingPose source_stands = standing_pose(motion, world, out.pairs.source);
  StandingPose target_stands = standing_pose(target, world_motion(target, work), out.pairs.target);
  if (out.pairs.source.pelvis >= 0) warn_not_upright(source_stands, "motion", work);
  if (out.pairs.target.pelvis >= 0) warn_not_upright(target_stands, "target", work);
  const std::vector<LinkPlan> plans =
      plan_links(from_skeleton, skeleton, out.pairs, source_stands, target_stands, params.feet_by);
  tell_shapes(plans, skeleton, work);
  for (const LinkPlan& plan : plans) out.link_to.push_back(plan.to);

  std::vector<bool> moves;
  const std::vector<Vec3> offsets = standing_offsets(target, moves);
  moves[0] = true;
  moves[out.pairs.target_pelvis] = true;
  const auto reserved = work.reserve(motion.frames() * skeleton.joints.size() * sizeof(Quat));
  const Orientations turned =
      Turning(world, skeleton, target_stands.pose, out.pairs, plans, offsets).orientations(work);

  Motion result(target.shared_skeleton(), facts_of(target, motion), motion.fps(), motion.frames(), moves);
  for (int j = 0; j < skeleton.size(); ++j) {
    work.check();
    const int parent = skeleton.joints[j].parent;
    const QuatTrack track = result.rotation(j);
    for (std::size_t t = 0; t < motion.frames(); ++t)
      track.set(t, normalized(inverse(parent < 0 ? skeleton.above : turned[parent][t]) * turned[j][t]));
    if (moves[j] && j > 0)
      for (std::size_t t = 0; t < motion.frames(); ++t) result.translation(j).set(t, offsets[j]);
  }
  const PlacedRoot placed =
      place_root({&from_skeleton, &world, &source_stands}, {&skeleton, &target_stands, to.sole}, out.pairs,
                 params.scale, result, work);
  out.scale = placed.scale;
  if (!target_stands.frame && params.feet_by == FeetBy::sole)
    keep_soles_up(out.pairs.target.legs, target_stands, to.feet, placed.ground, result, work);
  for (int j = 0; j < skeleton.size(); ++j) {
    const QuatTrack track = result.rotation(j);
    make_continuous(track.x, track.y, track.z, track.w);
  }
  out.motion = std::move(result);
  return out;
}

}  // namespace kinegraph
