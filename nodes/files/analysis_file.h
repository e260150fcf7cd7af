// Analyses (stats, warp, contacts, metrics …) as JSON that reads back without loss, and as tables.
// A further kind is its three functions, in KIND_file.cpp beside the value, and one line in analysis_kinds().
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"
#include "graph/value.h"
#include "graph/work.h"

namespace kinegraph {

struct AnalysisKind {
  std::string_view port;  // of Load and Export, and "kinegraph-PORT" is the file's "format"
  std::string_view type;  // the port type
  Json (*to_json)(const Value&, Work&) = nullptr;  // an object without "format" and "schema"
  ValuePtr (*from_json)(const Json&,
                        Work&) = nullptr;  // throws Failure ("bad-analysis") with line and column
  std::string (*to_csv)(const Value&, Work&) = nullptr;
};
const std::vector<AnalysisKind>& analysis_kinds();
const AnalysisKind* kind_of_port(std::string_view port);

struct AnalysisFile {
  const AnalysisKind* kind = nullptr;
  ValuePtr value;
};
// Throws Failure: what parse_json finds first, "not-an-analysis", "newer-schema", "bad-analysis".
AnalysisFile read_analysis(std::string_view text, Work& work);
std::string write_analysis(const AnalysisKind& kind, const Value& value, Work& work);

Json stats_json(const Value& stats, Work& work);
ValuePtr stats_of_json(const Json& json, Work& work);
std::string stats_table(
    const Value& stats,
    Work& work);  // joint, mean x y z w, spread, Euler means and spreads; then the root's travel
Json components_json(const Value& components,
                     Work& work);  // mean, mixing matrix, signals, convergence, and the clips themselves
ValuePtr components_of_json(const Json& json, Work& work);
std::string components_table(const Value& components, Work& work);  // frame, segment, u1, u2, …
Json warp_json(const Value& warp, Work& work);
ValuePtr warp_of_json(const Json& json, Work& work);
std::string warp_table(const Value& warp, Work& work);  // row, frame shown (one column a path)
Json contacts_json(const Value& contacts, Work& work);
ValuePtr contacts_of_json(const Json& json, Work& work);
std::string contacts_table(const Value& contacts, Work& work);  // frame, time, 0 or 1 for each foot point
Json metrics_json(const Value& metrics, Work& work);
ValuePtr metrics_of_json(const Json& json, Work& work);
std::string metrics_table(const Value& metrics, Work& work);  // name, value, unit

}  // namespace kinegraph
