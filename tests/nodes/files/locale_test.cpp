// Numbers in files are the same whatever the locale: here one with decimal commas, set in the process itself,
// as a program with a window does.
#include <gtest/gtest.h>

#include <clocale>
#include <locale>

#include "nodes/files/motion_file.h"
#include "tests/german_locale.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/motion/sample_motion.h"
#include "tests/sanitized.h"

#ifdef KINEGRAPH_LEAKS_ARE_WATCHED
#include <sanitizer/lsan_interface.h>
#endif

namespace kinegraph {
namespace {

// glibc's own setlocale never frees the parts of LOCPATH.
class LeaksOfTheSystem {
 public:
#ifdef KINEGRAPH_LEAKS_ARE_WATCHED
  LeaksOfTheSystem() {
    __lsan_disable();
  }
  ~LeaksOfTheSystem() {
    __lsan_enable();
  }
#endif
};

class GermanLocale {
 public:
  GermanLocale() : folder_(german_locale_path()) {
    if (folder_.empty()) return;
    [[maybe_unused]] const LeaksOfTheSystem unwatched;
    setenv("LOCPATH", folder_.c_str(), 1);
    set_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr && *std::localeconv()->decimal_point == ',';
    if (set_) before_ = std::locale::global(std::locale("de_DE.UTF-8"));
  }
  ~GermanLocale() {
    if (set_) std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  bool is_set() const { return set_; }

 private:
  std::string folder_;
  std::locale before_;
  bool set_ = false;
};

// Everything that a file holds, and what comes of writing it in every format that can hold it.
std::string read_and_written(const std::string& path) {
  PlainFiles files;
  Alone work;
  const MotionFile file = read_motion_file(path, {}, files, work);
  std::string all;
  for (const FileContent& content : file.contents) all += encoded(*content.value);
  for (const Diagnostic& one : work.reported) all += to_text(one);
  for (const char* ending : {"bvh", "gltf", "c3d", "trc", "csv"}) {
    const bool holds_points = file.points() != nullptr;
    const bool wants_points = std::string(ending) != "bvh" && std::string(ending) != "gltf";
    if (holds_points != wants_points) continue;
    std::vector<FileContent> contents = {file.contents.front()};
    const EncodedFile written = encode_motion_file(std::string("/x.") + ending, "auto", contents, {}, work);
    all += written.bytes;
    for (const auto& [name, bytes] : written.companions) all += bytes;
  }
  return all;
}

TEST(Locale, NeverMattersToFiles) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::vector<std::string> paths = {mocap("cmu/bvh/08_01.bvh"),
                                          mocap("odd/MS2_8Walk_M.bvh"),
                                          mocap("cmu/asfamc/16_45.amc"),
                                          mocap("gltf/SimpleSkin.gltf"),
                                          mocap("gltf/RiggedFigure.glb"),
                                          mocap("points/cmu_02_01.c3d"),
                                          mocap("points/face_eyebrows.csv"),
                                          mocap("points/std_walking2_markers.trc"),
                                          mocap("odd/derived/glued_numbers.bvh")};
  std::vector<std::string> here;
  for (const std::string& path : paths) here.push_back(read_and_written(path));
  const GermanLocale german;
  if (!german.is_set()) GTEST_SKIP() << "no German locale can be made here: install the package locales";
  for (std::size_t i = 0; i < paths.size(); ++i)
    EXPECT_TRUE(read_and_written(paths[i]) == here[i]) << paths[i];
}

}  // namespace
}  // namespace kinegraph
