// What ends a fit: the word that its directory, its table and its last line have for it.
#pragma once
#include <espalier/core/names.h>

namespace espalier {

enum class FitStop {
  evaluations,     ///< of the search, all that the budget allows
  time,            ///< as long as the budget allows
  target_fitness,  ///< the best is as good as was asked for
  converged,       ///< the optimiser had nothing left to try
  rounds,          ///< of the refinement, all that the budget allows
  stages,          ///< no search was asked for
  interrupted      ///< by its caller, or by Ctrl-C
};

template <>
inline constexpr auto kNames<FitStop> = std::to_array<Name<FitStop>>({{FitStop::evaluations, "evaluations"},
                                                                      {FitStop::time, "time"},
                                                                      {FitStop::target_fitness,
                                                                       "target_fitness"},
                                                                      {FitStop::converged, "converged"},
                                                                      {FitStop::rounds, "rounds"},
                                                                      {FitStop::stages, "stages"},
                                                                      {FitStop::interrupted, "interrupted"}});

}  // namespace espalier
