// A fit of a model of your own: a fir of straight branches in whorls. A model is a table of parameters, from
// which the search space, checks and files are made, and a function from values and a seed to a plant.
//   own_model tree.png runs/fir 300
#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <string>

#include <espalier/espalier.h>

using namespace espalier;

namespace {

enum Row { height, reach, slope, whorls, needles };  // of the table, in its order
constexpr int kBranchesPerWhorl = 7;

class Fir : public Model {
 public:
  const ParameterTable& table() const override { return table_; }

  GrowthEstimate estimate(std::span<const double> values) const override {
    return {1 + values[whorls] * kBranchesPerWhorl, 0};
  }

  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& settings,
                        Plant& plant) const override {
    const double over = estimate(values).stems / settings.budget.max_stems;
    if (over > 1) return {.grown = false, .over_budget_factor = over};
    plant.clear();
    plant.stems.first_knot = {0};
    const auto top_m = static_cast<float>(values[height]);
    add_stem(plant, -1, {0, 0, 0}, {0, 0, top_m}, 0.02f * top_m);
    const int count = static_cast<int>(values[whorls]) * kBranchesPerWhorl;
    for (int i = 0; i < count; ++i) add_branch(plant, values, i, child_key(root_key(seed), i));
    return {};
  }

 private:
  /// Branch `index` of the trunk, counted from the base. Random numbers belong to a place: `key` is this
  /// branch's.
  static void add_branch(Plant& plant, std::span<const double> values, int index, RandomKey key) {
    const float share = 0.1f + 0.9f * static_cast<float>(index) / (values[whorls] * kBranchesPerWhorl);
    const Vec3 base{0, 0, share * static_cast<float>(values[height])};
    const float azimuth = 2 * std::numbers::pi_v<float> * uniform_unit(key, 0);
    const float length_m =
        static_cast<float>(values[reach]) * (1 - share) * (1 + 0.2f * uniform_signed(key, 1));
    const Vec3 along{std::cos(azimuth), std::sin(azimuth), static_cast<float>(values[slope])};
    add_stem(plant, 0, base, base + along * length_m, static_cast<float>(values[needles]));
  }

  /// A straight stem of two knots; the handles of its Bézier curve lie at thirds.
  static void add_stem(Plant& plant, int parent, Vec3 from, Vec3 to, float radius_m) {
    const Vec3 third = (to - from) * (1 / 3.f);
    plant.stems.parent.push_back(parent);
    plant.stems.origin.push_back(parent);
    plant.stems.level.push_back(parent < 0 ? 0 : 1);
    plant.stems.path_key.push_back(plant.stems.path_key.size());
    plant.stems.child_index.push_back(static_cast<std::uint32_t>(plant.stems.child_index.size()));
    for (const Vec3 point : {from, to}) {
      plant.knots.point_m.push_back(point);
      plant.knots.handle_in_m.push_back(point - third);
      plant.knots.handle_out_m.push_back(point + third);
    }
    plant.knots.radius_m.insert(plant.knots.radius_m.end(), {radius_m, 0.3f * radius_m});
    plant.stems.first_knot.push_back(static_cast<std::uint32_t>(plant.knots.size()));
  }

  static ParameterInfo row(const char* name, const char* unit, double lower, double upper, double value,
                           const char* help) {
    ParameterInfo row;
    row.name = name, row.unit = unit, row.help = help;
    row.lower = row.search_lower = lower, row.upper = row.search_upper = upper;  // valid, and searched
    row.default_value = value;
    row.free_by_default = true;
    return row;
  }

  static ParameterTable make_table() {
    ParameterTable table{"whorled_fir",
                         {row("height", "m", 1, 40, 10, "of the trunk"),
                          row("reach", "m", 0.2, 20, 3, "length of the lowest branches, to the side"),
                          row("slope", "1", -1, 1, -0.2, "rise of a branch on its way out"),
                          row("whorls", "1", 1, 60, 20, "rings of branches"),
                          row("needles", "m", 0.01, 0.5, 0.1, "radius of a branch with its needles")}};
    table.rows[whorls].scale = Scale::integer;
    return table;
  }

  ParameterTable table_ = make_table();
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return fmt::print(stderr, "usage: own_model PICTURE DIRECTORY EVALUATIONS\n"), 2;
  try {
    FitRecord record;
    record.views = {{arguments[1], {}}};
    record.budget = {.evaluations = std::stol(arguments[3]), .seconds = 0};
    const Fir fir;
    FitExecution options;
    options.model = &fir;
    const FitResult result = fit(record, arguments[2], options);
    fmt::print("fitness {:.3f}", result.fitness);
    for (std::size_t i = 0; i < result.values.size(); ++i)
      fmt::print(", {} {:.2f}", fir.table().rows[i].name, result.values[i]);
    fmt::print("\n");
  } catch (const InputError& error) {
    return fmt::print(stderr, "{}\n", error.what()), 2;
  }
}
