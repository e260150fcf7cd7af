// Choosing joints: comma-separated patterns `*`, `LeftArm`, `*Leg*`, `-Head`, `Spine>` (the joint and all
// below it), read left to right; a first `-` starts from all; case counts; `\` escapes , * > - \.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

// One flag a joint. An exact name without a joint throws Failure ("unknown-joint", naming the nearest) at
// `param`; a wildcard without one is a warning.
std::vector<bool> chosen_joints(std::string_view pattern, const Skeleton& skeleton, std::string_view param,
                                Work& work);

// Over any names; "name>" is refused where there is no tree. `special` names may stand in the pattern as well
// ("root").
std::vector<bool> chosen_names(std::string_view pattern, const std::vector<std::string>& names,
                               std::string_view param, Work& work);

// The value of a table of patterns for each joint: the most specific match wins: exact name, then most
// literal characters, then byte order. Index into `patterns`, or -1.
std::vector<int> most_specific(const std::vector<std::string>& patterns, const Skeleton& skeleton);

}  // namespace kinegraph
