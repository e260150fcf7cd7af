#include "nodes/files/analysis_file.h"
#include "nodes/files/decimal.h"
#include "nodes/files/json_fields.h"
#include "nodes/motion/metrics.h"

namespace kinegraph {

Json metrics_json(const Value& value, Work&) {
  Json::Array all;
  for (const Metric& metric : dynamic_cast<const Metrics&>(value).all) {
    Json::Object entry;
    entry["name"] = metric.name;
    entry["value"] = metric.value ? Json(*metric.value) : Json();
    entry["unit"] = metric.unit;
    all.push_back(std::move(entry));
  }
  Json::Object out;
  out["metrics"] = std::move(all);
  return out;
}

ValuePtr metrics_of_json(const Json& json, Work&) {
  auto metrics = std::make_shared<Metrics>();
  for (const Json& entry : list_member(json, "metrics")) {
    Metric metric;
    metric.name = text_member(entry, "name");
    if (!member(entry, "value").is_null()) metric.value = number_member(entry, "value");
    metric.unit = text_member(entry, "unit");
    if (metrics->find(metric.name)) bad_analysis(entry, "metric " + metric.name + " stands there twice");
    metrics->all.push_back(std::move(metric));
  }
  return metrics;
}

std::string metrics_table(const Value& value, Work&) {
  std::string out = "name,value,unit\n";
  for (const Metric& metric : dynamic_cast<const Metrics&>(value).all) {
    out += csv_cell(metric.name) + ',';
    if (metric.value) append_shortest(out, *metric.value);
    out += ',' + csv_cell(metric.unit) + '\n';
  }
  return out;
}

}  // namespace kinegraph
