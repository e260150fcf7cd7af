#include "nodes/time/segment.h"

#include <gtest/gtest.h>

#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

Motion one_after_another(const std::vector<Motion>& motions) {
  std::size_t frames = 0;
  for (const Motion& motion : motions) frames += motion.frames();
  Motion all = motions[0].empty_like(frames);
  std::size_t base = 0;
  for (const Motion& motion : motions) {
    for (int j = 0; j < all.joints(); ++j) {
      for (std::size_t f = 0; f < motion.frames(); ++f) {
        all.rotation(j).set(base + f, motion.rotation(j)[f]);
        if (all.translates(j)) all.translation(j).set(base + f, motion.translation(j)[f]);
      }
    }
    base += motion.frames();
  }
  return all;
}

TEST(BehaviourPieces, CutsWhereTheGaitChanges) {
  Alone work;
  const Motion motion =
      one_after_another({gait("walk", 5, 60, 3), gait("sneak", 5, 60, 4), gait("run", 5, 60, 5)});
  const auto pieces = behaviour_pieces(motion, 1, work);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].start, 0u);
  EXPECT_NEAR(static_cast<double>(pieces[1].start), 300, 15);
  EXPECT_NEAR(static_cast<double>(pieces[2].start), 600, 15);
  EXPECT_EQ(pieces[2].end, 900u);
  EXPECT_EQ(pieces[0].end, pieces[1].start);
  EXPECT_EQ(pieces[1].end, pieces[2].start);
}

TEST(BehaviourPieces, LeavesOneGaitWhole) {
  Alone work;
  EXPECT_EQ(behaviour_pieces(gait("walk", 20), 1, work).size(), 1u);
  EXPECT_EQ(behaviour_pieces(turning(gait("walk", 20), 9), 1, work).size(), 1u)
      << "turning is no change of behaviour";
}

TEST(BehaviourPieces, AreOneWhereThereIsLittleOrNothing) {
  Alone work;
  const Motion walk = gait("walk", 1);
  for (std::size_t frames : {0, 1, 2, 500}) {
    const auto pieces = behaviour_pieces(walk.empty_like(frames), 1, work);
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].start, 0u);
    EXPECT_EQ(pieces[0].end, frames);
  }
}

TEST(PieceOf, HoldsTheMotionsFrames) {
  const Motion walk = with_sliding_joint(gait("walk", 1), 4);
  const Motion piece = piece_of(walk, {10, 25});
  ASSERT_EQ(piece.frames(), 15u);
  for (int j = 0; j < walk.joints(); ++j) {
    EXPECT_EQ(piece.rotation(j)[3], walk.rotation(j)[13]);
    EXPECT_EQ(piece.local_offset(j, 14), walk.local_offset(j, 24));
  }
}

}  // namespace
}  // namespace kinegraph
