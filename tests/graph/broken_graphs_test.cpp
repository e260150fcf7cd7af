// Mistakes people make in graph files, each with what they are told: code, place, node, port or parameter,
// and hint.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "graph/file/parse_json.h"
#include "graph/nested.h"
#include "graph/validate.h"
#include "tests/graph/toy_graphs.h"
#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

struct Mistake {
  const char* name;
  std::string text;
  const char* code;
  int line;
  std::string at;        // what stands at the place that is told
  const char* node;      // "" = of the whole file
  const char* part;      // port or parameter
  const char* hint;      // what the hint holds
  bool warning = false;  // the rest can still run
};
void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

// Line 1 is the frame; the nodes start in line 2.
std::string nodes(const std::string& text, const std::string& rest = {}) {
  return "{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {\n" + text + "\n}" + rest + "}";
}
const std::string walk = R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}})";
std::string after_walk(const std::string& text, const std::string& rest = {}) {
  return nodes(walk + ",\n" + text, rest);
}
// A Graph node "g" of lib/restyle.kg.json in line 3, whose last brace is added.
std::string after_restyle(const std::string& text, const std::string& rest = {}) {
  return after_walk(R"("g": {"type": "Graph", )" + text + "}", rest);
}
std::string deep(int levels) {
  return "{\"format\": \"kinegraph\", \"schema\": 1, \"x-a\":\n" + std::string(levels - 1, '[') +
         std::string(levels - 1, ']') + "}";
}

const Mistake mistakes[] = {
    // What JSON itself doesn't allow.
    {"EmptyFile", "", "syntax", 1, "", "", "", "kinegraph"},
    {"EndsEarly", "{\"format\": \"kinegraph\",\n \"schema\": 1", "syntax", 2, "", "", "", "missing"},
    {"TrailingComma", nodes("\"a\": {\"type\": \"Load\",\n}"), "trailing-comma", 2, ",", "", "", "remove"},
    {"Comment", nodes("// the walk\n" + walk), "comment", 2, "//", "", "", "note"},
    {"SingleQuotes", nodes("'a': {}"), "syntax", 2, "'a'", "", "", "write \""},
    {"NotANumber", nodes(R"("a": {"type": "Load", "params": {"fps": NaN}})"), "not-finite", 2, "NaN", "", "",
     "default"},
    {"MinusInfinity", nodes(R"("a": {"type": "Load", "params": {"fps": -Infinity}})"), "not-finite", 2,
     "-Infinity", "", "", "default"},
    {"TooLargeANumber", nodes(R"("a": {"type": "Load", "params": {"fps": 1e999}})"), "not-finite", 2, "1e999",
     "", "", "1.8e308"},
    {"LeadingZero", nodes(R"("a": {"type": "Load", "params": {"fps": 012}})"), "bad-number", 2, "012", "", "",
     "write 12"},
    {"NoDigitBeforeThePoint", nodes(R"("a": {"type": "Load", "params": {"fps": .5}})"), "bad-number", 2, ".5",
     "", "", "0.5"},
    {"Unquoted", nodes("a: {}"), "syntax", 2, "a", "", "", "a name in double quotes"},
    {"NoCommaBetween", nodes("\"a\": {}\n\"b\": {}"), "syntax", 3, "\"b\"", "", "",
     "a , before the next member"},
    {"NoColon", nodes("\"a\" {}"), "syntax", 2, "{", "", "", "a : belongs"},
    {"NoCommaInAList", nodes(R"("a": {"type": "Load", "params": {"range": [1 2]}})"), "syntax", 2, "2", "",
     "", "a , before the next element"},
    {"NoValue", nodes(R"("a": {"type": }, "b": {})"), "syntax", 2, "}", "", "", "a value belongs here"},
    {"BrokenEscape", nodes(R"("a": {"type": "C:\walk"})"), "syntax", 2, "\\walk", "", "", "forward slashes"},
    {"LoneSurrogate", nodes(R"("a": {"type": "\ud800"})"), "syntax", 2, "\\ud800", "", "", "\\\\"},
    {"StringOverTwoLines", nodes("\"a\": {\"note\": \"one\ntwo\"}"), "syntax", 2, "\"one", "", "", "\\n"},
    {"TwoCommas", nodes(R"("a": {"type": "Load",, "note": ""})"), "syntax", 2, ",", "", "",
     "a name in double quotes"},
    {"TwoDocuments", "{\"format\": \"kinegraph\", \"schema\": 1}\n{}", "syntax", 2, "{", "", "",
     "remove what follows"},
    {"BadUtf8", nodes("\"a\": {\"type\": \"Load\", \"note\": \"\xC3\x28\"}"), "bad-utf8", 2, "\xC3", "", "",
     "UTF-8"},
    {"OverlongUtf8", nodes("\"a\": {\"type\": \"Load\", \"note\": \"\xC0\xAF\"}"), "bad-utf8", 2, "\xC0", "",
     "", "UTF-8"},
    {"ByteOrderMark", "\xEF\xBB\xBF{}", "byte-order-mark", 1, "\xEF\xBB\xBF{", "", "", "UTF-8"},
    {"TooDeep", deep(65), "too-deep", 2, "[", "", "", "bracket"},
    {"ConflictMarkers", nodes("<<<<<<< ours\n" + walk + "\n=======\n" + walk + "\n>>>>>>> theirs"),
     "conflict-markers", 2, "<<<<<<<", "", "", "merge"},
    {"DuplicateKey", nodes(R"("a": {"type": "Load",
"type": "Load"})"),
     "duplicate-key", 3, "\"type\"", "", "", "line 2"},
    {"DuplicateNode", nodes(walk + ",\n" + walk), "duplicate-key", 3, "\"walk\"", "", "", "line 2"},
    {"DuplicateFieldDeepInside",
     nodes(
         R"("a": {"type": "StyleTransfer", "params": {"edits": [{"op": "scale", "op": "add", "component": 1}]},
"inputs": {"motion": "a.motion"}})"),
     "duplicate-key", 2, "\"op\"", "", "", "keep one"},

    {"UnclosedNode", nodes("\"a\": {\"type\": \"Load\", \"note\": \"\",\n" + walk), "syntax", 3, "\"walk\"",
     "", "", "a } is missing"},
    {"UnclosedNodeAboveDeeperLines",
     "{\n  \"format\": \"kinegraph\",\n  \"schema\": 1,\n  \"nodes\": {\n    \"s\": {\n      \"type\": "
     "\"Load\"\n  },\n"
     "  \"ui\": {}\n}\n",
     "syntax", 7, "}", "", "", "a } is missing"},
    {"UnclosedList", nodes(R"("a": {"type": "Load", "params": {"range": [1, 2}})"), "syntax", 2, "}}", "", "",
     "a ] is missing"},
    {"UnclosedString", nodes(R"("a": {"type": "Load, "params": {}})"), "syntax", 2, "\"Load", "", "",
     "a \" is missing after"},
    {"UnopenedString", nodes(R"("a": {type": "Load", "params": {}})"), "syntax", 2, "type", "", "",
     "a \" is missing before"},
    {"QuotesInAString", nodes(R"("a": {"note": "say "hello" to"})"), "syntax", 2, "\"say", "", "", "}"},
    {"NoBracketBefore", nodes(R"("a": {"type": "Load", "params": "fps": 24}})"), "syntax", 2, "\"fps\"", "",
     "", "a { is missing"},
    {"OneBracketTooMany", nodes("\"a\": {\"type\": \"Load\"}},\n" + walk), "syntax", 2, "},", "", "",
     "remove it"},
    {"BracketOfTheOtherKind", nodes(R"("a": {"type": "Load", "params": {"range": [1, 2}}})"), "syntax", 2,
     "}}}", "", "", "write ]"},
    {"CommentThatNeverEnds", nodes("/* the walk\n" + walk), "comment", 2, "/*", "", "", "note"},

    // Shape of the file.
    {"NotAGraph", "{\"version\": 1}", "not-a-graph", 1, "{", "", "", ""},
    {"AnotherFormat", "{\"format\": \"gltf\",\n\"schema\": 1}", "not-a-graph", 1, "\"gltf\"", "", "", ""},
    {"AMotionFile", "HIERARCHY\nROOT Hips", "not-a-graph", 1, "HIERARCHY", "", "", "kinegraph info"},
    {"AList", "[]", "not-a-graph", 1, "[", "", "", ""},
    {"NoSchema", "{\"format\": \"kinegraph\"}", "missing-key", 1, "{", "", "", "schema"},
    {"SchemaZero", "{\"format\": \"kinegraph\", \"schema\": 0}", "bad-version", 1, "0", "", "", "from 1"},
    {"NewerSchema", "{\"format\": \"kinegraph\", \"schema\": 2}", "newer-schema", 1, "2", "", "", "newer",
     true},
    {"UnknownTopKey", nodes(walk, ",\n\"nodse\": {}"), "unknown-key", 4, "\"nodse\"", "", "", "nodes"},
    {"NodesAsAList", "{\"format\": \"kinegraph\", \"schema\": 1,\n\"nodes\": []}", "wrong-type", 2, "[", "",
     "", "object"},
    {"BadNodeName", nodes(R"("1walk": {"type": "Load"})"), "bad-name", 2, "\"1walk\"", "", "", "letter"},
    {"NodeNameTooLong", nodes("\"" + std::string(65, 'a') + R"(": {"type": "Load"})"), "bad-name", 2,
     "\"aaaaaaaaaaaaaaaaaaaaaaa", "", "", "64"},
    {"UnknownNodeKey", nodes(R"("a": {"type": "Load", "parms": {}})"), "unknown-key", 2, "\"parms\"", "a", "",
     "params"},
    {"NoType", nodes(R"("a": {"params": {}})"), "missing-key", 2, "{", "a", "", ""},
    {"UnknownType", nodes(R"("a": {"type": "Laod"})"), "unknown-type", 2, "\"Laod\"", "a", "", "Load", true},
    {"NewerVersion", nodes(R"("a": {"type": "Load", "version": 2})"), "newer-version", 2, "2", "a", "",
     "newer", true},
    {"VersionZero", nodes(R"("a": {"type": "Load", "version": 0})"), "bad-version", 2, "0", "a", "",
     "from 1"},
    {"EnabledAsText", nodes(R"("a": {"type": "Load", "enabled": "no"})"), "wrong-type", 2, "\"no\"", "a", "",
     "true or false"},
    {"PositionsAreWhole", nodes(walk, ",\n\"ui\": {\"nodes\": {\"walk\": {\"pos\": [0.5, 0]}}}"),
     "not-an-integer", 4, "0.5", "", "", "whole"},
    {"UnknownUiKey", nodes(walk, ",\n\"ui\": {\"nodes\": {\"walk\": {\"colour\": \"#fff\"}}}"), "unknown-key",
     4, "\"colour\"", "", "", "color"},

    // Parameters.
    {"UnknownParam", nodes(R"("a": {"type": "Load", "params": {"flie": "clips/walk.bvh"}})"), "unknown-param",
     2, "\"flie\"", "a", "flie", "file"},
    {"ExtrasAreNoParams", nodes(R"("a": {"type": "Load", "params": {"x-a": 1}})"), "unknown-param", 2,
     "\"x-a\"", "a", "x-a", ""},
    {"WrongType", nodes(R"("a": {"type": "Load", "params": {"fps": "fast"}})"), "wrong-type", 2, "\"fast\"",
     "a", "fps", "a number from 0 to 1000 (Hz)"},
    {"OutOfHardRange", nodes(R"("a": {"type": "Load", "params": {"fps": 1001}})"), "out-of-range", 2, "1001",
     "a", "fps", "0 to 1000"},
    {"NotAnInteger", after_walk(R"("t": {"type": "StyleTransfer", "params": {"seed": 1.5}})"),
     "not-an-integer", 3, "1.5", "t", "seed", "whole"},
    {"BadChoice", after_walk(R"("t": {"type": "StyleTransfer", "params": {"root": "bothe"}})"), "bad-choice",
     3, "\"bothe\"", "t", "root", "\"both\""},
    {"BadRange", nodes(R"("a": {"type": "Load", "params": {"range": [20, 10]}})"), "bad-range", 2, "[20", "a",
     "range", "start"},
    {"NegativeFrame", nodes(R"("a": {"type": "Load", "params": {"range": [-1, 10]}})"), "bad-range", 2, "-1",
     "a", "range", ""},
    {"UnknownField", after_walk(R"("t": {"type": "StyleTransfer", "params": {"edits": [
{"op": "scale", "component": 1, "fator": 2}]}})"),
     "unknown-key", 4, "\"fator\"", "t", "edits[0]", "factor"},
    {"MissingField", after_walk(R"("t": {"type": "StyleTransfer", "params": {"edits": [{"op": "scale"}]}})"),
     "missing-key", 3, "{", "t", "edits[0]", "whole number"},
    {"DeepInside",
     after_walk(
         R"("t": {"type": "StyleTransfer", "params": {"edits": [{"op": "add", "component": 1, "keys": [[0.5, 1]]}]}})"),
     "not-an-integer", 3, "0.5", "t", "edits[0].keys[0][0]", "whole"},
    {"UndefinedVariable",
     nodes(R"("a": {"type": "Load", "params": {"fps": "${rat}"}})", R"(, "variables": {"rate": 30})"),
     "undefined-variable", 2, "\"${rat}\"", "a", "fps", "rate"},
    {"UndefinedVariableInAPath", nodes(R"("a": {"type": "Load", "params": {"file": "clips/${clip}.bvh"}})"),
     "undefined-variable", 2, "\"clips/${clip}.bvh\"", "a", "file", "--var clip="},
    {"VariableOfAnotherType",
     nodes(R"("a": {"type": "Load", "params": {"fps": "${rate}"}})", R"(, "variables": {"rate": "x"})"),
     "wrong-type", 2, "\"${rate}\"", "a", "fps", "number"},
    {"UnclosedVariable", nodes(R"("a": {"type": "Load", "params": {"file": "clips/${clip"}})"),
     "bad-variable", 2, "\"clips/${clip\"", "a", "file", "$${"},
    {"VariableInsideAText",
     after_walk(R"("t": {"type": "StyleTransfer", "params": {"joints": "${side}Arm"}})",
                R"(, "variables": {"side": "Left"})"),
     "variable-not-replaced", 3, "\"${side}Arm\"", "t", "joints", "whole value", true},
    {"MissingFile", nodes(R"("a": {"type": "Load", "params": {"file": "clips/wakl.bvh"}})"), "missing-file",
     2, "\"clips/wakl.bvh\"", "a", "file", "walk.bvh"},
    {"MissingFolder", nodes(R"("a": {"type": "Load", "params": {"file": "clip/walk.bvh"}})"), "missing-file",
     2, "\"clip/walk.bvh\"", "a", "file", "no folder"},
    {"FolderAsAFile", nodes(R"("a": {"type": "Load", "params": {"file": "clips"}})"), "not-a-regular-file", 2,
     "\"clips\"", "a", "file", ""},
    {"ZeroInAPath", nodes(R"("a": {"type": "Load", "params": {"file": "clips/walk.bvh\u0000.txt"}})"),
     "bad-path", 2, "\"clips", "a", "file", "u0000"},
    {"PathLeadsOut",
     after_walk(
         R"("o": {"type": "Export", "params": {"file": "a/../../o.bvh"}, "inputs": {"motion": "walk.motion"}})"),
     "leads-outside", 3, "\"a/../../o.bvh\"", "o", "file", "--allow-outside"},
    {"AbsoluteOutput",
     after_walk(
         R"("o": {"type": "Export", "params": {"file": "/tmp/o.bvh"}, "inputs": {"motion": "walk.motion"}})"),
     "leads-outside", 3, "\"/tmp/o.bvh\"", "o", "file", "--out"},
    {"Backslash",
     after_walk(
         R"("o": {"type": "Export", "params": {"file": "a\\o.bvh"}, "inputs": {"motion": "walk.motion"}})"),
     "backslash-path", 3, "\"a\\\\o.bvh\"", "o", "file", "forward", true},
    {"TwoExportsToOneFile",
     after_walk(R"("o": {"type": "Export", "params": {"file": "o.bvh"}, "inputs": {"motion": "walk.motion"}},
"p": {"type": "Export", "params": {"file": "./o.bvh"}, "inputs": {"motion": "walk.motion"}})"),
     "same-file", 4, "\"./o.bvh\"", "p", "file", "own"},

    // Links.
    {"UnknownPort", after_walk(R"("s": {"type": "QuatStats", "inputs": {"moton": "walk.motion"}})"),
     "unknown-port", 3, "\"moton\"", "s", "moton", "motion"},
    {"ParamUnderInputs", nodes(R"("a": {"type": "Load", "inputs": {"fps": "b.c"}})"), "unknown-port", 2,
     "\"fps\"", "a", "fps", "params"},
    {"InputUnderParams",
     after_walk(
         R"("s": {"type": "QuatStats", "params": {"motion": "walk.motion"}, "inputs": {"motion": "walk.motion"}})"),
     "unknown-param", 3, "\"motion\"", "s", "motion", "inputs"},
    {"NoLink", after_walk(R"("s": {"type": "QuatStats", "inputs": {"motion": "walk"}})"), "bad-link", 3,
     "\"walk\"", "s", "motion", "node.port"},
    {"LinkToANodeThatIsNotThere",
     after_walk(R"("s": {"type": "QuatStats", "inputs": {"motion": "wakl.motion"}})"), "unknown-node", 3,
     "\"wakl.motion\"", "s", "motion", "walk"},
    {"LinkToAPortThatIsNotThere",
     after_walk(R"("s": {"type": "QuatStats", "inputs": {"motion": "walk.moton"}})"), "unknown-port", 3,
     "\"walk.moton\"", "s", "motion", "\"motion\""},
    {"ListOnASinglePort", after_walk(R"("s": {"type": "QuatStats", "inputs": {"motion": ["walk.motion"]}})"),
     "one-link", 3, "[", "s", "motion", "node.port"},
    {"SingleOnAListPort", after_walk(R"("c": {"type": "Concatenate", "inputs": {"motions": "walk.motion"}})"),
     "needs-list", 3, "\"walk.motion\"", "c", "motions", "[\"walk.motion\"]"},
    {"TypeMismatch", after_walk(R"("s": {"type": "QuatStats", "inputs": {"motion": "walk.points"}})"),
     "type-mismatch", 3, "\"walk.points\"", "s", "motion", "\"motion\" would fit"},
    {"TypeMismatchThroughADot", after_walk(R"("d": {"type": "Dot", "inputs": {"input": "walk.points"}},
"s": {"type": "QuatStats", "inputs": {"motion": "d.output"}})"),
     "type-mismatch", 4, "\"d.output\"", "s", "motion", "Motion"},
    {"RequiredInputOpen", nodes(R"("s": {"type": "QuatStats"})"), "open-input", 2, "\"s\"", "s", "motion",
     "Motion"},
    {"Cycle", nodes(R"("a": {"type": "Concatenate", "inputs": {"motions": ["b.motion"]}},
"b": {"type": "Concatenate", "inputs": {"motions": ["a.motion"]}})"),
     "cycle", 2, "\"b.motion\"", "a", "motions", "remove"},
    {"LinkToItself", nodes(R"("a": {"type": "Dot", "inputs": {"input": "a.output"}})"), "cycle", 2,
     "\"a.output\"", "a", "input", "remove"},
    {"SwitchPastItsLinks",
     after_walk(R"("w": {"type": "Switch", "params": {"index": 1}, "inputs": {"inputs": ["walk.motion"]}})"),
     "index-out-of-range", 3, "1", "w", "index", "from 0"},
    {"SwitchOfTwoTypes",
     after_walk(R"("w": {"type": "Switch", "inputs": {"inputs": ["walk.motion", "walk.points"]}})"),
     "type-mismatch", 3, "\"walk.points\"", "w", "inputs", "one type"},

    // What is published.
    {"PublishAsFile", nodes(walk, ",\n\"publish\": {\"params\": {\"file\": \"walk.file\"}}"), "bad-name", 4,
     "\"file\"", "", "", "Graph"},
    {"PublishedNodeIsNotThere", nodes(walk, ",\n\"publish\": {\"params\": {\"clip\": \"wakl.file\"}}"),
     "unknown-node", 4, "\"wakl.file\"", "", "publish.params.clip", "walk"},
    {"PublishedParamIsNotThere", nodes(walk, ",\n\"publish\": {\"params\": {\"clip\": \"walk.flie\"}}"),
     "unknown-param", 4, "\"walk.flie\"", "", "publish.params.clip", "file"},
    {"PublishedTogetherButOfTwoTypes",
     nodes(walk, ",\n\"publish\": {\"params\": {\"clip\": [\"walk.file\", \"walk.fps\"]}}"), "type-mismatch",
     4, "\"walk.fps\"", "", "publish.params.clip", "one type"},
    {"PublishedOutputIsNotThere", nodes(walk, ",\n\"publish\": {\"outputs\": {\"o\": \"walk.stats\"}}"),
     "unknown-port", 4, "\"walk.stats\"", "", "publish.outputs.o", "motion"},
    {"PublishedOutputAsAList", nodes(walk, ",\n\"publish\": {\"outputs\": {\"o\": [\"walk.motion\"]}}"),
     "one-link", 4, "[", "", "publish.outputs.o", "node.port"},
    {"PublishIsNoList", nodes(walk, ",\n\"publish\": []"), "wrong-type", 4, "[", "", "", "object"},
    {"PublishUnknownKey", nodes(walk, ",\n\"publish\": {\"param\": {}}"), "unknown-key", 4, "\"param\"", "",
     "", "params"},
    {"PublishedUnderABadName", nodes(walk, ",\n\"publish\": {\"params\": {\"my clip\": \"walk.file\"}}"),
     "bad-name", 4, "\"my clip\"", "", "", "letter"},
    {"PublishedWithoutAPort", nodes(walk, ",\n\"publish\": {\"outputs\": {\"o\": \"walk\"}}"), "bad-link", 4,
     "\"walk\"", "", "publish.outputs.o", "node.port"},
    {"PublishedInputIsNotThere", nodes(walk, ",\n\"publish\": {\"inputs\": {\"i\": \"walk.motion\"}}"),
     "unknown-port", 4, "\"walk.motion\"", "", "publish.inputs.i", ""},
    {"PublishedInputsOfTwoTypes",
     after_walk(
         R"("s": {"type": "StyleTransfer", "inputs": {"motion": "walk.motion", "style": "q.stats"}}, "q": {"type": "QuatStats", "inputs": {"motion": "walk.motion"}})",
         ",\n\"publish\": {\"inputs\": {\"i\": [\"s.motion\", \"s.style\"]}}"),
     "type-mismatch", 5, "\"s.style\"", "", "publish.inputs.i", "one type"},
    {"PublishedTwiceUnderOneName",
     nodes(walk, ",\n\"publish\": {\"params\": {\"p\": \"walk.file\", \"p\": \"walk.fps\"}}"),
     "duplicate-key", 4, "\"p\"", "", "", "line 4"},
    {"PublishedNothing", nodes(walk, ",\n\"publish\": {\"params\": {\"o\": []}}"), "bad-link", 4, "[", "",
     "publish.params.o", "leave"},

    // Variables.
    {"VariablesAsAList", nodes(walk, ",\n\"variables\": [1]"), "wrong-type", 4, "[", "", "", "object"},
    {"VariableWithABadName", nodes(walk, ",\n\"variables\": {\"my clip\": 1}"), "bad-name", 4, "\"my clip\"",
     "", "", "letter"},
    {"VariableTwice", nodes(walk, ",\n\"variables\": {\"a\": 1, \"a\": 2}"), "duplicate-key", 4, "\"a\"", "",
     "", "line 4"},
    {"VariableThatIsNoTextInAPath",
     nodes(R"("a": {"type": "Load", "params": {"file": "clips/${clip}.bvh"}})",
           R"(, "variables": {"clip": [1]})"),
     "bad-variable", 2, "\"clips/${clip}.bvh\"", "a", "file", "a number can"},
    {"VariableOutOfRange",
     nodes(R"("a": {"type": "Load", "params": {"fps": "${rate}"}})", R"(, "variables": {"rate": 2000})"),
     "out-of-range", 2, "\"${rate}\"", "a", "fps", "0 to 1000"},
    {"UndefinedVariableInAList",
     after_walk(
         R"("t": {"type": "StyleTransfer", "params": {"edits": [{"op": "${what}", "component": 1}]}})"),
     "undefined-variable", 3, "\"${what}\"", "t", "edits[0].op", "--var what="},
    {"VariableWithoutAName", nodes(R"("a": {"type": "Load", "params": {"file": "clips/${}.bvh"}})"),
     "bad-variable", 2, "\"clips/${}.bvh\"", "a", "file", "$${"},

    // Graphs inside graphs.
    {"NoGraphFile", nodes(R"("g": {"type": "Graph"})"), "missing-file", 2, "\"g\"", "g", "file", "\"file\""},
    {"GraphFileMissing", nodes(R"("g": {"type": "Graph", "params": {"file": "lib/restlye.kg.json"}})"),
     "missing-file", 2, "\"lib/restlye.kg.json\"", "g", "file", "restyle.kg.json"},
    {"GraphFileBroken", nodes(R"("g": {"type": "Graph", "params": {"file": "lib/broken.kg.json"}})"),
     "broken-graph", 2, "\"lib/broken.kg.json\"", "g", "file", "validate"},
    {"GraphFileIsAClip", nodes(R"("g": {"type": "Graph", "params": {"file": "clips/walk.bvh"}})"),
     "broken-graph", 2, "\"clips/walk.bvh\"", "g", "file", "validate"},
    {"GraphFileOfANewerSchema", nodes(R"("g": {"type": "Graph", "params": {"file": "lib/newer.kg.json"}})"),
     "broken-graph", 2, "\"lib/newer.kg.json\"", "g", "file", "newer"},
    {"GraphFileInAnUndefinedPlace",
     nodes(R"("g": {"type": "Graph", "params": {"file": "${lib}/restyle.kg.json"}})"), "undefined-variable",
     2, "\"${lib}/restyle.kg.json\"", "g", "file", "--var lib="},
    {"GraphsInACircle", nodes(R"("g": {"type": "Graph", "params": {"file": "lib/circle.kg.json"}})"),
     "graph-cycle", 2, "\"lib/circle.kg.json\"", "g", "file", "inside itself"},
    {"GraphInsideItself", nodes(R"("g": {"type": "Graph", "params": {"file": "g.kg.json"}})"), "graph-cycle",
     2, "\"g.kg.json\"", "g", "file", "inside itself"},
    {"UndefinedVariableInsideAGraph",
     nodes(R"("g": {"type": "Graph", "params": {"file": "lib/asks.kg.json"}})"), "broken-graph", 2,
     "\"lib/asks.kg.json\"", "g", "file", "validate"},
    {"UnknownParamOfAGraph", after_restyle(R"("params": {"file": "lib/restyle.kg.json", "amuont": 1})"),
     "unknown-param", 3, "\"amuont\"", "g", "amuont", "amount"},
    {"ParamOfAnInnerNode",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json", "transfer.amount": 1})"), "unknown-param", 3,
     "\"transfer.amount\"", "g", "transfer.amount", "amount"},
    {"ParamOfAGraphOutOfRange", after_restyle(R"("params": {"file": "lib/restyle.kg.json", "amount": 2})"),
     "out-of-range", 3, "2", "g", "amount", "0 to 1"},
    {"ParamOfAGraphOfAnotherType",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json", "amount": "all"})"), "wrong-type", 3,
     "\"all\"", "g", "amount", "number"},
    {"ParamOfAGraphIsAnUndefinedVariable",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json", "amount": "${much}"})"), "undefined-variable",
     3, "\"${much}\"", "g", "amount", "--var much="},
    {"FileOfAGraphIsMissing",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json", "clip": "clips/prod.bvh"})"), "missing-file",
     3, "\"clips/prod.bvh\"", "g", "clip", "relative"},
    {"UnknownInputOfAGraph",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motoin": "walk.motion"})"),
     "unknown-port", 3, "\"motoin\"", "g", "motoin", "motion"},
    {"InputOfAGraphLeftOpen", nodes(R"("g": {"type": "Graph", "params": {"file": "lib/restyle.kg.json"}})"),
     "open-input", 2, "\"g\"", "g", "motion", "Motion"},
    {"InputOfAGraphOfAnotherType",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.points"})"),
     "type-mismatch", 3, "\"walk.points\"", "g", "motion", "\"motion\" would fit"},
    {"ListOnAnInputOfAGraph",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": ["walk.motion"]})"),
     "one-link", 3, "\"motion\"", "g", "motion", "node.port"},
    {"UnknownOutputOfAGraph",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"}},
"s": {"type": "QuatStats", "inputs": {"motion": "g.moton"})"),
     "unknown-port", 4, "\"g.moton\"", "s", "motion", "motion"},
    {"OutputOfAGraphOfAnotherType",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"}},
"p": {"type": "Check", "inputs": {"metrics": "g.motion"})"),
     "type-mismatch", 4, "\"g.motion\"", "p", "metrics", "Metrics"},
    {"LinkToAnInnerNode",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"}},
"s": {"type": "QuatStats", "inputs": {"motion": "g/transfer.motion"})"),
     "bad-link", 4, "\"g/transfer.motion\"", "s", "motion", "node.port"},
    {"CycleThroughAGraph", nodes(R"("c": {"type": "Concatenate", "inputs": {"motions": ["g.motion"]}},
"g": {"type": "Graph", "params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "c.motion"}})"),
     "cycle", 2, "\"g.motion\"", "c", "motions", "remove"},
    {"PublishedParamOfAGraphIsNotThere",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"})",
                   ",\n\"publish\": {\"params\": {\"a\": \"g.amuont\"}}"),
     "unknown-param", 5, "\"g.amuont\"", "", "publish.params.a", "amount"},
    {"PublishedOutputOfAGraphIsNotThere",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"})",
                   ",\n\"publish\": {\"outputs\": {\"o\": \"g.stats\"}}"),
     "unknown-port", 5, "\"g.stats\"", "", "publish.outputs.o", "motion"},
    {"PublishedTogetherButOfTwoTypesThroughAGraph",
     after_restyle(R"("params": {"file": "lib/restyle.kg.json"}, "inputs": {"motion": "walk.motion"})",
                   ",\n\"publish\": {\"params\": {\"a\": [\"g.amount\", \"g.clip\"]}}"),
     "type-mismatch", 5, "\"g.clip\"", "", "publish.params.a", "one type"},
};

class BrokenGraph : public testing::TestWithParam<Mistake> {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("kinegraph_broken_" + std::to_string(::getpid()));
    fs::create_directories(folder_ / "clips");
    fs::create_directories(folder_ / "lib");
    std::ofstream(folder_ / "clips" / "walk.bvh") << "HIERARCHY";
    const auto file = [&](const char* name, const std::string& text) {
      std::ofstream(folder_ / name) << text;
    };
    file(
        "lib/restyle.kg.json",
        nodes(
            R"("sample": {"type": "Load", "params": {"file": "../clips/walk.bvh"}},
"stats": {"type": "QuatStats", "inputs": {"motion": "sample.motion"}},
"transfer": {"type": "StyleTransfer", "inputs": {"style": "stats.stats"}})",
            R"(, "publish": {"inputs": {"motion": "transfer.motion"}, "outputs": {"motion": "transfer.motion"},
"params": {"amount": "transfer.amount", "clip": "sample.file"}})"));
    file("lib/broken.kg.json", nodes(R"("s": {"type": "QuatStats", "inputs": {"motion": "nobody.motion"}})"));
    file("lib/newer.kg.json", R"({"format": "kinegraph", "schema": 99})");
    file("lib/circle.kg.json", nodes(R"("c": {"type": "Graph", "params": {"file": "circle.kg.json"}})"));
    file("lib/asks.kg.json", nodes(R"("a": {"type": "Load", "params": {"fps": "${speed}"}})"));
    options_.file = "g.kg.json";
    options_.folder = folder_.string();
  }
  void TearDown() override { fs::remove_all(folder_); }
  // As the commands do it: the files of Graph nodes are opened before anything is judged.
  ReadResult read_and_validate_with_graphs_inside(const std::string& text) const {
    ReadResult result = read_and_validate(text, registry_, options_);
    if (result.document.nodes.empty()) return result;
    result = read_document(text, options_.file, registry_);
    std::ofstream(folder_ / "g.kg.json") << text;
    open_nested(result.document, registry_,
                {.path = (folder_ / "g.kg.json").string(),
                 .folder = folder_.string(),
                 .read = [](const std::string& path) {
                   if (!fs::is_regular_file(path)) throw Failure(error("missing-file", "it does not exist"));
                   return toys::content(path);
                 }});
    for (Diagnostic& problem : validate(result.document, registry_, options_))
      result.problems.push_back(std::move(problem));
    return result;
  }
  fs::path folder_;
  ValidateOptions options_;
  Registry registry_ = toys::registry();
};

// What stands at a place, to the end of its line.
std::string text_at(const std::string& text, Place place) {
  std::size_t offset = 0;
  for (int line = 1; line < place.line; ++line) offset = text.find('\n', offset) + 1;
  for (int column = 1; column < place.column; ++column) do
      ++offset;
    while (offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0) == 0x80);
  return text.substr(offset, text.find('\n', offset) - offset);
}

TEST_P(BrokenGraph, IsToldWhatIsWrongAndWhere) {
  const Mistake& mistake = GetParam();
  const ReadResult result = read_and_validate_with_graphs_inside(mistake.text);
  const auto found = std::find_if(result.problems.begin(), result.problems.end(),
                                  [&](const Diagnostic& problem) { return problem.code == mistake.code; });
  ASSERT_NE(found, result.problems.end()) << toys::all_text(result.problems);
  EXPECT_EQ(found->place.line, mistake.line) << to_text(*found);
  const std::string at = text_at(mistake.text, found->place);
  EXPECT_TRUE(mistake.at.empty() ? at.empty() : at.starts_with(mistake.at)) << to_text(*found);
  EXPECT_EQ(found->node, mistake.node) << to_text(*found);
  EXPECT_EQ(found->port.empty() ? found->param : found->port, mistake.part) << to_text(*found);
  EXPECT_FALSE(found->hint.empty()) << to_text(*found);
  EXPECT_NE(found->hint.find(mistake.hint), std::string::npos) << to_text(*found);
  EXPECT_FALSE(found->message.empty());
  EXPECT_EQ(found->file, "g.kg.json");
  EXPECT_EQ(found->severity, mistake.warning ? Severity::warning : Severity::error);
}

INSTANTIATE_TEST_SUITE_P(Table, BrokenGraph, testing::ValuesIn(mistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

class WholeFile : public BrokenGraph {};
TEST_F(WholeFile, TellsAllItsProblemsAtOnceInTheirOrder) {
  const ReadResult result = read_and_validate(R"({
  "format": "kinegraph",
  "schema": 1,
  "varaibles": {},
  "nodes": {
    "a": {"type": "Load", "params": {"fps": -1, "flie": "x", "range": [2, 1]}},
    "a": {"type": "Load"},
    "b": {"type": "StyleTransfer", "inputs": {"motion": "a.points", "stlye": "nobody.stats"}, "enabled": 1},
    "c": {"type": "Laod", "whatever": 1.0},
    "d": {"type": "Concatenate", "params": {"file": "${x}"}, "inputs": {"motions": ["d.motion", "a.stats", 7]}}
  },
  "publish": {"params": {"p": "a.nothing"}, "outputs": {"q": "zz.motion"}},
  "ui": {"nodes": {"a": {"pos": [1]}}}
})",
                                              registry_, options_);
  EXPECT_EQ(toys::in_short(result.problems),
            (std::vector<std::string>{
                "4:3 unknown-key", "6:5 no-file", "6:45 out-of-range", "6:49 unknown-param", "6:71 bad-range",
                "7:5 duplicate-key", "8:57 type-mismatch", "8:69 unknown-port", "8:106 wrong-type",
                "9:19 unknown-type", "10:45 unknown-param", "10:85 cycle", "10:97 unknown-port",
                "10:108 bad-link", "12:31 unknown-param", "12:62 unknown-node", "13:33 wrong-type"}))
      << toys::all_text(result.problems);
}

TEST_F(WholeFile, OneMistakeIsToldOnce) {
  EXPECT_EQ(read_and_validate(after_walk(R"("s": {"type": "QuatStats", "inputs": {"moton": "walk.motion"}})"),
                              registry_, options_)
                .problems.size(),
            1u);
  EXPECT_EQ(read_and_validate(after_walk(R"("s": {"type": "QuatStats", "inputs": {"motion": "walk"}})"),
                              registry_, options_)
                .problems.size(),
            1u);
  EXPECT_EQ(read_and_validate(
                nodes(R"("a": {"type": "Load", "params": {"file": "clips/walk.bvh", "fps": "${x}"}})"),
                registry_, options_)
                .problems.size(),
            1u);
}

TEST_F(WholeFile, ColumnsCountCharacters) {
  const ReadResult result =
      read_and_validate(nodes("\"a\": {\"note\": \"éé漢🙂\", \"typo\": 1, \"type\": \"Load\", "
                              "\"params\": {\"file\": \"clips/walk.bvh\"}}"),
                        registry_, options_);
  EXPECT_EQ(toys::in_short(result.problems), std::vector<std::string>{"2:23 unknown-key"});
}

TEST_F(WholeFile, SixtyFourLevelsAreFine) {
  EXPECT_TRUE(read_and_validate(deep(64), registry_, options_).problems.empty());
}

TEST_F(WholeFile, OfMoreThan64MiBIsRefused) {
  const std::string frame = "{\"format\": \"kinegraph\", \"schema\": 1, \"x-a\": \"\"}";
  std::string text = frame;
  text.insert(text.size() - 2, std::string(largest_json - frame.size(), 'x'));
  EXPECT_TRUE(read_and_validate(text, registry_, options_).problems.empty());
  text += ' ';
  EXPECT_EQ(toys::in_short(read_and_validate(text, registry_, options_).problems),
            std::vector<std::string>{"1:1 too-large"});
}

TEST_F(WholeFile, FilesAreNotLookedForWhenNotAsked) {
  options_.check_files = false;
  EXPECT_TRUE(read_and_validate(nodes(R"("a": {"type": "Load", "params": {"file": "gone.bvh"}})"), registry_,
                                options_)
                  .problems.empty());
}

TEST_F(WholeFile, OutputsMayLieOutsideWhenAllowed) {
  options_.allow_outside = true;
  const auto problems =
      read_and_validate(
          after_walk(
              R"("o": {"type": "Export", "params": {"file": "../o.bvh"}, "inputs": {"motion": "walk.motion"}})"),
          registry_, options_)
          .problems;
  EXPECT_TRUE(problems.empty()) << toys::all_text(problems);
}

TEST_F(WholeFile, ABatchsOwnVariablesAreFineInAPathThatIsWritten) {
  EXPECT_TRUE(
      read_and_validate(after_walk(R"("o": {"type": "Export", "params": {"file": "${item}_${index}.bvh"},
                                "inputs": {"motion": "walk.motion"}})"),
                        registry_, options_)
          .problems.empty());
  EXPECT_EQ(toys::in_short(read_and_validate(nodes(R"("a": {"type": "Load", "params": {"file": "${item}"}})"),
                                             registry_, options_)
                               .problems),
            std::vector<std::string>{"2:42 undefined-variable"});
}

TEST_F(WholeFile, AnAbsolutePathIsAWarningUnlessItIsGivenFromOutside) {
  const std::string clips = (folder_ / "clips").string();
  const std::string text = nodes(R"("a": {"type": "Load", "params": {"file": "${clips}/walk.bvh"}})",
                                 ", \"variables\": {\"clips\": \"" + clips + "\"}");
  EXPECT_EQ(toys::in_short(read_and_validate(text, registry_, options_).problems),
            std::vector<std::string>{"2:42 absolute-path"});
  options_.variables = {{"clips", Json(clips)}};
  EXPECT_TRUE(read_and_validate(text, registry_, options_).problems.empty());
}

TEST_F(WholeFile, AnOpenInputThatIsPublishedIsNoMistake) {
  EXPECT_TRUE(read_and_validate(
                  nodes(R"("s": {"type": "QuatStats"})", R"(, "publish": {"inputs": {"m": "s.motion"}})"),
                  registry_, options_)
                  .problems.empty());
}

TEST_F(WholeFile, ADisabledNodeMayBeUnfinished) {
  EXPECT_TRUE(read_and_validate(nodes(R"("s": {"type": "QuatStats", "enabled": false},
    "l": {"type": "Load", "enabled": false, "params": {"file": "gone.bvh"}})"),
                                registry_, options_)
                  .problems.empty());
}

TEST_F(WholeFile, VariablesGivenByHandComeFirstAndAreTypedByTheParameter) {
  options_.variables = {{"clip", Json("walk")}, {"rate", Json("25")}, {"range", Json("3:9")}};
  const auto problems =
      read_and_validate(nodes(R"("a": {"type": "Load", "params": {"file": "clips/${clip}.bvh",
    "fps": "${rate}", "range": "${range}"}})",
                              R"(, "variables": {"rate": "slow"})"),
                        registry_, options_)
          .problems;
  EXPECT_TRUE(problems.empty()) << toys::all_text(problems);
}

}  // namespace
}  // namespace kinegraph
