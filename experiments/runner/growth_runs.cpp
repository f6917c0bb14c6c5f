#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include <espalier/core/files.h>
#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/runner/growth_runs.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRepeats = 3;  ///< of each growth; the shortest counts, which other programs disturbed least

/// A species with its leaves and without them.
struct Grower {
  const Model& model;
  ParameterValues values, bare;
  Plant plant;

  explicit Grower(const Preset& preset)
      : model(model_by_name(preset.model)), values(preset.values), bare(preset.values) {
    if (const auto row = model.table().find(Role::leaf_count)) bare[*row] = 0;
  }
  double seconds(const ParameterValues& of, Seed seed) {
    double shortest = 0;
    for (int i = 0; i < kRepeats; ++i) {
      const auto began = Clock::now();
      model.generate(of, seed, {}, plant);
      const double took = std::chrono::duration<double>(Clock::now() - began).count();
      shortest = i == 0 ? took : std::min(shortest, took);
    }
    return shortest;
  }
};

struct Totals {
  double stems = 0, knots = 0, leaves = 0, seconds = 0;
};

/// One row of samples.csv. Leaves take what a tree takes longer than without them.
std::vector<std::string> sample(Grower& grower, const std::string& species, Seed seed, Totals& totals) {
  const double stems_s = grower.seconds(grower.bare, seed), all_s = grower.seconds(grower.values, seed);
  const Plant& plant = grower.plant;
  totals.stems += static_cast<double>(plant.stems.size());
  totals.knots += static_cast<double>(plant.knots.size());
  totals.leaves += static_cast<double>(plant.leaves.size());
  totals.seconds += all_s;
  return {species,
          fmt::format("{}", seed),
          fmt::format("{}", plant.knots.size()),
          fmt::format("{}", plant.leaves.size()),
          table_number(stems_s),
          table_number(std::max(0.0, all_s - stems_s))};
}

std::optional<Measured> grow_species(const std::string& species, int seeds, const fs::path& directory,
                                     const RunContext& context) {
  Grower grower(load_preset(species));
  CsvTable samples{{"species", "seed", "knots", "leaves", "stem_seconds", "leaf_seconds"}, {}, ""};
  Totals totals;
  for (int seed = 1; seed <= seeds; ++seed) {
    if (context.stop_requested()) return std::nullopt;
    samples.rows.push_back(sample(grower, species, static_cast<Seed>(seed), totals));
    context.on_progress(static_cast<double>(seed) / seeds);
  }
  fs::create_directories(directory);
  write_file_atomically(directory / "samples.csv", to_csv(samples));
  const auto mean = [&](double total) { return table_number(total / seeds); };
  return Measured{
      {{"stems", mean(totals.stems)}, {"knots", mean(totals.knots)}, {"leaves", mean(totals.leaves)}},
      {{"seconds_per_tree", mean(totals.seconds)}}};
}

}  // namespace

Plan plan_growth(const GrowthDeclaration& growth) {
  Plan plan{.label_columns = {"species"},
            .result_columns = {"stems", "knots", "leaves"},
            .time_columns = {"seconds_per_tree"},
            .runs = {},
            .one_at_a_time = true};
  for (const std::string& species : growth.species)
    plan.runs.push_back({directory_name(fs::path(species).stem()),
                         {{"species", species}},
                         [species, growth](const fs::path& run, const RunContext& context) {
                           return grow_species(species, growth.seeds, run, context);
                         }});
  make_names_unique(plan);
  return plan;
}

}  // namespace espalier
