#include "nodes/components/ica.h"

#include <gmock/gmock.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/components/principal.h"
#include "nodes/motion/kinematics.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
NodeType ica_node();
namespace {

using testing::HasSubstr;

constexpr Representation all_representations[] = {Representation::points, Representation::quaternions,
                                                  Representation::euler, Representation::logarithm};

Clips walk_and_sneak() {
  return {shared(turning(gait("walk", 2), 0.6)), shared(gait("sneak", 2.3))};
}

// The channels of all clips side by side.
Rows channels_of_all(const Components& components, Work& work) {
  Rows out(components.space.channels(), components.frames());
  std::vector<double> before;
  for (const ComponentSegment& segment : components.segments) {
    const Rows part = channels_of(components.space, *segment.motion, before, work);
    before.clear();
    for (std::size_t d = 0; d < out.rows; ++d) {
      std::copy_n(part.row(d), part.columns, out.row(d) + segment.start);
      before.push_back(part(d, part.columns - 1));
    }
  }
  return out;
}
Rows rebuilt_channels(const Components& components) {
  Rows x = product(components.mixing, components.signals);
  for (std::size_t d = 0; d < x.rows; ++d)
    for (std::size_t t = 0; t < x.columns; ++t) x(d, t) += components.mean[d];
  return x;
}
double largest_range(const Rows& rows) {
  double range = 0;
  for (std::size_t i = 0; i < rows.rows; ++i) {
    const auto [low, high] = std::minmax_element(rows.row(i), rows.row(i) + rows.columns);
    range = std::max(range, *high - *low);
  }
  return range;
}
double largest_difference(const Rows& a, const Rows& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) worst = std::max(worst, std::fabs(a.data[i] - b.data[i]));
  return worst;
}
std::size_t rank_of(const Clips& clips, Representation representation) {
  Alone work;
  const std::vector<bool> all(clips.front()->joints(), true);
  const ChannelSpace space = space_of_motions(representation, clips, all, true, {}, work);
  Components only{};
  only.space = space;
  std::size_t at = 0;
  std::vector<ComponentSegment> segments;
  for (const auto& clip : clips) {
    segments.push_back({at, at + clip->frames(), clip, nullptr, {}});
    at += clip->frames();
  }
  only.segments = segments;
  only.signals = Rows(1, at);
  return principal_components(channels_of_all(only, work), work).rank;
}

TEST(IcaOfMotions, GivesBackEveryClipWithAllComponents) {
  Alone work;
  const Clips clips = walk_and_sneak();
  for (Representation representation : all_representations) {
    const auto rank = static_cast<int>(rank_of(clips, representation));
    const Components components = analysed(clips, representation, rank, work);
    const Rows x = channels_of_all(components, work), again = rebuilt_channels(components);
    EXPECT_LT(largest_difference(x, again), 1e-9 * largest_range(x)) << name_of(representation);
    for (const ComponentSegment& segment : components.segments) {
      Rows part(again.rows, segment.frames());
      for (std::size_t d = 0; d < again.rows; ++d)
        std::copy_n(again.row(d) + segment.start, part.columns, part.row(d));
      const Motion back = motion_from_channels(components.space, part, *segment.motion, {}, work);
      const Difference worst = difference(back, *segment.motion);
      EXPECT_LT(worst.turn, 2e-7) << name_of(representation);  // arccos near 1 knows no better
      EXPECT_LT(worst.position, 1e-12) << name_of(representation);
      const WorldMotion a = world_motion(back), b = world_motion(*segment.motion);
      double apart = 0;
      for (int j = 0; j < back.joints(); ++j)
        for (std::size_t t = 0; t < back.frames(); ++t)
          apart = std::max(apart, norm(a.position(j)[t] - b.position(j)[t]));
      EXPECT_LT(apart, 1e-9 * largest_range(x)) << name_of(representation);
    }
  }
}

// The error left by k components over that left by projecting onto the first k singular vectors.
double error_over_rank_k_error(const Clips& clips, Representation representation, int k) {
  Alone work;
  const Components components = analysed(clips, representation, k, work);
  const Rows x = channels_of_all(components, work);
  Eigen::MatrixXd centred(x.rows, x.columns);
  for (std::size_t d = 0; d < x.rows; ++d)
    for (std::size_t t = 0; t < x.columns; ++t)
      centred(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(t)) = x(d, t);
  centred.colwise() -= centred.rowwise().mean().eval();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred.transpose(), Eigen::ComputeThinV);
  const Eigen::MatrixXd axes = svd.matrixV().leftCols(k);
  const double expected = (centred - axes * (axes.transpose() * centred)).norm();
  const Rows again = rebuilt_channels(components);
  double square = 0;
  for (std::size_t i = 0; i < x.data.size(); ++i)
    square += (x.data[i] - again.data[i]) * (x.data[i] - again.data[i]);
  return std::sqrt(square) / expected;
}

TEST(IcaOfMotions, LeavesTheRankKErrorOfASingularValueDecomposition) {
  for (Representation representation : all_representations)
    EXPECT_NEAR(error_over_rank_k_error(walk_and_sneak(), representation, 4), 1, 1e-9)
        << name_of(representation);
}

TEST(IcaOfMotions, TakesPathAndHeadingOut) {
  Alone work;
  const Motion walk = gait("walk", 2);
  const Components straight = analysed({shared(walk)}, Representation::points, 3, work),
                   round = analysed({shared(turning(walk, 2.0))}, Representation::points, 3, work);
  EXPECT_LT(largest_difference(straight.mixing, round.mixing), 1e-7);
  for (std::size_t c = 0; c < 3; ++c) {  // the root is the origin
    EXPECT_EQ(straight.mean[c], 0);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(straight.mixing(c, i), 0);
  }
}

TEST(IcaOfMotions, TakesTheFirstClipsBoneLengths) {
  Alone work;
  const Motion walk = gait("walk", 2);
  Skeleton taller = walk.skeleton();
  for (std::size_t j = 1; j < taller.joints.size(); ++j) taller.joints[j].offset *= 1.3;
  Motion other(std::make_shared<const Skeleton>(taller), walk.shared_source(), walk.fps(), walk.frames(),
               walk.translating());
  for (int j = 0; j < walk.joints(); ++j)
    for (std::size_t t = 0; t < walk.frames(); ++t) other.rotation(j).set(t, walk.rotation(j)[t]);
  const Components components = analysed({shared(walk), shared(other)}, Representation::points, 2, work);
  const Rows x = channels_of_all(components, work);
  for (std::size_t d = 0; d < x.rows; ++d)
    for (std::size_t t = 0; t < walk.frames(); ++t) ASSERT_NEAR(x(d, t), x(d, t + walk.frames()), 1e-12);
}

TEST(IcaOfMotions, FindsPartnersOfOtherNamesByMap) {
  Motion walk = gait("walk", 2);
  Skeleton renamed = walk.skeleton();
  renamed.joints[1].name = "Elsewhere";
  Motion other(std::make_shared<const Skeleton>(renamed), walk.shared_source(), walk.fps(), walk.frames(),
               walk.translating());
  NodeInMemory node(ica_node());
  node.link("motions", walk).link("motions", other);
  const Diagnostic refusal = NodeInMemory(node).refusal();
  EXPECT_EQ(refusal.code, "joint-missing");
  EXPECT_EQ(refusal.joint, walk.skeleton().joints[1].name);
  Json::Array map;
  for (std::size_t j = 0; j < renamed.joints.size(); ++j)
    map.push_back(renamed.joints[j].name + "=" + walk.skeleton().joints[j].name);
  node.set("map", map).run();
  EXPECT_EQ(node.out<Components>("components").segments.size(), 2u);
}

TEST(IcaNode, RemembersSegmentsAndConvergence) {
  NodeInMemory node(ica_node());
  node.link("motions", gait("walk", 2)).link("motions", gait("sneak", 2.5)).set("components", 3).run();
  const auto& components = node.out<Components>("components");
  ASSERT_EQ(components.segments.size(), 2u);
  EXPECT_EQ(components.segments[1].start, components.segments[0].end);
  EXPECT_EQ(components.segments[1].end, components.frames());
  EXPECT_EQ(components.count(), 3u);
  EXPECT_LT(components.reached, components.tolerance);
  double share = 0;
  for (double s : components.shares) share += s;
  EXPECT_GT(share, 0.5);
  EXPECT_LE(share, 1 + 1e-12);
}

TEST(IcaNode, SurvivesTheDiskCache) {
  NodeInMemory node(ica_node());
  node.link("motions", gait("walk", 1)).set("components", 2).set("representation", "logarithm").run();
  const std::string bytes = encoded(node.out<Components>("components"));
  Decoder in(bytes);
  EXPECT_EQ(encoded(*decode_components(in)), bytes);
  EXPECT_TRUE(in.at_end());
}

TEST(IcaNode, TellsOfAMapThatSaysNothing) {
  const auto asked = [](const char* representation, const char* entry) {
    NodeInMemory node(ica_node());
    node.link("motions", gait("walk", 1)).link("motions", gait("sneak", 1)).set("components", 2);
    node.set("representation", representation).set("map", Json::Array{entry});
    return node;
  };
  for (const char* representation : {"points", "logarithm"}) {
    EXPECT_EQ(asked(representation, "Heels=Hips").refusal().code, "unknown-joint");
    NodeInMemory node = asked(representation, "Hips=Hips");
    node.run();
    ASSERT_EQ(node.reported().size(), 1u) << representation;
    EXPECT_EQ(node.reported()[0].code, "map-unused");
  }
}

TEST(IcaNode, RefusesWhatCantBeDecomposed) {
  const Motion walk = gait("walk", 1);
  const auto refusal = [](const Motion& motion, const char* param = nullptr, Json value = {}) {
    NodeInMemory node(ica_node());
    node.link("motions", motion);
    if (param) node.set(param, std::move(value));
    return node.refusal();
  };
  EXPECT_EQ(refusal(walk.empty_like(1)).code, "too-few-frames");
  EXPECT_EQ(refusal(walk.empty_like(0)).code, "too-few-frames");
  EXPECT_EQ(refusal(walk.empty_like(50)).code, "no-variance");
  const Diagnostic many = refusal(walk, "components", 900);
  EXPECT_EQ(many.code, "too-many-components");
  EXPECT_EQ(many.param, "components");
  EXPECT_THAT(many.message, HasSubstr("span only"));
  EXPECT_EQ(refusal(walk, "joints", "").code, "no-joints");
  NodeInMemory rates(ica_node());
  const Diagnostic rate = rates.link("motions", walk).link("motions", gait("walk", 1, 30)).refusal();
  EXPECT_EQ(rate.code, "rate-mismatch");
  EXPECT_EQ(rate.port, "motions");
  EXPECT_THAT(rate.message, HasSubstr("clip 0 has 60 frames per second and clip 1 has 30"));
  EXPECT_THAT(rate.hint, HasSubstr("put a Resample node"));
  Points slow({"A"}, 10, 3), fast({"A"}, 60, 3);
  NodeInMemory cloud(ica_node());
  const Diagnostic of_points = cloud.link("motions", slow).link("motions", fast).refusal();
  EXPECT_EQ(of_points.code, "rate-mismatch");
  EXPECT_THAT(of_points.hint, HasSubstr("set `fps` of clip 1's Load to 10"));
  EXPECT_THAT(rate.hint, HasSubstr("put a Resample node with fps 60 before clip 1"));
}

// Five labels on a shaking and travelling head, two of which also move on their own.
Points face(std::size_t frames, bool shakes,
            std::vector<std::string> labels = {"a", "b", "c", "brow", "jaw"}) {
  Points points(std::move(labels), 60, frames);
  const Vec3 rest[] = {{0, 0.1, 0}, {0.1, -0.1, 0}, {-0.1, -0.1, 0.05}, {0.05, 0.05, 0.1}, {0, -0.2, 0.1}};
  for (std::size_t t = 0; t < frames; ++t) {
    const double s = static_cast<double>(t) / 60;
    for (int i = 0; i < 5; ++i) {
      Vec3 at = rest[i];
      if (i == 3) at.y += 0.02 * sine(7 * s) * sine(7 * s);
      if (i == 4) at.y -= 0.03 * std::max(0.0, sine(4.1 * s));
      if (shakes) at = rotate(about_y(sine(2 * s)), at) + Vec3{s, 0.3 * cosine(s), 0};
      points.track(i).set(t, at);
    }
  }
  return points;
}

TEST(IcaOfPoints, GivesBackTheClip) {
  Alone work;
  for (Stabilise stabilise : {Stabilise::none, Stabilise::centroid, Stabilise::rigid}) {
    const auto clip = std::make_shared<const Points>(face(200, true));
    ChannelSpace space = space_of_points({clip}, stabilise, {true, true, true, false, false});
    if (stabilise == Stabilise::none) {
      EXPECT_EQ(space.labels.size(), 3u) << "chosen ones are the channels";
      space = space_of_points({clip}, stabilise, std::vector<bool>(5, true));
    }
    IcaParams params;
    params.variance = 1;
    const Components components = components_of_points(space, {clip}, params, work);
    const Points back = points_from_channels(components.space, rebuilt_channels(components), *clip, {});
    for (std::size_t i = 0; i < clip->data.size(); ++i) ASSERT_NEAR(back.data[i], clip->data[i], 1e-9);
  }
}

TEST(IcaOfPoints, TakesTheRigidMotionOfChosenLabelsOut) {
  Alone work;
  const auto still = std::make_shared<const Points>(face(200, false)),
             shaken = std::make_shared<const Points>(face(200, true));
  const std::vector<bool> head = {true, true, true, false, false};
  IcaParams params;
  params.components = 2;
  params.fast_ica.tolerance = 1e-15;
  const auto a = components_of_points(space_of_points({still}, Stabilise::rigid, head), {still}, params,
                                      work),
             b = components_of_points(space_of_points({shaken}, Stabilise::rigid, head), {shaken}, params,
                                      work);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t t = 0; t < 200; ++t) ASSERT_NEAR(a.signals(i, t), b.signals(i, t), 1e-9);
}

TEST(IcaOfPoints, RefusesGapsAndOtherLabels) {
  NodeInMemory node(ica_node());
  Points gaps = face(50, false);
  for (std::size_t t : {4, 5, 6, 11}) gaps.set_missing(3, t);
  const Diagnostic gap = node.link("motions", gaps).refusal();
  EXPECT_EQ(gap.code, "gaps");
  EXPECT_THAT(gap.message, HasSubstr("'brow' of the clip is missing at frames 4 to 6, 11"));
  NodeInMemory without(ica_node());
  without.link("motions", gaps).set("joints", "-brow").set("components", 1).run();
  NodeInMemory labels(ica_node());
  labels.link("motions", face(50, false)).link("motions", face(50, false, {"a", "b", "c", "brow", "chin"}));
  EXPECT_THAT(labels.refusal().message, HasSubstr("clip 1 has no point 'jaw'"));
  NodeInMemory mixed(ica_node());
  mixed.link("motions", face(50, false)).link("motions", gait("walk", 1));
  EXPECT_EQ(mixed.refusal().code, "mixed-inputs");
}

const char* const named_pairs[][2] = {
    {"16_31", "17_03"}, {"07_05", "17_03"}, {"16_45", "17_03"}, {"16_45", "16_31"}};
Clips real_pair(const char* const (&names)[2]) {
  Clips clips;
  for (const char* name : names) clips.push_back(real_clip(std::string("cmu/asfamc/") + name + ".amc"));
  return clips;
}

TEST(IcaOfRealClips, LeavesTheRankKErrorOfASingularValueDecomposition) {
  KINEGRAPH_NEEDS_MOCAP();
  for (const auto& names : named_pairs)
    for (Representation representation : all_representations)
      for (int k : {3, 12})
        EXPECT_NEAR(error_over_rank_k_error(real_pair(names), representation, k), 1, 1e-9)
            << names[0] << " with " << names[1] << ", " << name_of(representation) << ", " << k;
}

// Their root stays put while the hips travel; told anew, the first frame's hips are no rest pose.
TEST(IcaOfRealClips, OfOneStudioHaveNoOtherRestPoses) {
  KINEGRAPH_NEEDS_MOCAP();
  for (Representation representation : all_representations) {
    NodeInMemory node(ica_node());
    for (const char* style : {"normal", "old", "proud"})
      node.link("motions", ValuePtr(real_clip(std::string("bandai/dataset-1_walk_") + style + "_001.bvh")));
    node.set("representation", name_of(representation)).set("components", 3).run();
    for (const Diagnostic& d : node.reported()) EXPECT_NE(d.code, "rest-pose-differs") << d.message;
  }
}

// Steps of FastICA may make two rows nearly the same, which must not blow up what becomes of them.
TEST(IcaOfRealClips, HaveSignalsOfUnitVarianceWithoutCorrelation) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  for (const auto& names : named_pairs) {
    const Clips clips = real_pair(names);
    const ChannelSpace space = space_of_motions(Representation::points, clips,
                                                std::vector<bool>(clips[0]->joints(), true), true, {}, work);
    for (int k : {3, 12, 30}) {
      for (Nonlinearity nonlinearity : {Nonlinearity::logcosh, Nonlinearity::pow3, Nonlinearity::gauss}) {
        for (bool symmetric : {true, false}) {
          IcaParams params;
          params.components = k;
          params.starts = k == 12 && symmetric ? 8 : 1;
          params.fast_ica = {nonlinearity, symmetric, 1e-4, 15};
          const Components c = components_of_motions(space, clips, params, work);
          double worst = 0;
          for (std::size_t i = 0; i < c.count(); ++i)
            for (std::size_t j = 0; j <= i; ++j) {
              double sum = 0;
              for (std::size_t t = 0; t < c.frames(); ++t) sum += c.signals(i, t) * c.signals(j, t);
              worst = std::max(worst, std::fabs(sum / static_cast<double>(c.frames()) - (i == j)));
            }
          EXPECT_LT(worst, 1e-8) << names[0] << " with " << names[1] << ", " << k << ", nonlinearity "
                                 << static_cast<int>(nonlinearity) << (symmetric ? "" : ", deflation");
        }
      }
    }
  }
}

TEST(IcaOfRealClips, ComeBackFromAllTheirComponents) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  for (const auto& names : named_pairs) {
    const Clips clips = real_pair(names);
    for (Representation representation : all_representations) {
      const auto rank = static_cast<int>(rank_of(clips, representation));
      const Components components = analysed(clips, representation, rank, work, false);
      const Rows x = channels_of_all(components, work), again = rebuilt_channels(components);
      EXPECT_LT(largest_difference(x, again), 1e-9 * largest_range(x))
          << names[0] << " with " << names[1] << ", " << name_of(representation) << ", rank " << rank;
    }
  }
}

}  // namespace
}  // namespace kinegraph
