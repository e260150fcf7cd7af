#include "nodes/motion/metrics.h"

#include <cmath>

#include "nodes/motion/codec.h"

namespace kinegraph {

const Metric* Metrics::find(std::string_view name) const {
  for (const Metric& metric : all)
    if (metric.name == name) return &metric;
  return nullptr;
}

std::size_t Metrics::bytes() const {
  return sizeof(Metrics) + all.size() * (sizeof(Metric) + 32);
}

void Metrics::encode(Encoder& out) const {
  encode_list(out, all, [&](const Metric& metric) {
    out.text(metric.name);
    out.boolean(metric.value.has_value());
    if (metric.value) out.f64(*metric.value);
    out.text(metric.unit);
  });
}

ValuePtr decode_metrics(Decoder& in) {
  auto metrics = std::make_shared<Metrics>();
  metrics->all = decode_list<Metric>(in, [&] {
    Metric metric;
    metric.name = in.text();
    if (in.boolean()) metric.value = in.f64();
    metric.unit = in.text();
    return metric;
  });
  return metrics;
}

std::optional<NonFinite> Metrics::non_finite() const {
  for (const Metric& metric : all)
    if (metric.value && !std::isfinite(*metric.value)) return NonFinite{metric.name, "", {}};
  return {};
}

}  // namespace kinegraph
