// Draws of the prior with their pictures' summaries: made once, looked up for every picture. Row i depends on
// (seed, i) alone, so a table can be made in parts, with any number of threads, and grows without changing.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <espalier/fitting/posterior/simulations/plant_prior.h>

namespace espalier {

/// The plant of a row: the first of its attempts, 0, 1, …, that grows within the budget.
PlantDraw draw_of_row(const PlantPrior& prior, Seed seed, std::size_t row, std::uint32_t attempt);

struct ReferenceTable {
  Seed seed = 1;
  double height_m = 10;
  Eigen::MatrixXd unknowns;            ///< a row a draw, columns as unknowns_of says
  Eigen::MatrixXd summaries;           ///< columns as summary_names() says
  std::vector<std::uint32_t> species;  ///< a draw's index of PlantPrior::species()
  std::vector<std::uint32_t> attempt;  ///< which draw of the row it was that grew

  std::size_t size() const { return species.size(); }
};

/// Asked between blocks of draws; false stops.
using TableProgress = std::function<bool(std::size_t done, std::size_t wanted)>;

/// Adds draws up to `size` of them, on `threads` threads (0: one a processor). Stops early where `progress`
/// says so; what was done stays.
void extend_table(const PlantPrior& prior, std::size_t size, int threads, const TableProgress& progress,
                  ReferenceTable& table);

/// The table of a file, of `seed` and `height_m`; an empty one where there is no file. Throws InputError for
/// a file that is damaged, or whose prior, seed or height is another, naming both.
ReferenceTable read_table(const std::filesystem::path& path, const PlantPrior& prior, Seed seed,
                          double height_m);

/// Throws InputError where it cannot be written.
void write_table(const std::filesystem::path& path, const PlantPrior& prior, const ReferenceTable& table);

}  // namespace espalier
