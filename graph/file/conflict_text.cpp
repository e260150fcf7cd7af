#include "graph/file/conflict_text.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace kinegraph {

namespace {

using Lines = std::vector<std::string_view>;

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

// Marks the lines that a shortest edit script keeps: Myers, "An O(ND) difference algorithm", 1986, figure 2,
// with every round's furthest points kept for the way back. Texts further apart than `most` edits keep
// nothing: one region then says it all.
void mark_kept(const Lines& a, const Lines& b, std::vector<bool>& in_a, std::vector<bool>& in_b) {
  const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size()), most = std::min(n + m, 4000);
  const auto same = [&](int x, int y) {
    return a[static_cast<std::size_t>(x)] == b[static_cast<std::size_t>(y)];
  };
  std::vector<std::vector<int>> rounds;
  const auto at = [&](std::vector<int>& v, int k, int d) -> int& {
    return v[static_cast<std::size_t>(k + d + 1)];
  };
  std::vector<int> last;
  for (int d = 0; d <= most; ++d) {
    std::vector<int> now(static_cast<std::size_t>(2 * d + 3), 0);
    for (int k = -d; k <= d; k += 2) {
      int x = 0;
      if (d > 0) {
        const bool down = k == -d || (k != d && at(last, k - 1, d - 1) < at(last, k + 1, d - 1));
        x = down ? at(last, k + 1, d - 1) : at(last, k - 1, d - 1) + 1;
      }
      int y = x - k;
      while (x < n && y < m && same(x, y)) ++x, ++y;
      at(now, k, d) = x;
      if (x < n || y < m) continue;
      // Back along the rounds.
      for (int back = d, kk = k;; --back) {
        int from = 0;
        if (back > 0) {
          auto& before = rounds[static_cast<std::size_t>(back - 1)];
          const bool down =
              kk == -back || (kk != back && at(before, kk - 1, back - 1) < at(before, kk + 1, back - 1));
          const int previous = down ? kk + 1 : kk - 1;
          from = at(before, previous, back - 1) + (down ? 0 : 1);
          for (; x > from; --x)
            in_a[static_cast<std::size_t>(x - 1)] = in_b[static_cast<std::size_t>(x - 1 - kk)] = true;
          x = at(before, previous, back - 1);
          kk = previous;
          continue;
        }
        for (; x > 0; --x)
          in_a[static_cast<std::size_t>(x - 1)] = in_b[static_cast<std::size_t>(x - 1)] = true;
        return;
      }
    }
    rounds.push_back(now);
    last = std::move(now);
  }
}

}  // namespace

std::string conflict_text(const std::string& ours, const std::string& theirs, const std::string& our_label,
                          const std::string& their_label) {
  const Lines a = lines_of(ours), b = lines_of(theirs);
  std::size_t head = 0, tail = 0;
  while (head < a.size() && head < b.size() && a[head] == b[head]) ++head;
  while (tail < a.size() - head && tail < b.size() - head && a[a.size() - 1 - tail] == b[b.size() - 1 - tail])
    ++tail;
  std::vector<bool> in_a(a.size() - head - tail, false), in_b(b.size() - head - tail, false);
  const auto middle = [&](const Lines& lines) {
    return Lines(lines.begin() + static_cast<std::ptrdiff_t>(head),
                 lines.end() - static_cast<std::ptrdiff_t>(tail));
  };
  const Lines mine = middle(a), other = middle(b);
  mark_kept(mine, other, in_a, in_b);

  std::string text;
  const auto add = [&](std::string_view line) { text += line; };
  std::for_each(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(head), add);
  for (std::size_t i = 0, j = 0; i < mine.size() || j < other.size();) {
    if (i < mine.size() && in_a[i] && j < other.size() && in_b[j]) {
      add(mine[i++]);
      ++j;
      continue;
    }
    text += "<<<<<<< " + our_label + "\n";
    for (; i < mine.size() && !in_a[i]; ++i) add(mine[i]);
    text += "=======\n";
    for (; j < other.size() && !in_b[j]; ++j) add(other[j]);
    text += ">>>>>>> " + their_label + "\n";
  }
  std::for_each(a.end() - static_cast<std::ptrdiff_t>(tail), a.end(), add);
  return text;
}

}  // namespace kinegraph
