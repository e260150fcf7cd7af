#include "graph/file/merge_lists.h"

#include <algorithm>
#include <optional>

namespace kinegraph {

std::vector<std::pair<std::size_t, std::size_t>> common_elements(const Json::Array& a, const Json::Array& b) {
  std::vector<std::vector<std::size_t>> length(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t j = b.size(); j-- > 0;)
      length[i][j] = a[i] == b[j] ? length[i + 1][j + 1] + 1 : std::max(length[i + 1][j], length[i][j + 1]);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j])
      pairs.emplace_back(i++, j++);
    else if (length[i + 1][j] >= length[i][j + 1])
      ++i;
    else
      ++j;
  }
  return pairs;
}

namespace {

// What a side made of the base: of each element, and what it put in.
struct Side {
  std::vector<std::optional<Json>> of;  // by base index: the element as it is now; nothing = removed
  std::vector<Json::Array> added;       // before base index i; the last after all
};

Side side_of(const Json::Array& base, const Json::Array& now) {
  Side side;
  side.of.resize(base.size());
  side.added.resize(base.size() + 1);
  std::size_t i = 0, j = 0;
  // Between two elements that stayed, the k-th that is new stands for the k-th that is gone.
  const auto gap = [&](std::size_t end_i, std::size_t end_j) {
    while (i < end_i && j < end_j) side.of[i++] = now[j++];
    i = end_i;
    while (j < end_j) side.added[end_i].push_back(now[j++]);
  };
  for (const auto& [at_base, at_now] : common_elements(base, now)) {
    gap(at_base, at_now);
    side.of[i++] = now[j++];
  }
  gap(base.size(), now.size());
  return side;
}

}  // namespace

MergedList merge_lists(const Json::Array& base, const Json::Array& ours, const Json::Array& theirs) {
  const Side our = side_of(base, ours), their = side_of(base, theirs);
  MergedList merged;
  for (std::size_t i = 0; i <= base.size(); ++i) {
    for (const Json& element : our.added[i]) merged.elements.push_back(element);
    for (const Json& element : their.added[i])
      if (std::find(our.added[i].begin(), our.added[i].end(), element) == our.added[i].end())
        merged.elements.push_back(element);
    if (i == base.size()) break;
    const std::optional<Json> was = base[i];
    const auto& is = their.of[i] == was || our.of[i] == their.of[i] ? our.of[i] : their.of[i];
    if (our.of[i] != was && their.of[i] != was && our.of[i] != their.of[i]) {
      merged.conflict = true;
      if (our.of[i]) merged.elements.push_back(*our.of[i]);
    } else if (is) {
      merged.elements.push_back(*is);
    }
  }
  return merged;
}

}  // namespace kinegraph
