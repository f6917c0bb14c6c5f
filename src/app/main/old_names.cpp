#include <algorithm>
#include <string_view>

#include <espalier/app/main/old_names.h>

namespace espalier {

namespace {

struct OtherName {
  std::string_view command;  ///< empty: all
  std::string_view other, name;
};

constexpr OtherName kOtherNames[] = {
    {"", "--out", "--output"},
    {"fit", "--method", "--separation"},
    {"fit", "--side", "--tree-side"},
    {"fit", "--view", "--views"},
    {"fit", "--set", "--fix"},
    {"target", "--method", "--separation"},
    {"target", "--side", "--tree-side"},
    {"compare", "--method", "--separation"},
    {"compare", "--side", "--tree-side"},
    {"posterior", "--method", "--separation"},
    {"posterior", "--side", "--tree-side"},
};

std::string name_of_today(std::string_view command, const std::string& word) {
  const std::string_view option = std::string_view(word).substr(0, word.find('='));
  for (const OtherName& row : kOtherNames)
    if (option == row.other && (row.command.empty() || row.command == command))
      return std::string(row.name) + word.substr(option.size());
  return word;
}

}  // namespace

std::vector<std::string> with_names_of_today(std::vector<std::string> words) {
  if (words.empty()) return words;
  const std::string command = words.front();
  const auto end = std::find(words.begin(), words.end(), "--");
  std::transform(words.begin(), end, words.begin(),
                 [&](const std::string& word) { return name_of_today(command, word); });
  return words;
}

}  // namespace espalier
