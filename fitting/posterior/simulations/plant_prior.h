// What is held likely of a plant before its picture is seen: a bundled species, each the same, whose free
// parameters are moved by half of what species differ among themselves, and random numbers of its own. Moves
// are normal and end at the searched ranges, where they are reflected. The tree's size is left out: a picture
// has no metres. Who knows more of the plant names its species, or what is unknown of it; curves, which no
// species has, are unknown only where they are named.
#pragma once
#include <string>
#include <vector>

#include <espalier/core/random.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/models/preset.h>
#include <espalier/plant/model.h>

namespace espalier {

struct PlantDraw {
  std::size_t species = 0;  ///< index of PlantPrior::species()
  ParameterValues values;
  Seed seed = 0;  ///< of the plant's own random numbers
};

/// What is known, or unknown, of a plant beyond its model.
struct PriorChoice {
  std::vector<std::string> species;  ///< as load_presets takes them; none: the bundled ones
  std::vector<std::string> free;     ///< as SearchChoice::free; none: the rows free by default
};

/// The nearest value that the row may have where it counts in whole numbers.
double whole_where_it_must(const ParameterInfo& row, double value);

class PlantPrior {
 public:
  /// `model` is not owned. Throws InputError where it has fewer than two bundled species, or for a species of
  /// another model; FieldError ("search.free") for unknown names, and for rows in which species do not
  /// differ.
  explicit PlantPrior(const Model& model, const PriorChoice& choice = {});

  const Model& model() const { return *model_; }
  const std::vector<Preset>& species() const { return species_; }
  /// Rows of the model's table that differ between draws beyond what the species' choices make of them.
  const std::vector<std::size_t>& rows() const { return rows_; }
  /// The same key draws the same plant.
  PlantDraw draw(RandomKey key) const;

 private:
  void choose_rows(const std::vector<std::string>& free);
  double moved(std::size_t row, const ParameterValues& species, double steps) const;
  void move_curves(RandomKey key, ParameterValues& values) const;

  const Model* model_;
  std::vector<Preset> species_;
  std::vector<double> spread_;  ///< of the bundled species
  std::vector<std::size_t> rows_;
  SearchSpace curves_;  ///< the numbers of free curves
};

}  // namespace espalier
