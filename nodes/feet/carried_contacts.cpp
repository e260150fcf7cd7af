#include "nodes/feet/carried_contacts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "nodes/feet/foot_points.h"

namespace kinegraph {

namespace {

bool fit(const Contacts& contacts, const Skeleton& skeleton) {
  const double leg = leg_length(skeleton);
  if (contacts.leg > 0 && std::fabs(contacts.leg - leg) > 1e-4 * leg) return false;
  return std::all_of(contacts.points.begin(), contacts.points.end(), [&](const FootPoint& point) {
    return skeleton.find(point.foot) >= 0 && skeleton.find(point.joint_name) >= 0;
  });
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return {};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<double> usual_height(const std::vector<FootPoint>& points, const std::string& part) {
  std::vector<double> all;
  for (const FootPoint& point : points)
    if (point.part == part) all.insert(all.end(), point.heights.begin(), point.heights.end());
  return median(std::move(all));
}

}  // namespace

Contacts carried_contacts(const Contacts& contacts, const Motion& motion, Work& work) {
  if (contacts.points.empty() || contacts.frames != motion.frames() || fit(contacts, motion.skeleton()))
    return contacts;
  Contacts out;
  out.fps = contacts.fps;
  out.frames = contacts.frames;
  out.leg = leg_length(motion.skeleton());
  out.points = foot_points(motion.skeleton(), "", "", work);
  const WorldMotion world = world_motion(motion, work);
  std::vector<const FootPoint*> from;
  for (FootPoint& point : out.points) {
    const auto found =
        std::find_if(contacts.points.begin(), contacts.points.end(),
                     [&](const FootPoint& one) { return one.left == point.left && one.part == point.part; });
    from.push_back(found == contacts.points.end() ? nullptr : &*found);
    point.planted = from.back() ? from.back()->planted : std::vector<bool>(contacts.frames);
    for (const Run& run : runs_of(point.planted)) {
      std::vector<double> heights;
      for (std::size_t t = run.start; t < run.end; ++t)
        heights.push_back(point_at(world, point.joint, point.local, t).y);
      point.heights.push_back(*median(std::move(heights)));
    }
  }
  const double size = contacts.leg > 0 ? out.leg / contacts.leg : 1;
  out.floor = contacts.floor;
  // The floor is below the balls as far as it was, where there are any: how high ankles are above a flat sole
  // is each rig's own.
  for (const char* part : {"heel", "ball"}) {
    const auto own = usual_height(out.points, part), theirs = usual_height(contacts.points, part);
    if (!own || !theirs) continue;
    for (std::size_t k = 0; k < out.points.size(); ++k) {
      FootPoint& point = out.points[k];
      if (point.part != part || !from[k] || from[k]->heights.size() != point.heights.size()) continue;
      for (std::size_t i = 0; i < point.heights.size(); ++i)
        point.heights[i] = *own + size * (from[k]->heights[i] - *theirs);
    }
    out.floor = *own - size * (*theirs - contacts.floor);
  }
  work.report(info("contacts-carried",
                   "the contacts are of another body: its heels' and balls' plants are taken for this one's")
                  .at_port("contacts"));
  return out;
}

}  // namespace kinegraph
