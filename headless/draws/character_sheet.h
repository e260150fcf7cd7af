// A character without a skeleton's motion: as it stands at rest from four sides, or, where its own morph
// targets move it (as MarkerMesh makes them), several moments in a row.
#pragma once
#include <string>

#include "headless/draws/canvas.h"
#include "nodes/motion/character.h"

namespace kinegraph {

// `moments`: of a moving one, 0 = as many as look good.
Canvas draw_character(const Character& character, const std::string& title, int moments = 0);

// "2 meshes · 3,273 vertices · 4,672 triangles · 19 joints"
std::string facts_of(const Character& character);

}  // namespace kinegraph
