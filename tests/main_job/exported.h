// A saved graph run by the real program, and the files that it wrote.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "graph/evaluate/file_store.h"
#include "nodes/files/motion_file.h"
#include "tests/mocap.h"
#include "tests/places.h"

namespace kinegraph {

// In a folder of its own, which goes with it unless the test failed.
class Exported {
 public:
  // `graph`: below the source folder. `more`: further words of the command line. Use ran() before the files.
  Exported(const std::string& graph, const std::string& name, const std::string& more) {
    namespace fs = std::filesystem;
    folder_ = fs::temp_directory_path() / fmt::format("kinegraph_{}_{}", name, ::getpid());
    fs::create_directories(folder_);
    const std::string out = folder_.string();
    const std::string command = fmt::format(
        "'{}/kinegraph' run '{}/{}' --var 'mocap={}' {} --out '{}' --progress none --report '{}/report.json' "
        "> "
        "'{}/log' 2>&1",
        bin_folder(), source_folder(), graph, mocap(), more, out, out, out);
    const int status = std::system(command.c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    std::ifstream log(folder_ / "log");
    std::stringstream text;
    text << log.rdbuf();
    problem_ = command + "\n" + text.str();
  }
  ~Exported() {
    if (!testing::Test::HasFailure()) std::filesystem::remove_all(folder_);
  }
  Exported(const Exported&) = delete;
  Exported& operator=(const Exported&) = delete;

  testing::AssertionResult ran() const {
    return problem_.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << problem_;
  }
  ValuePtr value(const std::string& file, const std::string& port) const {
    FileStore files;
    Alone work;
    MotionFile read = read_motion_file((folder_ / file).string(), {}, files, work);
    for (const FileContent& content : read.contents)
      if (content.port == port) return content.value;
    return nullptr;
  }
  // The first value of its kind; throws where the file has none.
  template <class T>
  std::shared_ptr<const T> read(const std::string& file) const {
    FileStore files;
    Alone work;
    for (const FileContent& content : read_motion_file((folder_ / file).string(), {}, files, work).contents)
      if (auto found = std::dynamic_pointer_cast<const T>(content.value)) return found;
    throw Failure(error("nothing", "no such value in " + file));
  }
  std::shared_ptr<const Motion> motion(const std::string& file) const {
    return std::dynamic_pointer_cast<const Motion>(value(file, "motion"));
  }

 private:
  std::filesystem::path folder_;
  std::string problem_;
};

}  // namespace kinegraph
