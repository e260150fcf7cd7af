// The papers' workflow, from saved graphs through the real program: components of two clips, of which each
// takes the other's, both ways; and clips in between. Judged on the files it wrote, by measures of its own.
#include <optional>

#include "tests/main_job/exported.h"
#include "tests/main_job/independent_measures.h"

namespace kinegraph {
namespace {

using namespace independent;

double torso_pitch(const Motion& motion) {
  return mean_pitch(motion, "root", "lowerneck", "lfemur", "rfemur");
}

double lowest_toe(const Motion& motion) {
  const auto places = positions_of(motion);
  double low = 1e9;
  for (const char* toes : {"ltoes", "rtoes"})
    for (Vec3 at : places[static_cast<std::size_t>(motion.skeleton().find(toes))]) low = std::min(low, at.y);
  return low;
}

// A run's plants slide faster than a walk's.
constexpr const char* run_plants = "--set a_plants.speed=0.6 --set a_plants.min_time=0.06 ";

struct Job {
  const char *a, *b;
  int carries;  // the component that is given, both ways
  const char* more;
  double least;  // part of the way that the torso's pitch has to go
  double below;  // m, how far toes may pass under the lowest place where they ever are in the clip
  friend void PrintTo(const Job& job, std::ostream* out) { *out << job.a << " with " << job.b; }
};
// Components are in order of their share of variance. For walk and sneak one carries the whole hunch. A run's
// own bobbing is of the same kind, so that two share it there.
const Job jobs[] = {
    {"16_31", "17_03", 1, "", 0.8, 0.005},
    {"07_05", "17_03", 1, "", 0.8, 0.005},
    {"16_45", "17_03", 1, run_plants, 0.35, 0.005},
    {"16_45", "16_31", 2, run_plants, 0.7, 0.022},
};

class ComponentJob : public testing::TestWithParam<Job> {
 protected:
  void SetUp() override {
    KINEGRAPH_NEEDS_MOCAP();
    const Job& job = GetParam();
    const auto edits = [&](int from, int to) {
      return fmt::format(R"([{{"op":"transfer","components":{},"from":{},"to":{}}}])", job.carries, from, to);
    };
    out_.emplace(
        "tests/component_job/both_ways.kg.json", fmt::format("components_{}_{}", job.a, job.b),
        fmt::format("--var a={} --var b={} --set 'a_restyled.edits={}' --set 'b_restyled.edits={}' {}", job.a,
                    job.b, edits(1, 0), edits(0, 1), job.more));
    ASSERT_TRUE(out_->ran());
    for (std::string side : {"a", "b"}) {
      source_.push_back(out_->motion(side + ".bvh"));
      restyled_.push_back(out_->motion(side + "_restyled.bvh"));
      feet_.push_back(out_->motion(side + "_feet.bvh"));
      plants_.push_back(
          std::dynamic_pointer_cast<const Contacts>(out_->value(side + "_plants.json", "contacts")));
      ASSERT_TRUE(source_.back() && restyled_.back() && feet_.back() && plants_.back());
    }
  }

  std::optional<Exported> out_;
  std::vector<std::shared_ptr<const Motion>> source_, restyled_, feet_;  // a, b
  std::vector<std::shared_ptr<const Contacts>> plants_;
};

TEST_P(ComponentJob, LeansTheTorsoAsTheOtherClipDoes) {
  for (std::size_t side : {0, 1}) {
    const double before = torso_pitch(*source_[side]), wanted = torso_pitch(*source_[1 - side]),
                 after = torso_pitch(*restyled_[side]), held = torso_pitch(*feet_[side]);
    const double part = (after - before) / (wanted - before);
    EXPECT_GT(part, GetParam().least);
    EXPECT_LT(part, 1.2);
    EXPECT_NEAR(held, after, 1.5) << "Footskate leaves the torso alone";
    fmt::print("{} <- {}: pitch {:.1f}° of {:.1f}° -> {:.1f}° ({:.0f} %)\n",
               side ? GetParam().b : GetParam().a, side ? GetParam().a : GetParam().b, before, wanted, after,
               100 * part);
  }
}

TEST_P(ComponentJob, KeepsPathAndHeading) {
  for (std::size_t side : {0, 1}) {
    const auto was = positions_of(*source_[side])[0], is = positions_of(*restyled_[side])[0];
    const auto psi = heading_of(*source_[side]).psi, now = heading_of(*restyled_[side]).psi;
    ASSERT_EQ(was.size(), is.size());
    for (std::size_t t = 0; t < was.size(); ++t) {
      ASSERT_LT(norm(is[t] - was[t]), 1e-6) << "frame " << t;
      ASSERT_LT(std::fabs(std::remainder(now[t] - psi[t], 2 * M_PI)), 1.5 * M_PI / 180) << "frame " << t;
    }
  }
}

TEST_P(ComponentJob, HoldsPlantedFeet) {
  for (std::size_t side : {0, 1}) {
    std::size_t plants = 0;
    for (const FootPoint& point : plants_[side]->points) plants += runs_of(point.planted).size();
    EXPECT_GE(plants, 4u) << "or nothing is held";
    EXPECT_LT(farthest_from_plants(*feet_[side], *plants_[side]), 1e-3) << "m, side " << side;
  }
}

// Free feet don't swing through the floor.
TEST_P(ComponentJob, SwingsFeetAboveTheFloor) {
  for (std::size_t side : {0, 1}) {
    EXPECT_GT(lowest_toe(*feet_[side]), lowest_toe(*source_[side]) - GetParam().below) << "side " << side;
    fmt::print("toes: {:.3f} m in the clip, {:.3f} restyled, {:.3f} after Footskate\n",
               lowest_toe(*source_[side]), lowest_toe(*restyled_[side]), lowest_toe(*feet_[side]));
  }
}

TEST_P(ComponentJob, StaysSmooth) {
  for (std::size_t side : {0, 1})
    EXPECT_EQ(joints_that_jerk(*feet_[side], *source_[side], *source_[1 - side]), "") << "side " << side;
}

INSTANTIATE_TEST_SUITE_P(Pairs, ComponentJob, testing::ValuesIn(jobs),
                         [](const auto& job) { return fmt::format("{}_{}", job.param.a, job.param.b); });

// Both clips on one clock before they are joined, and what lies between a clip and its restyled self [Shapiro
// Fig. 6]: every pair, both ways.
struct Aligned {
  const char *receives, *gives;
  int carries;
  double least;
  const char* more;
  friend void PrintTo(const Aligned& job, std::ostream* out) {
    *out << job.receives << " from " << job.gives;
  }
};
constexpr const char* run_lands = "--set plants.speed=0.6 --set plants.min_time=0.06 ";
// A run's 135 frames on a sneak's 450: by all joints they are held five at a time and then left out six at a
// time, by the legs evenly.
constexpr const char* run_lands_by_its_legs =
    "--set plants.speed=0.6 --set plants.min_time=0.06 --set "
    "'clock.features=\"lfemur,rfemur,ltibia,rtibia\"' ";
const Aligned aligned[] = {
    {"16_31", "17_03", 1, 0.8, ""},
    {"17_03", "16_31", 1, 0.8, ""},
    {"07_05", "17_03", 1, 0.8, ""},
    {"17_03", "07_05", 1, 0.8, ""},
    {"16_45", "17_03", 1, 0.8, run_lands_by_its_legs},
    {"17_03", "16_45", 1, 0.8, ""},
    {"16_45", "16_31", 2, 0.8, run_lands},
    {"16_31", "16_45", 2, 0.8, ""},
};
class AlignedComponentJob : public testing::TestWithParam<Aligned> {};

TEST_P(AlignedComponentJob, LeansMoreAndMoreFromTheClipToItsRestyledSelf) {
  KINEGRAPH_NEEDS_MOCAP();
  const Aligned& job = GetParam();
  const Exported out(
      "tests/component_job/aligned.kg.json", fmt::format("components_aligned_{}_{}", job.receives, job.gives),
      fmt::format(
          R"(--var walk={} --var sneak={} --set 'restyled.edits=[{{"op":"transfer","components":{},"from":1,"to":0}}]' {})",
          job.receives, job.gives, job.carries, job.more));
  ASSERT_TRUE(out.ran());
  const auto walk = out.motion("walk.bvh"), sneak = out.motion("sneak.bvh"),
             last = out.motion("restyled.bvh");
  ASSERT_TRUE(walk && sneak && last);
  const double before = torso_pitch(*walk), after = torso_pitch(*last), wanted = torso_pitch(*sneak);
  EXPECT_GT((after - before) / (wanted - before), job.least);
  for (int percent : {25, 50, 75}) {
    const auto between = out.motion(fmt::format("restyled_{}.bvh", percent));
    EXPECT_NEAR((torso_pitch(*between) - before) / (after - before), percent / 100.0, 0.05) << percent;
    EXPECT_EQ(joints_that_jerk(*between, *walk, *sneak), "") << percent;
  }
  fmt::print("aligned {} <- {}: pitch {:.1f}° of {:.1f}° -> {:.1f}° ({:.0f} %)\n", job.receives, job.gives,
             before, wanted, after, 100 * (after - before) / (wanted - before));
  EXPECT_EQ(joints_that_jerk(*last, *walk, *sneak), "");
  const auto plants = std::dynamic_pointer_cast<const Contacts>(out.value("plants.json", "contacts"));
  ASSERT_TRUE(plants);
  std::size_t count = 0;
  for (const FootPoint& point : plants->points) count += runs_of(point.planted).size();
  EXPECT_GE(count, 4u) << "or nothing is held";
  EXPECT_LT(farthest_from_plants(*last, *plants), 1e-3);
  EXPECT_GT(lowest_toe(*last), lowest_toe(*walk) - 0.005);
}

INSTANTIATE_TEST_SUITE_P(Pairs, AlignedComponentJob, testing::ValuesIn(aligned), [](const auto& job) {
  return fmt::format("{}_from_{}", job.param.receives, job.param.gives);
});

}  // namespace
}  // namespace kinegraph
