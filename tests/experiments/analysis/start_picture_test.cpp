// The drawn start of a fit is the one that the fit had, however it came to it.
#include <gtest/gtest.h>

#include <espalier/experiments/analysis/start_picture.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/image/pictures/picture.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

FitRecord record_of(const std::string& target) {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets" / (target + ".png"), {}}};
  record.target.size_px = 32;
  record.growth = {300, 1'000};
  record.kind = KindChoice::automatic;
  record.budget = {.evaluations = 60, .seconds = 0};
  return record;
}

/// A fit that stops at its starts ends with the best of them.
void expect_the_start_of_a_fit(const std::string& name, FitRecord record) {
  record.stages = parse_stages("starts");
  const fs::path folder = fresh_folder("start_" + name), run = folder / "run";
  fit(record, run);
  write_mask_png(folder / "drawn.png", draw_best_start(run));
  EXPECT_EQ(read_text_file(folder / "drawn.png"), read_text_file(run / "best.png")) << name;
}

TEST(StartPicture, IsThatOfTheFit) {
  expect_the_start_of_a_fit("leafy", record_of("tr_birch"));
  expect_the_start_of_a_fit("palm", record_of("oc_palm"));
  expect_the_start_of_a_fit("leafless", record_of("tr_blandbirch"));
  FitRecord random = record_of("tr_birch");
  random.start = "random:3";
  expect_the_start_of_a_fit("random", random);
}

TEST(StartPicture, OfASearchOfTheSpeciesSpaceIsAPreset) {
  FitRecord record = record_of("oc_palm");
  record.kind = KindChoice::any;
  record.space = "species:2";
  record.space_evaluations = 30;
  record.budget = {.evaluations = 120, .seconds = 0};
  const fs::path run = fresh_folder("start_space") / "run";
  fit(record, run);
  EXPECT_NO_THROW(draw_best_start(run));
}

}  // namespace
}  // namespace espalier
