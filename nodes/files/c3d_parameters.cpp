#include "nodes/files/c3d_parameters.h"

#include <fmt/format.h>

#include <bit>

#include "graph/diagnostic.h"
#include "nodes/files/text_place.h"

namespace kinegraph {

namespace {

constexpr std::size_t block = 512;

[[noreturn]] void refuse(const char* code, std::string what) {
  throw Failure(error(code, std::move(what)).hinting("check whether the file is whole and a C3D"));
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return upper;
}

std::string plain_text(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  bool changed = false;
  return as_utf8(trimmed(text), changed);
}

C3dParameter read_parameter(const C3dBytes& bytes, std::size_t at) {
  C3dParameter parameter;
  parameter.type = static_cast<std::int8_t>(bytes.byte(at));
  const std::size_t dimensions = bytes.byte(at + 1);
  at += 2;
  std::size_t count = 1;
  for (std::size_t i = 0; i < dimensions; ++i) {
    parameter.dimensions.push_back(bytes.byte(at++));
    count *= parameter.dimensions.back();
    if (count > bytes.size()) refuse("truncated", "a parameter is longer than the file");
  }
  if (parameter.type == -1) {
    const std::size_t width = dimensions == 0 ? 1 : parameter.dimensions[0];
    const std::size_t texts = width == 0 ? 0 : count / width;
    for (std::size_t i = 0; i < texts; ++i)
      parameter.texts.push_back(plain_text(bytes.text(at + i * width, width)));
    return parameter;
  }
  for (std::size_t i = 0; i < count; ++i) switch (parameter.type) {
      case 1:
        parameter.numbers.push_back(static_cast<std::int8_t>(bytes.byte(at + i)));
        break;
      case 2:
        parameter.numbers.push_back(bytes.whole(at + 2 * i));
        break;
      case 4:
        parameter.numbers.push_back(bytes.real(at + 4 * i));
        break;
      default:
        refuse("bad-parameters", fmt::format("a parameter has the unknown type {}", parameter.type));
    }
  return parameter;
}

C3dHeader read_header(const C3dBytes& bytes) {
  C3dHeader header;
  header.points = bytes.word(2);
  header.analog_per_frame = bytes.word(4);
  header.first_frame = bytes.word(6);
  header.last_frame = bytes.word(8);
  header.scale = bytes.real(12);
  header.data_block = bytes.word(16);
  header.rate = bytes.real(20);
  return header;
}

}  // namespace

std::uint8_t C3dBytes::byte(std::size_t at) const {
  if (at >= bytes_.size()) refuse("truncated", "the file ends too early");
  return static_cast<std::uint8_t>(bytes_[at]);
}
std::uint16_t C3dBytes::word(std::size_t at) const {
  const unsigned a = byte(at), b = byte(at + 1);
  return static_cast<std::uint16_t>(processor_ == C3dProcessor::sgi ? a << 8 | b : b << 8 | a);
}
float C3dBytes::real(std::size_t at) const {
  const std::uint32_t first = word(at), second = word(at + 2);
  if (processor_ == C3dProcessor::sgi) return std::bit_cast<float>(first << 16 | second);
  if (processor_ == C3dProcessor::intel) return std::bit_cast<float>(second << 16 | first);
  // VAX F: the high word first, and an exponent that is two larger. Exponent 0 is zero.
  if ((first & 0x7F80) == 0) return 0;
  return std::bit_cast<float>(first << 16 | second) / 4;
}
std::string_view C3dBytes::text(std::size_t at, std::size_t length) const {
  if (at > bytes_.size() || length > bytes_.size() - at) refuse("truncated", "the file ends within a text");
  return bytes_.substr(at, length);
}

const C3dParameter* C3dFile::find(const std::string& name) const {
  auto found = parameters.find(name);
  return found == parameters.end() ? nullptr : &found->second;
}
double C3dFile::number(const std::string& name, double otherwise) const {
  const C3dParameter* parameter = find(name);
  return parameter && !parameter->numbers.empty() ? parameter->numbers.front() : otherwise;
}
std::string C3dFile::text(const std::string& name) const {
  const C3dParameter* parameter = find(name);
  return parameter && !parameter->texts.empty() ? parameter->texts.front() : "";
}

C3dFile read_c3d_head(std::string_view all) {
  if (all.size() < block || all[1] != 0x50) refuse("not-c3d", "the file doesn't begin as a C3D does");
  const std::size_t section = (static_cast<std::uint8_t>(all[0]) - std::size_t{1}) * block;
  if (all[0] == 0 || section + block > all.size()) refuse("truncated", "the file ends before its parameters");
  C3dFile file;
  const int processor = static_cast<std::uint8_t>(all[section + 3]);
  if (processor < 84 || processor > 86)
    refuse("not-c3d", fmt::format("the processor type is {}, not 84, 85 or 86", processor));
  file.processor = static_cast<C3dProcessor>(processor);
  const C3dBytes bytes(all, file.processor);
  file.header = read_header(bytes);
  file.after_parameters = static_cast<std::uint8_t>(all[0]) + std::size_t{bytes.byte(section + 2)};
  std::map<int, std::string> groups;
  struct Found {
    int group;
    std::string name;
    std::size_t at;
  };
  std::vector<Found> found;
  for (std::size_t at = section + 4;;) {
    // A locked entry has a negative length; a length of 0 or an offset of 0 ends the section.
    const int signed_length = static_cast<std::int8_t>(bytes.byte(at));
    const int group = static_cast<std::int8_t>(bytes.byte(at + 1));
    const std::size_t length = static_cast<std::size_t>(signed_length < 0 ? -signed_length : signed_length);
    if (length == 0 || group == 0) break;
    std::string name = upper_case(plain_text(bytes.text(at + 2, length)));
    const std::size_t offset_at = at + 2 + length;
    const std::size_t offset = bytes.word(offset_at);
    if (group < 0) {
      groups[-group] = name;
    } else {
      found.push_back({group, name, offset_at + 2});
    }
    if (offset == 0) break;
    if (offset < 2) refuse("bad-parameters", "a parameter points into itself");
    at = offset_at + offset;
    if (at + 2 > all.size()) break;
  }
  for (const Found& one : found)
    file.parameters.emplace(groups[one.group] + ':' + one.name, read_parameter(bytes, one.at));
  return file;
}

}  // namespace kinegraph
