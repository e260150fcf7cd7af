// What Load lets a person say about a motion file.
#pragma once
#include <cstdint>
#include <string>

#include "graph/json.h"
#include "graph/param.h"

namespace kinegraph {

struct ReadOptions {
  std::string format = "auto";   // a key of file_formats()
  std::string skeleton;          // absolute path of the .asf of an .amc; "" = found beside it
  std::string clip;              // of a glTF: a name, else an index from 0
  FrameRange range;              // the file's frames
  double rate = 120;             // frames per second of a file that doesn't say
  double fps = 0;                // resampled to; 0 = as is
  bool drop_rest_frame = false;  // leaves out the file's frame 0
  Json unit = "auto";            // "auto", a key of known_units, or metres
  std::string up = "auto";       // auto, y, z
  std::int64_t max_gap = 10;     // frames of missing markers that are filled
};

struct FrameWindow {
  std::size_t first = 0, last = 0;  // half-open, of the file's frames
};
// The frames to keep of a file with `frames` of them. Throws Failure ("bad-range") at `range`.
FrameWindow frames_to_keep(const ReadOptions& options, std::size_t frames);

}  // namespace kinegraph
