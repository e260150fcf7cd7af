// How long a metre is in a picture.
#pragma once
#include "headless/draws/canvas.h"

namespace kinegraph {

// A bar of a round length that ends at `right`, `scale` points of the picture a metre; millimetres and
// centimetres where a metre would be far too long.
void draw_scale_bar(Canvas& canvas, double right, double y, double scale);

}  // namespace kinegraph
