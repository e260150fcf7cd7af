// Pictures of the values that are not motions.
#pragma once
#include <string>

#include "headless/draws/canvas.h"
#include "nodes/components/components.h"
#include "nodes/motion/metrics.h"
#include "nodes/motion/points.h"
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
// Moments in a row with each point's tail, one moment large with labels, heights and speeds over time, and
// where samples are missing. `moments`: 0 = as many as look good.
Canvas draw_points(const Points& points, const std::string& title, int moments = 0);
// "41 points · 902 frames · 60 fps · 15.03 s · no sample missing"
std::string facts_of(const Points& points);
// The metrics of ComponentMeaning: bars for d_emotion and each region, a column a component.
bool is_meaning(const Metrics& metrics);
Canvas draw_meaning(const Metrics& metrics, const std::string& title);

}  // namespace kinegraph
