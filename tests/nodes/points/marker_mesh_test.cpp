#include "nodes/points/marker_mesh.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"

namespace kinegraph {
namespace {

// A bent sheet of 6 × 6 vertices in centimetres, rigid on the one joint.
Character sheet() {
  Character character;
  Skeleton skeleton;
  skeleton.joints = {{"root", -1, {0, 1, 0}, axis_angle({0, 1, 0}, 0.7)}};
  character.skeleton = std::make_shared<const Skeleton>(skeleton);
  MeshPart part;
  part.name = "sheet";
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k)
      for (double value : {double(i), double(k), 0.2 * i * i - 0.1 * k * i})
        part.positions.push_back(static_cast<float>(value));
  part.triangles = {0, 1, 6};
  part.joint = 0;
  part.placed = affine({}, {}, {0.01, 0.01, 0.01});
  character.parts.push_back(part);
  return character;
}
const std::size_t paired[] = {0, 5, 14, 21, 30, 35};

// Markers on those vertices, in another place, size and heading; they move irregularly.
Points markers(const Character& character, double apart = 0) {
  Points points({"a", "b", "c", "d", "e", "f"}, 60, 4);
  const auto at = posed_vertices(character, character.parts[0], rest_pose_of(*character.skeleton));
  for (int m = 0; m < 6; ++m)
    for (std::size_t t = 0; t < 4; ++t) {
      const Vec3 moved{0.001 * double(t) * m, 0.002 * double(t), -0.003 * double(t * t) * (m % 2)};
      points.track(m).set(
          t, rotate(axis_angle({0, 0, 1}, apart), 2 * (at[paired[m]] + moved)) + apart * Vec3{5, 1, 2});
    }
  return points;
}

TEST(MarkerMesh, IsExactAtTheMarkersInEveryFrame) {
  Alone work;
  const Character character = sheet();
  MarkerMeshParams params;
  for (int m = 0; m < 6; ++m)
    params.pairs.push_back(std::string(1, char('a' + m)) + "=" + std::to_string(paired[m]));
  const Points points = markers(character, 0.4);
  const Character moving = marker_mesh(points, character, params, work);
  EXPECT_TRUE(work.reported.empty());
  EXPECT_FALSE(moving.non_finite());
  ASSERT_EQ(moving.morph_tracks.size(), 18u);
  const Pose rest = rest_pose_of(*character.skeleton);
  const auto still = posed_vertices(character, character.parts[0], rest);
  for (std::size_t t = 0; t < 4; ++t) {
    std::vector<double> weights;
    for (const MorphTrack& track : moving.morph_tracks) weights.push_back(track.weights[t]);
    const auto now = posed_vertices(moving, moving.parts[0], rest, weights);
    for (int m = 0; m < 6; ++m) {
      const Vec3 wanted{0.001 * double(t) * m, 0.002 * double(t), -0.003 * double(t * t) * (m % 2)};
      EXPECT_LT(norm(now[paired[m]] - still[paired[m]] - wanted), 1e-7) << t << " " << m;
    }
  }
}

TEST(MarkerMesh, CarriesAnAffineChangeToTheWholeMesh) {
  Alone work;
  const Character character = sheet();
  Points points = markers(character);
  const auto at = posed_vertices(character, character.parts[0], rest_pose_of(*character.skeleton));
  for (int m = 0; m < 6; ++m) {
    const Vec3 p = at[paired[m]];
    points.track(m).set(0, p);
    points.track(m).set(1, p + Vec3{0.1 * p.y, 0.05, 0.2 * p.x});
  }
  const Character moving = marker_mesh(points, character, {}, work);  // nearest vertices: those they lie on
  std::vector<double> weights;
  for (const MorphTrack& track : moving.morph_tracks) weights.push_back(track.weights[1]);
  const auto now = posed_vertices(moving, moving.parts[0], rest_pose_of(*character.skeleton), weights);
  for (std::size_t v = 0; v < now.size(); ++v)
    EXPECT_LT(norm(now[v] - (at[v] + Vec3{0.1 * at[v].y, 0.05, 0.2 * at[v].x})), 1e-6) << v;
}

TEST(MarkerMesh, RefusesWhatItCannotUse) {
  Alone work;
  const Character character = sheet();
  auto refused = [&](const Points& points, MarkerMeshParams params, const Character& mesh) -> Diagnostic {
    try {
      marker_mesh(points, mesh, params, work);
      return {};
    } catch (const Failure& failure) {
      return failure.diagnostic();
    }
  };
  auto code = [&](const Points& points, MarkerMeshParams params, const Character& mesh) {
    return refused(points, std::move(params), mesh).code;
  };
  Points points = markers(character);
  EXPECT_EQ(code(points, {{"x=1"}, 0}, character), "unknown-marker");
  EXPECT_EQ(code(points, {{"a=99"}, 0}, character), "bad-pair");
  EXPECT_EQ(code(points, {{"a=3", "b=3"}, 0}, character), "same-vertex");
  EXPECT_EQ(
      refused(points, {{"a=3", "b=3"}, 0}, character).hint,
      "name the vertices of three markers or more in pairs: they tell where the others look for theirs");
  EXPECT_EQ(code(points, {{}, 4}, character), "bad-frame");
  EXPECT_EQ(refused(points, {{}, 4}, character).hint, "they have frames 0 to 3");
  EXPECT_EQ(code(points, {}, Character()), "no-mesh");
  points.set_missing(2, 3);
  EXPECT_EQ(code(points, {}, character), "missing-samples");
}

}  // namespace
}  // namespace kinegraph
