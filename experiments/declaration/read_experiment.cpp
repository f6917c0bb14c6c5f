// Reading the file of an experiment. Every reader checks the keys of its table, so that a misspelt one is an
// error.
#include <algorithm>
#include <sstream>

#include <espalier/core/assignment.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/fit_lists.h>
#include <espalier/experiments/declaration/read_parts.h>
#include <espalier/experiments/declaration/toml_values.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kKinds{"fits", "pictures", "growth"};

/// A file and the words in it.
struct Document {
  toml::table table;
  ExperimentMetadata words;
};

/// Two numbers in [0, 1], the lower first.
std::vector<double> read_range(const TomlSection& root, std::string_view key) {
  std::vector<double> range;
  for (const toml::node& node : root.array(key)) range.push_back(node.value<double>().value_or(-1));
  if (range.size() != 2 || !(range[0] >= 0 && range[0] <= range[1] && range[1] <= 1))
    root.fail(key, "two numbers in 0..1, the lower first");
  return range;
}

ExperimentKey<ExperimentMetadata> word_key(KeyDescription words, std::string ExperimentMetadata::*member) {
  words.values = "a string";
  const std::string key = words.key;
  return {words,
          [=](const TomlSection& root, ExperimentMetadata& metadata) { metadata.*member = root.text(key); },
          nullptr};
}

std::vector<ExperimentKey<ExperimentMetadata>> all_keys_of_words() {
  using Words = ExperimentMetadata;
  return {
      word_key({"title", "", "the file's name", "of the page"}, &Words::title),
      word_key({"figure", "", "", "of a publication that it repeats"}, &Words::figure),
      word_key({"published", "", "", "what was found there"}, &Words::published),
      {{"published_fitness", "two numbers 0..1", "", "the range of fitness there, drawn into the plot"},
       [](const TomlSection& root, Words& words) {
         words.published_fitness = read_range(root, "published_fitness");
       },
       nullptr},
      word_key({"found", "", "", "what this experiment found"}, &Words::found),
      word_key({"note", "", "", "a paragraph of the page"}, &Words::note),
  };
}

std::string kind_of(const TomlSection& root) {
  std::vector<std::string> kinds;
  for (const std::string& kind : kKinds)
    if (root.has(kind)) kinds.push_back(kind);
  if (kinds.size() != 1)
    throw_input_error("{}: got {} of the tables [{}], expected one of them", root.source, kinds.size(),
                      fmt::join(kKinds, "], ["));
  return kinds[0];
}

/// KEY=VALUE as TOML: a decimal number, true, false, what looks like TOML, or else a word, with quotes or
/// without.
toml::table parse_setting(const std::string& setting) {
  const auto [key, value] = parse_assignment(setting);
  if (value.empty()) throw_input_error("got '{}', expected KEY=VALUE", setting);
  const bool is_toml = value == "true" || value == "false" || value.find_first_of("[{\"'") == 0;
  const bool is_bare = !is_toml && !parse_decimal(value);
  return parse_toml(fmt::format("{} = {}", key, is_bare ? quote_toml(value) : value), "VALUE");
}

/// The text with these keys of its one table replaced.
std::string with_settings(const std::string& text, const std::string& source,
                          const std::vector<std::string>& settings) {
  if (settings.empty()) return text;
  toml::table table = parse_toml(text, source);
  toml::table& kind = *table[kind_of({table, source})].as_table();
  for (const std::string& setting : settings)
    for (const auto& [key, value] : in_field("set", [&] { return parse_setting(setting); }))
      kind.insert_or_assign(key, value);
  std::ostringstream written;
  written << toml::toml_formatter(table) << "\n";
  return written.str();
}

/// Of a text as it stands in `path`.
Document parse_document(const std::string& text, const fs::path& path) {
  Document document;
  ExperimentMetadata& words = document.words;
  words.text = text;
  document.table = parse_toml(text, path.string());
  const TomlSection root{document.table, path.string()};
  std::vector<std::string> known = names_of(word_keys());
  known.insert(known.end(), kKinds.begin(), kKinds.end());
  root.expect_only(known);
  words.file = path;
  words.name = path.stem();
  words.title = words.name;
  words.expectations = path.parent_path() / (words.name + ".expected.toml");
  words.kind = kind_of(root);
  read_keys(root, word_keys(), words);
  return document;
}

Document read_document(const fs::path& path) { return parse_document(read_toml_text(path), path); }

}  // namespace

const std::vector<ExperimentKey<ExperimentMetadata>>& word_keys() {
  static const std::vector<ExperimentKey<ExperimentMetadata>> keys = all_keys_of_words();
  return keys;
}

ExperimentMetadata read_metadata(const fs::path& path) { return read_document(path).words; }

TargetGroups read_groups(const fs::path& path) {
  const Document document = read_document(path);
  const TomlSection root{document.table, path.string()};
  return root.has("fits") ? groups_in(root.section("fits")) : TargetGroups{};
}

Experiment read_experiment(const fs::path& path, const std::vector<std::string>& settings) {
  return read_experiment_text(with_settings(read_toml_text(path), path.string(), settings), path);
}

Experiment read_experiment_text(const std::string& text, const fs::path& path) {
  const Document document = parse_document(text, path);
  const TomlSection root{document.table, path.string()};
  Experiment experiment{document.words, {}, {}, {}};
  if (root.has("fits")) experiment.fits = read_fits(root.section("fits"));
  if (root.has("pictures")) experiment.pictures = read_pictures(root.section("pictures"));
  if (root.has("growth")) experiment.growth = read_growth(root.section("growth"));
  return experiment;
}

std::string change_of_runs(const Experiment& was, const Experiment& is) {
  if (was.words.kind != is.words.kind)
    return fmt::format("got another experiment, of [{}], expected one of [{}]", is.words.kind,
                       was.words.kind);
  if (was.fits) return first_change(fits_keys(), *was.fits, *is.fits);
  if (was.pictures) return first_change(pictures_keys(), *was.pictures, *is.pictures);
  return first_change(growth_keys(), *was.growth, *is.growth);
}

bool same_runs(const std::string& text, const std::string& other_text) {
  const auto runs_of = [](const std::string& source) {
    toml::table table = parse_toml(source, "experiment.toml");
    for (const std::string& word : names_of(word_keys())) table.erase(word);
    return table;
  };
  return runs_of(text) == runs_of(other_text);
}

}  // namespace espalier
