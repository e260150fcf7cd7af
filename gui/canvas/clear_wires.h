// The second half of arranging: nodes move up and down in their columns until wires run past nodes and not
// behind them, seldom cross, and lead as straight as they can.
#pragma once
#include <QPointF>
#include <map>
#include <string>

#include "gui/canvas/graph_scene.h"

namespace kinegraph {

// `positions`: of the nodes that may move, free of overlaps, those of a column at the same x. Only heights
// change. Deterministic; stops after about a tenth of a second of work, and leaves graphs that are too large
// for that as they are.
std::map<std::string, QPointF> clear_wires(const GraphScene& scene, std::map<std::string, QPointF> positions);

// How far a line runs inside a box, in graph units.
double length_inside(const QPolygonF& line, const QRectF& box);

}  // namespace kinegraph
