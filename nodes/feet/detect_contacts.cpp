#include "nodes/feet/detect_contacts.h"

#include <fmt/core.h>

#include <algorithm>

#include "graph/diagnostic.h"
#include "nodes/feet/foot_points.h"
#include "nodes/motion/kinematics.h"
#include "nodes/node_params.h"

namespace kinegraph {
namespace {

// The lowest that the feet usually are: the 10th percentile over time of the lowest foot point, toe tips
// included.
double floor_under(const Skeleton& skeleton, const WorldMotion& world, const std::vector<FootPoint>& points) {
  std::vector<double> lowest(world.frames());
  std::vector<FootPoint> all = points;
  for (const Leg& leg : find_legs(skeleton)) {
    if (!leg.toe_tip) continue;
    FootPoint tip;
    tip.joint = leg.toe >= 0 ? leg.toe : leg.ankle;
    tip.local = *leg.toe_tip;
    all.push_back(std::move(tip));
  }
  for (std::size_t t = 0; t < lowest.size(); ++t) {
    lowest[t] = point_at(world, all[0].joint, all[0].local, t).y;
    for (const FootPoint& point : all)
      lowest[t] = std::min(lowest[t], point_at(world, point.joint, point.local, t).y);
  }
  if (lowest.empty()) return 0;
  const auto at = lowest.begin() + static_cast<std::ptrdiff_t>(lowest.size() / 10);
  std::nth_element(lowest.begin(), at, lowest.end());
  return *at;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// How all plants slide in common, m/s in the plane: the median over their frames.
Vec3 ground_slide(const std::vector<std::vector<Vec3>>& paths, const Contacts& contacts) {
  std::vector<double> x, z;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t t = 1; t < contacts.frames; ++t) {
      if (!contacts.points[i].planted[t] || !contacts.points[i].planted[t - 1]) continue;
      const Vec3 step = paths[i][t] - paths[i][t - 1];
      x.push_back(step.x * contacts.fps);
      z.push_back(step.z * contacts.fps);
    }
  }
  if (x.empty()) return {};
  return {median(x), 0, median(z)};
}

// The paths as seen from ground that slides.
void stand_on(Vec3 slide, double fps, std::vector<std::vector<Vec3>>& paths) {
  for (std::vector<Vec3>& path : paths)
    for (std::size_t t = 0; t < path.size(); ++t) path[t] -= (static_cast<double>(t) / fps) * slide;
}

bool means(const ContactEdit& edit, const FootPoint& point) {
  const bool foot = edit.foot == point.foot || edit.foot == (point.left ? "left" : "right");
  return foot && (edit.part == "both" || edit.part == point.part);
}

void apply_edits(const std::vector<ContactEdit>& edits, Contacts& contacts) {
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const ContactEdit& edit = edits[i];
    const std::string where = fmt::format("edits[{}]", i);
    const Frames range = checked_range(edit.range, contacts.frames, where + ".range");
    bool any = false;
    std::string feet;
    for (FootPoint& point : contacts.points) {
      if (feet.find(point.foot) == feet.npos) feet += (feet.empty() ? "" : ", ") + point.foot;
      if (!means(edit, point)) continue;
      any = true;
      for (std::size_t t = range.start; t < range.end; ++t) point.planted[t] = edit.planted;
    }
    if (!any) {
      throw Failure(error("unknown-foot", fmt::format("no {} of a foot \"{}\"", edit.part, edit.foot))
                        .at_param(where + ".foot")
                        .hinting("left, right or an ankle: " + feet));
    }
  }
}

void measure_heights(FootPoint& point, const WorldMotion& world) {
  for (const Run& run : runs_of(point.planted)) {
    double sum = 0;
    for (std::size_t t = run.start; t < run.end; ++t) sum += point_at(world, point.joint, point.local, t).y;
    point.heights.push_back(sum / static_cast<double>(run.end - run.start));
  }
}

}  // namespace

Contacts detect_contacts(const Motion& motion, const DetectContactsParams& params, Work& work) {
  Contacts contacts;
  contacts.fps = motion.fps();
  contacts.frames = motion.frames();
  contacts.points = foot_points(motion.skeleton(), params.heels, params.balls, work);
  const WorldMotion world = world_motion(motion, work);
  contacts.floor = floor_under(motion.skeleton(), world, contacts.points);
  contacts.leg = leg_length(motion.skeleton());
  std::vector<std::vector<Vec3>> paths;
  for (const FootPoint& point : contacts.points) paths.push_back(path_of(point, world));
  // What is found first tells how the ground slides under all of it. Seen from there, two drifts of one
  // motion look the same but for plants that one of them hid, hence again; and what only a drift would excuse
  // is no plant.
  constexpr int passes = 3;
  for (int pass = 0; pass < passes; ++pass) {
    if (pass > 0) stand_on(ground_slide(paths, contacts), motion.fps(), paths);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      work.check();
      contacts.points[i].planted =
          planted_frames(paths[i], motion.fps(), params, pass + 1 < passes ? Ground::sliding : Ground::firm);
      work.progress(static_cast<double>(pass * paths.size() + i + 1) /
                    static_cast<double>(passes * paths.size()));
    }
  }
  const auto planted_once = [](const FootPoint& point) { return !runs_of(point.planted).empty(); };
  if (contacts.frames > 1 && params.edits.empty() &&
      std::none_of(contacts.points.begin(), contacts.points.end(), planted_once))
    work.report(
        info("no-contacts", fmt::format("no foot rests for {:g} s anywhere", params.min_time))
            .hinting("runners' feet rest for as little as 0.04 s: lower min_time, or set plants by edits"));
  apply_edits(params.edits, contacts);
  for (FootPoint& point : contacts.points) measure_heights(point, world);
  return contacts;
}

}  // namespace kinegraph
