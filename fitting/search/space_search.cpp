#include <algorithm>
#include <charconv>

#include <espalier/core/field_error.h>
#include <espalier/core/parallel_for.h>
#include <espalier/fitting/search/space_search.h>
#include <espalier/fitting/species_space/preset_collection.h>

namespace espalier {

namespace {

constexpr double kMargin = 0.15;  ///< beyond the species, as a share of their range

}  // namespace

SpeciesSpace bundled_species_space(const Model& model, int components) {
  const std::vector<Preset> presets = bundled_species(model.table().model);
  if (presets.size() < 2)
    throw_field_error("space", "got {} bundled presets of {}, expected at least 2", presets.size(),
                      model.table().model);
  return make_species_space(presets, "monotone", components);
}

SpeciesBox::SpeciesBox(const SpeciesSpace& space)
    : lower_(space.species[0].coordinates), upper_(space.species[0].coordinates) {
  for (const SpeciesPoint& species : space.species) {
    lower_ = lower_.cwiseMin(species.coordinates);
    upper_ = upper_.cwiseMax(species.coordinates);
  }
  const Eigen::VectorXd margin = kMargin * (upper_ - lower_);
  lower_ -= margin, upper_ += margin;
}

Eigen::VectorXd SpeciesBox::coordinates(std::span<const double> unit) const {
  ESPALIER_CHECK_EQ(unit.size(), dimension());
  const Eigen::Map<const Eigen::VectorXd> share(unit.data(), lower_.size());
  return lower_ + share.cwiseMax(0).cwiseMin(1).cwiseProduct(upper_ - lower_);
}

std::vector<double> SpeciesBox::unit(const Eigen::VectorXd& coordinates) const {
  const Eigen::VectorXd share = (coordinates - lower_).cwiseQuotient(upper_ - lower_).cwiseMax(0).cwiseMin(1);
  return {share.begin(), share.end()};
}

ParameterValues SpaceObjective::candidate(std::span<const double> unit) const {
  ParameterValues values = plant_moved_to(space_, start_, box_.coordinates(unit)).values;
  prepare_(values);
  return values;
}

void SpaceObjective::evaluate(std::span<const double> points, std::span<double> values) const {
  ESPALIER_CHECK_EQ(points.size(), values.size() * dimension());
  std::vector<ParameterValues> candidates(values.size());
  parallel_for(candidates.size(), [&](std::size_t i) {
    candidates[i] = candidate(points.subspan(i * dimension(), dimension()));
  });
  scorer_.score(candidates, values);
}

}  // namespace espalier
