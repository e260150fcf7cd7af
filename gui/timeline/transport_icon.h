// The signs on the buttons that move through time, drawn so that they fit any theme and size.
#pragma once
#include <QColor>
#include <QIcon>

namespace kinegraph {

enum class TransportIcon { start, back, play, pause, forward, end, loop, in, out };
// In one colour where the button can be pressed, in another where it can't.
QIcon transport_icon(TransportIcon icon, const QColor& color, const QColor& unusable, double pixel_ratio);

}  // namespace kinegraph
