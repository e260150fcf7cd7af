// What edits of the same components need again and again, whatever value a slider has: kept beside the
// components, so that it goes when they go.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "graph/value.h"
#include "nodes/components/last_few.h"
#include "nodes/components/rows.h"
#include "nodes/time/dynamic_time_warp.h"

namespace kinegraph {

// A value that never changes; two are equal where they are the same object. Doesn't keep it alive.
struct SameClip {
  std::weak_ptr<const Value> clip;
  bool operator==(const SameClip& other) const {
    return !clip.owner_before(other.clip) && !other.clip.owner_before(clip);
  }
};

// All that an alignment (alignment.h) depends on within one ChannelSpace.
struct AlignmentKey {
  SameClip a, b;
  std::vector<std::string> align;
  std::string param;            // how messages name `align`
  std::vector<double> signals;  // those among what is compared
  bool operator==(const AlignmentKey&) const = default;
};
// All that the channels of a component shown as a motion depend on.
struct ShownKey {
  SameClip base;
  std::vector<std::size_t> entries;
  std::vector<double> signals;  // of those entries
  bool operator==(const ShownKey&) const = default;
};

// All that the channels of a changed ComponentMotion depend on.
struct EditedKey {
  SameClip clip;
  std::vector<double> first;  // of Euler angles: the first frame's, which says how full turns are counted
  bool operator==(const EditedKey&) const = default;
};

struct ComponentMemory {
  LastFew<AlignmentKey, Correspondence, 4> alignments;
  LastFew<ShownKey, Rows, 1> shown;
  LastFew<EditedKey, Rows, 1> edited;
};

}  // namespace kinegraph
