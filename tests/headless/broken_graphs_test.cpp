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

const Mistake mistakes[] = {
    // Text.
    {"Empty", "", 1, "error: syntax: ", ""},
    {"CutOff", "{\"format\": \"kinegraph\",\n\"schema\": 1", 2, "error: syntax: ", ""},
    {"NotJson", "digraph {}\n", 1, "error: syntax: ", ""},
    {"TrailingComma", "{\"format\": \"kinegraph\",\n\"schema\": 1,\n}", 2,
     "error: trailing-comma: ", "remove"},
    {"Comment", file("// legs\n\"n\": {\"type\": \"Gait\"}"), 4, "error: comment: ", "note"},
    {"ConflictMarkers", file("<<<<<<< ours\n=======\n>>>>>>> theirs"), 4,
     "error: conflict-markers: ", "merge"},
    {"DuplicateKey", file("\"w\": {\"type\": \"Gait\"}"), 4, "error: duplicate-key: ", "line 3"},
    {"NotANumber", with("Gait", R"("speed": NaN)"), 4, "error: not-finite: ", ""},
    {"LeadingZero", with("Gait", R"("speed": 01)"), 4, "error: bad-number: ", ""},
    {"BadUtf8", file("\"n\": {\"type\": \"Gait\", \"note\": \"\xff\"}"), 4, "error: bad-utf8: ", "UTF-8"},
    {"ByteOrderMark", "\xEF\xBB\xBF{}", 1, "error: byte-order-mark: ", "UTF-8"},

    // The file's frame.
    {"NotAGraph", "{\"asset\": {\"version\": \"2.0\"}}", 1, "error: not-a-graph: ", ""},
    {"NewerSchema", "{\"format\": \"kinegraph\", \"schema\": 99, \"nodes\": {}}", 1,
     "warning: newer-schema: ", "newer", 0, 3},
    {"NoSchema", "{\"format\": \"kinegraph\"}", 1, "error: missing-key: ", "schema"},
    {"UnknownKey", file("\"n\": {\"type\": \"Gait\"}", ",\n\"node\": {}"), 6,
     "error: unknown-key: ", "nodes"},
    {"NoNodes", "{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {}}", 1, "", "", 0, 2},
    {"BadNodeName", file("\"left leg\": {\"type\": \"Gait\"}"), 4, "error: bad-name: ", ""},
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
    {"WrongType", with("Gait", R"("speed": "fast")"), 4, "error: wrong-type: n.speed: ", ""},
    {"NumberAsText", with("Gait", R"("speed": "1.2")"), 4, "error: wrong-type: n.speed: ", "number"},
    {"OutOfRange", with("Filter", R"("cutoff": -6)", moved), 4, "error: out-of-range: n.cutoff: ", "0.001"},
    {"NotWhole", with("Gait", R"("seed": 0.5)"), 4, "error: not-an-integer: n.seed: ", "whole"},
    {"BadChoice", with("Gait", R"("gait": "sneek")"), 4, "error: bad-choice: n.gait: ", "sneak"},
    {"RangeTurnedRound", with("Trim", R"("range": [30, 10])", moved), 4,
     "error: bad-range: n.range: ", "start"},
    {"RangeOfThree", with("Trim", R"("range": [1, 2, 3])", moved), 4, "error: ", ""},
    {"BadPattern", with("Filter", R"("joints": "Left\\")", moved), 4, "error: ", ""},
    {"ListWhereOneBelongs", with("Gait", R"("speed": [1])"), 4, "error: wrong-type: n.speed: ", ""},
    {"BadRule", with("Check", R"("rules": ["skate << 1"])", R"("metrics": "m.metrics")"), 4,
     "error: bad-rule: n.rules", "NAME"},
    {"FieldMissing", with("DetectContacts", R"("edits": [{"part": "ball", "range": [0, 3]}])", moved), 4,
     "error: missing-key: n.edits[0]", "string"},
    {"FieldUnknown", with("DetectContacts", R"("edits": [{"foot": "left", "rnage": [0, 3]}])", moved), 4,
     "error: unknown-key: n.edits[0]", "range"},
    {"UnitThatIsNone", exported(R"("file": "a.bvh", "unit": "feet")"), 4, "error: ", ""},

    // Variables.
    {"UndefinedVariable", with("Gait", R"("speed": "${pace}")"), 4,
     "error: undefined-variable: n.speed: ", ""},
    {"UndefinedVariableInAPath", exported(R"("file": "${shot}.bvh")"), 4,
     "error: undefined-variable: n.file: ", ""},
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
     4, "error: not-a-regular-file: n.file: ", "", 3, 1},
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
     "error: one-link: n.motion: ", ""},
    {"SingleOnAListPort", with("Concatenate", "", R"("motions": "w.motion")"), 4,
     "error: needs-list: n.motions: ", "["},
    {"Cycle", file(R"("n": {"type": "Trim", "inputs": {"motion": "m.motion"}},
"m": {"type": "Trim", "inputs": {"motion": "n.motion"}})"),
     5, "error: cycle: m.motion: ", "remove"},
    {"SwitchPastItsLinks", with("Switch", R"("index": 2)", R"("inputs": ["w.motion", "w.motion"])"), 4,
     "error: index-out-of-range: n.index: ", "from 0"},
};

class BrokenGraphs : public ProgramTest, public testing::WithParamInterface<Mistake> {};
INSTANTIATE_TEST_SUITE_P(Table, BrokenGraphs, testing::ValuesIn(mistakes),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BrokenGraphs, AreToldAndWriteNothing) {
  const Mistake& mistake = GetParam();
  write("g.kg.json", mistake.text);
  const auto before = files();
  const Ran validated = run({"validate", "g.kg.json"});
  EXPECT_EQ(validated.exit, mistake.validate) << validated.out;
  bool found = *mistake.told == 0;
  for (std::size_t start = 0; start < validated.out.size();) {
    const std::size_t end = validated.out.find('\n', start);
    const std::string line = validated.out.substr(start, end - start);
    const bool here = line.starts_with("g.kg.json:" + std::to_string(mistake.line) + ":") &&
                      line.find(mistake.told) != line.npos;
    const std::size_t hint = line.find('(');
    found |=
        here && (*mistake.hint == 0 || (hint != line.npos && line.find(mistake.hint, hint) != line.npos));
    start = end + 1;
  }
  EXPECT_TRUE(found) << validated.out;

  const Ran ran = run({"run", "g.kg.json"});
  EXPECT_EQ(ran.exit, mistake.run) << ran.err;
  const std::string told = mistake.told;  // "severity: code: …": run says the same
  if (!told.empty()) {
    EXPECT_THAT(ran.err, HasSubstr(told.substr(0, told.find(": ", told.find(": ") + 2))));
  }
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace kinegraph
