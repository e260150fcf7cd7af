#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/files/c3d.h"
#include "nodes/files/c3d_parameters.h"
#include "nodes/files/decimal.h"
#include "nodes/files/points_units.h"

namespace kinegraph {

namespace {

constexpr std::size_t block = 512;

// The plainest decimal that rounds to the same float32: 59.94, not 59.939998626…
double plain(double real) {
  double value = real;
  whole_number_text(fmt::format("{}", static_cast<float>(real)), value);
  return value;
}

double word_number(const C3dFile& file, const std::string& name, double otherwise) {
  const double value = file.number(name, otherwise);
  return value < 0 ? value + 65536 : value;  // counts use the sign bit
}

// Two words as a count of 32 bits.
double long_number(const C3dFile& file, const std::string& name) {
  const C3dParameter* parameter = file.find(name);
  if (!parameter || parameter->type != 2 || parameter->numbers.size() < 2) return 0;
  auto word = [&](std::size_t i) {
    return parameter->numbers[i] < 0 ? parameter->numbers[i] + 65536 : parameter->numbers[i];
  };
  return word(0) + 65536 * word(1);
}

struct Layout {
  std::size_t points = 0;
  bool reals = false;
  double scale = 1;
  std::size_t start = 0;  // byte of the first frame
  std::size_t frame_bytes = 0;
  std::size_t frames = 0;
};

std::size_t data_start(const C3dFile& file, std::size_t size, Work& work) {
  const double told = word_number(file, "POINT:DATA_START", static_cast<double>(file.header.data_block));
  auto usable = [&](double number) {
    return number >= static_cast<double>(file.after_parameters) && (number - 1) * block <= double(size);
  };
  if (usable(told)) return static_cast<std::size_t>(told - 1) * block;
  const bool header = usable(static_cast<double>(file.header.data_block));
  const std::size_t taken = header ? file.header.data_block : file.after_parameters;
  work.report(
      warning("data-start", fmt::format("POINT:DATA_START is {:g}; the data is read from block {}, {}", told,
                                        taken, header ? "as the header says" : "behind the parameters")));
  return (taken - 1) * block;
}

std::size_t frame_count(const C3dFile& file, std::size_t fit, Work& work) {
  std::vector<double> told;  // the surest first
  const double first = long_number(file, "TRIAL:ACTUAL_START_FIELD"),
               last = long_number(file, "TRIAL:ACTUAL_END_FIELD");
  if (first > 0 && last >= first) told.push_back(last - first + 1);
  if (const double frames = file.number("POINT:LONG_FRAMES", 0); frames > 0) told.push_back(frames);
  if (const double frames = word_number(file, "POINT:FRAMES", 0); frames > 0) told.push_back(frames);
  if (file.header.last_frame >= file.header.first_frame)
    told.push_back(static_cast<double>(file.header.last_frame - file.header.first_frame + 1));
  if (told.empty()) return 0;
  for (double frames : told) {
    if (frames > static_cast<double>(fit)) continue;
    if (frames != told.front())
      work.report(warning("frame-count", fmt::format("the file says {:g} frames and also {:g}; it holds "
                                                     "data for {}, and {:g} are taken",
                                                     told.front(), frames, fit, frames)));
    return static_cast<std::size_t>(frames);
  }
  throw Failure(
      error("truncated", fmt::format("the file says {:g} frames and holds data for {}", told.front(), fit))
          .hinting("check whether the file is whole"));
}

Layout layout_of(const C3dFile& file, std::size_t size, Work& work) {
  Layout layout;
  layout.points =
      static_cast<std::size_t>(word_number(file, "POINT:USED", static_cast<double>(file.header.points)));
  const double scale = file.number("POINT:SCALE", file.header.scale);
  layout.reals = scale < 0;
  layout.scale = std::fabs(scale);
  if (!std::isfinite(scale) || (scale == 0 && layout.points > 0))
    throw Failure(error("bad-parameters", fmt::format("POINT:SCALE is {:g}", scale)));
  const std::size_t width = layout.reals ? 4 : 2;
  layout.frame_bytes = width * (4 * layout.points + file.header.analog_per_frame);
  layout.start = data_start(file, size, work);
  const std::size_t left = layout.start < size ? size - layout.start : 0;
  layout.frames = layout.frame_bytes == 0 ? 0 : frame_count(file, left / layout.frame_bytes, work);
  return layout;
}

std::vector<std::string> labels_of(const C3dFile& file, std::size_t count, Work& work) {
  std::vector<std::string> labels;
  for (int k = 1; labels.size() < count; ++k) {  // LABELS holds 255 at most, LABELS2 goes on
    const C3dParameter* more = file.find(k == 1 ? "POINT:LABELS" : fmt::format("POINT:LABELS{}", k));
    if (!more) break;
    labels.insert(labels.end(), more->texts.begin(), more->texts.end());
  }
  labels.resize(count);
  make_labels_unique(labels, work);
  return labels;
}

UpAxis up_of(const C3dFile& file) {
  // The axes of the sheet on which a person would draw the markers: the one that points up.
  return file.text("POINT:Y_SCREEN").find_first_of("Zz") != std::string::npos ? UpAxis::z : UpAxis::y;
}

}  // namespace

Points read_c3d(std::string_view all, const ReadOptions& options, Work& work) {
  const C3dFile file = read_c3d_head(all);
  const C3dBytes bytes(all, file.processor);
  const Layout layout = layout_of(file, all.size(), work);
  const LengthUnit unit =
      layout.points == 0 ? unit_of_metres(1) : unit_of_file(file.text("POINT:UNITS"), options);
  double rate = file.number("POINT:RATE", file.header.rate);
  if (!(rate > 0)) rate = file.header.rate;
  if (!(rate > 0) || !std::isfinite(rate))
    throw Failure(error("bad-rate", fmt::format("the file's frame rate is {:g}", rate)));
  Points points(labels_of(file, layout.points, work), plain(rate), layout.frames);
  for (std::size_t t = 0; t < layout.frames; ++t) {
    if (t % 16 == 0) work.check();
    std::size_t at = layout.start + t * layout.frame_bytes;
    for (int label = 0; label < static_cast<int>(layout.points); ++label) {
      Vec3 place;
      bool missing = false;
      if (layout.reals) {
        place = {bytes.real(at), bytes.real(at + 4), bytes.real(at + 8)};
        missing = bytes.real(at + 12) < 0;
        at += 16;
      } else {
        place = layout.scale *
                Vec3{double(bytes.whole(at)), double(bytes.whole(at + 2)), double(bytes.whole(at + 4))};
        missing = bytes.whole(at + 6) < 0;
        at += 8;
      }
      if (missing || !std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z)) {
        points.set_missing(label, t);
      } else {
        points.track(label).set(t, place);
      }
    }
  }
  if (file.header.analog_per_frame > 0)
    work.report(
        info("analog-left-out", fmt::format("the file's analog data (force plates, muscles; {} values a "
                                            "frame) is not read",
                                            file.header.analog_per_frame)));
  return settled(std::move(points), unit, up_of(file), options, work);
}

}  // namespace kinegraph
