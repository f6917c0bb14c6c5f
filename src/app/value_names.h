// What options and positional arguments take: the word that help shows for it, and what shells complete.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace espalier {

/// What a shell offers: nothing, files, directories, or words of a list.
enum class Offers { nothing, files, directories, words };

struct ValueName {
  std::string_view command;  ///< empty: of all
  std::string_view option;   ///< "--output", or the name of a positional argument
  std::string_view shown;    ///< "FILE"
  Offers offers = Offers::nothing;
  std::string_view list = {};  ///< of words: which, of those that completion is given, or "a|b|c" itself
};

/// The row of an option of a command; what CLI11 says of its type where the table has none.
ValueName value_name(const CLI::App& command, const CLI::Option& option);

/// Words by the name of their list: "presets", "optimizers".
using WordLists = std::map<std::string, std::vector<std::string>, std::less<>>;

/// What completes a value; files are not among them.
std::vector<std::string> words_for(const ValueName& value, const WordLists& lists);

}  // namespace espalier
