// Runs a kernel on each of this machine's instruction sets.
#pragma once
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <functional>
#include <vector>

namespace kinegraph {

// The numbers that a kernel gives, which must be the same bits on every instruction set.
inline std::vector<double> on_every_target(const std::function<std::vector<double>()>& kernel) {
  std::vector<double> first;
  for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const std::vector<double> now = kernel();
    if (first.empty()) first = now;
    EXPECT_EQ(now, first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return first;
}

}  // namespace kinegraph
