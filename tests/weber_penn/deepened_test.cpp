// The same tree with more levels of branching.
#include <gtest/gtest.h>

#include <espalier/models/preset.h>
#include <espalier/weber_penn/deepen.h>
#include <espalier/weber_penn/estimate.h>
#include <espalier/weber_penn/model.h>

namespace espalier {
namespace {

TEST(Deepened, ExpectsAsManyLeavesAsBefore) {
  for (const char* name : {"palm", "fan_palm", "small_pine", "bamboo", "acer", "quaking_aspen"}) {
    const ParameterValues plant = load_preset(name).values, deeper = deepened_values(plant, 4);
    const auto& model = weber_penn_model();
    EXPECT_NEAR(model.estimate(deeper).leaves / model.estimate(plant).leaves, 1, 0.02) << name;
  }
}

TEST(Deepened, IsValidAndLeavesDeepTreesAlone) {
  for (const std::string& name : bundled_presets()) {
    const ParameterValues plant = load_preset(name).values;
    EXPECT_EQ(deepened_values(plant, 1), plant);
    const ParameterValues deeper = deepened_values(plant, 4);
    for (std::size_t row = 0; row < deeper.size(); ++row)
      check_value(weber_penn_model().table().rows[row], deeper[row], name);
  }
}

}  // namespace
}  // namespace espalier
