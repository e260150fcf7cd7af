#include "graph/evaluate/real_path.h"

#include <filesystem>

namespace kinegraph {

namespace {

namespace fs = std::filesystem;

// weakly_canonical stops at a link that leads nowhere; this puts the place it names in its stead.
bool follow_dangling(fs::path& path) {
  std::error_code ignored;
  fs::path seen;
  for (auto part = path.begin(); part != path.end(); ++part) {
    seen /= *part;
    if (!fs::is_symlink(fs::symlink_status(seen, ignored))) continue;
    fs::path target = seen.parent_path() / fs::read_symlink(seen, ignored);
    if (ignored) return false;
    for (++part; part != path.end(); ++part) target /= *part;
    path = target;
    return true;
  }
  return false;
}

}  // namespace

std::string real_path(const std::string& path) {
  fs::path at(path);
  constexpr int most_links = 40;  // as the system's own limit
  for (int followed = 0; followed < most_links; ++followed) {
    std::error_code problem;
    auto real = fs::weakly_canonical(at, problem);
    at = problem ? at.lexically_normal() : real.lexically_normal();
    if (!follow_dangling(at)) break;
  }
  return at.string();
}

bool is_below(const std::string& path, const std::string& folder) {
  if (folder.empty()) return false;
  if (path == folder) return true;
  return path.starts_with(folder.ends_with('/') ? folder : folder + "/");
}

}  // namespace kinegraph
