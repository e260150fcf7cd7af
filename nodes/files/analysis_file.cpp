#include "nodes/files/analysis_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/file/parse_json.h"
#include "graph/json_text.h"
#include "nodes/files/json_fields.h"

namespace kinegraph {

const std::vector<AnalysisKind>& analysis_kinds() {
  static const std::vector<AnalysisKind> kinds = {
      {"stats", "Stats", stats_json, stats_of_json, stats_table},
      {"components", "Components", components_json, components_of_json, components_table},
      {"warp", "Warp", warp_json, warp_of_json, warp_table},
      {"contacts", "Contacts", contacts_json, contacts_of_json, contacts_table},
      {"metrics", "Metrics", metrics_json, metrics_of_json, metrics_table},
  };
  return kinds;
}

const AnalysisKind* kind_of_port(std::string_view port) {
  for (const AnalysisKind& kind : analysis_kinds())
    if (kind.port == port) return &kind;
  return nullptr;
}

namespace {

constexpr std::string_view prefix = "kinegraph-";

}  // namespace

AnalysisFile read_analysis(std::string_view text, Work& work) {
  Diagnostics problems;
  const Json json = parse_json(text, "", problems, &work);
  for (const Diagnostic& problem : problems)
    if (problem.severity == Severity::error) throw Failure(problem);
  auto refuse = [&](const char* code, std::string what, std::string hint) {
    throw Failure(error(code, std::move(what)).hinting(std::move(hint)).in_file({}, json.place));
  };
  const Json* format = json.find("format");
  if (format && *format == Json("kinegraph"))
    refuse("not-an-analysis", "this is a graph, not what one gives",
           "kinegraph get GRAPH NODE.PORT -o FILE writes one of its results");
  if (!format || !format->is_string() || format->string().compare(0, prefix.size(), prefix) != 0)
    refuse("not-an-analysis", "the JSON is no analysis: \"format\" must be \"kinegraph-stats\" or the like",
           "Load reads the JSON that Export writes");
  const std::string port = format->string().substr(prefix.size());
  const AnalysisKind* kind = kind_of_port(port);
  if (!kind) {
    std::string known;
    for (const AnalysisKind& one : analysis_kinds())
      known += fmt::format("{}{}", known.empty() ? "" : ", ", one.port);
    refuse("not-an-analysis", fmt::format("\"{}\" is no kind of analysis", format->string()),
           "known are " + known);
  }
  const double schema = number_member(json, "schema");
  if (schema > 1)
    refuse("newer-schema", fmt::format("the file has schema {:g}, this program reads 1", schema),
           "use a newer Kinegraph");
  return {kind, kind->from_json(json, work)};
}

std::string write_analysis(const AnalysisKind& kind, const Value& value, Work& work) {
  Json json = kind.to_json(value, work);
  json.object()["format"] = std::string(prefix) + std::string(kind.port);
  json.object()["schema"] = 1;
  return indented(json, work);
}

}  // namespace kinegraph
