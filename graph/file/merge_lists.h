// Three-way merge of lists, element by element.
#pragma once
#include <vector>

#include "graph/json.h"

namespace kinegraph {

struct MergedList {
  Json::Array elements;
  bool conflict = false;  // both sides changed one element, each in its own way; ours stands
};
// What either side added is in the result, ours before theirs where both added at one place, once where both
// added the same; what either removed is gone. An element that one side changed is changed.
MergedList merge_lists(const Json::Array& base, const Json::Array& ours, const Json::Array& theirs);

// Pairs of indices of a longest common subsequence, rising in both.
std::vector<std::pair<std::size_t, std::size_t>> common_elements(const Json::Array& a, const Json::Array& b);

}  // namespace kinegraph
