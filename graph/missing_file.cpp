#include "graph/missing_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "graph/diagnostic.h"

namespace kinegraph {

namespace fs = std::filesystem;

std::string what_is_instead_of(const fs::path& file) {
  std::error_code failed;
  if (const fs::path target = fs::read_symlink(file, failed); !failed)
    return fmt::format("it is a link to {}, which leads to no file", in_quotes(target.string()));
  std::vector<std::string> names;
  fs::directory_iterator entry(file.has_parent_path() ? file.parent_path() : fs::path("."), failed), end;
  if (failed)
    return fmt::format("there is no folder {} either",
                       in_quotes(file.parent_path().lexically_normal().string()));
  for (; !failed && entry != end; entry.increment(failed)) names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  const std::string near = nearest(file.filename().string(), names);
  return near.empty() ? "" : fmt::format("did you mean {}?", in_quotes(near));
}

}  // namespace kinegraph
