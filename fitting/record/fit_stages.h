// Which stages a fit goes through once its starts are scored (docs/branches.md): all, or some alone.
#pragma once
#include <string>

#include <espalier/core/names.h>

namespace espalier {

/// Where a fit is: what its trace says of each row.
enum class FitStage { starts, species_space, search, tracing, branches, finish };

template <>
inline constexpr auto kNames<FitStage> = std::to_array<Name<FitStage>>({{FitStage::starts, "starts"},
                                                                        {FitStage::species_space,
                                                                         "species_space"},
                                                                        {FitStage::search, "search"},
                                                                        {FitStage::tracing, "tracing"},
                                                                        {FitStage::branches, "branches"},
                                                                        {FitStage::finish, "finish"}});

struct FitStages {
  bool search = true;    ///< of the parameters
  bool tracing = true;   ///< of the branches of leafless trees
  bool branches = true;  ///< their refinement, in masks of the search's size
  bool finish = true;    ///< the same in masks of twice that size as well

  bool refine() const { return tracing || branches || finish; }
  bool operator==(const FitStages&) const = default;
};

/// "search,tracing,branches,finish", in this order.
std::string to_string(const FitStages& stages);

/// The inverse, in any order; "starts" alone: none. Throws FieldError for other names.
FitStages parse_stages(const std::string& text);

}  // namespace espalier
