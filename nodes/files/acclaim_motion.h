// Acclaim skeleton and motion, .asf and .amc, to a motion.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/compute.h"
#include "graph/work.h"
#include "nodes/files/acclaim_skeleton.h"
#include "nodes/files/read_options.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

// A bone becomes a joint of its name at the bone's start; its length is the OFFSET of its children, or of an
// End Site where it has none. A local rotation is C M C⁻¹, M from the bone's degrees of freedom: "rx ry rz"
// turns about X first. The unit is the .asf's, 1 / `length` inch, where it says one, else found by height as
// for a BVH; frames per second are options.rate. Without `amc` text (an .asf alone) there are no frames.
// Throws Failure with line and column: "unknown-bone", "missing-bone", "too-few-values", "too-many-values",
// "not-finite", "decimal-comma", "bad-number", "bad-frame-number". Frame numbers that skip are a warning
// ("skipped-frame-numbers").
Motion acclaim_motion(const AcclaimSkeleton& skeleton, std::string_view amc, const ReadOptions& options,
                      Work& work);

// The .asf of an .amc: same stem ("16_45.asf"), else the stem up to the last `_` ("16.asf"), else the
// folder's only .asf. Throws Failure ("missing-skeleton") at `skeleton` listing what was tried.
std::string find_asf(const std::string& amc_path, FileAccess& files);

}  // namespace kinegraph
