// Blends: ends and equal plants come back bit for bit; what lies between means something between.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/blend.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

const Model& model() { return model_by_name("weber_penn"); }

std::vector<ParameterValues> all_values() {
  std::vector<ParameterValues> all;
  for (const std::string& name : bundled_presets()) all.push_back(load_preset(name).values);
  return all;
}

double value(const ParameterValues& values, const std::string& name) {
  return values[model().table().index_of(name)];
}

ParameterValues monotone_blend(const std::string& a, const std::string& b, double t) {
  return blend(model(), *make_encoding("monotone", model().table()), load_preset(a).values,
               load_preset(b).values, t);
}

TEST(Blend, OfAPlantWithItselfIsThatPlant) {
  for (const char* name : {"raw", "monotone"}) {
    const auto encoding = make_encoding(name, model().table());
    for (const ParameterValues& plant : all_values())
      for (const double t : {0.0, 0.1, 1.0 / 3, 0.5, 0.77, 1.0})
        EXPECT_EQ(blend(model(), *encoding, plant, plant, t), plant) << name << " " << t;
  }
}

TEST(Blend, EndsAreThePlantsThemselves) {
  const std::vector<ParameterValues> all = all_values();
  for (const char* name : {"raw", "monotone"}) {
    const auto encoding = make_encoding(name, model().table());
    for (const ParameterValues& a : all)
      for (const ParameterValues& b : all) {
        EXPECT_EQ(blend(model(), *encoding, a, b, 0), a);
        EXPECT_EQ(blend(model(), *encoding, a, b, 1), b);
      }
  }
}

RC_GTEST_PROP(Blend, IsValidEverywhere, ()) {
  const std::vector<std::string> names = bundled_presets();
  const auto preset = [&] {
    return load_preset(names[*rc::gen::inRange<std::size_t>(0, names.size())]).values;
  };
  const ParameterValues a = preset(), b = preset();
  const double t = *rc::gen::inRange(0, 1001) * 1e-3;
  for (const char* name : {"raw", "monotone"}) {
    const ParameterValues between = blend(model(), *make_encoding(name, model().table()), a, b, t);
    for (std::size_t row = 0; row < between.size(); ++row)
      check_value(model().table().rows[row], between[row], name);
  }
}

TEST(Blend, LogarithmsMeetAtTheGeometricMean) {
  EXPECT_NEAR(value(monotone_blend("acer", "douglas_fir", 0.5), "g_scale"), std::sqrt(10.0 * 40.0), 1e-9);
}

TEST(Blend, AMeasureOfOnePlantAloneIsTakenFromIt) {
  EXPECT_EQ(value(monotone_blend("quaking_aspen", "acer", 0.3), "split_angle[0]"), 50);
  EXPECT_EQ(value(monotone_blend("quaking_aspen", "hill_cherry", 0.3), "prune_width"), 0.7);
}

TEST(Blend, ARotationNeverPassesThroughZero) {
  for (int step = 0; step <= 20; ++step) {
    const double rotate = value(monotone_blend("weeping_willow", "quaking_aspen", step / 20.0), "rotate[1]");
    EXPECT_TRUE(rotate == -120 || rotate == 140) << rotate;
  }
}

TEST(Blend, AnEffectIsGoneWhereTheOtherTakesOver) {
  EXPECT_NEAR(value(monotone_blend("quaking_aspen", "acer", 0.25), "down_angle_v[1]"), -25, 1e-9);
  EXPECT_EQ(value(monotone_blend("quaking_aspen", "acer", 0.5), "down_angle_v[1]"), 0);
  EXPECT_NEAR(value(monotone_blend("quaking_aspen", "acer", 0.75), "down_angle_v[1]"), 2.5, 1e-9);
}

TEST(Blend, ARoundTrunkNarrowsWithoutAnOpenEnd) {
  double before = 0.9;
  for (int step = 0; step <= 10; ++step) {
    const double taper = value(monotone_blend("acer", "palm", step / 10.0), "taper[0]");
    EXPECT_GT(taper, before) << "from a cone, over a round end, to swellings";
    before = taper;
  }
  EXPECT_EQ(before, 2.15);
}

TEST(Blend, CrownsMixTheirShapesEvenly) {
  const ParameterValues third = monotone_blend("acer", "small_pine", 0.25);
  EXPECT_EQ(value(third, "shape"), 4) << "tapered cylindrical";
  EXPECT_EQ(value(third, "shape_2"), 0) << "conical";
  EXPECT_NEAR(value(third, "shape_mix"), 0.25, 1e-12);
}

TEST(Blend, ADeeperTreeGrowsOutOfStalks) {
  const ParameterValues near_palm = monotone_blend("palm", "acer", 0.01);
  EXPECT_EQ(value(near_palm, "levels"), 3);
  EXPECT_LT(value(near_palm, "length[2]"), 0.01);
}

TEST(Blend, RefusesAShareOutsideZeroToOne) {
  for (const double t : {-0.1, 1.1, double(NAN)}) EXPECT_THROW(monotone_blend("palm", "acer", t), InputError);
}

TEST(Blend, CurvesBlendNumberByNumber) {
  const std::size_t first = model().table().index_of("length_along[1].1");
  ParameterValues a = load_preset("quaking_aspen").values, b = a;
  for (std::size_t i = 0; i < kCurveRows; ++i)
    a[first + i] = 1 + 0.5 * static_cast<double>(i), b[first + i] = 2;
  for (const char* name : {"raw", "monotone"}) {
    const ParameterValues between = blend(model(), *make_encoding(name, model().table()), a, b, 0.25);
    for (std::size_t i = 0; i < kCurveRows; ++i)
      EXPECT_NEAR(between[first + i], 0.75 * a[first + i] + 0.25 * b[first + i], 1e-12) << name << i;
  }
}

/// A tree of fewer levels gets those of the other first; its leaves' curves go to the stalks.
TEST(Blend, CurvesOfLeavesSpreadTheStalksOfADeeperTree) {
  ParameterValues values = load_preset("quaking_aspen").values;
  const ParameterTable& table = model().table();
  const std::size_t leaves = table.find_curve("leaf_density_along")->first_row,
                    sizes = table.find_curve("leaf_scale_along")->first_row,
                    stalks = table.find_curve("density_along[3]")->first_row;
  for (std::size_t i = 0; i < kCurveRows; ++i)
    values[leaves + i] = static_cast<double>(i), values[sizes + i] = 2;
  const ParameterValues deeper = model().deepened(values, 4);
  for (std::size_t i = 0; i < kCurveRows; ++i) {
    EXPECT_EQ(deeper[stalks + i], static_cast<double>(i));
    EXPECT_EQ(deeper[leaves + i], 1);
    EXPECT_EQ(deeper[sizes + i], 1);
  }
  EXPECT_DOUBLE_EQ(value(deeper, "leaf_scale"), 2 * value(values, "leaf_scale"));
}

}  // namespace
}  // namespace espalier
