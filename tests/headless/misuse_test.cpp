// Slips on the command line: each says what is wrong, where, and what to do, and leaves files as they were.
#include <filesystem>

#include "program.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Slip {
  const char* name;
  std::vector<std::string> arguments;
  int exit;
  std::vector<std::string> said;
};
void PrintTo(const Slip& slip, std::ostream* out) {
  *out << slip.name;
}

const std::string ones(400, '1');

const Slip slips[] = {
    {"OptionThatIsNotThere",
     {"fmt", "--chek", "g.kg.json"},
     2,
     {"bad-option", "--chek", "did you mean --check?", "kinegraph fmt --help"}},
    {"OptionMisspelledBeforeItsValue",
     {"run", "g.kg.json", "--thread", "2"},
     2,
     {"there is no option --thread ", "did you mean --threads?"}},
    {"ReportOntoTheGraph",
     {"run", "g.kg.json", "--report", "./g.kg.json"},
     2,
     {"writes-onto-input: --report ./g.kg.json", "is a graph of this run", "a file of its own"}},
    {"JunitOntoTheClip",
     {"run", "g.kg.json", "--junit", "walk.bvh"},
     2,
     {"writes-onto-input: --junit walk.bvh", "is read by walk"}},
    {"PageOntoTheExport",
     {"run", "g.kg.json", "--html", "o.bvh"},
     2,
     {"writes-onto-input: --html o.bvh", "is written by out"}},
    {"ReportsIntoOneFile",
     {"run", "g.kg.json", "--report", "r", "--junit", "r"},
     2,
     {"writes-onto-input: --junit r", "is what --report names"}},
    {"ReportOfABatchOntoItsGraph",
     {"batch", "g.kg.json", "--each", "walk.file=walk.*", "--out", "b", "--report", "g.kg.json"},
     2,
     {"writes-onto-input: --report g.kg.json"}},
    {"PointWithoutAnOutput", {"run", "g.kg.json", "--target", "walk."}, 2, {"\"walk.\" names no output"}},
    {"NoNameOfAGraph", {"run", ""}, 3, {"missing-file", "name a graph file"}},
    {"NoNameOfAFile", {"info", ""}, 3, {"error: "}},
    {"LinkThatLeadsNowhere",
     {"run", "dangling"},
     3,
     {"dangling: error: missing-file", "is a link to \"gone\""}},
    {"ClipThatIsALinkThatLeadsNowhere",
     {"run", "g.kg.json", "--set", "walk.file=dangling"},
     1,
     {"missing-file: walk.file", "is a link to \"gone\""}},
    {"OptionOfAnotherCommand",
     {"validate", "g.kg.json", "--frames", "9"},
     2,
     {"no option --frames", "kinegraph validate --help"}},
    {"NoGraph", {"run"}, 2, {"error: bad-option: GRAPH is required", "kinegraph run --help"}},
    {"NoCommand", {"cache"}, 2, {"kinegraph cache needs a command", "stat"}},
    {"TimeoutInWords",
     {"run", "g.kg.json", "--timeout", "soon"},
     2,
     {"--timeout: \"soon\" can't be read", "a number"}},
    {"TimeoutThatIsNoNumber", {"run", "g.kg.json", "--timeout", "nan"}, 2, {"--timeout", "seconds"}},
    {"MoreThreadsThanAnyMachineHas",
     {"run", "g.kg.json", "--threads", "99999999"},
     2,
     {"--threads can't be more", "1024"}},
    {"RateOutOfRange", {"convert", "walk.bvh", "o.bvh", "--fps", "-3"}, 2, {"--fps", "not in range"}},
    {"OneWordTooMany", {"info", "walk.bvh", "run.bvh"}, 2, {"run.bvh is one word too many"}},
    {"FolderOfACacheAsAWord",
     {"cache", "stat", "folder"},
     2,
     {"folder is one word too many", "the folder goes after --cache"}},
    {"SecondTargetAsAWord",
     {"run", "g.kg.json", "--target", "walk", "out"},
     2,
     {"out is one word too many", "repeat --target before each"}},
    {"UnitOfATable",
     {"convert", "walk.bvh", "o.csv", "--out-unit", "cm"},
     2,
     {"no-unit: --out-unit cm", "csv are metres", "bvh, c3d, trc"}},
    {"UnitWithoutANameInATrc",
     {"convert", "walk.bvh", "o.trc", "--out-unit", "0.25"},
     2,
     {"no-unit: --out-unit 0.25", "name one: m, cm"}},
    {"UnitOfAGltf", {"convert", "walk.bvh", "o.glb", "--out-unit", "0.01"}, 2, {"no-unit", "glb are metres"}},
    {"LongNumber",
     {"run", "g.kg.json", "--set", "walk.fps=" + ones},
     2,
     {"bad-value: walk.fps: \"1111", "1…", "wanted is a number"}},
    {"LongFrame",
     {"run", "g.kg.json", "--set", "walk.range=" + ones + ":"},
     2,
     {"bad-value: walk.range: \"1111", "1…", "[start, end]"}},
    {"MissingGraph",
     {"run", "h.kg.json"},
     3,
     {"h.kg.json: error: missing-file", "did you mean \"g.kg.json\"?"}},
    {"MotionInsteadOfAGraph",
     {"run", "walk.bvh"},
     3,
     {"walk.bvh:1:1: error: not-a-graph", "HIERARCHY", "kinegraph info"}},
    {"FolderInsteadOfAGraph", {"fmt", "."}, 3, {"not-a-regular-file", "*.kg.json"}},
    {"GraphInsteadOfAMotion",
     {"convert", "g.kg.json", "o.bvh"},
     3,
     {"g.kg.json:1:1", "this is a graph", "kinegraph get"}},
    {"ConvertedOntoItself",
     {"convert", "walk.bvh", "./walk.bvh"},
     3,
     {"writes-onto-input", "walk.bvh", "name another"}},
    {"ConvertedToNoFormat", {"convert", "walk.bvh", "o.xyz"}, 3, {"o.xyz: error: unknown-format", "bvh"}},
    {"PackedIntoAFile",
     {"pack", "g.kg.json", "-o", "walk.bvh"},
     3,
     {"not-a-folder", "walk.bvh", "-o names the folder"}},
    {"EachOfNothing",
     {"batch", "g.kg.json", "--each", "walk.fps=[3,5]", "--out", "b"},
     2,
     {"no-match", "--table"}},
    {"EachOfAParameterThatIsNotThere",
     {"batch", "g.kg.json", "--each", "walk.flie=*.bvh", "--out", "b"},
     2,
     {"--each walk.flie", "did you mean \"file\"?"}},
    {"ColumnThatIsNotThere",
     {"batch", "g.kg.json", "--table", "column.csv", "--out", "b"},
     2,
     {"column.csv:2:1: error: unknown-param", "column walk.flie", "did you mean \"file\"?"}},
    {"ValueInATable",
     {"batch", "g.kg.json", "--table", "value.csv", "--out", "b"},
     2,
     {"value.csv:3:1: error: bad-value", "walk.fps", "\"fast\""}},
    {"ShortRowOfATable",
     {"batch", "g.kg.json", "--table", "short.csv", "--out", "b"},
     2,
     {"short.csv:3:1: error: bad-table", "1 fields, the header 2"}},
    {"TableThatIsAFolder",
     {"batch", "g.kg.json", "--table", ".", "--out", "b"},
     2,
     {"missing-file: the table '.' can't be read"}},
    {"TableThatIsNotThere",
     {"batch", "g.kg.json", "--table", "no.csv", "--out", "b"},
     2,
     {"'no.csv' can't be read", "current folder"}},
    {"ReportThatIsNotThere",
     {"batch", "--merge-reports", "no.json", "-o", "m.json"},
     3,
     {"'no.json' can't be read", "--report"}},
    {"CacheThatIsNotThere", {"cache", "stat", "--cache", "none"}, 0, {"missing-folder", "'none'"}},
};

class Misuse : public ProgramTest, public testing::WithParamInterface<Slip> {};

TEST_P(Misuse, IsToldAndHarmsNothing) {
  write("make.kg.json", graph(R"("walk": {"type": "Gait", "params": {"seconds": 0.2}},
    "out": {"type": "Export", "params": {"file": "walk.bvh"}, "inputs": {"motion": "walk.motion"}})"));
  ASSERT_EQ(run({"run", "make.kg.json"}).exit, 0);
  write("g.kg.json", graph(R"("walk": {"type": "Load", "params": {"file": "walk.bvh"}},
    "out": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "walk.motion"}})"));
  std::filesystem::create_symlink("gone", path("dangling"));
  write("column.csv", "walk.flie,walk.fps\nwalk.bvh,30\n");
  write("value.csv", "walk.file,walk.fps\n\nwalk.bvh,fast\n");
  write("short.csv", "walk.file,walk.fps\nwalk.bvh,30\nwalk.bvh\n");
  const std::string walk = read("walk.bvh");
  const Ran ran = run(GetParam().arguments);
  EXPECT_EQ(ran.exit, GetParam().exit) << ran.err;
  for (const std::string& part : GetParam().said) EXPECT_THAT(ran.err, HasSubstr(part));
  EXPECT_THAT(ran.err, Not(HasSubstr(path("")))) << "paths are told as they were typed";
  for (std::size_t start = 0; start < ran.err.size(); start = ran.err.find('\n', start) + 1)
    EXPECT_LT(ran.err.find('\n', start) - start, 400u) << "no message is endless";
  EXPECT_EQ(read("walk.bvh"), walk);
  EXPECT_FALSE(exists("o.bvh"));
  EXPECT_FALSE(exists("b"));
}

INSTANTIATE_TEST_SUITE_P(Table, Misuse, testing::ValuesIn(slips),
                         [](const auto& slip) { return std::string(slip.param.name); });

}  // namespace
}  // namespace kinegraph
