#include "nodes/cartoon/pin.h"

#include <gmock/gmock.h>

#include "graph/diagnostic.h"
#include "nodes/cartoon/chain_bend.h"
#include "nodes/cartoon/exaggerate.h"
#include "nodes/cartoon/groups.h"
#include "nodes/cartoon/rubber_joints.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/resample.h"
#include "tests/nodes/cartoon/cartoon_clips.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {

NodeType pin_node();

namespace {

Motion still_pose(std::size_t frames, double fps) {
  const Motion walk = gait("walk", 1, fps);
  Motion still = walk.empty_like(frames);
  for (int j = 0; j < still.joints(); ++j)
    for (std::size_t t = 0; t < frames; ++t) {
      still.rotation(j).set(t, walk.rotation(j)[10]);
      if (still.translates(j)) still.translation(j).set(t, walk.translation(j)[10]);
    }
  return still;
}

TEST(Pin, MeetsItsPointAtEveryPinnedFrameAlsoOnRubber) {
  Alone work;
  const Motion run = gait("run", 3);
  const Motion rubber = rubber_joints(exaggerate(run, {}, work).motion, {}, nullptr, work).motion;
  for (const Motion* motion : {&run, &rubber}) {
    const int hand = motion->skeleton().find("RightHand"),
              shoulder = motion->skeleton().find("RightShoulder");
    const WorldMotion before = world_motion(*motion);
    const Vec3 goal = before.position(hand)[80] + Vec3{0.1, 0.15, 0.1};
    PinParams params;
    params.pins = {{"RightHand", 70, 90, goal}};
    params.fade = 0.4;
    const Motion out = pin(*motion, params, nullptr, work);
    const WorldMotion after = world_motion(out);
    for (std::size_t t = 0; t < out.frames(); ++t) {
      if (t >= 70 && t < 90) {
        EXPECT_LT(norm(after.position(hand)[t] - goal), 1e-9);
      }
      EXPECT_LT(norm(after.position(shoulder)[t] - before.position(shoulder)[t]), 1e-9);
      if (t < 40 || t > 120) {
        EXPECT_LT(norm(after.position(hand)[t] - before.position(hand)[t]), 1e-9);
      }
    }
    // The hand keeps its orientation, and the fingers ride on it.
    EXPECT_LT(turn(after.orientation(hand)[80], before.orientation(hand)[80]), 1e-7);
    const int finger = motion->skeleton().find("RightHandIndex1");
    EXPECT_LT(norm((after.position(finger)[80] - after.position(hand)[80]) -
                   (before.position(finger)[80] - before.position(hand)[80])),
              1e-9);
  }
}

TEST(Pin, KeepsTheChainsDirectionAtItsFirstJoint) {
  Alone work;
  const Motion rubber = rubber_joints(still_pose(60, 60), {}, nullptr, work).motion;
  const WorldMotion before = world_motion(rubber);
  const int leg = rubber.skeleton().find("LeftUpLeg"), second = rubber.skeleton().find("LeftUpLeg_2");
  const int foot = rubber.skeleton().find("LeftFoot");
  PinParams params;
  params.pins = {{"LeftFoot", 20, 40, before.position(foot)[30] + Vec3{0.2, 0.1, 0}}};
  const WorldMotion after = world_motion(pin(rubber, params, nullptr, work));
  const Vec3 a = before.position(second)[30] - before.position(leg)[30];
  const Vec3 b = after.position(second)[30] - after.position(leg)[30];
  EXPECT_LT(turn(smallest_turn(a, b)) * degrees_per_radian, 5);
}

TEST(Pin, AddsLittleAcceleration) {
  Alone work;
  const double fps = 240;
  const Motion pose = still_pose(480, fps);
  const Motion rubber = rubber_joints(pose, {}, nullptr, work).motion;
  for (const Motion* still : {&pose, &rubber}) {
    const int hand = still->skeleton().find("LeftHand"), shoulder = still->skeleton().find("LeftShoulder");
    for (Vec3 way : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0.6, -0.8, 0}, Vec3{0, 0, -1}}) {
      for (double d : {0.05, 0.2}) {
        for (double t : {0.25, 0.5}) {
          PinParams params;
          params.fade = t;
          params.pins = {{"LeftHand", 200, 260, world_motion(*still).position(hand)[0] + d * way}};
          const WorldMotion after = world_motion(pin(*still, params, nullptr, work));
          double of_hand = 0, of_any = 0;
          for (int j = shoulder; j < still->joints(); ++j) {
            if (!still->skeleton().is_below(j, shoulder)) continue;
            for (std::size_t f = 1; f + 1 < still->frames(); ++f) {
              const auto at = after.position(j);
              const double size = norm(at[f + 1] - 2 * at[f] + at[f - 1]) * fps * fps;
              of_any = std::max(of_any, size);
              if (j == hand) of_hand = std::max(of_hand, size);
            }
          }
          EXPECT_LT(of_any, 8 * d / (t * t)) << d << " m in " << t << " s";
          EXPECT_GT(of_hand, 2 * d / (t * t));
        }
      }
    }
  }
}

// Of a difference of two tracks, or of one, the largest acceleration between two frames.
double acceleration(const ConstVec3Track& p, const ConstVec3Track* less, double fps, std::size_t first,
                    std::size_t last) {
  double most = 0;
  for (std::size_t t = std::max<std::size_t>(first, 1); t + 1 < std::min(last, p.x.size()); ++t) {
    const auto at = [&](std::size_t u) { return less ? p[u] - (*less)[u] : p[u]; };
    most = std::max(most, norm(at(t + 1) - 2 * at(t) + at(t - 1)));
  }
  return most * fps * fps;
}

// The pinned point itself; the joints above it, whose own bends turn with the chain, add at most what they
// already have.
TEST(Pin, AddsLittleAccelerationToMovingClips) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion clip = resampled(cartoon_clip(file, 240), 120, work);
    double worst = 0, worst_above = 0;
    for (const Motion& motion : {clip, rubber_joints(clip, {}, nullptr, work).motion}) {
      const WorldMotion world = world_motion(motion);
      for (const auto& group : automatic_groups(motion.skeleton(), small_ends(motion.skeleton()))) {
        if (group.size() < 3) continue;
        const int end = group.back();
        for (const auto& [d, fade] : {std::pair{0.05, 0.25}, {0.2, 0.25}, {0.2, 0.5}})
          for (Vec3 way : {Vec3{0, 1, 0}, Vec3{0.6, 0, -0.8}})
            for (std::size_t frame : {motion.frames() / 3, motion.frames() / 2}) {
              PinParams params;
              params.fade = fade;
              params.pins = {{motion.skeleton().joints[end].name, frame, frame + 1,
                              world.position(end)[frame] + d * way}};
              const WorldMotion pinned = world_motion(pin(motion, params, nullptr, work));
              EXPECT_LT(norm(pinned.position(end)[frame] - params.pins[0].position), 1e-9);
              const auto reach = static_cast<std::size_t>(fade * motion.fps()) + 2;
              const std::size_t first = frame > reach ? frame - reach : 0, last = frame + reach;
              double own = 0;
              for (int joint : group)
                own = std::max(own, acceleration(world.position(joint), nullptr, motion.fps(), first, last));
              const double usual = d / (fade * fade);
              for (int joint : group) {
                const auto before = world.position(joint);
                const double added =
                    acceleration(pinned.position(joint), &before, motion.fps(), 0, motion.frames());
                if (joint == end) {
                  EXPECT_LT(added, 8 * usual)
                      << file << " " << params.pins[0].joint << " " << d << " " << fade;
                  worst = std::max(worst, added / usual);
                } else {
                  EXPECT_LT(added, 8 * usual + own)
                      << file << " " << motion.skeleton().joints[joint].name << " " << d << " " << fade;
                  worst_above = std::max(worst_above, added / (8 * usual + own));
                }
              }
            }
      }
    }
    EXPECT_GT(worst, 2);
    RecordProperty(file, std::to_string(worst) + " d/t², above it " + std::to_string(worst_above));
  }
}

// A moving point that is held still for several frames loses its own acceleration there, whatever the pin
// does. What is left to the pin: its offset, which is all that differs from holding the point where it is
// anyhow; and to bring it to rest, from as far away as it is in the fades.
TEST(Pin, AddsLittleMoreThanStandingStillDoesOnMovingClips) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion motion = resampled(cartoon_clip(file, 240), 120, work);
    const WorldMotion world = world_motion(motion);
    double worst_offset = 0, worst_hold = 0;
    for (const auto& group : automatic_groups(motion.skeleton(), small_ends(motion.skeleton()))) {
      if (group.size() < 3) continue;
      const int end = group.back();
      const auto way = world.position(end);
      for (const double fade : {0.25, 0.5})
        for (const std::size_t frames : {2u, 6u, 24u})
          for (std::size_t middle : {motion.frames() / 3, motion.frames() / 2}) {
            PinParams params;
            params.fade = fade;
            const std::size_t start = middle - frames / 2;
            const auto pinned_at = [&](Vec3 position) {
              params.pins = {{motion.skeleton().joints[end].name, start, start + frames, position}};
              return world_motion(pin(motion, params, nullptr, work));
            };
            const WorldMotion still = pinned_at(way[middle]);
            const auto reach = static_cast<std::size_t>(fade * motion.fps()) + 2;
            const std::size_t first = start > reach ? start - reach : 0,
                              last = std::min(start + frames + reach, motion.frames());
            const double own = acceleration(way, nullptr, motion.fps(), first, last);
            const auto check_hold = [&](const WorldMotion& held, Vec3 position) {
              double far = 0;
              for (std::size_t t = first; t < last; ++t) far = std::max(far, norm(position - way[t]));
              const double added = acceleration(held.position(end), &way, motion.fps(), 0, motion.frames());
              const double bound = 8 * far / (fade * fade) + own;
              EXPECT_LT(added, bound) << file << " " << params.pins[0].joint << " " << frames << " " << fade;
              worst_hold = std::max(worst_hold, added / bound);
            };
            check_hold(still, way[middle]);
            for (const double d : {0.05, 0.2})
              for (Vec3 direction : {Vec3{0, 1, 0}, Vec3{0.6, 0, -0.8}}) {
                const WorldMotion held = pinned_at(way[middle] + d * direction);
                for (std::size_t t = start; t < start + frames; ++t)
                  EXPECT_LT(norm(held.position(end)[t] - params.pins[0].position), 1e-9);
                const auto without = still.position(end);
                const double added =
                    acceleration(held.position(end), &without, motion.fps(), 0, motion.frames());
                EXPECT_LT(added, 8 * d / (fade * fade))
                    << file << " " << params.pins[0].joint << " " << d << " " << frames << " " << fade;
                worst_offset = std::max(worst_offset, added / (d / (fade * fade)));
                check_hold(held, params.pins[0].position);
              }
          }
    }
    EXPECT_GT(worst_offset, 5);
    RecordProperty(file, "offset " + std::to_string(worst_offset) + " d/t², hold " +
                             std::to_string(worst_hold) + " of its bound");
  }
}

// A foot or a hand that rests in the clip, through the pin and its fades.
TEST(Pin, AddsLittleAccelerationToPointsThatRestInRealClips) {
  KINEGRAPH_NEEDS_MOCAP();
  int pins = 0;
  double worst = 0;
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion clip = resampled(cartoon_clip(file, 1000), 120, work);
    for (const Motion& motion : {clip, rubber_joints(clip, {}, nullptr, work).motion}) {
      const WorldMotion world = world_motion(motion);
      constexpr double fade = 0.25, d = 0.2;
      constexpr std::size_t around = 32, held = 12;  // frames
      for (const auto& group : automatic_groups(motion.skeleton(), small_ends(motion.skeleton()))) {
        if (group.size() < 3) continue;
        const auto way = world.position(group.back());
        int here = 0;
        for (std::size_t start = around; start + held + around < motion.frames() && here < 2; start += held) {
          double far = 0;
          for (std::size_t t = start - around; t < start + held + around; ++t)
            far = std::max(far, norm(way[t] - way[start]));
          const double own = acceleration(way, nullptr, 120, start - around, start + held + around);
          if (far > 0.03 || own > 7) continue;
          ++here;
          ++pins;
          for (Vec3 direction : {Vec3{0, 1, 0}, Vec3{0.6, 0, -0.8}}) {
            PinParams params;
            params.fade = fade;
            params.pins = {{motion.skeleton().joints[group.back()].name, start, start + held,
                            way[start] + d * direction}};
            const WorldMotion pinned = world_motion(pin(motion, params, nullptr, work));
            const double added = acceleration(pinned.position(group.back()), &way, 120, 0, motion.frames());
            EXPECT_LT(added, 8 * d / (fade * fade)) << file << " " << params.pins[0].joint << " " << start;
            worst = std::max(worst, added / (d / (fade * fade)));
          }
        }
      }
    }
  }
  EXPECT_GT(pins, 1);
  RecordProperty("pins", std::to_string(pins) + ", " + std::to_string(worst) + " d/t²");
}

TEST(BentChain, TurnsItsBendsAlongWithItself) {
  // A chain along x that zigzags in y; its end is carried over so that it ends along y. The zigzag must then
  // lie across the new direction, not along it.
  constexpr std::size_t links = 12;
  std::vector<Vec3> straight, zigzag;
  std::vector<double> places;
  for (std::size_t i = 0; i <= links; ++i) {
    straight.push_back({0.05 * static_cast<double>(i), 0, 0});
    zigzag.push_back(straight[i] + Vec3{0, i % 2 && i > 1 ? 0.01 : 0, 0});
    places.push_back(straight[i].x);
  }
  const std::vector<std::size_t> given{links};
  const Vec3 targets[] = {{0.3, 0.5, 0}};
  const auto weights = bend_weights({places[links]}, places);
  const auto smooth = bent_chain(straight, places, weights, given, targets);
  const auto bent = bent_chain(zigzag, places, weights, given, targets);
  EXPECT_LT(norm(bent[links] - targets[0]), 1e-12);
  EXPECT_EQ(bent[0], zigzag[0]);
  double along = 0, along_if_shifted = 0;
  for (std::size_t i = links / 2; i < links; ++i) {
    const Vec3 direction = normalized(smooth[i + 1] - smooth[i - 1]);
    along += std::fabs(dot(bent[i] - smooth[i], direction));
    along_if_shifted += std::fabs(dot(zigzag[i] - straight[i], direction));
  }
  EXPECT_LT(along, 0.5 * along_if_shifted);
}

TEST(BentChain, StaysWhereItsTargetsAre) {
  std::vector<Vec3> arm{{0, 0, 0}, {0.1, 0, 0}, {0.2, 0.05, 0}, {0.28, 0.12, 0.03}};
  const std::vector<double> places{0, 0.1, 0.21, 0.32};
  const std::vector<std::size_t> given{3};
  const Vec3 targets[] = {arm[3]};
  const auto bent = bent_chain(arm, places, bend_weights({0.32}, places), given, targets);
  for (std::size_t i = 0; i < arm.size(); ++i) EXPECT_LT(norm(bent[i] - arm[i]), 1e-12);
}

TEST(Pin, MeetsItsPointsWithinAMillimetreOnAnyClip) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file : cartoon_clips) {
    Alone work;
    const Motion clip = cartoon_clip(file, 120);
    for (const Motion& motion :
         {clip, rubber_joints(exaggerate(clip, {}, work).motion, {}, nullptr, work).motion}) {
      const WorldMotion before = world_motion(motion);
      // The last joint of every limb of two joints or more.
      for (const auto& group : automatic_groups(motion.skeleton(), small_ends(motion.skeleton()))) {
        if (group.size() < 3) continue;
        const int end = group.back();
        const Vec3 goal = before.position(end)[50] + Vec3{0.1, 0.1, -0.1};
        PinParams params;
        params.pins = {{motion.skeleton().joints[end].name, 40, 60, goal}};
        const WorldMotion after = world_motion(pin(motion, params, nullptr, work));
        for (std::size_t t = 40; t < 60; ++t)
          ASSERT_LT(norm(after.position(end)[t] - goal), 1e-3)
              << file << " " << params.pins[0].joint << " " << t;
      }
    }
  }
}

TEST(Pin, HoldsSeveralJointsOfAChainAndSeveralTimes) {
  Alone work;
  const Motion walk = gait("walk", 4);
  const int hand = walk.skeleton().find("LeftHand"), elbow = walk.skeleton().find("LeftForeArm");
  const WorldMotion before = world_motion(walk);
  const Vec3 a = before.position(hand)[60] + Vec3{0, 0.1, 0},
             b = before.position(elbow)[65] + Vec3{0.05, 0, 0};
  const Vec3 c = before.position(hand)[84] + Vec3{0, 0.2, 0};
  PinParams params;
  params.pins = {{"LeftHand", 55, 70, a}, {"LeftForeArm", 62, 75, b}, {"LeftHand", 78, 90, c}};
  const WorldMotion after = world_motion(pin(walk, params, nullptr, work));
  for (std::size_t t = 55; t < 90; ++t) {
    if (t < 70) {
      EXPECT_LT(norm(after.position(hand)[t] - a), 1e-9) << t;
    }
    if (t >= 62 && t < 75) {
      EXPECT_LT(norm(after.position(elbow)[t] - b), 1e-9) << t;
    }
    if (t >= 78) {
      EXPECT_LT(norm(after.position(hand)[t] - c), 1e-9) << t;
    }
  }
}

TEST(Pin, HoldsPlantedFeetThatExaggerationMoved) {
  Alone work;
  const Motion walk = gait("walk", 3);
  const Contacts contacts = detect_contacts(walk, {}, work);
  const Motion wild = exaggerate(walk, {}, work).motion;
  const WorldMotion slid = world_motion(wild), held = world_motion(pin(wild, {{}, 0.15}, &contacts, work));
  double before = 0, after = 0;
  for (const FootPoint& point : contacts.points)
    for (std::size_t t = 1; t < walk.frames(); ++t)
      if (point.planted[t] && point.planted[t - 1]) {
        before = std::max(before, norm(point_at(slid, point.joint, point.local, t) -
                                       point_at(slid, point.joint, point.local, t - 1)));
        after = std::max(after, norm(point_at(held, point.joint, point.local, t) -
                                     point_at(held, point.joint, point.local, t - 1)));
      }
  EXPECT_GT(before, 0.005);
  EXPECT_LT(after, 1e-9);
}

TEST(Pin, PutsPlantedFeetBackOnTheGround) {
  Alone work;
  const Motion run = gait("run", 2);
  const Contacts contacts = detect_contacts(run, {}, work);
  const auto highest = [&](const Contacts& given) {
    const Motion rubber = rubber_joints(exaggerate(run, {}, work).motion, {}, &given, work).motion;
    const WorldMotion held = world_motion(pin(rubber, {{}, 0.15}, &given, work));
    double most = 0;
    for (const FootPoint& point : contacts.points) {
      const int joint = rubber.skeleton().find(point.joint_name);
      const auto runs = runs_of(point.planted);
      for (std::size_t r = 0; r < runs.size(); ++r)
        for (std::size_t t = runs[r].start; t < runs[r].end; ++t)
          most = std::max(most, std::fabs(point_at(held, joint, point.local, t).y - point.heights[r]));
    }
    return most;
  };
  EXPECT_LT(highest(contacts), 1e-9);
  // Of another body's contacts only the frames count.
  Contacts shorter = contacts;
  shorter.leg *= 0.8;
  EXPECT_GT(highest(shorter), 0.01);
}

TEST(Pin, KeepsSwingingFeetAboveTheGround) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Motion dance = cartoon_clip("cmu/bvh/05_03.bvh", 434);
  const Contacts contacts = detect_contacts(dance, {}, work);
  ExaggerateParams params;
  params.omega = 4;
  params.keep_root = true;
  const Motion rubber = rubber_joints(exaggerate(dance, params, work).motion, {}, &contacts, work).motion;
  Contacts unknown = contacts;
  unknown.leg = 0;  // so the height of the ground isn't known
  const auto lowest = [&](const Motion& motion) {
    const WorldMotion world = world_motion(motion);
    double least = 0;
    for (const FootPoint& point : contacts.points) {
      if (point.heights.empty()) continue;
      const int joint = motion.skeleton().find(point.joint_name);
      const double ground = *std::min_element(point.heights.begin(), point.heights.end());
      for (std::size_t t = 0; t < motion.frames(); ++t)
        least = std::min(least, point_at(world, joint, point.local, t).y - ground);
    }
    return least;
  };
  EXPECT_LT(lowest(pin(rubber, {{}, 0.15}, &unknown, work)), -0.1);
  EXPECT_GT(lowest(pin(rubber, {{}, 0.15}, &contacts, work)), -0.025 * contacts.leg);
}

TEST(Pin, LeavesArmsOnATorsoThatIsPinnedWithThem) {
  Alone work;
  const Motion walk = gait("walk", 3);
  const WorldMotion before = world_motion(walk);
  const auto joint = [&](const char* name) { return walk.skeleton().find(name); };
  const Vec3 chest = before.position(joint("Spine1"))[70] + Vec3{0.2, 0.1, -0.15};
  const Vec3 goal = chest + (before.position(joint("LeftHand"))[67] - before.position(joint("Spine1"))[67]) +
                    Vec3{0.1, 0.1, 0.1};
  PinParams params;
  params.pins = {{"Spine1", 60, 90, chest}, {"LeftHand", 65, 70, goal}};
  const Motion out = pin(walk, params, nullptr, work);
  const WorldMotion after = world_motion(out);
  for (std::size_t t = 60; t < 90; ++t) {
    EXPECT_LT(norm(after.position(joint("Spine1"))[t] - chest), 1e-9);
    if (t >= 65 && t < 70) {
      EXPECT_LT(norm(after.position(joint("LeftHand"))[t] - goal), 1e-9);
    }
    // Shoulders, neck and the other hand ride on the chest.
    for (const char* rider : {"LeftShoulder", "RightShoulder", "Neck", "RightHand"})
      EXPECT_LT(norm((after.position(joint(rider))[t] - chest) -
                     (before.position(joint(rider))[t] - before.position(joint("Spine1"))[t])),
                1e-9)
          << rider << " " << t;
  }
  // A hand that is pinned at another time changes nothing of that.
  params.pins[1] = {"LeftHand", 150, 160, goal};
  EXPECT_LT(norm((world_motion(pin(walk, params, nullptr, work)).position(joint("LeftHand"))[75] - chest) -
                 (before.position(joint("LeftHand"))[75] - before.position(joint("Spine1"))[75])),
            1e-9);
}

TEST(Pin, PutsFingersOfOneHandWhereTheyShallBe) {
  Alone work;
  Motion walk = gait("walk", 1);
  auto skeleton = std::make_shared<Skeleton>(walk.skeleton());
  const int hand = skeleton->find("LeftHand");
  for (const char* finger : {"LeftHandThumb", "LeftHandPinky"}) {
    skeleton->joints.push_back({std::string(finger) + "1", hand, {0.02, 0.01, 0.03}, {}});
    skeleton->joints.push_back({std::string(finger) + "2", skeleton->size() - 1, {0.04, 0, 0}, {}});
  }
  std::vector<bool> translates(skeleton->joints.size());
  translates[0] = true;
  Motion hands(skeleton, std::make_shared<SourceFacts>(), walk.fps(), walk.frames(), translates);
  for (int j = 0; j < walk.joints(); ++j)
    for (std::size_t t = 0; t < walk.frames(); ++t) hands.rotation(j).set(t, walk.rotation(j)[t]);
  for (std::size_t t = 0; t < walk.frames(); ++t) hands.translation(0).set(t, walk.translation(0)[t]);

  const WorldMotion before = world_motion(hands);
  const auto pinned = [&](const char* joint, Vec3 by) {
    return PinnedJoint{joint, 50, 60, before.position(skeleton->find(joint))[55] + by};
  };
  PinParams params;
  params.pins = {pinned("LeftHandThumb2", {0, 0.03, 0}), pinned("LeftHandPinky2", {0, 0.02, 0}),
                 pinned("LeftHand", {0, 0.1, 0})};
  const WorldMotion after = world_motion(pin(hands, params, nullptr, work));
  for (const PinnedJoint& one : params.pins)
    for (std::size_t t = 50; t < 60; ++t)
      EXPECT_LT(norm(after.position(skeleton->find(one.joint))[t] - one.position), 1e-9) << one.joint;

  params.pins = {pinned("LeftHandThumb1", {0, 0.1, 0}), pinned("LeftHandPinky1", {0, 0.1, 0})};
  try {
    pin(hands, params, nullptr, work);
    ADD_FAILURE() << "two joints of one parent were pinned";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "pins-apart");
    EXPECT_THAT(failure.diagnostic().message,
                testing::AllOf(testing::HasSubstr("LeftHandThumb1"), testing::HasSubstr("LeftHandPinky1")));
  }
  params.pins.pop_back();  // one finger alone takes the arm with it
  EXPECT_LT(norm(world_motion(pin(hands, params, nullptr, work)).position(hand)[55] -
                 (before.position(hand)[55] +
                  (params.pins[0].position - before.position(skeleton->find("LeftHandThumb1"))[55]))),
            0.1);
}

TEST(PinNode, SaysWhichContactsHoldNothing) {
  const Motion walk = gait("walk", 1);
  Alone work;
  Contacts contacts = detect_contacts(walk, {}, work);
  for (FootPoint& point : contacts.points) point.planted.assign(walk.frames(), true);
  const auto run = [&](const Contacts& given) {
    NodeInMemory node(pin_node());
    node.link("motion", walk).link("contacts", given).run();
    std::string said;
    for (const Diagnostic& d : node.reported()) said += d.code + " " + d.port + " " + d.message + "; ";
    return said;
  };
  const auto refusal = [&](const Contacts& given) {
    const Diagnostic d = NodeInMemory(pin_node()).link("motion", walk).link("contacts", given).refusal();
    return d.code + " " + d.port;
  };
  EXPECT_EQ(run(contacts), "");
  Contacts some = contacts, none = contacts, slow = contacts, chainless = contacts;
  some.points[1].joint_name = "ltoes";
  EXPECT_THAT(run(some), testing::AllOf(testing::StartsWith("no-partner contacts"),
                                        testing::HasSubstr("1 of the 4"), testing::HasSubstr("ltoes")));
  for (FootPoint& point : none.points) point.joint_name = "l" + point.part;
  EXPECT_EQ(refusal(none), "no-common-joint contacts");
  slow.fps = 30;
  EXPECT_EQ(refusal(slow), "rate-mismatch contacts");
  chainless.points[0].joint_name = "LeftUpLeg";
  EXPECT_THAT(run(chainless), testing::StartsWith("no-chain contacts"));
}

TEST(Pin, StandsBetweenHeelAndBallOfAFootWithoutToes) {
  Alone work;
  const Motion walk = gait("walk", 2);
  Contacts contacts = detect_contacts(walk, {}, work);
  for (FootPoint& point : contacts.points) {
    point.joint_name = point.foot;
    point.planted.assign(walk.frames(), false);
    for (std::size_t t = point.part == "heel" ? 20 : 30; t < (point.part == "heel" ? 60 : 80); ++t)
      point.planted[t] = true;
  }
  EXPECT_NO_THROW(pin(walk, {}, &contacts, work));
}

TEST(Pin, ChangesNothingWithoutPins) {
  Alone work;
  const Motion walk = gait("walk", 1);
  EXPECT_LT(difference(pin(walk, {}, nullptr, work), walk).turn, 1e-15);
}

TEST(PinNode, WarnsOfAPinFarBeyondReach) {
  const Motion walk = gait("walk", 1);
  const auto said = [&](double height) {
    const Json position(Json::Array{Json(0), Json(height), Json(0)});
    const Json pins(Json::Array{Json(Json::Object{{"joint", Json("LeftHand")},
                                                  {"range", Json(Json::Array{Json(40), Json(60)})},
                                                  {"position", position}})});
    NodeInMemory node(pin_node());
    node.link("motion", walk).set("pins", pins).run();
    std::string all;
    for (const Diagnostic& d : node.reported()) all += d.code + " " + d.param + " " + d.joint;
    return all;
  };
  EXPECT_EQ(said(1.7), "");
  EXPECT_THAT(said(8), testing::StartsWith("stretched-link pins[0] Left"));
}

TEST(PinNode, NamesWhatIsWrongWithAPin) {
  const Motion walk = gait("walk", 1);
  const auto refusal = [&](std::string joint, double start, double end) {
    const Json position(Json::Array{Json(0), Json(1), Json(0)});
    Json::Object entry{
        {"joint", Json(joint)}, {"range", Json(Json::Array{Json(start), Json(end)})}, {"position", position}};
    Json::Array pins{Json(entry)};
    if (joint == "twice") {
      pins[0] = Json(Json::Object{{"joint", Json("LeftHand")},
                                  {"range", Json(Json::Array{Json(start), Json(end)})},
                                  {"position", position}});
      pins.push_back(pins[0]);
    }
    const Diagnostic d = NodeInMemory(pin_node()).link("motion", walk).set("pins", Json(pins)).refusal();
    return d.code + " " + d.param;
  };
  EXPECT_EQ(refusal("LeftHond", 10, 20), "unknown-joint pins[0]");
  EXPECT_EQ(refusal("LeftHand", 10, 2000), "bad-range pins[0]");
  EXPECT_EQ(refusal("Hips", 10, 20), "no-chain pins[0]");
  EXPECT_EQ(refusal("twice", 10, 20), "pins-overlap pins[1]");
}

}  // namespace
}  // namespace kinegraph
