#include "graph/edit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <random>

#include "graph/validate.h"
#include "tests/graph/random_edits.h"
#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

// Everything an edit can touch, a missing node with its own digits among it.
const char* const rich = R"({"format": "kinegraph", "schema": 1,
  "variables": {"clip": "walk"},
  "nodes": {
    "walk": {"type": "Load", "params": {"file": "clips/${clip}.bvh", "fps": 30}, "x-take": 1.50},
    "sneak": {"type": "Load", "note": "low"},
    "style": {"type": "QuatStats", "inputs": {"motion": "sneak.motion"}},
    "transfer": {"type": "StyleTransfer", "inputs": {"motion": "walk.motion", "style": "style.stats"}},
    "dot": {"type": "Dot", "inputs": {"input": "transfer.motion"}},
    "both": {"type": "Concatenate", "inputs": {"motions": ["walk.motion", "dot.output", "walk.motion"]}},
    "future": {"type": "Future", "version": 3, "params": {"a": 1.500, "walk": "walk"},
               "inputs": {"m": "walk.motion", "many": ["both.motion", "walk.motion"]}, "odd": [1E2]},
    "out": {"type": "Export", "enabled": false, "inputs": {"motion": "both.motion"}}},
  "publish": {"params": {"source": "walk.file", "rates": ["walk.fps", "sneak.fps"]},
              "inputs": {"m": ["style.motion", "transfer.motion"]}, "outputs": {"result": "transfer.motion"}},
  "ui": {"nodes": {"walk": {"pos": [10, 20]}, "sneak": {"pos": [0, 0]}, "style": {"pos": [100, 0]}},
         "frames": {"f": {"title": "Clips", "nodes": ["walk", "sneak"]}}, "notes": {"n": {"text": "x", "pos": [1, 1]}}}})";

class Editing : public testing::Test {
 protected:
  std::string text() const { return write_document(document_, registry_); }
  // Applies, and checks that the inverse gives the same bytes back.
  void does(const Edit& edit) {
    const std::string before = text();
    Document there_and_back = document_;
    apply(there_and_back, edit);
    apply(there_and_back, inverse(edit));
    EXPECT_EQ(write_document(there_and_back, registry_), before) << edit.title;
    apply(document_, edit);
  }
  std::string refusal(const std::function<void()>& edit) {
    try {
      edit();
    } catch (const Failure& failure) {
      return failure.diagnostic().code;
    }
    return "allowed";
  }
  std::string link(const std::string& node, const std::string& port) const {
    const auto value = get(document_, {Unit::Kind::node_input, node, port});
    return value ? compact(*value) : "open";
  }

  Registry registry_ = toys::registry();
  Document document_ = toys::document_of(rich, registry_);
};

TEST_F(Editing, RenamingRewritesLinksPublishingAndLayout) {
  does(rename_node(document_, "walk", "stroll"));
  EXPECT_EQ(link("transfer", "motion"), "\"stroll.motion\"");
  EXPECT_EQ(link("both", "motions"), R"(["stroll.motion", "dot.output", "stroll.motion"])");
  EXPECT_EQ(link("future", "m"), "\"stroll.motion\"");
  EXPECT_EQ(link("future", "many"), R"(["both.motion", "stroll.motion"])");
  EXPECT_EQ(document_.publish.params.at("source"), (std::vector<Link>{{"stroll", "file", {}}}));
  EXPECT_EQ(document_.ui.nodes.count("stroll"), 1u);
  EXPECT_EQ(compact(*document_.ui.frames.at("f").find("nodes")), R"(["stroll", "sneak"])");
  std::string remaining = text();
  // Only what isn't this node's name may still say "walk": a variable's value, and a missing node's own
  // parameters.
  EXPECT_THAT(remaining, HasSubstr("\"clip\": \"walk\""));
  EXPECT_THAT(remaining, HasSubstr("\"walk\": \"walk\""));
  EXPECT_EQ(remaining.find("walk."), std::string::npos);
  EXPECT_THAT(remaining, HasSubstr("1.500"));
  EXPECT_THAT(remaining, HasSubstr("\"x-take\": 1.50"));
}

TEST_F(Editing, RenamingAMissingNodeKeepsItMissing) {
  does(rename_node(document_, "future", "later"));
  EXPECT_TRUE(document_.nodes.at("later").missing);
  EXPECT_THAT(text(), HasSubstr("1E2"));
}

TEST_F(Editing, NamesMustBeGoodAndFree) {
  EXPECT_EQ(refusal([&] { rename_node(document_, "walk", "1"); }), "bad-name");
  EXPECT_EQ(refusal([&] { rename_node(document_, "walk", "sneak"); }), "name-taken");
  EXPECT_EQ(refusal([&] { rename_node(document_, "wakl", "x"); }), "unknown-node");
  EXPECT_EQ(refusal([&] { add_node(document_, registry_, "walk", "Load"); }), "name-taken");
  EXPECT_EQ(refusal([&] { add_node(document_, registry_, "x", "Laod"); }), "unknown-type");
  EXPECT_TRUE(rename_node(document_, "walk", "walk").empty());
}

TEST_F(Editing, DeletingTakesLinksPublishingAndLayoutAlong) {
  does(remove_nodes(document_, registry_, {"walk"}, false));
  EXPECT_EQ(link("transfer", "motion"), "open");
  EXPECT_EQ(link("both", "motions"), R"(["dot.output"])");
  EXPECT_EQ(document_.publish.params.count("source"), 0u);
  EXPECT_EQ(document_.publish.params.at("rates"), (std::vector<Link>{{"sneak", "fps", {}}}));
  EXPECT_EQ(document_.ui.nodes.count("walk"), 0u);
  EXPECT_EQ(compact(*document_.ui.frames.at("f").find("nodes")), R"(["sneak"])");
}

// A frame is drawn around its nodes: around none it would stay in the file where nobody sees it.
TEST_F(Editing, AFrameGoesWithTheLastOfItsNodes) {
  does(remove_nodes(document_, registry_, {"walk", "sneak"}, false));
  EXPECT_TRUE(document_.ui.frames.empty());
}

TEST_F(Editing, DeletingReconnectsPastWhatIsPassedOn) {
  does(remove_nodes(document_, registry_, {"transfer", "dot"}, true));
  EXPECT_EQ(link("both", "motions"), R"(["walk.motion", "walk.motion", "walk.motion"])");
  EXPECT_EQ(document_.publish.outputs.at("result"), (std::vector<Link>{{"walk", "motion", {}}}));
}

TEST_F(Editing, TakingOutJoinsTheWires) {
  does(take_out(document_, registry_, "transfer"));
  EXPECT_EQ(link("dot", "input"), "\"walk.motion\"");
  EXPECT_EQ(link("transfer", "motion"), "open");
  EXPECT_EQ(link("transfer", "style"), "open");
  EXPECT_EQ(document_.nodes.count("transfer"), 1u);
}

TEST_F(Editing, InsertingPutsANodeOnALink) {
  does(add_node(document_, registry_, "mid", "Aged"));
  does(insert_on_link(document_, registry_, "mid", "both", "motions", 2));
  EXPECT_EQ(link("mid", "motion"), "\"walk.motion\"");
  EXPECT_EQ(link("both", "motions"), R"(["walk.motion", "dot.output", "mid.motion"])");
  EXPECT_EQ(refusal([&] { insert_on_link(document_, registry_, "style", "transfer", "motion"); }),
            "type-mismatch");
}

TEST_F(Editing, LinksAppendOnAListAndReplaceElsewhere) {
  does(connect(document_, registry_, {"sneak", "motion", {}}, "both", "motions"));
  EXPECT_EQ(link("both", "motions"), R"(["walk.motion", "dot.output", "walk.motion", "sneak.motion"])");
  does(connect(document_, registry_, {"sneak", "motion", {}}, "transfer", "motion"));
  EXPECT_EQ(link("transfer", "motion"), "\"sneak.motion\"");
  does(disconnect(document_, registry_, "both", "motions", 1));
  EXPECT_EQ(link("both", "motions"), R"(["walk.motion", "walk.motion", "sneak.motion"])");
  does(disconnect(document_, registry_, "future", "many", 0));
  EXPECT_EQ(link("future", "many"), R"(["walk.motion"])");
}

TEST_F(Editing, LinksThatDoNotFitAreRefusedWithTheReason) {
  const auto why = [&](const Link& from, const char* node, const char* port) {
    return refusal([&] { connect(document_, registry_, from, node, port); });
  };
  EXPECT_EQ(why({"style", "stats", {}}, "transfer", "motion"), "type-mismatch");
  EXPECT_EQ(why({"both", "motion", {}}, "transfer", "motion"), "cycle");
  EXPECT_EQ(why({"dot", "output", {}}, "dot", "input"), "cycle");
  EXPECT_EQ(why({"walk", "motoin", {}}, "transfer", "motion"), "unknown-port");
  EXPECT_EQ(why({"walk", "motion", {}}, "transfer", "moton"), "unknown-port");
  EXPECT_EQ(why({"wakl", "motion", {}}, "transfer", "motion"), "unknown-node");
  EXPECT_EQ(why({"future", "motion", {}}, "transfer", "motion"), "missing-node");
  // Behind the Dot waits a port that takes motions.
  EXPECT_EQ(why({"style", "stats", {}}, "dot", "input"), "type-mismatch");
  EXPECT_EQ(why({"sneak", "motion", {}}, "dot", "input"), "allowed");
}

TEST_F(Editing, ParametersAreCheckedAndLeftOutAtTheirDefault) {
  does(set_param(document_, registry_, "transfer", "amount", 0.5));
  EXPECT_EQ(document_.nodes.at("transfer").params.at("amount"), Json(0.5));
  does(set_param(document_, registry_, "transfer", "amount", 1));
  EXPECT_EQ(document_.nodes.at("transfer").params.count("amount"), 0u);
  does(set_param(document_, registry_, "transfer", "amount", "${later}"));
  does(reset_param(document_, "transfer", "amount"));
  EXPECT_EQ(document_.nodes.at("transfer").params.count("amount"), 0u);
  EXPECT_EQ(refusal([&] { set_param(document_, registry_, "transfer", "amount", 2); }), "out-of-range");
  EXPECT_EQ(refusal([&] { set_param(document_, registry_, "transfer", "amuont", 1); }), "unknown-param");
  EXPECT_EQ(refusal([&] { set_param(document_, registry_, "transfer", "amount", "${clip}"); }), "wrong-type");
  EXPECT_EQ(refusal([&] { set_param(document_, registry_, "future", "a", 1); }), "missing-node");
}

TEST_F(Editing, PastingGivesFreshNamesKeepsOutsideLinksAndMoves) {
  const Document part = copied(document_, registry_, {"style", "transfer", "walk", "future"});
  EXPECT_EQ(part.variables.count("clip"), 1u);
  std::vector<std::string> names;
  does(paste(document_, registry_, part, 5, -5, &names));
  ASSERT_EQ(names.size(), 4u);
  const auto of_type = [&](const std::string& type) {
    return *std::find_if(names.begin(), names.end(),
                         [&](const auto& n) { return document_.nodes.at(n).type == type; });
  };
  const std::string walk = of_type("Load"), style = of_type("QuatStats"), transfer = of_type("StyleTransfer"),
                    future = of_type("Future");
  EXPECT_THAT(walk, testing::MatchesRegex("load_[a-z0-9][a-z0-9][a-z0-9][a-z0-9]"));
  EXPECT_EQ(link(transfer, "motion"), "\"" + walk + ".motion\"");
  EXPECT_EQ(link(transfer, "style"), "\"" + style + ".stats\"");
  EXPECT_EQ(link(style, "motion"), "\"sneak.motion\"") << "a link to a node outside is kept";
  EXPECT_EQ(link(future, "many"), "[\"both.motion\", \"" + walk + ".motion\"]");
  EXPECT_EQ(compact(document_.ui.nodes.at(walk)), R"({"pos": [15, 15]})");
  EXPECT_TRUE(document_.nodes.at(future).missing);

  document_ = Document();
  does(paste(document_, registry_, part, 0, 0));
  EXPECT_EQ(document_.nodes.size(), 4u);
  EXPECT_EQ(document_.variables.at("clip"), Json("walk")) << "what the part needs comes along";
}

TEST_F(Editing, PastedTextIsAGraphLikeAnyOther) {
  const Document part = copied(document_, registry_, {"walk", "sneak"});
  const std::string clipboard = write_document(part, registry_);
  const Document read = toys::document_of(clipboard, registry_);
  EXPECT_EQ(write_document(read, registry_), clipboard);
  EXPECT_EQ(read.ui.frames.size(), 1u);
}

TEST_F(Editing, AThousandRandomEditsOfEveryKindUndoneGiveTheSameBytes) {
  Document document = toys::document_of(rich, registry_);
  RandomEdits edits(1, registry_);
  History history;
  std::vector<std::string> states{write_document(document, registry_)};
  // New nodes' names end in letters that no seed chooses, so what can be done to the document varies a
  // little.
  for (int i = 0; i < 1000 || (edits.fewest() < 10 && i < 5000); ++i) {
    Edit edit = edits.next(document);
    apply(document, edit);
    history.push(std::move(edit));
    states.push_back(write_document(document, registry_));
  }
  for (int kind = 0; kind < RandomEdits::kinds; ++kind) EXPECT_GE(edits.made(kind), 10) << kind;
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    history.undo(document);
    ASSERT_EQ(write_document(document, registry_), states[i]) << "step " << i;
  }
  for (std::size_t i = 1; i < states.size(); ++i) {
    history.redo(document);
    ASSERT_EQ(write_document(document, registry_), states[i]) << "step " << i;
  }
}

TEST_F(Editing, RandomSequencesFoldedIntoOneStepDoAndUndoTheSame) {
  for (unsigned seed = 100; seed < 140; ++seed) {
    Document document = toys::document_of(rich, registry_);
    const std::string before = write_document(document, registry_);
    RandomEdits edits(seed, registry_);
    Edit all;
    for (int i = 0; i < 25; ++i) {
      const Edit edit = edits.next(document);
      apply(document, edit);
      all = combined(std::move(all), edit);
    }
    Document folded = toys::document_of(rich, registry_);
    apply(folded, all);
    ASSERT_EQ(write_document(folded, registry_), write_document(document, registry_)) << "seed " << seed;
    apply(folded, inverse(all));
    ASSERT_EQ(write_document(folded, registry_), before) << "seed " << seed;
  }
}

TEST_F(Editing, WhatEditsMakeReadsBackAndHasNoBrokenLinks) {
  for (unsigned seed = 200; seed < 220; ++seed) {
    Document document = toys::document_of(rich, registry_);
    RandomEdits edits(seed, registry_);
    for (int i = 0; i < 60; ++i) apply(document, edits.next(document));
    const std::string saved = write_document(document, registry_);
    ReadResult read = read_document(saved, "g", registry_);
    ASSERT_FALSE(has_error(read.problems)) << toys::all_text(read.problems);
    EXPECT_EQ(write_document(read.document, registry_), saved);
    for (const Diagnostic& problem :
         validate(read.document, registry_, {.file = "g", .folder = "/", .check_files = false})) {
      if (problem.param.starts_with("publish.")) continue;  // set at random, not by an edit that knows
      EXPECT_NE(problem.code, "cycle") << to_text(problem);
      EXPECT_NE(problem.code, "unknown-node") << to_text(problem);
      EXPECT_NE(problem.code, "unknown-port") << to_text(problem);
      EXPECT_NE(problem.code, "type-mismatch") << to_text(problem);
    }
  }
}

TEST_F(Editing, ADragIsOneStep) {
  History history;
  for (const double amount : {0.9, 0.8, 0.7}) {
    const Edit edit = set_param(document_, registry_, "transfer", "amount", amount);
    apply(document_, edit);
    amount == 0.9 ? history.push(edit) : history.extend(edit);
  }
  EXPECT_EQ(history.steps().size(), 1u);
  const std::string before = text();
  history.undo(document_);
  EXPECT_EQ(document_.nodes.at("transfer").params.count("amount"), 0u);
  EXPECT_TRUE(history.is_saved());
  history.redo(document_);
  EXPECT_EQ(text(), before);
}

TEST_F(Editing, ADragBackToTheStartLeavesNoStep) {
  History history;
  Edit edit = set_param(document_, registry_, "transfer", "amount", 0.5);
  apply(document_, edit);
  history.push(edit);
  edit = set_param(document_, registry_, "transfer", "amount", 1);
  apply(document_, edit);
  history.extend(edit);
  EXPECT_FALSE(history.can_undo());
}

TEST_F(Editing, HistoryKnowsWhetherTheFileIsSaved) {
  History history;
  const auto note = [&](const char* what) {
    const Edit edit = set_note(document_, "walk", what);
    apply(document_, edit);
    history.push(edit);
  };
  EXPECT_TRUE(history.is_saved());
  note("a");
  EXPECT_FALSE(history.is_saved());
  history.mark_saved();
  note("b");
  history.undo(document_);
  EXPECT_TRUE(history.is_saved());
  history.undo(document_);
  note("c");  // what was saved can't be reached by redo any more
  EXPECT_FALSE(history.is_saved());
  EXPECT_FALSE(history.can_redo());
}

}  // namespace
}  // namespace kinegraph
