// Where paths really lead.
#pragma once
#include <string>

namespace kinegraph {

// The absolute path with its links resolved, also where what they lead to, or the path's last parts, don't
// exist.
std::string real_path(const std::string& path);
// Whether a resolved path is the folder or lies in it. Nothing lies in "".
bool is_below(const std::string& path, const std::string& folder);

}  // namespace kinegraph
