// `kinegraph convert` between all formats: what each can become, with the same places, and what it can't.
#include <cmath>

#include "nodes/files/motion_file.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/points.h"
#include "program.h"
#include "tests/mocap.h"
#include "tests/nodes/files/fbx_texts.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

enum class Holds { motion, points };

struct Source {
  const char* name;
  const char* file;  // "" = made here
  Holds holds;
};
const Source sources[] = {{"bvh", "cmu/bvh/02_03.bvh", Holds::motion},
                          {"amc", "cmu/asfamc/09_06.amc", Holds::motion},
                          {"glb", "gltf/CesiumMan.glb", Holds::motion},
                          {"gltf", "gltf/SimpleSkin.gltf", Holds::motion},
                          {"fbx", "", Holds::motion},
                          {"c3d", "points/cmu_02_01.c3d", Holds::points},
                          {"trc", "points/gait10dof18musc_walk_CRLF_line_ending.trc", Holds::points},
                          {"csv", "points/face_eyebrows.csv", Holds::points}};

struct Pair {
  Source from;
  const char* to;
};
std::vector<Pair> pairs() {
  std::vector<Pair> all;
  for (const Source& from : sources)
    for (const char* to : {"bvh", "glb", "gltf", "c3d", "trc", "csv", "json", "amc", "fbx"})
      all.push_back({from, to});
  return all;
}

class Convert : public ProgramTest, public testing::WithParamInterface<Pair> {
 protected:
  static MotionFile load(const std::string& file, const ReadOptions& options) {
    PlainFiles files;
    Alone work;
    return read_motion_file(file, options, files, work);
  }
};

bool can_become(Holds holds, const std::string& to) {
  if (to == "c3d" || to == "trc" || to == "csv") return true;
  return holds == Holds::motion && (to == "bvh" || to == "glb" || to == "gltf");
}

// Largest distance between places of the same name, and that they are missing alike.
double apart(const Points& a, const Points& b) {
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.labels.size(), b.labels.size());
  double most = 0;
  for (std::size_t i = 0; i < a.labels.size(); ++i) {
    const auto found = std::find(b.labels.begin(), b.labels.end(), a.labels[i]);
    if (found == b.labels.end()) {
      ADD_FAILURE() << "no " << a.labels[i];
      continue;
    }
    const int label = static_cast<int>(i), other = static_cast<int>(found - b.labels.begin());
    for (std::size_t t = 0; t < std::min(a.frames, b.frames); ++t) {
      EXPECT_EQ(a.is_missing(label, t), b.is_missing(other, t)) << a.labels[i] << " " << t;
      if (!a.is_missing(label, t)) most = std::max(most, norm(a.track(label)[t] - b.track(other)[t]));
    }
  }
  return most;
}

Points places_of(const MotionFile& file) {
  if (!file.motion()) return *file.points();
  return dynamic_cast<const Points&>(*points_of_motion(*file.motion()));
}

TEST_P(Convert, KeepsPlacesOrSaysWhyNot) {
  const auto& [from, to] = GetParam();
  std::string in = path("in.fbx");
  if (*from.file) {
    KINEGRAPH_NEEDS_MOCAP();
    in = mocap(from.file);
  } else {
    write("in.fbx", text_fbx(1, 2, 1, 1));
  }
  const std::string out = std::string("out.") + to;
  const Ran ran = run({"convert", in, out});
  if (ran.err.find("built without Assimp") != std::string::npos) {
    EXPECT_EQ(ran.exit, 3);
    GTEST_SKIP() << "FBX needs Assimp";
  }
  if (!can_become(from.holds, to)) {
    EXPECT_EQ(ran.exit, 3) << ran.out << ran.err;
    EXPECT_NE(ran.err.find("error: "), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find(to), std::string::npos) << ran.err;
    EXPECT_FALSE(exists(out));
    return;
  }
  ASSERT_EQ(ran.exit, 0) << ran.out << ran.err;
  const MotionFile before = load(in, {});
  const Points was = places_of(before);
  ReadOptions options;
  options.max_gap = 0;
  if (std::string(to) == "bvh")
    options.unit = Json(before.motion()->source().unit);                  // which a BVH doesn't say
  if (std::string(to) == "trc" && was.up == UpAxis::z) options.up = "z";  // nor a TRC what is up
  const MotionFile after = load(path(out), options);
  const Points is = places_of(after);
  EXPECT_NEAR(is.fps, was.fps, 1e-3 * was.fps);
  // C3D holds single precision, and the table of a face, which says no unit, is tens of metres large.
  double farthest = 0;
  for (const double x : was.data) farthest = std::max(farthest, std::fabs(x));
  EXPECT_LT(apart(was, is), std::max(2e-6, 1.1e-7 * farthest)) << ran.err;
}

INSTANTIATE_TEST_SUITE_P(Table, Convert, testing::ValuesIn(pairs()), [](const auto& one) {
  return std::string(one.param.from.name) + "_to_" + one.param.to;
});

}  // namespace
}  // namespace kinegraph
