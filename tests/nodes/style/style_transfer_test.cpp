#include "nodes/style/style_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "nodes/feet/detect_contacts.h"
#include "nodes/gait/gait.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/kinematics.h"
#include "nodes/style/travel_factor.h"
#include "tests/nodes/style/independent_style_distance.h"
#include "tests/nodes/style/small_motion.h"

namespace kinegraph {
namespace {

constexpr double degrees = 57.29577951308232;
const Vec3 right{1, 0, 0};
const Vec3 forwards{0, 0, 1};

Motion gait(const char* name, double seconds = 2, double fps = 120) {
  Alone work;
  GaitParams params;
  params.gait = name;
  params.seconds = seconds;
  params.fps = fps;
  return make_gait(params, work);
}
Stats stats_of(const Motion& motion, QuatStatsParams params = {}) {
  Alone work;
  return quat_stats(motion, params, work);
}
StyleTransferResult transferred(const Motion& motion, const Stats& style,
                                const StyleTransferParams& params = {}) {
  Alone work;
  return style_transfer(motion, style, nullptr, params, work);
}
Diagnostics told_by(const Motion& motion, const Stats& style, const StyleTransferParams& params = {}) {
  Alone work;
  style_transfer(motion, style, nullptr, params, work);
  return work.reported;
}
const Diagnostic* find(const Diagnostics& all, const char* code) {
  for (const Diagnostic& told : all) {
    if (told.code == code) return &told;
  }
  return nullptr;
}
std::string refusal(const Motion& motion, const Stats& style, const StyleTransferParams& params = {}) {
  try {
    transferred(motion, style, params);
  } catch (const Failure& failure) {
    return failure.diagnostic().code;
  }
  return "";
}

independent::MeanAndSpread measured(const Motion& motion, int joint) {
  std::vector<independent::Rotation> all;
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    const Quat q = motion.rotation(joint)[t];
    all.push_back({q.w, q.x, q.y, q.z});
  }
  return independent::mean_and_spread(all);
}

EncodedRoot encoded(const Motion& motion) {
  Alone work;
  return encode_root(motion, work);
}

struct MeanSigma {
  double mean = 0, sigma = 0;
};
MeanSigma over(const std::vector<double>& values, std::size_t from) {
  MeanSigma out;
  const double n = static_cast<double>(values.size() - from);
  for (std::size_t t = from; t < values.size(); ++t) out.mean += values[t] / n;
  for (std::size_t t = from; t < values.size(); ++t)
    out.sigma += (values[t] - out.mean) * (values[t] - out.mean) / n;
  out.sigma = std::sqrt(out.sigma);
  return out;
}

// A walk that turns, sways and nods, with every channel at work.
SmallMotion lively() {
  SmallMotion motion;
  motion.place = [](double s) { return Vec3{0.1 * std::sin(6 * s), 1 + 0.03 * std::sin(12 * s), 1.2 * s}; };
  motion.hips = [](double s) {
    return about_y(0.5 * s) * axis_angle(right, 0.1 + 0.1 * std::sin(6 * s)) *
           axis_angle(forwards, 0.05 * std::cos(6 * s));
  };
  motion.spine = [](double s) {
    return axis_angle(right, 0.3 * std::sin(6 * s)) * axis_angle(forwards, 0.2 * std::cos(5 * s));
  };
  motion.head = [](double s) { return about_y(0.4 * std::sin(3 * s)); };
  return motion;
}
SmallMotion bowed() {
  SmallMotion motion;
  motion.place = [](double s) {
    return Vec3{0, 0.8 + 0.05 * std::sin(9 * s), 0.5 * s + 0.05 * std::sin(9 * s)};
  };
  motion.hips = [](double s) { return axis_angle(right, 0.5 + 0.2 * std::sin(9 * s)); };
  motion.spine = [](double s) { return axis_angle(right, 0.7 + 0.1 * std::sin(9 * s)); };
  motion.head = [](double s) { return axis_angle(forwards, 0.3) * about_y(0.6 * std::sin(4 * s)); };
  return motion;
}

TEST(StyleTransfer, GivesEveryJointTheReferencesMeanAndSpread) {
  const Motion walk = gait("walk");
  for (const char* style : {"sneak", "hobble", "strut", "run"}) {
    const Motion reference = gait(style);
    const Motion result = transferred(walk, stats_of(reference)).motion;
    for (int j = 1; j < walk.joints(); ++j) {
      const auto before = measured(walk, j);
      const auto got = measured(result, j);
      const auto wanted = measured(reference, j);
      EXPECT_NEAR(independent::cosine(got.mean, wanted.mean), 1, 1e-10) << style << " " << j;
      // A joint that hardly moves keeps its own spread.
      const double spread = before.spread < 0.001 ? before.spread : wanted.spread;
      EXPECT_NEAR(got.spread, spread, 1e-6) << style << " " << j;
    }
  }
}

TEST(StyleTransfer, IsTheSlerpOfThePaper) {
  // Eq. 7: q′ = q q̄s⁻¹ q̄r, then Slerp(σr/σs, q̄r, q′), also past 1.
  for (const auto& [from, to] : {std::pair{lively(), bowed()}, std::pair{bowed(), lively()}}) {
    const Motion source = from.made(200);
    const Stats own = stats_of(source);
    const Stats style = stats_of(to.made(300));
    const Motion result = transferred(source, style).motion;
    for (int j = 1; j < 3; ++j) {
      const JointStats& s = own.joints[static_cast<std::size_t>(j)];
      const JointStats& r = style.joints[static_cast<std::size_t>(j)];
      for (std::size_t t = 0; t < 200; ++t) {
        const Quat moved = source.rotation(j)[t] * inverse(s.mean) * r.mean;
        EXPECT_LT(turn(result.rotation(j)[t], slerp(r.spread / s.spread, r.mean, moved)), 1e-9);
      }
    }
  }
}

TEST(StyleTransfer, OfTheMotionsOwnStyleChangesNothing) {
  const Motion walk = gait("strut");
  StyleTransferParams printed;
  printed.travel = TravelKind::printed;
  for (const StyleTransferParams& params : {StyleTransferParams{}, printed}) {
    const StyleTransferResult result = transferred(walk, stats_of(walk), params);
    EXPECT_NEAR(result.travel_factor, 1, 1e-3);
    for (int j = 0; j < walk.joints(); ++j) {
      for (std::size_t t = 0; t < walk.frames(); ++t)
        EXPECT_LT(turn(result.motion.rotation(j)[t], walk.rotation(j)[t]), 1e-7);
    }
  }
  const Motion result = transferred(walk, stats_of(walk), printed).motion;
  for (std::size_t t = 0; t < walk.frames(); ++t)
    EXPECT_LT(norm(result.translation(0)[t] - walk.translation(0)[t]), 1e-9);
}

TEST(StyleTransfer, TakesTheMeanOrTheSpreadAlone) {
  const Motion source = lively().made(240);
  const Motion reference = bowed().made(240);
  StyleTransferParams params;
  params.transfer = TransferredPart::mean;
  const Motion mean = transferred(source, stats_of(reference), params).motion;
  params.transfer = TransferredPart::spread;
  const Motion spread = transferred(source, stats_of(reference), params).motion;
  for (int j = 1; j < 3; ++j) {
    EXPECT_NEAR(independent::cosine(measured(mean, j).mean, measured(reference, j).mean), 1, 1e-12);
    EXPECT_NEAR(measured(mean, j).spread, measured(source, j).spread, 1e-9);
    EXPECT_NEAR(independent::cosine(measured(spread, j).mean, measured(source, j).mean), 1, 1e-12);
    EXPECT_NEAR(measured(spread, j).spread, measured(reference, j).spread, 1e-9);
  }
}

TEST(StyleTransfer, KeepsTheHeadingAtEveryFrame) {
  const Motion source = lively().made(300);
  const Motion result = transferred(source, stats_of(bowed().made(300))).motion;
  const EncodedRoot before = encoded(source);
  const EncodedRoot after = encoded(result);
  for (std::size_t t = 0; t < 300; ++t) EXPECT_NEAR(before.heading[t], after.heading[t], 1e-12);
}

TEST(StyleTransfer, LeansTheRootAsTheReference) {
  const Motion source = lively().made(300);
  const Motion reference = bowed().made(300);
  const Stats after = stats_of(transferred(source, stats_of(reference)).motion);
  const Stats wanted = stats_of(reference);
  EXPECT_LT(turn(after.joints[0].mean, wanted.joints[0].mean) * degrees, 0.1);
  EXPECT_NEAR(after.joints[0].spread / wanted.joints[0].spread, 1, 0.1);
}

TEST(StyleTransfer, TransfersTheHeadingsChangesWhereAsked) {
  const Motion source = bowed().made(300);
  const Motion reference = lively().made(300);
  StyleTransferParams params;
  params.heading = HeadingKind::transfer;
  const Stats after = stats_of(transferred(source, stats_of(reference), params).motion);
  EXPECT_NEAR(after.root_mean[3], stats_of(reference).root_mean[3], 1e-6);
}

TEST(StyleTransfer, PrintedTravelAndHeightAreEquationFour) {
  const Motion source = lively().made(300);
  const Motion reference = bowed().made(300);
  StyleTransferParams params;
  params.travel = TravelKind::printed;
  const EncodedRoot after = encoded(transferred(source, stats_of(reference), params).motion);
  const EncodedRoot before = encoded(source);
  const EncodedRoot wanted = encoded(reference);
  const auto check = [](const std::vector<double>& got, const std::vector<double>& own,
                        const std::vector<double>& ref, std::size_t from) {
    const MeanSigma s = over(own, from);
    const MeanSigma r = over(ref, from);
    const double gain = s.sigma < 0.001 ? 1 : r.sigma / s.sigma;
    for (std::size_t t = from; t < own.size(); ++t)
      EXPECT_NEAR(got[t], r.mean + gain * (own[t] - s.mean), 1e-9);
  };
  check(after.d_x, before.d_x, wanted.d_x, 1);
  check(after.d_z, before.d_z, wanted.d_z, 1);
  check(after.height, before.height, wanted.height, 0);
}

TEST(StyleTransfer, BringsTheReferencesLengthsToTheSourcesSize) {
  // The same sneak by someone half as tall gives the same result.
  const Motion walk = gait("walk");
  const Motion sneak = gait("sneak");
  auto half = std::make_shared<Skeleton>(sneak.skeleton());
  for (Joint& joint : half->joints) joint.offset = 0.5 * joint.offset;
  Motion small(half, sneak.shared_source(), sneak.fps(), sneak.frames(), sneak.translating());
  for (int j = 0; j < sneak.joints(); ++j) {
    for (std::size_t t = 0; t < sneak.frames(); ++t) {
      small.rotation(j).set(t, sneak.rotation(j)[t]);
      if (sneak.translates(j)) small.translation(j).set(t, 0.5 * sneak.translation(j)[t]);
    }
  }
  StyleTransferParams params;
  params.travel = TravelKind::printed;
  const Motion a = transferred(walk, stats_of(sneak), params).motion;
  const Motion b = transferred(walk, stats_of(small), params).motion;
  for (std::size_t t = 0; t < walk.frames(); ++t)
    EXPECT_LT(norm(a.translation(0)[t] - b.translation(0)[t]), 1e-9);
}

TEST(StyleTransfer, LeavesAloneWhatTheRootIsNotToTake) {
  const Motion source = lively().made(200);
  const Stats style = stats_of(bowed().made(200));
  StyleTransferParams params;
  const auto path = [&](TransferredRoot root) {
    params.root = root;
    return transferred(source, style, params).motion;
  };
  const Motion none = path(TransferredRoot::none);
  const Motion height = path(TransferredRoot::height);
  const Motion travel = path(TransferredRoot::travel);
  bool rises = false, moves = false;
  for (std::size_t t = 0; t < 200; ++t) {
    const Vec3 p = source.translation(0)[t];
    EXPECT_EQ(none.translation(0)[t], p);
    EXPECT_EQ(height.translation(0)[t].x, p.x);
    EXPECT_EQ(height.translation(0)[t].z, p.z);
    EXPECT_EQ(travel.translation(0)[t].y, p.y);
    rises = rises || height.translation(0)[t].y != p.y;
    moves = moves || travel.translation(0)[t].z != p.z;
  }
  EXPECT_TRUE(rises && moves);
}

TEST(StyleTransfer, LeavesTheRootAloneWhereItIsNotChosen) {
  const Motion source = lively().made(100);
  StyleTransferParams params;
  params.joints = {false, true, false};
  const Motion result = transferred(source, stats_of(bowed().made(100)), params).motion;
  for (std::size_t t = 0; t < 100; ++t) {
    EXPECT_EQ(result.translation(0)[t], source.translation(0)[t]);
    EXPECT_EQ(result.rotation(0)[t], source.rotation(0)[t]);
    EXPECT_EQ(result.rotation(2)[t], source.rotation(2)[t]);
  }
  EXPECT_GT(turn(result.rotation(1)[0], source.rotation(1)[0]), 0.1);
}

TEST(StyleTransfer, LetsPlantedFeetSlideLeastAtTheFactorItReports) {
  const Motion walk = gait("walk", 3);
  const StyleTransferResult result = transferred(walk, stats_of(gait("sneak", 3)));
  Alone work;
  const Contacts contacts = detect_contacts(walk, {}, work);
  const auto slide = [&](double more) {
    EncodedRoot root = encoded(result.motion);
    for (double& d : root.d_x) d *= more;
    for (double& d : root.d_z) d *= more;
    Motion moved = result.motion;
    decode_root_keeping_heading(root, moved);
    const WorldMotion world = world_motion(moved);
    double sum = 0;
    for (const FootPoint& point : contacts.points) {
      for (std::size_t t = 1; t < moved.frames(); ++t) {
        if (!point.planted[t] || !point.planted[t - 1]) continue;
        const Vec3 step =
            point_at(world, point.joint, point.local, t) - point_at(world, point.joint, point.local, t - 1);
        sum += step.x * step.x + step.z * step.z;
      }
    }
    return sum;
  };
  const double best = slide(1);
  EXPECT_LT(best, slide(0.99));
  EXPECT_LT(best, slide(1.01));
  EXPECT_LT(best, slide(1 / result.travel_factor));
}

TEST(StyleTransfer, KeepsTheDirectionOfTravel) {
  // A reference that walks half sideways: its pelvis stands askew to its path.
  const Motion walk = gait("walk", 3);
  Motion askew = gait("sneak", 3);
  for (std::size_t t = 0; t < askew.frames(); ++t)
    askew.rotation(0).set(t, about_y(0.8) * askew.rotation(0)[t]);
  const auto direction = [](const Motion& motion) {
    const Vec3 way = motion.translation(0)[motion.frames() - 1] - motion.translation(0)[0];
    return std::atan2(way.x, way.z) * degrees;
  };
  EXPECT_NEAR(direction(transferred(walk, stats_of(askew)).motion), direction(walk), 1e-6);
  StyleTransferParams printed;
  printed.travel = TravelKind::printed;
  EXPECT_GT(std::fabs(direction(transferred(walk, stats_of(askew), printed).motion) - direction(walk)), 20);
}

TEST(StyleTransfer, WarnsWhereNoFootIsPlanted) {
  const Diagnostics told = told_by(lively().made(100), stats_of(bowed().made(100)));
  ASSERT_TRUE(find(told, "no-plants"));
  EXPECT_FALSE(find(told, "no-plants")->hint.empty());
}

TEST(StyleTransfer, WithNoAmountIsTheInput) {
  const Motion walk = gait("walk");
  StyleTransferParams params;
  params.weights.assign(walk.frames(), 0.0);
  const Motion result = transferred(walk, stats_of(gait("sneak")), params).motion;
  for (int j = 0; j < walk.joints(); ++j) {
    for (std::size_t t = 0; t < walk.frames(); ++t)
      EXPECT_LT(turn(result.rotation(j)[t], walk.rotation(j)[t]), 1e-7);
  }
  for (std::size_t t = 0; t < walk.frames(); ++t)
    EXPECT_LT(norm(result.translation(0)[t] - walk.translation(0)[t]), 1e-12);
  EXPECT_TRUE(told_by(walk, stats_of(gait("sneak")), params).empty())
      << "nothing of a change that isn't made";
}

TEST(StyleTransfer, HalfTheAmountIsHalfWay) {
  const Motion source = lively().made(150);
  const Stats style = stats_of(bowed().made(150));
  const Motion whole = transferred(source, style).motion;
  StyleTransferParams params;
  params.weights.assign(150, 0.5);
  const Motion half = transferred(source, style, params).motion;
  for (int j = 1; j < 3; ++j) {
    for (std::size_t t = 0; t < 150; ++t) {
      EXPECT_LT(turn(half.rotation(j)[t], slerp(0.5, source.rotation(j)[t], whole.rotation(j)[t])), 1e-7);
    }
  }
  const EncodedRoot a = encoded(source), b = encoded(half), c = encoded(whole);
  for (std::size_t t = 1; t < 150; ++t) {
    EXPECT_NEAR(b.d_z[t], 0.5 * (a.d_z[t] + c.d_z[t]), 1e-9);
    EXPECT_NEAR(b.height[t], 0.5 * (a.height[t] + c.height[t]), 1e-12);
  }
}

TEST(StyleTransfer, GoesOnFromWhereItIsAfterTheRange) {
  const Motion source = lively().made(200);
  StyleTransferParams params;
  params.travel = TravelKind::printed;
  params.weights.assign(200, 0.0);
  for (std::size_t t = 50; t < 100; ++t) params.weights[t] = 1;
  const Motion result = transferred(source, stats_of(bowed().made(200)), params).motion;
  for (std::size_t t = 1; t < 200; ++t) {
    const Vec3 was = source.translation(0)[t] - source.translation(0)[t - 1];
    const Vec3 is = result.translation(0)[t] - result.translation(0)[t - 1];
    if (t < 50 || t > 100) {
      EXPECT_LT(norm(was - is), 1e-12) << t;
    }
    if (t < 50 || t >= 100) {
      EXPECT_EQ(result.rotation(1)[t], source.rotation(1)[t]);
    }
  }
  EXPECT_GT(norm(result.translation(0)[199] - source.translation(0)[199]), 0.01);
}

TEST(StyleTransfer, HoldsTheGainToItsBoundAndSaysSo) {
  SmallMotion still = lively();
  still.head = [](double s) { return about_y(0.01 * std::sin(3 * s)); };
  const Motion source = still.made(240);
  const Motion reference = lively().made(240);
  StyleTransferParams params;
  params.max_gain = 4;
  const Motion result = transferred(source, stats_of(reference), params).motion;
  EXPECT_NEAR(measured(result, 2).spread, 4 * measured(source, 2).spread, 1e-9);
  const Diagnostics told = told_by(source, stats_of(reference), params);
  ASSERT_TRUE(find(told, "gain-bounded"));
  EXPECT_NE(find(told, "gain-bounded")->message.find("Head"), std::string::npos);
  EXPECT_EQ(find(told, "gain-bounded")->message.find("Spine"), std::string::npos);
}

TEST(StyleTransfer, DoesNotMagnifyWhatDoesNotMove) {
  SmallMotion still = lively();
  still.head = [](double s) { return about_y(0.001 * std::sin(30 * s)); };
  const Motion source = still.made(240);
  const Motion result = transferred(source, stats_of(lively().made(240))).motion;
  EXPECT_NEAR(measured(result, 2).spread, measured(source, 2).spread, 1e-9);
}

TEST(StyleTransfer, WarnsWhereAJointFoldsOver) {
  SmallMotion stray = lively();  // at rest but for one stray of 60° in frame 77
  stray.head = [](double s) {
    return about_y(std::lround(s * 120) == 77 ? 60 / degrees : 0.02 * std::sin(6 * s));
  };
  const Motion source = stray.made(240);
  const Stats style = stats_of(bowed().made(240));
  const Diagnostics told = told_by(source, style);
  const Diagnostic* fold = find(told, "fold-over");
  ASSERT_TRUE(fold);
  EXPECT_EQ(fold->joint, "Head");
  EXPECT_EQ(fold->frame, 77);
  EXPECT_EQ(fold->severity, Severity::warning);
  EXPECT_NE(fold->message.find("gain"), std::string::npos);
  StyleTransferParams bounded;
  bounded.max_gain = 2;
  EXPECT_FALSE(find(told_by(source, style, bounded), "fold-over"));
}

TEST(StyleTransfer, FoldsNothingOverThatItTurnsAsItIs) {
  SmallMotion stray = lively();
  stray.head = [](double s) {
    return about_y(std::lround(s * 120) == 77 ? 175 / degrees : 0.02 * std::sin(6 * s));
  };
  const Motion source = stray.made(240);
  StyleTransferParams mean;
  mean.transfer = TransferredPart::mean;
  EXPECT_FALSE(find(told_by(source, stats_of(bowed().made(240)), mean), "fold-over"));
  const Motion result = transferred(source, stats_of(bowed().made(240)), mean).motion;
  EXPECT_NEAR(turn(result.rotation(2)[76], result.rotation(2)[77]),
              turn(source.rotation(2)[76], source.rotation(2)[77]), 1e-9);
}

TEST(StyleTransfer, TakesStatisticsOfTheMotionThatWereMadeElsewhere) {
  const Motion source = lively().made(240);
  const Stats style = stats_of(bowed().made(240));
  const Stats own = stats_of(source);
  Alone work;
  const Motion given = style_transfer(source, style, &own, {}, work).motion;
  const Motion measured_here = transferred(source, style).motion;
  for (std::size_t t = 0; t < 240; ++t) EXPECT_EQ(given.rotation(1)[t], measured_here.rotation(1)[t]);
  // Those of a longer take set the same clip against that take's mean.
  const Stats longer = stats_of(lively().made(700));
  const Motion other = style_transfer(source, style, &longer, {}, work).motion;
  EXPECT_GT(turn(other.rotation(1)[0], given.rotation(1)[0]), 1e-3);
}

TEST(StyleTransfer, MapsJointsByName) {
  const Motion source = lively().made(100);
  Stats style = stats_of(bowed().made(100));
  style.joints[0].joint = "pelvis";
  style.joints[1].joint = "back";
  style.joints[2].joint = "skull";
  StyleTransferParams params;
  params.map = {"back=Spine"};
  Alone work;
  const Motion result = style_transfer(source, style, nullptr, params, work).motion;
  EXPECT_NEAR(independent::cosine(measured(result, 1).mean, measured(bowed().made(100), 1).mean), 1, 1e-12);
  EXPECT_EQ(result.rotation(2)[50], source.rotation(2)[50]);
  EXPECT_EQ(result.translation(0)[50], source.translation(0)[50]);
  EXPECT_TRUE(find(work.reported, "no-partner"));
  params.map = {"back=Hips"};
  EXPECT_EQ(refusal(source, style, params), "bad-map");
  params.map = {"neck=Head"};
  EXPECT_EQ(refusal(source, style, params), "unknown-joint");
}

TEST(StyleTransfer, RefusesAStyleOfWhichNoJointHasAPartner) {
  const Motion source = lively().made(100);
  Stats style = stats_of(bowed().made(100));
  for (JointStats& joint : style.joints) joint.joint = "b_" + joint.joint;
  try {
    transferred(source, style);
    FAIL() << "it was taken";
  } catch (const Failure& failure) {
    const Diagnostic& told = failure.diagnostic();
    EXPECT_EQ(told.code, "no-partner");
    EXPECT_NE(told.message.find("b_Spine"), std::string::npos) << told.message;
    for (const char* way : {"Retarget", "map"})
      EXPECT_NE(told.hint.find(way), std::string::npos) << told.hint;
  }
  // Of the chosen joints none either, though others have one.
  style.joints[0].joint = "Hips";
  StyleTransferParams params;
  params.joints = {false, true, true};
  EXPECT_EQ(refusal(source, style, params), "no-partner");
}

TEST(StyleTransfer, NamesThePlaceOfARetargetWhereRestPosesDiffer) {
  const Motion source = lively().made(100);
  Stats style = stats_of(bowed().made(100));
  style.offsets[2] = {0.4, 0, 0};
  const Diagnostics told = told_by(source, style);
  const Diagnostic* differs = find(told, "rest-pose-differs");
  ASSERT_TRUE(differs);
  EXPECT_NE(differs->hint.find("before the style's QuatStats"), std::string::npos) << differs->hint;
}

TEST(StyleTransfer, LeavesAloneJointsThatTheStyleDoesNotHold) {
  QuatStatsParams only_spine;
  only_spine.joints = {false, true, false};
  const Motion source = lively().made(100);
  const Motion result = transferred(source, stats_of(bowed().made(100), only_spine)).motion;
  EXPECT_EQ(result.rotation(2)[50], source.rotation(2)[50]);
  EXPECT_EQ(result.translation(0)[50], source.translation(0)[50]);
  EXPECT_GT(turn(result.rotation(1)[50], source.rotation(1)[50]), 0.1);
}

TEST(StyleTransfer, TakesAReferenceOfAnotherRate) {
  const Motion walk = gait("walk");
  const Motion a = transferred(walk, stats_of(gait("sneak", 2, 120))).motion;
  const Motion b = transferred(walk, stats_of(gait("sneak", 2, 60))).motion;
  const Vec3 apart = a.translation(0)[walk.frames() - 1] - b.translation(0)[walk.frames() - 1];
  EXPECT_LT(norm(apart), 0.05);
}

TEST(StyleTransfer, OfOneFrameGivesTheReferencesMeanPose) {
  const Motion source = lively().made(1);
  const Motion reference = bowed().made(100);
  const Motion result = transferred(source, stats_of(reference)).motion;
  EXPECT_FALSE(result.non_finite());
  EXPECT_LT(turn(result.rotation(1)[0], stats_of(reference).joints[1].mean), 1e-7);
}

TEST(StyleTransfer, InEulerSpaceIsEquationFive) {
  const Motion source = lively().made(200);
  const Motion reference = bowed().made(200);
  QuatStatsParams euler;
  euler.space = StyleSpace::euler;
  StyleTransferParams params;
  params.space = StyleSpace::euler;
  const Motion result = transferred(source, stats_of(reference, euler), params).motion;
  const Stats own = stats_of(source, euler);
  const Stats style = stats_of(reference, euler);
  std::array<double, 3> near{};
  for (std::size_t t = 0; t < 200; ++t) {
    near = to_euler(source.rotation(1)[t], "ZYX", near.data());
    std::array<double, 3> angles{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double s = own.joints[1].euler_spread[axis];
      const double gain = s < 0.001 ? 1 : style.joints[1].euler_spread[axis] / s;
      angles[axis] = style.joints[1].euler_mean[axis] + gain * (near[axis] - own.joints[1].euler_mean[axis]);
    }
    EXPECT_LT(turn(result.rotation(1)[t], from_euler("ZYX", angles.data())), 1e-7);
  }
}

TEST(StyleTransfer, RefusesStatisticsOfAnotherSpaceOrOrder) {
  const Motion source = lively().made(50);
  QuatStatsParams euler;
  euler.space = StyleSpace::euler;
  Stats style = stats_of(bowed().made(50), euler);
  EXPECT_EQ(refusal(source, style), "space-mismatch");
  StyleTransferParams params;
  params.space = StyleSpace::euler;
  EXPECT_EQ(refusal(source, stats_of(bowed().made(50)), params), "space-mismatch");
  style.joints[2].order = "XYZ";
  EXPECT_EQ(refusal(source, style, params), "euler-order-mismatch");
}

TEST(StyleTransfer, GivesAPathToARootThatHadNone) {
  Motion turning(three_joints(), std::make_shared<SourceFacts>(), 120, 50, {false, false, false});
  for (std::size_t t = 0; t < 50; ++t)
    turning.rotation(1).set(t, axis_angle(right, 0.01 * static_cast<double>(t)));
  const Motion result = transferred(turning, stats_of(bowed().made(200))).motion;
  ASSERT_TRUE(result.translates(0));
  EXPECT_NEAR(result.translation(0)[49].y, 0.8, 0.01);
  StyleTransferParams none;
  none.root = TransferredRoot::none;
  EXPECT_FALSE(transferred(turning, stats_of(bowed().made(200)), none).motion.translates(0));
}

}  // namespace
}  // namespace kinegraph
