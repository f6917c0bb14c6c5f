// Measures as JSON: an object with a key a measure, in the order of the table. Unknown ones are left out.
#pragma once
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include <espalier/image/measures/metric_table.h>

namespace espalier {

inline void to_json(nlohmann::ordered_json& json, const MaskMetrics& metrics) {
  json = nlohmann::ordered_json::object();
  for (std::size_t row = 0; row < kMetricCount; ++row)
    if (!std::isnan(metrics.values[row])) json[kMetrics[row].name] = metrics.values[row];
}

/// A measure that the object lacks, because it is older than the measure, becomes unknown.
template <class Json>
void from_json(const Json& json, MaskMetrics& metrics) {
  for (std::size_t row = 0; row < kMetricCount; ++row)
    metrics.values[row] = json.value(kMetrics[row].name, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace espalier
