// NLopt's derivative-free algorithms that take bounds (S. G. Johnson, The NLopt package), one row each, with
// what has to be known about them beyond their name. NLopt 2.7.1, as measured:
//  - a local method stops when its steps are small, long before the budget: restarted, row by row of `kind`;
//  - DIRECT, CRS2, ISRES, ESCH, AGS and MLSL never stop by themselves; ORIG_DIRECT may;
//  - MLSL ignores its own tolerances (its local method's count), and its bookkeeping grows with the square
//    of a run's length: its runs are cut and started anew;
//  - ORIG_DIRECT allocates for its largest number of evaluations, so that one is fixed.
//    Stopped within its first 2n + 1 points it reads memory that it never set, and may crash;
//  - all three NOSCAL variants of DIRECT are the same deterministic search;
//  - NEWUOA_BOUND's own work takes milliseconds a step, and it needs 2 dimensions; AGS takes 10 at most.
#pragma once
#include <nlopt.h>

#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace espalier {

enum class NloptKind {
  deterministic,  ///< global, ignores start point and seed: one stream, no restarts
  stochastic,     ///< global, random: several streams; starts anew with other draws where it stops
  multistart,     ///< MLSL with a local method
  local,          ///< from a start point; restarted
};

inline constexpr std::size_t kNoDimensionLimit = std::numeric_limits<std::size_t>::max();
inline constexpr int kNoRunLimit = 0;

struct NloptAlgorithm {
  std::string name;           ///< NLopt's; MLSL with a chosen local method is "GN_MLSL_LDS:LN_SBPLX"
  nlopt_algorithm algorithm;  ///< what nlopt_create gets
  nlopt_algorithm local;      ///< MLSL's local method; else NLOPT_NUM_ALGORITHMS
  NloptKind kind;
  std::string help;
  bool has_population = false;  ///< nlopt_set_population matters
  int run_limit = kNoRunLimit;  ///< evaluations after which one run of it ends
  std::size_t min_dimension = 1, max_dimension = kNoDimensionLimit;
  bool stops_in_first_points = true;  ///< false: may be stopped only after its first 2n + 1 points
};

/// All rows, in the order of the help.
std::span<const NloptAlgorithm> nlopt_algorithms();

}  // namespace espalier
