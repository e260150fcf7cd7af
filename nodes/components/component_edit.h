// Editing a motion by its components [Shapiro §4, §5; Cao §5, §6]: the signals of one segment are changed one
// edit after the other, and become a motion again.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "graph/param.h"
#include "graph/work.h"
#include "nodes/components/component_ref.h"
#include "nodes/components/components.h"

namespace kinegraph {

// Frames are the segment's own, from 0; the whole segment where there is no end. Of a group each edit moves
// all its components, by the group's factors.
namespace edits {
struct Scale {  // u ← factor u
  ComponentRef component;
  double factor = 1;
};
struct Merge {  // u_i ← αᵢ uᵢ, and from now on they are one [eq. 4, 6, 7]
  std::string name;
  std::vector<std::pair<ComponentRef, double>> terms;
};
struct Translate {  // u ← u + value
  ComponentRef component;
  double value = 0;
};
struct Replace {  // u[frames] ← u[by_frames], stretched to fit, or repeated
  ComponentRef component;
  FrameRange frames, by_frames;
  double fade = 0;  // s, inside `frames`
  bool repeat = false;
};
struct CopyAdd {  // x ← x + factor (P A)₂ vᵢ, v of `other`'s segment, resampled to this segment
  ComponentRef component;
  double factor = 1;
  std::int64_t segment = 0;  // of `other`
  FrameRange frames;
};
struct Transfer {  // u_a ← u_a + amount (u_b^s - u_a^s) [Shapiro eq. 5], after alignment
  std::vector<ComponentRef> components;
  std::int64_t from = 0, to = 0;   // segments b and a
  std::vector<std::string> align;  // as in alignment.h
  bool keep_timing_of_from = false;
  FrameRange frames;
  double amount = 1;
};
struct Substitute {  // x ← x + (x_edited - xᵢ)
  ComponentRef component;
};
struct Warp {  // u ← u + a C² cubic spline through (frame, value - u(frame)); level at the ends, 0 there
               // without a key
  ComponentRef component;
  std::vector<std::pair<std::int64_t, double>> keys;
};
}  // namespace edits
using ComponentEditStep = std::variant<edits::Scale, edits::Merge, edits::Translate, edits::Replace,
                                       edits::CopyAdd, edits::Transfer, edits::Substitute, edits::Warp>;

struct ComponentEditParams {
  std::vector<ComponentEditStep> edits;
  std::optional<std::int64_t> segment;  // open: a transfer's `to`, else 0
  // Hz, of what is warped in time or replaced; also fades `frames` over its inverse; 0 = off. A base that
  // holds frames of its own (held_frames.h) is smoothed by its own time.
  double lowpass = 6;
  bool residual = false;  // adds what the components leave out of the base
};
struct ComponentEditInputs {
  const Components* other = nullptr;
  std::shared_ptr<const Motion> edited_motion;
  std::shared_ptr<const Points> edited_points;
};

struct ComponentEditResult {
  Components components;  // with the changed signals, the groups, and the base as its segment
  std::size_t segment =
      0;          // the edited one; its clip is the base, warped where a transfer keeps the other's timing
  Rows channels;  // x of that segment
};
// Throws Failure at edits[i] or a field of it: "unknown-component", "unknown-segment", "bad-range",
// "no-input" (an edit needs `other` or `edited`), "wrong-kind" (`edited` is), "wrong-channels",
// "wrong-length", "name-taken", "bad-edit", those of alignment.h.
ComponentEditResult edit_components(const Components& components, const ComponentEditParams& params,
                                    const ComponentEditInputs& inputs, Work& work);

}  // namespace kinegraph
