#include "nodes/feet/detect_contacts.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

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

using Paths = std::vector<std::vector<Vec3>>;

// How the plants of some points slide in common, m/s in the plane: the median over their frames.
std::optional<Vec3> common_slide(const Paths& paths, const Contacts& contacts,
                                 const std::function<bool(const FootPoint&)>& counts) {
  std::vector<double> x, z;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!counts(contacts.points[i])) continue;
    for (std::size_t t = 1; t < contacts.frames; ++t) {
      if (!contacts.points[i].planted[t] || !contacts.points[i].planted[t - 1]) continue;
      const Vec3 step = paths[i][t] - paths[i][t - 1];
      x.push_back(step.x * contacts.fps);
      z.push_back(step.z * contacts.fps);
    }
  }
  if (x.empty()) return std::nullopt;
  return Vec3{median(x), 0, median(z)};
}

// A path as seen from ground that slides.
std::vector<Vec3> seen_from(Vec3 slide, double fps, std::vector<Vec3> path) {
  for (std::size_t t = 0; t < path.size(); ++t) path[t] -= (static_cast<double>(t) / fps) * slide;
  return path;
}

// Which frames of each point are planted. What is found first tells how the ground slides under all of it;
// seen from there, two drifts of one motion look the same but for plants that one of them hid, hence again
// until it settles; and what only a drift would excuse is no plant. The grounds that judge a point at last
// are the clip's own, the one under all plants, and the one under its own foot: each foot of a restyled
// motion may slide its own way, so that what is common to both is far from either.
void find_plants(const Paths& paths, const DetectContactsParams& params, Contacts& contacts, Work& work) {
  const auto seen = [&](std::size_t i, Vec3 slide, Ground kind) {
    work.check();
    return planted_frames(seen_from(slide, contacts.fps, paths[i]), contacts.fps, params, kind);
  };
  constexpr int rounds = 3;
  Vec3 ground;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < paths.size(); ++i)
      contacts.points[i].planted = seen(i, ground, Ground::sliding);
    ground = common_slide(paths, contacts, [](const FootPoint&) { return true; }).value_or(Vec3{});
    work.progress((round + 1.0) / (rounds + 1));
  }
  std::vector<std::vector<bool>> found;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto of_foot = [&](const FootPoint& point) { return point.foot == contacts.points[i].foot; };
    const Vec3 under_foot = common_slide(paths, contacts, of_foot).value_or(ground);
    found.push_back(seen(i, {}, Ground::firm));
    for (const Vec3& slide : {ground, under_foot}) {
      const std::vector<bool> more = seen(i, slide, Ground::firm);
      for (std::size_t t = 0; t < more.size(); ++t) found[i][t] = found[i][t] || more[t];
    }
  }
  for (std::size_t i = 0; i < paths.size(); ++i) contacts.points[i].planted = std::move(found[i]);
  work.progress(1);
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
  Paths paths;
  for (const FootPoint& point : contacts.points) paths.push_back(path_of(point, world));
  find_plants(paths, params, contacts, work);
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
