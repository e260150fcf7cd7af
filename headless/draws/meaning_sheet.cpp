// What components mean, as bars [Cao Fig. 2]: a column a component.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "headless/draws/sheets.h"
#include "headless/draws/theme.h"

namespace kinegraph {
namespace {

constexpr double step = 40;  // from bar to bar

struct Component {
  std::string name;  // "u1"
  const Metric* emotion = nullptr;
  const Metric* variance = nullptr;
  const Metric* cadence = nullptr;
  const Metric* segment = nullptr;  // where the cadence was measured; null: there is only one
  std::vector<const Metric*> regions, moves;
};

std::string rest_after(const std::string& name, std::string_view part) {
  return name.substr(name.find(part) + part.size());
}

std::vector<Component> components_in(const Metrics& metrics) {
  std::vector<Component> out;
  for (const Metric& metric : metrics.all) {
    const auto dot = metric.name.find('.');
    if (dot == std::string::npos || metric.name[0] != 'u') continue;
    const std::string name = metric.name.substr(0, dot), what = metric.name.substr(dot + 1);
    if (out.empty() || out.back().name != name) out.push_back({.name = name});
    if (what == "d_emotion") out.back().emotion = &metric;
    if (what == "variance") out.back().variance = &metric;
    if (what == "cadence") out.back().cadence = &metric;
    if (what == "cadence_segment") out.back().segment = &metric;
    if (what.starts_with("d_region.")) out.back().regions.push_back(&metric);
    if (what.starts_with("moves.")) out.back().moves.push_back(&metric);
  }
  return out;
}

// Three digits at most, no exponent: bars beside each other are read, not calculated with.
std::string number(double value) {
  const double size = std::fabs(value);
  auto text = fmt::format("{:.{}f}", value, size >= 9.95 ? 0 : size >= 0.95 ? 1 : 2);
  return text == "-0.00" ? "0.00" : text;
}

// A length's unit in which `most` metres is a number of ones to hundreds.
struct LengthShown {
  double times;
  const char* unit;
};
LengthShown length_for(double most) {
  return most >= 1 ? LengthShown{1, "m"} : most >= 0.02 ? LengthShown{100, "cm"} : LengthShown{1000, "mm"};
}

// Bars up from a line, and down from it for what is below zero, to a common scale.
// `times`: from the metrics' unit to the one that is written.
void draw_bars(Canvas& canvas, double x, double top, double height, const std::vector<const Metric*>& metrics,
               double low, double high, double times, Color color) {
  const double zero = top + height * high / (high - low);
  canvas.stroke(polyline({{x - 4, zero}, {x + step * static_cast<double>(metrics.size()) - step + 20, zero}}),
                {theme::faint, 1});
  for (const Metric* metric : metrics) {
    if (metric && metric->value) {
      const double end = zero - height * *metric->value / (high - low);
      canvas.fill(rectangle(x, std::min(zero, end), 16, std::max(1.0, std::fabs(end - zero)), 2), color);
      canvas.text({x + 8, end < zero ? end - 4 : end + 10}, number(times * *metric->value),
                  {.size = 8.5, .color = theme::muted, .anchor = Anchor::middle});
    }
    x += step;
  }
}

// The regions that the component does most for: those that gain at least two thirds of what the first gains.
std::string most_mended(const std::vector<const Metric*>& regions) {
  double most = 0;
  for (const Metric* region : regions)
    if (region->value) most = std::max(most, -*region->value);
  std::string text;
  for (const Metric* region : regions)
    if (region->value && most > 0 && -*region->value >= 2 * most / 3)
      text += (text.empty() ? "mostly " : " and ") + rest_after(region->name, "d_region.");
  return text;
}

}  // namespace

bool is_meaning(const Metrics& metrics) {
  return metrics.find("u1.d_emotion") && metrics.find("u1.variance");
}

Canvas draw_meaning(const Metrics& metrics, const std::string& title) {
  const auto components = components_in(metrics);
  const std::size_t regions = components.front().regions.size();
  const double column = std::max(172.0, step * static_cast<double>(regions) + 92);
  Canvas canvas(std::max(640.0, 2 * theme::margin + 28 + column * static_cast<double>(components.size())),
                100);
  const double height = 150, names = regions == 0 ? 50 : 86;  // below the bars
  double emotion = 1e-9, low = 0, high = 0;
  for (const Component& one : components) {
    if (one.emotion && one.emotion->value) emotion = std::max(emotion, *one.emotion->value);
    for (const Metric* region : one.regions) {
      if (!region->value) continue;
      low = std::min(low, *region->value);
      high = std::max(high, *region->value);
    }
  }
  if (!(high - low > 0)) low = -1e-9;
  const LengthShown shown = length_for(std::max(high, -low));
  const double y = theme::draw_title(
      canvas, title,
      regions == 0
          ? "emotion: how far the pair is apart, in standard deviations"
          : fmt::format(
                "emotion: how far the pair is apart, σ · regions: added error, {}; below the line it mends",
                shown.unit));
  const double top = y + 34;
  double x = theme::margin + 20;
  double bottom = top;
  for (const Component& one : components) {
    canvas.fill(rectangle(x - 14, y + 4, column - 10, height + names + 114, 4), theme::panel);
    canvas.text({x, y + 24}, one.name, {.size = 15, .color = theme::ink, .bold = true});
    draw_bars(canvas, x + 6, top + 8, height, {one.emotion}, 0, emotion, 1, theme::right);
    if (regions == 0)
      canvas.text({x - 4, top + height + 26}, "emotion", {.size = 9.5, .color = theme::muted});
    else
      canvas.text({x + 18, top + height + 30}, "emotion",
                  {.size = 9.5, .color = theme::muted, .anchor = Anchor::end, .turned = -50});
    double at = x + 54;
    if (regions > 0) draw_bars(canvas, at, top + 8, height, one.regions, low, high, shown.times, theme::left);
    for (const Metric* region : one.regions) {
      canvas.text({at + 12, top + height + 30}, fitted(rest_after(region->name, "d_region."), 9.5, 60),
                  {.size = 9.5, .color = theme::muted, .anchor = Anchor::end, .turned = -50});
      at += step;
    }
    double line = top + height + names;
    const auto say = [&](const std::string& text, Color color) {
      canvas.text({x - 4, line}, fitted(text, 9.5, column - 26), {.size = 9.5, .color = color});
      line += 13;
    };
    if (one.variance && one.variance->value)
      say(fmt::format("{:.1f} % of the variance", 100 * *one.variance->value), theme::ink);
    std::string beat =
        one.cadence && one.cadence->value ? fmt::format("{:.2f} Hz", *one.cadence->value) : "no steady beat";
    if (one.segment && one.segment->value) beat += fmt::format(" in segment {:g}", *one.segment->value);
    say(beat, theme::ink);
    if (const std::string mended = most_mended(one.regions); !mended.empty()) say(mended, theme::ink);
    for (const Metric* move : one.moves) {
      std::string much;
      if (move->value && move->unit == "m") {
        const LengthShown in = length_for(*move->value);
        much = number(in.times * *move->value) + " " + in.unit;
      } else if (move->value) {
        much = number(*move->value) + " " + move->unit;
      }
      say(rest_after(move->name, "moves.") + " " + much, theme::muted);
    }
    bottom = std::max(bottom, line);
    x += column;
  }
  canvas.set_height(std::max(bottom, y + height + names + 118) + 14);
  return canvas;
}

}  // namespace kinegraph
