// Where the real clips are: $KINEGRAPH_MOCAP, else ../shared/mocap beside the checkout.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/places.h"

namespace kinegraph {

inline std::string mocap(const std::string& path = {}) {
  namespace fs = std::filesystem;
  const char* named = std::getenv("KINEGRAPH_MOCAP");
  fs::path folder = named ? fs::path(named) : fs::path(source_folder()) / ".." / "shared" / "mocap";
  return (folder / path).lexically_normal().string();
}

}  // namespace kinegraph

// A test on real clips says plainly that it did not run where they are missing; scripts/test names the
// folder.
#define KINEGRAPH_NEEDS_MOCAP()                                \
  if (!std::filesystem::exists(kinegraph::mocap("README.md"))) \
  GTEST_SKIP() << "no motion capture at " << kinegraph::mocap() << "; set KINEGRAPH_MOCAP"
