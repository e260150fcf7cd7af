// The commands about graph files: validate, fmt, upgrade, dot, explain, files, nodes; and the cache.
#include "program.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

class GraphFiles : public ProgramTest {};

TEST_F(GraphFiles, ValidateTellsEveryProblemWithItsPlace) {
  write("g.kg.json", R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "walk": {
      "type": "Gait",
      "params": {
        "sped": 1,
        "seconds": "long"
      }
    }
  }
}
)");
  Ran ran = run({"validate", "g.kg.json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, IsEmpty());
  EXPECT_THAT(ran.out, HasSubstr("g.kg.json:8:9: error: unknown-param: "));
  EXPECT_THAT(ran.out, HasSubstr("g.kg.json:9:"));
  auto told = nlohmann::json::parse(run({"validate", "--json", "g.kg.json"}).out);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0]["line"], 8);
  EXPECT_EQ(told[0]["node"], "walk");
}

TEST_F(GraphFiles, ValidateAsksForInputFilesUnlessTold) {
  write("g.kg.json", graph(R"("clip": {"type": "Load", "params": {"file": "none.bvh"}})",
                           R"("outputs": {"m": "clip.motion"})"));
  EXPECT_EQ(run({"validate", "g.kg.json"}).exit, 3);
  EXPECT_EQ(run({"validate", "--no-files", "g.kg.json"}).exit, 0);
}

TEST_F(GraphFiles, ValidateFindsNodesThatLackWhatTheyAreFor) {
  write("load.kg.json", graph(R"("l": {"type": "Load"})"));
  Ran ran = run({"validate", "load.kg.json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.out + ran.err, HasSubstr("error: no-file: l.file: no file is named (set file)"));
  EXPECT_EQ(run({"validate", "load.kg.json", "--no-files"}).exit, 0);
  write("open.kg.json",
        graph(R"("l": {"type": "Load"})", R"("params": {"clip": "l.file"}, "outputs": {"o": "l.motion"})"));
  EXPECT_EQ(run({"validate", "open.kg.json"}).exit, 0);  // whoever uses it gives the file
  write("export.kg.json", graph(R"("e": {"type": "Export", "params": {"file": "a.bvh"}})"));
  ran = run({"run", "export.kg.json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, HasSubstr("open-input: e: no input of this Export is linked"));
  write("off.kg.json", graph(R"("e": {"type": "Export", "enabled": false})"));
  EXPECT_EQ(run({"validate", "off.kg.json"}).exit, 0);
}

TEST_F(GraphFiles, APresetIsAGraphOfOneNodeAndValid) {
  write("soft.kg.json", graph(R"("Filter_ab12": {"type": "Filter", "params": {"cutoff": 3}})"));
  Ran ran = run({"validate", "--strict", "soft.kg.json"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_THAT(ran.out, HasSubstr("info: open-input: Filter_ab12.motion: "));
  EXPECT_EQ(run({"run", "soft.kg.json", "--target", "Filter_ab12"}).exit, 3);
  write("broken.kg.json", graph(R"("Filter_ab12": {"type": "Filter", "params": {"cutoff": -3}})"));
  EXPECT_EQ(run({"validate", "broken.kg.json"}).exit, 3);
}

TEST_F(GraphFiles, ValidateStrictCountsWarnings) {
  write("g.kg.json", graph(R"("odd": {"type": "Telepathy"})"));
  EXPECT_EQ(run({"validate", "g.kg.json"}).exit, 0);
  EXPECT_EQ(run({"validate", "--strict", "g.kg.json"}).exit, 3);
}

TEST_F(GraphFiles, ValidateKnowsVariablesFromTheCommandLine) {
  write("g.kg.json", graph(R"("walk": {"type": "Gait", "params": {"seconds": "${length}"}})"));
  EXPECT_EQ(run({"validate", "g.kg.json"}).exit, 3);
  EXPECT_EQ(run({"validate", "g.kg.json", "--var", "length=2"}).exit, 0);
}

TEST_F(GraphFiles, FmtIsIdempotentAndCheckTells) {
  write("g.kg.json", walk_and_export());
  Ran check = run({"fmt", "--check", "g.kg.json"});
  EXPECT_EQ(check.exit, 1);
  EXPECT_EQ(check.out, "g.kg.json\n");
  EXPECT_EQ(check.err, "1 of 1 not in canonical form; `kinegraph fmt` without --check writes it\n");
  EXPECT_EQ(run({"fmt", "g.kg.json"}).exit, 0);
  auto once = read("g.kg.json");
  EXPECT_EQ(run({"fmt", "--check", "g.kg.json"}).exit, 0);
  EXPECT_EQ(run({"fmt", "-"}, {}, walk_and_export()).out, once);
  EXPECT_EQ(run({"fmt", "-"}, {}, once).out, once);
}

TEST_F(GraphFiles, FmtRefusesBrokenAndNewerFilesAndLeavesThemAlone) {
  const std::string broken = "{\"format\": \"kinegraph\",";
  const std::string newer = R"({"format": "kinegraph", "schema": 99, "nodes": {}})";
  write("broken.kg.json", broken);
  write("newer.kg.json", newer);
  EXPECT_EQ(run({"fmt", "broken.kg.json"}).exit, 3);
  EXPECT_EQ(run({"fmt", "newer.kg.json"}).exit, 3);
  EXPECT_EQ(run({"upgrade", "--in-place", "newer.kg.json"}).exit, 3);
  EXPECT_EQ(run({"run", "newer.kg.json"}).exit, 3);
  EXPECT_EQ(read("broken.kg.json"), broken);
  EXPECT_EQ(read("newer.kg.json"), newer);
}

TEST_F(GraphFiles, UpgradeOfACurrentGraphIsItsCanonicalForm) {
  write("g.kg.json", walk_and_export());
  auto canonical = run({"fmt", "-"}, {}, walk_and_export()).out;
  EXPECT_EQ(run({"upgrade", "g.kg.json"}).out, canonical);
  EXPECT_EQ(run({"upgrade", "g.kg.json", "g.kg.json"}).exit, 2);
  EXPECT_EQ(read("g.kg.json"), walk_and_export());
}

TEST_F(GraphFiles, DotIsAGraph) {
  write("g.kg.json", walk_and_export());
  Ran ran = run({"dot", "g.kg.json"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_THAT(ran.out, HasSubstr("digraph"));
  EXPECT_THAT(ran.out, HasSubstr("walk"));
}

TEST_F(GraphFiles, ExplainTellsKeyPartsAndTheCache) {
  write("g.kg.json", walk_and_export());
  Ran cold = run({"explain", "g.kg.json", "walk", "--cache", "cache"});
  EXPECT_EQ(cold.exit, 0);
  EXPECT_THAT(cold.out, HasSubstr("param seconds"));
  EXPECT_THAT(cold.out, HasSubstr("cached  no"));
  ASSERT_EQ(run({"run", "g.kg.json", "--cache", "cache"}).exit, 0);
  EXPECT_THAT(run({"explain", "g.kg.json", "walk", "--cache", "cache"}).out, HasSubstr("cached  disk"));
  EXPECT_THAT(run({"explain", "g.kg.json", "walk", "--cache", "cache", "--set", "walk.seed=3"}).out,
              HasSubstr("cached  no"));
  EXPECT_EQ(run({"explain", "g.kg.json", "wlk"}).exit, 2);
}

TEST_F(GraphFiles, FilesListsReadsAndWrites) {
  write("metrics.json", metrics_file(1));
  write("g.kg.json", graph(R"("numbers": {"type": "Load", "params": {"file": "metrics.json"}},
                             "gone": {"type": "Load", "params": {"file": "gone.bvh"}},
                             "out": {"type": "Export", "params": {"file": "sub/o.csv"}, "inputs": {"metrics": "numbers.metrics"}})"));
  Ran ran = run({"files", "g.kg.json"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_THAT(ran.out, HasSubstr("read   metrics.json"));
  EXPECT_THAT(ran.out, MatchesRegex("(.|\n)*read   gone.bvh  gone  missing\n(.|\n)*"));
  EXPECT_THAT(ran.out, HasSubstr("write  sub/o.csv"));
  auto told = nlohmann::json::parse(run({"files", "--json", "g.kg.json"}).out);
  EXPECT_EQ(told["reads"].size(), 2u);
  EXPECT_EQ(told["writes"][0]["path"], "sub/o.csv");

  write("deep/er/g.kg.json",
        graph(R"("numbers": {"type": "Load", "params": {"file": "../../metrics.json"}})"));
  EXPECT_THAT(run({"files", "deep/er/g.kg.json"}).out, HasSubstr("read   ../../metrics.json"));
}

TEST_F(GraphFiles, NodesIsTheReferenceInThreeForms) {
  EXPECT_THAT(run({"nodes"}).out, HasSubstr("Gait"));
  EXPECT_THAT(run({"nodes", "Gait"}).out, HasSubstr("speed"));
  EXPECT_THAT(run({"nodes", "Gait", "--markdown"}).out, HasSubstr("Gait"));
  EXPECT_EQ(nlohmann::json::parse(run({"nodes", "Gait", "--json"}).out)["name"], "Gait");
  EXPECT_TRUE(nlohmann::json::parse(run({"nodes", "--json"}).out).contains("nodes"));
  Ran slip = run({"nodes", "Gate"});
  EXPECT_EQ(slip.exit, 2);
  EXPECT_THAT(slip.err, HasSubstr("\"Gait\""));
}

TEST_F(GraphFiles, CacheIsCountedCheckedAndCleared) {
  write("g.kg.json", walk_and_export());
  ASSERT_EQ(run({"run", "g.kg.json", "--cache", "cache"}).exit, 0);
  EXPECT_THAT(run({"cache", "stat", "--cache", "cache"}).out, HasSubstr("1 entry"));
  EXPECT_EQ(run({"cache", "verify", "--cache", "cache"}).exit, 0);
  for (const auto& file : files())
    if (file.ends_with(".kgv")) write(file, "spoilt");
  EXPECT_EQ(run({"cache", "verify", "--cache", "cache"}).exit, 1);
  EXPECT_EQ(run({"run", "g.kg.json", "--cache", "cache"}).exit, 0);  // a damaged entry is a miss
  EXPECT_EQ(run({"cache", "gc", "--cache", "cache", "--cache-limit", "1K"}).exit, 0);
  EXPECT_EQ(run({"cache", "clear", "--cache", "cache"}).exit, 0);
  EXPECT_THAT(run({"cache", "stat", "--cache", "cache"}).out, HasSubstr("0 entries"));
  EXPECT_EQ(run({"cache", "stat"}).exit, 2);
}

TEST_F(GraphFiles, VersionAndHelp) {
  Ran version = run({"--version"});
  EXPECT_EQ(version.exit, 0);
  EXPECT_THAT(version.out, MatchesRegex("kinegraph [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_EQ(run({"--help"}).exit, 0);
  for (const char* command : {"run", "get", "validate", "fmt", "upgrade", "dot", "explain", "files", "nodes",
                              "picture", "compare", "cache"}) {
    EXPECT_THAT(run({"--help"}).out, HasSubstr(command));
    EXPECT_EQ(run({command, "--help"}).exit, 0) << command;
  }
}

}  // namespace
}  // namespace kinegraph
