// The species space: presets as points of a plane (or of more dimensions), by principal components of their
// encoded values [CH §3.3.1]. A point of it is a plant: the mean, plus its coordinates times the components,
// with the choices that the species vote for (choice_votes.h). What the plane leaves out of each species is
// measured, never hidden.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <espalier/fitting/species_space/encoding.h>
#include <espalier/fitting/species_space/principal_components.h>
#include <espalier/models/preset.h>
#include <espalier/plant/model.h>

namespace espalier {

/// A preset and where it lies.
struct SpeciesPoint {
  std::string name;
  ParameterValues values;
  Eigen::VectorXd coordinates;
  bool demonstration = false;  ///< no species: it has no vote on choices (choice_votes.h)
};

struct SpeciesSpace {
  const Model* model = nullptr;  ///< not owned
  std::shared_ptr<const Encoding> encoding;
  std::vector<SpeciesPoint> species;
  PrincipalComponents pca;

  int dimension() const { return pca.count(); }
};

/// Presets of one model, at least two. components: at least 1, at most the rank. Throws InputError for fewer,
/// for presets of several models, where all are the same, or components is out of range. Curves that are
/// neutral in all presets have no columns.
SpeciesSpace make_species_space(std::span<const Preset> presets, const std::string& encoding, int components);

/// Where a plant lies in the space, or its projection.
Eigen::VectorXd coordinates_of(const SpeciesSpace& space, const ParameterValues& values);

/// A plant at a point, and what it took to get it.
struct PlantAtPoint {
  ParameterValues values;             ///< valid
  std::vector<ClampedValue> clamped;  ///< of the values that mean something to this plant
  std::string nearest;                ///< species
  double outside = 0;  ///< distance to the convex hull of the species, in units of the coordinates
};

/// coordinates: dimension() finite numbers. Numbers are first clamped to the species' own range, a quarter
/// wider at each end, then to what is valid.
PlantAtPoint plant_at(const SpeciesSpace& space, const Eigen::VectorXd& coordinates);

/// The plant that lies at `coordinates` while it keeps its residual: what the space leaves out of `values`,
/// and their choices. At its own coordinates it is `values`, bit for bit.
PlantAtPoint plant_moved_to(const SpeciesSpace& space, const ParameterValues& values,
                            const Eigen::VectorXd& coordinates);

/// The differences between a species and its point in the space, in standard deviations: root mean squares.
struct ReconstructionError {
  std::vector<double> of_species;             ///< over the columns that mean something to it
  std::vector<double> of_columns;             ///< over the species to which the column means something
  std::vector<std::string> constant_columns;  ///< the same in all species: carried as they are
};

ReconstructionError reconstruction_error(const SpeciesSpace& space);

/// The columns with the largest loadings on the components shown, largest first: how far each moves the
/// point.
struct Loading {
  std::string column;
  Eigen::VectorXd on_components;
};

std::vector<Loading> strongest_loadings(const SpeciesSpace& space, std::size_t count);

}  // namespace espalier
