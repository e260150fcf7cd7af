// glTF as people have it: the collection's files, and small ones made here.
#include "nodes/files/gltf_read.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "nodes/files/gltf_file.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/kinematics.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

MotionFile load(const std::string& path, ReadOptions options, Alone& work) {
  PlainFiles files;
  return read_motion_file(mocap(path), options, files, work);
}

const Character& character_of(const MotionFile& file) {
  return dynamic_cast<const Character&>(*file.find("character"));
}

TEST(GltfFiles, OfTheCollectionHoldTheirMeshes) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const auto& [name, parts] : {std::pair{"gltf/CesiumMan.glb", 1},
                                    {"gltf/Fox.glb", 1},
                                    {"gltf/KayKit_Knight.glb", 15},
                                    {"gltf/RiggedFigure.glb", 1},
                                    {"gltf/RiggedSimple.glb", 1},
                                    {"gltf/SimpleSkin.gltf", 1},
                                    {"gltf/rig_transfer_from_bvh.glb", 1}}) {
    Alone work;
    const MotionFile file = load(name, {}, work);
    EXPECT_EQ(int(character_of(file).parts.size()), parts) << name;
  }
}

TEST(GltfFiles, PutTheirSkinsOnTheirSkeletons) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* name :
       {"gltf/CesiumMan.glb", "gltf/Fox.glb", "gltf/KayKit_Knight.glb", "gltf/rig_transfer_from_bvh.glb"}) {
    SCOPED_TRACE(name);
    Alone work;
    const MotionFile file = load(name, {}, work);
    const Character& character = character_of(file);
    const double height = rest_height(*character.skeleton);
    for (std::size_t frame : {std::size_t{0}, file.motion()->frames() / 2}) {
      const Pose pose = pose_for(character, *file.motion(), frame);
      double farthest = 0;
      for (const MeshPart& part : character.parts) {
        if (part.skin < 0) continue;
        for (Vec3 vertex : posed_vertices(character, part, pose)) {
          double nearest = 1e9;
          for (Vec3 joint : pose.positions) nearest = std::min(nearest, norm(vertex - joint));
          farthest = std::max(farthest, nearest);
        }
      }
      EXPECT_LT(farthest, 0.9 * height) << frame;  // the knight's head is as big as his body
    }
  }
}

TEST(GltfFiles, GiveTheClipThatIsNamedOrNumbered) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  ReadOptions options;
  options.clip = "Walk";
  const MotionFile walk = load("gltf/Fox.glb", options, work);
  options.clip = "1";
  const MotionFile second = load("gltf/Fox.glb", options, work);
  EXPECT_EQ(walk.motion()->frames(), second.motion()->frames());
  EXPECT_EQ(walk.motion()->rotation(5)[3], second.motion()->rotation(5)[3]);
  options.clip = "Wlak";
  try {
    load("gltf/Fox.glb", options, work);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "unknown-clip");
    EXPECT_NE(failure.diagnostic().hint.find("Walk"), std::string::npos);
  }
}

TEST(GltfFiles, AreScaledByTheUnitSkinAndAll) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  ReadOptions options;
  options.unit = "cmu";
  const MotionFile file = load("gltf/rig_transfer_from_bvh.glb", options, work);
  const Character& character = character_of(file);
  EXPECT_NEAR(rest_height(*character.skeleton), 23.6 * 0.0254 / 0.45, 0.01);
  double low = 1e9, high = -1e9;
  for (Vec3 vertex : posed_vertices(character, character.parts[0], pose_for(character, *file.motion(), 0))) {
    low = std::min(low, vertex.y);
    high = std::max(high, vertex.y);
  }
  EXPECT_NEAR(high - low, 1.6, 0.25);
}

// A chain of two joints under a scaled matrix node, in text, its buffer beside it; `animation` in JSON.
struct SmallGltf {
  std::string binary;
  std::string accessors, views;
  int count = 0;
  int add(const std::vector<float>& values, const char* type, int width) {
    const std::size_t at = binary.size();
    for (float value : values) {
      char bytes[4];
      std::memcpy(bytes, &value, 4);
      binary.append(bytes, 4);
    }
    const std::string comma = count ? "," : "";
    views += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(at) +
             ",\"byteLength\":" + std::to_string(4 * values.size()) + "}";
    accessors += comma + "{\"bufferView\":" + std::to_string(count) +
                 ",\"componentType\":5126,\"count\":" + std::to_string(values.size() / std::size_t(width)) +
                 ",\"type\":\"" + type + "\"}";
    return count++;
  }
  std::string json(const std::string& animation) const {
    return "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":["
           "{\"name\":\"arm\",\"children\":[1],\"matrix\":[0.5,0,0,0, 0,0,-0.5,0, 0,0.5,0,0, 1,2,3,1]},"
           "{\"name\":\"hip\",\"children\":[2],\"translation\":[0,0,2]},"
           "{\"name\":\"knee\",\"translation\":[4,0,0]}],"
           "\"animations\":[" +
           animation +
           "],\"buffers\":[{\"uri\":\"a%20b.bin\",\"byteLength\":" + std::to_string(binary.size()) +
           "}],\"bufferViews\":[" + views + "],\"accessors\":[" + accessors + "]}";
  }
  GltfContents read(const std::string& animation, ReadOptions options = {}) const {
    PlainFiles files;
    files.made["/x/a b.bin"] = binary;
    Alone work;
    return read_gltf(json(animation), "/x/a.gltf", options, files, work);
  }
};

std::string clip(const char* interpolation, const char* path, int node, int input, int output) {
  return std::string("{\"channels\":[{\"sampler\":0,\"target\":{\"node\":") + std::to_string(node) +
         ",\"path\":\"" + path + "\"}}],\"samplers\":[{\"interpolation\":\"" + interpolation +
         "\",\"input\":" + std::to_string(input) + ",\"output\":" + std::to_string(output) + "}]}";
}

TEST(Gltf, PutsWhatStandsAboveTheRootIntoTheSkeleton) {
  SmallGltf gltf;
  const int times = gltf.add({0, 0.5f}, "SCALAR", 1);
  const int turns = gltf.add({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4", 4);
  const std::string animation =
      "{\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"rotation\"}},"
      "{\"sampler\":0,\"target\":{\"node\":2,\"path\":\"rotation\"}}],\"samplers\":[{"
      "\"input\":" +
      std::to_string(times) + ",\"output\":" + std::to_string(turns) + "}]}";
  const GltfContents read = gltf.read(animation);
  ASSERT_EQ(read.motion.joints(), 2);
  EXPECT_EQ(read.companions, std::vector<std::string>{"/x/a b.bin"});
  EXPECT_EQ(read.character, nullptr);
  const Pose pose = pose_at(read.motion, 0);
  EXPECT_NEAR(norm(pose.positions[0] - Vec3{1, 3, 3}), 0, 1e-12);  // Z of the file is Y here, halved
  EXPECT_NEAR(norm(pose.positions[1] - Vec3{3, 3, 3}), 0, 1e-12);
  EXPECT_EQ(read.motion.frames(), 13u);
  EXPECT_NEAR(turn(read.motion.rotation(1)[6], {}), std::acos(-1.0) / 2, 1e-6);  // half of a half turn
}

TEST(Gltf, SamplesStepLinearAndCubicSplines) {
  SmallGltf gltf;
  const int times = gltf.add({0.25f, 1.25f}, "SCALAR", 1);
  const int places = gltf.add({0, 0, 0, 8, 0, 0}, "VEC3", 3);
  const int cubic = gltf.add({9, 9, 9, 0, 0, 0, 8, 0, 0, 0, 0, 0, 8, 0, 0, 9, 9, 9}, "VEC3", 3);
  const std::string step = clip("STEP", "translation", 2, times, places),
                    linear = clip("LINEAR", "translation", 2, times, places),
                    spline = clip("CUBICSPLINE", "translation", 2, times, cubic);
  // The only moving node is the knee: it is the root then, and `hip` stands above it.
  auto root_x = [&](const std::string& animation, double time) {
    const GltfContents read = gltf.read(animation);
    EXPECT_EQ(read.motion.joints(), 1);
    return read.motion.translation(0).x[static_cast<std::size_t>(time * read.motion.fps() + 0.5)];
  };
  EXPECT_NEAR(root_x(step, 1.0), 0, 1e-12);
  EXPECT_NEAR(root_x(step, 1.25), 4, 1e-12);
  EXPECT_NEAR(root_x(linear, 0), 0, 1e-12);  // before the first key: its value
  EXPECT_NEAR(root_x(linear, 0.5), 1, 1e-7);
  // p0 = 0, m0 = 8, p1 = 8, m1 = 0 at u = 1/2: (u³ - 2u² + u) 8 + (3u² - 2u³) 8 = 1 + 4, halved
  EXPECT_NEAR(root_x(spline, 0.75), 2.5, 1e-7);
}

TEST(Gltf, WithAStrayKeyFarOffIsReadOnlyInTheRangeThatIsAskedFor) {
  SmallGltf gltf;
  const int times = gltf.add({0, 1e6f}, "SCALAR", 1);
  const std::string far = clip("LINEAR", "translation", 2, times, gltf.add({0, 0, 0, 8, 0, 0}, "VEC3", 3));
  try {
    gltf.read(far);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "too-long");
    EXPECT_EQ(failure.diagnostic().param, "range");
  }
  ReadOptions options;
  options.range = {0, 100};
  EXPECT_EQ(gltf.read(far, options).motion.frames(), 100u);
}

TEST(Gltf, FollowsSparseEntriesAndStridesAndNormalisedNumbers) {
  std::string binary(64, '\0');
  auto put = [&](std::size_t at, auto value) { std::memcpy(binary.data() + at, &value, sizeof value); };
  // Three vec2 of normalised int16 with a stride of 8, the second replaced by a sparse entry.
  put(0, std::int16_t{32767}), put(2, std::int16_t{-32768}), put(8, std::int16_t{1}),
      put(16, std::int16_t{0});
  put(32, std::uint8_t{1});
  put(36, std::int16_t{-32767}), put(38, std::int16_t{32767});
  const std::string json =
      "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}],\"buffers\":[{\"uri\":\"b.bin\",\"byteLength\":64}],"
      "\"bufferViews\":[{\"buffer\":0,\"byteLength\":24,\"byteStride\":8},{\"buffer\":0,\"byteOffset\":32,"
      "\"byteLength\":1},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":4}],\"accessors\":[{\"bufferView\":0,"
      "\"componentType\":5122,\"normalized\":true,\"count\":3,\"type\":\"VEC2\",\"sparse\":{\"count\":1,"
      "\"indices\":{\"bufferView\":1,\"componentType\":5121},\"values\":{\"bufferView\":2}}},"
      "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}]}";
  PlainFiles files;
  files.made["/b.bin"] = binary;
  const GltfFile file = read_gltf_file(json, "/a.gltf", files);
  EXPECT_EQ(gltf_numbers(file, 0, 2), (std::vector<double>{1, -1, -1, 1, 0, 0}));
  EXPECT_THROW(gltf_numbers(file, 0, 3), Failure);
  EXPECT_THROW(gltf_numbers(file, 1, 4), Failure);  // leads out of its view
  EXPECT_THROW(gltf_numbers(file, 2, 4), Failure);
}

TEST(Gltf, IsRefusedOrReadWhereItIsDamaged) {
  KINEGRAPH_NEEDS_MOCAP();
  PlainFiles files;
  Alone work;
  for (const char* name : {"gltf/RiggedSimple.glb", "gltf/SimpleSkin.gltf"}) {
    const std::string whole = *files.read(mocap(name));
    auto attempt = [&](const std::string& bytes) {
      try {
        read_gltf(bytes, "/a.glb", {}, files, work);
      } catch (const Failure&) {
      }
    };
    for (std::size_t cut = 0; cut < whole.size(); cut += 97) attempt(whole.substr(0, cut));
    for (std::size_t at = 0; at < whole.size(); at += 17) {
      std::string wrong = whole;
      wrong[at] = static_cast<char>(wrong[at] ^ (at % 2 ? 0x01 : 0x92));
      attempt(wrong);
    }
  }
}

TEST(Gltf, TellsThatItHasMoreClipsThanTheOneThatIsRead) {
  KINEGRAPH_NEEDS_MOCAP();
  const auto told = [](const char* path, const char* clip) {
    PlainFiles files;
    Alone work;
    ReadOptions options;
    options.clip = clip;
    read_motion_file(mocap(path), options, files, work);
    std::string all;
    for (const Diagnostic& one : work.reported)
      if (one.code == "clips") all += one.message;
    return all;
  };
  EXPECT_EQ(told("gltf/Fox.glb", ""), "the file has 3 clips, of which the first is read: Survey, Walk, Run");
  EXPECT_EQ(told("gltf/Fox.glb", "Walk"), "");
  EXPECT_EQ(told("gltf/CesiumMan.glb", ""), "");
}

}  // namespace
}  // namespace kinegraph
