// Putting in a component that other nodes have changed as a clip.
#pragma once
#include <string>
#include <vector>

#include "graph/work.h"
#include "nodes/components/component_edit.h"
#include "nodes/components/components.h"

namespace kinegraph {

// x_edited - x_i, D x frames: what the edited clip of `inputs` changes of these entries (from 0) with the
// signals `u` on the path of `base`. What ComponentMotion itself changes by making a clip of them, whole
// bones and a path, is no edit. A motion stands for components of motions; points for components of points,
// and for positions of motions. Throws Failure at the port `edited` and `param`: "no-input", "wrong-length"
// (other frames than u has), "wrong-kind".
Rows substitution(const Components& components, const ComponentSegment& base, const Rows& u,
                  const std::vector<std::size_t>& entries, const ComponentEditInputs& inputs,
                  const std::string& param, Work& work);

}  // namespace kinegraph
