// Plants of the prior, grown, drawn and measured: what a posterior is computed from.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <espalier/fitting/posterior/simulations/plant_prior.h>
#include <espalier/render/silhouette.h>

namespace espalier {

/// What a posterior is of: the parameters that the prior moves, then the derived quantities.
struct Unknown {
  std::string name;
  std::string unit;
  bool is_quantity = false;
};

std::vector<Unknown> unknowns_of(const PlantPrior& prior);

struct Simulation {
  std::vector<double>
      unknowns;  ///< in the order of unknowns_of; quantities of a plant of the height asked for
  std::vector<double> summaries;  ///< in the order of summary_names()
};

/// Not thread-safe: one a thread.
class PlantSimulator {
 public:
  /// `prior` must outlive it. height_m: of the tree in the picture, > 0.
  PlantSimulator(const PlantPrior& prior, double height_m);

  /// False where the plant exceeds the budget, or shows nothing.
  bool simulate(const PlantDraw& draw, Simulation& simulation);
  /// Of the last plant simulated: kSummaryFramePx wide and high.
  const Mask& silhouette() const { return mask_; }

 private:
  const PlantPrior& prior_;
  double height_m_;
  std::unique_ptr<SilhouetteRenderer> renderer_;
  Plant plant_;
  Mask mask_;
};

}  // namespace espalier
