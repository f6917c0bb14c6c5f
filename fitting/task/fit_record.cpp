#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/core/toml_section.h>
#include <espalier/fitting/optimizers/search_method.h>
#include <espalier/fitting/task/fit_record.h>
#include <espalier/fitting/task/species_components.h>
#include <espalier/image/measures/compare.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

constexpr int kFormat = 1;
constexpr const char* kMethodNames[] = {"auto", "alpha", "luminance", "background"};
constexpr const char* kSideNames[] = {"auto", "light", "dark"};

void check_number(const char* option, double got, double lower, double upper, const char* expected) {
  if (std::isfinite(got) && got >= lower && got <= upper) return;
  throw_input_error("{}: got {}, expected {}", option, got, expected);
}

void check_view(const ViewRecord& view) {
  check_number("--views", view.view.azimuth_deg, -360, 360, "an azimuth in degrees, -360..360");
  check_number("--views", view.view.elevation_deg, -90, 90, "an elevation in degrees, -90..90");
  check_number("--views", view.view.field_of_view_deg, 1, 150, "a field of view in degrees, 1..150");
}

/// The word of an enumeration that a key holds.
template <typename Enum>
Enum read_word(const TomlSection& section, const char* key) {
  const auto value = value_named<Enum>(section.text(key));
  if (!value) section.fail(key, fmt::format("{}", fmt::join(names_of<Enum>(), ", ")));
  return *value;
}

ViewRecord read_view(const TomlSection& section) {
  ViewRecord record{section.text("picture"), {}};
  record.view.azimuth_deg = static_cast<float>(section.number("azimuth_deg"));
  record.view.elevation_deg = static_cast<float>(section.number("elevation_deg"));
  record.view.projection = section.flag("perspective") ? Projection::perspective : Projection::orthographic;
  record.view.field_of_view_deg = static_cast<float>(section.number("field_of_view_deg"));
  return record;
}

void read_views(const TomlSection& section, FitRecord& record) {
  for (const TomlSection& view : section.sections("views")) record.views.push_back(read_view(view));
}

void read_target_options(const TomlSection& section, FitRecord& record) {
  record.target.size_px = static_cast<int>(section.whole("size_px"));
  record.target.method = parse_separation_method(section.text("separation"));
  record.target.side = parse_tree_side(section.text("tree_side"));
  record.target.speck_px = static_cast<int>(section.whole("speck_px"));
  record.target.fill_pinholes = section.flag("fill_pinholes");
  record.target.one_tree = section.has("one_tree") && section.flag("one_tree");  // earlier versions took all
  record.target_hash = section.text("hash");
}

void read_budget(const TomlSection& section, FitRecord& record) {
  record.budget.evaluations = section.whole("evaluations");
  record.budget.seconds = section.number("seconds");
  record.budget.target_fitness = section.number("target_fitness");
  record.budget.branch_rounds = section.whole_or("branch_rounds", 0);  // earlier versions have none
  record.budget.finish_from = section.whole_or("finish_from", kLastShare);
  record.growth.max_stems = section.number("max_stems");
  record.growth.max_leaves = section.number("max_leaves");
}

void read_search(const TomlSection& section, FitRecord& record) {
  record.start = section.text("start");
  record.stages = parse_stages(section.text_or("stages", to_string(FitStages{})));
  record.space = section.text_or("space", record.space);  // records of earlier versions have none
  record.space_evaluations = section.whole_or("space_evaluations", record.space_evaluations);
  record.search.free = section.texts("free");
  record.search.fixed = section.section("fixed").numbers();
}

std::optional<FitOutcome> read_outcome(const TomlSection& section) {
  if (!section.table.contains("outcome")) return std::nullopt;
  const TomlSection outcome = section.section("outcome");
  const long rounds = outcome.whole_or("branch_rounds", 0);  // earlier versions have none, nor a finish
  return FitOutcome{outcome.whole("evaluations"), rounds, outcome.whole_or("finish_from", rounds),
                    read_word<FitStop>(outcome, "stopped_by")};
}

// Writing: in the order a person reads it.

/// Shortest text that reads back to the same bits, always with a point or exponent (a TOML float).
std::string toml_number(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string numbers_to_toml(const std::map<std::string, double>& values) {
  std::string text;
  for (const auto& [name, value] : values)
    text += fmt::format("{} = {}\n", quote_toml(name), toml_number(value));
  return text;
}

std::string views_to_toml(const FitRecord& record) {
  std::string text;
  for (const ViewRecord& view : record.views)
    text += fmt::format(
        "\n[[views]]\npicture = {}\nazimuth_deg = {}\nelevation_deg = {}\nperspective = {}\n"
        "field_of_view_deg = {}\n",
        quote_toml(view.picture.string()), toml_number(view.view.azimuth_deg),
        toml_number(view.view.elevation_deg), view.view.projection == Projection::perspective,
        toml_number(view.view.field_of_view_deg));
  return text;
}

std::string target_to_toml(const FitRecord& record) {
  const TargetOptions& target = record.target;
  return fmt::format(
      "\n[target]\nsize_px = {}\nseparation = \"{}\"\ntree_side = \"{}\"\nspeck_px = {}\nfill_pinholes = {}\n"
      "one_tree = {}  # of several, the largest; else all as one\n"
      "hash = {}  # of the masks that were fitted\n",
      target.size_px, kMethodNames[static_cast<int>(target.method)],
      kSideNames[static_cast<int>(target.side)], target.speck_px, target.fill_pinholes, target.one_tree,
      quote_toml(record.target_hash));
}

std::string budget_to_toml(const FitRecord& record) {
  return fmt::format(
      "\n[budget]  # 0: no limit\nevaluations = {}\nseconds = {}\ntarget_fitness = {}\n"
      "branch_rounds = {}  # after the search; -1: as many as time allows\nfinish_from = {}  # round; -1: "
      "for the last 40 %\nmax_stems = {}\nmax_leaves = {}\n",
      record.budget.evaluations, toml_number(record.budget.seconds),
      toml_number(record.budget.target_fitness), record.budget.branch_rounds, record.budget.finish_from,
      toml_number(record.growth.max_stems), toml_number(record.growth.max_leaves));
}

std::string space_to_toml(const FitRecord& record) {
  if (record.space.empty()) return "";
  return fmt::format("space = {}  # searched first\nspace_evaluations = {}\n", quote_toml(record.space),
                     record.space_evaluations);
}

std::string search_to_toml(const FitRecord& record) {
  std::string free;
  for (const std::string& name : record.search.free) free += (free.empty() ? "" : ", ") + quote_toml(name);
  return fmt::format(
      "\n[search]\nstages = {}\nstart = {}\n{}free = [{}]  # none: the default set of the "
      "model\n\n[search.fixed]\n{}",
      quote_toml(to_string(record.stages)), quote_toml(record.start), space_to_toml(record), free,
      numbers_to_toml(record.search.fixed));
}

std::string versions_to_toml(const FitRecord& record) {
  std::string text = "\n[versions]\n";
  for (const auto& [name, version] : record.versions)
    text += fmt::format("{} = {}\n", quote_toml(name), quote_toml(version));
  return text;
}

float parse_angle(std::string_view text, const std::string& whole) {
  float value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw_input_error("--views: got '{}', expected FILE:AZIMUTH,ELEVATION in degrees", whole);
  return value;
}

}  // namespace

void check_record(const FitRecord& record) {
  if (record.views.empty()) throw_input_error("fit: got no picture, expected IMAGE or --views");
  for (const ViewRecord& view : record.views) check_view(view);
  complete_settings(record.optimizer, optimizer_by_name(record.optimizer).settings(),
                    record.optimizer_settings);
  parse_objective(record.objective);
  parse_search_space(record.space);
  check_number("--space-evaluations", static_cast<double>(record.space_evaluations), 1, 1e9,
               "a whole number from 1");
  const FitBudget& budget = record.budget;
  check_number("--evaluations", static_cast<double>(budget.evaluations), 0, 1e15, "a whole number from 1");
  check_number("--seconds", budget.seconds, 0, 1e9, "a positive number of seconds");
  check_number("--target-fitness", budget.target_fitness, 0, 1, "a number above 0, at most 1");
  if (budget.evaluations == 0 && budget.seconds == 0)
    throw_input_error("fit: got no budget, expected --seconds or --evaluations above 0");
  check_number("--branch-rounds", static_cast<double>(budget.branch_rounds), kWhileTimeLasts, 1e9,
               "a whole number from 0");
  if (budget.branch_rounds == kWhileTimeLasts && budget.seconds == 0)
    throw_input_error("fit: got branch rounds without an end, expected --seconds or --branch-rounds");
  check_number("--max-stems", record.growth.max_stems, 1, 1e7, "a number 1..1e7");
  check_number("--max-leaves", record.growth.max_leaves, 1, 1e7, "a number 1..1e7");
  check_number("--fit-seeds", record.fit_seeds, 1, 1000, "a whole number 1..1000");
  check_number("--size", record.target.size_px, 16, 4096, "a size in pixels, 16..4096");
  if (record.height_m) check_number("--height", *record.height_m, 0.01, 200, "a height in metres, 0.01..200");
}

std::string record_to_toml(const FitRecord& record, const std::optional<FitOutcome>& outcome) {
  std::string text = "# Everything that repeats this run: espalier fit --repeat DIRECTORY --out OTHER\n";
  text += fmt::format("format = {}\nmodel = {}\nobjective = {}\noptimizer = {}\nseed = {}\nfit_seeds = {}\n",
                      kFormat, quote_toml(record.model), quote_toml(record.objective),
                      quote_toml(record.optimizer), static_cast<std::int64_t>(record.seed), record.fit_seeds);
  text += fmt::format("kind = {}\ntrain_to_target = {}\n", quote_toml(name_of(record.kind)),
                      record.train_to_target);
  if (record.height_m) text += fmt::format("height_m = {}\n", toml_number(*record.height_m));
  text += views_to_toml(record) + target_to_toml(record) + budget_to_toml(record) + search_to_toml(record);
  text += "\n[optimizer_settings]\n" + numbers_to_toml(record.optimizer_settings);
  text += versions_to_toml(record);
  if (outcome)
    text +=
        fmt::format("\n[outcome]\nevaluations = {}\nbranch_rounds = {}\nfinish_from = {}\nstopped_by = {}\n",
                    outcome->evaluations, outcome->branch_rounds, outcome->finish_from,
                    quote_toml(name_of(outcome->stopped_by)));
  return text;
}

RecordedRun read_record(const std::filesystem::path& path) {
  const std::string source = path.string();
  const toml::table document = parse_toml(read_toml_text(path), source);
  const TomlSection root{document, source};
  if (root.whole("format") != kFormat) root.fail("format", "1, of this version of the program");
  FitRecord record;
  record.model = root.text("model");
  record.objective = root.text("objective");
  record.optimizer = root.text("optimizer");
  record.seed = static_cast<Seed>(root.whole("seed"));
  record.fit_seeds = static_cast<int>(root.whole("fit_seeds"));
  if (root.has("kind")) record.kind = read_word<KindChoice>(root, "kind");  // earlier versions have neither
  if (document.contains("train_to_target")) record.train_to_target = root.flag("train_to_target");
  if (document.contains("height_m")) record.height_m = root.number("height_m");
  read_views(root, record);
  read_target_options(root.section("target"), record);
  read_budget(root.section("budget"), record);
  read_search(root.section("search"), record);
  record.optimizer_settings = root.section("optimizer_settings").numbers();
  const TomlSection versions = root.section("versions");
  for (const auto& [name, version] : versions.table)
    record.versions[std::string(name.str())] = versions.text(name.str());
  return {record, read_outcome(root)};
}

ViewRecord parse_view(const std::string& text) {
  const auto colon = text.rfind(':');
  ViewRecord record{text.substr(0, colon), {}};
  if (colon == std::string::npos) return record;
  std::vector<float> angles;
  std::string_view rest = std::string_view(text).substr(colon + 1);
  for (auto comma = rest.find(','); comma != rest.npos; comma = rest.find(',')) {
    angles.push_back(parse_angle(rest.substr(0, comma), text));
    rest.remove_prefix(comma + 1);
  }
  angles.push_back(parse_angle(rest, text));
  if (angles.size() < 2 || angles.size() > 3 || record.picture.empty())
    throw_input_error("--views: got '{}', expected FILE:AZIMUTH,ELEVATION in degrees", text);
  record.view.azimuth_deg = angles[0];
  record.view.elevation_deg = angles[1];
  if (angles.size() == 3) {
    record.view.projection = Projection::perspective;
    record.view.field_of_view_deg = angles[2];
  }
  check_view(record);
  return record;
}

}  // namespace espalier
