// The first stage of a fit that begins in the species space: the coordinates of a point, a box around the
// species, and the trees at its points, made as tall as the target and thinned to the growth budget as start
// points are.
#pragma once
#include <functional>
#include <string>

#include <espalier/fitting/optimizers/optimizer.h>
#include <espalier/fitting/species_space/species_space.h>
#include <espalier/fitting/task/scorer.h>

namespace espalier {

/// The space of the bundled presets of `model`. Throws InputError where there are too few of them.
SpeciesSpace bundled_species_space(const Model& model, int components);

/// Coordinates as the unit box: the range of the species, a little wider at each end.
class SpeciesBox {
 public:
  explicit SpeciesBox(const SpeciesSpace& space);
  std::size_t dimension() const { return static_cast<std::size_t>(lower_.size()); }
  Eigen::VectorXd coordinates(std::span<const double> unit) const;  ///< of units in [0, 1]
  std::vector<double> unit(const Eigen::VectorXd& coordinates) const;

 private:
  Eigen::VectorXd lower_, upper_;
};

/// The score of `start` moved to a point of the box. `prepare` makes a candidate of the values at the point;
/// it is called in parallel, for many of them at once.
class SpaceObjective : public Objective {
 public:
  using Prepare = std::function<void(ParameterValues&)>;
  /// All must outlive the objective.
  SpaceObjective(const SpeciesSpace& space, ParameterValues start, Prepare prepare, Scorer& scorer)
      : space_(space), start_(std::move(start)), box_(space), prepare_(std::move(prepare)), scorer_(scorer) {}
  const SpeciesBox& box() const { return box_; }
  std::size_t dimension() const override { return box_.dimension(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override;
  /// The candidate at a point of the unit box.
  ParameterValues candidate(std::span<const double> unit) const;

 private:
  const SpeciesSpace& space_;
  ParameterValues start_;
  SpeciesBox box_;
  Prepare prepare_;
  Scorer& scorer_;
};

}  // namespace espalier
