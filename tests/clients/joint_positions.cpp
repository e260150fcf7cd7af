// World positions of every joint and frame of a motion file as Kinegraph reads it, in the form of the scripts
// that ask Blender and three.js the same, for tests/clients/run:
//
//   joint_positions FILE OUT.json [FIRST LAST [FPS]]
//   joint_positions FILE OUT.json --vertices EVERY      also of the vertices of its character, every so many
//   frames
//
// OUT.json: {"joints": [names], "frames": n, "fps": f, "positions": [frame][joint][x, y, z], "height": h,
// "unit": u, "offset_and_position": b, "vertices": {frame: [[x, y, z]]}}, lengths in the file's own unit of u
// metres. b: a joint has both an OFFSET and position channels, which three.js adds up.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "nodes/files/motion_file.h"
#include "nodes/motion/character.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

bool has_offset_and_position(const BvhJoint& joint) {
  const bool moves = std::any_of(joint.channels.begin(), joint.channels.end(),
                                 [](const std::string& channel) { return channel.ends_with("position"); });
  return moves && norm(joint.offset) > 0;
}

// Of the joints in the first frame: some files' rest poses are degenerate.
double height_of(const WorldMotion& world) {
  double low = world.position(0)[0].y, high = low;
  for (int joint = 1; joint < world.joints(); ++joint) {
    low = std::min(low, world.position(joint)[0].y);
    high = std::max(high, world.position(joint)[0].y);
  }
  return high - low;
}

nlohmann::json positions_of(const Motion& motion) {
  const WorldMotion world = world_motion(motion);
  const double unit = motion.source().unit;
  auto joints = nlohmann::json::array(), frames = nlohmann::json::array();
  for (const Joint& joint : motion.skeleton().joints) joints.push_back(joint.name);
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    auto frame = nlohmann::json::array();
    for (int joint = 0; joint < motion.joints(); ++joint) {
      const Vec3 p = world.position(joint)[t];
      frame.push_back({p.x / unit, p.y / unit, p.z / unit});
    }
    frames.push_back(std::move(frame));
  }
  const auto& bvh = motion.source().bvh;
  return {{"joints", joints},
          {"frames", motion.frames()},
          {"fps", motion.fps()},
          {"positions", frames},
          {"height", std::max(height_of(world), rest_height(motion.skeleton())) / unit},
          {"unit", unit},
          {"offset_and_position", std::any_of(bvh.begin(), bvh.end(), has_offset_and_position)}};
}

nlohmann::json vertices_of(const Motion& motion, const Character& character, std::size_t every) {
  auto frames = nlohmann::json::object();
  for (std::size_t t = 0; t < motion.frames(); t += every) {
    auto& all = frames[std::to_string(t)] = nlohmann::json::array();
    const Pose pose = pose_for(character, motion, t);
    const auto morphs = morph_weights_at(character, t);
    for (std::size_t i = 0; i < character.parts.size(); ++i)
      for (Vec3 p : posed_vertices(character, character.parts[i], pose, morphs[i])) {
        p = p / motion.source().unit;
        all.push_back({p.x, p.y, p.z});
      }
  }
  return frames;
}

double height_of(const nlohmann::json& points) {
  double low = points[0][1], high = low;
  for (const auto& p : points) {
    low = std::min(low, p[1].get<double>());
    high = std::max(high, p[1].get<double>());
  }
  return high - low;
}

}  // namespace
}  // namespace kinegraph

int main(int argc, char** argv) {
  using namespace kinegraph;
  if (argc < 3) {
    std::cerr << "usage: joint_positions FILE OUT.json [FIRST LAST [FPS]]\n";
    return 2;
  }
  try {
    ReadOptions options;
    const std::size_t every = argc > 4 && std::string(argv[3]) == "--vertices" ? std::atoll(argv[4]) : 0;
    if (argc > 4 && every == 0) options.range = {std::atoll(argv[3]), std::atoll(argv[4])};
    if (argc > 5) options.fps = std::atof(argv[5]);
    PlainFiles files;
    Alone work;
    const MotionFile file = read_motion_file(std::filesystem::absolute(argv[1]), options, files, work);
    if (!file.motion()) throw Failure(error("no-motion", "no motion in " + std::string(argv[1])));
    nlohmann::json out = positions_of(*file.motion());
    if (const auto* character = dynamic_cast<const Character*>(file.find("character"));
        character && every > 0) {
      out["vertices"] = vertices_of(*file.motion(), *character, every);
      if (out["height"] == 0) out["height"] = height_of(out["vertices"]["0"]);
    }
    std::ofstream(argv[2]) << out;
  } catch (const Failure& problem) {
    std::cerr << problem.what() << "\n";
    return 1;
  }
}
