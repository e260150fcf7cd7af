// The real program under a locale whose decimal sign is the comma: files, graphs and numbers of the command
// line.
#include "program.h"
#include "tests/german_locale.h"

namespace kinegraph {
namespace {

class ProgramLocale : public ProgramTest {
 protected:
  ProgramLocale() : locale_(german_locale_path()) {}
  ~ProgramLocale() override {
    if (!locale_.empty()) std::filesystem::remove_all(locale_);
  }
  std::vector<std::string> german() const {
    return {"LOCPATH=" + locale_, "LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8"};
  }
  std::string locale_;
};

TEST_F(ProgramLocale, NeverMatters) {
  if (locale_.empty()) GTEST_SKIP() << "no German locale can be made here: install the package locales";
  write("g.kg.json", graph(R"("walk": {"type": "Gait", "params": {"seconds": 1.5, "speed": 1.25}},
      "filter": {"type": "Filter", "params": {"cutoff": 7.5}, "inputs": {"motion": "walk.motion"}},
      "style": {"type": "QuatStats", "inputs": {"motion": "walk.motion"}},
      "bvh": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "filter.motion"}},
      "glb": {"type": "Export", "params": {"file": "walk.gltf"}, "inputs": {"motion": "filter.motion"}},
      "json": {"type": "Export", "params": {"file": "style.json"}, "inputs": {"stats": "style.stats"}},
      "csv": {"type": "Export", "params": {"file": "style.csv"}, "inputs": {"stats": "style.stats"}})"));
  auto everything = [&](const std::vector<std::string>& environment) {
    std::string all;  // what they say and leave
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"fmt", "g.kg.json"},
             {"run", "g.kg.json", "--set", "filter.cutoff=6.25", "--out", "out", "--progress", "none"},
             {"info", "out/walk.bvh"},
             {"info", "out/walk.gltf", "--json"},
             {"convert", "out/walk.bvh", "out/slow.bvh", "--fps", "47.5", "--out-unit", "0.25"},
             {"compare", "out/walk.bvh", "out/walk.gltf", "--rule", "difference.position_max < 1.5e-3"}}) {
      const Ran ran = run(arguments, environment);
      EXPECT_EQ(ran.exit, 0) << arguments[0] << ": " << ran.err;
      all += ran.out;
    }
    for (const char* file : {"g.kg.json", "out/walk.bvh", "out/walk.gltf", "out/walk.bin", "out/style.json",
                             "out/style.csv", "out/slow.bvh"})
      all += read(file);
    return all;
  };
  const std::string plain = everything({"LC_ALL=C"});
  EXPECT_TRUE(everything(german()) == plain);
  EXPECT_THAT(read("g.kg.json"), testing::HasSubstr("\"cutoff\": 7.5"));
  EXPECT_THAT(read("out/slow.bvh"), testing::HasSubstr("Frame Time: 0.021"));
}

}  // namespace
}  // namespace kinegraph
