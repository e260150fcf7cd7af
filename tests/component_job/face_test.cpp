// Faces [Cao §7.1]: clips of brows and of a jaw, joined, separate into components that move the one or the
// other; those are scaled, shifted, repeated, mixed and borrowed, and carried to a mesh.
#include <algorithm>
#include <cmath>

#include "nodes/components/component_meaning.h"
#include "nodes/components/ica.h"
#include "nodes/motion/metrics.h"
#include "tests/main_job/exported.h"
#include "tests/nodes/points/face_mask.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

const char* const brow_labels = "*eyebrow*,Eyebrow_Center";
const char* const jaw_labels = "Chin*,Mouth_Down*";

bool is_brow(const std::string& label) {
  return label.find("eyebrow") != std::string::npos || label == "Eyebrow_Center";
}
bool is_jaw(const std::string& label) {
  return label.starts_with("Chin") || label.starts_with("Mouth_Down");
}

std::shared_ptr<const Points> clip(const char* path) {
  FileStore files;
  Alone work;
  const MotionFile file = read_motion_file(mocap(path), {}, files, work);
  return std::make_shared<const Points>(*file.points());
}
std::shared_ptr<const Points> brows() {
  return clip("points/face_eyebrows.trc");
}
std::shared_ptr<const Points> jaw() {
  return clip("points/face_jaw.trc");
}

// How much the components that rebuild the brows are those that rebuild the jaw: of each region the parts
// that the components take off its error, as shares; then what both profiles have in common. 0 = apart, 1 =
// the same.
double overlap(const Components& components, std::size_t emotion, const char* brow_pattern = brow_labels,
               const char* jaw_pattern = jaw_labels) {
  Alone work;
  MeaningParams params;
  params.pairs = {{0, 1}};
  params.emotion = {{static_cast<int>(emotion) + 1, ""}};
  params.regions = {{"brows", brow_pattern}, {"jaw", jaw_pattern}};
  const auto d = component_meaning(components, params, work).d_region;
  double sums[2] = {};
  for (int region = 0; region < 2; ++region)
    for (double value : d[static_cast<std::size_t>(region)]) sums[region] += std::max(0.0, -value);
  double common = 0;
  for (std::size_t i = 0; i < components.count(); ++i)
    common += std::min(std::max(0.0, -d[0][i]) / sums[0], std::max(0.0, -d[1][i]) / sums[1]);
  return common;
}

// Joined clips into k components; head motion left in, or taken out by the nose and the corners of the eyes.
Components decomposed(int k, bool rotate, bool still_head, const FastIcaParams& fast_ica = {}) {
  Alone work;
  const std::vector<std::shared_ptr<const Points>> clips = {brows(), jaw()};
  std::vector<bool> chosen;
  for (const std::string& label : clips[0]->labels)
    chosen.push_back(!still_head || label.starts_with("Nose") || label.find("eye_Inside") != label.npos ||
                     label.find("eye_Outside") != label.npos);
  IcaParams params;
  params.components = k;
  params.rotate = rotate;
  params.fast_ica = fast_ica;
  return components_of_points(space_of_points(clips, still_head ? Stabilise::rigid : Stabilise::none, chosen),
                              clips, params, work);
}
// What is common to both profiles, for each component taken for the emotion; rising.
std::vector<double> overlaps(int k, bool rotate, bool still_head, const FastIcaParams& fast_ica = {}) {
  const Components parts = decomposed(k, rotate, still_head, fast_ica);
  std::vector<double> out;
  for (std::size_t emotion = 0; emotion < parts.count(); ++emotion) out.push_back(overlap(parts, emotion));
  std::sort(out.begin(), out.end());
  return out;
}

// Whichever component is taken for the emotion, here or there: the worst of ICA against the best of PCA. k =
// 0 is as many as explain 95 % of the variance, six.
class FacesInParts : public testing::TestWithParam<std::tuple<int, bool>> {};
INSTANTIATE_TEST_SUITE_P(Of, FacesInParts,
                         testing::Combine(testing::Values(0, 2, 5, 6, 7, 8, 10, 12), testing::Bool()),
                         [](const auto& of) {
                           return fmt::format("{}{}", std::get<0>(of.param),
                                              std::get<1>(of.param) ? "_StillHead" : "");
                         });
TEST_P(FacesInParts, SeparateBetterIntoIndependentThanIntoPrincipalComponents) {
  KINEGRAPH_NEEDS_MOCAP();
  const auto [k, still_head] = GetParam();
  const auto independent = overlaps(k, true, still_head), principal = overlaps(k, false, still_head);
  if (k == 0) {
    EXPECT_EQ(independent.size(), 6u);
  }
  EXPECT_LT(independent.back(), principal.front());
  RecordProperty("overlap", fmt::format("{:.3f} to {:.3f}, {:.3f} to {:.3f}", independent.front(),
                                        independent.back(), principal.front(), principal.back()));
}

// With the head still, as in the graphs, it is so by every nonlinearity and method.
TEST(Faces, SeparateBetterByEveryNonlinearityAndMethod) {
  KINEGRAPH_NEEDS_MOCAP();
  for (int k : {0, 5, 7, 8}) {
    const double principal = overlaps(k, false, true).front();
    for (Nonlinearity nonlinearity : {Nonlinearity::logcosh, Nonlinearity::pow3, Nonlinearity::gauss})
      for (bool symmetric : {true, false})
        EXPECT_LT(overlaps(k, true, true, {nonlinearity, symmetric}).back(), 0.75 * principal)
            << k << " components, " << static_cast<int>(nonlinearity) << symmetric;
  }
}

// The made face of graphs/face.kg.json, as it is decomposed there.
TEST(Faces, OfTheShippedGraphSeparateBetterIntoIndependentThanIntoPrincipalComponents) {
  FileStore files;
  Alone work;
  std::vector<std::shared_ptr<const Points>> clips;
  for (const char* name : {"brows", "jaw"}) {
    const MotionFile file =
        read_motion_file(fmt::format("{}/graphs/faces/{}.csv", source_folder(), name), {}, files, work);
    clips.push_back(std::make_shared<const Points>(*file.points()));
  }
  std::vector<bool> stable;
  for (const std::string& label : clips[0]->labels)
    stable.push_back(label == "Nose_Top" || label.starts_with("Eye_"));
  const ChannelSpace space = space_of_points(clips, Stabilise::rigid, stable);
  IcaParams params;
  params.components = 2;
  double worst_independent = 0, best_principal = 1;
  for (bool rotate : {true, false}) {
    params.rotate = rotate;
    const Components parts = components_of_points(space, clips, params, work);
    for (std::size_t emotion : {0, 1}) {
      const double found = overlap(parts, emotion, "Brow_*", "Chin_*,Lip_Lower");
      if (rotate)
        worst_independent = std::max(worst_independent, found);
      else
        best_principal = std::min(best_principal, found);
    }
  }
  EXPECT_LT(worst_independent, 0.5 * best_principal);
}

// Three and four components are too few to hold apart what moves in 95 % of the variance: with the head
// still, three ICA components are a jaw, a brow, and one in which a second jaw and a second brow movement are
// added up. With head motion left in ICA is still the better one choice for choice.
TEST(Faces, SeparateBetterChoiceForChoiceIntoThreeOrFour) {
  KINEGRAPH_NEEDS_MOCAP();
  for (int k : {3, 4}) {
    const auto independent = overlaps(k, true, false), principal = overlaps(k, false, false);
    for (std::size_t i = 0; i < independent.size(); ++i)
      EXPECT_LT(independent[i], 0.95 * principal[i]) << k << " components, emotion " << i;
  }
}

// On the mean over the choices, and in their worst, it is so for every number of components, nonlinearity and
// method, with the head's motion left in or taken out.
TEST(Faces, SeparateBetterOnTheMeanAndAtWorstInAllWays) {
  KINEGRAPH_NEEDS_MOCAP();
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0;
    for (double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  };
  for (bool still_head : {false, true})
    for (int k : {2, 3, 4, 5, 6, 8, 10}) {
      const auto principal = overlaps(k, false, still_head);
      for (Nonlinearity nonlinearity : {Nonlinearity::logcosh, Nonlinearity::pow3, Nonlinearity::gauss})
        for (bool symmetric : {true, false}) {
          const auto independent = overlaps(k, true, still_head, {nonlinearity, symmetric});
          EXPECT_LT(mean(independent), mean(principal))
              << k << " components, " << static_cast<int>(nonlinearity) << symmetric << still_head;
          EXPECT_LT(independent.back(), principal.back())
              << k << " components, " << static_cast<int>(nonlinearity) << symmetric << still_head;
        }
    }
}

// Root mean square over frames and the chosen markers of how far two clips are apart, metres.
double apart(const Points& a, const Points& b, bool (*chosen)(const std::string&)) {
  double sum = 0, count = 0;
  for (int i = 0; i < static_cast<int>(a.labels.size()); ++i) {
    if (!chosen(a.labels[static_cast<std::size_t>(i)])) continue;
    for (std::size_t t = 0; t < a.frames; ++t) {
      const double d = norm(a.track(i)[t] - b.track(i)[t]);
      sum += d * d, count += 1;
    }
  }
  return std::sqrt(sum / count);
}

TEST(Faces, MoveByTheComponentsOfBrowsAndOfJaw) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::string mask_file = testing::TempDir() + fmt::format("kinegraph_mask_{}.glb", ::getpid());
  {
    Alone work;
    const auto mask = std::make_shared<const Character>(face_mask(*brows()));
    std::ofstream(mask_file, std::ios::binary)
        << encode_motion_file(mask_file, "auto", {{"character", mask}}, {}, work).bytes;
  }
  const Exported files("tests/component_job/face.kg.json", "face", fmt::format("--var 'mask={}'", mask_file));
  std::filesystem::remove(mask_file);
  ASSERT_TRUE(files.ran());

  // Which components move the brows, which the jaw: the graph makes groups of u2 and u4, and of u1, u3 and
  // u5.
  const auto meaning = files.read<Metrics>("meaning.json");
  const auto gain = [&](int i, const char* region) {
    return -*meaning->find(fmt::format("u{}.d_region.{}", i, region))->value;
  };
  for (int brow : {2, 4}) EXPECT_GT(gain(brow, "brows"), 10 * gain(brow, "jaw")) << "u" << brow;
  for (int chin : {1, 3, 5}) EXPECT_GT(gain(chin, "jaw"), 10 * gain(chin, "brows")) << "u" << chin;
  // The largest of each region are among them.
  for (int i = 1; i <= 6; ++i) {
    EXPECT_LE(gain(i, "brows"), gain(2, "brows"));
    EXPECT_LE(gain(i, "jaw"), gain(1, "jaw"));
  }

  // Scaled: brows twice as far from their mean, the jaw where it was.
  const auto parts = files.read<Components>("components.json");
  const Points first = *brows(), second = *jaw();
  const auto raised = files.read<Points>("raised.trc");
  const double brows_moved = apart(*raised, first, is_brow), jaw_moved = apart(*raised, first, is_jaw);
  EXPECT_GT(brows_moved, 0.002);
  EXPECT_LT(jaw_moved, 0.25 * brows_moved);
  // By the formula: rigid motion apart, each brow marker goes |P A (e_2 u_2 + e_4 u_4)| farther.
  double expected = 0, count = 0;
  for (std::size_t i = 0; i < parts->space.labels.size(); ++i) {
    if (!is_brow(parts->space.labels[i])) continue;
    for (std::size_t t = 0; t < first.frames; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double d = parts->mixing(3 * i + c, 1) * parts->signals(1, t) +
                         parts->mixing(3 * i + c, 3) * parts->signals(3, t);
        expected += d * d;
      }
      count += 1;
    }
  }
  EXPECT_NEAR(brows_moved, std::sqrt(expected / count), 1e-6);

  // Shifted by two standard deviations: the mouth is open all the time.
  const auto agape = files.read<Points>("agape.trc");
  EXPECT_GT(apart(*agape, first, is_jaw), 0.01);
  EXPECT_LT(apart(*agape, first, is_brow), 0.1 * apart(*agape, first, is_jaw));
  int chin_label =
      static_cast<int>(std::find(first.labels.begin(), first.labels.end(), "Chin") - first.labels.begin());
  for (std::size_t t = 0; t < first.frames; t += 100)
    EXPECT_LT(agape->track(chin_label)[t].y, first.track(chin_label)[t].y - 0.008) << t;

  // Repeated: the jaw of frames 250 to 550 once more in 900 to 1200, nothing else.
  const auto again = files.read<Points>("again.trc");
  const auto down = [&](const Points& clip, std::size_t from, std::size_t to) {
    double lowest = 1e9;
    for (std::size_t t = from; t < to; ++t) lowest = std::min(lowest, clip.track(chin_label)[t].y);
    return lowest;
  };
  EXPECT_LT(down(*again, 900, 1200), down(second, 900, 1200) - 0.01);
  for (std::size_t t = 0; t < 880; ++t)
    ASSERT_LT(norm(again->track(chin_label)[t] - second.track(chin_label)[t]), 1e-4) << t;

  // Mixed by percentages: half of the jaw goes, half as much again of the brows comes.
  EXPECT_NEAR(apart(*files.read<Points>("mixed.trc"), first, is_brow), 0.5 * brows_moved, 0.1 * brows_moved);

  // Borrowed: the jaw's clip gets the brows of the other, and keeps its jaw.
  const auto borrowed = files.read<Points>("borrowed.trc");
  EXPECT_GT(apart(*borrowed, second, is_brow), 0.4 * brows_moved);
  EXPECT_LT(apart(*borrowed, second, is_jaw), 0.25 * apart(*borrowed, second, is_brow));

  // On the mesh: at the markers' vertices it goes where the markers go.
  const auto mesh = files.read<Character>("face.glb");
  ASSERT_EQ(mesh->parts.size(), 1u);
  // One for each marker and axis, or two where it moves both ways.
  ASSERT_GE(mesh->parts[0].morphs.size(), 3 * first.labels.size());
  ASSERT_LE(mesh->parts[0].morphs.size(), 6 * first.labels.size());
  const auto vertices = [&](std::size_t frame) {
    std::vector<double> weights(mesh->parts[0].morphs.size());
    for (const MorphTrack& track : mesh->morph_tracks)
      weights[static_cast<std::size_t>(track.target)] = track.weights[frame];
    return posed_vertices(*mesh, mesh->parts[0], rest_pose_of(*mesh->skeleton), weights);
  };
  const auto still = vertices(0);
  double farthest = 0;
  for (std::size_t t : {200u, 500u, 700u, 1100u}) {
    const auto now = vertices(t);
    for (int m = 0; m < static_cast<int>(first.labels.size()); ++m) {
      const Vec3 marker = borrowed->track(m)[0];
      std::size_t vertex = 0;
      for (std::size_t v = 1; v < still.size(); ++v)
        if (norm(still[v] - marker) < norm(still[vertex] - marker)) vertex = v;
      const Vec3 wanted = borrowed->track(m)[t] - marker, is = now[vertex] - still[vertex];
      farthest = std::max(farthest, norm(is - wanted));
    }
  }
  EXPECT_LT(farthest, 0.004) << "the mask's vertices lie up to some mm beside the markers";
}

}  // namespace
}  // namespace kinegraph
