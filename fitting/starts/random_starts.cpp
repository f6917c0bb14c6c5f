#include <cmath>

#include <espalier/core/field_error.h>
#include <espalier/fitting/starts/random_starts.h>

namespace espalier {

namespace {

constexpr std::uint32_t kPurpose = 0x737274;  // keeps these draws apart from a plant's and an optimiser's
constexpr std::uint64_t kTries = 100;

ParameterValues draw_values(const SearchSpace& space, RandomKey key) {
  std::vector<double> unit(space.dimension());
  for (std::size_t i = 0; i < unit.size(); ++i)
    unit[i] = static_cast<double>(uniform_unit(key, kPurpose, static_cast<std::uint32_t>(i)));
  ParameterValues values = space.base;
  space.decode(unit, values);
  return values;
}

/// Plants that hang or wind do not grow in proportion to their size.
bool grows_as_tall(const Model& model, const GrowthBudget& budget, Seed seed, double height_m,
                   const ParameterValues& values) {
  constexpr double kTolerance = 0.1;
  Plant plant;
  return model.generate(values, seed, {budget, nullptr}, plant).grown &&
         std::fabs(bounds(plant).upper.z - height_m) <= kTolerance * height_m;
}

}  // namespace

std::vector<StartPoint> random_starts(const Model& model, int draws, const SearchChoice& choice,
                                      const GrowthBudget& budget, double height_m, Seed plant_seed) {
  SearchChoice everything = choice;
  everything.free = {"*"};
  const ParameterTable& table = model.table();
  const SearchSpace space = make_search_space(table, table.defaults(), everything);
  std::vector<StartPoint> points;
  for (std::uint64_t i = 0; points.size() < static_cast<std::size_t>(draws); ++i) {
    if (i >= kTries * (points.size() + 1))
      throw_field_error("start", "got random plants of {}, of which {} in turn do not grow within the budget",
                        table.model, kTries);
    ParameterValues values = draw_values(space, child_key(root_key(plant_seed), i));
    prepare_start(model, budget, height_m, plant_seed, values);
    if (grows_as_tall(model, budget, plant_seed, height_m, values))
      points.push_back({fmt::format("random {}", points.size() + 1), std::move(values)});
  }
  return points;
}

}  // namespace espalier
