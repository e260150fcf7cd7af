#include "nodes/cartoon/contact_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "nodes/node_params.h"

namespace kinegraph {
std::vector<int> contact_joints(const Contacts& contacts, const Motion& motion, Work& work) {
  const auto refuse = [](const char* code, std::string what, const char* hint) {
    throw Failure(error(code, std::move(what)).at_port("contacts").hinting(hint));
  };
  if (contacts.frames != motion.frames())
    refuse("frames-differ",
           fmt::format("the contacts have {} frames and the motion {}", contacts.frames, motion.frames()),
           "find them in this motion, or in one of the same length");
  check_same_rate(motion.fps(), contacts.fps, "motion", "contacts");
  std::vector<int> joints;
  std::vector<std::string> lacking;
  for (const FootPoint& point : contacts.points) {
    joints.push_back(motion.skeleton().find(point.joint_name));
    if (joints.back() < 0 && std::find(lacking.begin(), lacking.end(), point.joint_name) == lacking.end())
      lacking.push_back(point.joint_name);
  }
  if (lacking.empty()) return joints;
  const char* hint = "link contacts that were found in this motion, or in one with the same joint names";
  const auto found = std::count_if(joints.begin(), joints.end(), [](int joint) { return joint >= 0; });
  if (found == 0)
    refuse("no-common-joint",
           fmt::format("the motion has none of the joints of the contacts: {}", listed(lacking)), hint);
  work.report(
      warning("no-partner",
              fmt::format("{} of the {} points of the contacts are on joints that the motion hasn't, "
                          "and hold nothing: {}",
                          joints.size() - static_cast<std::size_t>(found), joints.size(), listed(lacking)))
          .at_port("contacts")
          .hinting(hint));
  return joints;
}

}  // namespace kinegraph
