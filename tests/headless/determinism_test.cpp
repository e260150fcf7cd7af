// The same bytes on every CPU, of exported files and of all nodes' outputs: each graph runs once as it is,
// once for every vector unit that the program has code for, and once with the C library's functions for old
// CPUs, whose last bits differ.
#include <cstdio>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "program.h"
#include "tests/mocap.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// glibc 2.33 and later spell it so; before, the names ended in _Usable.
constexpr const char* old_libm = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA_Usable,-AVX2_Usable";

class Determinism : public ProgramTest {
 protected:
  // The vector units that this program has code for and this CPU runs.
  std::vector<std::string> cpus() {
    Ran refused = run({"nodes"}, {"KINEGRAPH_CPU=?"});
    EXPECT_EQ(refused.exit, 2);
    const std::string before = "(one of ";
    std::size_t at = refused.err.find(before);
    if (at == std::string::npos) throw std::runtime_error("no list of CPUs: " + refused.err);
    std::istringstream list(refused.err.substr(at + before.size()));
    std::vector<std::string> names;
    for (std::string name; list >> name;) {
      bool last = name.back() == ')';
      name.pop_back();
      names.push_back(name);
      if (last) break;
    }
    return names;
  }

  std::map<std::string, std::string> exported(const std::string& folder) const {
    std::map<std::string, std::string> bytes;
    for (const std::string& name : files())
      if (name.starts_with(folder + "/") && fs::is_regular_file(path(name)))
        bytes[name.substr(folder.size())] = read(name);
    return bytes;
  }

  void runs_the_same_everywhere(const std::string& graph, const std::vector<std::string>& options = {}) {
    SCOPED_TRACE(graph);
    auto run_into = [&](const std::string& out, std::vector<std::string> environment) {
      // The cache holds every node's output to the last bit; an export's decimals would hide it.
      std::vector<std::string> words{"run",     graph,          "--out",      out,
                                     "--cache", out + "/cache", "--progress", "none"};
      words.insert(words.end(), options.begin(), options.end());
      // A failed Check (4) is a result like any other.
      Ran ran = run(words, std::move(environment));
      EXPECT_TRUE(ran.exit == 0 || ran.exit == 4) << ran.err;
      return exported(out);
    };
    const auto usual = run_into("usual", {});
    ASSERT_FALSE(usual.empty());
    std::set<std::vector<std::string>> settings{{old_libm}};
    for (const std::string& cpu : cpus()) settings.insert({"KINEGRAPH_CPU=" + cpu});
    settings.insert({"KINEGRAPH_CPU=" + cpus().back(), old_libm});
    for (const auto& setting : settings) {
      const auto other = run_into("other", setting);
      EXPECT_EQ(usual.size(), other.size()) << testing::PrintToString(setting);
      for (const auto& [name, bytes] : usual)
        EXPECT_TRUE(other.contains(name) && other.at(name) == bytes)
            << name << " differs under " << testing::PrintToString(setting);
      fs::remove_all(path("other"));
    }
    fs::remove_all(path("usual"));
  }
};

TEST_F(Determinism, EveryVectorUnitOfTheCpuCanBeChosen) {
  const auto names = cpus();
  EXPECT_FALSE(names.empty());
  for (const auto& name : names) EXPECT_EQ(run({"nodes"}, {"KINEGRAPH_CPU=" + name}).exit, 0) << name;
  EXPECT_THAT(run({"nodes"}, {"KINEGRAPH_CPU=abacus"}).err, HasSubstr("\"abacus\""));
}

// Else the comparison under it would show nothing. Python's math is the C library's.
TEST_F(Determinism, TheTunableReallyChangesTheCLibrarysLastBits) {
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2"))
    GTEST_SKIP() << "this CPU has no FMA: the C library takes its old functions anyway";
  auto digest = [](const std::string& setting) {
    std::string command =
        setting + " python3 -c 'import math; print(hash(tuple(math.sin(i * .37) for i in range(20000))))'";
    FILE* pipe = popen(command.c_str(), "r");
    char text[64] = {};
    if (!pipe || !fgets(text, sizeof text, pipe)) throw std::runtime_error("no python3");
    pclose(pipe);
    return std::string(text);
  };
  EXPECT_EQ(digest("env"), digest("env"));
  EXPECT_NE(digest("env"), digest(std::string("env ") + old_libm));
}

// Its functions differ in their last bits from CPU to CPU, and from version to version.
TEST_F(Determinism, NoNodeCallsTheCLibrarysFunctions) {
  const std::regex calls(
      R"((std::|[^\w:]::)(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|log2|log10|log1p|pow|hypot|cbrt|fma|erf|erfc|tgamma|lgamma)[fl]?\()");
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() + "/nodes")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    std::ifstream in(entry.path());
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      const std::string code = line.substr(0, line.find("//"));
      EXPECT_FALSE(std::regex_search(code, calls))
          << entry.path() << ":" << number << ": use nodes/motion/elementary.h: " << line;
    }
  }
  EXPECT_GT(files, 50);
}

TEST_F(Determinism, GraphsExportTheSameBytesOnEveryCpu) {
  fs::copy(source_folder() + "/graphs", path("graphs"), fs::copy_options::recursive);
  // The clips that the others read.
  ASSERT_EQ(run({"run", "graphs/sample_clips.kg.json"}).exit, 0);
  std::vector<std::string> graphs;
  for (const auto& entry : fs::directory_iterator(path("graphs")))
    if (entry.path().string().ends_with(".kg.json"))
      graphs.push_back("graphs/" + entry.path().filename().string());
  ASSERT_FALSE(graphs.empty());
  for (const auto& graph : graphs) runs_the_same_everywhere(graph);
}

TEST_F(Determinism, TheMainJobExportsTheSameBytesOnEveryCpu) {
  KINEGRAPH_NEEDS_MOCAP();
  int count = 0;
  for (const auto& entry : fs::directory_iterator(source_folder() + "/tests/main_job")) {
    if (!entry.path().string().ends_with(".kg.json")) continue;
    ++count;
    runs_the_same_everywhere(entry.path().string(), {"--var", "mocap=" + mocap()});
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace kinegraph
