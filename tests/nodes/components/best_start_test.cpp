#include "nodes/components/best_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/components/principal.h"
#include "tests/nodes/components/clips.h"

namespace kinegraph {
namespace {

// The least, over the components of one run, of how well another run has it too.
double agreement(const FastIcaRun& a, const FastIcaRun& b) {
  const Rows correlations = product(a.w, transposed(b.w));  // on whitened axes
  double least = 1;
  for (std::size_t i = 0; i < a.w.rows; ++i) {
    double nearest = 0;
    for (std::size_t j = 0; j < b.w.rows; ++j) nearest = std::max(nearest, std::fabs(correlations(i, j)));
    least = std::min(least, nearest);
  }
  return least;
}

// Clips of 4,657 frames in all, whitened.
Rows long_clips(std::size_t components) {
  Alone work;
  Clips clips;
  for (const char* name : {"17_10", "07_05", "16_31", "17_03", "02_04"})
    clips.push_back(real_clip(std::string("cmu/asfamc/") + name + ".amc"));
  const std::vector<bool> all(clips.front()->joints(), true);
  const ChannelSpace space = space_of_motions(Representation::points, clips, all, true, {}, work);
  std::size_t frames = 0, at = 0;
  for (const auto& clip : clips) frames += clip->frames();
  Rows x(space.channels(), frames);
  for (const auto& clip : clips) {
    const Rows part = channels_of(space, *clip, {}, work);
    for (std::size_t i = 0; i < x.rows; ++i) std::copy_n(part.row(i), part.columns, x.row(i) + at);
    at += part.columns;
  }
  return whiten(x, leading_components(x, work), components, work).z;
}

// The best of as many runs, each over all frames from the start.
FastIcaRun best_over_all_frames(const Rows& z, int starts, Work& work) {
  FastIcaRun best;
  for (int n = 0; n < starts; ++n) {
    FastIcaRun run = fast_ica(z, starting_rotation(z.rows, n, 0), {}, work);
    if (run.negentropy > best.negentropy) best = std::move(run);
  }
  return best;
}

TEST(BestStart, OfLongClipsIsAsGoodAsOverAllFramesFromTheStart) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  for (std::size_t components : {3, 5, 12}) {
    SCOPED_TRACE(std::to_string(components) + " components");
    const Rows z = long_clips(components);
    const FastIcaRun all = best_over_all_frames(z, 8, work);
    const BestStart found = best_of_starts(z, {}, 8, 0, work);
    EXPECT_TRUE(found.run.converged);
    EXPECT_LT(found.run.reached, 1e-4) << "over all frames";
    EXPECT_GE(found.run.negentropy, 0.995 * all.negentropy);
    EXPECT_GT(agreement(found.run, all), 0.99);
  }
}

TEST(BestStart, OfLongClipsIsTheSameForTheSameSeed) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Rows z = long_clips(5);
  for (std::uint64_t seed : {0, 3})
    EXPECT_EQ(best_of_starts(z, {}, 2, seed, work).run.w.data,
              best_of_starts(z, {}, 2, seed, work).run.w.data);
}

// Every 8th frame is like the last eighth: a search at equal distances would see only one pose.
TEST(BestStart, OfAClipThatRepeatsSeesAllOfIt) {
  Alone work;
  Rows x(2, 8192);
  for (std::size_t t = 0; t < x.columns; ++t) {
    const double a = t % 4 < 2 ? 1 : -1, b = t % 4 == 1 || t % 4 == 2 ? 1.5 : -0.5;
    x(0, t) = a + 0.3 * b;
    x(1, t) = b - 0.2 * a;
  }
  const Rows z = whiten(x, leading_components(x, work), 2, work).z;
  EXPECT_GT(agreement(best_of_starts(z, {}, 4, 0, work).run, best_over_all_frames(z, 4, work)), 0.999);
}

TEST(BestStart, TellsHowManyOfItsStartsAreDone) {
  struct Telling : Alone {
    void progress(double fraction) override { told.push_back(fraction); }
    std::vector<double> told;
  } work;
  Rows z(2, 600);
  for (std::size_t t = 0; t < z.columns; ++t) {
    z(0, t) = t % 7 < 3 ? 1 : -1;
    z(1, t) = t % 11 < 5 ? 1 : -1;
  }
  best_of_starts(z, {}, 5, 0, work);
  ASSERT_GE(work.told.size(), 5u);
  EXPECT_TRUE(std::is_sorted(work.told.begin(), work.told.begin() + 5));
  EXPECT_GT(work.told[0], 0);
  EXPECT_LE(work.told[4], 1);
}

}  // namespace
}  // namespace kinegraph
