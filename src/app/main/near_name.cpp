#include <algorithm>
#include <vector>

#include <espalier/app/main/near_name.h>

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

}  // namespace

std::optional<std::string> near_name(std::string_view word, std::span<const std::string> known) {
  std::optional<std::string> nearest;
  std::size_t least = word.size() < 3 ? 1 : 1 + word.size() / 3;
  for (const std::string& name : known) {
    const bool is_cut_short = word.size() >= 3 && name.starts_with(word);
    const std::size_t typos = is_cut_short ? 1 : count_typos(word, name);
    if (typos < least || (typos == least && !nearest)) nearest = name, least = typos;
  }
  return nearest;
}

}  // namespace espalier
