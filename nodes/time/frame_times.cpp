#include "nodes/time/frame_times.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

FrameTimes frame_times(std::span<const std::uint32_t> path, std::size_t frames) {
  FrameTimes times;
  times.row.resize(frames);
  times.first_row.assign(frames, 0);
  times.row_count.assign(frames, 0);
  times.before.resize(frames);
  times.after.resize(frames);
  for (std::size_t r = 0; r < path.size(); ++r)
    if (times.row_count[path[r]]++ == 0) times.first_row[path[r]] = static_cast<std::uint32_t>(r);
  times.first_shown = path.front();
  times.last_shown = path.back();

  std::uint32_t shown = times.first_shown;
  for (std::size_t f = 0; f < frames; ++f) {
    if (times.row_count[f]) shown = static_cast<std::uint32_t>(f);
    times.before[f] = shown;
  }
  shown = times.last_shown;
  for (std::size_t f = frames; f-- > 0;) {
    if (times.row_count[f]) shown = static_cast<std::uint32_t>(f);
    times.after[f] = shown;
  }
  const auto centre = [&](std::size_t f) { return times.first_row[f] + 0.5 * (times.row_count[f] - 1.0); };
  for (std::size_t f = 0; f < frames; ++f) {
    if (f < times.first_shown)
      times.row[f] = 0;
    else if (f > times.last_shown)
      times.row[f] = static_cast<double>(path.size() - 1);
    else if (times.row_count[f])
      times.row[f] = centre(f);
    else
      times.row[f] =
          centre(times.before[f]) + times.part(f) * (centre(times.after[f]) - centre(times.before[f]));
  }
  return times;
}

double sampled(std::span<const double> rows, double time) {
  const auto low = static_cast<std::size_t>(std::floor(time));
  const double part = time - static_cast<double>(low);
  return part > 0 ? rows[low] + part * (rows[low + 1] - rows[low]) : rows[low];
}

std::vector<double> averaged(std::span<const double> rows, const FrameTimes& times, std::size_t first) {
  std::vector<double> values(times.frames());
  for (std::size_t f = 0; f < values.size(); ++f) {
    if (!times.row_count[f]) continue;
    const std::size_t end = times.first_row[f] + times.row_count[f];
    const std::size_t begin = std::min(std::max<std::size_t>(times.first_row[f], first), end - 1);
    double sum = 0;
    for (std::size_t r = begin; r < end; ++r) sum += rows[r];
    values[f] = sum / static_cast<double>(end - begin);
  }
  for (std::size_t f = 0; f < values.size(); ++f) {
    if (times.row_count[f]) continue;
    const double from = values[times.before[f]], to = values[times.after[f]];
    values[f] = times.left_off(f) ? from : from + times.part(f) * (to - from);
  }
  return values;
}

}  // namespace kinegraph
