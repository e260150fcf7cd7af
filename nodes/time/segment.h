// Cutting a motion where its behaviour changes [Barbič et al. 2004, §3.1, PCA], so that each piece has one
// style.
#pragma once
#include <cstddef>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct Piece {
  std::size_t start = 0, end = 0;  // half-open, frames
};

// Poses of one behaviour lie near a plane of few dimensions. From the start of a piece its first two seconds
// tell how many dimensions hold 95 % of their spread; as the piece grows, the squared distance of its poses
// to the best plane of that many dimensions grows steadily, and faster where something new begins. Cut where
// the growth over half a second exceeds its mean so far by 3 / sensitivity standard deviations, at the frame
// where it began to rise; then start afresh. Poses are the joints' rotation vectors about their means, the
// root's without its heading. Pieces are at least two seconds long and cover the motion; a motion of less
// than four seconds is one piece.
std::vector<Piece> behaviour_pieces(const Motion& motion, double sensitivity, Work& work);

// Frames [start, end) of a motion.
Motion piece_of(const Motion& motion, const Piece& piece);

}  // namespace kinegraph
