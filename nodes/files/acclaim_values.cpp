#include "nodes/files/acclaim_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "nodes/files/decimal.h"
#include "nodes/files/text_place.h"

namespace kinegraph {

namespace {

constexpr double largest_value = 1e9;

class Reader {
 public:
  Reader(std::string_view text, const AcclaimSkeleton& skeleton, Work& work)
      : text_(text), at_(text.data()), end_(at_ + text.size()), skeleton_(skeleton), work_(work) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
    for (std::size_t b = 0; b < skeleton.bones.size(); ++b) {
      index_[skeleton.bones[b].name] = b;
      first_value_.push_back(values_);
      values_ += skeleton.bones[b].dof.size();
    }
  }

  AcclaimValues read(const ReadOptions& options) {
    AcclaimValues out;
    out.degrees = read_header();
    const std::size_t frames = count_frames();
    const FrameWindow window = frames_to_keep(options, frames);
    out.first = window.first;
    out.frames = window.last - window.first;
    out.series.resize(out.frames * values_);
    constexpr std::size_t rows = 64;
    std::vector<double> block(rows * values_);
    for (std::size_t frame = 0; frame < frames; frame += rows) {
      const std::size_t count = std::min(rows, frames - frame);
      for (std::size_t r = 0; r < count; ++r) read_frame(frame + r, block.data() + r * values_);
      for (std::size_t r = 0; r < count; ++r) {
        if (frame + r < window.first || frame + r >= window.last) continue;
        double* column = out.series.data() + (frame + r - window.first);
        for (std::size_t v = 0; v < values_; ++v) column[v * out.frames] = block[r * values_ + v];
      }
      work_.progress(static_cast<double>(frame + count) / static_cast<double>(frames));
    }
    return out;
  }

 private:
  [[noreturn]] void fail(const char* at, const char* code, std::string message, std::string hint = {}) {
    fail_at(text_, at, code, std::move(message), std::move(hint));
  }

  const char* line_end(const char* at) const {
    while (at < end_ && !is_line_end(*at)) ++at;
    return at;
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  void skip_empty() {
    for (;;) {
      while (at_ < end_ && (is_blank(*at_) || is_line_end(*at_) || *at_ == '\0' || *at_ == '\x1A')) ++at_;
      if (at_ == end_ || *at_ != '#') return;
      at_ = line_end(at_);
    }
  }

  // The lines before the first frame's number; whether angles are in degrees.
  bool read_header() {
    bool degrees = skeleton_.degrees;
    for (skip_empty(); at_ < end_ && *at_ == ':'; skip_empty()) {
      const char* stop = line_end(at_);
      const std::string word = lower_case(trimmed({at_, static_cast<std::size_t>(stop - at_)}));
      if (word == ":degrees") degrees = true;
      if (word == ":radians") degrees = false;
      at_ = stop;
    }
    return degrees;
  }

  // Lines that begin with a digit, from here on.
  std::size_t count_frames() const {
    std::size_t frames = 0;
    for (const char* at = at_; at < end_;) {
      const char* word = skip_blanks(at, end_);
      frames += word < end_ && is_digit(*word);
      const void* next = std::memchr(at, '\n', static_cast<std::size_t>(end_ - at));
      if (!next) break;
      at = static_cast<const char*>(next) + 1;
    }
    return frames;
  }

  void read_frame(std::size_t frame, double* out) {
    skip_empty();
    if (at_ == end_ || !is_digit(*at_))
      fail(at_, "bad-frame-number", fmt::format("a frame's number expected, found {}", word_at(text_, at_)));
    double number = 0;
    const char* stop = parse_decimal(at_, end_, number);
    if (!stop || skip_blanks(stop, end_) != line_end(at_))
      fail(at_, "bad-frame-number", fmt::format("{} is no frame number", word_at(text_, at_)));
    if (frame > 0 && number != last_number_ + 1 && !skipped_) {
      skipped_ = true;
      work_.report(warning("skipped-frame-numbers",
                           fmt::format("frame {:.0f} follows frame {:.0f}; frames are taken as they come",
                                       number, last_number_))
                       .in_file({}, place_in(text_, at_)));
    }
    last_number_ = number;
    const char* frame_place = at_;
    at_ = stop;
    // Bones nearly always stand in one order: the one that came next in the last frame is tried first.
    if (order_.empty()) order_.assign(1, 0);
    seen_.assign(skeleton_.bones.size(), 0);
    std::size_t lines = 0;
    for (;; ++lines) {
      skip_empty();
      if (at_ == end_ || is_digit(*at_)) break;
      const std::size_t bone = bone_here(lines);
      if (seen_[bone])
        fail(at_, "duplicate-bone", fmt::format("{} stands twice in a frame", skeleton_.bones[bone].name));
      seen_[bone] = 1;
      at_ += skeleton_.bones[bone].name.size();
      read_values(bone, out + first_value_[bone]);
    }
    for (std::size_t b = 0; b < seen_.size(); ++b)
      if (!seen_[b] && !skeleton_.bones[b].dof.empty())
        fail(frame_place, "missing-bone",
             fmt::format("frame {:.0f} has no line for {}", number, skeleton_.bones[b].name),
             "the file is cut short or damaged, or the .asf is another's");
  }

  bool is_name_here(const std::string& name) const {
    return static_cast<std::size_t>(end_ - at_) >= name.size() &&
           std::memcmp(at_, name.data(), name.size()) == 0 &&
           (at_ + name.size() == end_ || is_blank(at_[name.size()]) || is_line_end(at_[name.size()]));
  }

  std::size_t bone_here(std::size_t line) {
    if (line < order_.size() && is_name_here(skeleton_.bones[order_[line]].name)) return order_[line];
    const char* stop = at_;
    while (stop < end_ && !is_blank(*stop) && !is_line_end(*stop)) ++stop;
    const std::string_view name(at_, static_cast<std::size_t>(stop - at_));
    auto found = index_.find(name);
    if (found == index_.end()) {
      std::vector<std::string> names;
      for (const auto& bone : skeleton_.bones) names.push_back(bone.name);
      const std::string near = nearest(name, names);
      fail(at_, "unknown-bone", fmt::format("the skeleton has no bone {}", word_at(text_, at_)),
           near.empty() ? "the .asf is another's" : "did you mean " + near + "?");
    }
    if (line >= order_.size()) order_.resize(line + 1, 0);
    order_[line] = found->second;
    return found->second;
  }

  void read_values(std::size_t bone, double* out) {
    const std::size_t count = skeleton_.bones[bone].dof.size();
    const char* at = at_;
    for (std::size_t i = 0;; ++i) {
      while (at < end_ && is_blank(*at)) ++at;
      if (at == end_ || is_line_end(*at)) {
        if (i < count)
          fail(at, "too-few-values",
               fmt::format("{} has {} of {} values", skeleton_.bones[bone].name, i, count));
        break;
      }
      if (i == count)
        fail(at, "too-many-values",
             fmt::format("{} has more than its {} values", skeleton_.bones[bone].name, count),
             "the .asf is another's");
      const char* stop = parse_decimal(at, end_, out[i]);
      if (!stop || (stop < end_ && !is_blank(*stop) && !is_line_end(*stop)) ||
          std::fabs(out[i]) > largest_value)
        bad_number(at, stop);
      at = stop;
    }
    at_ = at;
  }

  [[noreturn]] void bad_number(const char* at, const char* stop) {
    const std::string word = word_at(text_, at);
    const std::string lower = lower_case(word);
    if (stop && stop < end_ && *stop == ',')
      fail(at, "decimal-comma", fmt::format("{} holds a decimal comma", word), "write numbers with a point");
    if (lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos ||
        lower.find('#') != std::string::npos)
      fail(at, "not-finite", fmt::format("{} is not a finite number", word));
    fail(at, "bad-number", fmt::format("{} is no number", word));
  }

  std::string_view text_;
  const char* at_;
  const char* end_;
  const AcclaimSkeleton& skeleton_;
  Work& work_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<std::size_t> first_value_;
  std::size_t values_ = 0;
  std::vector<std::size_t> order_;
  std::vector<char> seen_;
  double last_number_ = 0;
  bool skipped_ = false;
};

}  // namespace

AcclaimValues read_amc_values(std::string_view text, const AcclaimSkeleton& skeleton,
                              const ReadOptions& options, Work& work) {
  return Reader(text, skeleton, work).read(options);
}

}  // namespace kinegraph
