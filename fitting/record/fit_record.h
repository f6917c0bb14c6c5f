// The record of a fit: everything that repeats it, as TOML (run.toml). Two runs of one record give the
// same bits, whatever the threads; one that was stopped by time repeats by the evaluations it made.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <espalier/fitting/optimizers/optimizer.h>
#include <espalier/fitting/picture/tree_kind.h>
#include <espalier/fitting/record/fit_stages.h>
#include <espalier/fitting/record/fit_stop.h>
#include <espalier/fitting/record/freedom.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/fitting/record/view_record.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/plant/model.h>

namespace espalier {

/// Of FitBudget::finish_from: the finish gets the last share of what limits the refinement, rounds or time.
inline constexpr long kLastShare = -1;

/// Ends of a run; the first reached stops it. 0 means no limit; one of the first two must be set.
struct FitBudget {
  long evaluations = 0;
  double seconds = 60;
  double target_fitness = 0;  ///< 1 - dissimilarity, in (0, 1]; 0: none
  long branch_rounds = 0;  ///< of the refinement that follows the search, at most; kWhileTimeLasts: no limit
  long finish_from = kLastShare;  ///< round at which the finish begins; kLastShare: for the last 40 %
};

/// Rounds of refinement until the seconds are over.
inline constexpr long kWhileTimeLasts = -1;

/// The objective of `espalier fit`: outline and distance lead to the ends of thin twigs, gaps keep a fit from
/// filling a porous crown (experiments/closeness.md).
inline constexpr const char* kFitObjective =
    "0.25*truncated_distance+0.15*iou+0.15*tolerant_iou+0.3*outline_iou+0.15*gap_iou";

struct FitRecord {
  std::string model = "weber_penn";
  std::vector<ViewRecord> views;  ///< at least one
  TargetOptions target{.size_px = 128, .one_tree = true, .labels = LabelChoice::automatic};
  std::string target_hash;  ///< of the masks the fit saw; empty until they are read
  std::string objective = "0.5*truncated_distance+0.5*iou";
  int fit_seeds = 1;  ///< trees per candidate, grown with seeds seed, seed + 1, …
  std::string optimizer = "cma_es";
  OptimizerSettings optimizer_settings;
  FitBudget budget;
  FitStages stages;
  GrowthBudget growth{6'000,
                      60'000};  ///< species have 9,000 to 250,000 leaves: fewer make nests of thick wood
  Seed seed = 1;
  std::string start = "auto";
  std::string species;  ///< the preset that the search keeps to; empty: it does not
  std::string space;    ///< "species:2": search two coordinates of the species space first; empty: do not
  long space_evaluations = 300;  ///< most of that first search
  SearchChoice search;
  KindChoice kind = KindChoice::any;  ///< of tree
  bool train_to_target = false;       ///< keep the tree inside of the pictures' outlines
  std::optional<double> height_m;
  double bare_wood_price =
      0.2;  ///< of leafy trees: added to a dissimilarity where only wood covers the crown
  double depth_price =
      0.2;  ///< the same for plants flatter or deeper than species, of leafy trees in one view
  bool any_leaf_size = false;       ///< of leafy trees: leaves may be larger than those of species are
  double freedom = kFreedomOfKind;  ///< of single branches
  std::map<std::string, std::string> versions;  ///< of the program and its libraries
  std::map<std::string, std::string> files;     ///< that a run keeps, from its directory on, and hashes
};

/// What a finished run adds to its record.
struct FitOutcome {
  long evaluations = 0;    ///< of the search
  long branch_rounds = 0;  ///< of the refinement
  long finish_from = 0;    ///< round at which its finish began, or would have begun
  FitStop stopped_by = FitStop::evaluations;
};

/// Throws FieldError where numbers are out of their ranges or names unknown (optimiser, objective); whether
/// the model has the parameters is not looked at.
void check_record(const FitRecord& record);

std::string record_to_toml(const FitRecord& record, const std::optional<FitOutcome>& outcome);

struct RecordedRun {
  FitRecord record;
  std::optional<FitOutcome> outcome;
};

/// Reads run.toml and checks it; files that it names from its directory on, which the run keeps, have that
/// before them. Throws InputError with file, line, key, got and expected, also where the record, or a file
/// that the run keeps, was changed since it was written [record_check.h].
RecordedRun read_record(const std::filesystem::path& path);

}  // namespace espalier
