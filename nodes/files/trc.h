// TRC, the text format of markers (Motion Analysis, OpenSim).
#pragma once
#include <string>
#include <string_view>

#include "graph/work.h"
#include "nodes/files/read_options.h"
#include "nodes/files/write_options.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// Any line ends; empty cells and NaN are missing. The rate is that of the Time column where DataRate differs
// from it ("rate-differs"). Throws Failure with line and column: "bad-header", "truncated", "bad-number",
// "too-few-values", "too-many-values", "unknown-unit".
Points read_trc(std::string_view text, const ReadOptions& options, Work& work);
// `name` stands in the first line. In the source's unit and up axis; a file can't tell that Z is up
// ("up-untold").
std::string write_trc(const Points& points, std::string_view name, const WriteOptions& options, Work& work);

}  // namespace kinegraph
