#include "kept_table.h"

#include <fmt/format.h>

namespace espalier {

ReferenceTable kept_table(const std::filesystem::path& path, const PlantPrior& prior, Seed seed,
                          double height_m, std::size_t size) {
  ReferenceTable table = read_table(path, prior, seed, height_m);
  const std::size_t before = table.size();
  extend_table(
      prior, size, 0,
      [](std::size_t done, std::size_t wanted) {
        if (done % 2048 == 0) fmt::print(stderr, "{} of {} plants\n", done, wanted);
        return true;
      },
      table);
  if (table.size() > before) write_table(path, prior, table);
  return table;
}

}  // namespace espalier
