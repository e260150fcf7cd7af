#include "nodes/points/marker_mesh.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <map>

#include "nodes/motion/fill_gaps.h"

namespace kinegraph {

namespace {

using Matrix = Eigen::MatrixXd;

Eigen::Vector3d vector(Vec3 v) {
  return {v.x, v.y, v.z};
}
Vec3 vec3(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

struct Similarity {
  double scale = 1;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  Vec3 operator()(Vec3 p) const { return vec3(scale * turned * vector(p) + moved); }
};

// The least-squares similarity from one list of points to another (Umeyama 1991). One or two points, or
// points on one spot, only move.
Similarity fitted(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  const double count = static_cast<double>(from.size());
  Eigen::Vector3d mean_from = Eigen::Vector3d::Zero(), mean_to = mean_from;
  for (std::size_t i = 0; i < from.size(); ++i) {
    mean_from += vector(from[i]) / count;
    mean_to += vector(to[i]) / count;
  }
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  double spread = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector3d a = vector(from[i]) - mean_from, b = vector(to[i]) - mean_to;
    across += b * a.transpose() / count;
    spread += a.squaredNorm() / count;
  }
  Similarity fit;
  if (from.size() >= 3 && spread > 0) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(across, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d sign(1, 1, 1);
    if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign.z() = -1;
    fit.turned = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    fit.scale = svd.singularValues().dot(sign) / spread;
    if (!(fit.scale > 0)) fit.scale = 1;
  }
  fit.moved = mean_to - fit.scale * fit.turned * mean_from;
  return fit;
}

// What a vertex's own coordinates become in the rest pose.
std::vector<Affine> rest_maps(const Character& character, const MeshPart& part, const Pose& rest) {
  auto world = [&](int joint) { return affine(rest.positions[joint], rest.orientations[joint]); };
  std::vector<Affine> maps(part.vertices(),
                           part.skin < 0 && part.joint >= 0 ? world(part.joint) * part.placed : part.placed);
  if (part.skin < 0) return maps;
  const Skin& skin = character.skins[part.skin];
  std::vector<Affine> of_joint;
  for (std::size_t k = 0; k < skin.joints.size(); ++k)
    of_joint.push_back(world(skin.joints[k]) * skin.inverse_bind[k]);
  for (std::size_t v = 0; v < maps.size(); ++v) maps[v] = skinning_map(part, v, of_joint);
  return maps;
}

std::map<int, std::size_t> named_pairs(const Points& points, const std::vector<std::string>& pairs,
                                       std::size_t vertices) {
  std::map<int, std::size_t> vertex_of;
  for (const std::string& pair : pairs) {
    const std::size_t equals = pair.find_last_of('=');
    std::size_t vertex = 0;
    if (equals == std::string::npos ||
        std::from_chars(pair.data() + equals + 1, pair.data() + pair.size(), vertex).ptr !=
            pair.data() + pair.size() ||
        equals + 1 == pair.size() || vertex >= vertices)
      throw Failure(error("bad-pair", fmt::format("\"{}\" names no vertex", pair))
                        .hinting(fmt::format("write MARKER=VERTEX, a vertex from 0 to {}", vertices - 1))
                        .at_param("pairs"));
    const std::string name = pair.substr(0, equals);
    const auto label = std::find(points.labels.begin(), points.labels.end(), name);
    if (label == points.labels.end())
      throw Failure(error("unknown-marker", fmt::format("there is no marker {}", name))
                        .hinting(suggestion(name, points.labels))
                        .at_param("pairs"));
    vertex_of[static_cast<int>(label - points.labels.begin())] = vertex;
  }
  return vertex_of;
}

void check_whole(const Points& points) {
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label)
    if (const std::vector<Gap> gaps = gaps_of(points, label); !gaps.empty())
      throw Failure(
          error("missing-samples", fmt::format("{} is missing in frames {} to {}", points.labels[label],
                                               gaps[0].first, gaps[0].last - 1))
              .hinting("raise Load's max_gap, or choose a range without gaps")
              .at_port("points")
              .at_joint(points.labels[label])
              .at_frame(static_cast<std::int64_t>(gaps[0].first)));
}

}  // namespace

Character marker_mesh(const Points& points, const Character& character, const MarkerMeshParams& params,
                      Work& work) {
  const int markers = static_cast<int>(points.labels.size());
  if (params.rest_frame < 0 || static_cast<std::size_t>(params.rest_frame) >= points.frames)
    throw Failure(error("bad-frame", fmt::format("the points have no frame {}", params.rest_frame))
                      .at_param("rest_frame")
                      .hinting(points.frames == 0
                                   ? std::string("they have no frames")
                                   : fmt::format("they have frames 0 to {}", points.frames - 1)));
  check_whole(points);
  const auto rest_frame = static_cast<std::size_t>(params.rest_frame);
  const Pose rest = rest_pose_of(*character.skeleton);
  std::vector<std::vector<Affine>> maps;
  std::vector<Vec3> vertices;  // of all parts, world
  for (const MeshPart& part : character.parts) {
    maps.push_back(rest_maps(character, part, rest));
    for (std::size_t v = 0; v < part.vertices(); ++v)
      vertices.push_back(point(maps.back()[v], part.position(v)));
  }
  if (vertices.empty() || markers == 0)
    throw Failure(
        error("no-mesh", vertices.empty() ? "the character has no vertices" : "there are no markers"));

  const std::map<int, std::size_t> named = named_pairs(points, params.pairs, vertices.size());
  std::vector<Vec3> at_rest;
  for (int m = 0; m < markers; ++m) at_rest.push_back(points.track(m)[rest_frame]);
  // Named pairs tell how the markers lie to the mesh; the others look for their vertex from there.
  Similarity fit;
  if (named.size() >= 3) {
    std::vector<Vec3> from, to;
    for (const auto& [marker, vertex] : named) {
      from.push_back(at_rest[marker]);
      to.push_back(vertices[vertex]);
    }
    fit = fitted(from, to);
  }
  std::vector<std::size_t> vertex_of;
  std::vector<Vec3> targets;
  for (int m = 0; m < markers; ++m) {
    auto found = named.find(m);
    std::size_t vertex = found != named.end() ? found->second : 0;
    if (found == named.end()) {
      const Vec3 near = fit(at_rest[m]);
      for (std::size_t v = 1; v < vertices.size(); ++v)
        if (norm(vertices[v] - near) < norm(vertices[vertex] - near)) vertex = v;
    }
    for (int other = 0; other < m; ++other)
      if (vertices[vertex_of[other]] == vertices[vertex])
        throw Failure(error("same-vertex", fmt::format("{} and {} stand on one vertex, {}",
                                                       points.labels[other], points.labels[m], vertex))
                          .hinting(named.size() < 3
                                       ? "name the vertices of three markers or more in pairs: they tell "
                                         "where the others look for theirs"
                                       : "name their vertices in pairs")
                          .at_param("pairs"));
    vertex_of.push_back(vertex);
    targets.push_back(vertices[vertex]);
    work.check();
  }
  fit = fitted(at_rest, targets);
  Vec3 middle;
  for (Vec3 target : targets) middle += target / markers;
  double apart = 0, spread = 0;
  for (int m = 0; m < markers; ++m) {
    apart += norm(fit(at_rest[m]) - targets[m]) / markers;
    spread += norm(targets[m] - middle) / markers;
  }
  if (apart > 0.2 * spread)
    work.report(
        warning("far-markers", fmt::format("the markers lie {:.3g} m from their vertices in the mean, "
                                           "in a cloud of {:.3g} m",
                                           apart, spread))
            .hinting("name some vertices in pairs")
            .at_param("pairs"));

  // Σ_m w_m ‖x_k − x_m‖ + affine(x_k) = d_k with Σ w_m = 0, Σ w_m x_m = 0, solved for d = each unit vector:
  // column m of the solution tells how much marker m moves any x. Markers in one plane leave part of the
  // affine open; the smallest is taken.
  Matrix system = Matrix::Zero(markers + 4, markers + 4);
  for (int k = 0; k < markers; ++k) {
    for (int m = 0; m < markers; ++m) system(k, m) = norm(targets[k] - targets[m]);
    const double affine_row[] = {1, targets[k].x - middle.x, targets[k].y - middle.y,
                                 targets[k].z - middle.z};
    for (int i = 0; i < 4; ++i) system(k, markers + i) = system(markers + i, k) = affine_row[i];
  }
  Matrix unit = Matrix::Zero(markers + 4, markers);
  unit.topRows(markers).setIdentity();
  const Matrix solved = Eigen::CompleteOrthogonalDecomposition<Matrix>(system).solve(unit);

  Character out = character;
  const auto held = work.reserve(vertices.size() * static_cast<std::size_t>(markers) * 36);
  out.morph_tracks.clear();
  out.morph_fps = points.fps;
  std::size_t first_vertex = 0;
  Eigen::RowVectorXd basis(markers + 4);
  for (std::size_t p = 0; p < out.parts.size(); ++p) {
    MeshPart& part = out.parts[p];
    const std::size_t had = part.morphs.size();
    for (int m = 0; m < markers; ++m)
      for (char axis : {'x', 'y', 'z'})
        part.morphs.push_back(
            {fmt::format("{}.{}", points.labels[m], axis), std::vector<float>(part.positions.size()), {}});
    for (std::size_t v = 0; v < part.vertices(); ++v) {
      if (v % 64 == 0) work.check();
      const Vec3 x = vertices[first_vertex + v];
      for (int m = 0; m < markers; ++m) basis(m) = norm(x - targets[m]);
      basis(markers) = 1;
      for (int i = 0; i < 3; ++i) basis(markers + 1 + i) = x[i] - middle[i];
      const Eigen::RowVectorXd share = basis * solved;
      const Affine back = inverse(maps[p][v]);
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 along;
        along[axis] = 1;
        const Vec3 own = direction(back, along);
        for (int m = 0; m < markers; ++m) {
          float* to = part.morphs[had + static_cast<std::size_t>(3 * m + axis)].positions.data() + 3 * v;
          for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(share(m) * own[i]);
        }
      }
    }
    first_vertex += part.vertices();
    for (int m = 0; m < markers; ++m) {
      std::vector<double> weights[3];
      for (std::size_t t = 0; t < points.frames; ++t) {
        const Vec3 moved = fit(points.track(m)[t]) - fit(at_rest[m]);
        for (int axis = 0; axis < 3; ++axis) weights[axis].push_back(moved[axis]);
      }
      for (int axis = 0; axis < 3; ++axis)
        out.morph_tracks.push_back(
            {static_cast<int>(p), static_cast<int>(had) + 3 * m + axis, std::move(weights[axis])});
    }
  }
  return out;
}

}  // namespace kinegraph
