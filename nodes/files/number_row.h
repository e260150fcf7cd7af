// A line of decimal numbers, read many bytes at a time.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kinegraph {

// Reads lines of `count` numbers with blanks between them. First the words of a line are marked by 64 bytes
// at once, so that no number waits for the one before it (Langdale & Lemire, Parsing Gigabytes of JSON per
// Second, 2019), then all their digits are put together side by side.
class NumberRow {
 public:
  explicit NumberRow(std::size_t count);

  // The numbers of the line that starts at `line`, which are parse_decimal's to the last bit; returns where
  // the last ends. Null where the line doesn't hold exactly `count` numbers or ends too near `end` to be read
  // in blocks: who wants to know what it holds reads it number by number.
  const char* read(const char* line, const char* end, double* out);

 private:
  std::size_t count_;
  // Scratch, a value a number: where it starts, ends, and has its point, in bytes from the line's start; the
  // digits before and after its point, a byte each; whether it is to be read on its own, and a list of those.
  std::vector<std::uint32_t> starts_, points_, ends_, odd_ones_;
  std::vector<std::uint64_t> whole_, part_;
  std::vector<std::uint8_t> odd_;
};

}  // namespace kinegraph
