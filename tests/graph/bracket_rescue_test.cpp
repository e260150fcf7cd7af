// Brackets and quotes that are missing or too many don't hide what else is wrong with a graph file, and
// nothing is told that isn't so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/graph/toy_graphs.h"
#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

ReadResult judged(const std::string& text) {
  ValidateOptions options;
  options.file = "g.kg.json";
  options.check_files = false;
  return read_and_validate(text, toys::registry(), options);
}

// As the canonical form has it, with a misspelled parameter, a rate out of range, an unknown type and a link
// to nowhere.
const std::string canonical = R"({
  "format": "kinegraph",
  "schema": 1,
  "variables": {
    "rate": 24
  },
  "nodes": {
    "clip": {
      "type": "Load",
      "note": "two, three: {four}",
      "params": {
        "flie": "clips/walk.bvh",
        "range": [0, 10]
      }
    },
    "fast": {
      "type": "Load",
      "params": {
        "file": "run.bvh",
        "fps": 9999
      }
    },
    "odd": {
      "type": "Laod",
      "params": {
        "file": "x.bvh"
      }
    },
    "style": {
      "type": "QuatStats",
      "inputs": {
        "motion": "nobody.motion"
      }
    },
    "transfer": {
      "type": "StyleTransfer",
      "params": {
        "edits": [
          {"component": 1, "factor": 2, "op": "scale"},
          {"component": 2, "op": "add"}
        ],
        "weights": {
          "Hips": 2
        }
      },
      "inputs": {
        "motion": "clip.motion",
        "style": "style.stats"
      }
    }
  },
  "publish": {
    "outputs": {
      "result": "transfer.motion"
    }
  },
  "ui": {
    "nodes": {
      "clip": {
        "pos": [0, 0]
      }
    }
  }
}
)";
const std::vector<std::string> its_problems = {"12:9 unknown-param", "20:16 out-of-range",
                                               "24:15 unknown-type", "32:19 unknown-node"};

bool is_of_form(const std::string& told) {
  return told.ends_with(" syntax") || told.ends_with(" trailing-comma");
}
int line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

TEST(BracketRescue, TheExampleHasItsProblemsAndNoOthers) {
  EXPECT_EQ(toys::in_short(judged(canonical).problems), its_problems);
}

// One sign after the other: without it, what else is wrong is told all the same, and nothing besides.
TEST(BracketRescue, WithoutAnyOneSignOfACanonicalFileTheOtherProblemsAreToldAndNoFalseOnes) {
  int left_out = 0;
  for (std::size_t at = 0; at + 2 < canonical.size(); ++at) {
    if (std::string_view("{}[]\",:").find(canonical[at]) == std::string_view::npos) continue;
    const int line = line_of(canonical, at);
    if (line == 10) continue;  // a note may hold any of them
    std::string text = canonical;
    text.erase(at, 1);
    const ReadResult result = judged(text);
    const std::string what = "without " + canonical.substr(at, 1) + " in line " + std::to_string(line) +
                             "\n" + toys::all_text(result.problems);
    int of_form = 0;
    for (const std::string& told : toys::in_short(result.problems)) {
      of_form += is_of_form(told);
      // A problem of a line that is itself broken may be hidden by that.
      if (is_of_form(told)) continue;
      const bool here = told.substr(0, told.find(':')) == std::to_string(line);
      EXPECT_THAT(its_problems,
                  testing::Contains(testing::HasSubstr(here ? told.substr(told.find(' ')) : told)))
          << what;
    }
    EXPECT_EQ(of_form, 1) << what;
    for (const std::string& problem : its_problems)
      if (problem.substr(0, problem.find(':')) != std::to_string(line)) {
        EXPECT_THAT(toys::in_short(result.problems), testing::Contains(problem)) << what;
      }
    ++left_out;
  }
  EXPECT_GT(left_out, 200);
}

TEST(BracketRescue, WithOneBracketTooManyToo) {
  for (std::size_t at = 0; at < canonical.size(); ++at) {
    if ((canonical[at] != '}' && canonical[at] != ']') || line_of(canonical, at) == 10) continue;
    std::string text = canonical;
    text.insert(at, 1, canonical[at]);
    const ReadResult result = judged(text);
    const int line = line_of(canonical, at);
    int of_form = 0;
    for (const std::string& told : toys::in_short(result.problems)) of_form += is_of_form(told);
    EXPECT_GE(of_form, 1) << line << "\n" << toys::all_text(result.problems);
    EXPECT_LE(of_form, 2) << line << "\n" << toys::all_text(result.problems);
    for (const std::string& problem : its_problems)
      EXPECT_THAT(toys::in_short(result.problems), testing::Contains(problem))
          << line << "\n"
          << toys::all_text(result.problems);
    EXPECT_EQ(static_cast<int>(result.problems.size()) - of_form, 4) << line << "\n"
                                                                     << toys::all_text(result.problems);
  }
}

// A download that broke off: of what was there, what is certain is told; never what may still have come.
TEST(BracketRescue, ATextCutOffAnywhereIsToldOnceAndNothingFalse) {
  for (std::size_t length = 1; length + 2 < canonical.size(); ++length) {
    const ReadResult result = judged(canonical.substr(0, length));
    int of_form = 0;
    for (const std::string& told : toys::in_short(result.problems)) {
      of_form += is_of_form(told);
      if (is_of_form(told) || told.ends_with("not-a-graph")) continue;
      EXPECT_THAT(its_problems, testing::Contains(told)) << length << canonical.substr(0, length) << "\n"
                                                         << toys::all_text(result.problems);
    }
    EXPECT_GE(of_form, 1) << canonical.substr(0, length);
    EXPECT_LE(of_form, 2) << canonical.substr(0, length) << "\n" << toys::all_text(result.problems);
    const int last = line_of(canonical, length);
    for (const std::string& problem : its_problems)
      if (std::stoi(problem) < last && !problem.ends_with("unknown-node")) {
        EXPECT_THAT(toys::in_short(result.problems), testing::Contains(problem))
            << canonical.substr(0, length) << "\n"
            << toys::all_text(result.problems);
      }
  }
}

}  // namespace
}  // namespace kinegraph
