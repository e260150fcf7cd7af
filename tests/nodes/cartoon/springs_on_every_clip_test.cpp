// What holds of curves and springs, on every clip of the collection.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "nodes/cartoon/exaggerate.h"
#include "nodes/cartoon/rubber_joints.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/motion/resample.h"
#include "tests/nodes/cartoon/cartoon_clips.h"

namespace kinegraph {
namespace {

// From the middle of a clip, at a rate, without its first frame, which may be a T-pose that the motion jumps
// out of; null where it has none.
std::shared_ptr<const Motion> middle_of(const std::string& file, double seconds, double fps) {
  const auto whole = whole_clip(file);
  if (!whole) return nullptr;
  Alone work;
  const auto wished = static_cast<std::size_t>(std::ceil(seconds * whole->fps())) + 1;
  const std::size_t frames = std::min(wished, whole->frames() - 1),
                    first = (whole->frames() - frames + 1) / 2;
  Motion cut = whole->empty_like(frames);
  for (int j = 0; j < cut.joints(); ++j)
    for (std::size_t t = 0; t < frames; ++t) {
      cut.rotation(j).set(t, whole->rotation(j)[first + t]);
      if (cut.translates(j)) cut.translation(j).set(t, whole->translation(j)[first + t]);
    }
  return std::make_shared<Motion>(fps > 0 ? resampled(cut, fps, work) : cut);
}

struct Driven {
  std::vector<int> parents;
  ParticlePath path;
  double height = 0;
};

ParticlePath places_of(const WorldMotion& world) {
  ParticlePath path{static_cast<std::size_t>(world.joints()), {}};
  for (std::size_t t = 0; t < world.frames(); ++t)
    for (int i = 0; i < world.joints(); ++i) path.at.push_back(world.position(i)[t]);
  return path;
}

// The driven particles of an exaggerated clip.
Driven driven_by(const Motion& clip) {
  Alone work;
  RubberParams params;
  params.simulate = false;
  const RubberResult rubber = rubber_joints(exaggerate(clip, {}, work).motion, params, nullptr, work);
  Driven driven;
  for (const SubJoint& one : rubber.sub_joints.all) driven.parents.push_back(one.parent);
  driven.path = places_of(world_motion(rubber.motion));
  driven.height = std::max(rest_height(clip.skeleton()), 0.1);
  return driven;
}

double farthest(const ParticlePath& a, const ParticlePath& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.at.size(); ++i) {
    const double far = norm(a.at[i] - b.at[i]);
    if (!(far <= worst)) worst = far;
  }
  return worst;
}

TEST(SpringsOnEveryClip, StayFiniteForEveryStiffnessAndDrag) {
  KINEGRAPH_NEEDS_MOCAP();
  int clips = 0;
  for (const std::string& file : every_clip()) {
    for (double fps : {24.0, 240.0}) {
      const auto clip = middle_of(file, 0.25, fps);
      if (!clip || clip->frames() < 2) continue;
      ++clips;
      const Driven driven = driven_by(*clip);
      for (double hook : {0.0, 300.0, 1e6})
        for (double link : {0.0, 600.0, 1e6})
          for (double drag : {0.0, 1e4}) {
            Alone work;
            const auto out =
                simulate(driven.parents, driven.path, fps, {hook, link, drag, true, 0}, false, work);
            // Free masses fly on at their first speed, which is that of an exaggerated limb; nothing blows
            // up.
            EXPECT_LT(farthest(out.positions, driven.path), 30 * driven.height)
                << file << " at " << fps << ", hook " << hook << ", link " << link << ", drag " << drag;
          }
    }
  }
  EXPECT_GT(clips, 100);
}

// The driven particles stop in the clip's midst and rest.
TEST(SpringsOnEveryClip, NeverGainEnergyWhereTheDrivenRest) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const std::string& file : every_clip()) {
    const auto clip = middle_of(file, 0.5, 0);
    if (!clip) continue;
    Driven driven = driven_by(*clip);
    const std::size_t n = driven.path.particles, stop = driven.path.frames() - 1;
    const std::vector<Vec3> last(driven.path.at.end() - static_cast<std::ptrdiff_t>(n), driven.path.at.end());
    const auto rest_frames = static_cast<std::size_t>(std::ceil(0.5 * clip->fps())) + 2;
    for (std::size_t f = 0; f < rest_frames; ++f)
      driven.path.at.insert(driven.path.at.end(), last.begin(), last.end());
    for (double drag : {0.0, 12.0})
      for (double link : {600.0, 1e5}) {
        Alone work;
        const MassSpringParams params{300, link, drag, true, 0};
        const auto out = simulate(driven.parents, driven.path, clip->fps(), params, true, work);
        double before = 0, most = 0;
        // The cubic between frames still moves in the first frame after the stop.
        for (std::size_t f = stop + 2; f < driven.path.frames(); ++f) {
          const auto of = [&](const ParticlePath& path) { return std::span(path.at).subspan(f * n, n); };
          const double energy =
              energy_of(driven.parents, of(driven.path), of(out.positions), of(out.velocities), params);
          // Where all but nothing is left, the rounding of positions is more than 1e-9 of it.
          if (f > stop + 2 && before > 1e-20) most = std::max(most, (energy - before) / before);
          before = energy;
        }
        EXPECT_LE(most, 1e-9) << file << ", link " << link << ", drag " << drag;
      }
  }
}

TEST(SpringsOnEveryClip, ConvergeWithTheStep) {
  KINEGRAPH_NEEDS_MOCAP();
  double most = 0, worst_ratio = 0;
  for (const std::string& file : every_clip()) {
    const auto clip = whole_clip(file);
    if (!clip) continue;
    const Driven driven = driven_by(*clip);
    const auto at = [&](double halvings) {
      MassSpringParams params;
      // As many steps as the defaults take, and two and four times as many.
      params.substeps = static_cast<int>(halvings * std::max(1.0, std::ceil(120 / clip->fps() - 1e-9)));
      Alone work;
      return simulate(driven.parents, driven.path, clip->fps(), params, false, work).positions;
    };
    const auto once = at(1), twice = at(2), four = at(4);
    const double first = farthest(once, twice), second = farthest(twice, four);
    most = std::max(most, first / driven.height);
    EXPECT_LT(first, 0.01 * driven.height) << file;
    if (first > 1e-9) worst_ratio = std::max(worst_ratio, second / first);
    EXPECT_LE(second, 0.55 * first + 1e-9) << file << " " << first << " " << second;
  }
  RecordProperty("largest_change_of_the_height", std::to_string(most));
  RecordProperty("largest_ratio", std::to_string(worst_ratio));
}

// What RubberJoints gives, with all that keeps limbs from flipping, follows the springs.
void expect_rubber_converges(const std::string& file, const Motion& clip, bool with_contacts, double& most,
                             double& worst_ratio) {
  Alone work;
  const Motion wild = exaggerate(clip, {}, work).motion;
  const double height = std::max(rest_height(clip.skeleton()), 0.1);
  std::optional<Contacts> contacts;  // as the node finds them
  try {
    if (with_contacts) contacts = detect_contacts(wild, {}, work);
  } catch (const Failure&) {
  }
  const auto at = [&](double halvings) {
    RubberParams params;
    // As many steps as the defaults take, and two and four times as many.
    params.springs.substeps = static_cast<int>(halvings * std::max(1.0, std::ceil(120 / clip.fps() - 1e-9)));
    return places_of(world_motion(rubber_joints(wild, params, contacts ? &*contacts : nullptr, work).motion));
  };
  const auto once = at(1), twice = at(2), four = at(4);
  const double first = farthest(once, twice), second = farthest(twice, four);
  most = std::max(most, first / height);
  EXPECT_LT(first, 0.01 * height) << file;
  if (first > 1e-9) worst_ratio = std::max(worst_ratio, second / first);
  EXPECT_LE(second, 0.55 * first + 1e-9) << file << " " << first << " " << second;
}

TEST(RubberOnEveryClip, ConvergesWithTheStep) {
  KINEGRAPH_NEEDS_MOCAP();
  double most = 0, worst_ratio = 0;
  for (const std::string& file : every_clip()) {
    const auto clip = whole_clip(file);
    if (!clip) continue;
    Alone work;
    expect_rubber_converges(file, *clip, false, most, worst_ratio);
    expect_rubber_converges(file + " at 120 fps", resampled(*clip, 120, work), true, most, worst_ratio);
  }
  RecordProperty("largest_change_of_the_height", std::to_string(most));
  RecordProperty("largest_ratio", std::to_string(worst_ratio));
}

// Of a point from the nearest of a polyline's links, at a frame.
double stray(Vec3 p, const WorldMotion& world, const std::vector<int>& group, std::size_t t) {
  double nearest = 1e9;
  for (std::size_t k = 0; k + 1 < group.size(); ++k) {
    const Vec3 a = world.position(group[k])[t], link = world.position(group[k + 1])[t] - a;
    const double along = dot(link, link) > 0 ? std::clamp(dot(p - a, link) / dot(link, link), 0.0, 1.0) : 0;
    nearest = std::min(nearest, norm(p - (a + along * link)));
  }
  return nearest;
}

TEST(CurvesOnEveryClip, StayNearTheLimb) {
  KINEGRAPH_NEEDS_MOCAP();
  double most = 0;
  for (const std::string& file : every_clip()) {
    const auto whole = whole_clip(file);
    if (!whole) continue;
    for (bool wild : {false, true}) {
      Alone work;
      const Motion clip = wild ? exaggerate(*whole, {}, work).motion : *whole;
      RubberParams params;
      params.simulate = false;
      params.sub_joints.counts = {{"*", 7}};
      const RubberResult rubber = rubber_joints(clip, params, nullptr, work);
      const SubJoints& sub = rubber.sub_joints;
      const WorldMotion world = world_motion(clip), places = world_motion(rubber.motion);
      const std::size_t step = std::max<std::size_t>(1, clip.frames() / 200);
      double worst = 0;
      for (const auto& group : sub.groups) {
        for (std::size_t t = 0; t < clip.frames(); t += step) {
          double total = 0;  // as long as the group is here
          for (std::size_t i = 1; i < group.size(); ++i)
            total += norm(world.position(group[i])[t] - world.position(group[i - 1])[t]);
          if (!(total > 0)) continue;
          for (std::size_t i = 0; i + 1 < group.size(); ++i)
            for (int l = 1; l < sub.all[sub.first[group[i]]].count; ++l)
              worst = std::max(worst,
                               stray(places.position(sub.first[group[i]] + l)[t], world, group, t) / total);
        }
      }
      EXPECT_LT(worst, 0.3) << file << (wild ? ", exaggerated" : "");
      most = std::max(most, worst);
    }
  }
  RecordProperty("largest_stray_of_the_groups_length", std::to_string(most));
}

}  // namespace
}  // namespace kinegraph
