#include "nodes/cartoon/rubber_skin.h"

#include <gmock/gmock.h>

#include <functional>
#include <map>

#include "nodes/cartoon/exaggerate.h"
#include "nodes/cartoon/rubber_joints.h"
#include "nodes/time/retarget.h"
#include "tests/nodes/cartoon/cartoon_clips.h"
#include "tests/nodes/run_node.h"
#include "tests/nodes/time/walks.h"
#include "tests/places.h"

namespace kinegraph {

NodeType rubber_joints_node();

namespace {

// A cloud of vertices about Gait's skeleton, each bound to two to four joints.
Character cloud(const Motion& walk) {
  Character character;
  character.skeleton = walk.shared_skeleton();
  const Pose rest = rest_pose_of(*character.skeleton);
  Skin skin;
  for (int j = 0; j < walk.joints(); ++j) {
    skin.joints.push_back(j);
    skin.inverse_bind.push_back(inverse(affine(rest.positions[j], rest.orientations[j])));
  }
  character.skins = {skin};
  MeshPart part;
  part.skin = 0;
  part.influences = 4;
  for (int j = 1; j < walk.joints(); ++j) {
    const int p = walk.skeleton().joints[j].parent;
    for (int i = 0; i < 10; ++i) {
      const double f = i / 10.0;
      const Vec3 at =
          (1 - f) * rest.positions[p] + f * rest.positions[j] + Vec3{0.03, 0.01, 0.05 * (i % 3 - 1)};
      for (int axis = 0; axis < 3; ++axis) part.positions.push_back(static_cast<float>(at[axis]));
      const std::uint32_t joints[4] = {static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(j), 0, 9};
      const float weights[4] = {0.5f, 0.3f, i % 2 ? 0.2f : 0.15f, i % 2 ? 0.0f : 0.05f};
      part.joints.insert(part.joints.end(), joints, joints + 4);
      part.weights.insert(part.weights.end(), weights, weights + 4);
    }
  }
  character.parts = {part};
  return character;
}

std::map<int, double> sums(const Character& character, const MeshPart& part, std::size_t vertex,
                           const std::function<int(int)>& joint_of) {
  std::map<int, double> sum;
  for (int i = 0; i < part.influences; ++i) {
    const std::size_t entry =
        vertex * static_cast<std::size_t>(part.influences) + static_cast<std::size_t>(i);
    if (part.weights[entry] != 0)
      sum[joint_of(character.skins[part.skin].joints[part.joints[entry]])] += part.weights[entry];
  }
  return sum;
}

void expect_rebound_well(const Character& before, const Character& after) {
  const Pose old_rest = rest_pose_of(*before.skeleton), rest = rest_pose_of(*after.skeleton);
  const double height = rest_height(*before.skeleton);
  ASSERT_EQ(before.parts.size(), after.parts.size());
  double moved = 0, differs = 0;
  for (std::size_t p = 0; p < before.parts.size(); ++p) {
    const auto a = posed_vertices(before, before.parts[p], old_rest),
               b = posed_vertices(after, after.parts[p], rest);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_LE(after.parts[p].influences, std::max(usual_influences, before.parts[p].influences));
    for (std::size_t v = 0; v < a.size(); ++v) {
      moved = std::max(moved, norm(a[v] - b[v]));
      if (before.parts[p].skin < 0) continue;
      // Sub-joint NAME_3 stands for joint NAME: by the names' beginnings, parents' lists being in the same
      // order.
      const auto old_sums = sums(before, before.parts[p], v, [](int j) { return j; });
      const auto new_sums = sums(after, after.parts[p], v, [&](int j) {
        std::string name = after.skeleton->joints[j].name;
        int k = before.skeleton->find(name);
        while (k < 0 && name.find('_') != std::string::npos)
          k = before.skeleton->find(name = name.substr(0, name.rfind('_')));
        return k;
      });
      for (const auto& [joint, weight] : old_sums) {
        const auto found = new_sums.find(joint);
        differs = std::max(differs, std::abs(weight - (found == new_sums.end() ? 0 : found->second)));
      }
    }
  }
  EXPECT_LT(moved, 1e-5 * height);
  EXPECT_LT(differs, 1e-6);
}

TEST(RubberSkin, KeepsWeightsInSumAndVerticesAtRest) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const Character before = cloud(walk);
  const RubberResult rubber = rubber_joints(walk, {}, nullptr, work);
  const Character after = rubber_character(before, walk, rubber.sub_joints, {}, work);
  EXPECT_EQ(after.skeleton->joints.size(), 58u);
  EXPECT_TRUE(after.rebound);
  expect_rebound_well(before, after);
}

// A row of vertices beside the left thigh, from above the hip to below the knee, each bound to some joints.
Character row_beside_thigh(const Character& base,
                           const std::vector<std::pair<std::string, double>>& binding) {
  Character out = base;
  const Pose rest = rest_pose_of(*base.skeleton);
  const Vec3 thigh = rest.positions[base.skeleton->find("LeftUpLeg")],
             knee = rest.positions[base.skeleton->find("LeftLeg")];
  MeshPart part;
  part.skin = 0;
  part.influences = static_cast<int>(binding.size());
  for (int i = 0; i <= 100; ++i) {
    const Vec3 at = thigh + (0.012 * i - 0.1) * (knee - thigh) + Vec3{0.05, 0, 0};
    for (int axis = 0; axis < 3; ++axis) part.positions.push_back(static_cast<float>(at[axis]));
    for (const auto& [joint, weight] : binding) {
      part.joints.push_back(static_cast<std::uint32_t>(base.skeleton->find(joint)));
      part.weights.push_back(static_cast<float>(weight));
    }
  }
  out.parts = {part};
  return out;
}

// Of each vertex, the weight of every sub-joint.
std::vector<std::map<int, double>> weights_of(const Character& character) {
  const MeshPart& part = character.parts[0];
  std::vector<std::map<int, double>> all;
  for (std::size_t v = 0; v < part.vertices(); ++v)
    all.push_back(sums(character, part, v, [](int j) { return j; }));
  return all;
}

TEST(RubberSkin, SharesOutBetweenTheTwoSubJointsAVertexLiesBetween) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const Character before = row_beside_thigh(cloud(walk), {{"LeftUpLeg", 1}});
  const RubberResult rubber = rubber_joints(walk, {}, nullptr, work);
  const int thigh = rubber.sub_joints.first[walk.skeleton().find("LeftUpLeg")];
  ASSERT_EQ(rubber.sub_joints.all[thigh].count, 6);
  const auto weights = weights_of(rubber_character(before, walk, rubber.sub_joints, {}, work));
  for (int i = 0; i <= 100; ++i) {
    const double place = std::clamp(6 * (0.012 * i - 0.1), 0.0, 5.0);
    for (int l = 0; l < 6; ++l) {
      const auto found = weights[i].find(thigh + l);
      EXPECT_NEAR(found == weights[i].end() ? 0 : found->second, std::max(0.0, 1 - std::fabs(place - l)),
                  1e-5)
          << i << " " << l;
    }
  }
}

TEST(RubberSkin, ChangesWeightsSmoothlyFromVertexToVertex) {
  Alone work;
  const Motion walk = gait("walk", 1);
  const RubberResult rubber = rubber_joints(walk, {}, nullptr, work);
  const auto widest_step = [&](const std::vector<std::pair<std::string, double>>& binding) {
    const Character before = row_beside_thigh(cloud(walk), binding);
    const Character after = rubber_character(before, walk, rubber.sub_joints, {}, work);
    EXPECT_LE(after.parts[0].influences, usual_influences);
    expect_rebound_well(before, after);
    const auto weights = weights_of(after);
    double most = 0;
    for (std::size_t v = 1; v < weights.size(); ++v)
      for (int j = 0; j < after.skeleton->size(); ++j) {
        const auto weight = [&](std::size_t of) {
          const auto found = weights[of].find(j);
          return found == weights[of].end() ? 0.0 : found->second;
        };
        most = std::max(most, std::fabs(weight(v) - weight(v - 1)));
      }
    return most;
  };
  // Vertices are 0.072 of a sub-link apart, and two joints have room for all they share out. Of three the
  // thigh keeps its pairs, the others, with less, what room there is.
  EXPECT_LT(widest_step({{"LeftUpLeg", 0.7}, {"LeftLeg", 0.3}}), 0.0721 * 0.7 + 1e-6);
  EXPECT_LT(widest_step({{"LeftUpLeg", 0.6}, {"LeftLeg", 0.3}, {"Spine1", 0.1}}), 0.25);
}

TEST(RubberSkin, KeepsOneSetUnlessAVertexHasMoreJoints) {
  Alone work;
  const Motion walk = gait("walk", 1);
  Character before = cloud(walk);
  const RubberResult rubber = rubber_joints(walk, {}, nullptr, work);
  EXPECT_EQ(rubber_character(before, walk, rubber.sub_joints, {}, work).parts[0].influences, 4);
  // Six joints of a leg and an arm move every vertex.
  MeshPart& part = before.parts[0];
  part.influences = 6;
  part.joints.clear();
  part.weights.clear();
  for (std::size_t v = 0; v < part.vertices(); ++v)
    for (int i = 0; i < 6; ++i) {
      const char* names[] = {"LeftUpLeg", "LeftLeg", "LeftFoot", "LeftArm", "LeftForeArm", "LeftHand"};
      part.joints.push_back(static_cast<std::uint32_t>(walk.skeleton().find(names[i])));
      part.weights.push_back(static_cast<float>(i + 1) / 21);
    }
  const Character after = rubber_character(before, walk, rubber.sub_joints, {}, work);
  EXPECT_EQ(after.parts[0].influences, 6);
  expect_rebound_well(before, after);
}

TEST(RubberSkin, HoldsOnRealCharacters) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const char* file :
       {"gltf/CesiumMan.glb", "gltf/KayKit_Knight.glb", "gltf/rig_transfer_from_bvh.glb"}) {
    Alone work;
    PlainFiles files;
    const MotionFile loaded = read_motion_file(mocap(file), {}, files, work);
    const auto* character = dynamic_cast<const Character*>(loaded.find("character"));
    ASSERT_TRUE(character) << file;
    const Motion motion = loaded.motion()
                              ? *loaded.motion()
                              : Motion(character->skeleton, std::make_shared<SourceFacts>(), 30, 1,
                                       std::vector<bool>(character->skeleton->joints.size(), false));
    const RubberResult rubber = rubber_joints(motion, {}, nullptr, work);
    const Character after = rubber_character(*character, motion, rubber.sub_joints, {}, work);
    expect_rebound_well(*character, after);
    EXPECT_NO_THROW(pose_for(after, rubber.motion, 0));
  }
}

// How much longer the edges of a mesh are than at rest, all but the longest `leave` of all frames and edges;
// of edges between `chosen` vertices.
double stretched_edges(const Character& character, const Motion& motion, double leave = 0.001,
                       const std::vector<bool>& chosen = {}) {
  const MeshPart& part = character.parts[0];
  const std::vector<Vec3> rest = posed_vertices(character, part, rest_pose_of(*character.skeleton));
  std::vector<double> ratios;
  for (std::size_t t = 0; t < motion.frames(); t += 10) {
    const std::vector<Vec3> at = posed_vertices(character, part, pose_for(character, motion, t));
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      const std::uint32_t a = part.triangles[i], b = part.triangles[i % 3 == 2 ? i - 2 : i + 1];
      if (!chosen.empty() && !(chosen[a] && chosen[b])) continue;
      if (const double length = norm(rest[a] - rest[b]); length > 1e-4)
        ratios.push_back(norm(at[a] - at[b]) / length);
    }
  }
  const auto place =
      ratios.begin() + static_cast<std::ptrdiff_t>((1 - leave) * static_cast<double>(ratios.size() - 1));
  std::nth_element(ratios.begin(), place, ratios.end());
  return *place;
}

// A body that an automatic rig bound to up to four joints at once, walking.
struct WalkingBody {
  Character body, after;
  Motion wild, rubber;
};
WalkingBody walking_body() {
  Alone work;
  PlainFiles files;
  const MotionFile file = read_motion_file(mocap("gltf/rig_transfer_from_bvh.glb"), {}, files, work);
  const auto& body = dynamic_cast<const Character&>(*file.find("character"));
  const Motion at_rest(body.skeleton, std::make_shared<SourceFacts>(), 30, 1,
                       std::vector<bool>(body.skeleton->joints.size(), false));
  const Motion walk = retarget(cartoon_clip("cmu/bvh/08_01.bvh", 120), {&at_rest, {}}, {}, work).motion;
  ExaggerateParams exaggeration;
  exaggeration.omega = 2.5;
  exaggeration.keep_root = true;
  exaggeration.correction.max_link = 2;
  const Motion wild = exaggerate(walk, exaggeration, work).motion;
  const RubberResult rubber = rubber_joints(wild, {}, nullptr, work);
  return {body, rubber_character(body, wild, rubber.sub_joints, {}, work), wild, rubber.motion};
}

// Fingers bound to four joints of an arm.
TEST(RubberSkin, TearsNoFingers) {
  KINEGRAPH_NEEDS_MOCAP();
  const WalkingBody walk = walking_body();
  const double plain = stretched_edges(walk.body, walk.wild),
               stretched = stretched_edges(walk.after, walk.rubber);
  EXPECT_LT(stretched, 1.1 * plain);
  RecordProperty("edges", std::to_string(plain) + " and " + std::to_string(stretched));
}

// A crotch bound to both thighs and both hips has room for one sub-joint of each thigh: were that each
// vertex's nearest, the skin would step from one to the next.
TEST(RubberSkin, CreasesNoCrotch) {
  KINEGRAPH_NEEDS_MOCAP();
  const WalkingBody walk = walking_body();
  const MeshPart& part = walk.body.parts[0];
  const Skeleton& skeleton = *walk.body.skeleton;
  std::vector<bool> crotch(part.vertices());
  int vertices = 0;
  for (std::size_t v = 0; v < crotch.size(); ++v) {
    const auto bound = sums(walk.body, part, v, [](int j) { return j; });
    crotch[v] = true;
    for (const char* name : {"LHipJoint", "RHipJoint", "LeftUpLeg", "RightUpLeg"}) {
      const auto found = bound.find(skeleton.find(name));
      crotch[v] = crotch[v] && found != bound.end() && found->second > 0;
    }
    vertices += crotch[v];
  }
  ASSERT_GT(vertices, 300);
  const double plain = stretched_edges(walk.body, walk.wild, 0, crotch),
               stretched = stretched_edges(walk.after, walk.rubber, 0, crotch);
  EXPECT_LT(stretched, 1.25 * plain);
  RecordProperty("edges", std::to_string(plain) + " and " + std::to_string(stretched));
}

// The least distance between the shells of two joints, each of the vertices that it moves by over nine
// tenths.
double gap(const Character& character, const Pose& pose, const std::string& one, const std::string& other) {
  const MeshPart& part = character.parts[0];
  const std::vector<Vec3> at = posed_vertices(character, part, pose);
  std::vector<Vec3> shells[2];
  for (std::size_t v = 0; v < at.size(); ++v) {
    double of[2] = {};
    for (int i = 0; i < part.influences; ++i) {
      const std::size_t entry = v * static_cast<std::size_t>(part.influences) + static_cast<std::size_t>(i);
      const std::string& name =
          character.skeleton->joints[character.skins[part.skin].joints[part.joints[entry]]].name;
      for (int k : {0, 1})
        if (const std::string& limb = k == 0 ? one : other; name == limb || name.starts_with(limb + "_"))
          of[k] += part.weights[entry];
    }
    for (int k : {0, 1})
      if (of[k] > 0.9) shells[k].push_back(at[v]);
  }
  double least = 1e9;
  for (Vec3 a : shells[0])
    for (Vec3 b : shells[1]) least = std::min(least, norm(a - b));
  return least;
}

// A link that doubles its length leaves its shell behind by what its last sub-link grows: shorter ones leave
// less.
TEST(RubberSkin, ClosesGapsBetweenShellsWithMoreSubJoints) {
  Alone work;
  PlainFiles files;
  const MotionFile file =
      read_motion_file(source_folder() + "/graphs/characters/mannequin.glb", {}, files, work);
  const auto& mannequin = dynamic_cast<const Character&>(*file.find("character"));
  const Motion body(mannequin.skeleton, std::make_shared<SourceFacts>(), 30, 1,
                    std::vector<bool>(mannequin.skeleton->joints.size(), false));
  const Motion run = retarget(gait("run", 2), {&body, {}}, {}, work).motion;
  ExaggerateParams exaggeration;
  exaggeration.omega = 3;
  exaggeration.keep_root = true;
  const Motion wild = exaggerate(run, exaggeration, work).motion;
  const auto widest = [&](int count) {
    RubberParams params;
    if (count > 0) params.sub_joints.counts = {{"*ForeArm", count}, {"*Leg", count}};
    const RubberResult rubber = rubber_joints(wild, params, nullptr, work);
    const Character after = rubber_character(mannequin, wild, rubber.sub_joints, params.sub_joints, work);
    double most = 0;
    for (std::size_t t = 0; t < wild.frames(); t += 8) {
      const Pose pose = pose_for(after, rubber.motion, t);
      for (const char* side : {"mixamorig:Left", "mixamorig:Right"})
        most = std::max(most, gap(after, pose, side + std::string("ForeArm"), side + std::string("Hand")));
    }
    return most;
  };
  EXPECT_LT(gap(mannequin, rest_pose_of(*mannequin.skeleton), "mixamorig:LeftForeArm", "mixamorig:LeftHand"),
            0.01);
  const double usual = widest(0), finer = widest(12);
  EXPECT_LT(usual, 0.06);
  EXPECT_LT(finer, 0.02);
  RecordProperty("gap", std::to_string(usual) + " m, with 12 sub-joints " + std::to_string(finer));
}

// The mannequin's feet have frames half a turn away from their shins', at rest as in motion.
TEST(RubberSkin, WringsNoLimbWhoseFramesStandApart) {
  Alone work;
  PlainFiles files;
  const MotionFile file =
      read_motion_file(source_folder() + "/graphs/characters/mannequin.glb", {}, files, work);
  const auto& mannequin = dynamic_cast<const Character&>(*file.find("character"));
  const Motion body(mannequin.skeleton, std::make_shared<SourceFacts>(), 30, 1,
                    std::vector<bool>(mannequin.skeleton->joints.size(), false));
  const int foot = mannequin.skeleton->find("mixamorig:LeftFoot");
  EXPECT_GT(turn(mannequin.skeleton->joints[foot].rest), 3.1);
  const Motion run = retarget(gait("run", 2), {&body, {}}, {}, work).motion;
  const RubberResult rubber = rubber_joints(run, {}, nullptr, work);
  double most = 0;
  for (std::size_t i = 0; i < rubber.sub_joints.all.size(); ++i) {
    const std::string& name = rubber.motion.skeleton().joints[i].name;
    if (rubber.sub_joints.all[i].step == 0 || name.find("tLeg") == std::string::npos) continue;
    const int j = static_cast<int>(i);
    for (std::size_t t = 0; t < run.frames(); ++t)
      most = std::max(most, turn(inverse(rubber.motion.skeleton().joints[i].rest) *
                                 std::as_const(rubber.motion).rotation(j)[t]));
  }
  EXPECT_LT(most, 0.5);
  RecordProperty("turn", std::to_string(most));
}

TEST(RubberJointsNode, PassesACharacterThrough) {
  const Motion walk = gait("walk", 1);
  NodeInMemory node(rubber_joints_node());
  node.link("motion", walk).link("character", cloud(walk)).run();
  EXPECT_EQ(node.out<Character>("character").skeleton->joints.size(), 58u);
}

TEST(RubberJointsNode, SaysWhereTheCharacterIsAnotherBody) {
  const Motion walk = gait("walk", 1);
  const auto told = [&](const Character& character) {
    NodeInMemory node(rubber_joints_node());
    node.link("motion", walk).link("character", character).run();
    std::vector<std::string> codes;
    for (const Diagnostic& one : node.reported())
      if (one.severity == Severity::warning) codes.push_back(one.code + " " + one.port);
    return codes;
  };
  const Character same = cloud(walk);
  EXPECT_THAT(told(same), testing::IsEmpty());
  Character longer = same, further = same, strange = same;
  Skeleton body = *same.skeleton;
  body.joints[body.find("LeftLeg")].offset = 1.2 * body.joints[body.find("LeftLeg")].offset;
  longer.skeleton = std::make_shared<Skeleton>(body);
  EXPECT_THAT(told(longer), testing::ElementsAre("rest-pose-differs character"));
  body = *same.skeleton;
  body.joints.back().name = "Tail";
  further.skeleton = std::make_shared<Skeleton>(body);
  EXPECT_THAT(told(further), testing::ElementsAre("no-partner character"));
  for (Joint& joint : body.joints) joint.name = "strange " + joint.name;
  strange.skeleton = std::make_shared<Skeleton>(body);
  const Diagnostic refusal =
      NodeInMemory(rubber_joints_node()).link("motion", walk).link("character", strange).refusal();
  EXPECT_EQ(refusal.code, "no-common-joint");
  EXPECT_EQ(refusal.port, "character");
  EXPECT_THAT(refusal.hint, testing::HasSubstr("Retarget"));
}

}  // namespace
}  // namespace kinegraph
