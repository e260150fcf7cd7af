#include "nodes/files/read_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/diagnostic.h"

namespace kinegraph {

FrameWindow frames_to_keep(const ReadOptions& options, std::size_t frames) {
  auto refuse = [&](std::string what) {
    throw Failure(error("bad-range", std::move(what))
                      .hinting(fmt::format("the file has frames 0 to {}", frames == 0 ? 0 : frames - 1))
                      .at_param("range"));
  };
  const FrameRange& range = options.range;
  FrameWindow window{0, frames};
  if (range.start != 0 || range.end) {
    if (range.start < 0) refuse(fmt::format("a range can't start at {}", range.start));
    if (static_cast<std::size_t>(range.start) >= frames)
      refuse(fmt::format("the range starts at {}, the file has {} frames", range.start, frames));
    if (range.end && *range.end <= range.start)
      refuse(fmt::format("the range [{}, {}) is empty", range.start, *range.end));
    if (range.end && static_cast<std::size_t>(*range.end) > frames)
      refuse(fmt::format("the range ends at {}, the file has {} frames", *range.end, frames));
    window = {static_cast<std::size_t>(range.start),
              range.end ? static_cast<std::size_t>(*range.end) : frames};
  }
  if (options.drop_rest_frame && frames > 0) {
    window.first = std::max<std::size_t>(window.first, 1);
    if (window.first >= window.last)
      throw Failure(error("bad-range", "no frame is left once the rest frame 0 is dropped")
                        .hinting("Load's rest_frame keep, or a longer range")
                        .at_param("rest_frame"));
  }
  return window;
}

}  // namespace kinegraph
