// [fits]: its keys, and the options of espalier fit among them, which hold for all runs.
#include <algorithm>

#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/fit_lists.h>
#include <espalier/experiments/declaration/known_truth.h>
#include <espalier/experiments/declaration/read_parts.h>
#include <espalier/experiments/declaration/toml_values.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

using FitsKey = ExperimentKey<FitsDeclaration>;

constexpr double kMostFits = 100'000;  ///< each is a directory, and 3 kB of memory before it begins

/// Of a list whose values have a name in tables.
template <typename Value>
auto kept_list(std::vector<Value> FitsDeclaration::*list, std::string Value::*label) {
  return [list, label](const FitsDeclaration& was, const FitsDeclaration& is) {
    return lost_or_changed(
        was.*list, is.*list, [label](const Value& value) { return value.*label; },
        [](const Value& value) { return describe(value); });
  };
}

/// Of a list of plain values.
template <typename Value>
auto kept_values(std::vector<Value> FitsDeclaration::*list) {
  return [list](const FitsDeclaration& was, const FitsDeclaration& is) {
    const auto as_text = [](Value value) { return fmt::format("{}", value); };
    return lost_or_changed(was.*list, is.*list, as_text, as_text);
  };
}

std::vector<FitsKey> keys_of_lists() {
  return {
      {{"targets", "pictures, bundled names, tables of a target", "", "what is fitted", true},
       read_targets,
       kept_list(&FitsDeclaration::targets, &TargetDeclaration::name)},
      {{"optimizers", "names, tables of an optimiser, or `all`", "['cma_es']", "methods of the search"},
       read_optimizers,
       kept_list(&FitsDeclaration::optimizers, &OptimizerDeclaration::label)},
      {{"objectives", "weighted sums of measures, or `fit`: that of `espalier fit`",
        fmt::format("['{}']", FitRecord{}.objective), "what the search minimises"},
       read_objectives,
       kept_values(&FitsDeclaration::objectives)},
      {{"spaces", "`default`, tables of a space", "['default']", "what is searched"},
       read_spaces,
       kept_list(&FitsDeclaration::spaces, &SpaceDeclaration::label)},
      {{"starts", "as `--start` of a fit: `auto`, `defaults`, `random:8`, `acer,my.toml`", "['auto']",
        "where the search begins"},
       read_starts,
       kept_values(&FitsDeclaration::starts)},
      {{"trained", "true, false", "[false]", "whether the tree grows into the picture"},
       read_trained,
       kept_values(&FitsDeclaration::trained)},
      {{"seeds", "whole numbers, or how many: 5 is 1 to 5", "[1]", "of search and tree"},
       read_seeds,
       kept_values(&FitsDeclaration::seeds)},
  };
}

/// A key that holds a whole number.
FitsKey number_key(KeyDescription words, int FitsDeclaration::*member, int lower, int upper) {
  words.values = fmt::format("a whole number {}..{}", lower, upper);
  words.otherwise = fmt::format("{}", FitsDeclaration{}.*member);
  const std::string key = words.key;
  return {
      words,
      [=](const TomlSection& fits, FitsDeclaration& declaration) {
        declaration.*member = static_cast<int>(whole_between(fits, key, lower, upper));
      },
      unchanged<FitsDeclaration>([=](const FitsDeclaration& declaration) { return declaration.*member; })};
}

std::string angles_of(const FitsDeclaration& declaration) {
  const View& view = declaration.record.views[0].view;
  const std::string field =
      view.projection == Projection::perspective ? fmt::format(",{:g}", view.field_of_view_deg) : "";
  return fmt::format("{:g},{:g}{}", view.azimuth_deg, view.elevation_deg, field);
}

void read_front_view(const TomlSection& fits, FitsDeclaration& declaration) {
  declaration.record.views[0].view = parse_angles(fits, "view", fits.text("view"));
}

std::vector<FitsKey> keys_of_scores() {
  return {
      number_key({"unseen_seeds", "", "", "trees to grow of the result with seeds that no search saw"},
                 &FitsDeclaration::unseen_seeds, 0, 1000),
      number_key(
          {"siblings", "", "",
           "trees of a known target's species to score beside the result, on the side that the fit did "
           "not see"},
          &FitsDeclaration::siblings, 0, 1000),
      {{"exclude_truth", "true or false", "true", "the species of a known target is not among the starts"},
       [](const TomlSection& fits, FitsDeclaration& declaration) {
         declaration.exclude_truth = fits.flag("exclude_truth");
       },
       unchanged<FitsDeclaration>(
           [](const FitsDeclaration& declaration) { return declaration.exclude_truth; })},
      {{"posterior", "true or false", "false",
        "also what each target's picture says of its tree: posteriors.csv, posteriors/TARGET (posterior.md)"},
       [](const TomlSection& fits, FitsDeclaration& declaration) {
         declaration.posterior = fits.flag("posterior");
       },
       nullptr},
      number_key({"posterior_simulations", "", "", "plants of the prior that it is computed from"},
                 &FitsDeclaration::posterior_simulations, 2000, 1'000'000),
      {{"groups", "a table of names, each with its targets", "", "means over groups, a score sheet"},
       read_groups_of_targets,
       nullptr},
      number_key({"threads", "", "", "of each run; fewer runs at once then"}, &FitsDeclaration::threads, 1,
                 1024),
      {{"view", "AZIMUTH,ELEVATION[,FIELD_OF_VIEW], degrees", "'0,0'", "where pictures are taken from"},
       nullptr,  // before the targets, which have it
       unchanged<FitsDeclaration>(angles_of)},
  };
}

/// As TOML where that can say it.
std::string default_of(const FitOption& option) {
  const OptionValue value = get_value(option, FitRecord{});
  const std::string words = to_words(value);
  if (words.empty() || (option.zero_is_none && words == "0")) return "";
  if (option.inverted) return to_toml(!std::get<bool>(value));
  if (option.word && words == fmt::format("{}", option.word->value))
    return fmt::format("'{}'", option.word->word);
  return type_of(option) == ValueType::text ? fmt::format("'{}'", words) : words;
}

/// A limit of evaluations takes that of time away: then it is the evaluations that have changed.
bool is_replaced(const FitOption& option, const FitsDeclaration& was, const FitsDeclaration& is) {
  return option.field == "budget.seconds" && was.record.budget.evaluations != is.record.budget.evaluations;
}

FitsKey key_of(const FitOption& option) {
  const std::string key = experiment_key(option);
  const bool is_time = option.field == "budget.seconds";
  const auto is_unchanged = unchanged<FitsDeclaration>([&option](const FitsDeclaration& declaration) {
    return to_words(get_value(option, declaration.record));
  });
  return {{key, describe_values(option), default_of(option) + (is_time ? ", none with evaluations" : ""),
           option.help},
          nullptr,
          [=, &option](const FitsDeclaration& was, const FitsDeclaration& is) -> std::string {
            return is_replaced(option, was, is) ? "" : is_unchanged(was, is);
          }};
}

std::vector<FitsKey> all_keys_of_fits() {
  std::vector<FitsKey> keys = keys_of_lists();
  std::ranges::move(keys_of_scores(), std::back_inserter(keys));
  for (const FitOption& option : fit_options())
    if (!experiment_key(option).empty()) keys.push_back(key_of(option));
  return keys;
}

/// Where the file says something of a field.
std::string place_of(const TomlSection& fits, const std::string& field) {
  const FitOption* option = find_option(field);
  const std::string key = option ? experiment_key(*option) : "";
  return fits.has(key) ? location(fits, key) : fmt::format("{}: {}", fits.source, key.empty() ? field : key);
}

/// What all runs share: the options of espalier fit that no list varies.
FitRecord read_shared_record(const TomlSection& fits) {
  FitRecord record;
  record.views.emplace_back();
  if (fits.has("evaluations")) record.budget.seconds = 0;  // given alone they are the only limit
  with_places([&](const std::string& field) { return place_of(fits, field); },
              [&] {
                for (const FitOption& option : fit_options())
                  if (const std::string key = experiment_key(option); fits.has(key))
                    set_from_request(option, fits.node(key), fits.source, record);
                check_record(record);
              });
  record.model = find_model(fits, record.model);
  located(place_of(fits, "model"), [&] { return &model_by_name(record.model); });
  return record;
}

void check_starts_beside_truth(const TomlSection& fits, const FitsDeclaration& declaration) {
  for (const std::string& start : declaration.starts)
    for (const TargetDeclaration& target : declaration.targets)
      for (const SpaceDeclaration& space : declaration.spaces)
        located(place_of(fits, "starts"), [&] {
          return start_beside_truth(start_of_model(start, space.model), target.species, space.model);
        });
}

}  // namespace

const std::vector<FitsKey>& fits_keys() {
  static const std::vector<FitsKey> keys = all_keys_of_fits();
  return keys;
}

const std::vector<KeyDescription>& target_keys() {
  static const std::vector<KeyDescription> keys{
      {"picture", "a file, or a bundled name", "", "a string alone is this"},
      {"views", "as `--views` of a fit: FILE:AZIMUTH,ELEVATION; of a species angles alone", "",
       "more pictures of the tree, from other sides"},
      {"species", "a preset", "", "its silhouette instead of a picture: the parameters are known"},
      {"seed", "a whole number", fmt::format("{}", TargetDeclaration{}.seed), "of the species' tree"},
      {"name", "a string", "the file's or the species'", "in tables"},
  };
  return keys;
}

const std::vector<KeyDescription>& optimizer_keys() {
  static const std::vector<KeyDescription> keys{
      {"name", "the name of an optimiser", "", "a string alone is this"},
      {"label", "a string", "name and settings", "in tables"},
  };
  return keys;
}

const std::vector<KeyDescription>& space_keys() {
  static const std::vector<KeyDescription> keys{
      {"label", "a string", "'default'", "in tables"},
      {"model", "as `model` above", "that", "whose parameters are searched"},
      {"free", "names of parameters, with `*`", "what the model frees", "to be searched"},
      {"fixed", "a table of parameters and values", "", "to be held"},
      {"first", "`species:K`", "", "searched first: K coordinates of the species space"},
  };
  return keys;
}

FitsDeclaration read_fits(const TomlSection& fits) {
  fits.expect_only(names_of(fits_keys()));
  FitsDeclaration declaration;
  declaration.record = read_shared_record(fits);
  declaration.objectives = {declaration.record.objective};
  if (fits.has("view")) read_front_view(fits, declaration);
  declaration.spaces = {usual_space(fits, declaration.record)};
  read_keys(fits, fits_keys(), declaration);
  check_combinations(fits,
                     {declaration.targets.size(), declaration.optimizers.size(),
                      declaration.objectives.size(), declaration.spaces.size(), declaration.starts.size(),
                      declaration.trained.size(), declaration.seeds.size()},
                     kMostFits);
  if (declaration.exclude_truth) check_starts_beside_truth(fits, declaration);
  return declaration;
}

}  // namespace espalier
