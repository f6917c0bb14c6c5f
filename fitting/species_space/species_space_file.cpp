#include <cmath>

#include <espalier/core/error.h>
#include <espalier/core/toml/toml_file.h>
#include <espalier/fitting/species_space/species_space_file.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

using Eigen::Index;
constexpr int kFormat = 1;

// Writing.

/// The shortest decimals that read back to the same bits, as a TOML float.
std::string number_to_toml(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

template <typename Numbers>
std::string numbers_to_toml(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_to_toml(number);
  return fmt::format("[{}]", text);
}

/// The entries of rows that the space's encoding writes.
template <typename T>
std::vector<T> of_written_rows(const Encoding& encoding, const std::vector<T>& of_rows) {
  std::vector<T> written;
  written.reserve(of_rows.size());
  for (std::size_t row = 0; row < of_rows.size(); ++row)
    if (encoding.writes(row)) written.push_back(of_rows[row]);
  return written;
}

template <typename Named>
std::string names_to_toml(const std::vector<Named>& all, std::string (*name)(const Named&)) {
  std::string text;
  for (const Named& one : all) text += (text.empty() ? "" : ", ") + quote_toml(name(one));
  return fmt::format("[{}]", text);
}

std::string row_name(const ParameterInfo& row) { return row.full_name(); }
std::string column_name(const EncodingColumn& column) { return column.name; }

// Reading: each failure names file, line, key, got and expected.

struct SpaceReader {
  const toml::table& table;
  const std::string& source;

  [[noreturn]] void fail(std::string_view key, const std::string& expected) const {
    const toml::node* node = table.get(key);
    throw_input_error("{}: key '{}': got {}, expected {}", toml_location(source, node ? *node : table), key,
                      node ? describe_toml(*node) : "nothing", expected);
  }
  std::string text(std::string_view key) const {
    if (const auto value = table[key].value_exact<std::string>()) return *value;
    fail(key, "a string of a species space");
  }
  const toml::array& array(std::string_view key) const {
    if (const toml::array* found = table[key].as_array()) return *found;
    fail(key, "an array of a species space");
  }
  Eigen::VectorXd numbers(std::string_view key, std::size_t count) const {
    return numbers_of(array(key), key, count);
  }
  Eigen::VectorXd numbers_of(const toml::array& list, std::string_view key, std::size_t count) const {
    const std::string expected =
        count > 0 ? fmt::format("an array of {} finite numbers", count) : "an array of finite numbers";
    if ((count > 0 && list.size() != count) || list.empty()) fail(key, expected);
    Eigen::VectorXd numbers(static_cast<Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto value = list[i].value<double>();
      if (!value || !std::isfinite(*value)) fail(key, expected);
      numbers[static_cast<Index>(i)] = *value;
    }
    return numbers;
  }
  /// False where it is not there.
  bool flag(std::string_view key) const {
    if (!table.contains(key)) return false;
    if (const auto value = table[key].value_exact<bool>()) return *value;
    fail(key, "true or false");
  }
  /// Throws unless the array holds these names in this order.
  template <typename Named>
  void check_names(std::string_view key, const std::vector<Named>& all,
                   std::string (*name)(const Named&)) const {
    const toml::array& list = array(key);
    bool same = list.size() == all.size();
    for (std::size_t i = 0; same && i < all.size(); ++i)
      same = list[i].value_exact<std::string>() == std::optional(name(all[i]));
    if (!same) fail(key, fmt::format("the {} {} of this program", all.size(), key));
  }
};

/// Curves and parts that the file does not name are left out, as in what older programs wrote.
std::vector<bool> written_rows(const SpaceReader& reader, const ParameterTable& table) {
  std::vector<bool> written;
  written.reserve(table.rows.size());
  for (const ParameterInfo& row : table.rows)
    written.push_back(row.point < 0 && row.part_of.empty() && !row.says_nothing_at_default);
  for (const toml::node& name : reader.array("parameters"))
    if (const auto row = table.find(name.value_or(std::string()))) written[*row] = true;
  return written;
}

SpeciesPoint read_species(const SpaceReader& reader, const Encoding& encoding, int dimension) {
  SpeciesPoint species;
  species.name = reader.text("name");
  species.values = encoding.table().defaults();
  const Eigen::VectorXd values = reader.numbers("values", of_written_rows(encoding, species.values).size());
  Index next = 0;
  for (std::size_t row = 0; row < species.values.size(); ++row) {
    if (!encoding.writes(row)) continue;
    species.values[row] = values[next++];
    check_value(encoding.table().rows[row], species.values[row],
                toml_location(reader.source, reader.array("values")));
  }
  species.coordinates = reader.numbers("coordinates", static_cast<std::size_t>(dimension));
  species.demonstration = reader.flag("demonstration");
  return species;
}

void read_components(const SpaceReader& reader, std::size_t columns, PrincipalComponents& pca) {
  pca.mean = reader.numbers("mean", columns);
  pca.deviation = reader.numbers("deviation", columns);
  pca.variance = reader.numbers("variance", 0);
  const toml::array& rows = reader.array("components");
  if (rows.empty() || static_cast<Index>(rows.size()) > pca.variance.size())
    reader.fail("components", fmt::format("1 … {} arrays of numbers", pca.variance.size()));
  pca.components.resize(static_cast<Index>(rows.size()), static_cast<Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const toml::array* row = rows[i].as_array();
    if (!row) reader.fail("components", "an array of arrays of numbers");
    pca.components.row(static_cast<Index>(i)) = reader.numbers_of(*row, "components", columns);
  }
}

}  // namespace

std::string species_space_to_toml(const SpeciesSpace& space) {
  const PrincipalComponents& pca = space.pca;
  std::string text = fmt::format(
      "# A species space: for espalier blend, space and fits\nformat = {}\nmodel = {}\nencoding = {}\n",
      kFormat, quote_toml(space.model->table().model), quote_toml(space.encoding->name()));
  text += fmt::format("parameters = {}\n",
                      names_to_toml(of_written_rows(*space.encoding, space.model->table().rows), row_name));
  text += fmt::format("columns = {}\n", names_to_toml(space.encoding->columns(), column_name));
  text +=
      fmt::format("mean = {}\ndeviation = {}  # 0: constant\nvariance = {}\ncomponents = [\n",
                  numbers_to_toml(pca.mean), numbers_to_toml(pca.deviation), numbers_to_toml(pca.variance));
  for (Index i = 0; i < pca.components.rows(); ++i)
    text += fmt::format("  {},\n", numbers_to_toml(Eigen::VectorXd(pca.components.row(i))));
  text += "]\n";
  for (const SpeciesPoint& species : space.species)
    text += fmt::format("\n[[species]]\nname = {}\n{}coordinates = {}\nvalues = {}\n",
                        quote_toml(species.name), species.demonstration ? "demonstration = true\n" : "",
                        numbers_to_toml(species.coordinates),
                        numbers_to_toml(of_written_rows(*space.encoding, species.values)));
  return text;
}

SpeciesSpace read_species_space(const std::filesystem::path& path) {
  const std::string source = path.string();
  const toml::table document = parse_toml(read_toml_text(path), source);
  const SpaceReader reader{document, source};
  if (document["format"].value_exact<std::int64_t>() != std::optional<std::int64_t>(kFormat))
    reader.fail("format", fmt::format("{}, of a species space", kFormat));
  SpeciesSpace space;
  space.model = &model_by_name(reader.text("model"));
  const ParameterTable& table = space.model->table();
  space.encoding = make_encoding(reader.text("encoding"), table, written_rows(reader, table));
  reader.check_names("parameters", of_written_rows(*space.encoding, table.rows), row_name);
  reader.check_names("columns", space.encoding->columns(), column_name);
  read_components(reader, space.encoding->columns().size(), space.pca);
  for (const toml::node& node : reader.array("species")) {
    if (!node.is_table()) reader.fail("species", "an array of tables");
    space.species.push_back(read_species({*node.as_table(), source}, *space.encoding, space.dimension()));
  }
  if (space.species.size() < 2) reader.fail("species", "at least 2 of them");
  return space;
}

}  // namespace espalier
