// Mistakes in graph files as a user of the program meets them, with the real node types: what `validate`
// says, where, and how, and how `validate` and `run` exit. (tests/graph/broken_graphs_test.cpp has what the
// core finds, to the column.)
#include "program.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;

struct Mistake {
  const char* name;
  std::string text;
  int line;
  const char* told;           // "severity: code: node.part"
  const char* hint;           // part of it
  int validate = 3, run = 3;  // exit codes
  const char* when_run =
      "";  // where run tells it in another way: a node that is missing stops only what needs it
  const char* in = "g.kg.json";  // where validate finds it
};
void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

// The nodes start in line 3; "w" (Gait) stands there, to be linked to. `rest` follows the nodes.
std::string file(const std::string& nodes, const std::string& rest = {}) {
  return "{\"format\": \"kinegraph\", \"schema\": 1,\n\"nodes\": {\n\"w\": {\"type\": \"Gait\", \"params\": "
         "{\"seconds\": "
         "1}},\n" +
         nodes + "\n}" + rest + "\n}\n";
}
std::string with(const std::string& type, const std::string& params, const std::string& inputs = {}) {
  return file("\"n\": {\"type\": \"" + type + "\"" +
                  (params.empty() ? "" : ", \"params\": {" + params + "}") +
                  (inputs.empty() ? "" : ", \"inputs\": {" + inputs + "}") + "}",
              ",\n\"publish\": {\"outputs\": {\"o\": \"w.motion\"}}");
}
const std::string moved = R"("motion": "w.motion")";
std::string exported(const std::string& params, const std::string& inputs = moved) {
  return with("Export", params, inputs);
}

// "g" is a Graph node in line 4, "w" the walk in line 3; g's motion is published.
const std::string result = ",\n\"publish\": {\"outputs\": {\"o\": \"g.motion\"}}";
std::string inside(const std::string& lib, const std::string& params = {}, const std::string& inputs = {},
                   const std::string& rest = result) {
  return file("\"g\": {\"type\": \"Graph\", \"params\": {\"file\": \"lib/" + lib + ".kg.json\"" +
                  (params.empty() ? "" : ", " + params) + "}" +
                  (inputs.empty() ? "" : ", \"inputs\": {" + inputs + "}") + "}",
              rest);
}
// "n" in line 5 is linked to `link`.
std::string behind(const std::string& link) {
  return file(R"("g": {"type": "Graph", "params": {"file": "lib/smooth.kg.json"}},
"n": {"type": "Trim", "inputs": {"motion": ")" +
              link + "\"}}");
}
// "n" smooths the walk; line 6 publishes it, and what is given.
std::string published(const std::string& rest) {
  const std::string output = rest.starts_with("\"outputs\"") ? "" : R"("outputs": {"o": "n.motion"}, )";
  return file(R"("n": {"type": "Filter", "inputs": {"motion": "w.motion"}})",
              ",\n\"publish\": {" + output + rest + "}");
}
// The files in lib/ that Graph nodes name.
const std::pair<const char*, std::string> libraries[] = {
    {"smooth", file(R"("f": {"type": "Filter", "inputs": {"motion": "w.motion"}},
"m": {"type": "Metrics", "inputs": {"motion": "f.motion"}})",
                    R"(, "publish": {"inputs": {"motion": "f.motion"},
"outputs": {"motion": "f.motion", "metrics": "m.metrics"}, "params": {"cutoff": "f.cutoff", "gait": "w.gait"}})")},
    {"open", file(R"("f": {"type": "Filter"})",
                  R"(, "publish": {"inputs": {"motion": "f.motion"}, "outputs": {"motion": "f.motion"}})")},
    {"unfinished", file(R"("f": {"type": "Filter"})", R"(, "publish": {"outputs": {"motion": "f.motion"}})")},
    {"asks",
     file(R"("f": {"type": "Filter", "params": {"cutoff": "${low}"}, "inputs": {"motion": "w.motion"}})",
          R"(, "publish": {"outputs": {"motion": "f.motion"}})")},
    {"misspelt", file(R"("f": {"type": "Fliter", "inputs": {"motion": "w.motion"}})",
                      R"(, "publish": {"outputs": {"motion": "f.motion"}})")},
    {"clipless", file(R"("l": {"type": "Load", "params": {"file": "none.bvh"}})",
                      R"(, "publish": {"outputs": {"motion": "l.motion"}})")},
    {"deeper", file(R"("d": {"type": "Graph", "params": {"file": "clipless.kg.json"}})",
                    R"(, "publish": {"outputs": {"motion": "d.motion"}})")},
    {"circle", file(R"("g": {"type": "Graph", "params": {"file": "round.kg.json"}})",
                    R"(, "publish": {"outputs": {"motion": "g.motion"}})")},
    {"round", file(R"("g": {"type": "Graph", "params": {"file": "circle.kg.json"}})",
                   R"(, "publish": {"outputs": {"motion": "g.motion"}})")},
    {"cut", "{\"format\": \"kinegraph\",\n\"schema\": 1,\n"},
    {"merging", file("<<<<<<< ours\n=======\n>>>>>>> theirs")},
    {"newer", R"({"format": "kinegraph", "schema": 99})"},
};

const Mistake mistakes[] = {
    // Text.
    {"Empty", "", 1, "error: syntax: ", "kinegraph"},
    {"CutOff", "{\"format\": \"kinegraph\",\n\"schema\": 1", 2, "error: syntax: ", "missing"},
    {"NotJson", "digraph {}\n", 1, "error: not-a-graph: ", "info FILE"},
    {"TrailingComma", "{\"format\": \"kinegraph\",\n\"schema\": 1,\n}", 2,
     "error: trailing-comma: ", "remove"},
    {"Comment", file("// legs\n\"n\": {\"type\": \"Gait\"}"), 4, "error: comment: ", "note"},
    {"ConflictMarkers", file("<<<<<<< ours\n=======\n>>>>>>> theirs"), 4,
     "error: conflict-markers: ", "merge"},
    {"DuplicateKey", file("\"w\": {\"type\": \"Gait\"}"), 4, "error: duplicate-key: ", "line 3"},
    {"NotANumber", with("Gait", R"("speed": NaN)"), 4, "error: not-finite: ", "default"},
    {"LeadingZero", with("Gait", R"("speed": 01)"), 4, "error: bad-number: ", "write 1"},
    {"UnclosedNode", file("\"n\": {\"type\": \"Gait\",\n\"o\": {\"type\": \"Gait\"}"), 5,
     "error: syntax: ", "a } is missing"},
    {"UnclosedString", with("Gait", R"("gait": "sneak, "seed": 1)"), 4, "error: syntax: ", "a \" is missing"},
    {"UnclosedList", with("Trim", R"("range": [0, 9)", moved), 4, "error: syntax: ", "a ] is missing"},
    {"BadUtf8", file("\"n\": {\"type\": \"Gait\", \"note\": \"\xff\"}"), 4, "error: bad-utf8: ", "UTF-8"},
    {"ByteOrderMark", "\xEF\xBB\xBF{}", 1, "error: byte-order-mark: ", "UTF-8"},

    // The file's frame.
    {"NotAGraph", "{\"asset\": {\"version\": \"2.0\"}}", 1, "error: not-a-graph: ", "graph file"},
    {"NewerSchema", "{\"format\": \"kinegraph\", \"schema\": 99, \"nodes\": {}}", 1,
     "warning: newer-schema: ", "newer", 0, 3},
    {"NoSchema", "{\"format\": \"kinegraph\"}", 1, "error: missing-key: ", "schema"},
    {"UnknownKey", file("\"n\": {\"type\": \"Gait\"}", ",\n\"node\": {}"), 6,
     "error: unknown-key: ", "nodes"},
    {"NoNodes", "{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {}}", 1, "", "", 0, 2,
     "error: nothing-to-run: "},
    {"BadNodeName", file("\"left leg\": {\"type\": \"Gait\"}"), 4, "error: bad-name: ", "letter"},
    {"NoType", file("\"n\": {\"params\": {}}"), 4, "error: missing-key: n: ", "type"},
    {"UnknownNodeKey", file("\"n\": {\"type\": \"Gait\", \"disabled\": true}"), 4,
     "error: unknown-key: n: ", "enabled"},

    // Node types and versions: the rest still runs.
    {"UnknownType", with("Trimm", ""), 4, "warning: unknown-type: n: ", "Trim", 0, 0},
    {"NewerVersion",
     file("\"n\": {\"type\": \"Gait\", \"version\": 7}",
          ",\n\"publish\": {\"outputs\": {\"o\": \"n.motion\"}}"),
     4, "warning: newer-version: n: ", "newer", 0, 3},
    {"NeedsAnUnknownType",
     file("\"n\": {\"type\": \"Trimm\"},\n\"e\": {\"type\": \"Export\", \"params\": {\"file\": \"a.bvh\"}, "
          "\"inputs\": "
          "{\"motion\": \"n.motion\"}}"),
     4, "warning: unknown-type: n: ", "Trim", 0, 3},

    // Parameters.
    {"UnknownParam", with("Gait", R"("sped": 1)"), 4, "error: unknown-param: n.sped: ", "speed"},
    {"WrongType", with("Gait", R"("speed": "fast")"), 4, "error: wrong-type: n.speed: ", "number"},
    {"NumberAsText", with("Gait", R"("speed": "1.2")"), 4, "error: wrong-type: n.speed: ", "number"},
    {"OutOfRange", with("Filter", R"("cutoff": -6)", moved), 4, "error: out-of-range: n.cutoff: ", "0.001"},
    {"NotWhole", with("Gait", R"("seed": 0.5)"), 4, "error: not-an-integer: n.seed: ", "whole"},
    {"BadChoice", with("Gait", R"("gait": "sneek")"), 4, "error: bad-choice: n.gait: ", "sneak"},
    {"RangeTurnedRound", with("Trim", R"("range": [30, 10])", moved), 4,
     "error: bad-range: n.range: ", "start"},
    {"RangeOfThree", with("Trim", R"("range": [1, 2, 3])", moved), 4,
     "error: wrong-type: n.range: ", "[start, end]"},
    {"BadPattern", with("Filter", R"("joints": "Left\\")", moved), 4,
     "error: bad-pattern: n.joints: ", "names"},
    {"ListWhereOneBelongs", with("Gait", R"("speed": [1])"), 4, "error: wrong-type: n.speed: ", "number"},
    {"BadRule", with("Check", R"("rules": ["skate << 1"])", R"("metrics": "m.metrics")"), 4,
     "error: bad-rule: n.rules", "NAME"},
    {"FieldMissing", with("DetectContacts", R"("edits": [{"part": "ball", "range": [0, 3]}])", moved), 4,
     "error: missing-key: n.edits[0]", "string"},
    {"FieldUnknown", with("DetectContacts", R"("edits": [{"foot": "left", "rnage": [0, 3]}])", moved), 4,
     "error: unknown-key: n.edits[0]", "range"},
    {"UnitThatIsNone", exported(R"("file": "a.bvh", "unit": "feet")"), 4,
     "error: bad-choice: n.unit: ", "number of metres"},

    // Variables.
    {"UndefinedVariable", with("Gait", R"("speed": "${pace}")"), 4,
     "error: undefined-variable: n.speed: ", "--var pace="},
    {"UndefinedVariableInAPath", exported(R"("file": "${shot}.bvh")"), 4,
     "error: undefined-variable: n.file: ", "--var shot="},
    {"VariableOfAnotherType",
     file(R"("n": {"type": "Gait", "params": {"speed": "${pace}"}})",
          ",\n\"variables\": {\"pace\": \"quick\"}"),
     4, "error: wrong-type: n.speed: ", "number"},

    // Paths.
    {"MissingFile",
     file(R"("n": {"type": "Load", "params": {"file": "none.bvh"}})",
          ",\n\"publish\": {\"outputs\": {\"o\": \"n.motion\"}}"),
     4, "error: missing-file: n.file: ", "relative", 3, 1},
    {"FolderAsFile",
     file(R"("n": {"type": "Load", "params": {"file": "."}})",
          ",\n\"publish\": {\"outputs\": {\"o\": \"n.motion\"}}"),
     4, "error: not-a-regular-file: n.file: ", "name a file", 3, 1},
    {"NoFileNamed", file(R"("n": {"type": "Load"})", ",\n\"publish\": {\"outputs\": {\"o\": \"n.motion\"}}"),
     4, "error: no-file: n.file: ", "set file", 3, 1},
    {"LeadsOut", exported(R"("file": "../walk.bvh")"), 4,
     "error: leads-outside: n.file: ", "--allow-outside"},
    {"AbsoluteOutput", exported(R"("file": "/walk.bvh")"), 4, "error: leads-outside: n.file: ", "--out"},
    {"TwoExportsOnOneFile",
     file(R"("n": {"type": "Export", "params": {"file": "a.bvh"}, "inputs": {"motion": "w.motion"}},
"m": {"type": "Export", "params": {"file": "./a.bvh"}, "inputs": {"motion": "w.motion"}})"),
     4, "error: same-file: n.file: ", "own"},

    // What an Export can hold.
    {"FormatCantHoldIt", file(R"("c": {"type": "DetectContacts", "inputs": {"motion": "w.motion"}},
"n": {"type": "Export", "params": {"file": "a.bvh"}, "inputs": {"contacts": "c.contacts"}})"),
     5, "error: wrong-content: n.contacts: ", "csv, json"},
    {"PointsAsBvh", exported(R"("file": "a.bvh")", R"("points": "w.motion")"), 4,
     "error: wrong-content: n.points: ", "c3d, trc, csv"},
    {"EndingWithoutAFormat", exported(R"("file": "walk.xyz")"), 4, "error: unknown-format: n.file: ", "bvh"},
    {"NoEnding", exported(R"("file": "walk")"), 4, "error: unknown-format: n.file: ", "bvh"},
    {"FormatAgainstEnding", exported(R"("file": "a.bvh", "format": "c3d")"), 4,
     "error: wrong-content: n.motion: ", "bvh"},
    {"SeveralInputs", exported(R"("file": "a.csv")", R"("points": "w.motion", "motion": "w.motion")"), 4,
     "error: several-inputs: n.points: ", "one Export a file"},
    {"NothingToWrite", exported(R"("file": "a.bvh")", ""), 4, "error: open-input: n: ", "motion"},

    // Links.
    {"UnknownInput", with("Trim", "", R"("moton": "w.motion")"), 4,
     "error: unknown-port: n.moton: ", "motion"},
    {"UnknownOutput", with("Trim", "", R"("motion": "w.moton")"), 4,
     "error: unknown-port: n.motion: ", "motion"},
    {"UnknownNode", with("Trim", "", R"("motion": "wlk.motion")"), 4, "error: unknown-node: n.motion: ", "w"},
    {"UnknownNodeInAnUnknownType", with("Trimm", "", R"("motion": "wlk.motion")"), 4,
     "warning: unknown-node: n.motion: ", "w", 0, 0},
    {"NoLink", with("Trim", "", R"("motion": "w")"), 4, "error: bad-link: n.motion: ", "node.port"},
    {"WrongPortType", with("StyleTransfer", "", R"("motion": "w.motion", "style": "w.motion")"), 4,
     "error: type-mismatch: n.style: ", "Stats"},
    {"OpenInput", with("Trim", ""), 4, "error: open-input: n.motion: ", "Motion"},
    {"ListOnASinglePort", with("Trim", "", R"("motion": ["w.motion"])"), 4,
     "error: one-link: n.motion: ", "node.port"},
    {"SingleOnAListPort", with("Concatenate", "", R"("motions": "w.motion")"), 4,
     "error: needs-list: n.motions: ", "["},
    {"Cycle", file(R"("n": {"type": "Trim", "inputs": {"motion": "m.motion"}},
"m": {"type": "Trim", "inputs": {"motion": "n.motion"}})"),
     5, "error: cycle: m.motion: ", "remove"},
    {"SwitchPastItsLinks", with("Switch", R"("index": 2)", R"("inputs": ["w.motion", "w.motion"])"), 4,
     "error: index-out-of-range: n.index: ", "from 0"},

    // Values by variables.
    {"VariablesAsAList", file("\"n\": {\"type\": \"Gait\"}", ",\n\"variables\": []"), 6,
     "error: wrong-type: ", "object"},
    {"BadVariableName", file("\"n\": {\"type\": \"Gait\"}", ",\n\"variables\": {\"2nd\": 1}"), 6,
     "error: bad-name: ", "letter"},
    {"VariableOutOfRange",
     file(R"("n": {"type": "Gait", "params": {"speed": "${pace}"}})", ",\n\"variables\": {\"pace\": -1}"), 4,
     "error: out-of-range: n.speed: ", "number"},
    {"VariableWithoutItsEnd", exported(R"("file": "${shot.bvh")"), 4,
     "error: bad-variable: n.file: ", "${name}"},
    {"ListInAPath",
     file(R"("n": {"type": "Load", "params": {"file": "${shot}.bvh"}})", ",\n\"variables\": {\"shot\": [1]}"),
     4, "error: bad-variable: n.file: ", "string"},
    {"OnlyABatchKnowsTheItem", exported(R"("file": "${item}.bvh")"), 4, "", "", 0, 3,
     "error: undefined-variable: n.file"},

    // What is published.
    {"PublishesAParamOfNobody", published(R"("params": {"p": "m.cutoff"})"), 6,
     "error: unknown-node: publish.params.p: ", "there is n, w"},
    {"PublishesAnUnknownParam", published(R"("params": {"p": "n.cutof"})"), 6,
     "error: unknown-param: publish.params.p: ", "cutoff"},
    {"PublishesAnUnknownInput", published(R"("inputs": {"p": "n.moton"})"), 6,
     "error: unknown-port: publish.inputs.p: ", "motion"},
    {"PublishesAnUnknownOutput", published(R"("outputs": {"o": "n.moton"})"), 6,
     "error: unknown-port: publish.outputs.o: ", "motion"},
    {"PublishesTwoTypesTogether", published(R"("params": {"p": ["n.cutoff", "w.gait"]})"), 6,
     "error: type-mismatch: publish.params.p: ", "one type"},
    {"PublishesAsFile", published(R"("params": {"file": "n.cutoff"})"), 6,
     "error: bad-name: ", "own parameter"},
    {"PublishesUnderABadName", published(R"("params": {"cut off": "n.cutoff"})"), 6,
     "error: bad-name: ", "letter"},
    {"PublishesAnEmptyList", published(R"("params": {"p": []})"), 6,
     "error: bad-link: publish.params.p: ", "leave the name out"},
    {"PublishesNoParam", published(R"("params": {"p": "cutoff"})"), 6,
     "error: bad-link: publish.params.p: ", "node.param"},
    {"PublishesOneOutputOfTwo", published(R"("outputs": {"o": ["n.motion", "w.motion"]})"), 6,
     "error: one-link: publish.outputs.o: ", "node.port"},
    {"PublishesAnUnknownKind", published(R"("parameters": {"p": "n.cutoff"})"), 6,
     "error: unknown-key: ", "params"},

    // Graph files inside graphs. One that can't be used is a missing node: only what needs it doesn't run.
    {"GraphFileMissing", inside("smoth"), 4, "error: missing-file: g.file: ", "smooth.kg.json", 3, 3,
     "error: missing-node: g: "},
    {"GraphWithoutAFile", file("\"g\": {\"type\": \"Graph\"}", result), 4,
     "error: missing-file: g.file: ", "parameter \"file\"", 3, 3, "error: missing-node: g: "},
    {"GraphFileCutOff", inside("cut"), 4, "error: broken-graph: g.file: ", "validate", 3, 3,
     "error: missing-node: g: "},
    {"GraphFileUnfinished", inside("unfinished"), 4, "error: broken-graph: g.file: ", "validate", 3, 3,
     "error: missing-node: g: "},
    {"GraphFileWithConflictMarkers", inside("merging"), 4, "error: broken-graph: g.file: ", "validate", 3, 3,
     "error: missing-node: g: "},
    {"GraphFileOfANewerSchema", inside("newer"), 4, "error: broken-graph: g.file: ", "newer", 3, 3,
     "error: missing-node: g: "},
    {"GraphFileAsksForAVariable", inside("asks"), 4, "error: broken-graph: g.file: ", "validate", 3, 3,
     "error: missing-node: g: "},
    {"GraphFileNotNeeded", inside("smoth", "", "", ",\n\"publish\": {\"outputs\": {\"o\": \"w.motion\"}}"), 4,
     "error: missing-file: g.file: ", "smooth.kg.json", 3, 0, "warning: missing-file: g.file: "},
    {"GraphsInACircle", inside("circle"), 4, "error: graph-cycle: g.file: ", "inside itself"},
    {"UnknownTypeInsideAGraph", inside("misspelt"), 4, "warning: unknown-type: g/f: ", "Filter", 0, 3,
     "error: missing-node: g/f: ", "lib/misspelt.kg.json"},
    {"MissingFileInsideAGraph", inside("clipless"), 4, "error: missing-file: g/l.file: ", "relative", 3, 1,
     "error: missing-file: g/l.file: ", "lib/clipless.kg.json"},
    {"MissingFileTwoGraphsDeep", inside("deeper"), 4, "error: missing-file: g/d/l.file: ", "relative", 3, 1,
     "error: missing-file: g/d/l.file: ", "lib/clipless.kg.json"},
    {"GraphFileInAnUndefinedPlace",
     file(R"("g": {"type": "Graph", "params": {"file": "${lib}/smooth.kg.json"}})", result), 4,
     "error: undefined-variable: g.file: ", "--var lib="},
    {"UnknownParamOfAGraph", inside("smooth", R"("cutof": 3)"), 4,
     "error: unknown-param: g.cutof: ", "cutoff"},
    {"ParamOfAnInnerNode", inside("smooth", R"("f.cutoff": 3)"), 4,
     "error: unknown-param: g.f.cutoff: ", "cutoff"},
    {"ParamOfAGraphOutOfRange", inside("smooth", R"("cutoff": -3)"), 4,
     "error: out-of-range: g.cutoff: ", "0.001"},
    {"ParamOfAGraphOfAnotherType", inside("smooth", R"("cutoff": "low")"), 4,
     "error: wrong-type: g.cutoff: ", "number"},
    {"BadChoiceOfAGraph", inside("smooth", R"("gait": "sneek")"), 4, "error: bad-choice: g.gait: ", "sneak"},
    {"UndefinedVariableOfAGraph", inside("smooth", R"("cutoff": "${low}")"), 4,
     "error: undefined-variable: g.cutoff: ", "--var low="},
    {"UnknownInputOfAGraph", inside("smooth", "", R"("moton": "w.motion")"), 4,
     "error: unknown-port: g.moton: ", "motion"},
    {"OpenInputOfAGraph", inside("open"), 4, "error: open-input: g.motion: ", "Motion"},
    {"InputOfAGraphOfAnotherType",
     file(
         R"("g": {"type": "Graph", "params": {"file": "lib/smooth.kg.json"}, "inputs": {"motion": "s.stats"}},
"s": {"type": "QuatStats", "inputs": {"motion": "w.motion"}})"),
     4, "error: type-mismatch: g.motion: ", "Motion"},
    {"ListOnAnInputOfAGraph", inside("smooth", "", R"("motion": ["w.motion"])"), 4,
     "error: one-link: g.motion: ", "node.port"},
    {"PublishesAnUnknownParamOfAGraph",
     inside("smooth", "", "", ",\n\"publish\": {\"params\": {\"p\": \"g.cutof\"}}"), 6,
     "error: unknown-param: publish.params.p: ", "cutoff"},
    {"UnknownOutputOfAGraph", behind("g.stats"), 5, "error: unknown-port: n.motion: ", "metrics, motion"},
    {"OutputOfAGraphOfAnotherType", behind("g.metrics"), 5,
     "error: type-mismatch: n.motion: ", "\"motion\" would fit"},
    {"LinkToAnInnerNode", behind("g/f.motion"), 5, "error: bad-link: n.motion: ", "node.port"},
};

class BrokenGraphs : public ProgramTest, public testing::WithParamInterface<Mistake> {};
INSTANTIATE_TEST_SUITE_P(Table, BrokenGraphs, testing::ValuesIn(mistakes),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BrokenGraphs, AreToldAndWriteNothing) {
  const Mistake& mistake = GetParam();
  write("g.kg.json", mistake.text);
  for (const auto& [name, text] : libraries) write("lib/" + std::string(name) + ".kg.json", text);
  const auto before = files();
  const Ran validated = run({"validate", "g.kg.json"});
  EXPECT_EQ(validated.exit, mistake.validate) << validated.out;
  bool found = *mistake.told == 0;
  for (std::size_t start = 0; start < validated.out.size();) {
    const std::size_t end = validated.out.find('\n', start);
    const std::string line = validated.out.substr(start, end - start);
    const std::size_t hint = line.find('(');
    found |= line.starts_with(std::string(mistake.in) + ":" + std::to_string(mistake.line) + ":") &&
             line.find(mistake.told) != line.npos && hint != line.npos && *mistake.hint != 0 &&
             line.find(mistake.hint, hint) != line.npos;
    start = end + 1;
  }
  EXPECT_TRUE(found) << validated.out;

  const Ran ran = run({"run", "g.kg.json"});
  EXPECT_EQ(ran.exit, mistake.run) << ran.err;
  std::string told = mistake.when_run;
  if (told.empty() && *mistake.told) {  // "severity: code: …": run says the same
    told = mistake.told;
    told.resize(told.find(": ", told.find(": ") + 2));
  }
  EXPECT_THAT(ran.err, HasSubstr(told));
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace kinegraph
