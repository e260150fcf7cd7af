#include "nodes/motion/character.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

// A strip of two triangles, the lower end on joint 0, the upper on joint 1, the middle on both.
Character strip() {
  Character character;
  Skeleton skeleton;
  skeleton.joints = {{"low", -1, {0, 1, 0}, {}}, {"high", 0, {0, 1, 0}, {}}};
  character.skeleton = std::make_shared<const Skeleton>(skeleton);
  character.skins.push_back({"skin", {0, 1}, {affine({0, -1, 0}), affine({0, -2, 0})}});
  MeshPart part;
  part.name = "strip";
  part.positions = {0, 1, 0, 1, 2, 0, 0, 3, 0};
  part.triangles = {0, 1, 2};
  part.skin = 0;
  part.influences = 2;
  part.joints = {0, 1, 0, 1, 0, 1};
  part.weights = {1, 0, 0.5f, 0.5f, 0, 1};
  part.morphs.push_back({"wide", {0, 0, 0, 1, 0, 0, 0, 0, 0}, {}});
  character.parts.push_back(part);
  character.morph_tracks.push_back({0, 0, {0, 1}});
  character.morph_fps = 30;
  auto source = std::make_shared<CharacterSource>();
  source->json = "{}";
  source->buffers = {"bytes"};
  source->node_of_joint = {3, 4};
  source->scale_of_parent = {1, 2};
  character.source = source;
  return character;
}

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_NEAR(norm(a - b), 0, 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(Affine, DecomposesWhatItWasComposedOf) {
  const Quat turned = normalized(Quat{0.3, -0.2, 0.7, -0.4});
  const Affine map = affine({1, 2, 3}, turned, {2, 3, 0.5});
  const Decomposed parts = decomposed(map);
  expect_near(parts.move, {1, 2, 3});
  expect_near(parts.scale, {2, 3, 0.5});
  EXPECT_NEAR(std::fabs(dot(parts.turned, turned)), 1, 1e-14);
  expect_near(point(inverse(map) * map, {4, -5, 6}), {4, -5, 6});
  EXPECT_NEAR(determinant(map), 3, 1e-12);
}

TEST(Character, StaysWhereItIsInTheRestPose) {
  const Character character = strip();
  const auto at = posed_vertices(character, character.parts[0], rest_pose_of(*character.skeleton));
  expect_near(at[0], {0, 1, 0});
  expect_near(at[1], {1, 2, 0});
  expect_near(at[2], {0, 3, 0});
}

TEST(Character, FollowsItsJointsByTheirWeights) {
  const Character character = strip();
  Pose pose = rest_pose_of(*character.skeleton);
  pose.orientations[1] = axis_angle({0, 0, 1}, std::acos(-1.0) / 2);  // the upper link falls to -x
  const auto at = posed_vertices(character, character.parts[0], pose);
  expect_near(at[0], {0, 1, 0});
  expect_near(at[1], 0.5 * (Vec3{1, 2, 0} + Vec3{0, 3, 0}));
  expect_near(at[2], {-1, 2, 0});
  const auto wide = posed_vertices(character, character.parts[0], rest_pose_of(*character.skeleton), {0.5});
  expect_near(wide[1], {1.5, 2, 0});
}

TEST(Character, FollowsAMotionWhoseJointsHaveItsNames) {
  const Character character = strip();
  Skeleton other;
  other.joints = {{"low", -1, {0, 5, 0}, {}}, {"side", 0, {1, 0, 0}, {}}, {"high", 0, {0, 9, 0}, {}}};
  Motion motion(std::make_shared<const Skeleton>(other), nullptr, 30, 1, {true, false, false});
  motion.translation(0).set(0, {7, 8, 9});
  const Pose pose = pose_for(character, motion, 0);
  expect_near(pose.positions[0], {7, 8, 9});
  expect_near(pose.positions[1], {7, 9, 9});  // the character's own bone length
  other.joints[0].name = other.joints[2].name = "x";
  const Motion foreign(std::make_shared<const Skeleton>(other), nullptr, 30, 1, {false, false, false});
  EXPECT_THROW(pose_for(character, foreign, 0), Failure);
}

TEST(Character, WeightsCountByTheirShareOfTheSum) {
  Character character = strip();
  const Pose pose = rest_pose_of(*character.skeleton);
  const std::vector<Vec3> sound = posed_vertices(character, character.parts[0], pose);
  for (float& weight : character.parts[0].weights) weight *= 0.3f;
  const std::vector<Vec3> unsound = posed_vertices(character, character.parts[0], pose);
  for (std::size_t v = 0; v < sound.size(); ++v) expect_near(unsound[v], sound[v]);
}

TEST(Character, IsTheSameOutOfTheCache) {
  const Character character = strip();
  const std::string bytes = encoded(character);
  Decoder in(bytes);
  const ValuePtr back = decode_character(in);
  EXPECT_TRUE(in.at_end());
  EXPECT_EQ(encoded(*back), bytes);
  EXPECT_FALSE(back->non_finite());
  for (std::size_t cut = 0; cut < bytes.size(); cut += 7) {
    Decoder part(std::string_view(bytes).substr(0, cut));
    EXPECT_THROW(decode_character(part), Failure) << cut;
  }
}

TEST(Character, NamesWhatIsNotFinite) {
  Character character = strip();
  character.parts[0].weights[2] = std::nanf("");
  ASSERT_TRUE(character.non_finite());
  EXPECT_EQ(character.non_finite()->what, "weight of mesh strip");
}

}  // namespace
}  // namespace kinegraph
