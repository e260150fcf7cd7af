// What all readers and writers of points share: units, up axis, frames to keep, gaps, rates of time columns.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "graph/work.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/read_options.h"
#include "nodes/files/write_options.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// Points as a file has them, in its own unit and axes, made into metres and Y up, cut to the range, with
// short gaps filled. `unit`, `up`: what the file says, or what its format means; the options stand above.
// Reports "gaps-filled" and, naming the longest, "long-gap".
Points settled(Points in_file, const LengthUnit& unit, UpAxis up, const ReadOptions& options, Work& work);

// The unit of that name ("mm ", "Meters"), or one with 0 metres when it is no name of a unit.
LengthUnit named_unit(std::string_view name);
// As above; throws Failure ("unknown-unit") unless the options name one.
LengthUnit unit_of_file(std::string_view name, const ReadOptions& options);

// The unit to write in: the option's, else the source's where `named` can tell it, else metres.
LengthUnit unit_to_write(const Points& points, const WriteOptions& options, bool must_have_name);
// Coordinates of the file, of metres and Y up.
Vec3 in_file(Vec3 metres, const LengthUnit& unit, UpAxis up);

// Frames a second of a column of times, the plainest rate that agrees with all of them as they are rounded;
// 0 when they don't rise evenly. Two times at least.
double rate_of_times(std::span<const double> times, int decimals);

// Labels made unique, empty ones named ("point7"); what was changed is warned about ("duplicate-label").
void make_labels_unique(std::vector<std::string>& labels, Work& work);

// A Failure about a cell of a table that is no number, at its place in `text`: "decimal-comma" or
// "bad-number".
[[noreturn]] void fail_no_number(std::string_view text, std::string_view cell);

}  // namespace kinegraph
