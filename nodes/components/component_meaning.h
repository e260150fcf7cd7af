// What each component does [Cao §4.3]: how much it tells clips of different emotion apart, which parts of the
// body it moves, how fast it swings.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/work.h"
#include "nodes/components/component_ref.h"
#include "nodes/components/components.h"

namespace kinegraph {

// How often signals repeat, in Hz: the highest peak of a signal's autocorrelation after it first falls below
// zero, if it reaches 0.3 of its variance there and 0.01 of the whole signal's. Clips that are joined have
// beats of their own, so all components are measured in one segment: the first in which at least half as much
// of the variance repeats as in any. Only a component that has no beat there takes it from another segment.
struct Cadence {
  double hertz = 0;
  std::size_t segment = 0;  // where it was measured
};
// A component's, or none.
std::vector<std::optional<Cadence>> cadences_of(const Components& components);
// "0.92 Hz", with several segments "0.92 Hz in segment 1".
std::string text_of(const Cadence& cadence, const Components& components);

// How far a component moves each joint or point: root mean square over its signals, in metres, for rotations
// in radians (for quaternions in parts of the unit sphere). The largest first.
struct Moved {
  std::string label;
  double amount = 0;
};
std::vector<Moved> moved_by(const Components& components, std::size_t entry);

// The same of the body's regions: by what angle their links turn, root mean square, in radians. "trunk",
// "head", "arms" and "legs", those that there are; empty for Points and for skeletons without a body.
std::vector<Moved> regions_moved_by(const Components& components, std::size_t entry);
// What a caption names: the regions that turn at least two thirds as much as the first, "trunk and arms";
// where there are no regions the three joints or points that move most, and of a cloud which part of it
// (cloud_caption.h).
std::string what_moves(const Components& components, std::size_t entry);

struct MeaningParams {
  std::vector<std::pair<std::int64_t, std::int64_t>>
      pairs;  // segments of equal content and different emotion
  std::vector<std::string> align;
  std::vector<ComponentRef> emotion;  // E; empty: the component with the largest d_emotion
  std::vector<std::pair<std::string, std::string>> regions;  // name and pattern of joints
};
struct ComponentMeaning {
  std::vector<std::optional<double>> d_emotion;  // a component
  std::vector<std::size_t> emotion;              // E, entries from 0
  std::vector<std::vector<double>> d_region;     // [region][component], metres; negative = contributes
};
// d_emotion,j = (Σ_pairs Σ_t (u_j - v_j)² / Σ_pairs q)^½ over the q rows of each pair's path. With
// x_A = E{x} + P A Σ_{i∈A} uᵢ eᵢ and d(x_A, x_B) = (mean over frames of the mean over the region's points of
// ‖x_A - x_B‖²)^½: d_region,i = d(x_{E∪{i}}, x_all) - d(x_E, x_all), and for i of E, where that would be 0,
// d(x_E, x_all) - d(x_{E∖{i}}, x_all). Throws Failure: "unknown-segment", "bad-pair", "unknown-component",
// "unknown-joint", "no-joints" at regions.
ComponentMeaning component_meaning(const Components& components, const MeaningParams& params, Work& work);

}  // namespace kinegraph
