#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "graph/diagnostic.h"
#include "nodes/files/c3d.h"
#include "nodes/files/points_units.h"

namespace kinegraph {

namespace {

constexpr std::size_t block = 512;
constexpr std::size_t most_bytes_of_label = 120;

// No more bytes than a label may have, and no character in halves.
std::string cut_label(const std::string& label) {
  std::size_t end = std::min(label.size(), most_bytes_of_label);
  while (end < label.size() && end > 0 && (static_cast<unsigned char>(label[end]) & 0xC0) == 0x80) --end;
  return label.substr(0, end);
}

// Little-endian, as Intel writes it.
class C3dOut {
 public:
  std::string bytes;
  void byte(int value) { bytes += static_cast<char>(value); }
  void word(std::size_t value) {
    byte(static_cast<int>(value & 0xFF));
    byte(static_cast<int>(value >> 8 & 0xFF));
  }
  void real(double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    word(bits & 0xFFFF);
    word(bits >> 16);
  }
  void pad_block() { bytes.resize((bytes.size() + block - 1) / block * block); }

  void group(int number, std::string_view name) {
    byte(static_cast<int>(name.size()));
    byte(-number);
    bytes += name;
    word(3);  // to the next entry: this word and an empty description
    byte(0);
  }
  // A parameter of group 1 whose data are `data`.
  void parameter(int number, std::string_view name, int type, std::vector<std::size_t> dimensions,
                 std::string_view data) {
    byte(static_cast<int>(name.size()));
    byte(number);
    bytes += name;
    word(2 + 2 + dimensions.size() + data.size() + 1);
    byte(type);
    byte(static_cast<int>(dimensions.size()));
    for (std::size_t size : dimensions) byte(static_cast<int>(size));
    bytes += data;
    byte(0);
  }
  void text(int number, std::string_view name, std::string_view value) {
    parameter(number, name, -1, {value.size()}, value);
  }
  void count(int number, std::string_view name, std::size_t value) {
    C3dOut data;
    data.word(value);
    parameter(number, name, 2, {}, data.bytes);
  }
  void long_count(int number, std::string_view name, std::size_t value) {
    C3dOut data;
    data.word(value & 0xFFFF);
    data.word(value >> 16);
    parameter(number, name, 2, {2}, data.bytes);
  }
  void number(int group_number, std::string_view name, double value) {
    C3dOut data;
    data.real(value);
    parameter(group_number, name, 4, {}, data.bytes);
  }
};

// Texts of one width, at most 255 a parameter: LABELS, LABELS2, …
void put_texts(C3dOut& out, std::string_view name, const std::vector<std::string>& all) {
  for (std::size_t first = 0, k = 1; first < all.size() || k == 1; first += 255, ++k) {
    const std::size_t count = std::min<std::size_t>(255, all.size() - first);
    std::size_t width = 1;
    for (std::size_t i = 0; i < count; ++i) width = std::max(width, cut_label(all[first + i]).size());
    std::string data;
    for (std::size_t i = 0; i < count; ++i) {
      std::string text = cut_label(all[first + i]);
      text.resize(width, ' ');
      data += text;
    }
    out.parameter(1, k == 1 ? std::string(name) : std::string(name) + std::to_string(k), -1, {width, count},
                  data);
  }
}

}  // namespace

std::string write_c3d(const Points& points, const WriteOptions& options, Work& work) {
  const LengthUnit unit = unit_to_write(points, options, true);
  if (points.labels.size() > 0xFFFF)
    throw Failure(error("too-many-points", "a C3D holds 65535 points at most"));
  for (const std::string& label : points.labels)
    if (label.size() > most_bytes_of_label)
      work.report(warning("label-cut", "a C3D's labels are cut off after 120 bytes, first of " + label));
  C3dOut section;
  section.byte(1);
  section.byte(0x50);
  section.byte(0);  // number of blocks, known below
  section.byte(84);
  section.group(1, "POINT");
  section.group(2, "TRIAL");
  section.count(1, "USED", points.labels.size());
  section.count(1, "FRAMES", std::min<std::size_t>(points.frames, 0xFFFF));
  const std::size_t start_at = section.bytes.size() + 2 + std::string_view("DATA_START").size() + 2 + 2;
  section.count(1, "DATA_START", 0);
  section.number(1, "SCALE", -1);
  section.number(1, "RATE", points.fps);
  section.text(1, "X_SCREEN", "+X");
  section.text(1, "Y_SCREEN", points.up == UpAxis::z ? "+Z" : "+Y");
  section.text(1, "UNITS", unit.name);
  put_texts(section, "LABELS", points.labels);
  if (points.frames > 0xFFFF) section.number(1, "LONG_FRAMES", static_cast<double>(points.frames));
  section.long_count(2, "ACTUAL_START_FIELD", 1);
  section.long_count(2, "ACTUAL_END_FIELD", points.frames);
  section.word(0);
  section.pad_block();
  const std::size_t blocks = section.bytes.size() / block, data_block = 2 + blocks;
  if (blocks > 255) throw Failure(error("too-many-points", "the labels don't fit a C3D's parameter section"));
  section.bytes[2] = static_cast<char>(blocks);
  section.bytes[start_at] = static_cast<char>(data_block & 0xFF);
  section.bytes[start_at + 1] = static_cast<char>(data_block >> 8);

  C3dOut out;
  out.byte(2);
  out.byte(0x50);
  out.word(points.labels.size());
  out.word(0);  // no analog data
  out.word(1);
  out.word(std::min<std::size_t>(points.frames, 0xFFFF));
  out.word(0);  // longest gap that was filled
  out.real(-1);
  out.word(data_block);
  out.word(0);
  out.real(points.fps);
  out.pad_block();
  out.bytes += section.bytes;
  for (std::size_t t = 0; t < points.frames; ++t) {
    if (t % 16 == 0) work.check();
    for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
      const bool missing = points.is_missing(label, t);
      const Vec3 place = missing ? Vec3{} : in_file(points.track(label)[t], unit, points.up);
      for (int axis = 0; axis < 3; ++axis) {
        if (!(std::fabs(place[axis]) <= std::numeric_limits<float>::max()))
          throw Failure(error("too-large", fmt::format("a C3D's numbers go to {:g}, here is {:g}",
                                                       std::numeric_limits<float>::max(), place[axis]))
                            .hinting("write a larger unit, or another format")
                            .at_joint(points.labels[label])
                            .at_frame(static_cast<std::int64_t>(t)));
        out.real(place[axis]);
      }
      out.real(missing ? -1 : 0);
    }
  }
  out.pad_block();
  return std::move(out.bytes);
}

}  // namespace kinegraph
