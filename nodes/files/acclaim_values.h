// The numbers of an .amc.
#pragma once
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/files/acclaim_skeleton.h"
#include "nodes/files/read_options.h"

namespace kinegraph {

struct AcclaimValues {
  std::size_t frames = 0;  // kept
  std::size_t first = 0;   // the file's number of the first kept, from 0
  bool degrees = true;
  std::vector<double> series;  // value after value, all bones in order, `frames` each
};

// See acclaim_motion.h for the errors.
AcclaimValues read_amc_values(std::string_view text, const AcclaimSkeleton& skeleton,
                              const ReadOptions& options, Work& work);

}  // namespace kinegraph
