// Pictures of the values that are not motions.
#pragma once
#include <string>

#include "headless/draws/canvas.h"
#include "nodes/components/components.h"
#include "nodes/motion/metrics.h"
#include "nodes/style/stats.h"
#include "nodes/time/warp.h"

namespace kinegraph {

// The path over the clock, its slope, and the energy over the half-steps.
Canvas draw_warp(const Warp& warp, const std::string& title);
// The mean pose, each joint's spread as a bar, and the root's travel, height and turning.
Canvas draw_stats(const Stats& stats, const std::string& title);
// A table of the overall metrics, and bars over the joints for those measured per joint.
Canvas draw_metrics(const Metrics& metrics, const std::string& title);
// Each component as a small strip with a caption, its signal underneath with the segments shaded; last all
// together.
Canvas draw_components(const Components& components, const std::string& title);
// The metrics of ComponentMeaning: bars for d_emotion and each region, a column a component.
bool is_meaning(const Metrics& metrics);
Canvas draw_meaning(const Metrics& metrics, const std::string& title);

}  // namespace kinegraph
