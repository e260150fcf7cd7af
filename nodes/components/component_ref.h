// Naming components: by number from 1 (u1, u2, …), or a group by its name.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"
#include "graph/param.h"
#include "nodes/components/components.h"

namespace kinegraph {

struct ComponentRef {
  int component = 0;  // from 1; 0: the group
  std::string group;
};

// A parameter or field that names one: a number, or text ("u3", "3", a group's name).
ParamType component_type();
ComponentRef component_ref(const Json& value);
// One, or a list of them.
std::vector<ComponentRef> component_refs(const Json& value);

// What a reference stands for: entries of the signals, from 0, and what a unit step along it is on each.
struct ComponentTerm {
  std::size_t index = 0;
  double weight = 1;
};
// Throws Failure ("unknown-component") at `param`, naming what there is.
std::vector<ComponentTerm> terms_of(const ComponentRef& ref, std::size_t count,
                                    const std::vector<ComponentGroup>& groups, std::string_view param);
// Entries from 0 of all of them, rising, each once; of no reference: all.
std::vector<std::size_t> entries_of(const std::vector<ComponentRef>& refs, const Components& components,
                                    std::string_view param);

// A segment by its number from 0. Throws Failure ("unknown-segment") at `param`.
const ComponentSegment& segment_of(const Components& components, std::int64_t number, std::string_view param);

}  // namespace kinegraph
