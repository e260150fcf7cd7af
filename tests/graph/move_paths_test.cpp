#include "graph/move_paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using Kind = ParamType::Kind;

const Move next_door{"/home/ada/walks", "/home/ada/runs"};

TEST(MovedPath, ARelativePathStartsAtTheNewFolder) {
  EXPECT_EQ(moved_path("clips/a.bvh", Kind::open_file, next_door), "../walks/clips/a.bvh");
  EXPECT_EQ(moved_path("../runs/a.bvh", Kind::open_file, next_door), "a.bvh");
  EXPECT_EQ(moved_path("clips/${who}.bvh", Kind::open_file, next_door), "../walks/clips/${who}.bvh");
}

TEST(MovedPath, AnAbsolutePathBecomesRelativeWhereItLiesNear) {
  EXPECT_EQ(moved_path("/home/ada/runs/clips/a.bvh", Kind::open_file, next_door), "clips/a.bvh");
  EXPECT_EQ(moved_path("/home/ada/runs/a.bvh", Kind::open_file, {"", "/home/ada/runs"}), "a.bvh");
  EXPECT_EQ(moved_path("/srv/mocap/a.bvh", Kind::open_file, {"", "/home/ada/runs/old/2"}),
            "/srv/mocap/a.bvh");
}

TEST(MovedPath, WhatLiesFarFromTheNewFolderIsNamedInFull) {
  EXPECT_EQ(moved_path("a.bvh", Kind::open_file, {"/srv/mocap", "/home/ada/runs/old"}), "/srv/mocap/a.bvh");
}

TEST(MovedPath, AVariableAtTheStartStays) {
  EXPECT_EQ(moved_path("${clips}/a.bvh", Kind::open_file, next_door), "${clips}/a.bvh");
  EXPECT_EQ(moved_path("", Kind::open_file, next_door), "");
}

TEST(MovedPath, ResultsAreWrittenBesideTheirGraph) {
  EXPECT_EQ(moved_path("out/a.bvh", Kind::save_file, next_door), "out/a.bvh");
  EXPECT_EQ(moved_path("/home/ada/runs/out/a.bvh", Kind::save_file, next_door), "out/a.bvh");
  EXPECT_EQ(moved_path("/home/ada/other/a.bvh", Kind::save_file, next_door), "/home/ada/other/a.bvh");
}

TEST(MovedPath, AFileThatIsOnlyInTheNewFolderIsThatOne) {
  const fs::path folder = fs::path(testing::TempDir()) / "move_paths";
  fs::create_directories(folder / "there");
  std::ofstream(folder / "there" / "a.bvh") << "x";
  const Move move{(folder / "here").string(), (folder / "there").string()};
  EXPECT_EQ(moved_path("a.bvh", Kind::open_file, move), "a.bvh");
  EXPECT_EQ(moved_path("b.bvh", Kind::open_file, move), "../here/b.bvh");
  fs::remove_all(folder);
}

const char* const graph =
    R"({"format": "kinegraph", "schema": 1, "variables": {"clips": "takes", "who": "ada"},
  "nodes": {
    "walk": {"type": "Load", "params": {"file": "clips/a.bvh"}},
    "sneak": {"type": "Load", "params": {"file": "${clips}/${who}.bvh"}},
    "out": {"type": "Export", "params": {"file": "a.bvh"}, "inputs": {"motion": "walk.motion"}}}})";

std::string param(const Document& document, const char* node, const char* name) {
  return document.nodes.at(node).params.find(name)->second.string();
}

TEST(MovePaths, OfADocumentAndTheVariablesThatPathsBeginWith) {
  const Registry registry = toys::registry();
  Document document = toys::document_of(graph, registry);
  move_paths(document, registry, next_door);
  EXPECT_EQ(param(document, "walk", "file"), "../walks/clips/a.bvh");
  EXPECT_EQ(param(document, "sneak", "file"), "${clips}/${who}.bvh");
  EXPECT_EQ(document.variables.at("clips").string(), "../walks/takes");
  EXPECT_EQ(document.variables.at("who").string(), "ada");
  EXPECT_EQ(param(document, "out", "file"), "a.bvh");
}

// Choosing a file, deleting the node: undone after the move both name the file from the new folder.
TEST(MovePaths, OfWhatUndoBringsBack) {
  const Registry registry = toys::registry();
  Document document = toys::document_of(graph, registry);
  History history;
  const auto act = [&](const Edit& edit) {
    apply(document, edit);
    history.push(edit);
  };
  act(set_param(document, registry, "walk", "file", "clips/b.bvh"));
  act(remove_nodes(document, registry, {"walk"}, false));
  move_paths(history, document, registry, next_door);
  move_paths(document, registry, next_door);
  history.undo(document);
  EXPECT_EQ(param(document, "walk", "file"), "../walks/clips/b.bvh");
  history.undo(document);
  EXPECT_EQ(param(document, "walk", "file"), "../walks/clips/a.bvh");
  history.redo(document);
  EXPECT_EQ(param(document, "walk", "file"), "../walks/clips/b.bvh");
}

}  // namespace
}  // namespace kinegraph
