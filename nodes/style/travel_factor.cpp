#include "nodes/style/travel_factor.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "nodes/feet/detect_contacts.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/kinematics.h"
#include "nodes/quiet_work.h"

namespace kinegraph {

namespace {

constexpr double low = 0.04;  // m above the usual low, as DetectContacts' default

// The 10th percentile of a point's height, and what counts as low above it.
double height_of_low(const WorldMotion& world, const FootPoint& point) {
  std::vector<double> heights(world.frames());
  for (std::size_t t = 0; t < heights.size(); ++t)
    heights[t] = point_at(world, point.joint, point.local, t).y;
  const auto tenth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), tenth, heights.end());
  return *tenth + low;
}

template <class Values>
Values gathered(const Values& values, const std::vector<std::size_t>& frames) {
  Values out;
  for (std::size_t t : frames) out.push_back(values[t]);
  return out;
}

// Only the frames `shown`, each with its own travel.
Motion in_its_own_time(const Motion& motion, const std::vector<std::size_t>& shown, Work& work) {
  const Motion& from = motion;
  EncodedRoot root = encode_root(from, work);
  root.d_x = gathered(root.d_x, shown);
  root.d_z = gathered(root.d_z, shown);
  root.d_heading = gathered(root.d_heading, shown);
  root.height = gathered(root.height, shown);
  root.heading = gathered(root.heading, shown);
  root.rho = gathered(root.rho, shown);
  Motion out =
      from.translates(0) ? from.empty_like(shown.size()) : from.with_translation(0).empty_like(shown.size());
  for (int j = 1; j < motion.joints(); ++j) {
    for (std::size_t i = 0; i < shown.size(); ++i) {
      out.rotation(j).set(i, from.rotation(j)[shown[i]]);
      if (from.translates(j)) out.translation(j).set(i, from.translation(j)[shown[i]]);
    }
  }
  decode_root(root, out);
  return out;
}

}  // namespace

std::optional<double> travel_factor(const Motion& motion, const Contacts& contacts,
                                    const std::vector<bool>& counted, Work& work) {
  const WorldMotion world = world_motion(motion, work);
  const ConstVec3Track root = world.position(0);
  double along = 0;    // Σ a·b
  double squared = 0;  // Σ a·a
  for (const FootPoint& point : contacts.points) {
    work.check();
    for (std::size_t t = 1; t < motion.frames(); ++t) {
      if (!point.planted[t] || !point.planted[t - 1] || (!counted.empty() && !counted[t])) continue;
      const Vec3 a = root[t] - root[t - 1];
      const Vec3 b =
          point_at(world, point.joint, point.local, t) - point_at(world, point.joint, point.local, t - 1) - a;
      along += a.x * b.x + a.z * b.z;
      squared += a.x * a.x + a.z * a.z;
    }
  }
  if (!(squared > 1e-12)) return std::nullopt;
  return -along / squared;
}

std::vector<std::size_t> frames_shown(const Motion& motion) {
  std::vector<std::size_t> shown;
  if (motion.frames() > 0) shown.push_back(0);
  for (std::size_t t = 1; t < motion.frames(); ++t) {
    bool moves = false;
    for (int j = 1; j < motion.joints() && !moves; ++j)
      moves = motion.rotation(j)[t] != motion.rotation(j)[t - 1];
    if (moves) shown.push_back(t);
  }
  if (shown.size() > 1) return shown;
  shown.resize(motion.frames());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  return shown;
}

Contacts plants_of(const Motion& motion, Work& work) {
  QuietWork quiet(work);
  const std::vector<std::size_t> shown = frames_shown(motion);
  if (shown.size() == motion.frames()) return detect_contacts(motion, {}, quiet);
  Contacts contacts = detect_contacts(in_its_own_time(motion, shown, quiet), {}, quiet);
  contacts.frames = motion.frames();
  for (FootPoint& point : contacts.points) {
    std::vector<bool> planted(motion.frames());
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const std::size_t end = i + 1 < shown.size() ? shown[i + 1] : motion.frames();
      std::fill(planted.begin() + static_cast<std::ptrdiff_t>(shown[i]),
                planted.begin() + static_cast<std::ptrdiff_t>(end), point.planted[i]);
    }
    point.planted = std::move(planted);
  }
  return contacts;
}

std::optional<double> sweep_factor(const Motion& before, const Motion& after, const Contacts& contacts,
                                   const std::vector<bool>& counted, Work& work) {
  const EncodedRoot root = encode_root(before, work);
  const WorldMotion world = world_motion(before, work);
  const WorldMotion changed = world_motion(after, work);
  double both = 0;     // Σ b·b′
  double squared = 0;  // Σ b·b
  for (const FootPoint& point : contacts.points) {
    work.check();
    const double limit = height_of_low(world, point);
    const auto from_root = [&](const WorldMotion& of, std::size_t t) {
      return rotate(about_y(-root.heading[t]), point_at(of, point.joint, point.local, t) - of.position(0)[t]);
    };
    std::vector<bool> low_frames(before.frames());
    for (std::size_t t = 0; t < before.frames(); ++t)
      low_frames[t] =
          (counted.empty() || counted[t]) && point_at(world, point.joint, point.local, t).y < limit;
    for (const Run& run : runs_of(low_frames)) {
      const Vec3 b = from_root(world, run.end - 1) - from_root(world, run.start);
      const Vec3 c = from_root(changed, run.end - 1) - from_root(changed, run.start);
      both += b.x * c.x + b.z * c.z;
      squared += b.x * b.x + b.z * b.z;
    }
  }
  if (!(squared > 1e-12)) return std::nullopt;
  return both / squared;
}

}  // namespace kinegraph
