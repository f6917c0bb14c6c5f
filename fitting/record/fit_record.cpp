#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include <espalier/core/field_error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/core/toml/toml_section.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/record/option_values.h>
#include <espalier/fitting/record/record_check.h>

namespace espalier {

namespace {

constexpr int kFormat = 1;
constexpr const char* kHead = "# The record of a fit: everything that repeats it\n";
constexpr const char* kOutcomeKeys[] = {"evaluations", "branch_rounds", "finish_from", "stopped_by"};

/// A table of the file and the last name of a key: "search.fixed" is {"search", "fixed"}.
struct KeyPath {
  std::string_view section, name;
};

KeyPath path_of(std::string_view key) {
  const std::size_t dot = key.rfind('.');
  if (dot == key.npos) return {"", key};
  return {key.substr(0, dot), key.substr(dot + 1)};
}

// Writing: in the order a person reads it.

/// The head of a table, with what holds for all its keys.
std::string section_head(std::string_view section) {
  return fmt::format("\n[{}]{}\n", section, section == "budget" ? "  # 0: no limit" : "");
}

std::string numbers_to_toml(const std::map<std::string, double>& values) {
  std::string text;
  for (const auto& [name, value] : values)
    text += fmt::format("{} = {}\n", quote_toml(name), toml_number(value));
  return text;
}

std::string views_to_toml(const std::vector<ViewRecord>& views) {
  std::string text;
  for (const ViewRecord& view : views) text += view_to_toml(view);
  return text;
}

std::string line_of(const FitOption& option, const OptionValue& value) {
  return fmt::format("{} = {}{}\n", path_of(option.key).name, to_toml(value),
                     option.note.empty() ? "" : fmt::format("  # {}", option.note));
}

/// Assignments are a table of their own, views one each; all else is a line of its section.
std::string option_to_toml(const FitOption& option, const OptionValue& value, std::string_view& section) {
  if (const auto* views = std::get_if<std::vector<ViewRecord>>(&value)) return views_to_toml(*views);
  if (const auto* numbers = std::get_if<std::map<std::string, double>>(&value))
    return section_head(option.key) + numbers_to_toml(*numbers);
  const std::string_view before = std::exchange(section, path_of(option.key).section);
  return (section == before ? "" : section_head(section)) + line_of(option, value);
}

std::string files_to_toml(const FitRecord& record) {
  if (record.files.empty()) return "";
  std::string text = "\n[files]  # that the run keeps, with hashes\n";
  for (const auto& [name, hash] : record.files)
    text += fmt::format("{} = {}\n", quote_toml(name), quote_toml(hash));
  return text;
}

std::string versions_to_toml(const FitRecord& record) {
  std::string text = "\n[versions]\n";
  for (const auto& [name, version] : record.versions)
    text += fmt::format("{} = {}\n", quote_toml(name), quote_toml(version));
  return text;
}

std::string outcome_to_toml(const FitOutcome& outcome) {
  return fmt::format("\n[outcome]\nevaluations = {}\nbranch_rounds = {}\nfinish_from = {}\nstopped_by = {}\n",
                     outcome.evaluations, outcome.branch_rounds, outcome.finish_from,
                     quote_toml(name_of(outcome.stopped_by)));
}

// Reading.

/// run.toml, and who wrote it, for messages.
struct RecordFile {
  toml::table table;
  std::string source;

  TomlSection root() const { return {table, source}; }
  const toml::node* find(std::string_view key) const { return table.at_path(key).node(); }

  /// "run.toml:7: target.size_px"
  std::string place_of(std::string_view key) const {
    const toml::node* node = find(key);
    return fmt::format("{}: {}", node ? toml_location(source, *node) : source, key);
  }
  /// " (written by espalier 0.3.0)", where the file says so.
  std::string writer() const {
    const auto version = table.at_path("versions.espalier").value<std::string>();
    return version ? fmt::format(" (written by espalier {})", *version) : "";
  }
};

void check_format(const RecordFile& file) {
  const std::int64_t format = file.root().whole("format");
  if (format != kFormat)
    throw_input_error("{}: got {}{}, expected {}, that of this version of the program",
                      file.place_of("format"), format, file.writer(), kFormat);
}

/// Keys that files have besides those of options.
std::vector<std::string> other_keys() {
  std::vector<std::string> keys{"format", kCheckKey};
  for (const char* key : kOutcomeKeys) keys.push_back(std::string("outcome.") + key);
  return keys;
}

std::vector<std::string> known_keys() {
  std::vector<std::string> keys = other_keys();
  for (const FitOption& option : fit_options()) keys.emplace_back(option.key);
  return keys;
}

/// Looks at the keys of `table`, whose own is `prefix`, and of the tables in it. A table that is an option is
/// left to that.
void check_keys(const RecordFile& file, const toml::table& table, const std::string& prefix,
                const std::vector<std::string>& known) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (std::find(known.begin(), known.end(), path) != known.end() || path == "versions" || path == "files")
      continue;
    const auto holds = [&](const std::string& one) { return one.starts_with(path + "."); };
    const bool is_section = std::any_of(known.begin(), known.end(), holds);
    if (!is_section)
      throw_input_error("{}: {}: got an unknown key{}, expected one like '{}'",
                        toml_location(file.source, node), path, file.writer(), closest_name(path, known));
    if (!node.is_table())
      throw_input_error("{}: {}: got {}, expected a table", toml_location(file.source, node), path,
                        describe_toml(node));
    check_keys(file, *node.as_table(), path + ".", known);
  }
}

void read_option(const RecordFile& file, const FitOption& option, FitRecord& record) {
  const toml::node* node = file.find(option.key);
  if (node)
    set_from_record(option, *node, file.source, record);
  else if (option.before)
    set_value(option, *option.before, record);
  else
    throw_field_error(option.field, "got nothing{}, expected {}", file.writer(), describe_values(option));
}

FitStop read_stop(const TomlSection& outcome) {
  const auto stop = value_named<FitStop>(outcome.text("stopped_by"));
  if (!stop) outcome.fail("stopped_by", fmt::format("{}", fmt::join(names_of<FitStop>(), ", ")));
  return *stop;
}

std::optional<FitOutcome> read_outcome(const TomlSection& root) {
  if (!root.has("outcome")) return std::nullopt;
  const TomlSection outcome = root.section("outcome");
  const long rounds = outcome.whole_or("branch_rounds", 0);  // earlier versions have none, nor a finish
  return FitOutcome{outcome.whole("evaluations"), rounds, outcome.whole_or("finish_from", rounds),
                    read_stop(outcome)};
}

std::map<std::string, std::string> texts_of(const TomlSection& section) {
  std::map<std::string, std::string> texts;
  for (const auto& [name, text] : section.table) texts[std::string(name.str())] = section.text(name.str());
  return texts;
}

void check_ends(const FitBudget& budget) {
  if (budget.evaluations == 0 && budget.seconds == 0)
    throw_field_error("budget.seconds", "got no budget, expected a number of seconds or of evaluations");
  if (budget.branch_rounds == kWhileTimeLasts && budget.seconds == 0)
    throw_field_error("budget.branch_rounds",
                      "got rounds without an end, expected a number of them or of seconds");
}

/// Files that the run keeps are named from its directory on; others as the user gave them.
void name_from(const std::filesystem::path& directory, const FitOption& option, FitRecord& record) {
  const auto found = [&](const std::string& name) {
    const std::filesystem::path kept = directory / name;
    std::error_code none;
    return std::filesystem::is_regular_file(kept, none) ? kept.string() : name;
  };
  if (option.field == "model") record.model = model_from(directory, record.model);
  if (option.field == "start") record.start = start_with(record.start, found);
  if (option.field == "species" && !record.species.empty()) record.species = found(record.species);
}

}  // namespace

void check_record(const FitRecord& record) {
  for (const FitOption& option : fit_options()) check_option(option, record);
  check_ends(record.budget);
}

std::string record_to_toml(const FitRecord& record, const std::optional<FitOutcome>& outcome) {
  std::string text;
  std::string_view section;
  for (const FitOption& option : fit_options()) {
    const OptionValue value = get_value(option, record);
    const bool is_left_out = option.is_written && !option.is_written(record);
    if (!is_left_out && !std::holds_alternative<std::monostate>(value))
      text += option_to_toml(option, value, section);
  }
  text += files_to_toml(record) + versions_to_toml(record) + (outcome ? outcome_to_toml(*outcome) : "");
  return with_check(fmt::format("{}format = {}\n", kHead, kFormat), text);
}

RecordedRun read_record(const std::filesystem::path& path) {
  const std::string source = path.string();
  const std::string text = read_toml_text(path);
  const RecordFile file{parse_toml(text, source), source};
  check_format(file);
  check_keys(file, file.table, "", known_keys());
  FitRecord record;
  const auto place = [&](const std::string& field) {
    const FitOption* option = find_option(field);
    return file.place_of(option ? option->key : field);
  };
  with_places(place, [&] {
    for (const FitOption& option : fit_options()) {
      read_option(file, option, record);
      name_from(path.parent_path(), option, record);
    }
    check_record(record);
  });
  record.versions = texts_of(file.root().section("versions"));
  if (file.root().has("files")) record.files = texts_of(file.root().section("files"));
  verify_check(text, source);  // what is wrong by itself has been told by now
  verify_files(record.files, path.parent_path());
  return {record, read_outcome(file.root())};
}

}  // namespace espalier
