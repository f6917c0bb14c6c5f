// From a picture to the directory of its posterior: samples.csv, intervals.csv, summaries.csv, parameters.svg
// and .png, pairs.svg and .png, silhouette.png, posterior.json, and the table that it was computed from.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/fitting/posterior/posterior_summary.h>
#include <espalier/fitting/posterior/predictive_check.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>
#include <espalier/image/masks/mask.h>

namespace espalier {

struct PosteriorRequest {
  std::string model = "weber_penn";
  std::string picture;   ///< as it was named, for the files
  double height_m = 10;  ///< of the tree in the picture
  std::size_t simulations = 20'000;
  std::size_t samples = 1000;  ///< rows of samples.csv
  Seed seed = 1;
  PriorChoice prior;
  std::filesystem::path table;  ///< empty: table.bin in the directory
  std::string version;          ///< of the program, for the files
  TrainingSettings training = posterior_training();
};

struct PosteriorResult {
  std::vector<UnknownSummary> unknowns;
  std::vector<SpeciesShare> species;
  PredictiveCheck check;
  std::size_t simulations = 0;  ///< fewer than asked for where it was stopped
  bool is_complete() const { return !unknowns.empty(); }
};

/// Throws FieldError ("simulations", "height", "samples") for values out of range; of the prior as
/// PlantPrior.
void check_request(const PosteriorRequest& request);

/// Whether the directory has, beside what a posterior writes, other things: one that was killed holds its
/// lock, and as much of its files as it came to. False where there is no directory.
bool holds_other_things(const std::filesystem::path& directory);

/// `mask`: the tree of the picture at any size. Extends the table first, which is kept where `progress` stops
/// it: then the result is not complete, nothing else is written, and the same call goes on. Where the check
/// finds that no plant of the prior makes such a picture, the files hold the prior. Throws InputError for
/// what cannot be read or written, and where another process works in the directory.
PosteriorResult compute_posterior(const PosteriorRequest& request, const Mask& mask,
                                  const std::filesystem::path& directory, int threads,
                                  const TableProgress& progress);

/// Lines for people.
std::string posterior_in_words(const PosteriorResult& result);

}  // namespace espalier
