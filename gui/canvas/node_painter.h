// Draws one node of the canvas, and the marks that ports, states and wires share.
#pragma once
#include <QPainter>

#include "gui/canvas/graph_scene.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/theme.h"

namespace kinegraph {

// A port's mark: shape and colour by type, filled where something is linked; `radius` in the painter's units.
void draw_port(QPainter& painter, QPointF at, double radius, Theme::Shape shape, const QColor& color,
               const QColor& hole, bool filled);

// The families have a colour each, a thin bar above the title, so that a graph's parts are told apart from
// afar. A node's own colour comes first.
QColor family_color(const Theme& theme, const SceneNode& node);

// "12 ms", "1.4 s"
QString shown_seconds(double seconds);
// "up to date", "failed"
QString shown_state(NodeStatus::State state);
QColor state_color(const Theme& theme, NodeStatus::State state);

// Draws the node with its top left at the painter's origin, at `zoom`. Its text stays legible at any zoom: a
// small node shows only its name, as large as fits. `status` may be null. `problem`: it has an error or a
// warning of its structure.
void draw_node(QPainter& painter, const SceneNode& node, const NodeStatus* status,
               std::optional<Severity> problem, const Theme& theme, double zoom);

}  // namespace kinegraph
