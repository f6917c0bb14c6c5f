// How sure a fit is of each parameter. Two measures, both as a share of the range that was searched: how far
// apart the good solutions of the archive lie, and how much worse the picture gets when the best solution
// moves by a fixed step along that parameter alone, with the same random numbers of the tree. What the
// picture does not determine shows as a wide spread, or as a step that costs nothing.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/random.h>
#include <espalier/fitting/identifiability/solution_archive.h>
#include <espalier/fitting/task/scorer.h>

namespace espalier {

enum class Identifiability { determined, partly, open, no_effect };

/// "determined", "partly", "open", "no effect".
std::string identifiability_name(Identifiability identifiability);

/// The step of the sensitivity, as a share of the range; whole numbers move by one at least.
inline constexpr double kSensitivityStep = 0.1;

struct ParameterIdentifiability {
  FreeParameter parameter;
  double best = 0;                   ///< value
  double lowest = 0, highest = 0;    ///< values in the archive
  double spread = 0;                 ///< of the archive, share of the range
  std::optional<double> rise_below;  ///< of the score by a step down; none where the range ends there
  std::optional<double> rise_above;  ///< by a step up
  Identifiability identifiability = Identifiability::open;

  /// The smaller rise of the two.
  double least_rise() const;
};

struct IdentifiabilityReport {
  std::vector<ParameterIdentifiability> parameters;  ///< in the order of the space; empty: not measured
  double tolerance = 0;  ///< a rise of the score up to this still is a good solution
  long evaluations = 0;  ///< that it took
};

/// Steps around the archive's best, at most `allowed` evaluations of them. The first ones measure
/// sensitivity; where more are allowed, the others look for solutions that are as good and lie elsewhere.
/// Good ones join the archive, but none that is better than its best. Not measured where the archive is empty
/// or the steps are more than allowed. The same report for any number of threads.
IdentifiabilityReport measure_identifiability(SolutionArchive& archive, Scorer& scorer, long allowed,
                                              Seed seed);

}  // namespace espalier
