// One call to read any motion file and one to write it: what Load, Export and the commands info, convert,
// compare and picture stand on.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "graph/compute.h"
#include "graph/value.h"
#include "nodes/files/read_options.h"
#include "nodes/files/write_options.h"
#include "nodes/motion/motion.h"
#include "nodes/motion/points.h"

namespace kinegraph {

// A value and the port of Load or Export that it belongs to: motion, points, character, stats, components,
// warp, contacts or metrics.
struct FileContent {
  std::string port;
  ValuePtr value;
};

struct MotionFile {
  std::string format;                   // the key of the reader that took it
  std::vector<std::string> companions;  // further files that were read, absolute
  std::vector<FileContent> contents;
  const Value* find(std::string_view port) const;
  const Motion* motion() const;
  const Points* points() const;
  std::string ports() const;  // "motion", "motion and character", for messages
};

// Reads, converts to metres and Y up, cuts and resamples as `options` say. What a person should know is
// reported to `work`, without file names: warnings ("rest-frame", "duplicate-joint", …) and infos
// ("unit-found"). Throws Failure naming the file, with line and column where the format has them;
// "unknown-format", "no-reader" name what can be read.
MotionFile read_motion_file(const std::string& absolute_path, const ReadOptions& options, FileAccess& files,
                            Work& work);

// The files beside the named one that reading will need.
std::vector<std::string> companions_of(const std::string& absolute_path, const ReadOptions& options,
                                       FileAccess& files);

struct EncodedFile {
  std::string bytes;
  std::vector<std::pair<std::string, std::string>> companions;  // name beside the file, bytes
};
// Those of a file's contents that a format can hold, for a person who only wants another format: what is left
// out is told ("left-out"), and a motion becomes the points of its joints where the format knows none. All of
// them where nothing fits: encode_motion_file then says so.
std::vector<FileContent> contents_for(const std::string& path, const std::vector<FileContent>& contents,
                                      Work& work);

// What speaks against writing a file of these ports: "nothing-to-write", "several-inputs", "unknown-format",
// "no-writer", "wrong-content" naming what can hold them. `path` tells the format where it is "auto".
std::optional<Diagnostic> objection_to_writing(const std::string& path, std::string_view format,
                                               const std::vector<std::string>& ports);
// `path` names companions, too. Throws Failure with what objection_to_writing has to say.
EncodedFile encode_motion_file(const std::string& path, std::string_view format,
                               const std::vector<FileContent>& contents, const WriteOptions& options,
                               Work& work);

}  // namespace kinegraph
