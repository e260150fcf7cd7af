#include "nodes/files/motion_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "nodes/files/formats.h"
#include "nodes/files/text_place.h"
#include "nodes/motion/resample.h"

namespace kinegraph {

const Value* MotionFile::find(std::string_view port) const {
  for (const FileContent& content : contents)
    if (content.port == port) return content.value.get();
  return nullptr;
}
const Motion* MotionFile::motion() const {
  return dynamic_cast<const Motion*>(find("motion"));
}
const Points* MotionFile::points() const {
  return dynamic_cast<const Points*>(find("points"));
}
std::string MotionFile::ports() const {
  std::string text;
  for (const FileContent& content : contents) text += (text.empty() ? "" : " and ") + content.port;
  return text.empty() ? "nothing" : text;
}

namespace {

std::string list_of(const std::vector<std::string_view>& words) {
  std::string text;
  for (std::string_view word : words) text += fmt::format("{}{}", text.empty() ? "" : ", ", word);
  return text;
}

bool holds(const WriteFormat& format, std::string_view port) {
  return std::find(format.ports.begin(), format.ports.end(), port) != format.ports.end();
}

std::string readable() {
  std::vector<std::string_view> keys;
  for (const ReadFormat& format : read_formats()) keys.push_back(format.key);
  return "formats that can be read: " + list_of(keys);
}

std::string writable(const std::vector<std::string>& ports) {
  std::vector<std::string_view> keys;
  for (const WriteFormat& format : write_formats())
    if (format.write &&
        std::all_of(ports.begin(), ports.end(), [&](const std::string& port) { return holds(format, port); }))
      keys.push_back(format.key);
  return keys.empty() ? "no format can hold it" : "formats that can hold it: " + list_of(keys);
}

// What a file without a telling name is, by how it begins.
std::string format_of_bytes(std::string_view bytes) {
  std::string_view head = bytes.substr(0, 4096);
  if (bytes.size() > 512 && bytes[1] == 0x50 && bytes[0] > 0 && bytes[0] < 16) return "c3d";
  if (head.substr(0, 3) == "\xEF\xBB\xBF") head.remove_prefix(3);
  head = trimmed(head);
  const std::string start = lower_case(head.substr(0, 32));
  if (start.compare(0, 9, "hierarchy") == 0) return "bvh";
  if (start.compare(0, 4, "gltf") == 0) return "gltf";
  if (start.compare(0, 12, "pathfiletype") == 0) return "trc";
  if (start.compare(0, 18, "kaydara fbx binary") == 0) return "fbx";
  if (!start.empty() && start[0] == '{')
    return head.find("\"kinegraph-") == std::string_view::npos &&
                   head.find("\"asset\"") != std::string_view::npos
               ? "gltf"
               : "json";
  if (head.find(":FULLY-SPECIFIED") != std::string_view::npos ||
      head.find(":DEGREES") != std::string_view::npos)
    return "asf-amc";
  return {};
}

// What no reader can make anything of, whichever it is.
void refuse_outright(std::string_view bytes) {
  if (bytes.empty()) throw Failure(error("empty-file", "the file is empty"));
  const std::string_view start = bytes.substr(0, 2);
  if (start == "\xFF\xFE" || start == "\xFE\xFF")
    throw Failure(error("utf-16", "the file is text in UTF-16").hinting("save it as UTF-8"));
}

const ReadFormat* reader_of(const std::string& path, const ReadOptions& options, std::string_view bytes) {
  std::string key = options.format;
  if (key == "auto") key = read_format_of(path);
  if (key.empty()) key = format_of_bytes(bytes);
  for (const ReadFormat& format : read_formats())
    if (format.key == key) return &format;
  return nullptr;
}

const WriteFormat* writer_of(const std::string& path, std::string_view key) {
  const std::string wanted = key == "auto" ? write_format_of(path) : std::string(key);
  for (const WriteFormat& format : write_formats())
    if (format.key == wanted) return &format;
  return nullptr;
}

}  // namespace

std::vector<std::string> companions_of(const std::string& path, const ReadOptions& options,
                                       FileAccess& files) {
  if (path.empty()) return {};
  // By the name only: content is read, and hashed, once.
  const ReadFormat* format = reader_of(path, options, {});
  if (!format || !format->companions) return {};
  return format->companions(path, options, files);
}

MotionFile read_motion_file(const std::string& path, const ReadOptions& options, FileAccess& files,
                            Work& work) {
  const FileBytes bytes = files.read(path);
  const ReadFormat* format = nullptr;
  try {
    refuse_outright(*bytes);
    format = reader_of(path, options, *bytes);
    if (!format)
      throw Failure(error("unknown-format", "neither its name nor its content tells the file's format")
                        .hinting("name it by Load's format; " + readable())
                        .at_param("format"));
    MotionFile file = format->read({path, *bytes, options, files}, work);
    file.format = format->key;
    for (FileContent& content : file.contents) {
      if (options.fps <= 0) break;
      if (auto motion = std::dynamic_pointer_cast<const Motion>(content.value))
        content.value = std::make_shared<const Motion>(resampled(*motion, options.fps, work));
      if (auto points = std::dynamic_pointer_cast<const Points>(content.value))
        content.value = std::make_shared<const Points>(resampled(*points, options.fps, work));
    }
    return file;
  } catch (const Failure& failure) {
    Diagnostic problem = failure.diagnostic();
    const std::string begins = format_of_bytes(*bytes);
    if (format && !begins.empty() && begins != "json" && begins != format->key && problem.file.empty())
      problem.hint =
          fmt::format("the file begins as {} does: give it that ending, or name it by Load's format", begins);
    if (problem.file.empty()) problem.file = path;
    throw Failure(problem);
  }
}

std::vector<FileContent> contents_for(const std::string& path, const std::vector<FileContent>& contents,
                                      Work& work) {
  const WriteFormat* format = writer_of(path, "auto");
  if (!format) return contents;
  std::vector<FileContent> fit;
  std::string left;
  for (const FileContent& content : contents) {
    if (holds(*format, content.port)) {
      fit.push_back(content);
    } else {
      left += (left.empty() ? "" : " and ") + content.port;
    }
  }
  if (fit.empty() && holds(*format, "points"))
    for (const FileContent& content : contents)
      if (content.port == "motion") {
        fit.push_back({"points", points_of_motion(*content.value)});
        left = "what is not its joints' places";
      }
  if (fit.empty()) return contents;
  if (!left.empty())
    work.report(info("left-out", fmt::format("{} can't hold {}, which is left out", format->key, left)));
  return fit;
}

std::optional<Diagnostic> objection_to_writing(const std::string& path, std::string_view format,
                                               const std::vector<std::string>& ports) {
  if (ports.empty())
    return error("nothing-to-write", "no input is linked").hinting("link what is to be written");
  const auto linked = [&](std::string_view port) {
    return std::find(ports.begin(), ports.end(), port) != ports.end();
  };
  if (ports.size() > 1 && !(ports.size() == 2 && linked("motion") && linked("character")))
    return error("several-inputs", fmt::format("{} inputs are linked", ports.size()))
        .hinting("link exactly one, or a motion and a character; use one Export a file")
        .at_port(ports[1]);
  const WriteFormat* writer = writer_of(path, format);
  const std::string only_read = writer ? "" : read_format_of(path);
  if (!writer)
    return error("unknown-format", only_read.empty()
                                       ? "the file's ending tells no format"
                                       : fmt::format("{} files are read, not written", only_read))
        .hinting("give it another ending, or name one by Export's format; " + writable(ports))
        .at_param("file");
  for (const std::string& port : ports)
    if (!holds(*writer, port))
      return error("wrong-content", fmt::format("the format {} can't hold {}", writer->key, port))
          .hinting(writable(ports))
          .at_port(port);
  if (!writer->write)
    return error("no-writer", fmt::format("files of the format {} can't be written", writer->key))
        .hinting(writable(ports))
        .at_param("format");
  return {};
}

EncodedFile encode_motion_file(const std::string& path, std::string_view format,
                               const std::vector<FileContent>& contents, const WriteOptions& options,
                               Work& work) {
  std::vector<std::string> ports;
  for (const FileContent& content : contents) ports.push_back(content.port);
  if (const auto objection = objection_to_writing(path, format, ports)) throw Failure(*objection);
  return writer_of(path, format)->write({path, contents, options}, work);
}

}  // namespace kinegraph
