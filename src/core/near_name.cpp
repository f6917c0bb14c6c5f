#include <algorithm>
#include <cstdint>
#include <vector>

#include <espalier/core/near_name.h>

namespace espalier {

namespace {

/// Letters to insert, delete, replace or exchange with their neighbour (Damerau 1964, restricted).
std::size_t count_typos(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> typos(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        typos[i][j] = i + j;
        continue;
      }
      typos[i][j] = std::min(
          {typos[i - 1][j] + 1, typos[i][j - 1] + 1, typos[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        typos[i][j] = std::min(typos[i][j], typos[i - 2][j - 2] + 1);
    }
  return typos[a.size()][b.size()];
}

/// 1 where the word was cut short: it is the beginning of the name. Words of more than
/// 100 letters are compared by their beginnings.
std::size_t steps_between(std::string_view word, std::string_view name) {
  constexpr std::size_t kMostLetters = 100;
  const bool is_cut_short = word.size() >= 2 && name.starts_with(word) && name != word;
  return is_cut_short ? 1 : count_typos(word.substr(0, kMostLetters), name.substr(0, kMostLetters));
}

}  // namespace

std::string closest_name(std::string_view word, std::span<const std::string> known) {
  std::string closest;
  std::size_t least = SIZE_MAX;
  for (const std::string& name : known) {
    const std::size_t steps = steps_between(word, name);
    if (steps < least) closest = name, least = steps;
  }
  return closest;
}

std::optional<std::string> near_name(std::string_view word, std::span<const std::string> known) {
  const std::string closest = closest_name(word, known);
  const std::size_t most = word.size() < 3 ? 1 : 1 + word.size() / 3;
  if (closest.empty() || steps_between(word, closest) > most) return std::nullopt;
  return closest;
}

}  // namespace espalier
