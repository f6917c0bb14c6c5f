#include <espalier/experiments/declaration/experiment_keys.h>

namespace espalier {

namespace {

std::string in_code(const std::string& text) { return text.empty() ? "" : fmt::format("`{}`", text); }

std::string row_as_markdown(const KeyDescription& key) {
  const std::string otherwise = key.required ? "must be given" : key.otherwise;
  return fmt::format("| {} | {} | {} | {} |\n", in_code(key.key), key.values, otherwise, key.help);
}

std::string table_of(const std::string& title, const std::vector<KeyDescription>& keys) {
  std::string text = fmt::format("\n{}:\n\n| key | values | default | meaning |\n|---|---|---|---|\n", title);
  for (const KeyDescription& key : keys) text += row_as_markdown(key);
  return text;
}

template <typename Part>
std::string table_of(const std::string& title, const std::vector<ExperimentKey<Part>>& keys) {
  std::vector<KeyDescription> words;
  words.reserve(keys.size());
  for (const auto& key : keys) words.push_back(key.words);
  return table_of(title, words);
}

}  // namespace

std::vector<std::string> names_of(const std::vector<KeyDescription>& keys) {
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const KeyDescription& key : keys) names.push_back(key.key);
  return names;
}

std::string experiment_keys_as_markdown() {
  return table_of("Of the file", word_keys()) + table_of("`[fits]`", fits_keys()) +
         table_of("A target", target_keys()) +
         table_of("An optimiser, besides the [settings](optimizers.md) of its method", optimizer_keys()) +
         table_of("A space", space_keys()) + table_of("`[pictures]`", pictures_keys()) +
         table_of("A row or a column of pictures", change_keys()) + table_of("`[growth]`", growth_keys()) +
         table_of("An L-system of `[growth]`", grown_model_keys());
}

}  // namespace espalier
