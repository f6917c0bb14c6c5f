// `espalier blend`: presets between two others or at a point, strips of them, and bad input.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <espalier/fitting/record/fit_record.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string path_in(const std::string& name) {
  static const fs::path kFolder = fresh_folder("blend_command");
  return (kFolder / name).string();
}

TEST(BlendCommand, WritesAPresetBetweenTwo) {
  const ProgramRun run = run_espalier("blend quaking_aspen silver_birch --t 0.5 -o " + path_in("mix.toml"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Preset mix = load_preset(path_in("mix.toml"));
  EXPECT_EQ(mix.name, "quaking_aspen_silver_birch_0.5");
  EXPECT_NE(mix.values, load_preset("quaking_aspen").values);
}

TEST(BlendCommand, EndsAreThePresetsThemselves) {
  for (const char* encoding : {"raw", "monotone"})
    for (const auto& [t, end] : {std::pair{"0", "palm"}, {"1", "weeping_willow"}}) {
      const std::string command = fmt::format("blend palm weeping_willow --t {} --encoding {} -o {}", t,
                                              encoding, path_in("end.toml"));
      ASSERT_EQ(run_espalier(command).exit_code, 0);
      EXPECT_EQ(load_preset(path_in("end.toml")).values, load_preset(end).values);
    }
}

TEST(BlendCommand, SaysWhereAPointLiesAndWhatWasClamped) {
  const ProgramRun inside = run_espalier("blend --at 0,0 -o " + path_in("inside.toml"));
  ASSERT_EQ(inside.exit_code, 0) << inside.err;
  EXPECT_THAT(inside.out, HasSubstr("inside the convex hull"));
  const ProgramRun outside = run_espalier("blend --at -30,40 -o " + path_in("outside.toml"));
  ASSERT_EQ(outside.exit_code, 0) << outside.err;
  EXPECT_THAT(outside.out, HasSubstr("outside the convex hull"));
  EXPECT_THAT(outside.out, HasSubstr("\nclamped: "));
  EXPECT_EQ(run_espalier("species --check " + path_in("outside.toml")).exit_code, 0);
}

TEST(BlendCommand, APointKeepsToTheBudgetOfAFitAndSaysHowLargeItWouldHaveBeen) {
  const ProgramRun run = run_espalier("blend --at 0.8,-1.2 -o " + path_in("thinned.toml"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\nthinned to the growth budget of a fit, 6000 stems and 60000 leaves: it "
                                 "would have had "));
  const Preset preset = load_preset(path_in("thinned.toml"));
  const GrowthBudget of_a_fit = FitRecord{}.growth;
  Plant plant;
  EXPECT_TRUE(model_by_name(preset.model).generate(preset.values, 1, {of_a_fit}, plant).grown);
  EXPECT_GT(plant.leaves.size(), 6'000u);  // no more than it must
}

TEST(BlendCommand, APointMayHaveAnyNumberOfCoordinates) {
  EXPECT_EQ(run_espalier("blend --at 1 -o " + path_in("line.toml")).exit_code, 0);
  EXPECT_EQ(run_espalier("blend --at=-.5,2,0.5,1e-1,0 -o " + path_in("five.toml")).exit_code, 0);
}

TEST(BlendCommand, DrawsAStripAndBothEncodings) {
  const ProgramRun run = run_espalier("blend palm acer --tile 32 --strip 4 " + path_in("strip.png") +
                                      " --compare " + path_in("both.png"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const DecodedPicture strip = decode_picture(path_in("strip.png")),
                       both = decode_picture(path_in("both.png"));
  EXPECT_EQ(strip.width_px, 4 * 32 + 3 * 4);
  EXPECT_EQ(strip.height_px, 32 + 24);
  EXPECT_EQ(both.width_px, 5 * 32 + 4 * 4);
  EXPECT_EQ(both.height_px, 2 * (32 + 24));
}

TEST(BlendCommand, BadInputIsOneLineAndWritesNothing) {
  const std::string to = " -o " + path_in("x.toml");
  const std::pair<std::string, std::string> cases[] = {
      {"--at 0.8,north" + to, "--at: got '0.8,north', expected finite numbers"},
      {"--at nan,0" + to, "expected finite numbers"},
      {"--at 1,inf" + to, "expected finite numbers"},
      {"--at 1," + to, "expected finite numbers"},
      {"--at 1e999,0" + to, "expected finite numbers"},
      {"--at 1,2", "expected a TOML file"},
      {"palm acer --at 1,2" + to, "--at: got presets"},
      {"--at 0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0" + to, "--components: got 19, expected 1 … 17"},
      {"palm acer --t 2" + to, "--t: got 2, expected a number 0 … 1"},
      {"palm acer --t half" + to, "--t: got 'half'"},
      {"palm acer" + to, "expected --t"},
      {"palm --t 0.5" + to, "expected two presets"},
      {"palm oka --t 0.5" + to, "got preset 'oka'"},
      {"palm acer --t 0.5", "expected a TOML file"},
      {"palm acer --t 0.5 --encoding log" + to, "expected raw or monotone"},
      {"palm acer --t 0.5 -o /nowhere/x.toml", "/nowhere"},
      {"palm acer --strip one " + path_in("x.png"), "--strip: got 'one'"},
      {"palm acer --strip 5 " + path_in("x.jpg"), ".png"},
      {"palm acer --compare " + path_in("x.svg"), ".png"}};
  for (const auto& [arguments, message] : cases) {
    const ProgramRun run = run_espalier("blend " + arguments);
    SCOPED_TRACE(arguments);
    expect_one_clear_error(run);
    EXPECT_THAT(run.err, HasSubstr(message));
  }
  EXPECT_FALSE(fs::exists(path_in("x.toml")));
  EXPECT_FALSE(fs::exists(path_in("x.png")));
}

}  // namespace
}  // namespace espalier
