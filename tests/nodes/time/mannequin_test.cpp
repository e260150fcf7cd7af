// graphs/characters/mannequin.glb is made here, by the project's own writer: a skinned figure with the names,
// the armature and the bones' axes of a Mixamo download, so that examples and tests need no one's character.
// KINEGRAPH_UPDATE_GOLDEN=1 writes it anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "nodes/files/motion_file.h"
#include "nodes/motion/character.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/time/other_bodies.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

constexpr int sides = 10;

// A spindle from one place to another, thickest near its start, on one joint.
void add_spindle(MeshPart& mesh, int joint, Vec3 from, Vec3 to, double radius, Vec3 flat = {1, 1, 1}) {
  constexpr std::pair<double, double> rings[] = {{-0.06, 0.02}, {0.0, 0.62},  {0.12, 0.95}, {0.3, 1.0},
                                                 {0.6, 0.86},   {0.88, 0.68}, {1.0, 0.45},  {1.05, 0.02}};
  constexpr int count = std::size(rings);
  const Vec3 along = to - from;
  const Quat turned = smallest_turn({0, 1, 0}, along);
  const auto first = static_cast<std::uint32_t>(mesh.vertices());
  const auto place = [&](int ring, int side) {
    const double angle = 2 * pi * side / sides, size = radius * rings[ring].second;
    const Vec3 out = rotate(turned, {size * sine(angle), 0, size * cosine(angle)});
    return from + rings[ring].first * along + Vec3{flat.x * out.x, flat.y * out.y, flat.z * out.z};
  };
  for (int ring = 0; ring < count; ++ring)
    for (int side = 0; side < sides; ++side) {
      const Vec3 p = place(ring, side);
      const Vec3 down = place(std::min(ring + 1, count - 1), side) - place(std::max(ring - 1, 0), side);
      const Vec3 round = place(ring, side + 1) - place(ring, side - 1);
      const Vec3 normal = normalized(cross(down, round));
      for (double value : {p.x, p.y, p.z}) mesh.positions.push_back(static_cast<float>(value));
      for (double value : {-normal.x, -normal.y, -normal.z})
        mesh.normals.push_back(static_cast<float>(value));
      for (int k = 0; k < 4; ++k) {
        mesh.joints.push_back(k == 0 ? static_cast<std::uint32_t>(joint) : 0);
        mesh.weights.push_back(k == 0 ? 1.0F : 0.0F);
      }
    }
  for (int ring = 0; ring + 1 < count; ++ring)
    for (int side = 0; side < sides; ++side) {
      const auto at = [&](int r, int s) { return first + static_cast<std::uint32_t>(r * sides + s % sides); };
      for (std::uint32_t v : {at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring, side + 1),
                              at(ring + 1, side + 1), at(ring + 1, side)})
        mesh.triangles.push_back(v);
    }
}

Character mannequin() {
  const OtherBody body = mixamo_like();
  Character out;
  out.skeleton = std::make_shared<const Skeleton>(body.skeleton);
  const Skeleton& s = body.skeleton;
  const RestPose rest = rest_pose(s);
  Skin skin;
  skin.name = "mannequin";
  for (int j = 0; j < s.size(); ++j) {
    skin.joints.push_back(j);
    skin.inverse_bind.push_back(inverse(affine(rest.positions[j], rest.orientations[j])));
  }
  MeshPart mesh;
  mesh.name = "mannequin";
  mesh.skin = 0;
  mesh.influences = 4;
  const auto at = [&](const std::string& role) { return s.find(body.roles.at(role)); };
  const auto link = [&](const std::string& from, const std::string& to, double radius,
                        Vec3 flat = {1, 1, 1}) {
    add_spindle(mesh, at(from), rest.positions[at(from)], rest.positions[at(to)], radius, flat);
  };
  const Vec3 deep{1, 1, 0.7};
  const Vec3 hips = rest.positions[at("pelvis")];
  add_spindle(mesh, at("pelvis"), hips + Vec3{0, -0.13, 0}, hips + Vec3{0, 0.07, 0}, 0.16, deep);
  link("spine.1", "spine.2", 0.125, deep);
  link("spine.2", "spine.3", 0.13, deep);
  const Vec3 chest = rest.positions[at("spine.3")];
  add_spindle(mesh, at("spine.3"), rest.positions[at("neck.1")] + Vec3{0, -0.01, 0},
              chest + Vec3{0, -0.03, 0}, 0.165, deep);
  link("neck.1", "head", 0.05);
  const Vec3 head = rest.positions[at("head")];
  add_spindle(mesh, at("head"), head + Vec3{0, 0.19, 0}, head + Vec3{0, -0.02, 0.01}, 0.09);
  add_spindle(mesh, at("head"), head + Vec3{0, 0.07, 0.08}, head + Vec3{0, 0.05, 0.11}, 0.014);  // nose
  for (const std::string side : {".l", ".r"}) {
    link("clavicle" + side, "arm" + side, 0.05);
    link("arm" + side, "forearm" + side, 0.05);
    link("forearm" + side, "hand" + side, 0.042);
    const Vec3 hand = rest.positions[at("hand" + side)], finger = rest.positions[at("finger" + side)];
    add_spindle(mesh, at("hand" + side), hand, finger, 0.04, {1, 1, 1});
    add_spindle(mesh, at("finger" + side), finger, finger + 0.8 * (finger - hand), 0.03);
    link("thigh" + side, "shin" + side, 0.085);
    link("shin" + side, "foot" + side, 0.062);
    const Vec3 ankle = rest.positions[at("foot" + side)], toe = rest.positions[at("toe" + side)];
    const Vec3 heel{ankle.x, 0.035, ankle.z - 0.05};
    add_spindle(mesh, at("foot" + side), heel, {toe.x, 0.03, toe.z}, 0.045, {1, 0.75, 1});
    add_spindle(mesh, at("toe" + side), {toe.x, 0.025, toe.z}, {toe.x, 0.018, toe.z + 0.08}, 0.04,
                {1, 0.6, 1});
  }
  out.skins.push_back(std::move(skin));
  out.parts.push_back(std::move(mesh));
  return out;
}

TEST(Mannequin, is_what_this_makes) {
  Alone work;
  const std::string bytes =
      encode_motion_file("mannequin.glb", "glb",
                         {{"character", std::make_shared<const Character>(mannequin())}}, {}, work)
          .bytes;
  const std::string path = source_folder() + "/graphs/characters/mannequin.glb";
  if (std::getenv("KINEGRAPH_UPDATE_GOLDEN")) std::ofstream(path, std::ios::binary) << bytes;
  std::ifstream in(path, std::ios::binary);
  const std::string kept((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_TRUE(kept == bytes) << "write it anew with KINEGRAPH_UPDATE_GOLDEN=1";
}

TEST(Mannequin, reads_back_with_every_vertex_in_its_place) {
  Alone work;
  PlainFiles files;
  const std::string path = source_folder() + "/graphs/characters/mannequin.glb";
  const MotionFile file = read_motion_file(path, {}, files, work);
  const auto& read = dynamic_cast<const Character&>(*file.find("character"));
  const Character made = mannequin();
  const auto at_rest = [](const Character& character) {
    return posed_vertices(character, character.parts[0], rest_pose_of(*character.skeleton));
  };
  const std::vector<Vec3> a = at_rest(read), b = at_rest(made);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t v = 0; v < a.size(); ++v) EXPECT_LT(norm(a[v] - b[v]), 1e-5);
}

TEST(Mannequin, stands_on_its_soles) {
  const Character character = mannequin();
  const Pose rest = rest_pose_of(*character.skeleton);
  double low = 1, high = 0;
  for (Vec3 v : posed_vertices(character, character.parts[0], rest)) {
    low = std::min(low, v.y);
    high = std::max(high, v.y);
  }
  EXPECT_NEAR(low, 0, 0.02);
  EXPECT_NEAR(high, 1.6, 0.15);
}

}  // namespace
}  // namespace kinegraph
