#include "nodes/judge/measures.h"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "nodes/feet/carried_contacts.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/judge/distance_measures.h"
#include "nodes/judge/feet_measures.h"
#include "nodes/judge/smoothness_measures.h"
#include "nodes/motion/metric_name.h"
#include "nodes/motion/moving_root.h"
#include "nodes/node_params.h"
#include "nodes/style/quat_stats.h"

namespace kinegraph {

namespace {

struct Row {
  const char* name;
  const char* unit;
  Measured measured;
  bool feet = false;  // only joints that carry a point of a foot
};

void check_contacts(const Contacts& contacts, const Motion& motion) {
  if (contacts.points.empty() || contacts.frames == motion.frames()) return;
  throw Failure(error("length-mismatch", fmt::format("contacts are of {} frames and the motion has {}",
                                                     contacts.frames, motion.frames()))
                    .at_port("contacts")
                    .hinting("detect contacts on this motion, or leave the port open"));
}

// Joint names as they stand in metric names, made unique.
std::vector<std::string> suffixes(const Skeleton& skeleton) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Joint& joint : skeleton.joints) {
    const std::string plain = joint_metric_name("", joint.name);
    std::string name = plain;
    for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}_{}", plain, n);
    names.push_back(name);
  }
  return names;
}

std::vector<Row> distances(const Motion& motion, const WorldMotion& world, const Motion* reference,
                           const std::vector<bool>& joints, const MeasureParams& params, Window window,
                           Work& work) {
  std::vector<Row> rows{{"position_distance", "m", {}},
                        {"rotation_distance", "deg", {}},
                        {"aligned_distance", "m", {}},
                        {"style_distance", "deg", {}}};
  for (Row& row : rows) row.measured.joints.resize(joints.size());
  if (!reference) return rows;

  check_same_rate(motion.fps(), reference->fps(), "motion", "reference");
  std::vector<int> partner = partners(reference->skeleton(), motion.skeleton(), params.map);
  warn_about_partners(reference->skeleton(), motion.skeleton(), partner, work);
  for (std::size_t j = 0; j < partner.size(); ++j) {
    if (!joints[j]) partner[j] = -1;
  }
  const WorldMotion reference_world = world_motion(*reference, work);
  const Compared pair{motion, world, *reference, reference_world, partner};
  rows[0].measured = position_distance(pair, window);
  rows[1].measured = rotation_distance(pair, window);
  // Where a joint below a still root carries the body, its path and heading are the root's.
  const auto unowned = [](const Motion& one) {
    return std::shared_ptr<const Motion>(std::shared_ptr<const Motion>(), &one);
  };
  const auto told = with_moving_root(unowned(motion), work),
             told_reference = with_moving_root(unowned(*reference), work);
  std::optional<WorldMotion> own_world, own_reference_world;
  const WorldMotion& told_world =
      told.get() == &motion ? world : own_world.emplace(world_motion(*told, work));
  const WorldMotion& told_reference_world =
      told_reference.get() == reference ? reference_world
                                        : own_reference_world.emplace(world_motion(*told_reference, work));
  rows[2].measured =
      aligned_distance({*told, told_world, *told_reference, told_reference_world, partner}, window, work);
  if (window.size() > 0 && reference->frames() > 0) {
    QuatStatsParams own;
    own.joints = joints;
    own.start = window.start;
    own.end = window.end;
    QuatStatsParams other;
    other.joints.assign(reference->skeleton().joints.size(), false);
    for (int joint : partner) {
      if (joint >= 0) other.joints[static_cast<std::size_t>(joint)] = true;
    }
    rows[3].measured =
        style_distance(quat_stats(*told, own, work), quat_stats(*told_reference, other, work), partner);
  }
  return rows;
}

}  // namespace

Metrics measure(const Motion& motion, const Motion* reference, const Contacts* contacts,
                const MeasureParams& params, Work& work) {
  const auto count = static_cast<std::size_t>(motion.joints());
  const std::vector<bool> joints = params.joints.empty() ? std::vector<bool>(count, true) : params.joints;
  Window window = params.window;
  if (window.end == 0) window.end = motion.frames();

  std::optional<Contacts> found;
  if (!contacts) {
    // A skeleton without feet has no plants, which is no error here.
    found = find_legs(motion.skeleton()).empty() ? Contacts{}
                                                 : detect_contacts(motion, DetectContactsParams{}, work);
    contacts = &*found;
  }
  check_contacts(*contacts, motion);
  const Contacts own = carried_contacts(*contacts, motion, work);
  contacts = &own;

  const WorldMotion world = world_motion(motion, work);
  FeetMeasures feet = measure_feet(world, motion.fps(), *contacts, joints, window);
  SmoothnessMeasures smooth = measure_smoothness(motion, world, joints, window, work);
  std::vector<Row> rows;
  rows.push_back({"skate", "m/s", std::move(feet.skate), true});
  rows.push_back({"skate_share", "", std::move(feet.skate_share), true});
  rows.push_back({"penetration", "m", std::move(feet.penetration), true});
  rows.push_back({"jerk", "m/s3", std::move(smooth.jerk)});
  rows.push_back({"sparc", "", std::move(smooth.sparc)});
  rows.push_back({"acceleration_max", "m/s2", std::move(smooth.acceleration_max)});
  rows.push_back({"angular_acceleration_max", "rad/s2", std::move(smooth.angular_acceleration_max)});
  rows.push_back({"bone_drift", "", std::move(smooth.bone_drift)});
  for (Row& row : distances(motion, world, reference, joints, params, window, work))
    rows.push_back(std::move(row));

  std::vector<bool> foot(count);
  for (const FootPoint& point : contacts->points) {
    if (point.joint >= 0) foot[static_cast<std::size_t>(point.joint)] = true;
  }
  Metrics metrics;
  for (const Row& row : rows) metrics.all.push_back({row.name, row.measured.all, row.unit});
  const std::vector<std::string> suffix = suffixes(motion.skeleton());
  for (const Row& row : rows) {
    for (std::size_t j = 0; j < count; ++j) {
      if (!joints[j] || (row.feet && !foot[j])) continue;
      metrics.all.push_back({row.name + suffix[j], row.measured.joints[j], row.unit});
    }
  }
  return metrics;
}

}  // namespace kinegraph
