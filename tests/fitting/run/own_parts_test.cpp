// Fits with a model or an optimiser of the caller's: what no table holds is fitted, kept and gone on with
// like what is known by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/fitting/optimizers/search_method.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/image/pictures/picture.h>

#include "support/fakes.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A pole to be fitted, at 32×32 pixels.
FitRecord pole_record(const fs::path& folder, long evaluations) {
  Mask mask(64, 64);
  for (int y = 4; y < 60; ++y)
    for (int x = 28; x < 36; ++x) mask.set(x, y);
  write_mask_png(folder / "pole.png", mask);
  FitRecord record;
  record.views = {{folder / "pole.png", {}}};
  record.target.size_px = 32;
  record.budget = {.evaluations = evaluations, .seconds = 0};
  return record;
}

/// Random points, one at a time.
class Wanderer : public SearchMethod {
 public:
  std::string name() const override { return "wanderer"; }
  std::string help() const override { return "random points"; }

 private:
  void search(Search& run) const override {
    for (RandomStream draws(run.key);;)
      run.evaluator.evaluate(random_point(run.evaluator.dimension(), draws));
  }
};

std::string error_of(const FitRecord& record, const fs::path& directory, const FitExecution& options) {
  try {
    fit(record, directory, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(OwnModel, ItsPresetsHoldTheRowsOfItsTable) {
  const fs::path folder = fresh_folder("own_model");
  const PoleModel pole;
  FitExecution options;
  options.model = &pole;
  const FitResult result = fit(pole_record(folder, 200), folder / "run", options);
  EXPECT_GT(result.metrics["iou"], 0.9);
  const std::string best = read_text_file(folder / "run/best.toml");
  EXPECT_THAT(best, HasSubstr("model = \"pole\"\n"));
  for (const ParameterInfo& row : pole.table().rows) EXPECT_THAT(best, HasSubstr("\n" + row.name + " = "));
  EXPECT_THAT(read_text_file(folder / "run/archive/1.toml"), HasSubstr("model = \"pole\"\n"));
  EXPECT_THAT(read_text_file(folder / "run/run.toml"), HasSubstr("model = \"pole\"\n"));
}

TEST(OwnOptimizer, OneOfTheTableFitsAsItDoesByName) {
  const fs::path folder = fresh_folder("table_optimizer");
  const PoleModel pole;
  FitExecution options;
  options.model = &pole;
  FitRecord by_name = pole_record(folder, 60);
  by_name.optimizer = "random_search";
  fit(by_name, folder / "by_name", options);
  options.optimizer = &optimizer_by_name("random_search");
  fit(pole_record(folder, 60), folder / "own", options);
  for (const char* file : {"run.toml", "best.toml"})
    EXPECT_EQ(read_text_file(folder / "own" / file), read_text_file(folder / "by_name" / file)) << file;
}

TEST(OwnOptimizer, ARunOfItIsGoneOnWithAsIfUnbroken) {
  const fs::path folder = fresh_folder("own_optimizer");
  const PoleModel pole;
  const Wanderer wanderer;
  FitExecution options;
  options.model = &pole;
  options.optimizer = &wanderer;
  fit(pole_record(folder, 60), folder / "whole", options);
  fit(pole_record(folder, 20), folder / "broken", options);
  options.resume = true;
  fit(pole_record(folder, 60), folder / "broken", options);
  for (const char* file : {"run.toml", "best.toml"})
    EXPECT_EQ(read_text_file(folder / "broken" / file), read_text_file(folder / "whole" / file)) << file;
  EXPECT_THAT(read_text_file(folder / "whole/run.toml"), HasSubstr("optimizer = \"wanderer\"\n"));
}

TEST(OwnOptimizer, WhoDoesNotHaveItIsToldItsName) {
  const fs::path folder = fresh_folder("wanderer");
  const PoleModel pole;
  const Wanderer wanderer;
  FitExecution options;
  options.model = &pole;
  options.optimizer = &wanderer;
  fit(pole_record(folder, 20), folder / "run", options);
  try {
    read_record(folder / "run/run.toml");
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("wanderer"));
  }
}

TEST(OwnOptimizer, ItsSettingsAreCheckedBeforeAnythingIsWritten) {
  const fs::path folder = fresh_folder("own_settings");
  const PoleModel pole;
  const Wanderer wanderer;
  FitExecution options;
  options.model = &pole;
  options.optimizer = &wanderer;
  FitRecord record = pole_record(folder, 20);
  record.optimizer_settings = {{"stride", 1}};
  EXPECT_THAT(error_of(record, folder / "run", options), HasSubstr("wanderer: got setting stride"));
  EXPECT_FALSE(fs::exists(folder / "run"));
}

}  // namespace
}  // namespace espalier
