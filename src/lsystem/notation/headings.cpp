#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/lsystem/notation/headings.h>
#include <espalier/lsystem/notation/settings.h>

namespace espalier::lsystem {

namespace {

/// Those that statements or code follow.
const std::vector<std::string> kHeadings{"productions", "interpretation", "table", "lua"};

/// Other keywords that a colon follows.
constexpr std::array kKeywords{"axiom",    "symbols",  "colors", "ignore", "consider",
                               "branches", "segments", "sun",    "shade"};

/// What cpfg and L-Py call things, by how their words begin, and what is closest here.
struct ForeignWord {
  std::string_view begins, closest;
  bool is_heading = true;  ///< an id that begins so is taken for it
};
constexpr std::array kForeign{
    ForeignWord{"production", "productions"},         ForeignWord{"interpret", "interpretation"},
    ForeignWord{"homomorph", "interpretation"},       ForeignWord{"decompos", "productions"},
    ForeignWord{"derivation length", "steps", false}, ForeignWord{"startlsystem", "axiom", false}};

/// The words of the first line before its colon or end; empty where something else stands there.
std::string words_before_colon(std::string_view line) {
  std::string_view words = line.substr(0, line.find(':'));
  while (words.ends_with(' ')) words.remove_suffix(1);
  const auto is_part = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == ' '; };
  return std::all_of(words.begin(), words.end(), is_part) ? std::string(words) : "";
}

std::string_view first_line(std::string_view statement) {
  std::string_view line = statement.substr(0, statement.find('\n'));
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
  return line;
}

const ForeignWord* find_foreign(std::string words) {
  std::transform(words.begin(), words.end(), words.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::find_if(kForeign.begin(), kForeign.end(),
                                  [&](const ForeignWord& word) { return words.starts_with(word.begins); });
  return found == kForeign.end() ? nullptr : &*found;
}

std::string closest_heading(const std::string& words) {
  const ForeignWord* foreign = find_foreign(words);
  return foreign ? std::string(foreign->closest) : closest_name(words, kHeadings);
}

std::vector<std::string> known_words() {
  std::vector<std::string> known = kHeadings;
  known.insert(known.end(), kKeywords.begin(), kKeywords.end());
  for (const std::string_view name : setting_names()) known.emplace_back(name);
  return known;
}

/// "table" with a slip, and what follows it: the words before its colon are no plain words.
bool is_misspelt_table(std::string_view line) {
  return line.ends_with(':') && line.find("-->") == std::string_view::npos &&
         line.find(" when ") != std::string_view::npos;
}

}  // namespace

void check_heading(const Cursor& cursor) {
  const std::string_view line = first_line(cursor.rest());
  std::string words = words_before_colon(line);
  const ForeignWord* foreign = find_foreign(words);
  // An id has its colon at once and its production beside it; the colon before a condition has a space before
  // it.
  const std::string_view after = line.substr(words.size());
  const bool is_id = after.starts_with(':'), ends = after == ":" || after == " :" || after.empty();
  const bool is_heading =
      !words.empty() && (after == ":" || ((is_id || ends) && foreign && foreign->is_heading));
  if (is_misspelt_table(line))
    words = std::string(line.substr(0, line.find(' ')));
  else if (!is_heading)
    return;
  throw_at(
      cursor.position(),
      "got the unknown heading '{}', expected productions, interpretation, table or lua, the closest is '{}'",
      words, closest_heading(words));
}

void fail_unknown(const Cursor& cursor, std::string_view expected) {
  const std::string_view line = first_line(cursor.rest());
  const std::string words = words_before_colon(line);
  if (words.empty() || line.find(':') == std::string_view::npos) cursor.fail(expected);
  const ForeignWord* foreign = find_foreign(words);
  throw_at(cursor.position(), "got '{}:', expected {}, the closest is '{}'", words, expected,
           foreign ? std::string(foreign->closest) : closest_name(words, known_words()));
}

}  // namespace espalier::lsystem
