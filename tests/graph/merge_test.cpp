// Diff and merge of graphs: what two people may do to one file, and what comes of it.
#include "graph/file/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "graph/file/conflict_text.h"
#include "graph/file/diff.h"
#include "graph/file/merge_lists.h"
#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string file(const std::string& nodes, const std::string& rest = {}) {
  return R"({"format": "kinegraph", "schema": 1, "nodes": {)" + nodes + "}" + rest + "}";
}
const std::string walk = R"("walk": {"type": "Load", "params": {"file": "walk.bvh"}})";
const std::string sneak = R"("sneak": {"type": "Load", "params": {"file": "sneak.bvh", "fps": 30}})";
const std::string stats = R"("stats": {"type": "QuatStats", "inputs": {"motion": "sneak.motion"}})";
std::string transfer(const std::string& params = {}, const std::string& motion = "walk.motion") {
  return R"("transfer": {"type": "StyleTransfer")" +
         (params.empty() ? "" : ", \"params\": {" + params + "}") + R"(, "inputs": {"motion": ")" + motion +
         R"(", "style": "stats.stats"}})";
}
std::string whole(const std::string& params = {}) {
  return walk + "," + sneak + "," + stats + "," + transfer(params);
}

class MergeTest : public testing::Test {
 protected:
  Document document(const std::string& text) {
    ReadResult read = read_document(text, "test.kg.json", registry_);
    for (const auto& problem : read.problems)
      if (problem.severity == Severity::error) ADD_FAILURE() << to_text(problem);
    return std::move(read.document);
  }
  Merge merged(const std::string& base, const std::string& ours, const std::string& theirs) {
    return merge(document(base), document(ours), document(theirs), registry_);
  }
  std::string canonical(const std::string& text) { return write_document(document(text), registry_); }
  void expect_clean(const std::string& base, const std::string& ours, const std::string& theirs,
                    const std::string& expected) {
    const Merge one = merged(base, ours, theirs), other = merged(base, theirs, ours);
    for (const auto& conflict : one.conflicts) ADD_FAILURE() << conflict.what;
    EXPECT_EQ(one.text, canonical(expected));
    EXPECT_EQ(write_document(one.document, registry_), one.text);
    EXPECT_THAT(other.conflicts, IsEmpty());
  }
  Diff difference(const std::string& a, const std::string& b) { return diff(document(a), document(b)); }

  Registry registry_ = toys::registry();
};

TEST_F(MergeTest, BothSidesAddNodes) {
  const std::string ours = R"("dot_a1b2": {"type": "Dot", "inputs": {"input": "walk.motion"}})";
  const std::string theirs = R"("dot_c3d4": {"type": "Dot", "inputs": {"input": "sneak.motion"}})";
  expect_clean(file(whole()), file(whole() + "," + ours), file(whole() + "," + theirs),
               file(whole() + "," + ours + "," + theirs));
}

TEST_F(MergeTest, DifferentParametersOfOneNode) {
  expect_clean(file(whole()), file(whole(R"("amount": 0.5)")), file(whole(R"("root": "travel")")),
               file(whole(R"("amount": 0.5, "root": "travel")")));
}

TEST_F(MergeTest, TheSameChangeTwiceIsOne) {
  expect_clean(file(whole()), file(whole(R"("amount": 0.5)")), file(whole(R"("amount": 0.50)")),
               file(whole(R"("amount": 0.5)")));
}

TEST_F(MergeTest, TheSameParameterConflictsAndShowsBothValues) {
  const Merge merge = merged(file(whole(R"("amount": 0.1)")), file(whole(R"("amount": 0.5)")),
                             file(whole(R"("amount": 0.25, "root": "none")")));
  ASSERT_THAT(merge.conflicts, SizeIs(1));
  EXPECT_EQ(merge.conflicts[0].what, "transfer.amount: 0.5 here, 0.25 there");
  EXPECT_THAT(merge.text, HasSubstr("<<<<<<< ours\n"
                                    "        \"amount\": 0.5,\n"
                                    "=======\n"
                                    "        \"amount\": 0.25,\n"
                                    ">>>>>>> theirs\n"
                                    "        \"root\": \"none\"\n"));
  EXPECT_EQ(merge.document.nodes.at("transfer").params.at("amount"), Json(0.5));
}

TEST_F(MergeTest, BackToTheDefaultAgainstAChangeConflicts) {
  const Merge merge =
      merged(file(whole(R"("amount": 0.1)")), file(whole()), file(whole(R"("amount": 0.25)")));
  ASSERT_THAT(merge.conflicts, SizeIs(1));
  EXPECT_EQ(merge.conflicts[0].what, "transfer.amount: nothing here, 0.25 there");
}

TEST_F(MergeTest, EditsAndLinksFollowARename) {
  const std::string renamed = R"("stroll": {"type": "Load", "params": {"file": "walk.bvh"}})";
  const std::string edited = R"("walk": {"type": "Load", "params": {"file": "walk.bvh", "fps": 60}})";
  const std::string dot = R"("dot_a1b2": {"type": "Dot", "inputs": {"input": "walk.motion"}})";
  expect_clean(file(whole()), file(renamed + "," + sneak + "," + stats + "," + transfer("", "stroll.motion")),
               file(edited + "," + sneak + "," + stats + "," + transfer() + "," + dot),
               file(R"("stroll": {"type": "Load", "params": {"file": "walk.bvh", "fps": 60}},)" + sneak +
                    "," + stats + "," + transfer("", "stroll.motion") +
                    R"(,"dot_a1b2": {"type": "Dot", "inputs": {"input": "stroll.motion"}})"));
}

TEST_F(MergeTest, PublishedNamesFollowARename) {
  const std::string publish = R"(, "publish": {"outputs": {"result": "transfer.motion"}})";
  const std::string other =
      R"("restyle": {"type": "StyleTransfer", "inputs": {"motion": "walk.motion", "style": "stats.stats"}})";
  expect_clean(
      file(whole(), publish),
      file(walk + "," + sneak + "," + stats + "," + other,
           R"(, "publish": {"outputs": {"result": "restyle.motion"}})"),
      file(whole(R"("amount": 0.5)"), publish),
      file(
          walk + "," + sneak + "," + stats +
              R"(,"restyle": {"type": "StyleTransfer", "params": {"amount": 0.5}, "inputs": {"motion": "walk.motion", "style": "stats.stats"}})",
          R"(, "publish": {"outputs": {"result": "restyle.motion"}})"));
}

TEST_F(MergeTest, TwoNamesForOneNodeConflict) {
  const std::string a = R"("stroll": {"type": "Load", "params": {"file": "walk.bvh"}})";
  const std::string b = R"("amble": {"type": "Load", "params": {"file": "walk.bvh"}})";
  const Merge merge = merged(file(walk), file(a), file(b));
  ASSERT_THAT(merge.conflicts, SizeIs(1));
  EXPECT_EQ(merge.conflicts[0].what, "walk is renamed to stroll here and to amble there");
  EXPECT_TRUE(merge.document.nodes.contains("stroll"));
}

TEST_F(MergeTest, RemovedHereAndChangedThereConflicts) {
  const std::string without = walk + "," + sneak + "," + stats;
  const Merge merge = merged(file(whole()), file(without), file(whole(R"("amount": 0.5)")));
  ASSERT_THAT(merge.conflicts, SizeIs(1));
  EXPECT_EQ(merge.conflicts[0].what, "transfer is removed here and changed there");
  EXPECT_THAT(merge.text, HasSubstr("=======\n"));
  EXPECT_THAT(merge.text, HasSubstr("\"amount\": 0.5"));
  // Removed and left alone is removed.
  expect_clean(file(whole()), file(without), file(whole()), file(without));
}

TEST_F(MergeTest, ListsMergeByElement) {
  const auto joined = [](const std::string& links) {
    return file(walk + "," + sneak + R"(,"all": {"type": "Concatenate", "inputs": {"motions": [)" + links +
                "]}}");
  };
  expect_clean(joined(R"("walk.motion")"), joined(R"("walk.motion", "sneak.motion")"),
               joined(R"("walk.motion", "sneak.motion")"), joined(R"("walk.motion", "sneak.motion")"));
  expect_clean(joined(R"("walk.motion")"), joined(R"("sneak.motion", "walk.motion")"),
               joined(R"("walk.motion", "walk.motion")"),
               joined(R"("sneak.motion", "walk.motion", "walk.motion")"));
  expect_clean(joined(R"("walk.motion", "sneak.motion")"), joined(R"("sneak.motion")"),
               joined(R"("walk.motion", "sneak.motion", "sneak.motion")"),
               joined(R"("sneak.motion", "sneak.motion")"));
}

TEST_F(MergeTest, ElementsOfAListOfObjectsMergeToo) {
  const auto edits = [](const std::string& list) { return file(whole(R"("edits": [)" + list + "]")); };
  const std::string one = R"({"op": "scale", "component": 1, "factor": 2})";
  const std::string one_changed = R"({"op": "scale", "component": 1, "factor": 3})";
  const std::string one_changed_else = R"({"op": "scale", "component": 1, "factor": 4})";
  const std::string two = R"({"op": "add", "component": 2, "factor": 2})";
  const std::string two_changed = R"({"op": "add", "component": 2, "factor": 5})";
  expect_clean(edits(one + "," + two), edits(one_changed + "," + two), edits(one + "," + two_changed),
               edits(one_changed + "," + two_changed));
  const Merge merge =
      merged(edits(one + "," + two), edits(one_changed + "," + two), edits(one_changed_else + "," + two));
  ASSERT_THAT(merge.conflicts, SizeIs(1));
  EXPECT_THAT(merge.conflicts[0].what, HasSubstr("transfer.edits"));
  EXPECT_THAT(merge.text, HasSubstr("<<<<<<< ours\n          {\"component\": 1, \"factor\": 3"));
}

TEST_F(MergeTest, TablesMergeByKey) {
  const auto weights = [](const std::string& table) { return file(whole(R"("weights": {)" + table + "}")); };
  expect_clean(weights(R"("A": 2)"), weights(R"("A": 2, "B": 3)"), weights(R"("A": 4)"),
               weights(R"("A": 4, "B": 3)"));
  EXPECT_THAT(merged(weights(R"("A": 2)"), weights(R"("A": 3)"), weights(R"("A": 4)")).conflicts, SizeIs(1));
}

TEST_F(MergeTest, NotesEnabledVariablesAndPublishingAreUnits) {
  const auto with = [](const std::string& node, const std::string& rest) {
    return file(R"("walk": {"type": "Load")" + node + "}", rest);
  };
  expect_clean(
      with("", R"(, "variables": {"a": 1})"),
      with(R"(, "enabled": false)", R"(, "variables": {"a": 1, "b": 2})"),
      with(R"(, "note": "slow")", R"(, "variables": {"a": 3}, "publish": {"outputs": {"m": "walk.motion"}})"),
      with(R"(, "enabled": false, "note": "slow")",
           R"(, "variables": {"a": 3, "b": 2}, "publish": {"outputs": {"m": "walk.motion"}})"));
  EXPECT_THAT(merged(with("", ""), with(R"(, "note": "a")", ""), with(R"(, "note": "b")", "")).conflicts,
              SizeIs(1));
}

TEST_F(MergeTest, LayoutNeverConflicts) {
  const auto at = [](const char* x) {
    return file(walk, R"(, "ui": {"nodes": {"walk": {"pos": [)" + std::string(x) + ", 0]}}}");
  };
  const Merge merge = merged(at("0"), at("10"), at("20"));
  EXPECT_THAT(merge.conflicts, IsEmpty());
  EXPECT_EQ(merge.text, canonical(at("10")));
  EXPECT_EQ(merged(at("0"), at("0"), at("20")).text, canonical(at("20")));
}

TEST_F(MergeTest, ACycleMadeByBothTogetherConflicts) {
  const auto dots = [](const std::string& a, const std::string& b) {
    return file(R"("a": {"type": "Dot")" + a + R"(}, "b": {"type": "Dot")" + b + "}");
  };
  const Merge merge = merged(dots("", ""), dots(R"(, "inputs": {"input": "b.output"})", ""),
                             dots("", R"(, "inputs": {"input": "a.output"})"));
  ASSERT_THAT(merge.conflicts, SizeIs(1));
  EXPECT_THAT(merge.conflicts[0].what, HasSubstr("circle"));
  EXPECT_THAT(merge.text, HasSubstr("<<<<<<< ours\n"));
}

TEST_F(MergeTest, ALinkToWhatTheOtherSideRemovedConflicts) {
  const std::string dot = R"("dot_a1b2": {"type": "Dot", "inputs": {"input": "sneak.motion"}})";
  for (const bool turned : {false, true}) {
    const std::string removed = file(walk), linked = file(walk + "," + sneak + "," + dot);
    const Merge merge = turned ? merged(file(walk + "," + sneak), linked, removed)
                               : merged(file(walk + "," + sneak), removed, linked);
    ASSERT_THAT(merge.conflicts, SizeIs(1));
    EXPECT_THAT(merge.conflicts[0].what, HasSubstr("there is no node \"sneak\""));
    EXPECT_THAT(merge.text, HasSubstr("<<<<<<< ours\n"));
  }
}

TEST_F(MergeTest, TwoNewExportsOnOneFileConflict) {
  const auto writer = [](const std::string& name) {
    return "," + std::string("\"") + name +
           R"(": {"type": "Export", "params": {"file": "out.bvh"}, "inputs": {"motion": "walk.motion"}})";
  };
  const Merge merge = merged(file(walk), file(walk + writer("out_a1b2")), file(walk + writer("out_c3d4")));
  ASSERT_THAT(merge.conflicts, SizeIs(1));
  EXPECT_THAT(merge.conflicts[0].what, HasSubstr("out.bvh"));
  EXPECT_THAT(merge.text, HasSubstr("<<<<<<< ours\n"));
}

TEST_F(MergeTest, MissingNodesMergeByTheirPartsDigitForDigit) {
  const auto future = [](const std::string& params) {
    return file(R"("f": {"type": "Future", "params": {)" + params + "}}");
  };
  const Merge merge =
      merged(future(R"("a": 1.50, "b": 1)"), future(R"("a": 1.50, "b": 2)"), future(R"("a": 2.50, "b": 1)"));
  EXPECT_THAT(merge.conflicts, IsEmpty());
  EXPECT_THAT(merge.text, HasSubstr("\"a\": 2.50,\n        \"b\": 2\n"));
}

TEST_F(MergeTest, WhatWasWrongBeforeIsNoConflict) {
  const std::string broken = file(walk + R"(,"d": {"type": "Dot", "inputs": {"input": "nobody.motion"}})");
  EXPECT_THAT(merged(broken, broken, broken).conflicts, IsEmpty());
}

TEST_F(MergeTest, MergesAThousandNodes) {
  std::string base, ours;
  for (int i = 0; i < 1000; ++i) {
    const std::string n = std::to_string(i);
    base += (i ? "," : "") + ("\"n" + n) + R"(": {"type": "Load", "params": {"file": ")" + n + ".bvh\"}}";
    ours += (i ? "," : "") + ("\"m" + n) + R"(": {"type": "Load", "params": {"file": ")" + n + ".bvh\"}}";
  }
  const Merge merge = merged(file(base), file(ours), file(base));
  EXPECT_THAT(merge.conflicts, IsEmpty());
  EXPECT_EQ(merge.text, canonical(file(ours)));
}

TEST_F(MergeTest, DiffSpeaksInUnits) {
  const Diff diff = difference(file(whole(R"("amount": 0.5, "heading": false)")),
                               file(whole(R"("amount": 0.25)") + R"(,"d": {"type": "Dot"})"));
  ASSERT_THAT(diff.changes, SizeIs(3));
  EXPECT_EQ(to_text(diff.changes[0].unit), "d");
  EXPECT_EQ(to_text(diff.changes[1].unit), "transfer.amount");
  EXPECT_EQ(diff.changes[1].after, Json(0.25));
  EXPECT_EQ(to_text(diff.changes[2].unit), "transfer.heading");
  EXPECT_EQ(diff.changes[2].after, std::nullopt);
}

TEST_F(MergeTest, DiffSeesARenameAndNotItsLinks) {
  const std::string renamed = R"("stroll": {"type": "Load", "params": {"file": "walk.bvh"}})";
  const Diff diff = difference(
      file(whole()), file(renamed + "," + sneak + "," + stats + "," + transfer("", "stroll.motion")));
  EXPECT_THAT(diff.changes, IsEmpty());
  EXPECT_EQ(diff.renames, (Renames{{"walk", "stroll"}}));
  EXPECT_FALSE(diff.empty());
}

TEST_F(MergeTest, HalfOfTheValuesMakeARenameLessDoNot) {
  const auto load = [](const std::string& name, const std::string& params) {
    return file("\"" + name + R"(": {"type": "Load", "params": {)" + params + "}}");
  };
  EXPECT_THAT(
      difference(load("a", R"("file": "x.bvh", "fps": 30)"), load("b", R"("file": "x.bvh", "fps": 60)"))
          .renames,
      SizeIs(1));
  EXPECT_THAT(difference(load("a", R"("file": "x.bvh", "fps": 30, "unit": "cm")"),
                         load("b", R"("file": "y.bvh", "fps": 60, "unit": "cm")"))
                  .renames,
              IsEmpty());
}

TEST_F(MergeTest, LayoutIsNoDifference) {
  const Diff diff = difference(file(walk), file(walk, R"(, "ui": {"nodes": {"walk": {"pos": [1, 2]}}})"));
  EXPECT_TRUE(diff.empty());
  EXPECT_TRUE(diff.layout);
}

TEST_F(MergeTest, UnitLinesNameTheNodeOnEveryLine) {
  EXPECT_EQ(unit_lines(document(file(whole(R"("amount": 0.5)")))),
            "sneak: Load\nsneak.file = \"sneak.bvh\"\nsneak.fps = 30\n"
            "stats: QuatStats\nstats.motion <- sneak.motion\n"
            "transfer: StyleTransfer\ntransfer.amount = 0.5\ntransfer.motion <- walk.motion\n"
            "transfer.style <- stats.stats\n"
            "walk: Load\nwalk.file = \"walk.bvh\"\n");
}

TEST(ConflictText, MarksOnlyWhatDiffers) {
  EXPECT_EQ(conflict_text("a\nb\nc\nd\ne\n", "a\nB\nc\nd\nE\nf\n", "ours", "theirs"),
            "a\n<<<<<<< ours\nb\n=======\nB\n>>>>>>> theirs\nc\nd\n<<<<<<< ours\ne\n=======\nE\nf\n>>>>>>> "
            "theirs\n");
  EXPECT_EQ(conflict_text("a\nx\nb\n", "a\nb\n", "o", "t"), "a\n<<<<<<< o\nx\n=======\n>>>>>>> t\nb\n");
  EXPECT_EQ(conflict_text("a\n", "a\n", "o", "t"), "a\n");
}

// Taking either side of every region gives that side's text.
TEST(ConflictText, HoldsBothSidesWhole) {
  std::uint32_t state = 7;
  const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 24; };
  for (int round = 0; round < 300; ++round) {
    std::string ours, theirs;
    for (int i = 0; i < 12; ++i) {
      const std::string line(1, static_cast<char>('a' + next() % 5));
      if (next() % 4) ours += line + "\n";
      if (next() % 4) theirs += line + "\n";
    }
    const std::string text = conflict_text(ours, theirs, "o", "t");
    std::string one, other;
    int side = 0;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at) + 1;
      const std::string line = text.substr(at, end - at);
      at = end;
      if (line == "<<<<<<< o\n")
        side = 1;
      else if (line == "=======\n")
        side = 2;
      else if (line == ">>>>>>> t\n")
        side = 0;
      else {
        if (side != 2) one += line;
        if (side != 1) other += line;
      }
    }
    ASSERT_EQ(one, ours);
    ASSERT_EQ(other, theirs);
  }
}

}  // namespace
}  // namespace kinegraph
