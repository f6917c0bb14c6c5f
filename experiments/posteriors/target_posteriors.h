// Posteriors of an experiment's targets: what each picture says of its tree, beside the truth where that is
// known.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/random.h>
#include <espalier/fitting/posterior/posterior_run.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {

/// The tree that a target was drawn from.
struct TrueTree {
  std::string species;  ///< a preset
  Seed seed = 1;
};

struct PosteriorTarget {
  std::string name;       ///< in the table
  std::string directory;  ///< below posteriors/
  std::filesystem::path picture;
  double height_m = 10;
  std::optional<TrueTree> truth;
};

struct TargetPosteriorOptions {
  TargetOptions reading;
  std::size_t simulations = PosteriorRequest{}.simulations;
  int threads = 0;
  std::string version;  ///< of the program, for the files
  TrainingSettings training = posterior_training();
  /// Asked between blocks of plants; false stops.
  std::function<bool(const std::string& target, std::size_t done, std::size_t wanted)> on_progress;
};

/// posteriors/TARGET for each of them, as espalier posterior leaves it, and posteriors.csv: a row a target
/// and an unknown, with its truth where that is known. Targets of one height share a table of plants,
/// posteriors/plants_HEIGHT.bin. Where it is stopped, the plants drawn so far stay and posteriors.csv is not
/// written. Throws InputError.
void write_target_posteriors(const std::filesystem::path& directory,
                             const std::vector<PosteriorTarget>& targets,
                             const TargetPosteriorOptions& options);

}  // namespace espalier
