#include "headless/draws/character_sheet.h"

#include <gmock/gmock.h>

#include <limits>

#include "headless/draws/mesh_raster.h"
#include "headless/draws/picture.h"
#include "headless/draws/skin_figure.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::Not;

// A box of 1 m on the joint "root", 2 triangles a side.
Character box() {
  Character character;
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"root", -1, {}, {}}};
  character.skeleton = skeleton;
  MeshPart part;
  part.joint = 0;
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis) part.positions.push_back(corner >> axis & 1 ? 0.5f : -0.5f);
  part.triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  character.parts.push_back(part);
  return character;
}

SolidMesh triangle(double depth, Color color) {
  return {{{-1, -1, depth}, {1, -1, depth}, {0, 1, depth}},
          {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
          {color, color, color},
          {0, 1, 2}};
}

TEST(MeshRaster, ShowsWhatIsNearerWhicheverIsDrawnFirst) {
  const Camera camera({0, 0, 1}, 0, 40);
  const auto both = [&](bool far_first) {
    SolidMesh mesh = triangle(far_first ? 0 : 0.5, far_first ? rgb(0xff0000) : rgb(0x00ff00));
    const SolidMesh other = triangle(far_first ? 0.5 : 0, far_first ? rgb(0x00ff00) : rgb(0xff0000));
    for (std::size_t v = 0; v < 3; ++v) {
      mesh.positions.push_back(other.positions[v]);
      mesh.normals.push_back(other.normals[v]);
      mesh.colors.push_back(other.colors[v]);
      mesh.triangles.push_back(static_cast<std::uint32_t>(3 + v));
    }
    Canvas canvas(100, 100);
    draw_mesh(canvas, camera, mesh, {}, {50, 50});
    return canvas.svg("");
  };
  EXPECT_EQ(both(true), both(false));
}

TEST(MeshRaster, LeavesOutTrianglesThatAreNotFinite) {
  Canvas canvas(100, 100);
  SolidMesh mesh = triangle(0, rgb(0xffffff));
  mesh.positions[1].x = std::numeric_limits<double>::quiet_NaN();
  draw_mesh(canvas, Camera({0, 0, 1}, 0, 40), mesh, {}, {50, 50});
  draw_mesh(canvas, Camera({0, 0, 1}, 0, 40), {}, {}, {50, 50});
  EXPECT_THAT(canvas.svg(""), Not(HasSubstr("nan")));
}

TEST(SkinFigure, SharesNormalsOfVerticesOnOneSpot) {
  Character character = box();
  const SolidMesh smooth = SkinFigure(character).posed(rest_pose_of(*character.skeleton));
  EXPECT_NEAR(norm(smooth.normals[7]), 1, 1e-12);
  EXPECT_GT(dot(smooth.normals[7], normalized(Vec3{1, 1, 1})), 0.9) << "outwards, between its three sides";
}

TEST(SkinFigure, IsWholeWhereWeightsDoNotAddUpToOne) {
  Character character = box();
  MeshPart& part = character.parts[0];
  part.skin = 0;
  part.influences = 1;
  part.joints.assign(8, 0);
  part.weights.assign(8, 0.25f);
  part.weights[3] = 0;
  character.skins.push_back({"skin", {0}, {Affine()}});
  const Pose pose{{{0, 2, 0}}, {Quat{}}};
  const auto at = posed_vertices(character, part, pose);
  for (std::size_t v = 0; v < 8; ++v) EXPECT_LT(norm(at[v] - (part.position(v) + Vec3{0, 2, 0})), 1e-12) << v;
}

TEST(CharacterSheet, ShowsAStillCharacterFromFourSides) {
  const std::string svg = picture_of(box(), {.title = "box"}).svg("box");
  for (const char* words : {"1 mesh · 8 vertices · 12 triangles · 1 joint", "front", "left", "back",
                            "data:image/png;base64,iVBORw0KGgo"})
    EXPECT_THAT(svg, HasSubstr(words));
}

TEST(CharacterSheet, ShowsMomentsOfOneThatItsMorphTargetsMove) {
  Character character = box();
  character.parts[0].morphs.push_back({"grow", character.parts[0].positions, {}});
  character.morph_fps = 10;
  character.morph_tracks.push_back({0, 0, {0, 0.5, 1, 0.5, 0}});
  const std::string svg = picture_of(character, {.title = "", .moments = 3}).svg("");
  for (const char* words : {"1 morph targets", "0.00 s", "0.20 s", "0.40 s"})
    EXPECT_THAT(svg, HasSubstr(words));
}

TEST(CharacterSheet, ShowsMorphTargetsOfOneWhoseSkeletonStandsStill) {
  Character character = box();
  character.parts[0].morphs.push_back({"grow", character.parts[0].positions, {}});
  character.morph_fps = 10;
  character.morph_tracks.push_back({0, 0, {0, 0.5, 1}});
  const Motion still(character.skeleton, std::make_shared<SourceFacts>(), 10, 3, {false});
  EXPECT_THAT(picture_of(character, {.title = "", .motion = &still}).svg(""),
              HasSubstr("the farther from rest"));
}

TEST(CharacterSheet, SaysThatThereIsNoMesh) {
  EXPECT_THAT(picture_of(Character(), {}).svg(""), HasSubstr("no mesh"));
}

TEST(CharacterSheet, DrawsTheMeshAlongAMotion) {
  const Motion walk = gait("walk", 1);
  Character character = box();
  character.skeleton = walk.shared_skeleton();
  const std::string skinned = picture_of(character, {.title = "walk", .motion = &walk}).svg("");
  EXPECT_THAT(skinned, HasSubstr("60 frames"));
  EXPECT_THAT(skinned, HasSubstr("1 mesh"));
  EXPECT_THAT(skinned, HasSubstr("<image"));
  EXPECT_THAT(picture_of(walk, {}).svg(""), Not(HasSubstr("<image")));
}

}  // namespace
}  // namespace kinegraph
