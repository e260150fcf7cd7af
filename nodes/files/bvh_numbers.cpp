#include "nodes/files/bvh_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "nodes/files/decimal.h"
#include "nodes/files/number_row.h"
#include "nodes/files/text_place.h"

namespace kinegraph {

namespace {

// Frames are read into a small block that stays in the cache, then laid out channel by channel.
constexpr std::size_t block_bytes = 64 << 10;
constexpr std::size_t most_frames_a_block = 64;

class Reader {
 public:
  Reader(std::string_view text, const char* from, std::size_t channels, Work& work)
      : text_(text),
        at_(from),
        end_(text.data() + text.size()),
        channels_(channels),
        work_(work),
        row_(channels) {}

  const char* at() const { return at_; }

  // One frame's numbers; false when the text ends before its first.
  bool read_frame(double* out) {
    if (!skip_empty_lines()) return false;
    if (const char* stop = row_.read(at_, end_, out)) {
      at_ = stop;
      return true;
    }
    const char* line = at_;
    std::size_t count = 0;
    for (;;) {
      std::size_t on_line = read_line(out, count, line);
      count += on_line;
      if (count == channels_) return true;
      if (!skip_empty_lines()) too_few(line, count);
    }
  }

  // Lines with something on them, from here on.
  std::size_t count_lines() {
    std::size_t count = 0;
    while (skip_empty_lines()) {
      ++count;
      while (at_ < end_ && !is_line_end(*at_)) ++at_;
    }
    return count;
  }

  bool skip_empty_lines() {
    while (at_ < end_ && (is_blank(*at_) || is_line_end(*at_) || *at_ == '\0' || *at_ == '\x1A')) ++at_;
    return at_ < end_;
  }

 private:
  // The numbers up to the line's end, after the `before` ones that lines since `frame_line` gave.
  std::size_t read_line(double* out, std::size_t before, const char* frame_line) {
    const char* const line = at_;
    const char* at = at_;
    std::size_t count = before;
    for (;;) {
      while (at < end_ && is_blank(*at)) ++at;
      if (at == end_ || is_line_end(*at)) break;
      if (count == channels_) {
        at_ = at;
        if (before > 0)
          too_few(frame_line, before);  // the line that fell short is the mistake, not the one after it
        too_many(line);
      }
      const char* stop = parse_decimal(at, end_, out[count]);
      if (!stop) bad_number(at);
      if (stop < end_ && !is_blank(*stop) && !is_line_end(*stop)) {
        if (*stop != '-') bad_number(at);
        glued(stop);
      }
      ++count;
      at = stop;
    }
    at_ = at;
    return count - before;
  }

  void glued(const char* at) {
    if (!glued_)
      work_.report(warning("glued-numbers", "numbers run together without a blank; split at the minus sign")
                       .in_file({}, place_in(text_, at)));
    glued_ = true;
  }

  [[noreturn]] void too_few(const char* line, std::size_t count) {
    at_ = line;
    while (at_ < end_ && !is_line_end(*at_)) ++at_;
    fail_at(text_, at_, "too-few-values", fmt::format("the line has {} of {} values", count, channels_),
            "the file is cut short or damaged there");
  }
  [[noreturn]] void too_many(const char* line) {
    const char* extra = at_;
    std::size_t count = channels_;
    for (const char* c = at_; c < end_ && !is_line_end(*c); ++c)
      count += !is_blank(*c) && (c == line || is_blank(c[-1]));
    fail_at(text_, extra, "too-many-values",
            fmt::format("the line has {} values, the channels are {}", count, channels_),
            "the CHANNELS of the hierarchy and the numbers don't fit together");
  }
  [[noreturn]] void bad_number(const char* at) {
    std::string word = word_at(text_, at);
    std::string lower = lower_case(word);
    double value = 0;
    const char* stop = parse_decimal(at, end_, value);
    if (stop && stop < end_ && *stop == ',')
      fail_at(text_, at, "decimal-comma", fmt::format("{} holds a decimal comma", word),
              "write numbers with a point");
    if (lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos ||
        lower.find('#') != std::string::npos)
      fail_at(text_, at, "not-finite", fmt::format("{} is not a finite number", word),
              "mend the program that wrote it, or the frame");
    fail_at(text_, at, "bad-number", fmt::format("{} is no number", word));
  }

  std::string_view text_;
  const char* at_;
  const char* end_;
  std::size_t channels_;
  Work& work_;
  bool glued_ = false;
  NumberRow row_;
};

// rows x columns, row after row -> column after column in `out`, whose columns are `stride` apart.
void transpose(const double* block, std::size_t rows, std::size_t columns, double* out, std::size_t stride) {
  constexpr std::size_t tile = 8;
  for (std::size_t c0 = 0; c0 < columns; c0 += tile)
    for (std::size_t c = c0; c < std::min(c0 + tile, columns); ++c) {
      double* column = out + c * stride;
      for (std::size_t r = 0; r < rows; ++r) column[r] = block[r * columns + c];
    }
}

}  // namespace

BvhNumbers read_bvh_numbers(std::string_view text, const char* from, std::size_t channels, std::size_t frames,
                            std::size_t first, std::size_t last, Work& work) {
  Reader reader(text, from, channels, work);
  const auto room = static_cast<std::size_t>(text.data() + text.size() - from);
  // Checked before memory is asked for: every value takes a byte at least.
  if (channels > 0 && frames > room / channels) {
    std::size_t lines = reader.count_lines();
    fail_at(text, reader.at(), "too-few-frames",
            fmt::format("{} frames are announced, {} lines of numbers are there", frames, lines),
            "the file is cut short; correct the number after Frames:");
  }
  if (channels == 0 && frames > room + 1)
    fail_at(text, from, "too-few-frames",
            fmt::format("{} frames are announced, and no joint has a channel", frames));

  BvhNumbers numbers;
  const std::size_t kept = last - first;
  numbers.series = std::make_shared<std::vector<double>>(kept * channels);
  const std::size_t rows =
      std::clamp<std::size_t>(block_bytes / 8 / std::max<std::size_t>(channels, 1), 8, most_frames_a_block);
  std::vector<double> block(rows * channels);
  for (std::size_t frame = 0; channels > 0 && frame < frames; frame += rows) {
    std::size_t count = std::min(rows, frames - frame);
    for (std::size_t r = 0; r < count; ++r)
      if (!reader.read_frame(block.data() + r * channels))
        fail_at(text, reader.at(), "too-few-frames",
                fmt::format("{} frames are announced, {} are there", frames, frame + r),
                "the file is cut short; correct the number after Frames:");
    if (frame == 0)
      numbers.first_frame.assign(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(channels));
    std::size_t from_row = frame < first ? std::min(first - frame, count) : 0;
    std::size_t to_row = std::min(count, last > frame ? last - frame : 0);
    if (from_row < to_row)
      transpose(block.data() + from_row * channels, to_row - from_row, channels,
                numbers.series->data() + (frame + from_row - first), kept);
    work.progress(static_cast<double>(frame + count) / static_cast<double>(frames));
  }
  if (channels > 0 && reader.skip_empty_lines()) {
    const char* more = reader.at();
    double value = 0;
    if (!parse_decimal(more, text.data() + text.size(), value))
      fail_at(text, more, "bad-number", fmt::format("{} after the last frame", word_at(text, more)));
    std::size_t lines = reader.count_lines();
    work.report(
        warning("more-frames",
                fmt::format("{} frames are announced, {} lines more are there and left out", frames, lines))
            .hinting("correct the number after Frames:")
            .in_file({}, place_in(text, more)));
  }
  return numbers;
}

}  // namespace kinegraph
