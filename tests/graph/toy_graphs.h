// Node types without a body, for tests of documents: what is read, checked, edited, written and planned.
#pragma once
#include <string>
#include <vector>

#include "graph/builtin_nodes.h"
#include "graph/compute.h"
#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/registry.h"

namespace kinegraph::toys {

inline NodeType bare(std::string name) {
  NodeType type;
  type.name = std::move(name);
  type.category = "toy";
  type.help = "A toy.";
  type.compute = [](Compute&) {};
  return type;
}

struct Nothing : Value {
  std::string_view type() const override { return "Warp"; }
  std::size_t bytes() const override { return 1; }
  void encode(Encoder&) const override {}
  std::optional<NonFinite> non_finite() const override { return {}; }
};

// Version 1 had a `speed` in percent and a port `in`; version 2 calls the factor `rate`; version 3 the port `motion`.
inline NodeType aged() {
  NodeType type = bare("Aged");
  type.version = 3;
  type.input("motion", {"Motion"}, "m").output("motion", "Motion", "m", "motion");
  type.param("rate", number(1).between(0, 10), "a factor");
  type.migrations = {{1,
                      [](Json::Object& params, Json::Object&) {
                        const auto speed = params.find("speed");
                        if (speed == params.end()) return;
                        if (speed->second.is_number()) params["rate"] = speed->second.number() / 100;
                        params.erase("speed");
                      }},
                     {2, [](Json::Object&, Json::Object& inputs) {
                        const auto in = inputs.find("in");
                        if (in == inputs.end()) return;
                        inputs["motion"] = in->second;
                        inputs.erase("in");
                      }}};
  return type;
}

inline Registry registry() {
  Registry registry;
  for (const char* name : {"Motion", "Stats", "Warp", "Metrics"}) registry.add(ValueType{.name = name, .help = "toy"});
  registry.add(ValueType{
      .name = "Points", .help = "toy", .convert_from = "Motion", .convert = [](const Value&) { return ValuePtr(); }});

  NodeType load = bare("Load");
  load.output("motion", "Motion", "m").output("points", "Points", "p");
  load.param("file", open_file(), "what to read");
  load.param("fps", number(0).between(0, 1000).in("Hz"), "0 = the file's");
  load.param("unit", unit_of({{"auto", ""}, {"cm", ""}, {"m", ""}}), "the file's");
  load.param("range", range(), "frames");
  registry.add(std::move(load));

  NodeType stats = bare("QuatStats");
  stats.input("motion", {"Motion"}, "m").output("stats", "Stats", "s");
  registry.add(std::move(stats));

  NodeType transfer = bare("StyleTransfer");
  transfer.input("motion", {"Motion"}, "m").input("style", {"Stats"}, "s").optional_input("own", {"Stats"}, "s");
  transfer.output("motion", "Motion", "m", "motion");
  transfer.param("amount", number(1).between(0, 1), "how much");
  transfer.param("root", choice({{"both", ""}, {"travel", ""}, {"none", ""}}), "what of the root");
  transfer.param("heading", boolean(true), "keep it");
  transfer.param("joints", pattern("*"), "which");
  transfer.param("seed", integer(0).between(0, 9007199254740991.0), "of chance");
  transfer.param("weights", table(number(1).between(0, 10)), "by joint");
  transfer.param("edits",
                 list(object({required(choice({{"scale", ""}, {"add", ""}}).as("op", "what")),
                              required(integer(1).between(1, 99).as("component", "which")),
                              number(1).as("factor", "times"),
                              list(tuple({integer(0), number(0)})).as("keys", "frame, value")})),
                 "in order");
  registry.add(std::move(transfer));

  NodeType concatenate = bare("Concatenate");
  concatenate.list_input("motions", {"Motion"}, "m").output("motion", "Motion", "m", "motions");
  registry.add(std::move(concatenate));

  NodeType warp = bare("TimeWarp");
  warp.input("source", {"Motion"}, "m").input("reference", {"Motion"}, "m");
  warp.output("warped", "Motion", "m", "source").output("reference", "Motion", "m", "reference");
  warp.output("warp", "Warp", "w");
  warp.outputs.back().constant = [] { return std::make_shared<const Nothing>(); };
  registry.add(std::move(warp));

  NodeType particles = bare("Particles");
  particles.input("points", {"Points"}, "p").output("points", "Points", "p", "points");
  registry.add(std::move(particles));

  NodeType metrics = bare("Metrics");
  metrics.input("motion", {"Motion"}, "m").output("metrics", "Metrics", "m");
  registry.add(std::move(metrics));

  NodeType write = bare("Export");
  write.effect = Effect::writes;
  write.optional_input("motion", {"Motion"}, "m").optional_input("points", {"Points"}, "p");
  write.param("file", save_file().outside_key(), "where to");
  registry.add(std::move(write));

  NodeType check = bare("Check");
  check.effect = Effect::checks;
  check.input("metrics", {"Metrics"}, "m");
  check.param("rules", list(text("")), "what must hold");
  registry.add(std::move(check));

  registry.add(aged());
  registry.add(switch_node());
  registry.add(dot_node());
  registry.add(graph_node());
  return registry;
}

// The example of the contract, word for word.
inline constexpr const char* example = R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "out": {
      "type": "Export",
      "params": {
        "file": "sneaky_walk.bvh"
      },
      "inputs": {
        "motion": "transfer.motion"
      }
    },
    "sneak": {
      "type": "Load",
      "params": {
        "file": "clips/sneak.bvh"
      }
    },
    "style": {
      "type": "QuatStats",
      "inputs": {
        "motion": "sneak.motion"
      }
    },
    "transfer": {
      "type": "StyleTransfer",
      "inputs": {
        "motion": "walk.motion",
        "style": "style.stats"
      }
    },
    "walk": {
      "type": "Load",
      "params": {
        "file": "clips/walk.bvh"
      }
    }
  },
  "publish": {
    "outputs": {
      "result": "transfer.motion"
    },
    "params": {
      "source": "walk.file"
    }
  },
  "ui": {
    "nodes": {
      "walk": {
        "pos": [0, 0]
      }
    }
  }
}
)";

// A graph of these nodes: the text between the braces of "nodes".
inline std::string with_nodes(const std::string& nodes, const std::string& rest = {}) {
  return "{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {" + nodes + "}" + rest + "}";
}

inline std::string all_text(const Diagnostics& problems) {
  std::string text;
  for (const Diagnostic& problem : problems) text += to_text(problem) + "\n";
  return text;
}

// "line:column code" of each.
inline std::vector<std::string> in_short(const Diagnostics& problems) {
  std::vector<std::string> all;
  for (const Diagnostic& problem : problems)
    all.push_back(std::to_string(problem.place.line) + ":" + std::to_string(problem.place.column) + " " + problem.code);
  return all;
}

// The document of a text that must be readable without an error.
inline Document document_of(std::string_view text, const Registry& registry) {
  ReadResult result = read_document(text, "g.kg.json", registry);
  if (has_error(result.problems)) throw std::logic_error(all_text(result.problems));
  return std::move(result.document);
}

}  // namespace kinegraph::toys
