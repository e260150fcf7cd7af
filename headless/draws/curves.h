// Plots: axes with round ticks and units, curves, a legend.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "headless/draws/canvas.h"

namespace kinegraph {

struct Frame {  // where a plot goes on the page, its axis labels included
  double x, y, width, height;
};

struct Curve {
  std::string name;  // in the legend; "" = not there
  Color color;
  std::vector<double> x, y;  // equal lengths; a gap where y is NaN
  double width = 1.6;
  std::vector<double> dashes = {};
  bool dots = false;  // a dot at every value
};
struct Axis {
  std::string label;                // "time"
  std::string unit;                 // "s"; "" = none
  std::optional<double> low, high;  // else what the curves need, rounded outwards
  bool logarithmic = false;         // values > 0
  bool whole = false;               // ticks at whole numbers only
};
struct Chart {
  std::string title;
  Axis x, y;
  std::vector<Curve> curves;
};
void draw_chart(Canvas& canvas, const Frame& frame, const Chart& chart);

// Round numbers inside [low, high], about `wanted` of them.
std::vector<double> round_ticks(double low, double high, int wanted, bool whole = false);
// As a tick needs it: no more decimals than the step asks for.
std::string tick_text(double value, double step);

// A time axis below bars or strips: ticks and seconds between two places of the page.
void draw_time_axis(Canvas& canvas, double x0, double x1, double y, double seconds);

}  // namespace kinegraph
