// Slips of the hand in the JSON itself don't hide what else is wrong with a graph file: each is told in its
// place, and the rest is judged as it was meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "graph/file/parse_json.h"
#include "graph/validate.h"
#include "tests/graph/toy_graphs.h"
#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

struct Slip {
  const char* name;
  const char* text;  // of line 3, inside the params of a Load
  std::vector<std::string> told;
};
void PrintTo(const Slip& slip, std::ostream* out) {
  *out << slip.name;
}

ReadResult judged(const std::string& text) {
  ValidateOptions options;
  options.file = "g.kg.json";
  options.check_files = false;
  return read_and_validate(text, toys::registry(), options);
}

// Line 2 has an unknown type, line 4 a misspelled parameter and a rate out of range.
std::string between_mistakes(const std::string& line) {
  return "{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {\n\"z\": {\"type\": \"Laod\"},\n" + line +
         "\n\"b\": {\"type\": \"Load\", \"params\": {\"flie\": \"x\", \"fps\": 9999}}}}";
}

const Slip slips[] = {
    {"NotANumber", R"("a": {"type": "Load", "params": {"fps": NaN}},)", {"3:41 not-finite"}},
    {"MinusInfinity", R"("a": {"type": "Load", "params": {"fps": -Infinity}},)", {"3:41 not-finite"}},
    {"TooLarge", R"("a": {"type": "Load", "params": {"fps": 1e999}},)", {"3:41 not-finite"}},
    {"NotANumberInARange", R"("a": {"type": "Load", "params": {"range": [5, NaN]}},)", {"3:47 not-finite"}},
    {"LeadingZero", R"("a": {"type": "Load", "params": {"fps": 024}},)", {"3:41 bad-number"}},
    {"NoDigitBeforeThePoint", R"("a": {"type": "Load", "params": {"fps": .5}},)", {"3:41 bad-number"}},
    {"NoDigitAfterThePoint", R"("a": {"type": "Load", "params": {"fps": 5.}},)", {"3:41 bad-number"}},
    {"Plus", R"("a": {"type": "Load", "params": {"fps": +5}},)", {"3:41 bad-number"}},
    {"Hexadecimal", R"("a": {"type": "Load", "params": {"fps": 0x1F}},)", {"3:41 bad-number"}},
    {"NumberWithAUnit", R"("a": {"type": "Load", "params": {"fps": 24Hz}},)", {"3:41 bad-number"}},
    {"TwoPoints", R"("a": {"type": "Load", "params": {"fps": 1.2.3}},)", {"3:41 bad-number"}},
    {"DecimalComma", R"("a": {"type": "Load", "params": {"fps": 23,976}},)", {"3:44 syntax"}},
    {"TrailingComma",
     R"("a": {"type": "Load", "params": {"fps": 24,},},)",
     {"3:43 trailing-comma", "3:45 trailing-comma"}},
    {"TrailingCommaInAList",
     R"("a": {"type": "Load", "params": {"range": [1, 9,]}},)",
     {"3:48 trailing-comma"}},
    {"NoComma", R"("a": {"type": "Load" "params": {"fps": 24}})", {"3:22 syntax", "4:1 syntax"}},
    {"NoCommaInAList", R"("a": {"type": "Load", "params": {"range": [1 9]}},)", {"3:46 syntax"}},
    {"Semicolon", R"("a": {"type": "Load"; "params": {"fps": 24;}},)", {"3:21 syntax", "3:43 syntax"}},
    {"TwoCommas", R"("a": {"type": "Load",, "params": {"fps": 24}},)", {"3:22 syntax"}},
    {"LeadingComma",
     R"("a": {, "type": "Load", "params": {"range": [,1, 9]}},)",
     {"3:7 syntax", "3:46 syntax"}},
    {"NoColon", R"("a": {"type" "Load", "params": {"fps" 24}},)", {"3:14 syntax", "3:39 syntax"}},
    {"EqualsSign", R"("a": {"type" = "Load"},)", {"3:14 syntax"}},
    {"NoValue", R"("a": {"type": "Load", "params": {"fps": , "unit": }},)", {"3:41 syntax", "3:51 syntax"}},
    {"SingleQuotes",
     R"('a': {'type': 'Load', "params": {"fps": 24}},)",
     {"3:1 syntax", "3:7 syntax", "3:15 syntax"}},
    {"BareWords",
     R"(a: {type: Load, params: {fps: 24}},)",
     {"3:1 syntax", "3:5 syntax", "3:11 syntax", "3:17 syntax", "3:26 syntax"}},
    {"PythonsWords",
     R"("a": {"type": "Load", "enabled": True, "params": {"range": [0, None]}},)",
     {"3:34 syntax", "3:64 syntax"}},
    {"Comments",
     R"("a": {"type": "Load", /* é */ "params": {"fps": 24}}, // the walk)",
     {"3:23 comment", "3:55 comment"}},
    {"CommentAfterTheLastComma",
     R"("a": {"type": "Load", "params": {"fps": 24, # as filmed
}},)",
     {"3:43 trailing-comma", "3:45 comment"}},
    {"BrokenEscape",
     R"("a": {"type": "Load", "params": {"file": "..\clips\walk.bvh"}},)",
     {"3:42 backslash-path", "3:45 syntax"}},
    {"TabInAString", "\"a\": {\"type\": \"Load\", \"note\": \"one\ttwo\"},", {"3:35 syntax"}},
    {"NotUtf8", "\"a\": {\"type\": \"Load\", \"note\": \"caf\xE9, caf\xE9\"},", {"3:35 bad-utf8"}},
    {"UnreadVersion", R"("a": {"type": "Load", "version": 0x1},)", {"3:34 bad-number"}},
    {"UnreadVariable",
     R"("a": {"type": "Load", "params": {"fps": "${rate}"}}}, "variables": {"rate": NaN}, "nodes": {)",
     {"3:77 not-finite", "3:83 duplicate-key"}},
    // With more than one meaning: the likeliest is taken, and of the line no more is told.
    {"StringOverTwoLines", "\"a\": {\"type\": \"Load\", \"note\": \"one\ntwo\"},", {"3:31 syntax"}},
    {"UnclosedString", R"("a": {"type": "Load", "note": "one, "enabled": true},)", {"3:31 syntax"}},
    {"UnclosedStringAtTheEndOfTheLine", R"("a": {"type": "Load", "note": "one},)", {"3:31 syntax"}},
    {"UnclosedName", R"("a": {"type: "Load", "note": "one"},)", {"3:7 syntax"}},
    {"UnopenedString", R"("a": {"type": Load", "note": "one"},)", {"3:15 syntax"}},
    {"QuotesInAString", R"("a": {"type": "Load", "note": "say "hello" to"},)", {"3:31 syntax"}},
    {"UnclosedObject", R"("a": {"type": "Load",)", {"4:1 syntax"}},
    {"UnclosedObjects", R"("a": {"type": "Load", "params": {"fps": 24)", {"4:1 syntax"}},
    {"UnclosedList", R"("a": {"type": "Load", "params": {"range": [0, 1}},)", {"3:48 syntax"}},
    {"UnopenedList", R"("a": {"type": "Load", "params": {"range": 0, 1]}},)", {"3:46 syntax"}},
    {"UnopenedObject", R"("a": {"type": "Load", "params": "fps": 24}},)", {"3:33 syntax"}},
    {"BracketOfTheOtherKind", R"("a": {"type": "Load", "params": {"range": [0, 1}}},)", {"3:48 syntax"}},
    {"ClosedTwice", R"("a": {"type": "Load"}},)", {"3:22 syntax"}},
    {"ANameAlone", R"("a": {"type": "Load", "note", "enabled": true},)", {"3:29 syntax"}},
    {"CommentThatNeverEnds", "/* the walk", {"3:1 comment"}},
};

class ReadPast : public testing::TestWithParam<Slip> {};

TEST_P(ReadPast, TheSlipAndTheRestOfTheFileAreToldTogether) {
  const std::string text = between_mistakes(GetParam().text);
  const int more = static_cast<int>(std::count(text.begin(), text.end(), '\n')) - 3;
  std::vector<std::string> told = {"2:15 unknown-type"};
  told.insert(told.end(), GetParam().told.begin(), GetParam().told.end());
  const std::string last = std::to_string(4 + more) + ":";
  if (GetParam().name != std::string("UnreadVariable")) {
    told.push_back(last + "34 unknown-param");
    told.push_back(last + "54 out-of-range");
  }
  const ReadResult result = judged(text);
  EXPECT_EQ(toys::in_short(result.problems), told) << text << "\n" << toys::all_text(result.problems);
}

INSTANTIATE_TEST_SUITE_P(Table, ReadPast, testing::ValuesIn(slips),
                         [](const auto& slip) { return std::string(slip.param.name); });

TEST(ReadPastMistakes, OfAWindowsEditorsMarkColumnsAreThoseOfTheText) {
  EXPECT_EQ(toys::in_short(judged("\xEF\xBB\xBF{\"format\": \"kinegraph\", \"schema\": 0}").problems),
            (std::vector<std::string>{"1:1 byte-order-mark", "1:35 bad-version"}));
}

TEST(ReadPastMistakes, OfConflictsTheFirstSideIsJudgedAndEachIsTold) {
  const std::string conflict =
      "<<<<<<< ours\n\"a\": {\"type\": \"Load\", \"nte\": \"\"},\n||||||| base\n\"a\": 1,\n=======\n"
      "\"a\": {\"type\": \"Load\", \"params\": {\"fps\": 9999}},\n>>>>>>> theirs";
  EXPECT_EQ(toys::in_short(judged(between_mistakes(conflict + "\n" + conflict)).problems),
            (std::vector<std::string>{"2:15 unknown-type", "3:1 conflict-markers", "4:23 unknown-key",
                                      "10:1 conflict-markers", "11:1 duplicate-key", "17:34 unknown-param",
                                      "17:54 out-of-range"}));
}

// "new" is linked outside the conflict, and only the second side holds it; the other way round the second
// side has no "old".
TEST(ReadPastMistakes, WhatOnlyFollowsFromAConflictsSidesIsNotTold) {
  const std::string text =
      "{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {\n<<<<<<< ours\n\"old\": {\"type\": "
      "\"Load\"},\n"
      "=======\n\"new\": {\"type\": \"Load\"},\n>>>>>>> theirs\n"
      "\"s\": {\"type\": \"QuatStats\", \"inputs\": {\"motion\": \"new.motion\"}},\n"
      "\"t\": {\"type\": \"QuatStats\", \"inputs\": {\"motion\": \"nobody.motion\"}}}}";
  EXPECT_EQ(toys::in_short(judged(text).problems),
            (std::vector<std::string>{"2:1 conflict-markers", "8:49 unknown-node"}));
}

// Somebody took one of the markers out, and where the sides begin and end can't be told.
TEST(ReadPastMistakes, OfAConflictWithoutAllOfItsMarkersWhatIsCertainIsTold) {
  const std::string ours = "\"a\": {\"type\": \"Load\"},\n",
                    theirs = "\"a\": {\"type\": \"Load\", \"note\": \"\"},";
  using Told = std::vector<std::string>;
  EXPECT_EQ(toys::in_short(judged(between_mistakes("<<<<<<< ours\n" + ours + "=======\n" + theirs)).problems),
            (Told{"2:15 unknown-type", "3:1 conflict-markers", "7:34 unknown-param", "7:54 out-of-range"}));
  EXPECT_EQ(
      toys::in_short(judged(between_mistakes(ours + "=======\n" + theirs + "\n>>>>>>> theirs")).problems),
      (Told{"2:15 unknown-type", "4:1 conflict-markers", "6:1 conflict-markers", "7:34 unknown-param",
            "7:54 out-of-range"}));
}

TEST(ReadPastMistakes, OfATextWithZerosEachLineThatHoldsThemIsTold) {
  using namespace std::string_literals;
  EXPECT_EQ(toys::in_short(judged(between_mistakes("\"a\": \0\0{\"type\":\0\"Load\"},"s)).problems),
            (std::vector<std::string>{"2:15 unknown-type", "3:6 bad-character", "4:34 unknown-param",
                                      "4:54 out-of-range"}));
  // What a crash leaves behind.
  const std::string text = between_mistakes("") + std::string(40'000, '\0');
  EXPECT_EQ(toys::in_short(judged(text).problems),
            (std::vector<std::string>{"2:15 unknown-type", "4:34 unknown-param", "4:54 out-of-range",
                                      "4:62 bad-character"}));
}

// A path, a node's name and the links to it: they are misspelled by those bytes alone.
TEST(ReadPastMistakes, OfNamesWithBytesThatCannotBeReadNothingElseIsTold) {
  using namespace std::string_literals;
  for (const std::string& bad : {"\xFC"s, "\0"s, "\x1B"s}) {
    const auto told = toys::in_short(
        judged(between_mistakes(
                   "\"gr" + bad + "n\": {\"type\": \"Load\", \"params\": {\"f" + bad + "s\": 1}},\n\"s\": " +
                   "{\"type\": \"QuatStats\", \"inputs\": {\"motion\": \"gr" + bad + "n.motion\"}},"))
            .problems);
    const std::string code = bad == "\xFC" ? " bad-utf8" : " bad-character";
    EXPECT_EQ(told, (std::vector<std::string>{"2:15 unknown-type", "3:4" + code, "4:52" + code,
                                              "5:34 unknown-param", "5:54 out-of-range"}));
  }
}

TEST(ReadPastMistakes, BlanksOfOtherProgramsAreNamed) {
  for (const char* blank : {"\u00A0", "\u200B", "\u3000", "\uFEFF", "\f", "\v"}) {
    const ReadResult result = judged(
        between_mistakes(std::string("\"a\":") + blank + "{\"type\": \"Load\", \"note\": \"\u00A0\"},"));
    EXPECT_EQ(toys::in_short(result.problems),
              (std::vector<std::string>{"2:15 unknown-type", "3:5 bad-character", "4:34 unknown-param",
                                        "4:54 out-of-range"}));
    EXPECT_EQ(result.document.nodes.at("a").note, "\u00A0");
  }
}

TEST(ReadPastMistakes, QuotesOfWordProcessorsAreReadAsMeant) {
  const ReadResult result = judged(between_mistakes(
      "\u201Ca\u201D: {\u201Etype\u201D: \"Load\", \"note\": \"a \u201Cslow\u201D walk\"},"));
  EXPECT_EQ(toys::in_short(result.problems),
            (std::vector<std::string>{"2:15 unknown-type", "3:1 bad-character", "4:34 unknown-param",
                                      "4:54 out-of-range"}));
  EXPECT_EQ(result.document.nodes.at("a").note, "a \u201Cslow\u201D walk");
}

// A slip of the hand in "format" is no reason to stop; a file of another kind is.
TEST(ReadPastMistakes, OfAFileOfAnotherKindOnlyThatIsTold) {
  using Told = std::vector<std::string>;
  EXPECT_EQ(toys::in_short(judged(R"({"format": "kinegraph-report", "schema": 1, "exit": 0})").problems),
            (Told{"1:12 not-a-graph"}));
  EXPECT_EQ(toys::in_short(judged(R"({"format": "kinegrph", "schema": 1, "nodse": {}})").problems),
            (Told{"1:12 not-a-graph", "1:37 unknown-key"}));
  EXPECT_EQ(toys::in_short(judged("<?xml version=\"1.0\"?>\n<a/>").problems), (Told{"1:1 not-a-graph"}));
}

// What stands in the wrong place isn't missing as well.
TEST(ReadPastMistakes, OneMistakeOneMessage) {
  using Told = std::vector<std::string>;
  const auto told = [](const std::string& node) {
    return toys::in_short(judged(between_mistakes(node)).problems);
  };
  const Told others = {"2:15 unknown-type", "4:34 unknown-param", "4:54 out-of-range"};
  const auto with = [&](std::string one) {
    Told all = others;
    all.insert(all.begin() + 1, std::move(one));
    return all;
  };
  EXPECT_EQ(told(R"("s": {"type": "QuatStats", "params": {"motion": "b.motion"}},)"),
            with("3:39 unknown-param"));
  EXPECT_EQ(told(R"("s": {"type": "Load", "inputs": {"file": "x.bvh"}},)"), with("3:34 unknown-port"));
  EXPECT_EQ(told(R"("s": {"type": "Switch", "inputs": {"input": ["b.motion"]}},)"),
            with("3:36 unknown-port"));
}

TEST(ReadPastMistakes, Utf16IsToldOnceAndReadPast) {
  for (const bool little : {true, false})
    for (const std::u16string mark : {u"\uFEFF", u""}) {
      std::string text;
      const std::string plain = between_mistakes("");
      for (const char16_t unit : mark + std::u16string(plain.begin(), plain.end())) {
        const char low = static_cast<char>(unit & 0xFF), high = static_cast<char>(unit >> 8);
        (text += little ? low : high) += little ? high : low;
      }
      EXPECT_EQ(toys::in_short(judged(text).problems),
                (std::vector<std::string>{"1:1 bad-utf8", "2:15 unknown-type", "4:34 unknown-param",
                                          "4:54 out-of-range"}));
    }
}

TEST(ReadPastMistakes, WhatIsNoTextIsToldOnce) {
  std::string bytes;
  for (int i = 0; i < 100'000; ++i) bytes += static_cast<char>(i * 7919 >> 3);
  EXPECT_EQ(toys::in_short(judged("\x89PNG" + bytes).problems),
            (std::vector<std::string>{"1:1 not-a-graph"}));
  EXPECT_EQ(toys::in_short(judged(std::string(4096, '\0')).problems),
            (std::vector<std::string>{"1:1 not-a-graph"}));
}

// One node a line, as people write them by hand.
TEST(ReadPastMistakes, OfNodesOfOneLineEachTheIndentationAndTheirPartsTellWhereABracketIsMissing) {
  const auto text = [](const std::string& node) {
    return "{\n  \"format\": \"kinegraph\",\n  \"schema\": 1,\n  \"nodes\": {\n    \"a\": {\"type\": "
           "\"Load\"},\n    " +
           node + "\n    \"z\": {\"type\": \"Laod\"}\n  }\n}\n";
  };
  using Told = std::vector<std::string>;
  EXPECT_EQ(toys::in_short(
                judged(text(R"("s": {"type": "QuatStats", "inputs": {"motion": "a.motion"},)")).problems),
            (Told{"7:5 syntax", "7:19 unknown-type"}));
  EXPECT_EQ(
      toys::in_short(
          judged(
              text(
                  R"("t": {"type": "TimeWarp", "params": {"x": 1, "inputs": {"source": "a.motion", "reference": "a.motion"}},)"))
              .problems),
      (Told{"6:42 unknown-param", "6:50 syntax", "7:19 unknown-type"}));
}

// The line is as long as a whole graph.
TEST(ReadPastMistakes, OfAGraphInOneLineAMissingQuoteIsToldOnce) {
  std::string text = R"({"format": "kinegraph", "schema": 1, "nodes": {)";
  for (int i = 0; i < 40; ++i)
    text += "\"n" + std::to_string(i) +
            "\": {\"type\": \"Load\", \"params\": {\"file\": \"a walk of mine.bvh\"}}, ";
  text += R"("z": {"type": "Laod"}}})";
  const std::size_t quote = text.find("\"a walk", 900);
  text.erase(quote, 1);
  const auto told = toys::in_short(judged(text).problems);
  ASSERT_EQ(told.size(), 2u) << toys::all_text(judged(text).problems);
  EXPECT_EQ(told[0], "1:" + std::to_string(quote + 1) + " syntax");
  EXPECT_TRUE(told[1].ends_with(" unknown-type"));
}

TEST(ReadPastMistakes, ARateThatWasMeantIsJudged) {
  const ReadResult result = judged(between_mistakes(R"("a": {"type": "Load", "params": {"fps": 02000}},)"));
  EXPECT_EQ(result.document.nodes.at("a").params.at("fps"), Json(2000));
}

TEST(ReadPastMistakes, ManyMistakesInALargeFileEndSoon) {
  std::string text = "{\"format\": \"kinegraph\", \"schema\": 1, \"x-a\": [";
  for (int i = 0; i < 200'000; ++i) text += "01234567890123,";
  const ReadResult result = judged(text + "0]}");
  EXPECT_GT(result.problems.size(), 10u);
  EXPECT_LT(result.problems.size(), 200u);
}

// Whatever the bytes, something is told exactly when nlohmann's own parser refuses them, and nothing twice.
TEST(ReadPastMistakes, DamagedTextsAreNeverTakenForWholeOnes) {
  std::mt19937 random(11);
  const std::string damage = "{}[]\",:;=\\0123456789.eE-+ \n'#/\xC3\x80NTtruefalsn";
  int mended = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = i % 2 ? std::string(toys::example)
                             : R"([1, -2.5e3, "a\u00e9\"\\", {"k": [true, null]}, "é", NaN, 'x'])";
    for (int changes = 0; changes <= i % 4; ++changes) {
      const std::size_t at = random() % text.size();
      if (random() % 2)
        text[at] = damage[random() % damage.size()];
      else
        text.erase(at, 1 + random() % 3);
    }
    Diagnostics strict, past;
    parse_json(text, "", strict);
    const Json json = parse_json_past_mistakes(text, "", past).json;
    ASSERT_EQ(strict.empty(), past.empty()) << text;
    ASSERT_GE(past.size(), strict.size()) << text;
    std::set<std::string> once;
    for (const std::string& one : toys::in_short(past))
      ASSERT_TRUE(once.insert(one).second) << text << "\n" << toys::all_text(past);
    mended += !strict.empty() && !json.is_null();
    judged(text);
  }
  EXPECT_GT(mended, 500);
}

}  // namespace
}  // namespace kinegraph
