#include "nodes/components/component_edit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/alignment.h"
#include "nodes/components/rebuild.h"
#include "nodes/motion/kinematics.h"
#include "nodes/time/motion_warp.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
NodeType ica_node();
NodeType component_edit_node();
NodeType component_motion_node();
NodeType component_project_node();
namespace {

using testing::HasSubstr;

// Two points that move by two components, in two segments of 40 and 50 frames: numbers that can be followed
// by hand.
Components small() {
  Components c;
  c.space.of_motions = false;
  c.space.heading = false;
  c.space.labels = {"p", "q"};
  c.fps = 60;
  c.mean = {1, 2, 3, 4, 5, 6};
  c.mixing = Rows(6, 2);
  c.mixing.data = {1, 0, 0, 2, 0.5, 0, 0, 0, 1, 1, 0, -1};
  c.unmixing = Rows(2, 6);
  // (MᵀM)⁻¹Mᵀ with MᵀM = [2.25 1; 1 6]
  const double determinant = 2.25 * 6 - 1;
  for (std::size_t d = 0; d < 6; ++d) {
    c.unmixing(0, d) = (6 * c.mixing(d, 0) - c.mixing(d, 1)) / determinant;
    c.unmixing(1, d) = (2.25 * c.mixing(d, 1) - c.mixing(d, 0)) / determinant;
  }
  c.signals = Rows(2, 90);
  for (std::size_t t = 0; t < 90; ++t) {
    c.signals(0, t) = sine(0.2 * static_cast<double>(t)) + (t < 40 ? 1 : -1);
    c.signals(1, t) = cosine(0.3 * static_cast<double>(t));
  }
  c.shares = {0.6, 0.4};
  c.unique = {true, true};
  for (const auto& [start, end] : {std::pair<std::size_t, std::size_t>{0, 40}, {40, 90}}) {
    Points clip(c.space.labels, 60, end - start);
    for (std::size_t t = start; t < end; ++t)
      for (int i = 0; i < 2; ++i) {
        Vec3 at;
        for (int axis = 0; axis < 3; ++axis) {
          const auto d = static_cast<std::size_t>(3 * i + axis);
          at[axis] = c.mean[d] + c.mixing(d, 0) * c.signals(0, t) + c.mixing(d, 1) * c.signals(1, t);
        }
        clip.track(i).set(t - start, at);
      }
    c.segments.push_back({start, end, nullptr, std::make_shared<const Points>(std::move(clip)), {}});
  }
  return c;
}

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

Components walk_and_sneak(int components = 4) {
  Alone work;
  return analysed({shared(turning(gait("walk", 2.4), 0.6)), shared(gait("sneak", 2.8))},
                  Representation::points, components, work);
}
double farthest(const Points& a, const Points& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) worst = std::max(worst, std::fabs(a.data[i] - b.data[i]));
  return worst;
}
NodeInMemory editing(const Components& components, Json edits) {
  NodeInMemory node(component_edit_node());
  node.link("components", components);
  node.set("edits", Json::Array{std::move(edits)});
  return node;
}

TEST(ComponentEditNode, ChecksEachOpsFields) {
  const auto refused = [](const char* text) {
    NodeInMemory node(component_edit_node());
    Json::Array list{parse_value(component_edit_node().find_param("edits")->parts[0], text)};
    return check(*component_edit_node().find_param("edits"), list, "edits").front();
  };
  EXPECT_THAT(refused(R"({"op":"merge","name":"g"})").message, HasSubstr("\"terms\" is missing"));
  EXPECT_THAT(refused(R"({"op":"translate","component":1,"factor":2})").message, HasSubstr("no \"factor\""));
  EXPECT_EQ(refused(R"({"op":"transfer","components":1,"from":1,"to":0,"amount":"x"})").param,
            "edits[0].amount");
}

TEST(ComponentEditNode, ScalesOnTheBasesPath) {
  const Components c = walk_and_sneak();
  Json::Object scale{{"op", "scale"}, {"component", "u1"}, {"factor", 1.6}};
  NodeInMemory node = editing(c, scale);
  node.run();
  const Motion& walk = *c.segments[0].motion;
  const auto& motion = node.out<Motion>("motion");
  EXPECT_EQ(difference(motion, walk).position, 0);
  Alone work;
  const EncodedRoot before = encode_root(walk, work), after = encode_root(motion, work);
  for (std::size_t t = 0; t < walk.frames(); ++t) EXPECT_NEAR(before.heading[t], after.heading[t], 0.01);
  EXPECT_GT(difference(motion, walk).turn, 0.05);
}

TEST(ComponentEditNode, KeepsBonesAndDirectionsWithLimbs) {
  Alone work;
  const Components c = walk_and_sneak();
  Json::Object scale{{"op", "scale"}, {"component", 1}, {"factor", 1.8}};
  NodeInMemory node = editing(c, scale), loose = editing(c, scale);
  node.run();
  loose.set("limbs", false).run();
  const auto &points = node.out<Points>("points"), &raw = loose.out<Points>("points");
  const Skeleton& skeleton = *c.space.skeleton;
  double stretched = 0;
  for (int j = 1; j < skeleton.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    for (std::size_t t = 0; t < points.frames; ++t) {
      const Vec3 link = points.track(j)[t] - points.track(parent)[t],
                 free = raw.track(j)[t] - raw.track(parent)[t];
      ASSERT_NEAR(norm(link), skeleton.link_length(j), 1e-6);
      ASSERT_LT(norm(cross(normalized(link), normalized(free))), 1e-9);
      stretched = std::max(stretched, std::fabs(norm(free) / skeleton.link_length(j) - 1));
    }
  }
  EXPECT_GT(stretched, 0.01) << "or the test shows nothing";
  // Without limbs the motion's joints lie on the points, by varying translations.
  const WorldMotion world = world_motion(loose.out<Motion>("motion"));
  for (int j = 0; j < skeleton.size(); ++j)
    for (std::size_t t = 0; t < raw.frames; ++t)
      ASSERT_LT(norm(world.position(j)[t] - raw.track(j)[t]), 1e-9);
}

TEST(ComponentEditNode, TransferOfAllWithTheOthersTimingGivesThatMotionOnTheBasesPath) {
  Alone work;
  const Components c = walk_and_sneak();
  Json::Object transfer{{"op", "transfer"},
                        {"components", Json::Array{1, 2, 3, 4}},
                        {"from", 1},
                        {"to", 0},
                        {"keep_timing_of", "from"}};
  NodeInMemory node = editing(c, transfer);
  node.set("limbs", false).run();
  const auto& result = node.out<Components>("components");
  ASSERT_EQ(result.segments[0].frames(), c.segments[1].frames());
  const Rows kept = channels_from_signals(c, signals_of(c, c.segments[1]));
  const Points expected =
      points_from_channels(c.space, kept, *result.segments[0].motion, {false, true}, work);
  EXPECT_LT(farthest(node.out<Points>("points"), expected), 1e-12);
  // The path is the walk's: it ends where the walk does.
  const Motion& walk = *c.segments[0].motion;
  const Motion& moved = node.out<Motion>("motion");
  EXPECT_LT(
      norm(pose_at(walk, walk.frames() - 1).positions[0] - pose_at(moved, moved.frames() - 1).positions[0]),
      0.1);
}

TEST(ComponentEditNode, GoesOnFromItsOwnComponents) {
  const Components c = walk_and_sneak();
  const Json::Object first{{"op", "scale"}, {"component", 1}, {"factor", 1.5}},
      second{{"op", "translate"}, {"component", 2}, {"value", 0.4}};
  NodeInMemory one = editing(c, first);
  one.run();
  NodeInMemory two = editing(one.out<Components>("components"), second);
  two.run();
  NodeInMemory both(component_edit_node());
  both.link("components", c).set("edits", Json::Array{first, second}).run();
  EXPECT_LT(farthest(two.out<Points>("points"), both.out<Points>("points")), 1e-12);
}

TEST(ComponentEditNode, SubstitutesAMotionWarpedComponent) {
  Alone work;
  const Components c = walk_and_sneak();
  NodeInMemory shown(component_motion_node());
  shown.link("components", c).set("component", 1).run();
  const Motion& component = shown.out<Motion>("motion");
  NodeInMemory plain(component_edit_node()),
      same = editing(c, Json::Object{{"op", "substitute"}, {"component", 1}}), warped = same;
  plain.link("components", c).run();
  same.link("edited", component).run();
  EXPECT_LT(farthest(plain.out<Points>("points"), same.out<Points>("points")), 1e-9);
  const std::string arm = "LeftArm";
  const int joint = component.skeleton().find(arm);
  const Motion bent_motion = motion_warp(
      component, {{60, arm, component.rotation(joint)[60] * axis_angle({1, 0, 0}, 0.8), {}}}, work);
  warped.link("edited", bent_motion).run();
  EXPECT_GT(farthest(plain.out<Points>("points"), warped.out<Points>("points")), 0.02);
}

TEST(ComponentEditNode, WithAllComponentsAndNoEditsReturnsTheMotion) {
  for (Representation representation : {Representation::points, Representation::quaternions,
                                        Representation::euler, Representation::logarithm}) {
    Alone work;
    const Clips clips = {shared(turning(gait("walk", 2.4), 0.6)), shared(gait("sneak", 2.8))};
    IcaParams params;
    params.variance = 1;
    params.rotate = false;
    const std::vector<bool> all(clips.front()->joints(), true);
    Components c = components_of_motions(space_of_motions(representation, clips, all, true, {}, work), clips,
                                         params, work);
    NodeInMemory node(component_edit_node());
    node.link("components", std::move(c)).set("segment", 1).set("residual", true).run();
    const WorldMotion a = world_motion(node.out<Motion>("motion")), b = world_motion(*clips[1]);
    double apart = 0;
    for (int j = 0; j < a.joints(); ++j)
      for (std::size_t t = 0; t < a.frames(); ++t)
        apart = std::max(apart, norm(a.position(j)[t] - b.position(j)[t]));
    EXPECT_LT(apart, 1e-9) << name_of(representation);
  }
}

TEST(ComponentEditNode, StaysOnTheSpotWithoutRoot) {
  const Components c = walk_and_sneak();
  NodeInMemory node(component_edit_node());
  node.link("components", c).set("root", false).run();
  const auto& motion = node.out<Motion>("motion");
  for (std::size_t t = 0; t < motion.frames(); ++t) {
    EXPECT_NEAR(motion.translation(0)[t].x, 0, 1e-9);
    EXPECT_NEAR(motion.translation(0)[t].z, 0, 1e-9);
  }
  const WorldMotion world = world_motion(motion);
  const auto& points = node.out<Points>("points");
  const int hand = motion.joints() - 1;
  EXPECT_LT(norm(world.position(hand)[50] - points.track(hand)[50]), 0.05);
}

TEST(ComponentMotionNode, SumsToTheRankKApproximation) {
  const Components c = walk_and_sneak(3);
  const auto shown = [&](Json which) {
    NodeInMemory node(component_motion_node());
    node.link("components", c).set("component", std::move(which)).set("segment", 1).run();
    return node;
  };
  NodeInMemory all = shown(Json::Array{}), listed = shown(Json::Array{1, "u2", 3}), first = shown(1),
               second = shown(2), third = shown(3), plain(component_edit_node());
  plain.link("components", c).set("segment", 1).set("limbs", false).run();
  EXPECT_EQ(all.out<Points>("points").data, listed.out<Points>("points").data);
  Alone work;
  NodeInMemory node(component_motion_node());
  Rows sum(c.space.channels(), c.segments[1].frames());
  for (std::size_t i = 0; i < 3; ++i) {
    const Rows x = channels_from_signals(c, signals_of(c, c.segments[1]), {i});
    for (std::size_t d = 0; d < x.rows; ++d)
      for (std::size_t t = 0; t < x.columns; ++t) sum(d, t) += x(d, t) - c.mean[d];
  }
  for (std::size_t d = 0; d < sum.rows; ++d)
    for (std::size_t t = 0; t < sum.columns; ++t) sum(d, t) += c.mean[d];
  const Points expected = points_of(c, sum, c.segments[1], {}, work);
  EXPECT_LT(farthest(all.out<Points>("points"), expected), 1e-9);
}

TEST(ComponentMotionNode, SaysThatPointsGiveNoMotion) {
  NodeInMemory node(component_motion_node());
  const Diagnostic d = node.link("components", small()).refusal();
  EXPECT_EQ(d.code, "no-motion");
  EXPECT_EQ(d.port, "motion");
}

TEST(ComponentProjectNode, FindsTheSignalsOfItsOwnClips) {
  const Components c = walk_and_sneak();
  NodeInMemory node(component_project_node());
  node.link("components", c).link("motion", ValuePtr(c.segments[1].motion)).run();
  const auto& projected = node.out<Components>("components");
  ASSERT_EQ(projected.segments.size(), 1u);
  for (std::size_t i = 0; i < c.count(); ++i)
    for (std::size_t t = 0; t < projected.frames(); ++t)
      ASSERT_NEAR(projected.signals(i, t), c.signals(i, c.segments[1].start + t), 1e-9);
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
