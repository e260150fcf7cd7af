// A C3D file's numbers in the three processors' spellings, its header and its parameter section.
// Source: the C3D file format user guide (c3d.org).
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kinegraph {

enum class C3dProcessor : std::uint8_t { intel = 84, dec = 85, sgi = 86 };

// Reads numbers at byte positions; throws Failure ("truncated") past the end.
class C3dBytes {
 public:
  C3dBytes(std::string_view bytes, C3dProcessor processor) : bytes_(bytes), processor_(processor) {}
  std::size_t size() const { return bytes_.size(); }
  std::uint8_t byte(std::size_t at) const;
  std::uint16_t word(std::size_t at) const;
  std::int16_t whole(std::size_t at) const { return static_cast<std::int16_t>(word(at)); }
  float real(std::size_t at) const;
  std::string_view text(std::size_t at, std::size_t length) const;

 private:
  std::string_view bytes_;
  C3dProcessor processor_;
};

struct C3dParameter {
  int type = 0;  // -1 characters, 1 bytes, 2 words, 4 reals
  std::vector<std::size_t> dimensions;
  std::vector<double> numbers;     // of types 1, 2, 4
  std::vector<std::string> texts;  // of type -1: one a last dimension, trimmed
};

struct C3dHeader {
  std::size_t points = 0, analog_per_frame = 0;
  std::size_t first_frame = 1, last_frame = 0;
  double scale = 0;  // negative: coordinates are reals
  std::size_t data_block = 0;
  double rate = 0;
};

struct C3dFile {
  C3dProcessor processor = C3dProcessor::intel;
  C3dHeader header;
  std::map<std::string, C3dParameter> parameters;  // "POINT:USED", upper case
  std::size_t after_parameters = 0;                // the first block behind them, from 1

  const C3dParameter* find(const std::string& name) const;
  double number(const std::string& name, double otherwise) const;
  std::string text(const std::string& name) const;  // "" where there is none
};
// Throws Failure ("not-c3d", "truncated", "bad-parameters").
C3dFile read_c3d_head(std::string_view bytes);

}  // namespace kinegraph
