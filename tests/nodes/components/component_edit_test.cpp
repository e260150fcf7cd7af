#include "nodes/components/component_edit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/alignment.h"
#include "nodes/components/rebuild.h"
#include "nodes/motion/kinematics.h"
#include "nodes/time/motion_warp.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/components/small_components.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

ComponentEditResult edited(const Components& components, std::vector<ComponentEditStep> steps,
                           double lowpass = 0, ComponentEditInputs inputs = {}) {
  Alone work;
  ComponentEditParams params;
  params.edits = std::move(steps);
  params.lowpass = lowpass;
  return edit_components(components, params, inputs, work);
}
Rows u_of(const ComponentEditResult& result) {
  return signals_of(result.components, result.components.segments[result.segment]);
}
double u(const Components& c, std::size_t i, std::size_t t) {
  return c.signals(i, t);
}
Diagnostic refusal(const Components& components, ComponentEditStep step,
                   std::optional<std::int64_t> segment = {}) {
  Alone work;
  ComponentEditParams params;
  params.edits = {std::move(step)};
  params.segment = segment;
  try {
    edit_components(components, params, {}, work);
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(ComponentEdit, WithoutEditsChangesNothing) {
  const Components c = small();
  const ComponentEditResult result = edited(c, {});
  EXPECT_EQ(result.components.signals.data, c.signals.data);
  for (std::size_t t = 0; t < 40; ++t)
    for (std::size_t d = 0; d < 6; ++d)
      EXPECT_NEAR(result.channels(d, t),
                  c.segments[0].points->track(static_cast<int>(d / 3))[t][static_cast<int>(d % 3)], 1e-12);
}

TEST(ComponentEdit, ScalesAComponent) {
  const Components c = small();
  const Rows x = edited(c, {edits::Scale{{2, ""}, -1.5}}).channels;
  for (std::size_t t = 0; t < 40; ++t)
    for (std::size_t d = 0; d < 6; ++d)
      EXPECT_NEAR(x(d, t), c.mean[d] + c.mixing(d, 0) * u(c, 0, t) - 1.5 * c.mixing(d, 1) * u(c, 1, t),
                  1e-12);
}

TEST(ComponentEdit, TranslatesAComponent) {
  const Components c = small();
  const Rows plain = edited(c, {}).channels, x = edited(c, {edits::Translate{{1, ""}, 0.7}}).channels;
  for (std::size_t d = 0; d < 6; ++d) EXPECT_NEAR(x(d, 9) - plain(d, 9), 0.7 * c.mixing(d, 0), 1e-12);
}

TEST(ComponentEdit, MergesWithFactorsAndTreatsTheGroupAsOne) {
  const Components c = small();
  const edits::Merge ones{"all", {{{1, ""}, 1}, {{2, ""}, 1}}},
      weighted{"all", {{{1, ""}, 2}, {{2, ""}, -1}}};
  EXPECT_EQ(edited(c, {ones}).channels.data, edited(c, {}).channels.data);
  const ComponentEditResult result =
      edited(c, {weighted, edits::Scale{{0, "all"}, 3}, edits::Translate{{0, "all"}, 0.5}});
  const Rows now = u_of(result);
  for (std::size_t t = 0; t < 40; ++t) {
    EXPECT_NEAR(now(0, t), 3 * 2 * u(c, 0, t) + 2 * 0.5, 1e-12);
    EXPECT_NEAR(now(1, t), 3 * -1 * u(c, 1, t) - 1 * 0.5, 1e-12);
  }
  ASSERT_EQ(result.components.groups.size(), 1u);
  EXPECT_EQ(result.components.signals(0, 60), 2 * u(c, 0, 60)) << "a group is one in every segment";
}

TEST(ComponentEdit, ReplacesFrames) {
  const Components c = small();
  const Rows stretched = u_of(edited(c, {edits::Replace{{1, ""}, {10, 21}, {0, 6}, 0, false}}));
  const Rows repeated = u_of(edited(c, {edits::Replace{{1, ""}, {10, 21}, {0, 6}, 0, true}}));
  for (std::size_t t = 0; t < 40; ++t) {
    const bool inside = t >= 10 && t < 21;
    const double place = 0.5 * static_cast<double>(t - 10);
    const auto low = static_cast<std::size_t>(inside ? place : 0);
    const double between =
        inside ? u(c, 0, low) + (place - static_cast<double>(low)) * (u(c, 0, low + 1) - u(c, 0, low)) : 0;
    EXPECT_NEAR(stretched(0, t), inside ? between : u(c, 0, t), 1e-12) << t;
    EXPECT_NEAR(repeated(0, t), inside ? u(c, 0, (t - 10) % 6) : u(c, 0, t), 1e-12) << t;
    EXPECT_EQ(repeated(1, t), u(c, 1, t));
  }
}

TEST(ComponentEdit, FadesAReplacementInside) {
  const Components c = small();
  const Rows now = u_of(edited(c, {edits::Replace{{1, ""}, {10, 30}, {0, 20}, 5 / 60.0, false}}));
  EXPECT_EQ(now(0, 9), u(c, 0, 9));
  EXPECT_EQ(now(0, 30), u(c, 0, 30));
  EXPECT_NEAR(now(0, 20), u(c, 0, 10), 1e-12);
  const double part = (now(0, 12) - u(c, 0, 12)) / (u(c, 0, 2) - u(c, 0, 12));
  EXPECT_NEAR(part, 0.5, 1e-12);
}

TEST(ComponentEdit, CopiesAComponentOfOthers) {
  const Components c = small();
  Components other = small();
  for (double& m : other.mixing.data) m *= 3;
  const Rows plain = edited(c, {}).channels;
  const Rows x =
      edited(c, {edits::CopyAdd{{2, ""}, 0.5, 1, {5, 20}}}, 0, {&other, nullptr, nullptr}).channels;
  for (std::size_t t = 0; t < 40; ++t) {
    const double place = static_cast<double>(t) * 49 / 39;  // resampled from its 50 frames
    const auto low = std::min<std::size_t>(static_cast<std::size_t>(place), 48);
    const double v =
        other.signals(1, 40 + low) +
        (place - static_cast<double>(low)) * (other.signals(1, 41 + low) - other.signals(1, 40 + low));
    for (std::size_t d = 0; d < 6; ++d)
      EXPECT_NEAR(x(d, t) - plain(d, t), t >= 5 && t < 20 ? 0.5 * other.mixing(d, 1) * v : 0, 1e-12) << t;
  }
}

TEST(ComponentEdit, TransfersInTheReceiversTiming) {
  Alone work;
  const Components c = small();
  const Rows now = u_of(edited(c, {edits::Transfer{{{1, ""}}, 1, 0, {"u2"}, false, {0, {}}, 0.25}}));
  const Correspondence path = aligned_segments(c, c.segments[0], c.segments[1], {"u2"}, "align", work);
  const ClockMaps maps = clock_maps(path, 40, 50, 60, 0);
  const Rows b = at_times(signals_of(c, c.segments[1]), maps.b_of_a);
  ASSERT_EQ(now.columns, 40u);
  for (std::size_t t = 0; t < 40; ++t) {
    EXPECT_NEAR(now(0, t), u(c, 0, t) + 0.25 * (b(0, t) - u(c, 0, t)), 1e-12);
    EXPECT_EQ(now(1, t), u(c, 1, t));
  }
}

TEST(ComponentEdit, TransfersInTheGiversTiming) {
  const Components c = small();
  for (double lowpass : {0.0, 6.0}) {
    const ComponentEditResult result =
        edited(c, {edits::Transfer{{{1, ""}, {2, ""}}, 1, 0, {"u2"}, true, {0, {}}, 1}}, lowpass);
    const Rows now = u_of(result);
    ASSERT_EQ(now.columns, 50u);
    EXPECT_EQ(result.components.frames(), 100u);
    EXPECT_EQ(result.components.segments[1].start, 50u);
    EXPECT_EQ(result.components.segments[0].points->frames, 50u) << "the base is warped with it";
    for (std::size_t t = 0; t < 50; ++t)
      for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(now(i, t), u(c, i, 40 + t), 1e-12);
  }
}

TEST(ComponentEdit, BendsACurveThroughKeys) {
  const Components c = small();
  const Rows now = u_of(edited(c, {edits::Warp{{1, ""}, {{10, 3}, {25, -2}}}}));
  EXPECT_NEAR(now(0, 10), 3, 1e-12);
  EXPECT_NEAR(now(0, 25), -2, 1e-12);
  EXPECT_NEAR(now(0, 0), u(c, 0, 0), 1e-12);
  EXPECT_NEAR(now(0, 39), u(c, 0, 39), 1e-12);
  double largest = 0;  // the difference has no jump in slope
  for (std::size_t t = 1; t + 1 < 40; ++t) {
    const auto d = [&](std::size_t s) { return now(0, s) - u(c, 0, s); };
    largest = std::max(largest, std::fabs(d(t + 1) - 2 * d(t) + d(t - 1)));
  }
  EXPECT_LT(largest, 0.2);
}

TEST(ComponentEdit, SubstitutesAnEditedComponent) {
  Alone work;
  const Components c = small();
  const auto shown = std::make_shared<Points>(
      points_of(c, channels_from_signals(c, signals_of(c, c.segments[0]), {0}), c.segments[0], {}, work));
  EXPECT_EQ(edited(c, {edits::Substitute{{1, ""}}}, 0, {nullptr, nullptr, shown}).channels.data,
            edited(c, {}).channels.data);
  const Vec3 before = shown->track(1)[7];
  shown->track(1).set(7, before + Vec3{0, 0.3, 0});
  const Rows plain = edited(c, {}).channels,
             x = edited(c, {edits::Substitute{{1, ""}}}, 0, {nullptr, nullptr, shown}).channels;
  EXPECT_NEAR(x(4, 7) - plain(4, 7), 0.3, 1e-12);
  EXPECT_NEAR(x(4, 8) - plain(4, 8), 0, 1e-12);
}

// Points of motions' components stand on the clip's path: nothing of that is an edit.
TEST(ComponentEdit, SubstitutesPointsOfAMotion) {
  Alone work;
  const Components c =
      analysed({shared(gait("walk", 1)), shared(gait("sneak", 1.3))}, Representation::points, 3, work);
  const Rows plain = edited(c, {}).channels;
  const auto shown = std::make_shared<Points>(
      points_of(c, channels_from_signals(c, signals_of(c, c.segments[0]), {1}), c.segments[0], {}, work));
  const auto channels = [&] {
    return edited(c, {edits::Substitute{{2, ""}}}, 0, {nullptr, nullptr, shown}).channels;
  };
  const Rows same = channels();
  for (std::size_t i = 0; i < plain.data.size(); ++i) EXPECT_NEAR(same.data[i], plain.data[i], 1e-12);
  const auto at = static_cast<std::size_t>(std::find(shown->labels.begin(), shown->labels.end(), "Head") -
                                           shown->labels.begin());
  ASSERT_LT(at, shown->labels.size());
  const int head = static_cast<int>(at);
  shown->track(head).set(30, shown->track(head)[30] + Vec3{0, 0.2, 0});
  const Rows moved = channels();
  EXPECT_NEAR(moved(3 * at + 1, 30) - plain(3 * at + 1, 30), 0.2, 1e-12);
  EXPECT_NEAR(moved(3 * at + 1, 31) - plain(3 * at + 1, 31), 0, 1e-12);
}

TEST(ComponentEdit, RefusesToSubstituteAnotherKind) {
  Alone work;
  const auto refused = [&](const Components& components, const ComponentEditInputs& inputs) {
    ComponentEditParams params;
    params.edits = {edits::Substitute{{1, ""}}};
    try {
      edit_components(components, params, inputs, work);
    } catch (const Failure& failure) {
      return failure.diagnostic();
    }
    return Diagnostic{};
  };
  Motion motion = gait("walk", 1);
  const Components angles =
      analysed({shared(gait("walk", 1)), shared(gait("sneak", 1.3))}, Representation::euler, 2, work);
  const auto points = std::make_shared<const Points>(angles.space.labels, 120, motion.frames());
  const Diagnostic of_points = refused(angles, {nullptr, nullptr, points});
  EXPECT_EQ(of_points.code, "wrong-kind");
  EXPECT_THAT(of_points.hint, HasSubstr("`motion`"));
  const Diagnostic of_motion = refused(small(), {nullptr, shared(motion.empty_like(40)), nullptr});
  EXPECT_EQ(of_motion.code, "wrong-kind");
  EXPECT_THAT(of_motion.hint, HasSubstr("`points`"));
}

// Of edited clips as of signals: what is remembered is what new components find.
TEST(ComponentEdit, SubstitutesTheSameWithAndWithoutAMemory) {
  for (Representation representation : {Representation::points, Representation::euler}) {
    Alone work;
    const Components kept =
        analysed({shared(gait("walk", 1)), shared(gait("sneak", 1.3))}, representation, 2, work);
    for (const char* name : {"run", "sneak", "run"}) {
      const auto clip = shared(gait(name, 1));
      for (double factor : {1.0, -30.0}) {
        Components fresh = kept;
        fresh.memory = std::make_shared<ComponentMemory>();
        const auto channels = [&](const Components& components) {
          return edited(components, {edits::Scale{{1, ""}, factor}, edits::Substitute{{1, ""}}}, 0,
                        {nullptr, clip, nullptr})
              .channels.data;
        };
        EXPECT_EQ(channels(kept), channels(fresh)) << name << " " << factor;
      }
    }
  }
}

TEST(ComponentEdit, AddsTheResidualOfTheBase) {
  Alone work;
  Components c = small();
  Points clip = *c.segments[0].points;
  clip.track(0).set(3, clip.track(0)[3] + Vec3{0, 0, 1});  // which no component says
  c.segments[0].points = std::make_shared<const Points>(clip);
  ComponentEditParams params;
  params.edits = {edits::Scale{{1, ""}, 0}};
  const Rows without = edit_components(c, params, {}, work).channels;
  params.residual = true;
  const Rows with = edit_components(c, params, {}, work).channels;
  const Rows kept = channels_from_signals(c, signals_from_channels(c, channels_of(c.space, clip, work)));
  for (std::size_t d = 0; d < 6; ++d)
    EXPECT_NEAR(with(d, 3) - without(d, 3), channels_of(c.space, clip, work)(d, 3) - kept(d, 3), 1e-12);
  EXPECT_GT(std::fabs(with(2, 3) - without(2, 3)), 0.5);
}

TEST(ComponentEdit, RefusesWhatIsNotThere) {
  const Components c = small();
  Diagnostic d = refusal(c, edits::Scale{{3, ""}, 1});
  EXPECT_EQ(d.code, "unknown-component");
  EXPECT_EQ(d.param, "edits[0].component");
  EXPECT_THAT(d.hint, HasSubstr("u1 to u2"));
  EXPECT_EQ(refusal(c, edits::Scale{{0, "legs"}, 1}).code, "unknown-component");
  EXPECT_EQ(refusal(c, edits::Replace{{1, ""}, {30, 60}, {0, 5}, 0, false}).code, "bad-range");
  EXPECT_EQ(refusal(c, edits::CopyAdd{}).port, "other");
  EXPECT_EQ(refusal(c, edits::Substitute{{1, ""}}).code, "no-input");
  EXPECT_EQ(refusal(c, edits::Transfer{{{1, ""}}, 7, 0, {}, false, {}, 1}).code, "unknown-segment");
  EXPECT_EQ(refusal(c, edits::Transfer{{{1, ""}}, 0, 0, {}, false, {}, 1}).code, "bad-edit");
  EXPECT_EQ(refusal(c, edits::Transfer{{{1, ""}}, 1, 0, {}, false, {}, 1}, 1).param, "edits[0].to");
  EXPECT_EQ(refusal(c, edits::Transfer{{{1, ""}}, 1, 0, {"hip"}, false, {}, 1}).code, "bad-align");
  EXPECT_EQ(refusal(c, edits::Warp{{1, ""}, {{40, 0}}}).code, "bad-frame");
  const Diagnostic twice = refusal(c, edits::Warp{{1, ""}, {{10, 1}, {20, 0}, {10, 2}}});
  EXPECT_EQ(twice.code, "bad-edit");
  EXPECT_EQ(twice.param, "edits[0].keys[2]");
  EXPECT_THAT(twice.message, HasSubstr("frame 10 has a key already"));
  const Diagnostic dof = refusal(c, edits::Transfer{{{1, ""}}, 1, 0, {"dof:q.w"}, false, {}, 1});
  EXPECT_EQ(dof.code, "bad-align");
  EXPECT_THAT(dof.hint, HasSubstr("q.x, q.y and q.z"));
  EXPECT_EQ(refusal(c, edits::Transfer{{{1, ""}}, 1, 0, {"dof:r.x"}, false, {}, 1}).code, "unknown-joint");
  EXPECT_EQ(refusal(c, edits::Merge{"u1", {{{1, ""}, 1}}}).code, "bad-edit");
  EXPECT_THAT(refusal(c, edits::Merge{"g", {}}).message, HasSubstr("a group of nothing"));
  EXPECT_EQ(refusal(c, edits::Merge{"g", {{{1, ""}, 1}, {{1, ""}, 1}}}).code, "bad-edit");
}

// On motions, through the nodes.

// A value that can be changed without end: what doesn't depend on it is found once.
TEST(ComponentEdit, FindsAnAlignmentOnceForEveryAmount) {
  class Counting : public Alone {
   public:
    void parallel(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) override {
      ++loops;
      Alone::parallel(count, grain, body);
    }
    int loops = 0;
  };
  Alone quiet;
  const auto walk = shared(gait("walk", 2)), sneak = shared(gait("sneak", 2));
  const Components kept = analysed({walk, sneak}, Representation::points, 3, quiet);
  const auto loops = [](const Components& components, const std::vector<std::string>& align) {
    Counting work;
    aligned_segments(components, components.segments[0], components.segments[1], align, "align", work);
    return work.loops;
  };
  EXPECT_GT(loops(kept, {}), 0);
  EXPECT_EQ(loops(kept, {}), 0);
  Components copy = kept;  // as an edit makes one
  EXPECT_EQ(loops(copy, {}), 0);
  // Another question is another alignment.
  EXPECT_GT(loops(kept, {"joint:LeftUpLeg"}), 0);
  copy.segments[0].motion = shared(*walk);
  EXPECT_GT(loops(copy, {}), 0);
  // What is remembered is what a new one finds: of signals, too, which an edit may have changed.
  for (const std::vector<std::string>& align :
       {std::vector<std::string>{}, {"u1"}, {"u2", "dof:LeftLeg.x"}}) {
    Components fresh = kept;
    fresh.memory = std::make_shared<ComponentMemory>();
    const auto path = [&](const Components& components) {
      Alone work;
      return aligned_segments(components, components.segments[0], components.segments[1], align, "align",
                              work)
          .pairs;
    };
    EXPECT_EQ(path(kept), path(fresh));
    Components changed = kept;
    for (std::size_t t = 0; t < 60; ++t) changed.signals(0, t) *= -3;
    fresh = changed;
    fresh.memory = std::make_shared<ComponentMemory>();
    EXPECT_EQ(path(changed), path(fresh));
  }
}

// Either way round: the map says which joints of another skeleton are compared.
TEST(ComponentEdit, AlignsClipsOfOtherJointNamesByTheComponentsMap) {
  Alone work;
  const auto walk = shared(gait("walk", 1)), sneak = shared(gait("sneak", 1.3));
  Skeleton renamed = sneak->skeleton();
  std::vector<std::string> map;
  for (Joint& joint : renamed.joints) {
    map.push_back("Bip" + joint.name + "=" + joint.name);
    joint.name = "Bip" + joint.name;
  }
  Motion other(std::make_shared<const Skeleton>(renamed), sneak->shared_source(), sneak->fps(),
               sneak->frames(), sneak->translating());
  for (int j = 0; j < other.joints(); ++j) {
    for (std::size_t t = 0; t < other.frames(); ++t) {
      other.rotation(j).set(t, sneak->rotation(j)[t]);
      if (other.translates(j)) other.translation(j).set(t, sneak->translation(j)[t]);
    }
  }
  const std::vector<bool> all(static_cast<std::size_t>(walk->joints()), true);
  const auto path = [&](const Clips& clips, const std::vector<std::string>& names, std::size_t a,
                        const std::vector<std::string>& align) {
    IcaParams params;
    params.components = 2;
    const Components c = components_of_motions(
        space_of_motions(Representation::points, clips, all, true, names, work), clips, params, work);
    return aligned_segments(c, c.segments[a], c.segments[1 - a], align, "align", work).pairs;
  };
  const Clips mapped{walk, shared(std::move(other))}, same{walk, sneak};
  for (std::size_t a : {0u, 1u}) EXPECT_EQ(path(mapped, map, a, {}), path(same, {}, a, {})) << a;
  EXPECT_EQ(path(mapped, map, 0, {"joint:*Leg"}), path(same, {}, 0, {"joint:*Leg"}));
}

TEST(ComponentEdit, TellsTheWarningsOfARememberedAlignmentAgain) {
  Alone first, second;
  const Components c =
      analysed({shared(gait("walk", 1)), shared(gait("sneak", 1))}, Representation::points, 2, first);
  for (Alone* work : {&first, &second})
    aligned_segments(c, c.segments[0], c.segments[1], {"joint:*,-Tail*"}, "align", *work);
  ASSERT_FALSE(second.reported.empty());
  EXPECT_EQ(second.reported.back().code, "no-joint");
  EXPECT_EQ(second.reported.back().message, first.reported.back().message);
}

TEST(ComponentEditOfRealClips, ObeysTransferAndScale) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Clips clips = {real_clip("cmu/asfamc/16_31.amc"), real_clip("cmu/asfamc/17_03.amc")};
  const Components c = analysed(clips, Representation::points, 3, work);
  const Rows scaled = edited(c, {edits::Scale{{1, ""}, 0.3}}).channels;
  const Rows u0 = signals_of(c, c.segments[0]);
  for (std::size_t t = 0; t < u0.columns; t += 17)
    for (std::size_t d = 0; d < scaled.rows; ++d)
      ASSERT_NEAR(
          scaled(d, t),
          c.mean[d] + 0.3 * c.mixing(d, 0) * u0(0, t) + c.mixing(d, 1) * u0(1, t) + c.mixing(d, 2) * u0(2, t),
          1e-12);
  const ComponentEditResult moved =
      edited(c, {edits::Transfer{{{1, ""}, {2, ""}, {3, ""}}, 1, 0, {}, true, {0, {}}, 1}}, 6);
  const Rows other = channels_from_signals(c, signals_of(c, c.segments[1]));
  for (std::size_t i = 0; i < other.data.size(); ++i)
    ASSERT_NEAR(moved.channels.data[i], other.data[i], 1e-12);
}

}  // namespace
}  // namespace kinegraph
