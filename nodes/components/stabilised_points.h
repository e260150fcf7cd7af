// What is taken out of every frame of Points before they are decomposed, and put back later.
#pragma once
#include <string>
#include <vector>

#include "nodes/components/channels.h"

namespace kinegraph {

// How one frame was moved: x' = turn (x - centre).
struct Move {
  Quat turn;
  Vec3 centre;
};
std::vector<Move> moves_of(const ChannelSpace& space, const Points& points);

// The tracks of these labels. Throws Failure ("label-missing").
std::vector<int> labels_of(const std::vector<std::string>& wanted, const Points& points,
                           std::string_view clip = "the clip");
// Throws Failure ("gaps") naming the first of these tracks that has gaps, and its frames.
void check_whole(const Points& points, const std::vector<int>& labels, std::string_view clip = "the clip");

}  // namespace kinegraph
