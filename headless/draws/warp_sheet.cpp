#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "headless/draws/curves.h"
#include "headless/draws/sheets.h"
#include "headless/draws/theme.h"

namespace kinegraph {

namespace {

// Frames advanced a row, weighted over a window that falls off to both sides: single holds and skips read as
// a slope.
std::vector<double> slope_of(const std::vector<std::uint32_t>& path, std::size_t reach) {
  std::vector<double> slope(path.size());
  for (std::size_t row = 0; row < path.size(); ++row) {
    double sum = 0, weights = 0;
    for (std::size_t other = row > reach ? row - reach : 1; other < path.size() && other <= row + reach;
         ++other) {
      double away = std::abs(static_cast<double>(other) - 0.5 - static_cast<double>(row));
      double weight = static_cast<double>(reach) + 1 - away;
      sum += weight * (static_cast<double>(path[other]) - static_cast<double>(path[other - 1]));
      weights += weight;
    }
    slope[row] = weights > 0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
  }
  return slope;
}

}  // namespace

Canvas draw_warp(const Warp& warp, const std::string& title) {
  const char* laid = warp.source_warped ? "source" : "reference";
  std::string facts =
      warp.identity
          ? "the identity: rows are frames"
          : fmt::format(
                "source {} frames · reference {} frames · {:g} fps · the {} is laid on the {}'s clock{}",
                warp.source_frames, warp.reference_frames, warp.fps, laid,
                warp.source_warped ? "reference" : "source",
                warp.dofs.empty() ? "" : fmt::format(" · {} paths, one a DOF", warp.dofs.size()));
  Canvas canvas(1000, 720);
  double y = theme::draw_title(canvas, title, facts);
  const double left = theme::margin - 4, width = canvas.width() - 2 * left;
  bool energy = warp.energy.size() > 1;

  Chart path{"Which frame is shown when",
             {"row of the shared clock", "frames"},
             {fmt::format("{} frame", laid), ""},
             {}};
  Chart slope{"Slope", {"row of the shared clock", "frames"}, {"frames a row", ""}, {}};
  std::size_t rows = warp.paths.empty() ? 0 : warp.paths[0].size();
  double end = rows > 0 ? static_cast<double>(rows - 1) : 1;
  double last = 0;
  for (const auto& one : warp.paths)
    if (!one.empty()) last = std::max(last, static_cast<double>(one.back()));
  path.curves.push_back({"even time", theme::faint, {0, end}, {0, rows ? last : 1}, 1.1, {4, 4}});
  slope.curves.push_back({"", theme::faint, {0, end}, {1, 1}, 1.1, {4, 4}});
  for (std::size_t i = 0; i < warp.paths.size(); ++i) {
    const auto& one = warp.paths[i];
    bool many = warp.paths.size() > 1;
    Color color = many ? faded(theme::series(static_cast<int>(i)), 0.45) : theme::left;
    Curve shown{many ? "" : "path", color, {}, {}, many ? 1.0 : 2.0};
    for (std::size_t row = 0; row < one.size(); ++row) {
      shown.x.push_back(static_cast<double>(row));
      shown.y.push_back(static_cast<double>(one[row]));
    }
    Curve rate{"", color, shown.x, slope_of(one, std::max<std::size_t>(6, one.size() / 40)),
               many ? 1.0 : 1.6};
    path.curves.push_back(std::move(shown));
    slope.curves.push_back(std::move(rate));
  }
  slope.y.low = 0;
  if (rows == 0) slope.y.high = 2;
  draw_chart(canvas, {left, y, width, 330}, path);
  double below = energy ? 0.6 * width : width;
  draw_chart(canvas, {left, y + 345, below - 10, 230}, slope);
  if (energy) {
    Chart fall{"Energy", {"half-step", "", {}, {}, false, true}, {"energy", ""}, {}};
    Curve curve{"", theme::right, {}, {}, 1.6, {}, warp.energy.size() < 60};
    for (std::size_t i = 0; i < warp.energy.size(); ++i) {
      curve.x.push_back(static_cast<double>(i));
      curve.y.push_back(warp.energy[i]);
    }
    double low = *std::min_element(curve.y.begin(), curve.y.end());
    fall.y.logarithmic = low > 0 && curve.y.front() > 30 * low;
    fall.curves.push_back(std::move(curve));
    draw_chart(canvas, {left + below, y + 345, width - below, 230}, fall);
  }
  canvas.set_height(y + 345 + 230 + 12);
  return canvas;
}

}  // namespace kinegraph
