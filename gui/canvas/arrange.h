// Puts nodes into columns from left to right along their links, with few crossings.
#pragma once
#include <QPointF>
#include <map>
#include <set>
#include <string>

#include "gui/canvas/graph_scene.h"

namespace kinegraph {

// New positions of `nodes` (of all, where it is empty). The arrangement keeps the top left of where they
// were.
std::map<std::string, QPointF> arranged(const GraphScene& scene, const std::set<std::string>& nodes);

}  // namespace kinegraph
