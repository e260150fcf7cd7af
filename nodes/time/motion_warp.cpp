#include "nodes/time/motion_warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "nodes/time/displacement.h"
#include "nodes/time/limb.h"

namespace kinegraph {
namespace {

constexpr double close_enough = 1e-9;  // m
constexpr int most_passes = 30;

std::string param_of(std::size_t key, const char* field) {
  return fmt::format("keys[{}].{}", key, field);
}

struct Position {
  std::size_t key, frame;
  int joint;
  Vec3 goal;
  Limb limb;
};

class Warping {
 public:
  Warping(const Motion& motion, const std::vector<WarpKey>& keys, Work& work)
      : input_(motion.translates(0) ? motion : motion.with_translation(0)), out_(input_), work_(work) {
    for (std::size_t k = 0; k < keys.size(); ++k) take(k, keys[k]);
    for (const auto& [frame, joint] : anchors_) {
      hold(joint, frame);
      for (const Position& one : positions_) {
        if (one.joint != joint) continue;
        hold(one.limb.upper, frame);
        hold(one.limb.middle, frame);
      }
    }
  }

  Motion run() {
    displace_root();
    displace_all();
    for (int pass = 0; !reach_all(); ++pass) {
      work_.check();
      if (pass == most_passes) refuse_conflict();
      displace_all();
    }
    return std::move(out_);
  }

 private:
  void take(std::size_t k, const WarpKey& key) {
    const Skeleton& skeleton = input_.skeleton();
    if (key.frame < 0 || key.frame >= static_cast<std::int64_t>(input_.frames()))
      throw Failure(error("bad-frame", fmt::format("frame {} is not in the motion", key.frame))
                        .at_param(param_of(k, "frame"))
                        .hinting(fmt::format("it has frames 0 to {}", input_.frames() - 1)));
    const int joint = skeleton.find(key.joint);
    if (joint < 0) {
      std::vector<std::string> names;
      for (const Joint& one : skeleton.joints) names.push_back(one.name);
      const std::string near = nearest(key.joint, names);
      throw Failure(
          error("unknown-joint", fmt::format("there is no joint \"{}\"", key.joint))
              .at_param(param_of(k, "joint"))
              .hinting(near.empty() ? "see `kinegraph info` for its joints" : "did you mean " + near + "?"));
    }
    if (key.rotation && key.position)
      throw Failure(error("bad-key", "a key has a rotation or a position, not both")
                        .at_param(fmt::format("keys[{}]", k))
                        .at_joint(key.joint)
                        .hinting("write two keys"));
    const auto frame = static_cast<std::size_t>(key.frame);
    if (!seen_.insert({{frame, joint}, key.position ? 1 : 0}).second)
      throw Failure(error("duplicate-key", "the joint has such a key at this frame already")
                        .at_param(fmt::format("keys[{}]", k))
                        .at_joint(key.joint)
                        .at_frame(key.frame)
                        .hinting("keep one of the two"));
    if (key.rotation) {
      const double size = std::sqrt(dot(*key.rotation, *key.rotation));
      if (!(size > 1e-6) || !std::isfinite(size))
        throw Failure(error("bad-key", "a rotation needs a length above 0")
                          .at_param(param_of(k, "rotation"))
                          .hinting("[0, 0, 0, 1] is no rotation"));
      wanted_[joint][frame] = normalized(*key.rotation);
      fixed_[{joint, frame}] = k;
    } else if (!key.position) {
      anchors_.push_back({frame, joint});
    } else if (joint == 0) {
      const Vec3 local =
          rotate(inverse(skeleton.above), *key.position - skeleton.above_offset) / skeleton.above_scale;
      root_[frame] = local - input_.local_offset(0, frame);
    } else {
      const std::optional<Limb> limb = limb_of(skeleton, joint);
      if (!limb)
        throw Failure(error("no-limb", "no two joints above this one can bring it to a position")
                          .at_param(param_of(k, "joint"))
                          .at_joint(key.joint)
                          .hinting("give the root a position, or a joint further out"));
      positions_.push_back({k, frame, joint, *key.position, *limb});
    }
  }

  // The joint stays as it is at this frame, unless a key says what it does there.
  void hold(int joint, std::size_t frame) {
    wanted_[joint].try_emplace(frame, input_.rotation(joint)[frame]);
    if (joint == 0) root_.try_emplace(frame);
  }

  void displace_root() {
    if (root_.empty()) return;
    const std::vector<Vec3> curve = displacement_curve(root_, input_.frames());
    const Vec3Track track = out_.translation(0);
    for (std::size_t f = 0; f < curve.size(); ++f) track.set(f, track[f] + curve[f]);
  }

  void displace_all() {
    for (const auto& [joint, wanted] : wanted_) {
      work_.check();
      const ConstQuatTrack from = std::as_const(input_).rotation(joint);
      std::map<std::size_t, Vec3> knots;
      Quat last;  // turns that follow each other take the near way round
      for (const auto& [frame, rotation] : wanted) {
        if (rotation == from[frame]) {  // an anchor
          last = {};
          knots[frame] = {};
          continue;
        }
        last = nearer(rotation * inverse(from[frame]), knots.empty() ? Quat{} : last);
        knots[frame] = log(last);
      }
      const std::vector<Vec3> curve = displacement_curve(knots, input_.frames());
      const QuatTrack to = out_.rotation(joint);
      for (std::size_t f = 0; f < curve.size(); ++f) to.set(f, normalized(exp(curve[f]) * from[f]));
      make_continuous(to.x, to.y, to.z, to.w);
    }
  }

  // Brings the joints that are off their positions there, as the other curves now stand. True: none was off.
  bool reach_all() {
    bool all = true;
    for (const Position& one : positions_) {
      const Pose pose = pose_at(out_, one.frame);
      if (norm(pose.positions[one.joint] - one.goal) < close_enough) continue;
      all = false;
      off_ = one.key;
      const Vec3 bend = rotate(pose.orientations[one.limb.upper], usual_bend(input_, one.limb, one.joint));
      const Reached reached = reach(out_, pose, one.frame, one.limb, one.joint, one.goal, bend);
      const std::string& name = input_.skeleton().joints[one.joint].name;
      if (reached.missing > 0)
        throw Failure(error("out-of-reach",
                            fmt::format("{} is {:.3g} m short of the position when only {} and {} move", name,
                                        reached.missing, input_.skeleton().joints[one.limb.upper].name,
                                        input_.skeleton().joints[one.limb.middle].name))
                          .at_param(param_of(one.key, "position"))
                          .at_joint(name)
                          .at_frame(static_cast<std::int64_t>(one.frame))
                          .hinting("move the root nearer with a key of its own"));
      for (int joint : {one.limb.upper, one.limb.middle})
        if (fixed_.contains({joint, one.frame})) refuse_conflict();
      wanted_[one.limb.upper][one.frame] = reached.upper;
      wanted_[one.limb.middle][one.frame] = reached.middle;
      out_.rotation(one.limb.upper).set(one.frame, reached.upper);
      out_.rotation(one.limb.middle).set(one.frame, reached.middle);
    }
    return all;
  }

  [[noreturn]] void refuse_conflict() const {
    throw Failure(
        error("keys-conflict", "this position and the other keys at its frame can't all hold")
            .at_param(fmt::format("keys[{}]", off_))
            .hinting("two keys move the same joints: remove one, or key the joint at the limb's end only"));
  }

  Motion input_, out_;
  Work& work_;
  std::map<int, std::map<std::size_t, Quat>> wanted_;  // local rotations by joint and frame
  std::map<std::size_t, Vec3> root_;                   // displacements of the root, local
  std::vector<Position> positions_;
  std::vector<std::pair<std::size_t, int>> anchors_;
  std::map<std::pair<int, std::size_t>, std::size_t> fixed_;  // joint and frame of rotation keys
  std::set<std::pair<std::pair<std::size_t, int>, int>> seen_;
  std::size_t off_ = 0;
};

}  // namespace

Motion motion_warp(const Motion& motion, const std::vector<WarpKey>& keys, Work& work) {
  if (keys.empty()) return motion;
  return Warping(motion, keys, work).run();
}

}  // namespace kinegraph
