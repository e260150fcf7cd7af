#include "nodes/motion/motion.h"

#include <gtest/gtest.h>

#include <limits>

#include "graph/diagnostic.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/metrics.h"
#include "nodes/motion/points.h"
#include "nodes/style/stats.h"
#include "nodes/time/warp.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(Motion, begins_at_the_rest_pose) {
  Skeleton skeleton = sample_skeleton();
  skeleton.joints[3].rest = axis_angle({1, 0, 0}, 0.3);
  std::vector<bool> translates(skeleton.joints.size());
  translates[0] = translates[3] = true;
  Motion motion(std::make_shared<const Skeleton>(skeleton), nullptr, 30, 5, translates);
  EXPECT_EQ(motion.rotation(3)[4], skeleton.joints[3].rest);
  EXPECT_EQ(motion.translation(3)[4], skeleton.joints[3].offset);
  EXPECT_EQ(motion.translation(0)[0], skeleton.joints[0].offset);
  EXPECT_EQ(motion.local_offset(5, 2), skeleton.joints[5].offset);
  EXPECT_EQ(motion.translating(), translates);
}

TEST(Motion, channels_are_contiguous_in_time_and_dont_overlap) {
  Motion motion = sample_motion(7);
  auto q = motion.rotation(2);
  EXPECT_EQ(q.x.size(), 7u);
  EXPECT_EQ(q.y.data(), q.x.data() + 7);
  EXPECT_EQ(q.w.data(), q.x.data() + 21);
  EXPECT_EQ(motion.rotation(3).x.data(), q.x.data() + 28);
}

TEST(Motion, gains_a_translation_track_without_any_other_change) {
  Motion motion = sample_motion(6);
  Motion more = motion.with_translation(4);
  EXPECT_TRUE(more.translates(4));
  EXPECT_EQ(more.translation(4)[5], motion.skeleton().joints[4].offset);
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < 6; ++t) {
      EXPECT_EQ(more.rotation(j)[t], motion.rotation(j)[t]);
      EXPECT_EQ(more.local_offset(j, t), motion.local_offset(j, t));
    }
  EXPECT_EQ(encoded(more.with_translation(4)), encoded(more));
}

TEST(Motion, empty_like_keeps_everything_but_the_frames) {
  Motion motion = sample_motion(6, 50);
  Motion other = motion.empty_like(9);
  EXPECT_EQ(other.frames(), 9u);
  EXPECT_EQ(other.fps(), 50);
  EXPECT_EQ(other.translating(), motion.translating());
  EXPECT_EQ(other.shared_skeleton(), motion.shared_skeleton());
  EXPECT_EQ(other.shared_source(), motion.shared_source());
}

TEST(Motion, names_the_first_number_that_is_not_finite) {
  Motion motion = sample_motion(9);
  EXPECT_FALSE(motion.non_finite());
  motion.rotation(4).y[7] = inf;
  motion.translation(0).z[8] = std::nan("");
  auto found = motion.non_finite();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->what, "rotation");
  EXPECT_EQ(found->joint, motion.skeleton().joints[4].name);
  EXPECT_EQ(found->frame, 7);
  motion.rotation(4).y[7] = 0;
  EXPECT_EQ(motion.non_finite()->what, "translation");

  Skeleton broken = sample_skeleton();
  broken.joints[2].offset.y = inf;
  EXPECT_EQ(Motion(std::make_shared<const Skeleton>(broken), nullptr, 30, 0, {}).non_finite()->what,
            "offset");
}

// --- what the disk cache keeps ---

// Every value comes back bit for bit, and no damaged beginning of it is taken for a value.
void expect_kept(const Value& value, ValuePtr (*decode)(Decoder&)) {
  std::string bytes = encoded(value);
  Decoder in(bytes);
  ValuePtr back = decode(in);
  EXPECT_TRUE(in.at_end());
  EXPECT_EQ(back->type(), value.type());
  EXPECT_EQ(encoded(*back), bytes);
  EXPECT_FALSE(back->non_finite());
  EXPECT_GT(back->bytes(), bytes.size() / 4);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 97) {
    Decoder cut(std::string_view(bytes).substr(0, length));
    try {
      decode(cut);
      ADD_FAILURE() << value.type() << " read from " << length << " of " << bytes.size() << " bytes";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, "damaged-entry");
    }
  }
  // Any byte may be wrong; a wrong one is refused or gives a value, and never crashes.
  for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 3000); at += 3) {
    std::string wrong = bytes;
    wrong[at] = static_cast<char>(wrong[at] ^ 0x41);
    Decoder damaged(wrong);
    try {
      decode(damaged);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, "damaged-entry");
    }
  }
}

TEST(Codec, keeps_a_motion_with_its_source) {
  Motion motion = sample_motion(12);
  SourceFacts source;
  source.format = "bvh";
  source.unit = 0.0254;
  source.unit_name = "in";
  source.up = UpAxis::z;
  source.bvh = {{{"Xposition", "Zrotation"}, {1, 2, 3}}, {{}, {0, 0, 1}}};
  source.bvh_ends = {{0, 0, 1}};
  source.frame_time = 0.0083333;
  source.frame_time_text = "0.0083333";
  source.read = std::make_shared<const std::vector<double>>(std::vector<double>{1, 2, 3.5});
  source.read_frames = 12;
  source.first_read = 3;
  motion.set_source(std::make_shared<const SourceFacts>(source));
  expect_kept(motion, decode_motion);

  std::string bytes = encoded(motion);
  Decoder in(bytes);
  auto back = std::dynamic_pointer_cast<const Motion>(decode_motion(in));
  EXPECT_EQ(back->source().unit_name, "in");
  EXPECT_EQ(back->source().up, UpAxis::z);
  EXPECT_EQ(back->source().bvh[0].channels[1], "Zrotation");
  EXPECT_EQ(*back->source().read, *source.read);
  EXPECT_EQ(back->source().first_read, 3u);
  EXPECT_EQ(back->skeleton().ends.size(), motion.skeleton().ends.size());
  EXPECT_EQ(back->translation(0)[11], motion.translation(0)[11]);
}

TEST(Codec, keeps_a_motion_without_frames) {
  expect_kept(sample_motion(0), decode_motion);
}

TEST(Codec, keeps_points_and_their_gaps) {
  Points points({"LASI", "RASI", "T10"}, 100, 5);
  points.track(1).set(3, {1, 2, 3});
  points.set_missing(2, 4);
  points.links = {{0, 1}};
  points.up = UpAxis::z;
  points.unit_name = "mm";
  points.unit = 0.001;
  expect_kept(points, decode_points);
  std::string bytes = encoded(points);
  Decoder in(bytes);
  auto back = std::dynamic_pointer_cast<const Points>(decode_points(in));
  EXPECT_TRUE(back->is_missing(2, 4));
  EXPECT_FALSE(back->is_missing(1, 3));
  EXPECT_EQ(back->track(1)[3], (Vec3{1, 2, 3}));
}

TEST(Codec, keeps_contacts) {
  Contacts contacts;
  contacts.frames = 11;
  contacts.points = {{"LeftFoot", true, "heel", 3, "LeftFoot", {0, 0.1, 0}, std::vector<bool>(11)}};
  contacts.points[0].planted[10] = true;
  expect_kept(contacts, decode_contacts);
}

TEST(Codec, keeps_a_warp) {
  Warp warp;
  warp.identity = false;
  warp.source_frames = 4;
  warp.reference_frames = 3;
  warp.paths = {{0, 1, 3}, {0, 2, 3}};
  warp.dofs = {"Hips.x", "*"};
  warp.means = {0, 0, 0, 1};
  warp.skipped = {{2, 0.1, 0.2, 0.3, 0.4, {1, 2, 3}}};
  warp.energy = {3, 2, 1};
  warp.rounds = 2;
  expect_kept(warp, decode_warp);
}

TEST(Codec, refuses_a_warp_that_names_frames_its_motion_lacks) {
  Warp warp;
  warp.identity = false;
  warp.source_frames = 3;
  warp.paths = {{0, 3}};
  std::string bytes = encoded(warp);
  Decoder in(bytes);
  EXPECT_THROW(decode_warp(in), Failure);
}

TEST(Codec, keeps_stats_and_metrics) {
  Stats stats;
  stats.joints = {{"Hips", true, {0, 0, 0, 1}, 0.1, "ZYX", {1, 2, 3}, {4, 5, 6}},
                  {"Spine", false, {}, 0, "", {}, {}}};
  stats.parents = {-1, 0};
  stats.offsets = {{0, 1, 0}, {0, 0.2, 0}};
  stats.rests = {{}, {}};
  stats.root_mean = {1, 2, 3, 4};
  stats.frames = 400;
  expect_kept(stats, decode_stats);

  Metrics metrics;
  metrics.all = {{"skate", 0.02, "m/s"}, {"skate_share", {}, ""}};
  expect_kept(metrics, decode_metrics);
  EXPECT_FALSE(metrics.find("skate_share")->value);
  EXPECT_FALSE(metrics.find("skat"));
  metrics.all[0].value = inf;
  EXPECT_EQ(metrics.non_finite()->what, "skate");
}

TEST(Contacts, runs_are_the_longest_stretches_of_true) {
  auto runs = runs_of({true, true, false, true, false, false, true});
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].start, 0u);
  EXPECT_EQ(runs[0].end, 2u);
  EXPECT_EQ(runs[2].start, 6u);
  EXPECT_EQ(runs[2].end, 7u);
  EXPECT_TRUE(runs_of({}).empty());
}

}  // namespace
}  // namespace kinegraph
