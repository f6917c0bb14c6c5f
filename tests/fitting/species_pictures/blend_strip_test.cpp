// Strips are even, and pictures of them show what they should. All pairs: experiments/blend_evenness.cpp.
#include <gtest/gtest.h>

#include <espalier/fitting/species_pictures/blend_strip.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

const Model& model() { return model_by_name("weber_penn"); }

std::vector<ParameterValues> strip(const std::string& encoding, const std::string& a, const std::string& b,
                                   int steps) {
  return blend_strip(model(), *make_encoding(encoding, model().table()), load_preset(a).values,
                     load_preset(b).values, steps);
}

TEST(BlendStrip, GoesFromEndToEnd) {
  const std::vector<ParameterValues> trees = strip("monotone", "palm", "acer", 4);
  ASSERT_EQ(trees.size(), 5u);
  EXPECT_EQ(trees.front(), load_preset("palm").values);
  EXPECT_EQ(trees.back(), load_preset("acer").values);
}

TEST(BlendStrip, OfAPlantWithItselfDoesNotChange) {
  for (const double change : silhouette_changes(model(), strip("monotone", "acer", "acer", 3)))
    EXPECT_EQ(change, 0);
}

TEST(BlendStrip, NoStepChangesMoreThanFourTimesTheMedian) {
  for (const auto& [a, b] : {std::pair{"quaking_aspen", "silver_birch"},
                             {"palm", "acer"},
                             {"hill_cherry", "palm"},
                             {"small_pine", "lombardy_poplar"},
                             {"bamboo", "sphere_tree"}}) {
    const StripEvenness evenness = strip_evenness(silhouette_changes(model(), strip("monotone", a, b, 10)));
    EXPECT_LT(evenness.ratio(), 4) << a << " " << b;
    EXPECT_GT(evenness.median, 0.005) << "trees change";
  }
}

TEST(BlendStrip, APlantWrittenDeeperHasNearlyItsSilhouette) {
  for (const char* name : {"palm", "fan_palm", "small_pine", "quaking_aspen"}) {
    const ParameterValues plant = load_preset(name).values;
    const int levels = static_cast<int>(plant[model().table().index_of("levels")]) + 1;
    const ParameterValues deeper = model().deepened(plant, levels);
    const double deepened = silhouette_changes(model(), {plant, deeper})[0];
    const double other = silhouette_changes(model(), {plant, load_preset("sphere_tree").values})[0];
    EXPECT_LT(deepened, 0.5 * other) << name;
    EXPECT_EQ(deeper[model().table().index_of("levels")], levels);
  }
}

TEST(StripEvenness, ComparesTheLargestStepWithTheMedian) {
  const StripEvenness evenness = strip_evenness({1, 2, 9, 3});
  EXPECT_EQ(evenness.median, 2.5);
  EXPECT_EQ(evenness.largest, 9);
  EXPECT_EQ(evenness.largest_step, 2);
  EXPECT_EQ(evenness.ratio(), 3.6);
  EXPECT_EQ(strip_evenness({0, 0}).ratio(), 1);
}

}  // namespace
}  // namespace espalier
