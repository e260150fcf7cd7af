// Two texts as one, with git's conflict markers where they differ.
#pragma once
#include <string>

namespace kinegraph {

std::string conflict_text(const std::string& ours, const std::string& theirs, const std::string& our_label,
                          const std::string& their_label);

}  // namespace kinegraph
