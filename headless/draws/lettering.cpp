// Widths of DejaVu Sans, so that a layout is the same on a machine that lacks the font.
#include <array>
#include <cstddef>

#include "headless/draws/canvas.h"

namespace kinegraph {

namespace {

// Advance of the printable ASCII characters from space to ~, in thousandths of the size.
constexpr std::array<short, 95> regular = {
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
constexpr std::array<short, 95> heavy = {
    348, 456,  521, 838, 696, 1002, 872, 306, 457, 457, 523, 838, 380, 415,  380, 365, 696, 696,  696,
    696, 696,  696, 696, 696, 696,  696, 400, 400, 838, 838, 838, 580, 1000, 774, 762, 734, 830,  683,
    683, 821,  837, 372, 372, 775,  637, 995, 837, 850, 733, 850, 770, 720,  682, 812, 774, 1103, 771,
    724, 725,  457, 365, 457, 838,  500, 500, 675, 716, 593, 716, 678, 435,  716, 712, 343, 343,  665,
    343, 1042, 712, 687, 716, 716,  493, 595, 478, 712, 652, 924, 645, 652,  582, 712, 365, 712,  838};

bool continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

// The character that starts at `at`, and its width in thousandths.
struct Letter {
  std::size_t bytes;
  double width;
};
Letter letter_at(std::string_view text, std::size_t at, bool bold) {
  auto byte = static_cast<unsigned char>(text[at]);
  if (byte >= 32 && byte < 127) return {1, static_cast<double>((bold ? heavy : regular)[byte - 32])};
  std::size_t end = at + 1;
  while (end < text.size() && continues(text[end])) ++end;
  auto letter = text.substr(at, end - at);
  if (letter == "·") return {letter.size(), bold ? 380.0 : 318.0};
  if (letter == "°" || letter == "–") return {letter.size(), 500};
  if (letter == "²" || letter == "³") return {letter.size(), 420};
  if (letter == "…" || letter.size() >= 3) return {letter.size(), byte >= 0xE3 ? 1000.0 : 838.0};
  return {letter.size(), bold ? 740.0 : 650.0};
}

}  // namespace

double text_width(std::string_view utf8, double size, bool bold) {
  double width = 0;
  for (std::size_t at = 0; at < utf8.size();) {
    auto letter = letter_at(utf8, at, bold);
    width += letter.width;
    at += letter.bytes;
  }
  return width * size / 1000;
}

std::string fitted(std::string_view utf8, double size, double width, bool bold) {
  if (text_width(utf8, size, bold) <= width) return std::string(utf8);
  double room = width - size;
  std::size_t at = 0;
  double used = 0;
  while (at < utf8.size()) {
    auto letter = letter_at(utf8, at, bold);
    used += letter.width * size / 1000;
    if (used > room) break;
    at += letter.bytes;
  }
  return std::string(utf8.substr(0, at)) + "…";
}

}  // namespace kinegraph
