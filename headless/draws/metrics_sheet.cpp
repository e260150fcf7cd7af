#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "headless/draws/sheets.h"
#include "headless/draws/theme.h"

namespace kinegraph {

namespace {

// "m/s2" as a reader writes it.
std::string unit_text(std::string unit) {
  if (unit == "deg") return "°";
  if (unit.ends_with("2")) unit.replace(unit.size() - 1, 1, "²");
  if (unit.ends_with("3")) unit.replace(unit.size() - 1, 1, "³");
  return unit.empty() ? unit : " " + unit;
}

std::string number_text(const Metric& metric, int digits) {
  if (!metric.value) return "not measured";
  double value = *metric.value;
  std::string number = std::abs(value) >= 1000 && std::abs(value) < 1e6
                           ? fmt::format("{:.0f}", value)
                           : fmt::format("{:.{}g}", value, digits);
  return number + unit_text(metric.unit);
}

struct Group {
  std::string name;
  std::vector<const Metric*> joints;
};

}  // namespace

Canvas draw_metrics(const Metrics& metrics, const std::string& title) {
  std::vector<const Metric*> overall;
  std::vector<Group> groups;
  std::size_t missing = 0;
  for (const auto& metric : metrics.all) {
    auto dot = metric.name.find('.');
    // "skate.LeftFoot" belongs to "skate"; "u1.d_emotion" has no metric of its own name above it and stands
    // by itself.
    if (dot != std::string::npos && metrics.find(metric.name.substr(0, dot))) {
      auto name = metric.name.substr(0, dot);
      if (groups.empty() || groups.back().name != name) groups.push_back({name, {}});
      groups.back().joints.push_back(&metric);
      continue;
    }
    overall.push_back(&metric);
    missing += metric.value ? 0 : 1;
  }
  // Bars of nothing, or of zeros alone, would only push the others down.
  for (auto& group : groups) std::erase_if(group.joints, [](const Metric* metric) { return !metric->value; });
  std::erase_if(groups, [](const Group& group) {
    return std::all_of(group.joints.begin(), group.joints.end(),
                       [](const Metric* m) { return *m->value == 0; });
  });

  Canvas canvas(1080, 100);
  double y = theme::draw_title(
      canvas, title,
      fmt::format("{} metrics{}", overall.size(), missing ? fmt::format(" · {} not measured", missing) : ""));
  const double left = theme::margin, row = 21;
  const double table = groups.empty() ? canvas.width() - 2 * theme::margin : 330;
  double at = y + 4;
  for (std::size_t i = 0; i < overall.size(); ++i) {
    if (i % 2 == 0) canvas.fill(rectangle(left, at, table, row, 3), theme::panel);
    canvas.text({left + 10, at + 14.5}, overall[i]->name, {.size = 11.5, .color = theme::ink});
    canvas.text(
        {left + table - 10, at + 14.5}, number_text(*overall[i], 4),
        {.size = 11.5, .color = overall[i]->value ? theme::ink : theme::faint, .anchor = Anchor::end});
    at += row;
  }
  double lowest = at;

  // Bars, packed into two columns.
  const double columns_x = left + table + 30, gap = 26;
  const double column = (canvas.width() - theme::margin - columns_x - gap) / 2;
  double tops[2] = {y + 4, y + 4};
  for (const auto& group : groups) {
    int side = tops[1] < tops[0] ? 1 : 0;
    double x = columns_x + side * (column + gap), top = tops[side];
    double largest = 0;
    for (const Metric* metric : group.joints) largest = std::max(largest, std::abs(*metric->value));
    auto shown = group.joints;
    std::stable_sort(shown.begin(), shown.end(), [](const Metric* a, const Metric* b) {
      return std::abs(*a->value) > std::abs(*b->value);
    });
    const std::size_t most = 12;
    std::size_t hidden = shown.size() > most ? shown.size() - most : 0;
    shown.resize(shown.size() - hidden);
    canvas.text({x, top + 12}, group.name + " by joint", {.size = 12, .color = theme::ink, .bold = true});
    if (hidden)
      canvas.text({x + column, top + 12}, fmt::format("{} of {}", most, most + hidden),
                  {.size = 10, .color = theme::faint, .anchor = Anchor::end});
    top += 20;
    for (const Metric* metric : shown) {
      auto joint = metric->name.substr(group.name.size() + 1);
      double names = 110, numbers = 72, bars = column - names - numbers;
      canvas.text({x + names - 8, top + 10.5}, fitted(joint, 10, names - 10),
                  {.size = 10, .color = theme::ink, .anchor = Anchor::end});
      if (largest > 0)
        canvas.fill(
            rectangle(x + names, top + 2, std::max(1.0, bars * std::abs(*metric->value) / largest), 10, 3),
            mixed(theme::left, theme::paper, 0.15));
      canvas.text({x + column, top + 10.5}, number_text(*metric, 3),
                  {.size = 10, .color = theme::muted, .anchor = Anchor::end});
      top += 15;
    }
    tops[side] = top + 14;
    lowest = std::max(lowest, top);
  }
  canvas.set_height(lowest + 20);
  return canvas;
}

}  // namespace kinegraph
