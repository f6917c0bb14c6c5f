// The table of NLopt's algorithms, with the paper behind each.
#include <fmt/format.h>

#include <vector>

#include <espalier/fitting/optimizers/nlopt_algorithms.h>

namespace espalier {

namespace {

constexpr nlopt_algorithm kNoLocal = NLOPT_NUM_ALGORITHMS;
constexpr int kOrigDirectRunLimit = 100000;
constexpr int kMlslRunLimit = 5000;

std::vector<NloptAlgorithm> global_rows() {
  constexpr auto fixed = NloptKind::deterministic;
  constexpr auto random = NloptKind::stochastic;
  return {
      {"GN_DIRECT", NLOPT_GN_DIRECT, kNoLocal, fixed, "dividing rectangles (Jones et al. 1993)"},
      {"GN_DIRECT_L", NLOPT_GN_DIRECT_L, kNoLocal, fixed,
       "DIRECT biased to local search (Gablonsky, Kelley 2001)"},
      {"GN_DIRECT_L_RAND", NLOPT_GN_DIRECT_L_RAND, kNoLocal, random, "DIRECT_L, ties between sides drawn"},
      {"GN_DIRECT_NOSCAL", NLOPT_GN_DIRECT_NOSCAL, kNoLocal, fixed,
       "as GN_DIRECT_L_NOSCAL: so NLopt 2.7.1 runs it"},
      {"GN_DIRECT_L_NOSCAL", NLOPT_GN_DIRECT_L_NOSCAL, kNoLocal, fixed,
       "DIRECT_L without scaling of the box"},
      {"GN_DIRECT_L_RAND_NOSCAL", NLOPT_GN_DIRECT_L_RAND_NOSCAL, kNoLocal, fixed,
       "as GN_DIRECT_L_NOSCAL: so NLopt 2.7.1 runs it"},
      {"GN_ORIG_DIRECT", NLOPT_GN_ORIG_DIRECT, kNoLocal, fixed, "Gablonsky's original DIRECT (2001)", false,
       kOrigDirectRunLimit, 1, kNoDimensionLimit, false},
      {"GN_ORIG_DIRECT_L", NLOPT_GN_ORIG_DIRECT_L, kNoLocal, fixed, "Gablonsky's original DIRECT_L (2001)",
       false, kOrigDirectRunLimit, 1, kNoDimensionLimit, false},
      {"GN_CRS2_LM", NLOPT_GN_CRS2_LM, kNoLocal, random,
       "controlled random search with local mutation (Kaelo, Ali 2006)", true},
      {"GN_ISRES", NLOPT_GN_ISRES, kNoLocal, random, "evolution strategy with ranking (Runarsson, Yao 2005)",
       true},
      {"GN_ESCH", NLOPT_GN_ESCH, kNoLocal, random, "evolution with Cauchy mutation (da Silva Santos 2010)",
       true},
      {"GN_AGS", NLOPT_GN_AGS, kNoLocal, fixed, "space-filling curves (Sergeyev, Markin 1995; Sovrasov 2018)",
       false, kNoRunLimit, 1, 10},
  };
}

std::vector<NloptAlgorithm> local_rows() {
  constexpr auto local = NloptKind::local;
  return {
      {"LN_COBYLA", NLOPT_LN_COBYLA, kNoLocal, local, "linear models (Powell 1994)"},
      {"LN_BOBYQA", NLOPT_LN_BOBYQA, kNoLocal, local, "quadratic models in a box (Powell 2009)"},
      {"LN_NEWUOA_BOUND", NLOPT_LN_NEWUOA_BOUND, kNoLocal, local,
       "quadratic models (Powell 2004) with Johnson's bounds", false, kNoRunLimit, 2},
      {"LN_PRAXIS", NLOPT_LN_PRAXIS, kNoLocal, local, "principal axes (Brent 1972)"},
      {"LN_NELDERMEAD", NLOPT_LN_NELDERMEAD, kNoLocal, local, "simplex (Nelder, Mead 1965; Box 1965)"},
      {"LN_SBPLX", NLOPT_LN_SBPLX, kNoLocal, local, "simplex on subspaces (Rowan 1990)"},
  };
}

NloptAlgorithm multistart_row(const std::string& mlsl, nlopt_algorithm algorithm, const std::string& suffix,
                              const NloptAlgorithm& local) {
  const bool low_discrepancy = algorithm == NLOPT_G_MLSL_LDS;
  return {mlsl + suffix,
          algorithm,
          local.algorithm,
          NloptKind::multistart,
          fmt::format("multi-level single linkage (Rinnooy Kan, Timmer 1987{}), local {}",
                      low_discrepancy ? "; Kucherenko, Sytsko 2005" : "", local.name),
          true,
          kMlslRunLimit,
          local.min_dimension};
}

/// Both kinds of MLSL: first under NLopt's own name with NLopt's own local method, COBYLA, then with each.
std::vector<NloptAlgorithm> multistart_rows() {
  std::vector<NloptAlgorithm> rows;
  const std::vector<NloptAlgorithm> locals = local_rows();
  for (const auto& [mlsl, algorithm] :
       {std::pair{"GN_MLSL", NLOPT_G_MLSL}, std::pair{"GN_MLSL_LDS", NLOPT_G_MLSL_LDS}}) {
    rows.push_back(multistart_row(mlsl, algorithm, "", locals[0]));
    for (const NloptAlgorithm& local : locals)
      rows.push_back(multistart_row(mlsl, algorithm, ":" + local.name, local));
  }
  return rows;
}

std::vector<NloptAlgorithm> all_rows() {
  std::vector<NloptAlgorithm> rows = global_rows();
  for (auto* more : {multistart_rows, local_rows}) {
    const auto added = more();
    rows.insert(rows.end(), added.begin(), added.end());
  }
  return rows;
}

}  // namespace

std::span<const NloptAlgorithm> nlopt_algorithms() {
  static const std::vector<NloptAlgorithm> rows = all_rows();
  return rows;
}

}  // namespace espalier
