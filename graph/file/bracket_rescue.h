// Where brackets and quotes were meant to stand in a graph's text that has some of them too few or too many,
// so that what else is wrong with the file can be told as well. Never for anything but telling problems.
#pragma once
#include <string_view>
#include <vector>

#include "graph/file/loose_tokens.h"

namespace kinegraph {

struct Rescue {
  std::vector<Mend> mends;  // in the text's order, not overlapping
  std::vector<Slip> slips;  // what is told of them
  // Nothing says where a bracket was meant to stand, or the text ends too early: what seems to be missing may
  // stand elsewhere or have been lost.
  bool in_doubt = false;
};
// The evidence, in this order: strings that end where their line reads best (loose_tokens.h); a bracket of
// the other kind; where most of the file's brackets agree with their lines' indentation, that of the others;
// a node, or a part of a graph, that stands where only a node's parts can.
Rescue rescue_brackets(std::string_view text);

}  // namespace kinegraph
