#include "headless/draws/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "headless/draws/theme.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// The ten-power, doubled or quintupled where that fits better, that makes about `wanted` steps over `span`.
double round_step(double span, int wanted) {
  double raw = span / std::max(1, wanted);
  double power = 1;
  while (power > raw) power /= 10;
  while (power * 10 <= raw) power *= 10;
  for (double factor : {1.0, 2.0, 5.0})
    if (power * factor >= raw * 0.999) return power * factor;
  return power * 10;
}

struct Scale {
  double low, high, from, to;  // values, and their places on the page
  bool logarithmic;
  double operator()(double value) const {
    if (logarithmic)
      return from + (to - from) * (logarithm(value) - logarithm(low)) / (logarithm(high) - logarithm(low));
    return from + (to - from) * (value - low) / (high - low);
  }
};

Scale scale_of(const Axis& axis, bool vertical, const std::vector<Curve>& curves, double from, double to) {
  double low = 1e300, high = -1e300;
  for (const auto& curve : curves)
    for (double value : vertical ? curve.y : curve.x) {
      if (!std::isfinite(value) || (axis.logarithmic && value <= 0)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (low > high) low = axis.logarithmic ? 1 : 0, high = axis.logarithmic ? 10 : 1;
  if (axis.logarithmic)
    return {axis.low.value_or(low / 1.3), axis.high.value_or(std::max(high, 1.01 * low) * 1.3), from, to,
            true};
  if (vertical) {
    double pad = high > low ? 0.06 * (high - low) : std::max(1e-9, 0.1 * std::abs(high));
    if (high == low && high == 0) pad = 1;
    // A zero line that is near belongs in the picture.
    if (low >= 0 && low < 0.4 * high)
      low = pad = 0, high *= 1.06;
    else
      low -= pad, high += pad;
  }
  low = axis.low.value_or(low);
  high = axis.high.value_or(high);
  if (!(high > low)) high = low + 1;
  return {low, high, from, to, false};
}

std::string with_unit(const Axis& axis) {
  return axis.unit.empty() ? axis.label : axis.label + " (" + axis.unit + ")";
}

// At most some 1,500 points a curve: each column of the page keeps its least and its greatest value.
std::vector<std::vector<Spot>> pieces_of(const Curve& curve, const Scale& x, const Scale& y) {
  std::vector<std::vector<Spot>> pieces(1);
  std::size_t count = std::min(curve.x.size(), curve.y.size());
  std::size_t column = std::max<std::size_t>(1, count / 750);
  for (std::size_t at = 0; at < count; at += column) {
    std::size_t end = std::min(count, at + column);
    std::size_t low = at, high = at;
    bool gap = false;
    for (std::size_t i = at; i < end; ++i) {
      if (!std::isfinite(curve.y[i]) || (y.logarithmic && curve.y[i] <= 0)) {
        gap = true;
        continue;
      }
      if (!(curve.y[low] <= curve.y[i])) low = i;
      if (!(curve.y[high] >= curve.y[i])) high = i;
    }
    if (gap && column == 1) {
      if (!pieces.back().empty()) pieces.emplace_back();
      continue;
    }
    for (std::size_t i : {std::min(low, high), std::max(low, high)}) {
      if (!std::isfinite(curve.y[i])) continue;
      pieces.back().push_back({x(curve.x[i]), y(curve.y[i])});
      if (low == high) break;
    }
    if (column == 1) continue;
    if (end == count && high != count - 1 && low != count - 1 && std::isfinite(curve.y[count - 1]))
      pieces.back().push_back({x(curve.x[count - 1]), y(curve.y[count - 1])});
  }
  return pieces;
}

std::vector<double> ticks_of(const Scale& scale, const Axis& axis, int wanted) {
  if (!scale.logarithmic) return round_ticks(scale.low, scale.high, wanted, axis.whole);
  // Decades; with 2 and 5 between them where there are few.
  std::vector<double> ticks;
  bool narrow = scale.high < 1e3 * scale.low;
  for (int power = -300; power <= 300; ++power) {
    double decade = 1;
    for (int i = 0; i < std::abs(power); ++i) decade *= 10;
    if (power < 0) decade = 1 / decade;
    for (double factor : {1.0, 2.0, 5.0})
      if ((factor == 1 || narrow) && factor * decade >= scale.low && factor * decade <= scale.high)
        ticks.push_back(factor * decade);
  }
  std::size_t step = ticks.size() / 9 + 1;
  std::vector<double> kept;
  for (std::size_t i = 0; i < ticks.size(); i += step) kept.push_back(ticks[i]);
  return kept;
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int wanted, bool whole) {
  double step = round_step(high - low, wanted);
  if (whole) step = std::max(1.0, std::round(step));
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && ticks.size() < 100; k += 1)
    ticks.push_back(k == 0 ? 0 : k * step);
  return ticks;
}

std::string tick_text(double value, double step) {
  double size = std::abs(value);
  if (size > 0 && (size >= 1e6 || size < 1e-4)) return fmt::format("{:.3g}", value);
  int decimals = 0;
  for (double rest = step; decimals < 6 && std::abs(rest - std::round(rest)) > 1e-6 * rest; rest *= 10)
    ++decimals;
  return fmt::format("{:.{}f}", value, decimals);
}

void draw_chart(Canvas& canvas, const Frame& frame, const Chart& chart) {
  const double left = frame.x + 58, right = frame.x + frame.width - 8;
  const double top = frame.y + 28, bottom = frame.y + frame.height - 40;
  Scale x = scale_of(chart.x, false, chart.curves, left, right);
  Scale y = scale_of(chart.y, true, chart.curves, bottom, top);
  canvas.fill(rectangle(left, top, right - left, bottom - top), theme::panel);

  const Lettering tick_style{.size = 10, .color = theme::muted};
  auto y_ticks = ticks_of(y, chart.y, static_cast<int>((bottom - top) / 34));
  for (double tick : y_ticks) {
    bool zero = tick == 0 && y.low < 0;
    canvas.stroke(polyline({{left, y(tick)}, {right, y(tick)}}), {zero ? theme::faint : theme::hairline, 1});
    auto style = tick_style;
    style.anchor = Anchor::end;
    canvas.text({left - 7, y(tick) + 3.6}, tick_text(tick, y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1),
                style);
  }
  auto x_ticks = ticks_of(x, chart.x, static_cast<int>((right - left) / 80));
  for (double tick : x_ticks) {
    canvas.stroke(polyline({{x(tick), bottom}, {x(tick), bottom + 4}}), {theme::faint, 1});
    auto style = tick_style;
    style.anchor = Anchor::middle;
    canvas.text({x(tick), bottom + 16}, tick_text(tick, x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1),
                style);
  }
  canvas.stroke(polyline({{left, bottom}, {right, bottom}}), {theme::faint, 1});

  canvas.begin_clip(left - 4, top - 4, right - left + 8, bottom - top + 8);
  for (const auto& curve : chart.curves)
    for (const auto& piece : pieces_of(curve, x, y)) {
      if (piece.size() > 1) canvas.stroke(polyline(piece), {curve.color, curve.width, curve.dashes});
      if (curve.dots || piece.size() == 1)
        for (Spot spot : piece) canvas.fill(ellipse(spot, curve.width + 0.9, curve.width + 0.9), curve.color);
    }
  canvas.end();

  canvas.text({frame.x + 4, frame.y + 14}, chart.title, {.size = 12.5, .color = theme::ink, .bold = true});
  canvas.text({(left + right) / 2, bottom + 33}, with_unit(chart.x),
              {.size = 11, .color = theme::muted, .anchor = Anchor::middle});
  canvas.text({frame.x + 13, (top + bottom) / 2}, with_unit(chart.y),
              {.size = 11, .color = theme::muted, .anchor = Anchor::middle, .turned = -90});

  double width = 0;
  for (const auto& curve : chart.curves)
    if (!curve.name.empty()) width += 34 + text_width(curve.name, 11);
  double at = right - width;
  for (const auto& curve : chart.curves) {
    if (curve.name.empty()) continue;
    canvas.stroke(polyline({{at + 12, frame.y + 10}, {at + 28, frame.y + 10}}),
                  {curve.color, std::max(2.0, curve.width), curve.dashes});
    canvas.text({at + 34, frame.y + 14}, curve.name, {.size = 11, .color = theme::muted});
    at += 34 + text_width(curve.name, 11);
  }
}

void draw_time_axis(Canvas& canvas, double x0, double x1, double y, double seconds) {
  canvas.stroke(polyline({{x0, y}, {x1, y}}), {theme::faint, 1});
  auto ticks = round_ticks(0, seconds, static_cast<int>((x1 - x0) / 90));
  double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
  for (double tick : ticks) {
    double x = seconds > 0 ? x0 + (x1 - x0) * tick / seconds : x0;
    canvas.stroke(polyline({{x, y}, {x, y + 4}}), {theme::faint, 1});
    canvas.text({x, y + 16}, tick_text(tick, step),
                {.size = 10, .color = theme::muted, .anchor = Anchor::middle});
  }
  canvas.text({(x0 + x1) / 2, y + 31}, "time (s)",
              {.size = 11, .color = theme::muted, .anchor = Anchor::middle});
}

}  // namespace kinegraph
