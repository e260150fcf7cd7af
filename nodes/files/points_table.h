// Points as a table: `frame,time,NAME.x,NAME.y,NAME.z,…`, a row a frame, seconds and metres, missing values
// empty.
#pragma once
#include <string>
#include <string_view>

#include "graph/work.h"
#include "nodes/files/read_options.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// Also tables of others: no frame or no time column (the rate is then options.rate), columns NAME_x, NAME x
// or NAME:x, `;` or tabs between the cells. Such a table's unit is unknown and taken as metres, with a
// warning ("unit-unknown") unless the options name it. Throws Failure with line and column: "bad-header",
// "bad-number", "too-few-values", "too-many-values", "bad-times".
Points read_points_table(std::string_view text, const ReadOptions& options, Work& work);
// Always metres and Y up; every number reads back exactly.
std::string write_points_table(const Points& points, Work& work);

}  // namespace kinegraph
