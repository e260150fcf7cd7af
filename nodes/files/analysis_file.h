// Analyses (stats, warp, contacts, metrics …) as JSON that reads back without loss, and as tables.
// A further kind is its three functions, in KIND_file.cpp beside the value, and one line in analysis_kinds().
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"
#include "graph/value.h"

namespace kinegraph {

struct AnalysisKind {
  std::string_view port;                    // of Load and Export, and "kinegraph-PORT" is the file's "format"
  std::string_view type;                    // the port type
  Json (*to_json)(const Value&) = nullptr;  // an object without "format" and "schema"
  ValuePtr (*from_json)(const Json&) = nullptr;  // throws Failure ("bad-analysis") with line and column
  std::string (*to_csv)(const Value&) = nullptr;
};
const std::vector<AnalysisKind>& analysis_kinds();
const AnalysisKind* kind_of_port(std::string_view port);

struct AnalysisFile {
  const AnalysisKind* kind = nullptr;
  ValuePtr value;
};
// Throws Failure: what parse_json finds first, "not-an-analysis", "newer-schema", "bad-analysis".
AnalysisFile read_analysis(std::string_view text);
std::string write_analysis(const AnalysisKind& kind, const Value& value);

Json stats_json(const Value& stats);
ValuePtr stats_of_json(const Json& json);
std::string stats_table(
    const Value& stats);  // joint, mean x y z w, spread, Euler means and spreads; then the root's travel
Json components_json(
    const Value& components);  // mean, mixing matrix, signals, convergence, and the clips themselves
ValuePtr components_of_json(const Json& json);
std::string components_table(const Value& components);  // frame, segment, u1, u2, …
Json warp_json(const Value& warp);
ValuePtr warp_of_json(const Json& json);
std::string warp_table(const Value& warp);  // row, frame shown (one column a path)
Json contacts_json(const Value& contacts);
ValuePtr contacts_of_json(const Json& json);
std::string contacts_table(const Value& contacts);  // frame, time, 0 or 1 for each foot point
Json metrics_json(const Value& metrics);
ValuePtr metrics_of_json(const Json& json);
std::string metrics_table(const Value& metrics);  // name, value, unit

}  // namespace kinegraph
