// Pictures of the values that are not motions.
#pragma once
#include <string>

#include "headless/draws/canvas.h"
#include "nodes/judge/metrics.h"
#include "nodes/style/stats.h"
#include "nodes/time/warp.h"

namespace kinegraph {

// The path over the clock, its slope, and the energy over the half-steps.
Canvas draw_warp(const Warp& warp, const std::string& title);
// The mean pose, each joint's spread as a bar, and the root's travel, height and turning.
Canvas draw_stats(const Stats& stats, const std::string& title);
// A table of the overall metrics, and bars over the joints for those measured per joint.
Canvas draw_metrics(const Metrics& metrics, const std::string& title);

}  // namespace kinegraph
