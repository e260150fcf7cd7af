#include "headless/metrics_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace kinegraph {

namespace {

std::string number_text(const Metric* metric) {
  if (!metric || !metric->value || !std::isfinite(*metric->value)) return "-";
  double size = std::abs(*metric->value);
  // Fixed point lets the eye compare columns; what is too small or too large for it has few digits anyway.
  if (size == 0) return "0";
  if (size < 1e-4 || size >= 1e6) return fmt::format("{:.1e}", *metric->value);
  int digits = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : size >= 1 ? 3 : 4;
  return fmt::format("{:.{}f}", *metric->value, digits);
}

bool of_one_joint(const Metrics& metrics, const std::string& name) {
  auto dot = name.find('.');
  return dot != std::string::npos && metrics.find(name.substr(0, dot));
}

}  // namespace

std::string metrics_table(const Terminal& terminal, const std::vector<std::string>& columns,
                          const std::vector<std::shared_ptr<const Metrics>>& values) {
  if (columns.empty()) return {};
  std::vector<const Metric*> rows;  // every name once, in the metrics' own order
  for (const auto& metrics : values)
    for (const auto& metric : metrics->all) {
      bool known =
          std::any_of(rows.begin(), rows.end(), [&](const Metric* row) { return row->name == metric.name; });
      if (!known && !of_one_joint(*metrics, metric.name)) rows.push_back(&metric);
    }
  std::size_t names = 0;
  for (const auto* row : rows) names = std::max(names, row->name.size());
  std::vector<std::size_t> widths;
  std::string head = fmt::format("{:<{}}", "", names);
  for (const auto& column : columns) {
    widths.push_back(std::max<std::size_t>(column.size(), 10));
    head += fmt::format("  {:>{}}", column, widths.back());
  }
  std::string text = terminal.tinted(head, Tint::bold) + "\n";
  for (const auto* row : rows) {
    text += fmt::format("{:<{}}", row->name, names);
    for (std::size_t i = 0; i < columns.size(); ++i)
      text += fmt::format("  {:>{}}", number_text(values[i]->find(row->name)), widths[i]);
    text += (row->unit.empty() ? "" : "  " + terminal.tinted(row->unit, Tint::faint)) + "\n";
  }
  return text;
}

std::vector<std::string> metrics_columns(const Plan& plan, const Outcome& outcome) {
  std::vector<int> depths(plan.nodes.size(), -1);  // links on the longest way from a source
  std::function<int(int)> depth = [&](int index) {
    int& known = depths[static_cast<std::size_t>(index)];
    if (known >= 0) return known;
    known = 0;
    for (const auto& [port, sources] : plan.nodes[static_cast<std::size_t>(index)].inputs)
      for (const auto& source : sources)
        if (source.node >= 0) known = std::max(known, depth(source.node) + 1);
    return known;
  };
  std::vector<std::pair<int, std::string>> found;
  for (const auto& [name, metrics] : outcome.metrics) {
    auto planned = plan.by_name.find(name);
    if (!metrics || planned == plan.by_name.end()) continue;
    if (plan.nodes[static_cast<std::size_t>(planned->second)].type_name == "Metrics")
      found.emplace_back(depth(planned->second), name);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> columns;
  for (auto& [at, name] : found) columns.push_back(std::move(name));
  return columns;
}

}  // namespace kinegraph
