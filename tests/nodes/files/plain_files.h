// Files from the disk, or from memory, for tests of readers.
#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "graph/compute.h"
#include "graph/diagnostic.h"

namespace kinegraph {

class PlainFiles : public FileAccess {
 public:
  FileBytes read(const std::string& path) override {
    if (auto known = made.find(path); known != made.end())
      return std::make_shared<std::string>(known->second);
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Failure(error("missing-file", "no file " + path));
    std::stringstream bytes;
    bytes << in.rdbuf();
    return std::make_shared<std::string>(bytes.str());
  }
  bool exists(const std::string& path) override {
    return made.count(path) || std::filesystem::is_regular_file(path);
  }
  std::vector<std::string> list(const std::string& folder) override {
    std::vector<std::string> names;
    for (const auto& [path, bytes] : made)
      if (path.size() > folder.size() && path.compare(0, folder.size(), folder) == 0 &&
          path[folder.size()] == '/')
        names.push_back(path.substr(folder.size() + 1));
    if (std::filesystem::is_directory(folder))
      for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::map<std::string, std::string> made;  // path -> bytes
};

}  // namespace kinegraph
