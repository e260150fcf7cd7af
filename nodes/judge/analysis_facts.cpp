#include "nodes/judge/analysis_facts.h"

#include <fmt/format.h>

#include <algorithm>

#include "nodes/components/component_meaning.h"
#include "nodes/components/components.h"
#include "nodes/motion/metrics.h"

namespace kinegraph {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

std::string listed(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

std::string caption(const Components& components, std::size_t entry, const std::optional<Cadence>& cadence) {
  std::string text = fmt::format("{:.1f} % of the variance", 100 * components.shares[entry]);
  if (cadence) text += ", " + text_of(*cadence, components);
  if (const std::string what = what_moves(components, entry); !what.empty()) text += ", moves " + what;
  if (!components.unique[entry]) text += "; not unique";
  return text;
}

Lines lines_of(const Components& components) {
  Lines out;
  double explained = 0;
  for (double share : components.shares) explained += share;
  out.emplace_back("components", fmt::format("{} {} of {}, {:.1f} % of the variance", components.count(),
                                             components.method == "pca" ? "principal" : "independent",
                                             name_of(components.space.representation), 100 * explained));
  const auto cadences = cadences_of(components);
  for (std::size_t i = 0; i < components.count(); ++i)
    out.emplace_back(fmt::format("u{}", i + 1), caption(components, i, cadences[i]));
  if (components.method != "pca")
    out.emplace_back(
        "found by",
        fmt::format("{}, {}, {} in {} rounds (change {:.1g}, wanted {:.1g})", components.nonlinearity,
                    components.method, components.converged ? "settled" : "not settled",
                    components.iterations, components.reached, components.tolerance));
  for (std::size_t s = 0; s < components.segments.size(); ++s) {
    const std::size_t frames = components.segments[s].frames();
    out.emplace_back(fmt::format("segment {}", s),
                     fmt::format("{} frames at {:.6g} a second, {:.3g} s", frames, components.fps,
                                 static_cast<double>(frames) / components.fps));
  }
  out.emplace_back(components.space.of_motions ? "joints" : "points",
                   fmt::format("{}: {}", components.space.labels.size(), listed(components.space.labels, 8)));
  std::vector<std::string> groups;
  for (const ComponentGroup& group : components.groups) groups.push_back(group.name);
  if (!groups.empty()) out.emplace_back("groups", listed(groups, 8));
  return out;
}

Lines lines_of(const Metrics& metrics) {
  Lines out{{"numbers", fmt::format("{}", metrics.all.size())}};
  constexpr std::size_t shown = 40;
  for (std::size_t i = 0; i < std::min(shown, metrics.all.size()); ++i) {
    const Metric& one = metrics.all[i];
    out.emplace_back("", one.value ? fmt::format("{} {:.4g}{}{}", one.name, *one.value,
                                                 one.unit.empty() ? "" : " ", one.unit)
                                   : one.name + " unknown");
  }
  if (metrics.all.size() > shown)
    out.emplace_back("", fmt::format("and {} more", metrics.all.size() - shown));
  return out;
}

}  // namespace

Lines analysis_lines(const Value& value) {
  if (const auto* components = dynamic_cast<const Components*>(&value)) return lines_of(*components);
  if (const auto* metrics = dynamic_cast<const Metrics*>(&value)) return lines_of(*metrics);
  return {};
}

Json::Object analysis_json(const Value& value) {
  Json::Object out;
  if (const auto* components = dynamic_cast<const Components*>(&value)) {
    out["components"] = static_cast<std::int64_t>(components->count());
    out["method"] = components->method;
    out["representation"] = name_of(components->space.representation);
    Json::Array shares, unique, clips, labels;
    for (double share : components->shares) shares.emplace_back(share);
    for (bool one : components->unique) unique.emplace_back(one);
    for (const ComponentSegment& segment : components->segments)
      clips.emplace_back(static_cast<std::int64_t>(segment.frames()));
    for (const std::string& label : components->space.labels) labels.emplace_back(label);
    out["shares"] = std::move(shares);
    out["unique"] = std::move(unique);
    out["clips"] = std::move(clips);
    out["labels"] = std::move(labels);
    out["fps"] = components->fps;
    out["converged"] = components->converged;
  } else if (const auto* metrics = dynamic_cast<const Metrics*>(&value)) {
    Json::Object numbers;
    for (const Metric& one : metrics->all) numbers[one.name] = one.value ? Json(*one.value) : Json();
    out["metrics"] = std::move(numbers);
  }
  return out;
}

}  // namespace kinegraph
