// What independent component analysis finds in one or several clips [Shapiro §3, Cao §3, eq. 2]: x = E{x} + P
// A u.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "graph/value.h"
#include "nodes/components/channels.h"
#include "nodes/components/component_memory.h"
#include "nodes/components/rows.h"

namespace kinegraph {

// One input clip among the joined ones: its frames [start, end) of the signals, and the clip itself, which is
// the base of what is built from it (path, heading, bones, what the components leave out). Exactly one of the
// two is there.
struct ComponentSegment {
  std::size_t start = 0, end = 0;
  std::shared_ptr<const Motion> motion;
  std::shared_ptr<const Points> points;
  Rows added;  // D x frames: what edits added that no signal says; empty: nothing
  std::size_t frames() const { return end - start; }
};

// Components that later edits treat as one [eq. 4, 6, 7]: Σ αᵢ uᵢ eᵢ.
struct ComponentGroup {
  std::string name;
  std::vector<std::pair<int, double>> terms;  // component from 1, factor
};

class Components final : public Value {
 public:
  ChannelSpace space;
  double fps = 120;
  std::vector<double> mean;    // D: E{x}
  Rows mixing;                 // D x k: P A
  Rows unmixing;               // k x D: (P A)⁺, u = unmixing (x - mean)
  Rows signals;                // k x T over all segments; unit variance
  std::vector<double> shares;  // k: each component's part of the whole variance
  std::vector<ComponentSegment> segments;
  std::vector<ComponentGroup> groups;
  // How they were found.
  std::string nonlinearity = "logcosh", method = "symmetric";
  bool converged = true;
  int iterations = 0;
  double reached = 0, tolerance = 0, negentropy = 0;
  std::vector<bool> unique;  // false: another optimum with nearly the same negentropy lacks this component

  // No part of the value: what follows from it, and from copies with other signals, segments or groups.
  std::shared_ptr<ComponentMemory> memory = std::make_shared<ComponentMemory>();

  std::size_t count() const { return signals.rows; }
  std::size_t frames() const { return signals.columns; }

  std::string_view type() const override { return "Components"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;
};
ValuePtr decode_components(Decoder& in);

}  // namespace kinegraph
