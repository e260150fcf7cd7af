// What a retargeted motion is held to, measured from world positions and orientations alone.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "nodes/feet/detect_contacts.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

// What each joint is on a body ("thigh.l") to its name in a skeleton.
using JointRoles = std::map<std::string, std::string>;

// Links that joints turn, as roles from and to, in chains: where a skeleton lacks one in the middle, the link
// goes to the next. Not among them: held_links().
inline std::vector<std::vector<std::string>> link_chains() {
  std::vector<std::vector<std::string>> chains = {
      {"spine.1", "spine.2", "spine.3", "neck.1", "neck.2", "head"}};
  for (const char* side : {".l", ".r"}) {
    const auto of = [&](const char* role) { return std::string(role) + side; };
    chains.push_back({of("clavicle"), of("arm"), of("forearm"), of("hand")});
    chains.push_back({of("thigh"), of("shin"), of("foot")});
  }
  return chains;
}

// Links that have no direction of their own: a joint with several, such as the pelvis, holds them at fixed
// angles; and feet, whose soles are held to the ground. First what they are of, then their ends, of which a
// body may lack the first.
inline std::vector<std::pair<std::string, std::vector<std::string>>> held_links() {
  std::vector<std::pair<std::string, std::vector<std::string>>> links = {{"pelvis", {"spine.1"}}};
  for (const char* side : {".l", ".r"}) {
    const auto of = [&](const char* role) { return std::string(role) + side; };
    links.push_back({"pelvis", {of("thigh")}});
    links.push_back({"spine.3", {of("clavicle"), of("arm")}});
    links.push_back({of("foot"), {of("toe")}});
  }
  return links;
}

struct LinkErrors {
  double direction = 0, twist = 0;  // largest, degrees
  std::string worst_direction, worst_twist;
  int links = 0;
  // Of held links: by how much their difference from the source's, as its joint sees it, changes in the clip.
  double held_direction = 0;
  std::string worst_held;
  int held = 0;
};

// Directions in every frame; and of turns since frame 0, what the target turns otherwise about its link.
inline LinkErrors link_errors(const Motion& source, const JointRoles& source_roles, const Motion& target,
                              const JointRoles& target_roles) {
  const WorldMotion a = world_motion(source), b = world_motion(target);
  LinkErrors out;
  for (const auto& chain : link_chains()) {
    std::vector<std::string> both;
    for (const std::string& role : chain)
      if (source_roles.count(role) && target_roles.count(role)) both.push_back(role);
    for (std::size_t k = 0; k + 1 < both.size(); ++k) {
      const int ja = source.skeleton().find(source_roles.at(both[k]));
      const int ka = source.skeleton().find(source_roles.at(both[k + 1]));
      const int jb = target.skeleton().find(target_roles.at(both[k]));
      const int kb = target.skeleton().find(target_roles.at(both[k + 1]));
      EXPECT_TRUE(ja >= 0 && ka >= 0 && jb >= 0 && kb >= 0) << both[k];
      const auto way_a = [&](std::size_t t) { return a.position(ka)[t] - a.position(ja)[t]; };
      const auto way_b = [&](std::size_t t) { return b.position(kb)[t] - b.position(jb)[t]; };
      if (norm(way_a(0)) < 1e-6 || norm(way_b(0)) < 1e-6) continue;
      ++out.links;
      for (std::size_t t = 0; t < source.frames(); ++t) {
        const Vec3 u = normalized(way_a(t)), v = normalized(way_b(t));
        const double direction = std::atan2(norm(cross(u, v)), dot(u, v)) * degrees_per_radian;
        if (direction > out.direction) {
          out.direction = direction;
          out.worst_direction = both[k];
        }
        const Quat turned_a = a.orientation(ja)[t] * inverse(a.orientation(ja)[0]);
        const Quat turned_b = b.orientation(jb)[t] * inverse(b.orientation(jb)[0]);
        const double twist = turn(twist_about(turned_b * inverse(turned_a), v)) * degrees_per_radian;
        if (twist > out.twist) {
          out.twist = twist;
          out.worst_twist = both[k];
        }
      }
    }
  }
  for (const auto& [from, ends] : held_links())
    for (const std::string& to : ends) {
      if (!source_roles.count(from) || !source_roles.count(to)) continue;
      if (!target_roles.count(from) || !target_roles.count(to)) continue;
      const int ja = source.skeleton().find(source_roles.at(from));
      const int jb = target.skeleton().find(target_roles.at(from));
      const int kb = target.skeleton().find(target_roles.at(to));
      EXPECT_TRUE(ja >= 0 && jb >= 0 && kb >= 0) << from << " " << to;
      const auto seen = [&](std::size_t t) {
        return rotate(inverse(a.orientation(ja)[t]), b.position(kb)[t] - b.position(jb)[t]);
      };
      ++out.held;
      for (std::size_t t = 1; t < source.frames() && norm(seen(0)) > 1e-6; ++t) {
        const double changed = turn(smallest_turn(seen(0), seen(t))) * degrees_per_radian;
        if (changed > out.held_direction) {
          out.held_direction = changed;
          out.worst_held = from + " to " + to;
        }
      }
      break;
    }
  return out;
}

struct FootErrors {
  double skate = 0;       // m/s, mean horizontal speed of heels and balls where the source has them planted
  double largest = 0;     // m/s, the same of the worst plant
  double off_ground = 0;  // m, largest of plants' mean heights against the usual of their part
  int plants = 0;
};

inline FootErrors foot_errors(const Motion& target, const Contacts& of_source) {
  const WorldMotion world = world_motion(target);
  FootErrors out;
  double sum = 0, steps = 0;
  std::map<std::string, std::vector<double>> heights;
  for (const FootPoint& point : of_source.points) {
    for (const Leg& leg : find_legs(target.skeleton())) {
      if (leg.left != point.left) continue;
      const bool heel = point.part == "heel";
      if (!heel && leg.toe < 0) continue;
      const int joint = heel ? leg.ankle : leg.toe;
      for (const Run& run : runs_of(point.planted)) {
        double own = 0, height = 0;
        for (std::size_t t = run.start; t < run.end; ++t) {
          height += world.position(joint)[t].y;
          if (t == run.start) continue;
          const Vec3 way = world.position(joint)[t] - world.position(joint)[t - 1];
          own += std::hypot(way.x, way.z) * target.fps();
        }
        const auto length = static_cast<double>(run.end - run.start);
        heights[point.part].push_back(height / length);
        sum += own;
        steps += length - 1;
        if (length > 1) out.largest = std::max(out.largest, own / (length - 1));
        ++out.plants;
      }
    }
  }
  out.skate = steps > 0 ? sum / steps : 0;
  for (auto& [part, all] : heights) {
    std::sort(all.begin(), all.end());
    const double usual = all[all.size() / 2];
    for (double height : all) out.off_ground = std::max(out.off_ground, std::fabs(height - usual));
  }
  return out;
}

}  // namespace kinegraph
