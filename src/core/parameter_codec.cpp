#include <algorithm>

#include <espalier/core/parameter_codec.h>
#include <espalier/core/parameter_table.h>

namespace espalier {

double read_magnitude(const ParameterInfo& row, double number, std::vector<ClampedValue>& clamped) {
  if (number < -1e-9) clamped.push_back({row.full_name(), number, 0});
  return std::max(0.0, number);
}

}  // namespace espalier
