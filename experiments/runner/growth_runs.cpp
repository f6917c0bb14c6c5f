#include <fmt/format.h>

#include <espalier/core/files.h>
#include <espalier/experiments/declaration/target_files.h>
#include <espalier/experiments/growth/growth_phases.h>
#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/runner/growth_runs.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// Whose trees a run grows, as tables name it.
struct GrownTree {
  std::string species, model;
  std::function<std::unique_ptr<TimedGrower>()> make;
};

struct Totals {
  double stems = 0, knots = 0, leaves = 0, seconds = 0;
};

/// One row of samples.csv.
std::vector<std::string> sample(TimedGrower& grower, const GrownTree& tree, Seed seed, Totals& totals) {
  const GrowthTimes times = grower.grow(seed);
  const Plant& plant = grower.plant();
  totals.stems += static_cast<double>(plant.stems.size());
  totals.knots += static_cast<double>(plant.knots.size());
  totals.leaves += static_cast<double>(plant.leaves.size());
  totals.seconds += times.all_s;
  return {tree.species,
          tree.model,
          fmt::format("{}", seed),
          fmt::format("{}", plant.knots.size()),
          fmt::format("{}", plant.leaves.size()),
          table_cell(times.stems_s),
          table_cell(times.leaves_s),
          table_cell(times.derivation_s),
          table_cell(times.interpretation_s)};
}

std::optional<Measured> grow_trees(const GrownTree& tree, int seeds, const fs::path& directory,
                                   const RunContext& context) {
  const std::unique_ptr<TimedGrower> grower = tree.make();
  CsvTable samples{growth_sample_columns(), {}, ""};
  Totals totals;
  for (int seed = 1; seed <= seeds; ++seed) {
    if (context.stop_requested()) return std::nullopt;
    samples.rows.push_back(sample(*grower, tree, static_cast<Seed>(seed), totals));
    context.on_progress(static_cast<double>(seed) / seeds);
  }
  fs::create_directories(directory);
  write_file_atomically(directory / "samples.csv", to_csv(samples));
  const auto mean = [&](double total) { return table_number(total / seeds); };
  return Measured{
      {{"stems", mean(totals.stems)}, {"knots", mean(totals.knots)}, {"leaves", mean(totals.leaves)}},
      {{"seconds_per_tree", mean(totals.seconds)}}};
}

std::vector<GrownTree> trees_of(const GrowthDeclaration& growth) {
  std::vector<GrownTree> trees;
  trees.reserve(growth.species.size() + growth.models.size());
  for (const std::string& species : growth.species)
    trees.push_back({species, load_preset(species).model, [species] { return time_preset(species); }});
  for (const GrownLsystem& lsystem : growth.models)
    trees.push_back({lsystem.label, fs::path(lsystem.model).filename().string(),
                     [lsystem] { return time_lsystem(lsystem.model); }});
  return trees;
}

std::string name_of_run(const GrownTree& tree) {
  const std::string species = directory_name(fs::path(tree.species).stem());
  return tree.model.ends_with(".lsys") ? species + "-lsystem" : species;
}

}  // namespace

std::vector<std::string> growth_sample_columns() {
  return {"species",
          "model",
          "seed",
          "knots",
          "leaves",
          "stem_seconds",
          "leaf_seconds",
          "derivation_seconds",
          "interpretation_seconds"};
}

Plan plan_growth(const GrowthDeclaration& growth) {
  Plan plan{.label_columns = {"species", "model"},
            .result_columns = {"stems", "knots", "leaves"},
            .time_columns = {"seconds_per_tree"},
            .runs = {},
            .one_at_a_time = true};
  for (const GrownTree& tree : trees_of(growth))
    plan.runs.push_back({name_of_run(tree),
                         {{"species", tree.species}, {"model", tree.model}},
                         [tree, seeds = growth.seeds](const fs::path& run, const RunContext& context) {
                           return grow_trees(tree, seeds, run, context);
                         }});
  make_names_unique(plan);
  return plan;
}

}  // namespace espalier
