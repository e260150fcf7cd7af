#include "program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tests/places.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path fresh_folder() {
  std::string name = (fs::temp_directory_path() / "kinegraph-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  return name;
}

}  // namespace

ProgramTest::ProgramTest() : folder_(fresh_folder()), outputs_(fresh_folder()) {}
ProgramTest::~ProgramTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::remove_all(outputs_, ignored);
}

RunningProgram ProgramTest::start(std::vector<std::string> arguments, std::vector<std::string> environment,
                                  std::string in) {
  ++count_;
  RunningProgram running{-1, outputs_ / ("out" + std::to_string(count_)),
                         outputs_ / ("err" + std::to_string(count_))};
  fs::path input = outputs_ / ("in" + std::to_string(count_));
  std::ofstream(input, std::ios::binary) << in;
  std::string program = bin_folder() + "/kinegraph";
  std::vector<char*> words{program.data()};
  for (auto& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  running.process = fork();
  if (running.process < 0) throw std::runtime_error("fork failed");
  if (running.process == 0) {
    auto redirect = [](const fs::path& path, int flags, int to) {
      int from = open(path.c_str(), flags, 0600);
      if (from < 0 || dup2(from, to) < 0) _exit(99);
    };
    redirect(input, O_RDONLY, STDIN_FILENO);
    redirect(running.out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(running.err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    unsetenv("KINEGRAPH_CACHE");
    for (auto& setting : environment) putenv(setting.data());
    if (chdir(folder_.c_str()) != 0) _exit(98);
    execv(program.c_str(), words.data());
    _exit(97);
  }
  return running;
}

Ran ProgramTest::wait(const RunningProgram& running) {
  int status = 0;
  rusage used{};
  wait4(running.process, &status, 0, &used);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), bytes_of(running.out),
          bytes_of(running.err), static_cast<std::size_t>(used.ru_maxrss) * 1024};
}

Ran ProgramTest::run(std::vector<std::string> arguments, std::vector<std::string> environment,
                     std::string in) {
  return wait(start(std::move(arguments), std::move(environment), std::move(in)));
}

void ProgramTest::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string ProgramTest::read(const std::string& name) const {
  return bytes_of(folder_ / name);
}

std::vector<std::string> ProgramTest::files() const {
  std::vector<std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    all.push_back(fs::relative(entry.path(), folder_).generic_string());
  std::sort(all.begin(), all.end());
  return all;
}

std::string graph(const std::string& nodes, const std::string& publish) {
  std::string text = R"({"format": "kinegraph", "schema": 1, "nodes": {)" + nodes + "}";
  if (!publish.empty()) text += R"(, "publish": {)" + publish + "}";
  return text + "}\n";
}

std::string walk_and_export() {
  return graph(R"("walk": {"type": "Gait", "params": {"seconds": 1}},
                  "out": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "walk.motion"}})",
               R"("params": {"pace": "walk.speed"})");
}

std::string long_warp() {
  return graph(R"("a": {"type": "Gait", "params": {"seconds": 120}},
                  "b": {"type": "Gait", "params": {"gait": "sneak", "seconds": 110}},
                  "warp": {"type": "TimeWarp", "inputs": {"source": "a.motion", "reference": "b.motion"}})",
               R"("outputs": {"warped": "warp.warped"})");
}

std::string check_of(const std::string& rule) {
  return graph(R"("numbers": {"type": "Load", "params": {"file": "metrics.json"}},
                  "judge": {"type": "Check", "params": {"rules": [")" +
               rule + R"("]}, "inputs": {"metrics": "numbers.metrics"}})");
}

std::string metrics_file(double skate) {
  return R"({"format": "kinegraph-metrics", "schema": 1, "metrics": [{"name": "skate", "value": )" +
         std::to_string(skate) +
         R"(, "unit": "m/s"}, {"name": "aligned_distance", "value": null, "unit": "m"}]})";
}

}  // namespace kinegraph
