// What a screen reader finds on the canvas: each node a child with its name, type, state and links, the
// current one with the keyboard.
#pragma once
#include <QString>

class QAccessibleInterface;
class QObject;

namespace kinegraph {

class GraphCanvas;

// For QAccessible::installFactory(): null for all but a GraphCanvas.
QAccessibleInterface* canvas_accessible(const QString& key, QObject* object);
// To be called when another node is the current one.
void tell_of_current_node(GraphCanvas& canvas);

}  // namespace kinegraph
