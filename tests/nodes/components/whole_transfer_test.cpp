// Transfers on the named pairs of real clips, both ways: all components with the other's timing, and bones
// and directions after an edit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "tests/nodes/components/clips.h"
#include "tests/nodes/components/plain_tables.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
NodeType component_edit_node();
namespace {

using namespace plain;

struct Way {
  const char *first, *second;
  std::size_t to;  // the segment that receives
  friend void PrintTo(const Way& way, std::ostream* out) {
    *out << (way.to ? way.second : way.first) << " <- " << (way.to ? way.first : way.second);
  }
};
const Way ways[] = {{"16_31", "17_03", 0}, {"16_31", "17_03", 1}, {"07_05", "17_03", 0},
                    {"07_05", "17_03", 1}, {"16_45", "17_03", 0}, {"16_45", "17_03", 1},
                    {"16_45", "16_31", 0}, {"16_45", "16_31", 1}};

class TransfersBetweenRealClips : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    KINEGRAPH_NEEDS_MOCAP();
    const Way& way = GetParam();
    to = way.to;
    from = 1 - to;
    Alone work;
    clips = {real_clip(fmt::format("cmu/asfamc/{}.amc", way.first)),
             real_clip(fmt::format("cmu/asfamc/{}.amc", way.second))};
    c = analysed(clips, Representation::points, 3, work);
  }
  NodeInMemory edited(const std::string& edits, bool limbs) {
    NodeInMemory node(component_edit_node());
    const Json list = parse_value(*component_edit_node().find_param("edits"), edits);
    return node.link("components", c).set("edits", list).set("limbs", limbs).run();
  }
  std::string transfer(const char* components, const char* more) const {
    return fmt::format(R"([{{"op":"transfer","components":{},"from":{},"to":{}{}}}])", components, from, to,
                       more);
  }

  std::size_t to = 0, from = 1;
  Clips clips;
  Components c;
};
INSTANTIATE_TEST_SUITE_P(Of, TransfersBetweenRealClips, testing::ValuesIn(ways), [](const auto& way) {
  return fmt::format("{}_{}_to_{}", way.param.first, way.param.second, way.param.to);
});

// x' = the giver's points without root and heading, but for what a singular value decomposition of both clips
// leaves out at rank k.
TEST_P(TransfersBetweenRealClips, OfAllComponentsInTheGiversTimingGiveItsPointsOnTheBasesPath) {
  NodeInMemory node = edited(transfer("[1,2,3]", R"(,"keep_timing_of":"from")"), false);
  const auto& points = node.out<Points>("points");
  ASSERT_EQ(points.frames, clips[from]->frames());

  const Skeleton& bones = clips[0]->skeleton();
  const Table own[] = {channels_of(*clips[0], &bones), channels_of(*clips[1], &bones)};
  Eigen::MatrixXd x(static_cast<Eigen::Index>(own[0].size()),
                    static_cast<Eigen::Index>(own[0][0].size() + own[1][0].size()));
  for (Eigen::Index d = 0; d < x.rows(); ++d) {
    Eigen::Index at = 0;
    for (const Table& one : own)
      for (double value : one[static_cast<std::size_t>(d)]) x(d, at++) = value;
  }
  const Eigen::VectorXd mean = x.rowwise().mean();
  const Eigen::MatrixXd centred = x.colwise() - mean;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred.transpose(), Eigen::ComputeThinV);
  const Eigen::MatrixXd axes = svd.matrixV().leftCols(3);
  const Eigen::MatrixXd kept = (axes * (axes.transpose() * centred)).colwise() + mean;
  const std::size_t start = from == 0 ? 0 : own[0][0].size();

  // The base's path, in the giver's timing: every frame of it lies on the base's own, which it goes through
  // from end to end and never backwards.
  const auto path = independent::positions_of(*clips[to])[0];
  const auto psi = independent::heading_of(*clips[to]).psi;
  const auto& base = *node.out<Components>("components").segments[to].motion;
  const auto placed = independent::positions_of(base)[0];
  const auto heading = independent::heading_of(base).psi;
  double time = 0, off_path = 0, off_heading = 0;
  for (std::size_t t = 0; t < placed.size(); ++t) {
    double nearest = 1e9, at = time, turned = 0;
    for (auto low = static_cast<std::size_t>(time);
         low + 1 < path.size() && static_cast<double>(low) < time + 40; ++low) {
      const Vec3 step = path[low + 1] - path[low];
      const double part = std::clamp(dot(placed[t] - path[low], step) / std::max(dot(step, step), 1e-18),
                                     std::max(0.0, time - static_cast<double>(low)), 1.0);
      const double d = norm(placed[t] - path[low] - part * step);
      if (d < nearest)
        nearest = d, at = static_cast<double>(low) + part,
        turned =
            std::fabs(std::remainder(heading[t] - (psi[low] + part * (psi[low + 1] - psi[low])), 2 * M_PI));
    }
    time = at;
    off_path = std::max(off_path, nearest);
    off_heading = std::max(off_heading, turned);
  }
  EXPECT_LT(off_path, 1e-4);
  EXPECT_LT(off_heading, 0.1 * M_PI / 180);
  EXPECT_GT(time, 0.98 * static_cast<double>(path.size() - 1));

  double off = 0, square = 0, left_out = 0;
  for (std::size_t t = 0; t < points.frames; ++t) {
    const double co = std::cos(heading[t]), si = std::sin(heading[t]);
    for (std::size_t j = 0; j < points.labels.size(); ++j) {
      const auto d = static_cast<Eigen::Index>(3 * j), column = static_cast<Eigen::Index>(start + t);
      const Vec3 is = points.track(static_cast<int>(j))[t] - placed[t];
      const Vec3 unturned{co * is.x - si * is.z, is.y, si * is.x + co * is.z};
      off = std::max(off, norm(unturned - Vec3{kept(d, column), kept(d + 1, column), kept(d + 2, column)}));
      const Vec3 wanted{x(d, column), x(d + 1, column), x(d + 2, column)},
          residual = wanted - Vec3{kept(d, column), kept(d + 1, column), kept(d + 2, column)};
      square += dot(unturned - wanted, unturned - wanted);
      left_out += dot(residual, residual);
    }
  }
  EXPECT_LT(off, 1e-9) << "m";
  EXPECT_NEAR(std::sqrt(square / left_out), 1, 1e-9);
}

TEST_P(TransfersBetweenRealClips, KeepBonesAndDirectionsWithLimbs) {
  for (const char* component : {"1", "2", "3", "[1,2,3]"}) {
    SCOPED_TRACE(component);
    NodeInMemory node = edited(transfer(component, ""), true), loose = edited(transfer(component, ""), false);
    const auto &points = node.out<Points>("points"), &raw = loose.out<Points>("points");
    const Motion& motion = node.out<Motion>("motion");
    const Skeleton& bones = motion.skeleton();
    const auto places = independent::positions_of(motion);
    double length = 0, point_length = 0, direction = 0, turned = 0, stretched = 0;
    for (int j = 1; j < bones.size(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const int parent = bones.joints[at].parent;
      const double rest = bones.link_length(j);
      if (rest < 1e-9) continue;
      for (std::size_t t = 0; t < points.frames; ++t) {
        const Vec3 free = raw.track(j)[t] - raw.track(parent)[t],
                   link = points.track(j)[t] - points.track(parent)[t],
                   bone = places[at][t] - places[static_cast<std::size_t>(parent)][t];
        length = std::max(length, std::fabs(norm(bone) - rest));
        point_length = std::max(point_length, std::fabs(norm(link) - rest));
        stretched = std::max(stretched, std::fabs(norm(free) / rest - 1));
        direction = std::max(direction, norm(normalized(link) - normalized(free)));
        turned = std::max(turned, norm(normalized(bone) - normalized(free)));
      }
    }
    EXPECT_GT(stretched, 0.001) << "or the test shows nothing";
    EXPECT_LT(length, 1e-6) << "m";
    EXPECT_LT(point_length, 1e-6) << "m";
    EXPECT_LT(direction, 1e-9);
    // In an AMC every link hangs on a joint of its own, so that the motion keeps all of them.
    EXPECT_LT(turned, 1e-7);
  }
}

}  // namespace
}  // namespace kinegraph
