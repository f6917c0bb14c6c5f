#include <espalier/core/error.h>
#include <espalier/fitting/search/fit_objective.h>

namespace espalier {

void FitObjective::evaluate(std::span<const double> points, std::span<double> values) const {
  const std::size_t n = dimension();
  ESPALIER_CHECK_EQ(points.size(), values.size() * n);
  std::vector<ParameterValues> candidates(values.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) space_.decode(points.subspan(i * n, n), candidates[i]);
  scorer_.score(candidates, values);
}

}  // namespace espalier
