// Named numbers, in a fixed order. A missing one (no plants, no reference) is null, never 0 or NaN.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/value.h"

namespace kinegraph {

struct Metric {
  std::string name;  // [A-Za-z0-9_.-]+; per joint "NAME.JOINT"
  std::optional<double> value;
  std::string unit;
};

class Metrics final : public Value {
 public:
  std::vector<Metric> all;
  const Metric* find(std::string_view name) const;

  std::string_view type() const override { return "Metrics"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;
};
ValuePtr decode_metrics(Decoder& in);

}  // namespace kinegraph
