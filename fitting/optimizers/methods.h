// The methods all_optimizers() is made of, one function a file. To add one, write its file, and declare and
// list its function here: the command line, records, experiments, docs and the conformance suite know it
// then.
#pragma once
#include <memory>
#include <vector>

#include <espalier/fitting/optimizers/optimizer.h>

namespace espalier {

std::unique_ptr<Optimizer> make_random_search();
std::unique_ptr<Optimizer> make_hewitt_ga();
std::unique_ptr<Optimizer> make_ga();
std::unique_ptr<Optimizer> make_cma_es();

/// In the order of the help.
inline constexpr std::unique_ptr<Optimizer> (*kOwnMethods[])() = {make_random_search, make_hewitt_ga, make_ga,
                                                                  make_cma_es};

/// One optimiser a row of the table of NLopt's algorithms (nlopt_algorithms.h).
std::vector<std::unique_ptr<Optimizer>> make_nlopt_optimizers();

}  // namespace espalier
