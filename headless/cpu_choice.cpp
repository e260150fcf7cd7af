#include "headless/cpu_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string>
#include <vector>

#include "headless/session.h"

namespace kinegraph {

void choose_cpu_from_environment() {
  const char* wanted = std::getenv("KINEGRAPH_CPU");
  if (!wanted) return;
  std::vector<std::string> names;
  for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    std::string name = hwy::TargetName(target);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    if (name == wanted) return hwy::SetSupportedTargetsForTest(target);
    names.push_back(name);
  }
  throw UsageError(Diagnostic(error("unknown-cpu", fmt::format("KINEGRAPH_CPU: no \"{}\" here", wanted))
                                  .hinting(fmt::format("one of {}", fmt::join(names, ", ")))));
}

}  // namespace kinegraph
