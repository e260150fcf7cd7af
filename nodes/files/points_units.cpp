#include "nodes/files/points_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "nodes/files/decimal.h"
#include "nodes/files/text_place.h"
#include "nodes/files/up_axis.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/fill_gaps.h"

namespace kinegraph {

namespace {

Points cut(Points points, FrameWindow window) {
  if (window.first == 0 && window.last == points.frames) return points;
  Points out(points.labels, points.fps, window.last - window.first);
  out.links = points.links;
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label)
    for (std::size_t t = 0; t < out.frames; ++t)
      if (points.is_missing(label, window.first + t)) {
        out.set_missing(label, t);
      } else {
        out.track(label).set(t, points.track(label)[window.first + t]);
      }
  return out;
}

void report_long_gaps(const Points& points, std::size_t first_frame, Work& work) {
  if (points.missing.empty()) return;
  Gap longest{0, 0};
  std::string label_of_longest;
  std::size_t samples = 0;
  std::set<std::string> labels;
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label)
    for (const Gap& gap : gaps_of(points, label)) {
      samples += gap.last - gap.first;
      labels.insert(points.labels[label]);
      if (gap.last - gap.first > longest.last - longest.first) {
        longest = gap;
        label_of_longest = points.labels[label];
      }
    }
  work.report(
      warning("long-gap", fmt::format("{} samples of {} of {} points stay missing; the longest gap is {} in "
                                      "frames {} to {}",
                                      samples, labels.size(), points.labels.size(), label_of_longest,
                                      first_frame + longest.first, first_frame + longest.last - 1))
          .hinting("raise Load's max_gap, or choose a range without gaps; gaps at an end are never filled")
          .at_joint(label_of_longest)
          .at_frame(static_cast<std::int64_t>(longest.first)));
}

// `value` rounded to so many significant digits.
double rounded(double value, int digits) {
  double back = value;
  whole_number_text(fmt::format("{:.{}e}", value, digits - 1), back);
  return back;
}

}  // namespace

Points settled(Points in_file, const LengthUnit& unit, UpAxis up, const ReadOptions& options, Work& work) {
  const FrameWindow window = frames_to_keep(options, in_file.frames);
  Points points = cut(std::move(in_file), window);
  const LengthUnit used = unit_from_param(options.unit, unit);
  points.unit = used.metres;
  points.unit_name = used.name;
  points.up = options.up == "auto" ? up : options.up == "z" ? UpAxis::z : UpAxis::y;
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
    const auto track = points.track(label);
    for (std::size_t t = 0; t < points.frames; ++t)
      if (!points.is_missing(label, t)) track.set(t, used.metres * y_up(track[t], points.up));
  }
  if (const std::size_t filled = fill_gaps(points, static_cast<std::size_t>(options.max_gap)))
    work.report(info("gaps-filled", fmt::format("{} missing samples were filled by splines", filled)));
  report_long_gaps(points, window.first, work);
  return points;
}

LengthUnit named_unit(std::string_view name) {
  const std::string key = lower_case(trimmed(name));
  for (const LengthUnit& unit : known_units())
    if (unit.name == key) return unit;
  if (key == "meters" || key == "metres" || key == "meter" || key == "metre") return unit_of_metres(1);
  if (key == "millimeters" || key == "millimetres") return unit_of_metres(0.001);
  if (key == "centimeters" || key == "centimetres") return unit_of_metres(0.01);
  if (key == "inch" || key == "inches") return unit_of_metres(0.0254);
  return {0, ""};
}

LengthUnit unit_of_file(std::string_view name, const ReadOptions& options) {
  const LengthUnit unit = named_unit(name);
  if (unit.metres > 0 || names_a_unit(options.unit)) return unit;
  bool changed = false;
  throw Failure(error("unknown-unit", fmt::format("the file's unit \"{}\" is none that is known",
                                                  as_utf8(trimmed(name), changed)))
                    .hinting("tell it by Load's unit or convert's --unit")
                    .at_param("unit"));
}

LengthUnit unit_to_write(const Points& points, const WriteOptions& options, bool must_have_name) {
  const LengthUnit source = points.unit > 0 ? LengthUnit{points.unit, points.unit_name} : unit_of_metres(1);
  const LengthUnit unit = unit_from_param(options.unit, source);
  return must_have_name && named_unit(unit.name).metres <= 0 ? unit_of_metres(1) : unit;
}

Vec3 in_file(Vec3 metres, const LengthUnit& unit, UpAxis up) {
  return with_up(metres, up) / unit.metres;
}

double rate_of_times(std::span<const double> times, int decimals) {
  const double first = times.front();
  // A time stands for any that is rounded to it; two of them make a span.
  const double slack = power(10.0, -decimals) + 1e-13 * std::max(std::fabs(first), std::fabs(times.back()));
  auto farthest = [&](double step, std::size_t count) {
    double most = 0;
    for (std::size_t k = 0; k < count; ++k)
      most = std::max(most, std::fabs(times[k] - first - static_cast<double>(k) * step));
    return most;
  };
  // The last row may stand at the end of a longer recording, off the beat of the others.
  for (std::size_t count : {times.size(), times.size() - 1}) {
    if (count < 2 || !(times[count - 1] > first)) continue;
    const double rate = static_cast<double>(count - 1) / (times[count - 1] - first);
    for (int digits = 1; digits <= 16; ++digits)
      if (const double plain = rounded(rate, digits); plain > 0 && farthest(1 / plain, count) <= slack)
        return plain;
  }
  const double step = (times.back() - first) / static_cast<double>(times.size() - 1);
  return step > 0 && farthest(step, times.size()) <= 0.25 * step + slack ? 1 / step : 0;
}

void make_labels_unique(std::vector<std::string>& labels, Work& work) {
  constexpr std::size_t shown = 8;
  std::set<std::string> seen;
  std::map<std::string, int> last_number;
  std::string told;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string wanted = labels[i].empty() ? fmt::format("point{}", i + 1) : labels[i];
    std::string name = wanted;
    while (!seen.insert(name).second)
      name = fmt::format("{}_{}", wanted, ++last_number.try_emplace(wanted, 1).first->second);
    if (!labels[i].empty() && name != labels[i] && ++changed <= shown)
      told += fmt::format("{}{}", told.empty() ? "" : ", ", name);
    labels[i] = name;
  }
  if (changed > shown) told += fmt::format(" and {} more", changed - shown);
  if (changed > 0)
    work.report(warning("duplicate-label", "labels that came twice were made unique: " + told));
}

void fail_no_number(std::string_view text, std::string_view cell) {
  if (cell.find_first_not_of("0123456789+-.,eE") == std::string_view::npos &&
      cell.find(',') != std::string_view::npos)
    fail_at(text, cell.data(), "decimal-comma", shown(cell) + " holds a decimal comma",
            "write numbers with a point");
  fail_at(text, cell.data(), "bad-number", shown(cell) + " is no number");
}

}  // namespace kinegraph
