// glTF out: what comes back, what stays untouched, what is repaired, what is built anew.
#include "nodes/files/gltf_write.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "nodes/files/gltf_file.h"
#include "nodes/files/gltf_read.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/kinematics.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

MotionFile load(const std::string& path, Alone& work) {
  PlainFiles files;
  return read_motion_file(mocap(path), {}, files, work);
}
std::shared_ptr<const Character> character_of(const MotionFile& file) {
  for (const FileContent& content : file.contents)
    if (content.port == "character") return std::dynamic_pointer_cast<const Character>(content.value);
  return nullptr;
}

GltfContents again(GltfOut out, Alone& work) {
  PlainFiles files;
  const std::string bytes = out.glb(work);
  // $KINEGRAPH_KEEP_GLB: a folder that what is built here goes to, for Khronos' validator.
  if (const char* keep = std::getenv("KINEGRAPH_KEEP_GLB")) {
    static int number = 0;
    std::ofstream(std::string(keep) + "/built" + std::to_string(number++) + ".glb", std::ios::binary)
        << bytes;
  }
  return read_gltf(bytes, "/x.glb", {}, files, work);
}

void expect_same_motion(const Motion& a, const Motion& b) {
  ASSERT_EQ(a.joints(), b.joints());
  ASSERT_EQ(a.frames(), b.frames());
  EXPECT_EQ(a.fps(), b.fps());
  const WorldMotion wa = world_motion(a), wb = world_motion(b);
  for (int j = 0; j < a.joints(); ++j) {
    EXPECT_EQ(a.skeleton().joints[j].name, b.skeleton().joints[j].name);
    for (std::size_t t = 0; t < a.frames(); ++t) {
      ASSERT_LT(turn(a.rotation(j)[t], b.rotation(j)[t]), 1e-6) << j << " " << t;
      ASSERT_LT(norm(wa.position(j)[t] - wb.position(j)[t]), 1e-5 * (1 + norm(wa.position(j)[t]))) << j;
    }
  }
}

const char* const skinned[] = {
    "gltf/CesiumMan.glb",    "gltf/Fox.glb",         "gltf/KayKit_Knight.glb",        "gltf/RiggedFigure.glb",
    "gltf/RiggedSimple.glb", "gltf/SimpleSkin.gltf", "gltf/rig_transfer_from_bvh.glb"};

TEST(GltfOut, GivesTheSameMotionBackAndLeavesMeshAndSkinUntouched) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* name : skinned) {
    SCOPED_TRACE(name);
    Alone work;
    const MotionFile file = load(name, work);
    const auto character = character_of(file);
    const GltfContents back = again(gltf_of(file.motion(), character.get(), {}, work), work);
    expect_same_motion(*file.motion(), back.motion);
    ASSERT_NE(back.character, nullptr);
    ASSERT_EQ(back.character->parts.size(), character->parts.size());
    for (std::size_t p = 0; p < character->parts.size(); ++p) {
      const MeshPart &was = character->parts[p], &is = back.character->parts[p];
      EXPECT_EQ(was.positions, is.positions);
      EXPECT_EQ(was.normals, is.normals);
      EXPECT_EQ(was.texcoords, is.texcoords);
      EXPECT_EQ(was.triangles, is.triangles);
      EXPECT_EQ(was.joints, is.joints);
      EXPECT_EQ(was.weights, is.weights);
    }
    for (std::size_t s = 0; s < character->skins.size(); ++s)
      EXPECT_EQ(character->skins[s].inverse_bind, back.character->skins[s].inverse_bind);
  }
}

// The bytes of an accessor's bufferView.
std::string view_of(GltfOut& out, const Json& accessor) {
  const Json& one = out.list("accessors")[static_cast<std::size_t>(accessor.number())];
  const Json& view = out.list("bufferViews")[static_cast<std::size_t>(one.find("bufferView")->number())];
  const Json* offset = view.find("byteOffset");
  return out.binary().substr(offset ? static_cast<std::size_t>(offset->number()) : 0,
                             static_cast<std::size_t>(view.find("byteLength")->number()));
}

TEST(GltfOut, LeavesTheBytesOfMeshesAndSkinsUntouchedUnderANewMotion) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* name : skinned) {
    SCOPED_TRACE(name);
    Alone work;
    const MotionFile file = load(name, work);
    const auto character = character_of(file);
    GltfOut out = gltf_of(file.motion(), character.get(), {}, work);
    std::size_t looked_at = 0;
    auto expect_carried = [&](const Json& accessor) {
      const std::string bytes = view_of(out, accessor);
      bool found = false;
      for (const std::string& buffer : character->source->buffers)
        found = found || buffer.find(bytes) != std::string::npos;
      EXPECT_TRUE(found) << "accessor " << accessor.number();
      ++looked_at;
    };
    for (const Json& mesh : out.list("meshes"))
      for (const Json& primitive : mesh.find("primitives")->array()) {
        for (const auto& [attribute, accessor] : primitive.find("attributes")->object())
          expect_carried(accessor);
        if (const Json* indices = primitive.find("indices")) expect_carried(*indices);
      }
    for (const Json& skin : out.list("skins"))
      if (const Json* binds = skin.find("inverseBindMatrices")) expect_carried(*binds);
    EXPECT_GE(looked_at, 4u);
  }
}

TEST(GltfOut, CarriesTheBytesOfBufferViewsAsTheyAre) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const auto character = character_of(load("gltf/Fox.glb", work));
  GltfOut out = gltf_of(nullptr, character.get(), {}, work);
  // Without a motion nothing is dropped: the texture, the mesh and all three clips are there.
  const std::string& was = character->source->buffers[0];
  EXPECT_EQ(out.list("animations").size(), 3u);
  EXPECT_GE(out.binary().size(), was.size() - 16);
  for (const Json& view : out.list("bufferViews")) {
    const auto offset = static_cast<std::size_t>(view.find("byteOffset")->number());
    const auto length = static_cast<std::size_t>(view.find("byteLength")->number());
    EXPECT_NE(was.find(out.binary().substr(offset, length)), std::string::npos);
  }
}

TEST(GltfOut, RepairsWeightsAndPutsSkinnedMeshesAtTheRoot) {
  KINEGRAPH_NEEDS_MOCAP();
  WriteOptions repair;
  repair.repair = true;
  for (const char* name : skinned) {
    SCOPED_TRACE(name);
    Alone work;
    const MotionFile file = load(name, work);
    const auto character = character_of(file);
    const GltfContents back = again(gltf_of(file.motion(), character.get(), repair, work), work);
    expect_same_motion(*file.motion(), back.motion);
    for (const MeshPart& part : back.character->parts) {
      if (part.skin < 0) continue;
      for (std::size_t v = 0; v < part.vertices(); ++v) {
        double sum = 0;
        for (int k = 0; k < part.influences; ++k)
          sum += part.weights[v * static_cast<std::size_t>(part.influences) + static_cast<std::size_t>(k)];
        ASSERT_NEAR(sum, 1, 1e-6);
      }
    }
  }
}

TEST(GltfOut, BindsAnewWhereTheSkeletonHasChanged) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* name : skinned) {
    SCOPED_TRACE(name);
    Alone work;
    const MotionFile file = load(name, work);
    Character changed = *character_of(file);
    changed.rebound = true;
    const GltfContents back = again(gltf_of(file.motion(), &changed, {}, work), work);
    expect_same_motion(*file.motion(), back.motion);
    ASSERT_EQ(back.character->parts.size(), changed.parts.size());
    const std::size_t t = file.motion()->frames() / 2;
    const Pose pose = pose_at(*file.motion(), t), now = pose_at(back.motion, t);
    for (std::size_t p = 0; p < changed.parts.size(); ++p) {
      const auto find = [&](const Character& all) -> const MeshPart& {
        for (const MeshPart& part : all.parts)
          if (part.name == changed.parts[p].name) return part;
        return all.parts[p];
      };
      const auto was = posed_vertices(changed, changed.parts[p], pose);
      const auto is = posed_vertices(*back.character, find(*back.character), now);
      ASSERT_EQ(was.size(), is.size());
      // Sums of weights that were not 1 are, so compare where they were.
      const MeshPart& part = changed.parts[p];
      for (std::size_t v = 0; v < was.size(); ++v) {
        double sum = part.skin < 0 ? 1 : 0;
        for (int k = 0; part.skin >= 0 && k < part.influences; ++k)
          sum += part.weights[v * static_cast<std::size_t>(part.influences) + static_cast<std::size_t>(k)];
        if (std::fabs(sum - 1) < 1e-5) {
          ASSERT_LT(norm(was[v] - is[v]), 1e-4 * (1 + norm(was[v]))) << v;
        }
      }
    }
  }
}

TEST(GltfOut, WritesAMotionByItselfWithEndSitesAndStretch) {
  Alone work;
  Motion motion = sample_motion(20, 30).with_translation(2);
  for (std::size_t t = 0; t < motion.frames(); ++t)
    motion.translation(2).set(t, (1 + 0.01 * double(t)) * motion.skeleton().joints[2].offset);
  const GltfContents back = again(gltf_of(&motion, nullptr, {}, work), work);
  expect_same_motion(motion, back.motion);
  EXPECT_EQ(back.motion.skeleton().ends.size(), motion.skeleton().ends.size());
  EXPECT_TRUE(back.motion.translates(2));
  EXPECT_FALSE(back.motion.translates(3));
  WriteOptions rigid;
  rigid.stretch = "drop";
  EXPECT_FALSE(again(gltf_of(&motion, nullptr, rigid, work), work).motion.translates(2));
  rigid.stretch = "error";
  EXPECT_THROW(gltf_of(&motion, nullptr, rigid, work), Failure);
}

TEST(GltfOut, KeepsWhatStandsAboveTheRoot) {
  Alone work;
  Skeleton skeleton = sample_skeleton();
  skeleton.above = axis_angle({1, 0, 0}, -1.5);
  skeleton.above_offset = {1, 2, 3};
  const Motion motion = sample_motion(5, 30, 1, skeleton);
  expect_same_motion(motion, again(gltf_of(&motion, nullptr, {}, work), work).motion);
}

TEST(GltfOut, WritesACharacterThatNoFileGave) {
  Alone work;
  const Motion motion = sample_motion(10, 30);
  Character character;
  character.skeleton = motion.shared_skeleton();
  const RestPose rest = rest_pose(*character.skeleton);
  Skin skin;
  for (int j = 0; j < motion.joints(); ++j) {
    skin.joints.push_back(j);
    skin.inverse_bind.push_back(inverse(affine(rest.positions[j], rest.orientations[j])));
  }
  character.skins.push_back(skin);
  MeshPart part;
  part.name = "triangle";
  part.positions = {0, 1, 0, 0.1f, 1, 0, 0, 1.1f, 0};
  part.triangles = {0, 1, 2};
  part.skin = 0;
  part.influences = 6;  // more than one set of four
  for (int v = 0; v < 3; ++v)
    for (std::uint32_t k = 0; k < 6; ++k) {
      part.joints.push_back(k);
      part.weights.push_back(v == 0 ? 1.0f / 6 : k == 2 ? 1.0f : 0.0f);
    }
  part.morphs.push_back({"up", {0, 1, 0, 0, 1, 0, 0, 1, 0}, {}});
  character.parts.push_back(part);
  MeshPart prop;
  prop.name = "prop";
  prop.positions = part.positions;
  prop.triangles = part.triangles;
  prop.joint = 3;
  prop.placed = affine({0.1, 0, 0}, axis_angle({0, 1, 0}, 1), {2, 2, 2});
  character.parts.push_back(prop);
  character.morph_tracks.push_back({0, 0, std::vector<double>(10, 0.25)});
  character.morph_fps = 30;
  const GltfContents back = again(gltf_of(&motion, &character, {}, work), work);
  expect_same_motion(motion, back.motion);
  ASSERT_EQ(back.character->parts.size(), 2u);
  ASSERT_EQ(back.character->morph_tracks.size(), 1u);
  EXPECT_EQ(back.character->morph_tracks[0].weights, character.morph_tracks[0].weights);
  const Pose pose = pose_at(motion, 7);
  for (std::size_t p = 0; p < 2; ++p) {
    const std::vector<double> weights = p == 0 ? std::vector<double>{0.25} : std::vector<double>{};
    const auto was = posed_vertices(character, character.parts[p], pose, weights);
    for (const MeshPart& other : back.character->parts) {
      if (other.name != character.parts[p].name) continue;
      const auto is = posed_vertices(*back.character, other, pose_at(back.motion, 7), weights);
      for (std::size_t v = 0; v < 3; ++v) EXPECT_LT(norm(was[v] - is[v]), 1e-5);
    }
  }
}

// Blender holds a morph target's weight between 0 and 1.
TEST(GltfOut, GivesATargetThatMovesBothWaysOneForEachSoThatAllWeightsAreFromZeroToOne) {
  Alone work;
  Character character;
  MeshPart part;
  part.name = "triangle";
  part.positions = {0, 1, 0, 0.1f, 1, 0, 0, 1.1f, 0};
  part.triangles = {0, 1, 2};
  part.morphs.push_back({"up", {0, 1, 0, 0, 1, 0, 0, 1, 0}, {}});
  part.morphs.push_back({"out", {0, 0, 1, 0, 0, 2, 0, 0, 0}, {}});
  part.morphs.push_back({"in", {1, 0, 0, 0, 0, 0, 0, 0, 0}, {}});
  part.morphs.push_back({"still", {5, 0, 0, 0, 5, 0, 0, 0, 5}, {}});
  character.parts.push_back(part);
  character.morph_fps = 30;
  character.morph_tracks.push_back({0, 0, {0, 0.25, -0.5, 0.02}});
  character.morph_tracks.push_back({0, 1, {0, 3, 1.5, 0}});
  character.morph_tracks.push_back({0, 2, {-1, -2, 0, -0.5}});
  const GltfContents back = again(gltf_of(nullptr, &character, {}, work), work);
  const MeshPart& is = back.character->parts.at(0);
  std::vector<std::string> names;
  for (const MorphTarget& target : is.morphs) names.push_back(target.name);
  EXPECT_EQ(names, (std::vector<std::string>{"up", "up-", "out", "in-", "still"}));
  for (const MorphTrack& track : back.character->morph_tracks)
    for (double weight : track.weights) {
      EXPECT_GE(weight, 0);
      EXPECT_LE(weight, 1);
    }
  for (std::size_t t = 0; t < 4; ++t) {
    const auto was =
        posed_vertices(character, part, rest_pose_of(*character.skeleton), morph_weights_at(character, t)[0]);
    const auto now = posed_vertices(*back.character, is, rest_pose_of(*back.character->skeleton),
                                    morph_weights_at(*back.character, t)[0]);
    for (std::size_t v = 0; v < 3; ++v) EXPECT_LT(norm(was[v] - now[v]), 1e-6) << t << " " << v;
  }
}

TEST(GltfOut, RefusesAMotionWithoutACommonJoint) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const auto fox = character_of(load("gltf/Fox.glb", work));
  const Motion motion = sample_motion(3);
  try {
    gltf_of(&motion, fox.get(), {}, work);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "no-common-joint");
  }
}

TEST(GltfOut, AsTextNamesItsBufferAndReadsBack) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const MotionFile file = load("gltf/Fox.glb", work);
  const EncodedFile written = encode_motion_file("/out/a fox.gltf", "auto", file.contents, {}, work);
  ASSERT_EQ(written.companions.size(), 1u);
  EXPECT_EQ(written.companions[0].first, "a fox.bin");
  PlainFiles files;
  files.made["/out/a fox.bin"] = written.companions[0].second;
  const GltfContents back = read_gltf(written.bytes, "/out/a fox.gltf", {}, files, work);
  expect_same_motion(*file.motion(), back.motion);
}

}  // namespace
}  // namespace kinegraph
