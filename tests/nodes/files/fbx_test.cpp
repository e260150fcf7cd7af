// FBX: pivots, pre-rotations, axes and units; or, built without Assimp, what to do instead.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "nodes/files/fbx_read.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/files/fbx_texts.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

GltfContents read(const std::string& bytes, Work& work, ReadOptions options = {}) {
  PlainFiles files;
  return read_fbx(bytes, options, files, work);
}

// Whether this program can: the tests below say what it does then.
bool without_assimp() {
  Alone work;
  try {
    read("nothing", work);
  } catch (const Failure& failure) {
    return failure.diagnostic().code == "no-fbx";
  }
  return false;
}

TEST(Fbx, IsRefusedWithWhatToDoWhereItCannotBeRead) {
  Alone work;
  try {
    read("Kaydara FBX Binary  ", work);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, without_assimp() ? "no-fbx" : "bad-fbx");
    EXPECT_NE(failure.diagnostic().hint.find("GLB"), std::string::npos);
  }
}

Vec3 foot_in_file(double degrees) {
  const Quat hips = axis_angle({0, 0, 1}, 90 / degrees_per_radian);
  const Quat leg =
      axis_angle({1, 0, 0}, 30 / degrees_per_radian) * axis_angle({0, 0, 1}, degrees / degrees_per_radian);
  const Vec3 pivot{0, 5, 0};
  const Vec3 in_hips = Vec3{0, -40, 0} + pivot + rotate(leg, Vec3{0, -35, 0} - pivot);
  return Vec3{10, 100, 5} + rotate(hips, in_hips);
}

TEST(Fbx, MultipliesPivotsAndPreRotationsOut) {
  if (without_assimp()) GTEST_SKIP() << "built without Assimp";
  Alone work;
  const Motion motion = read(text_fbx(1, 2, 1, 1), work).motion;
  ASSERT_EQ(motion.frames(), 3u);
  EXPECT_EQ(motion.fps(), 30);
  EXPECT_EQ(motion.source().unit_name, "cm");
  EXPECT_EQ(motion.source().format, "fbx");
  const int foot = motion.skeleton().find("Foot");
  const int leg = motion.skeleton().find("Leg");
  ASSERT_GE(leg, 0);
  for (std::size_t t = 0; t < 3; ++t) {
    const Vec3 expected = 0.01 * foot_in_file(45.0 * double(t));
    const WorldMotion world = world_motion(motion);
    Vec3 place = foot >= 0 ? world.position(foot)[t] : Vec3{};
    for (const EndSite& end : motion.skeleton().ends)
      if (foot < 0 && end.name == "Foot") place = point_at(world, end.joint, end.offset, t);
    EXPECT_LT(norm(place - expected), 2e-6) << t;
  }
  for (const Joint& joint : motion.skeleton().joints)
    EXPECT_EQ(joint.name.find("$AssimpFbx$"), std::string::npos) << joint.name;
}

// tests/nodes/golden/nodes/clips/swing.fbx: Z up; the hips, turned by 90° beforehand, only change their
// place.
TEST(Fbx, AJointThatOnlyMovesKeepsItsPreRotationOnce) {
  if (without_assimp()) GTEST_SKIP() << "built without Assimp";
  std::ifstream in(source_folder() + "/tests/nodes/golden/nodes/clips/swing.fbx", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  Alone work;
  const Motion motion = read(bytes, work).motion;
  ASSERT_EQ(motion.frames(), 3u);
  const Vec3 hips[] = {{10, 5, 100}, {12, 5, 98}, {15, 6, 101}};
  const int leg = motion.skeleton().find("Leg");
  ASSERT_GE(leg, 0);
  const Quat turned = axis_angle({0, 0, 1}, 90 / degrees_per_radian),
             bent = axis_angle({1, 0, 0}, 30 / degrees_per_radian);
  const Vec3 pivot{0, 0, 5};
  for (std::size_t t = 0; t < 3; ++t) {
    const Pose pose = pose_at(motion, t);
    const auto expect_at = [&](Vec3 place, const Vec3& in_file) {
      EXPECT_LT(norm(place - 0.01 * Vec3{in_file.x, in_file.z, -in_file.y}), 2e-6) << t;
    };
    expect_at(pose.positions[0], hips[t]);
    if (t > 0) continue;  // the leg hangs straight but for its own pre-rotation
    expect_at(pose.positions[static_cast<std::size_t>(leg)],
              hips[0] + rotate(turned, Vec3{0, 0, -40} + pivot + rotate(bent, -1.0 * pivot)));
  }
}

TEST(Fbx, IsTurnedAndScaledAsItsSettingsSay) {
  if (without_assimp()) GTEST_SKIP() << "built without Assimp";
  Alone work;
  const Motion y = read(text_fbx(1, 2, 1, 1), work).motion, z = read(text_fbx(2, 1, -1, 2.54), work).motion;
  EXPECT_EQ(z.source().unit_name, "in");
  EXPECT_EQ(z.source().up, UpAxis::z);
  const Pose a = pose_at(y, 1), b = pose_at(z, 1);
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t j = 0; j < a.positions.size(); ++j) {
    const Vec3 p = 2.54 * a.positions[j];
    EXPECT_LT(norm(b.positions[j] - Vec3{p.x, p.z, -p.y}), 1e-5) << j;
  }
  ReadOptions metres;
  metres.unit = Json("m");
  EXPECT_LT(
      norm(pose_at(read(text_fbx(1, 2, 1, 1), work, metres).motion, 1).positions[0] - 100 * a.positions[0]),
      1e-3);
}

// As a target of Retarget is exported.
TEST(Fbx, WithNothingButASkeletonIsThatSkeleton) {
  if (without_assimp()) GTEST_SKIP() << "built without Assimp";
  Alone work;
  std::string text = text_fbx(1, 2, 1, 1);
  const std::size_t clip = text.find("AnimationStack"), links = text.find("}\nConnections");
  text.erase(clip, links - clip);
  const std::size_t of_clip = text.find("C: \"OO\",11,10");
  text.erase(of_clip, text.rfind("}") - of_clip);
  const Motion still = read(text, work).motion;
  ASSERT_EQ(still.joints(), 3);
  const char* const names[] = {"Hips", "Leg", "Foot"};
  for (int j = 0; j < 3; ++j) EXPECT_EQ(still.skeleton().joints[j].name, names[j]);
  const Pose pose = pose_at(still, 0);
  EXPECT_NEAR(norm(pose.positions[0] - Vec3{0.1, 1, 0.05}), 0, 1e-6);
}

TEST(Fbx, GivesTheClipThatIsNamed) {
  if (without_assimp()) GTEST_SKIP() << "built without Assimp";
  Alone work;
  ReadOptions options;
  options.clip = "Swing";
  EXPECT_EQ(read(text_fbx(1, 2, 1, 1), work, options).motion.frames(), 3u);
  options.clip = "Swung";
  EXPECT_THROW(read(text_fbx(1, 2, 1, 1), work, options), Failure);
}

}  // namespace
}  // namespace kinegraph
