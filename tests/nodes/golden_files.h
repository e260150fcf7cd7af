// What tests remember from one version of the program to the next, in tests/nodes/golden/.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "graph/file/parse_json.h"
#include "tests/places.h"

namespace kinegraph::golden {

inline const std::string folder = source_folder() + "/tests/nodes/golden/";

// KINEGRAPH_UPDATE_GOLDEN=1 build/release/bin/test_nodes --gtest_filter='Golden*' writes what is new.
inline bool updating() {
  const char* asked = std::getenv("KINEGRAPH_UPDATE_GOLDEN");
  return asked && *asked;
}
inline std::string text(const std::string& name) {
  std::ifstream in(folder + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
// An empty object where there is no such file yet.
inline Json json(const std::string& name) {
  if (!std::filesystem::exists(folder + name)) return Json(Json::Object{});
  Diagnostics problems;
  return parse_json(text(name), name, problems);
}
inline void write(const std::string& name, const std::string& what) {
  std::ofstream(folder + name, std::ios::binary) << what;
}

}  // namespace kinegraph::golden
