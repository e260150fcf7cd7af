// The file formats, each a line in a table: its key, endings, and functions.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "nodes/files/motion_file.h"

namespace kinegraph {

struct FileToRead {
  const std::string& path;  // absolute
  std::string_view bytes;
  const ReadOptions& options;
  FileAccess& files;
};

struct ReadFormat {
  std::string_view key;  // of Load's `format`
  std::string_view help;
  std::vector<std::string_view> endings;  // lower case, without the dot
  MotionFile (*read)(const FileToRead&, Work&) = nullptr;
  std::vector<std::string> (*companions)(const std::string& path, const ReadOptions&, FileAccess&) = nullptr;
};
const std::vector<ReadFormat>& read_formats();

struct FileToWrite {
  const std::string& path;
  const std::vector<FileContent>& contents;
  const WriteOptions& options;
};

struct WriteFormat {
  std::string_view key;  // of Export's `format`
  std::string_view help;
  std::vector<std::string_view> endings;
  std::vector<std::string_view> ports;  // what it can hold
  EncodedFile (*write)(const FileToWrite&, Work&) = nullptr;
};
const std::vector<WriteFormat>& write_formats();

// The key of the format of that ending, or "" ("clip.BVH" is bvh).
std::string read_format_of(std::string_view path);
std::string write_format_of(std::string_view path);
// NodeType::resolve of Load and Export: `format` auto becomes what the ending of `file` says, where it says
// any.
void resolve_format(Json::Object& params, std::string (*format_of)(std::string_view path));
// The file that a .gltf's numbers go to, beside it: "walk.bin" of "/x/walk.gltf".
std::string gltf_buffer_name(std::string_view path);

}  // namespace kinegraph
