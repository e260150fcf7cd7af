// Which nodes of a plan can't give anything, because one before them can't.
#pragma once
#include <map>
#include <set>
#include <string>

#include "graph/plan.h"

namespace kinegraph {

// Node -> the first node before it, by its ports and links, that failed or is of an unknown type; "" where
// what it needs is absent though nothing failed. A node inside a Graph is named as that Graph, but to its
// neighbours there. `failed`: names of nodes that failed, and maybe of some that they block.
std::map<std::string, std::string> blocked_part(const Plan& plan, const std::set<std::string>& failed);

}  // namespace kinegraph
