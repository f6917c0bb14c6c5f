// The keys of an experiment's file as tables, one row for each key: what it may be, what it is by default,
// what it means, how it is read, and what of it a study that has runs may change. From the rows are made the
// reading, the message for an unknown key, the growing of a study, and the tables of docs/experiments.md.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <espalier/core/toml/toml_section.h>
#include <espalier/experiments/declaration/experiment.h>

namespace espalier {

struct KeyDescription {
  std::string key, values;
  std::string otherwise;  ///< its default as TOML, or words; empty: none
  std::string help;
  bool required = false;
};

template <typename Part>
struct ExperimentKey {
  KeyDescription words;
  /// Null where another row's reader reads it.
  std::function<void(const TomlSection& section, Part& part)> read;
  /// What is wrong with it for a study that has runs of `was`; empty where these stay as they are. Null: it
  /// changes no run.
  std::function<std::string(const Part& was, const Part& is)> change;
};

/// Of the file, then of its tables; a reader of [fits] may use what the rows before it have read.
const std::vector<ExperimentKey<ExperimentMetadata>>& word_keys();
const std::vector<ExperimentKey<FitsDeclaration>>& fits_keys();
const std::vector<ExperimentKey<PicturesDeclaration>>& pictures_keys();
const std::vector<ExperimentKey<GrowthDeclaration>>& growth_keys();

/// Of elements of lists that are tables.
const std::vector<KeyDescription>& target_keys();
const std::vector<KeyDescription>& optimizer_keys();  ///< besides the settings of the method
const std::vector<KeyDescription>& space_keys();
const std::vector<KeyDescription>& change_keys();  ///< rows and columns of a sheet
const std::vector<KeyDescription>& grown_model_keys();

std::vector<std::string> names_of(const std::vector<KeyDescription>& keys);

template <typename Part>
std::vector<std::string> names_of(const std::vector<ExperimentKey<Part>>& keys) {
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const auto& key : keys) names.push_back(key.words.key);
  return names;
}

/// Reads the keys that are there, in the order of the rows.
template <typename Part>
void read_keys(const TomlSection& section, const std::vector<ExperimentKey<Part>>& keys, Part& part) {
  for (const auto& key : keys)
    if (key.read && (key.words.required || section.has(key.words.key))) key.read(section, part);
}

/// "KEY: got …, expected …" for the first key that changes runs; empty where there is none. Plain values
/// stand behind lists, which may hold what they say: they are looked at first.
template <typename Part>
std::string first_change(const std::vector<ExperimentKey<Part>>& keys, const Part& was, const Part& is) {
  for (auto key = keys.rbegin(); key != keys.rend(); ++key)
    if (key->change)
      if (const std::string change = key->change(was, is); !change.empty())
        return key->words.key + ": " + change;
  return "";
}

/// Of a plain value: what it was is what it has to be.
template <typename Part, typename Show>
auto unchanged(Show show) {
  return [show](const Part& was, const Part& is) -> std::string {
    const auto before = fmt::format("{}", show(was)), now = fmt::format("{}", show(is));
    return before == now ? "" : fmt::format("got {}, expected {}", now, before);
  };
}

/// Of a list that may grow: each value is still there, by its label, and is what it was.
template <typename Value, typename Label, typename Describe>
std::string lost_or_changed(const std::vector<Value>& was, const std::vector<Value>& is, Label label,
                            Describe describe) {
  std::map<std::string, std::string> now;  // described: of a list of switches there are no addresses
  for (const Value& value : is) now.emplace(label(value), describe(value));
  for (const Value& before : was) {
    const auto found = now.find(label(before));
    if (found == now.end())
      return fmt::format("got none that is '{}', expected it among them", label(before));
    if (found->second != describe(before))
      return fmt::format("got {}, expected {}", found->second, describe(before));
  }
  return "";
}

/// The tables of docs/experiments.md.
std::string experiment_keys_as_markdown();

}  // namespace espalier
