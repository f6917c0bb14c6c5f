#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/core/parallel_for.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>

namespace espalier {

namespace {

constexpr std::size_t kBlock = 256;  ///< draws between two looks at the progress
constexpr std::uint32_t kAttempts = 100;

struct DrawnRow {
  Simulation simulation;
  std::uint32_t species = 0, attempt = 0;
};

DrawnRow draw_row(const PlantPrior& prior, Seed seed, std::size_t row, PlantSimulator& simulator) {
  DrawnRow drawn;
  for (std::uint32_t attempt = 0; attempt < kAttempts; ++attempt) {
    const PlantDraw draw = draw_of_row(prior, seed, row, attempt);
    if (!simulator.simulate(draw, drawn.simulation)) continue;
    drawn.species = static_cast<std::uint32_t>(draw.species);
    drawn.attempt = attempt;
    return drawn;
  }
  throw InternalError(fmt::format("draw {} of the prior: {} plants in turn do not grow", row, kAttempts));
}

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

void put_row(const std::vector<double>& values, std::size_t row, Eigen::MatrixXd& matrix) {
  matrix.row(index(row)) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), index(values.size()));
}

void resize(std::size_t size, std::size_t unknowns, ReferenceTable& table) {
  table.unknowns.conservativeResize(index(size), index(unknowns));
  table.summaries.conservativeResize(index(size), index(summary_names().size()));
  table.species.resize(size);
  table.attempt.resize(size);
}

/// Of the prior, of how plants grow and are measured: a hash of the first rows of a table.
std::uint64_t fingerprint_of(const PlantPrior& prior, double height_m) {
  constexpr std::size_t kRows = 4;
  PlantSimulator simulator(prior, height_m);
  std::uint64_t hash = prior.species().size();
  for (std::size_t row = 0; row < kRows; ++row) {
    const DrawnRow drawn = draw_row(prior, 1, row, simulator);
    for (const std::vector<double>* numbers : {&drawn.simulation.unknowns, &drawn.simulation.summaries})
      for (const double number : *numbers) hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(number));
  }
  return hash;
}

std::string names_of(const std::vector<Unknown>& unknowns) {
  std::string names;
  for (const Unknown& unknown : unknowns) names.append(names.empty() ? "" : ", ").append(unknown.name);
  return names;
}

/// All that a table's numbers depend on but their count, a line each.
std::string head_of(const PlantPrior& prior, Seed seed, double height_m) {
  return fmt::format(
      "espalier reference table 2\nmodel {}\nseed {}\nheight_m {}\nunknowns {}\nsummaries {}\nprior "
      "{:016x}\n",
      prior.model().table().model, seed, height_m, names_of(unknowns_of(prior)),
      fmt::join(summary_names(), ", "), fingerprint_of(prior, height_m));
}

template <typename Number>
void append_numbers(const Number* numbers, std::size_t count, std::string& bytes) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
}

/// Takes numbers from the front of a text.
class NumberReader {
 public:
  explicit NumberReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number>
  void read(Number* numbers, std::size_t count) {
    std::memcpy(numbers, bytes_.data(), count * sizeof(Number));
    bytes_.remove_prefix(count * sizeof(Number));
  }

 private:
  std::string_view bytes_;
};

std::string_view first_line(std::string_view text) { return text.substr(0, text.find('\n')); }

/// Says the first line in which the file's head differs.
[[noreturn]] void refuse_head(const std::filesystem::path& path, std::string_view got,
                              std::string_view expected) {
  while (!expected.empty() && first_line(got) == first_line(expected)) {
    const std::size_t next = first_line(expected).size() + 1;
    got.remove_prefix(std::min(next, got.size()));
    expected.remove_prefix(std::min(next, expected.size()));
  }
  throw_input_error(
      "{}: got '{}', expected '{}': the table is of another prior, seed, height or version; name another "
      "file",
      path.string(), first_line(got).substr(0, 60), first_line(expected).substr(0, 60));
}

}  // namespace

PlantDraw draw_of_row(const PlantPrior& prior, Seed seed, std::size_t row, std::uint32_t attempt) {
  const RandomKey key = child_key(root_key(seed), row);
  return prior.draw(attempt == 0 ? key : child_key(key, attempt));
}

void extend_table(const PlantPrior& prior, std::size_t size, int threads, const TableProgress& progress,
                  ReferenceTable& table) {
  const std::size_t unknowns = unknowns_of(prior).size();
  std::size_t done = table.size();
  while (done < size && progress(done, size)) {
    const std::size_t end = std::min(size, done + kBlock);
    resize(end, unknowns, table);
    constexpr std::size_t kPart = 32;  // rows that share a simulator's memory
    parallel_for((end - done + kPart - 1) / kPart,
                 [&](std::size_t part) {
                   PlantSimulator simulator(prior, table.height_m);
                   for (std::size_t row = done + part * kPart; row < std::min(end, done + (part + 1) * kPart);
                        ++row) {
                     const DrawnRow drawn = draw_row(prior, table.seed, row, simulator);
                     put_row(drawn.simulation.unknowns, row, table.unknowns);
                     put_row(drawn.simulation.summaries, row, table.summaries);
                     table.species[row] = drawn.species;
                     table.attempt[row] = drawn.attempt;
                   }
                 },
                 threads);
    done = end;
  }
}

ReferenceTable read_table(const std::filesystem::path& path, const PlantPrior& prior, Seed seed,
                          double height_m) {
  ReferenceTable table{.seed = seed, .height_m = height_m};
  const std::size_t unknowns = unknowns_of(prior).size();
  resize(0, unknowns, table);
  if (std::error_code ignored; !std::filesystem::exists(path, ignored)) return table;
  const std::string bytes = read_file(path);
  const std::string head = head_of(prior, seed, height_m);
  if (!bytes.starts_with(head)) refuse_head(path, bytes, head);
  const std::string_view body = std::string_view(bytes).substr(head.size());
  const std::size_t bytes_per_row =
      sizeof(double) * (unknowns + summary_names().size()) + 2 * sizeof(std::uint32_t);
  if (body.size() % bytes_per_row != 0)
    throw_input_error("{}: got {} bytes of rows, expected a multiple of {}: the file is damaged",
                      path.string(), body.size(), bytes_per_row);
  resize(body.size() / bytes_per_row, unknowns, table);
  NumberReader reader(body);
  reader.read(table.unknowns.data(), static_cast<std::size_t>(table.unknowns.size()));
  reader.read(table.summaries.data(), static_cast<std::size_t>(table.summaries.size()));
  reader.read(table.species.data(), table.size());
  reader.read(table.attempt.data(), table.size());
  if (!table.unknowns.allFinite() || !table.summaries.allFinite())
    throw_input_error("{}: got numbers that are not finite, expected a table: the file is damaged",
                      path.string());
  for (std::size_t row = 0; row < table.size(); ++row)
    if (table.species[row] >= prior.species().size() || table.attempt[row] >= kAttempts)
      throw_input_error(
          "{}: got species {} and attempt {} in row {}, expected less than {} and {}: the file is damaged",
          path.string(), table.species[row], table.attempt[row], row, prior.species().size(), kAttempts);
  return table;
}

void write_table(const std::filesystem::path& path, const PlantPrior& prior, const ReferenceTable& table) {
  std::string bytes = head_of(prior, table.seed, table.height_m);
  append_numbers(table.unknowns.data(), static_cast<std::size_t>(table.unknowns.size()), bytes);
  append_numbers(table.summaries.data(), static_cast<std::size_t>(table.summaries.size()), bytes);
  append_numbers(table.species.data(), table.size(), bytes);
  append_numbers(table.attempt.data(), table.size(), bytes);
  write_file_atomically(path, bytes);
}

}  // namespace espalier
