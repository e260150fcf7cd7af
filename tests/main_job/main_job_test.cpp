// The main job, from saved graphs through the real program: the four pairs of [Wu] Table 1 as far as the
// clips are to be had. Judged on the files it wrote, by measures of its own.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "graph/evaluate/file_store.h"
#include "independent_measures.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/contacts.h"
#include "tests/mocap.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

class MainJob : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    KINEGRAPH_NEEDS_MOCAP();
    out_ = fs::temp_directory_path() / fmt::format("kinegraph_main_job_{}_{}", GetParam(), ::getpid());
    fs::create_directories(out_);
    const std::string command = fmt::format(
        "'{}/kinegraph' run '{}/tests/main_job/{}.kg.json' --var 'mocap={}' --out '{}' --progress none "
        "--report '{}/report.json' > '{}/log' 2>&1",
        KINEGRAPH_BIN_DIR, KINEGRAPH_SOURCE_DIR, GetParam(), mocap(), out_.string(), out_.string(),
        out_.string());
    const int status = std::system(command.c_str());
    std::ifstream log(out_ / "log");
    std::stringstream text;
    text << log.rdbuf();
    ASSERT_EQ(WEXITSTATUS(status), 0) << command << "\n" << text.str();
    source_ = motion("_source.bvh");
    warped_ = motion("_warped.bvh");
    transferred_ = motion("_transferred.bvh");
    reference_ = motion("_reference.bvh");
    result_ = motion(".bvh");
    stats_ = std::dynamic_pointer_cast<const Stats>(value("_style.json", "stats"));
    contacts_ = std::dynamic_pointer_cast<const Contacts>(value("_plants.json", "contacts"));
    ASSERT_TRUE(stats_ && contacts_);
    // Partners: the result's joints by the names that the Stats use.
    for (const JointStats& joint : stats_->joints) wanted_.push_back(joint);
    Skeleton from;
    for (const JointStats& joint : stats_->joints) from.joints.push_back({joint.joint, -1, {}, {}});
    const std::vector<int> of = partners(from, source_->skeleton(), {});
    std::vector<JointStats> named;
    for (int j = 0; j < source_->joints(); ++j) {
      if (of[j] < 0) continue;
      named.push_back(stats_->joints[of[j]]);
      named.back().joint = source_->skeleton().joints[j].name;
    }
    wanted_ = named;
    ASSERT_GT(wanted_.size(), 10u);
  }
  void TearDown() override {
    if (!out_.empty() && !HasFailure()) fs::remove_all(out_);
  }
  ValuePtr value(const std::string& ending, const std::string& port) {
    FileStore files;
    Alone work;
    MotionFile file = read_motion_file((out_ / (GetParam() + ending)).string(), {}, files, work);
    for (const FileContent& content : file.contents)
      if (content.port == port) return content.value;
    return nullptr;
  }
  std::shared_ptr<const Motion> motion(const std::string& ending) {
    return std::dynamic_pointer_cast<const Motion>(value(ending, "motion"));
  }

  fs::path out_;
  std::shared_ptr<const Motion> source_, warped_, transferred_, reference_, result_;
  std::shared_ptr<const Stats> stats_;
  std::shared_ptr<const Contacts> contacts_;
  std::vector<JointStats> wanted_;
};

TEST_P(MainJob, TakesOnTheStyle) {
  const double at_first = independent::mean_of(independent::style_distances(*warped_, wanted_));
  const auto before = independent::style_distances(*warped_, wanted_);
  const auto transferred = independent::style_distances(*transferred_, wanted_);
  const auto result = independent::style_distances(*result_, wanted_);
  EXPECT_LT(independent::mean_of(transferred), 0.05 * at_first)
      << "style distance before UnwarpTime, of " << at_first;
  EXPECT_LT(independent::mean_of(result), 0.30 * at_first)
      << "style distance of the exported file, of " << at_first;
  std::string worse;
  for (const auto& [joint, distance] : result)
    if (before.count(joint) && distance > before.at(joint))
      worse += fmt::format(" {} {:.2f}->{:.2f}°", joint, before.at(joint), distance);
  fmt::print("{}: style distance {:.2f}° -> {:.3f}° before UnwarpTime -> {:.3f}° exported; worse joints:{}\n",
             GetParam(), at_first, independent::mean_of(transferred), independent::mean_of(result),
             worse.empty() ? " none" : worse);
}

TEST_P(MainJob, KeepsStepsAndCadence) {
  const std::vector<Leg> legs = find_legs(source_->skeleton());
  ASSERT_EQ(legs.size(), 2u);
  const auto name = [&](int leg) { return source_->skeleton().joints[legs[leg].ankle].name; };
  const independent::Steps was = independent::steps_of(*source_, name(0), name(1));
  const independent::Steps is = independent::steps_of(*result_, name(0), name(1));
  EXPECT_GT(was.count, 1);
  EXPECT_EQ(is.count, was.count);
  EXPECT_NEAR(is.cadence, was.cadence, 0.02 * was.cadence) << "steps a second";
  fmt::print("{}: {} steps at {:.3f} a second -> {} at {:.3f}\n", GetParam(), was.count, was.cadence,
             is.count, is.cadence);
}

TEST_P(MainJob, KeepsTheHeading) {
  const auto was = independent::heading_of(*source_), is = independent::heading_of(*result_);
  ASSERT_EQ(was.psi.size(), is.psi.size());
  for (std::size_t t = 0; t < was.psi.size(); ++t)
    ASSERT_NEAR(std::remainder(is.psi[t] - was.psi[t], 2 * M_PI) * 180 / M_PI, 0, 0.5) << "frame " << t;
  const auto direction = [](const Motion& motion) {
    const auto positions = independent::positions_of(motion)[0];
    const Vec3 d = positions.back() - positions.front();
    return std::atan2(d.x, d.z);
  };
  EXPECT_NEAR(std::remainder(direction(*result_) - direction(*source_), 2 * M_PI) * 180 / M_PI, 0, 3);
}

TEST_P(MainJob, HoldsPlantedPoints) {
  const auto positions = independent::positions_of(*result_);
  // World orientation by plain kinematics, for points that lie in a joint's frame.
  std::vector<std::vector<Quat>> world(positions.size(), std::vector<Quat>(result_->frames()));
  for (int j = 0; j < result_->joints(); ++j)
    for (std::size_t t = 0; t < result_->frames(); ++t) {
      const int parent = result_->skeleton().joints[j].parent;
      world[j][t] = (parent < 0 ? result_->skeleton().above : world[parent][t]) * result_->rotation(j)[t];
    }
  double largest = 0;
  for (const FootPoint& point : contacts_->points) {
    const int joint = result_->skeleton().find(point.joint_name);
    ASSERT_GE(joint, 0) << point.joint_name;
    for (const auto& run : runs_of(point.planted)) {
      const auto at = [&](std::size_t t) {
        return positions[joint][t] + rotate(world[joint][t], point.local);
      };
      Vec3 mean;
      for (std::size_t t = run.start; t < run.end; ++t)
        mean += at(t) / static_cast<double>(run.end - run.start);
      for (std::size_t t = run.start; t < run.end; ++t) largest = std::max(largest, norm(at(t) - mean));
    }
  }
  EXPECT_LT(largest, 1e-3) << "m, largest distance of a planted point from where it is planted";
}

TEST_P(MainJob, StaysSmooth) {
  const auto result = independent::largest_accelerations(*result_);
  const auto source = independent::largest_accelerations(*source_);
  const auto reference = independent::largest_accelerations(*reference_);
  const std::vector<int> of = partners(reference_->skeleton(), source_->skeleton(), {});
  for (const auto& [joint, largest] : result) {
    const int at = source_->skeleton().find(joint);
    double own = source.at(joint);
    if (at >= 0 && of[at] >= 0) own = std::max(own, reference.at(reference_->skeleton().joints[of[at]].name));
    EXPECT_LT(largest, 2 * own + 20) << joint << ", m/s²; the larger of its inputs " << own;
  }
}

INSTANTIATE_TEST_SUITE_P(Wu, MainJob, testing::Values("stealthy", "stride_run", "happy", "old"),
                         [](const auto& pair) { return std::string(pair.param); });

}  // namespace
}  // namespace kinegraph
