#include "nodes/components/component_ref.h"

#include <fmt/format.h>

#include <charconv>
#include <set>

namespace kinegraph {
namespace {

// "u3" or "3" as 3, else 0.
int number_in(std::string_view text) {
  if (!text.empty() && text[0] == 'u') text.remove_prefix(1);
  int number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && end == text.data() + text.size() && number > 0 ? number : 0;
}

}  // namespace

ParamType component_type() {
  return either({integer(1).between(1, 100000), text("u1")});
}

ComponentRef component_ref(const Json& value) {
  if (value.is_number()) return {static_cast<int>(value.number()), {}};
  if (const int number = number_in(value.string())) return {number, {}};
  return {0, value.string()};
}

std::vector<ComponentRef> component_refs(const Json& value) {
  if (!value.is_array()) return {component_ref(value)};
  std::vector<ComponentRef> out;
  for (const Json& one : value.array()) out.push_back(component_ref(one));
  return out;
}

std::vector<ComponentTerm> terms_of(const ComponentRef& ref, std::size_t count,
                                    const std::vector<ComponentGroup>& groups, std::string_view param) {
  if (ref.component > 0) {
    if (static_cast<std::size_t>(ref.component) <= count)
      return {{static_cast<std::size_t>(ref.component) - 1, 1.0}};
    throw Failure(error("unknown-component", fmt::format("there is no component u{}", ref.component))
                      .at_param(std::string(param))
                      .hinting(fmt::format("there are u1 to u{}", count)));
  }
  std::string names;
  for (const ComponentGroup& group : groups) {
    names += (names.empty() ? "" : ", ") + group.name;
    if (group.name != ref.group) continue;
    std::vector<ComponentTerm> out;
    for (const auto& [component, weight] : group.terms)
      out.push_back({static_cast<std::size_t>(component) - 1, weight});
    return out;
  }
  throw Failure(error("unknown-component", fmt::format("there is no group '{}'", ref.group))
                    .at_param(std::string(param))
                    .hinting(names.empty() ? fmt::format("there are u1 to u{} and no groups", count)
                                           : fmt::format("there are u1 to u{} and {}", count, names)));
}

std::vector<std::size_t> entries_of(const std::vector<ComponentRef>& refs, const Components& components,
                                    std::string_view param) {
  std::set<std::size_t> entries;
  for (const ComponentRef& ref : refs)
    for (const ComponentTerm& term : terms_of(ref, components.count(), components.groups, param))
      entries.insert(term.index);
  for (std::size_t i = 0; refs.empty() && i < components.count(); ++i) entries.insert(i);
  return {entries.begin(), entries.end()};
}

const ComponentSegment& segment_of(const Components& components, std::int64_t number,
                                   std::string_view param) {
  if (number >= 0 && static_cast<std::size_t>(number) < components.segments.size())
    return components.segments[static_cast<std::size_t>(number)];
  throw Failure(
      error("unknown-segment", fmt::format("there is no segment {}", number))
          .at_param(std::string(param))
          .hinting(fmt::format("segments are counted from 0; there {} {}",
                               components.segments.size() == 1 ? "is" : "are", components.segments.size())));
}

}  // namespace kinegraph
