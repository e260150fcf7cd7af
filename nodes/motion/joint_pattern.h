// Choosing joints: comma-separated patterns `*`, `LeftArm`, `*Leg*`, `-Head`, `Spine>` (the joint and all
// below it), read left to right; a first `-` starts from all; case counts; `\` escapes , * > - \. Spaces
// around a pattern don't count. An empty text chooses nothing.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

// One flag a joint. An exact name without a joint throws Failure ("unknown-joint", naming the nearest) at
// `param`; a wildcard without one is a warning ("no-joint"). A `,,`, a `>` inside a name or a stray `\`
// throws "bad-pattern".
std::vector<bool> chosen_joints(std::string_view pattern, const Skeleton& skeleton, std::string_view param,
                                Work& work);

// Over any names, of which several may stand for special things ("root"); a `>` is refused, as there is no
// tree.
std::vector<bool> chosen_names(std::string_view pattern, const std::vector<std::string>& names,
                               std::string_view param, Work& work);

// Throws "bad-pattern" for a text that is no pattern, whatever the skeleton: for Param::checked_by.
void check_pattern(std::string_view pattern);

// The value of a table of patterns for each joint: the most specific match wins: exact name, then most
// literal characters, then byte order. Index into `patterns`, or -1. A key without a joint is told as above.
std::vector<int> most_specific(const std::vector<std::string>& patterns, const Skeleton& skeleton,
                               std::string_view param, Work& work);

}  // namespace kinegraph
