#include <algorithm>
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

template <typename Named>
std::string names_to_toml(const std::vector<Named>& all, std::string (*name)(const Named&)) {
  std::string text;
  for (const Named& one : all) text += (text.empty() ? "" : ", ") + quote_toml(name(one));
  return fmt::format("[{}]", text);
}

std::string own_name(const std::string& name) { return name; }
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

/// The rows that the file lists: all but some of parts that no plant of it has.
std::vector<std::size_t> read_rows(const SpaceReader& reader, const ParameterTable& table) {
  const toml::array& listed = reader.array("parameters");
  std::vector<std::size_t> rows;
  std::vector<std::string> names;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const ParameterInfo& info = table.rows[row];
    const auto is_it = [&](const toml::node& node) {
      return node.value_exact<std::string>() == info.full_name();
    };
    if (!info.part_of.empty() && std::none_of(listed.begin(), listed.end(), is_it)) continue;
    rows.push_back(row);
    names.push_back(info.full_name());
  }
  reader.check_names("parameters", names, own_name);
  return rows;
}

SpeciesPoint read_species(const SpaceReader& reader, const ParameterTable& table,
                          const std::vector<std::size_t>& rows, int dimension) {
  SpeciesPoint species{.name = reader.text("name"), .values = table.defaults()};
  const Eigen::VectorXd values = reader.numbers("values", rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double value = species.values[rows[i]] = values[static_cast<Index>(i)];
    check_value(table.rows[rows[i]], value, toml_location(reader.source, reader.array("values")));
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

namespace {

/// All but those that the encoding leaves out as part of what no plant has.
std::vector<std::size_t> written_rows(const SpeciesSpace& space) {
  const ParameterTable& table = space.model->table();
  std::vector<bool> in_use(table.rows.size(), false);
  for (const SpeciesPoint& species : space.species) {
    const std::vector<bool> of_one = rows_in_use(table, species.values);
    for (std::size_t row = 0; row < in_use.size(); ++row) in_use[row] = in_use[row] || of_one[row];
  }
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < in_use.size(); ++row)
    if (in_use[row]) rows.push_back(row);
  return rows;
}

std::vector<std::string> names_of(const ParameterTable& table, const std::vector<std::size_t>& rows) {
  std::vector<std::string> names;
  names.reserve(rows.size());
  for (const std::size_t row : rows) names.push_back(table.rows[row].full_name());
  return names;
}

std::vector<double> values_of(const ParameterValues& all, const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const std::size_t row : rows) values.push_back(all[row]);
  return values;
}

}  // namespace

std::string species_space_to_toml(const SpeciesSpace& space) {
  const PrincipalComponents& pca = space.pca;
  std::string text = fmt::format(
      "# A species space: for espalier blend, space and fits\nformat = {}\nmodel = {}\nencoding = {}\n",
      kFormat, quote_toml(space.model->table().model), quote_toml(space.encoding->name()));
  const std::vector<std::size_t> rows = written_rows(space);
  text += fmt::format("parameters = {}\n", names_to_toml(names_of(space.model->table(), rows), own_name));
  text += fmt::format("columns = {}\n", names_to_toml(space.encoding->columns(), column_name));
  text +=
      fmt::format("mean = {}\ndeviation = {}  # 0: constant\nvariance = {}\ncomponents = [\n",
                  numbers_to_toml(pca.mean), numbers_to_toml(pca.deviation), numbers_to_toml(pca.variance));
  for (Index i = 0; i < pca.components.rows(); ++i)
    text += fmt::format("  {},\n", numbers_to_toml(Eigen::VectorXd(pca.components.row(i))));
  text += "]\n";
  for (const SpeciesPoint& species : space.species)
    text +=
        fmt::format("\n[[species]]\nname = {}\n{}coordinates = {}\nvalues = {}\n", quote_toml(species.name),
                    species.demonstration ? "demonstration = true\n" : "",
                    numbers_to_toml(species.coordinates), numbers_to_toml(values_of(species.values, rows)));
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
  const std::vector<std::size_t> rows = read_rows(reader, table);
  std::vector<bool> is_in_file(table.rows.size(), false);
  for (const std::size_t row : rows) is_in_file[row] = true;
  space.encoding = make_encoding(reader.text("encoding"), table, is_in_file);
  reader.check_names("columns", space.encoding->columns(), column_name);
  read_components(reader, space.encoding->columns().size(), space.pca);
  for (const toml::node& node : reader.array("species")) {
    if (!node.is_table()) reader.fail("species", "an array of tables");
    space.species.push_back(read_species({*node.as_table(), source}, table, rows, space.dimension()));
  }
  if (space.species.size() < 2) reader.fail("species", "at least 2 of them");
  return space;
}

}  // namespace espalier
