// Where each frame of a warped motion lies on the rows of its path.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace kinegraph {

struct FrameTimes {
  // The centre of the frame's run of rows; of a skipped frame linear between its shown neighbours'; of one
  // left off at an end the first or last row. In rows.
  std::vector<double> row;
  std::vector<std::uint32_t> first_row, row_count;  // the run; 0 rows: skipped or left off
  std::vector<std::uint32_t> before, after;  // the nearest shown frames (the frame itself where it is shown)
  std::uint32_t first_shown = 0, last_shown = 0;

  std::size_t frames() const { return row.size(); }
  bool left_off(std::size_t frame) const { return frame < first_shown || frame > last_shown; }
  bool skipped(std::size_t frame) const { return row_count[frame] == 0 && !left_off(frame); }
  // How far a skipped frame lies from `before` to `after`, in (0, 1).
  double part(std::size_t frame) const {
    return static_cast<double>(frame - before[frame]) / static_cast<double>(after[frame] - before[frame]);
  }
};
FrameTimes frame_times(std::span<const std::uint32_t> path, std::size_t frames);

// A series over rows at a time between them, linear.
double sampled(std::span<const double> rows, double time);
// A series over rows by frames: averaged over each run; linear between neighbours for skipped frames; of the
// nearest shown frame for those left off. `first`: the first row that counts (1 for differences, whose row 0
// only repeats row 1).
std::vector<double> averaged(std::span<const double> rows, const FrameTimes& times, std::size_t first);

}  // namespace kinegraph
