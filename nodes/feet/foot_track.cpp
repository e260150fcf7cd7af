#include "nodes/feet/foot_track.h"

#include <fmt/core.h>

#include "graph/diagnostic.h"

namespace kinegraph {

std::vector<FootTrack> foot_tracks(const Skeleton& skeleton, const WorldMotion& world,
                                   const Contacts& contacts) {
  if (contacts.frames != world.frames()) {
    throw Failure(error("contacts-mismatch", fmt::format("the contacts have {} frames, the motion {}",
                                                         contacts.frames, world.frames()))
                      .at_port("contacts")
                      .hinting("detect the contacts on a motion of the same frames, or leave the port open"));
  }
  std::vector<FootTrack> feet;
  for (const Leg& leg : find_legs(skeleton)) {
    FootTrack foot;
    foot.leg = leg;
    foot.ankle.resize(world.frames());
    for (std::size_t t = 0; t < world.frames(); ++t) foot.ankle[t] = world.position(leg.ankle)[t];
    for (const FootPoint& point : contacts.points) {
      if (point.foot != skeleton.joints[leg.ankle].name) continue;
      // The joint by its name: contacts may come from a clip whose joints stand in another order.
      const int joint = skeleton.find(point.joint_name);
      if (joint < 0 || !skeleton.is_below(joint, leg.ankle)) {
        throw Failure(
            error("contacts-mismatch", fmt::format("the contacts name a joint \"{}\" at the foot \"{}\"",
                                                   point.joint_name, point.foot))
                .at_port("contacts")
                .at_joint(point.joint_name)
                .hinting("detect the contacts on a motion of this skeleton"));
      }
      FootTrack::Part& part = point.part == "heel" ? foot.heel : foot.ball;
      if (!part.planted.empty()) continue;  // one heel and one ball a foot hold it
      part.planted = point.planted;
      part.heights = point.heights;
      part.from_ankle.resize(world.frames());
      for (std::size_t t = 0; t < world.frames(); ++t)
        part.from_ankle[t] = point_at(world, joint, point.local, t) - foot.ankle[t];
    }
    const auto from_ankle = [&](int joint, Vec3 local) {
      std::vector<Vec3> path(world.frames());
      for (std::size_t t = 0; t < path.size(); ++t)
        path[t] = point_at(world, joint, local, t) - foot.ankle[t];
      return path;
    };
    if (leg.toe >= 0) foot.toe_from_ankle = from_ankle(leg.toe, {});
    if (leg.toe_tip) foot.tip_from_ankle = from_ankle(leg.toe >= 0 ? leg.toe : leg.ankle, *leg.toe_tip);
    feet.push_back(std::move(foot));
  }
  if (feet.empty() || contacts.points.empty()) {
    throw Failure(error("no-feet", "no joint of the skeleton looks like a foot")
                      .at_port("motion")
                      .hinting("the skeleton needs legs of hip, knee and ankle"));
  }
  return feet;
}

}  // namespace kinegraph
