#include <fmt/ranges.h>

#include <algorithm>

#include <espalier/core/assignment.h>
#include <espalier/core/field_error.h>
#include <espalier/fitting/optimizers/search_method.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/species_components.h>
#include <espalier/fitting/record/start_names.h>
#include <espalier/image/measures/objective.h>
#include <espalier/image/reading/picture_hints.h>
#include <espalier/image/separation/hints.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

constexpr double kManyEvaluations = 1e15, kManySeconds = 1e9, kManyRounds = 1e9;

void check_optimizer(const FitRecord& record) { optimizer_by_name(record.optimizer); }

void check_settings(const FitRecord& record) {
  complete_settings(record.optimizer, optimizer_by_name(record.optimizer).settings(),
                    record.optimizer_settings);
}

void check_objective(const FitRecord& record) {
  try {
    parse_objective(record.objective);
  } catch (const InputError& error) {
    throw_input_error("got '{}', expected a weighted sum of measures ({})", record.objective, error.what());
  }
}

void check_color(const std::string& text) {
  if (!text.empty()) parse_hinted_color(text);
}

void check_space(const FitRecord& record) { parse_search_space(record.space); }

void check_views(const FitRecord& record) {
  if (record.views.empty()) throw_input_error("got no picture, expected at least one");
  for (const ViewRecord& view : record.views) check_view(view);
}

void check_start(const FitRecord& record) { parse_start(record.start); }

bool has_space(const FitRecord& record) { return !record.space.empty(); }

/// Of a parameter, or of all that a pattern names.
double parameter_value(const FitRecord& record, const std::string& name, const std::string& text) {
  const ParameterTable& table = model_by_name(record.model).table();
  const std::vector<std::size_t> rows = rows_matching(table, name, "search.fixed");
  const double value = parse_parameter_value(table.rows[rows[0]], text);
  for (const std::size_t row : rows)
    if (parse_parameter_value(table.rows[row], text) != value)
      throw_input_error("got '{}' for {}, expected a number: it is not the same for all of them", text, name);
  return value;
}

double setting_value(const FitRecord&, const std::string& name, const std::string& text) {
  const auto value = parse_decimal(text);
  if (!value) throw_input_error("got '{}' for {}, expected a decimal number", text, name);
  return *value;
}

std::string help_of_optimizers() {
  std::vector<std::string> methods;
  for (const auto& optimizer : all_optimizers()) methods.push_back(optimizer->name());
  return fmt::format("method of the search: {}", fmt::join(methods, ", "));
}

std::string help_of_objectives() {
  return fmt::format("weighted sum of measures to minimise: {}", fmt::join(objective_names(), ", "));
}

std::vector<FitOption> options_of_the_task() {
  return {
      {.field = "model",
       .key = "model",
       .option = "model",
       .member = [](FitRecord& record) -> std::string& { return record.model; },
       .help = "weber_penn, or an L-system file NAME.lsys"},
      {.field = "objective",
       .key = "objective",
       .option = "objective",
       .member = [](FitRecord& record) -> std::string& { return record.objective; },
       .expected = "a weighted sum of measures",
       .check = check_objective,
       .help = help_of_objectives(),
       .experiment_list = "objectives"},
      {.field = "optimizer",
       .key = "optimizer",
       .option = "optimizer",
       .member = [](FitRecord& record) -> std::string& { return record.optimizer; },
       .expected = "the name of an optimiser",
       .check = check_optimizer,
       .help = help_of_optimizers(),
       .experiment_list = "optimizers"},
      {.field = "seed",
       .key = "seed",
       .option = "seed",
       .member = [](FitRecord& record) -> Seed& { return record.seed; },
       .help = "seed of the search, and of the first tree",
       .experiment_list = "seeds"},
      {.field = "fit_seeds",
       .key = "fit_seeds",
       .option = "fit-seeds",
       .member = [](FitRecord& record) -> int& { return record.fit_seeds; },
       .lower = 1,
       .upper = 1000,
       .help = "trees grown per candidate, averaged"},
      {.field = "kind",
       .key = "kind",
       .option = "kind",
       .member = [](FitRecord& record) -> KindChoice& { return record.kind; },
       .help = "kind of tree: auto (read off the picture), any, leafy, leafless (never any leaves), palm",
       .before = name_of(KindChoice::any)},
      {.field = "train_to_target",
       .key = "train_to_target",
       .option = "train-to-target",
       .member = [](FitRecord& record) -> bool& { return record.train_to_target; },
       .help = "keep the tree inside of the picture's outline: stems are shortened, bent, or cut (not for "
               "L-systems)",
       .before = false,
       .experiment_list = "trained"},
      {.field = "height_m",
       .key = "height_m",
       .option = "height",
       .member = [](FitRecord& record) -> std::optional<double>& { return record.height_m; },
       .unit = "m",
       .lower = 0.01,
       .upper = 200,
       .help = "height of the tree, m (default: a nominal 10)",
       .before = std::monostate{}},
  };
}

std::vector<FitOption> options_of_the_target() {
  return {
      {.field = "views",
       .key = "views",
       .option = "views",
       .member = [](FitRecord& record) -> std::vector<ViewRecord>& { return record.views; },
       .check = check_views,
       .help = "more pictures: FILE:AZIMUTH,ELEVATION[,FIELD_OF_VIEW], in degrees; 0,0 is the front view",
       .experiment_list = "targets"},
      {.field = "target.size_px",
       .key = "target.size_px",
       .option = "size",
       .member = [](FitRecord& record) -> int& { return record.target.size_px; },
       .unit = "px",
       .lower = 16,
       .upper = 4096,
       .help = "side of the masks, px"},
      {.field = "target.method",
       .key = "target.separation",
       .option = "separation",
       .member = [](FitRecord& record) -> SeparationMethod& { return record.target.separation.method; },
       .help = "auto, alpha, luminance or background"},
      {.field = "target.side",
       .key = "target.tree_side",
       .option = "tree-side",
       .member = [](FitRecord& record) -> TreeSide& { return record.target.separation.side; },
       .help = "auto, light or dark"},
      {.field = "target.speck_px",
       .key = "target.speck_px",
       .option = "speck",
       .member = [](FitRecord& record) -> int& { return record.target.speck_px; },
       .unit = "px",
       .lower = -1,
       .upper = 1e6,
       .word = NumberWord{"auto", -1},
       .help = "loose pieces under this many pixels of the picture are dropped (0: none; auto: by its size)"},
      {.field = "target.fill_pinholes",
       .key = "target.fill_pinholes",
       .option = "fill-pinholes",
       .member = [](FitRecord& record) -> bool& { return record.target.fill_pinholes; },
       .help = "fill holes under the size of specks"},
      {.field = "target.one_tree",
       .key = "target.one_tree",
       .option = "all-trees",
       .member = [](FitRecord& record) -> bool& { return record.target.one_tree; },
       .help = "fit several trees of a picture as one (default: the largest alone)",
       .note = "of several, the largest; else all as one",
       .before = false,
       .inverted = true},
      {.field = "target.labels",
       .key = "target.labels",
       .option = "labels",
       .member = [](FitRecord& record) -> LabelChoice& { return record.target.labels; },
       .help = "auto (leaves and wood are told apart where the picture's colours do) or none",
       .before = name_of(LabelChoice::none)},
      {.field = "target_hash",
       .key = "target.hash",
       .member = [](FitRecord& record) -> std::string& { return record.target_hash; },
       .help = "of the masks that were fitted: a run goes on with these alone",
       .note = "of the masks that were fitted"},
  };
}

/// Whether the rest of a picture's hints parses is seen where the picture is read; these are words alone.
void check_ground_color(const FitRecord& record) { check_color(record.target.hints.ground_color); }
void check_tree_color(const FitRecord& record) { check_color(record.target.hints.tree_color); }
void check_region(const FitRecord& record) {
  if (!record.target.hints.region.empty()) parse_region(record.target.hints.region);
}
void check_tree_seeds(const FitRecord& record) { parse_places(record.target.hints.tree_seeds); }
void check_ground_seeds(const FitRecord& record) { parse_places(record.target.hints.ground_seeds); }
void check_keep_marks(const FitRecord& record) { marks_to_leave_out(record.target.hints.keep_marks); }
void check_scale_bar(const FitRecord& record) { parse_scale_bar(record.target.hints.scale_bar); }

/// What a user may say of a picture where it is read wrongly without.
std::vector<FitOption> options_of_the_picture() {
  return {
      {.field = "target.threshold",
       .key = "target.threshold",
       .option = "threshold",
       .member = [](FitRecord& record) -> double& { return record.target.hints.threshold; },
       .lower = 0.01,
       .upper = 0.99,
       .help = "share of a pixel that the tree covers, from which it is tree; of alpha and tones likewise",
       .is_written = [](const FitRecord& record) { return record.target.hints.threshold != kHalfCovered; },
       .since = "0.2",
       .before = double{kHalfCovered}},
      {.field = "target.ground_color",
       .key = "target.ground_color",
       .option = "ground-color",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.ground_color; },
       .expected = "RRGGBB, or R,G,B of 0 to 255",
       .check = check_ground_color,
       .help = "the ground's colour, RRGGBB or R,G,B of 0 to 255 (default: what the border shows)",
       .is_written = [](const FitRecord& record) { return !record.target.hints.ground_color.empty(); },
       .since = "0.2",
       .before = std::string()},
      {.field = "target.tree_color",
       .key = "target.tree_color",
       .option = "tree-color",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.tree_color; },
       .expected = "RRGGBB, or R,G,B of 0 to 255",
       .check = check_tree_color,
       .help = "the tree's colour, likewise (default: that of its solid parts)",
       .is_written = [](const FitRecord& record) { return !record.target.hints.tree_color.empty(); },
       .since = "0.2",
       .before = std::string()},
      {.field = "target.region",
       .key = "target.region",
       .option = "region",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.region; },
       .expected = "LEFT,TOP,WIDTH,HEIGHT in pixels",
       .check = check_region,
       .help = "the part of the picture that shows the tree: LEFT,TOP,WIDTH,HEIGHT in its pixels",
       .is_written = [](const FitRecord& record) { return !record.target.hints.region.empty(); },
       .since = "0.2",
       .before = std::string()},
      {.field = "target.tree_seeds",
       .key = "target.seed_tree",
       .option = "seed-tree",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.tree_seeds; },
       .expected = "X,Y in pixels, or X,Y;X,Y",
       .check = check_tree_seeds,
       .help = "a pixel of the tree, X,Y, or several, X,Y;X,Y: they and what is like them around are tree",
       .is_written = [](const FitRecord& record) { return !record.target.hints.tree_seeds.empty(); },
       .since = "0.2",
       .before = std::string()},
      {.field = "target.ground_seeds",
       .key = "target.seed_ground",
       .option = "seed-ground",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.ground_seeds; },
       .expected = "X,Y in pixels, or X,Y;X,Y",
       .check = check_ground_seeds,
       .help = "a pixel of the ground, likewise",
       .is_written = [](const FitRecord& record) { return !record.target.hints.ground_seeds.empty(); },
       .since = "0.2",
       .before = std::string()},
      {.field = "target.label",
       .key = "target.tree_label",
       .option = "label",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.label; },
       .expected = "numbers or RRGGBB, with commas between",
       .help = "of a picture of labels, that of the tree: a number or RRGGBB, several with commas between "
               "(default: the only one)",
       .is_written = [](const FitRecord& record) { return !record.target.hints.label.empty(); },
       .since = "0.2",
       .before = std::string()},
      {.field = "target.keep_marks",
       .key = "target.keep_marks",
       .option = "keep-marks",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.keep_marks; },
       .expected = "none, all, or some of strips, lines, captions, figures",
       .check = check_keep_marks,
       .help = "what beside the tree is not left out: none, all, or some of strips (along the edges), lines "
               "(of the ground, frames), captions (and scale bars), figures (persons, loose pieces)",
       .is_written = [](const FitRecord& record) { return record.target.hints.keep_marks != "none"; },
       .since = "0.2",
       .before = std::string("none")},
      {.field = "target.scale_bar",
       .key = "target.scale_bar",
       .option = "scale-bar",
       .member = [](FitRecord& record) -> std::string& { return record.target.hints.scale_bar; },
       .expected = "PIXELS=METRES",
       .check = check_scale_bar,
       .help = "how long a scale bar is: PIXELS=METRES; the tree has the height that it tells",
       .is_written = [](const FitRecord& record) { return !record.target.hints.scale_bar.empty(); },
       .since = "0.2",
       .before = std::string()},
      {.field = "target.tree",
       .key = "target.tree",
       .option = "tree",
       .member = [](FitRecord& record) -> int& { return record.target.hints.tree; },
       .lower = 0,
       .upper = 1000,
       .zero_is_none = true,
       .help = "of several trees, this one, counted from 1 as one reads (default: the largest)",
       .is_written = [](const FitRecord& record) { return record.target.hints.tree != 0; },
       .since = "0.2",
       .before = std::int64_t{0}},
      {.field = "target.frame",
       .key = "target.frame",
       .option = "frame",
       .member = [](FitRecord& record) -> int& { return record.target.hints.frame; },
       .lower = 0,
       .upper = 10'000,
       .zero_is_none = true,
       .help =
           "of an animation, or of pages, this one, counted from 1 (default: the first that is not blank)",
       .is_written = [](const FitRecord& record) { return record.target.hints.frame != 0; },
       .since = "0.2",
       .before = std::int64_t{0}},
  };
}

std::vector<FitOption> options_of_the_budget() {
  return {
      {.field = "budget.evaluations",
       .key = "budget.evaluations",
       .option = "evaluations",
       .member = [](FitRecord& record) -> long& { return record.budget.evaluations; },
       .lower = 0,
       .upper = kManyEvaluations,
       .zero_is_none = true,
       .help = "stop after this many (alone: no limit of time)",
       .resumable = true},
      {.field = "budget.seconds",
       .key = "budget.seconds",
       .option = "seconds",
       .member = [](FitRecord& record) -> double& { return record.budget.seconds; },
       .unit = "s",
       .lower = 0,
       .upper = kManySeconds,
       .zero_is_none = true,
       .help = "time to search",
       .resumable = true},
      {.field = "budget.target_fitness",
       .key = "budget.target_fitness",
       .option = "target-fitness",
       .member = [](FitRecord& record) -> double& { return record.budget.target_fitness; },
       .lower = 0,
       .upper = 1,
       .zero_is_none = true,
       .help = "stop once the best is this good, 0..1",
       .resumable = true},
      {.field = "budget.branch_rounds",
       .key = "budget.branch_rounds",
       .option = "branch-rounds",
       .member = [](FitRecord& record) -> long& { return record.budget.branch_rounds; },
       .lower = 0,
       .upper = kManyRounds,
       .word = NumberWord{"time", kWhileTimeLasts},
       .help = "rounds of branch by branch refinement after the search (default: as time allows, 24 without "
               "a limit of time; 0: none)",
       .note = "after the search; -1: as many as time allows",
       .before = std::int64_t{0},
       .says_default = true},
      {.field = "budget.finish_from",
       .key = "budget.finish_from",
       .member = [](FitRecord& record) -> long& { return record.budget.finish_from; },
       .lower = 0,
       .upper = kManyRounds,
       .word = NumberWord{"last_share", kLastShare},
       .help = "round at which the finish begins",
       .note = "round; -1: for the last 40 %",
       .before = std::int64_t{kLastShare}},
      {.field = "growth.max_stems",
       .key = "budget.max_stems",
       .option = "max-stems",
       .member = [](FitRecord& record) -> double& { return record.growth.max_stems; },
       .lower = 1,
       .upper = 1e7,
       .help = "stems a candidate may have; for an L-system at least 3 times those of its default plant"},
      {.field = "growth.max_leaves",
       .key = "budget.max_leaves",
       .option = "max-leaves",
       .member = [](FitRecord& record) -> double& { return record.growth.max_leaves; },
       .lower = 1,
       .upper = 1e7,
       .help = "leaves a candidate may have; for an L-system likewise"},
  };
}

std::vector<FitOption> options_of_the_start() {
  return {
      {.field = "stages",
       .key = "search.stages",
       .option = "stages",
       .member = [](FitRecord& record) -> FitStages& { return record.stages; },
       .expected = "starts, or names of search, tracing, branches and finish",
       .help = "what to do after the starts are scored: names of search, tracing, branches and finish; "
               "starts that are not searched from are taken as they are, with their overrides",
       .before = to_string(FitStages{})},
      {.field = "start",
       .key = "search.start",
       .option = "start",
       .member = [](FitRecord& record) -> std::string& { return record.start; },
       .check = check_start,
       .help = "auto (all presets), auto,-NAME (all but these), defaults, random:K (K plants that nobody "
               "chose), or presets: NAME,NAME",
       .experiment_list = "starts"},
      {.field = "species",
       .key = "search.species",
       .option = "species",
       .member = [](FitRecord& record) -> std::string& { return record.species; },
       .help = "keep to a species, a preset: start from it, and search its parameters within what it allows",
       .before = std::string()},
      {.field = "space",
       .key = "search.space",
       .option = "space",
       .member = [](FitRecord& record) -> std::string& { return record.space; },
       .expected = "species:K",
       .check = check_space,
       .help = "species:K: search K coordinates of the species space first, then the parameters",
       .note = "searched first",
       .is_written = has_space,
       .before = std::string(),
       .experiment_list = "spaces"},
      {.field = "space_evaluations",
       .key = "search.space_evaluations",
       .option = "space-evaluations",
       .member = [](FitRecord& record) -> long& { return record.space_evaluations; },
       .lower = 1,
       .upper = kManyEvaluations,
       .help = "evaluations in the species space, at most",
       .is_written = has_space,
       .before = std::int64_t{FitRecord{}.space_evaluations}},
  };
}

std::vector<FitOption> options_of_the_plant() {
  return {
      {.field = "bare_wood_price",
       .key = "search.bare_wood_price",
       .option = "bare-wood-price",
       .member = [](FitRecord& record) -> double& { return record.bare_wood_price; },
       .lower = 0,
       .upper = 100,
       .help = "of leafy trees: what a crown that only wood covers costs, in fitness, and in the search wood "
               "beyond the share that species have (0: a branch is as good as a leaf)",
       .since = "0.2",
       .before = 0.0},
      {.field = "depth_price",
       .key = "search.depth_price",
       .option = "depth-price",
       .member = [](FitRecord& record) -> double& { return record.depth_price; },
       .lower = 0,
       .upper = 100,
       .help = "of leafy trees in one view: what a candidate of the search costs, in fitness, that is e "
               "times flatter or deeper than species are (0: nothing)",
       .since = "0.2",
       .before = 0.0},
      {.field = "any_leaf_size",
       .key = "search.any_leaf_size",
       .option = "any-leaf-size",
       .member = [](FitRecord& record) -> bool& { return record.any_leaf_size; },
       .help =
           "of leafy trees: leaves may be larger than those of the bundled species are (default: at most 3 % "
           "of the tree's height long, and as wide as long)",
       .since = "0.2",
       .before = true},
      {.field = "freedom",
       .key = "search.freedom",
       .option = "freedom",
       .member = [](FitRecord& record) -> double& { return record.freedom; },
       .lower = 0,
       .upper = 100,
       .word = NumberWord{"auto", kFreedomOfKind},
       .help = "how far branches may leave what the model draws: 0 not at all, 1 little, 4 and more as "
               "far as they like (default: 1, of leafless trees and palms 4)",
       .note = "of single branches; -1: as the kind of tree needs",
       .since = "0.2",
       .before = kWholeFreedom,
       .says_default = true},
  };
}

std::vector<FitOption> options_of_the_search() {
  return {
      {.field = "search.free",
       .key = "search.free",
       .option = "free",
       .member = [](FitRecord& record) -> std::vector<std::string>& { return record.search.free; },
       .help = "parameters to search: a,b[1],curve*,default; of a curve as 4 numbers: curve~4",
       .note = "none: the default set of the model",
       .experiment_list = "spaces"},
      {.field = "search.fixed",
       .key = "search.fixed",
       .option = "fix",
       .member = [](FitRecord& record) -> std::map<std::string, double>& { return record.search.fixed; },
       .assigned = parameter_value,
       .help = "hold a parameter: name=value",
       .experiment_list = "spaces"},
      {.field = "optimizer_settings",
       .key = "optimizer_settings",
       .option = "set-optimizer",
       .member = [](FitRecord& record) -> std::map<std::string, double>& {
         return record.optimizer_settings;
       },
       .check = check_settings,
       .assigned = setting_value,
       .help = "a setting of the method: name=value",
       .experiment_list = "optimizers"},
  };
}

std::vector<FitOption> options_of_all() {
  struct Part {
    const char* group;
    std::vector<FitOption> (*options)();
  };
  std::vector<FitOption> options;
  for (const Part& part :
       {Part{"What is fitted, and how it is scored", options_of_the_task},
        Part{"How the picture is read", options_of_the_target},
        Part{"How the picture is read", options_of_the_picture},
        Part{"How long, and how large", options_of_the_budget},
        Part{"Where it starts, and what it does", options_of_the_start},
        Part{"What the tree may be", options_of_the_plant}, Part{"What is searched", options_of_the_search}})
    for (FitOption& option : part.options()) {
      option.group = part.group;
      options.push_back(std::move(option));
    }
  return options;
}

}  // namespace

const std::vector<FitOption>& fit_options() {
  static const std::vector<FitOption> options = options_of_all();
  return options;
}

const FitOption* find_option(std::string_view field) {
  for (const FitOption& option : fit_options())
    if (option.field == field) return &option;
  return nullptr;
}

std::string experiment_key(const FitOption& option) {
  if (option.option.empty() || !option.experiment_list.empty()) return "";
  std::string key(option.option);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

}  // namespace espalier
