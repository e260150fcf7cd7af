#include "nodes/cartoon/skin_places.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "nodes/cartoon/planted_limbs.h"

namespace kinegraph {
namespace {

constexpr double longest_patch = 2.5, fade = 1.5;  // sub-links

// Patches of tight vertices; of each the places its vertices take.
void settle_patches(const JointSkin& skin, const std::vector<int>& index, std::vector<double>& places) {
  std::vector<char> seen(skin.vertices.size());
  std::vector<int> patch;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (!skin.tight[start] || seen[start]) continue;
    patch.assign(1, static_cast<int>(start));
    seen[start] = 1;
    double sum = 0, least = places[start], most = least;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const double place = places[patch[i]];
      sum += place;
      least = std::min(least, place);
      most = std::max(most, place);
      for (int other : skin.beside[skin.vertices[patch[i]]]) {
        const int next = index[other];
        if (next < 0 || !skin.tight[next] || seen[next]) continue;
        seen[next] = 1;
        patch.push_back(next);
      }
    }
    const double middle = std::floor(sum / static_cast<double>(patch.size()) + 0.5);
    for (int one : patch)
      places[one] = most - least <= longest_patch ? middle : std::floor(places[one] + 0.5);
  }
}

}  // namespace

std::vector<std::vector<int>> mesh_neighbours(std::span<const Vec3> at,
                                              std::span<const std::uint32_t> triangles) {
  const auto by_place = [&](int a, int b) {
    return std::tie(at[a].x, at[a].y, at[a].z) < std::tie(at[b].x, at[b].y, at[b].z);
  };
  std::vector<int> order(at.size()), same(at.size());
  for (std::size_t v = 0; v < at.size(); ++v) order[v] = static_cast<int>(v);
  std::stable_sort(order.begin(), order.end(), by_place);
  for (std::size_t i = 0; i < order.size(); ++i)
    same[order[i]] = i > 0 && !by_place(order[i - 1], order[i]) ? same[order[i - 1]] : order[i];
  std::vector<std::vector<int>> beside(at.size());
  const auto join = [&](int a, int b) {
    if (a != b) beside[a].push_back(b);
  };
  for (std::size_t v = 0; v < at.size(); ++v) {
    join(static_cast<int>(v), same[v]);
    join(same[v], static_cast<int>(v));
  }
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = same[triangles[i + k]], b = same[triangles[i + (k + 1) % 3]];
      join(a, b);
      join(b, a);
    }
  for (auto& list : beside) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return beside;
}

void settle_places(const JointSkin& skin, std::vector<double>& places, Work& work) {
  std::vector<int> index(skin.at.size(), -1);
  for (std::size_t i = 0; i < skin.vertices.size(); ++i) index[skin.vertices[i]] = static_cast<int>(i);
  const std::vector<double> own = places;
  settle_patches(skin, index, places);
  // From the patches outwards, the nearest first.
  using Reached = std::tuple<double, int, double>;  // way, vertex, the patch's place
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (skin.tight[i]) next.emplace(0.0, static_cast<int>(i), places[i]);
  std::vector<char> done(places.size());
  for (std::size_t count = 0; !next.empty(); ++count) {
    if (count % 1024 == 0) work.check();
    const auto [way, i, of_patch] = next.top();
    next.pop();
    if (done[i]) continue;
    done[i] = 1;
    if (!skin.tight[i])
      places[i] = of_patch + smoothest_step(way / (fade * skin.sub_link)) * (own[i] - of_patch);
    for (int other : skin.beside[skin.vertices[i]]) {
      const int there = index[other];
      if (there < 0 || done[there] || skin.tight[there]) continue;
      const double far = way + norm(skin.at[other] - skin.at[skin.vertices[i]]);
      if (far < fade * skin.sub_link) next.emplace(far, there, of_patch);
    }
  }
}

}  // namespace kinegraph
