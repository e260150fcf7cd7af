// The human body in a skeleton: which joints are pelvis, spine, neck, head, arms and legs, whatever they are
// called.
#pragma once
#include <vector>

#include "nodes/motion/skeleton.h"

namespace kinegraph {

// -1: none.
struct Arm {
  int clavicle = -1, upper = -1, forearm = -1, hand = -1;
  bool left = true;
};

struct Body {
  int pelvis = -1;         // the joint that legs and spine hang on
  std::vector<int> spine;  // from above the pelvis to the one that the arms branch off from
  std::vector<int> neck;   // between that and the head
  int head = -1;
  std::vector<Arm> arms;  // left first
  std::vector<Leg> legs;  // left first
};

// By names, else by the shape of the rest pose. A body without arms or legs has none; one without both, or
// without anything to tell where it begins, has no pelvis.
Body find_body(const Skeleton& skeleton);

}  // namespace kinegraph
