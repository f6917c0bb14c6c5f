// An experiment as data, read from a TOML file (experiments/*.toml). It has one of three kinds:
//   [fits]      every target × optimiser × objective × space × start × seed is a run of espalier fit
//   [pictures]  a sheet of shaded trees: every row of changes × every column of changes is one picture
//   [growth]    each species is grown with many seeds: how long it takes, how large it gets

#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <espalier/fitting/record/fit_record.h>
#include <espalier/render/camera.h>

namespace espalier {

/// Pictures of a tree, or the silhouettes of a bundled species or preset file.
struct TargetDeclaration {
  std::string name;               ///< in tables and directories
  std::vector<ViewRecord> views;  ///< at least one; without pictures where they are drawn from a species
  std::string species;            ///< empty where there are pictures
  Seed seed = 1;                  ///< of the species' tree
};

struct OptimizerDeclaration {
  std::string label, name;
  OptimizerSettings settings;
};

struct SpaceDeclaration {
  std::string label = "default";
  std::string model = FitRecord{}.model;
  SearchChoice search;
  std::string first;    ///< searched before it: "species:2", or nothing
  GrowthBudget growth;  ///< the record's; of an L-system as much as its default plant needs
};

/// Names of groups, and of their targets.
using TargetGroups = std::map<std::string, std::vector<std::string>>;

struct FitsDeclaration {
  std::vector<TargetDeclaration> targets;
  std::vector<OptimizerDeclaration> optimizers = {{"cma_es", "cma_es", {}}};
  std::vector<std::string> objectives;  ///< that of the record, where the file names none
  std::vector<SpaceDeclaration> spaces = {SpaceDeclaration{}};
  std::vector<std::string> starts = {"auto"};
  std::vector<Seed> seeds = {1};
  FitRecord record;                     ///< what all runs share: budget, size, view
  std::vector<bool> trained = {false};  ///< to grow into the picture, or not
  int threads = 1;                      ///< of each run; fewer runs at once then
  TargetGroups groups;                  ///< for means; none: no score sheet
  int unseen_seeds = 0;                 ///< trees of the result to grow with seeds that the fit never saw
  bool exclude_truth = true;            ///< the species of a known target is not among the starts
  bool posterior = false;               ///< what each target's picture says of its tree, too
  int posterior_simulations = 20'000;   ///< plants of the prior that it is computed from
  int siblings =
      0;  ///< trees of a target's species to score beside the result, on the side that it never saw
};

/// Changes that a row or a column of a sheet makes.
struct PictureChange {
  std::string label;
  std::string species;                ///< empty: that of the sheet
  std::string model;                  ///< an L-system instead of a species
  std::string blend_with;             ///< another species, empty for none
  double t = 0.5;                     ///< how far towards it
  std::map<std::string, double> set;  ///< parameters
  std::string prune_to;               ///< a volume [environment/volume.h], empty for none
  std::vector<std::string> objects;   ///< that stand beside the tree [environment/scene_object.h]
  std::string season;                 ///< of the picture [render/shading/seasons.h], empty: as the tree grows
  std::optional<View> view;           ///< where it is taken from; none: as those of the sheet
};

struct PicturesDeclaration {
  std::string species;
  std::string model;  ///< an L-system instead of a species: one of them is empty
  Seed seed = 1;
  int size_px = 320;
  double frame_m = 0;   ///< side of each picture, the tree's foot near its bottom; 0: framed one by one
  View view;            ///< where all pictures are taken from
  bool ground = false;  ///< a lawn
  std::vector<std::string> objects;  ///< that stand in all pictures
  std::vector<PictureChange> rows = {PictureChange{}}, columns = {PictureChange{}};
};

/// An L-system whose trees are grown beside those of the species.
struct GrownLsystem {
  std::string label;  ///< of the tree that it grows, in tables: "quaking_aspen"
  std::string model;
};

struct GrowthDeclaration {
  std::vector<std::string> species;
  std::vector<GrownLsystem> models;
  int seeds = 100;
};

/// What an experiment says of itself.
struct ExperimentMetadata {
  std::string name;  ///< of the file, without its suffix
  std::string kind;  ///< "fits", "pictures" or "growth"
  std::string title;
  std::string figure;                     ///< of the source, as "4.9, 4.10"
  std::string published;                  ///< what the source found
  std::string found;                      ///< what its own runs found
  std::string note;                       ///< a paragraph for the page
  std::vector<double> published_fitness;  ///< its range in the source, as [0.95, 0.97]; empty where unknown
  std::string text;                       ///< the whole file
  std::filesystem::path file;             ///< as it was named
  std::filesystem::path expectations;     ///< beside the file; it need not be there
};

struct Experiment {
  ExperimentMetadata words;
  std::optional<FitsDeclaration> fits;  ///< one of these three
  std::optional<PicturesDeclaration> pictures;
  std::optional<GrowthDeclaration> growth;
};

/// Only the words: the files that the experiment names need not be there. Throws InputError.
ExperimentMetadata read_metadata(const std::filesystem::path& path);

/// Reads and checks everything that can be checked before a run: names, ranges, files. Throws InputError with
/// file, line, key, got and expected. settings: KEY=VALUE in TOML, each replaces a key of [fits], [pictures]
/// or [growth]; the experiment's text then holds them.
Experiment read_experiment(const std::filesystem::path& path, const std::vector<std::string>& settings = {});

/// The same of a text that was read from `path`, or a later version of it: files that the text names lie
/// beside that.
Experiment read_experiment_text(const std::string& text, const std::filesystem::path& path);

/// What of `is` no study can be given that has the runs of `was`: "evaluations: got 300, expected 200". Empty
/// where the runs of `was` are all among those of `is`, or are renamed there: lists may grow.
std::string change_of_runs(const Experiment& was, const Experiment& is);

/// The groups of targets that the file names; none where it has none.
TargetGroups read_groups(const std::filesystem::path& path);

/// True where both describe the same runs: they may differ in title, figure, published, note and comments.
bool same_runs(const std::string& text, const std::string& other_text);

}  // namespace espalier
