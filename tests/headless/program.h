// Drives the real program in a folder of its own.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace kinegraph {

struct Ran {
  int exit = -1;  // 128 + N where signal N ended it
  std::string out, err;
  std::size_t peak = 0;  // bytes resident at the most
};

struct RunningProgram {
  int process = -1;
  std::filesystem::path out, err;
};

class ProgramTest : public testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  // Runs `kinegraph ARGUMENTS` in folder() to its end. `environment`: NAME=VALUE besides what the test has.
  Ran run(std::vector<std::string> arguments, std::vector<std::string> environment = {}, std::string in = {});
  RunningProgram start(std::vector<std::string> arguments, std::vector<std::string> environment = {},
                       std::string in = {});
  Ran wait(const RunningProgram& running);

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  nlohmann::json read_json(const std::string& name) const { return nlohmann::json::parse(read(name)); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::vector<std::string> files() const;  // all below the folder, sorted

 private:
  std::filesystem::path folder_, outputs_;
  int count_ = 0;
};

// Graphs that the tests share. `nodes` and `publish`: the insides of those members; publish "" = left out.
std::string graph(const std::string& nodes, const std::string& publish = {});
std::string walk_and_export();  // "walk" (Gait, 1 s) -> "out" (Export, walk.bvh)
std::string
long_warp();  // two Gaits of two minutes and the TimeWarp "warp" between them, published as "warped"
// metrics.json (skate 0.02) -> "numbers" (Load) -> "judge" (Check, rule)
std::string check_of(const std::string& rule);
std::string metrics_file(double skate);

}  // namespace kinegraph
