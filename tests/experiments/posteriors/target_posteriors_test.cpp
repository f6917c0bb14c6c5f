// Posteriors of targets: a table with the truth where it is known, the same when it is stopped and gone on
// with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <espalier/core/files.h>
#include <espalier/experiments/posteriors/target_posteriors.h>
#include <espalier/models/models.h>

#include "support/posterior_table.h"
#include "support/small_training.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<PosteriorTarget> two_targets() {
  const fs::path targets = fs::path(ESPALIER_SOURCE_DIR) / "targets";
  return {{.name = "a fir", .directory = "a-fir", .picture = targets / "fir.png", .truth = {}},
          {.name = "as if an aspen",
           .directory = "aspen",
           .picture = targets / "reference_quaking_aspen.png",
           .truth = TrueTree{"quaking_aspen", 3}}};
}

TargetPosteriorOptions small_options(std::size_t stop_at = 1'000'000) {
  return {
      .reading = {.one_tree = true},
      .simulations = kLeastTableSize,
      .version = "test",
      .training = small_training(),
      .on_progress = [stop_at](const std::string&, std::size_t done, std::size_t) { return done < stop_at; }};
}

TEST(TargetPosteriors, LeaveATableWithTheTruthWhereItIsKnown) {
  const fs::path folder = fresh_folder("target_posteriors");
  fs::create_directories(folder / "posteriors");
  take_kept_table(PlantPrior(model_by_name("weber_penn")), kLeastTableSize - 300,
                  folder / "posteriors/plants_10.bin");
  write_target_posteriors(folder, two_targets(), small_options(1000));
  EXPECT_FALSE(fs::exists(folder / "posteriors.csv")) << "it was stopped";
  EXPECT_TRUE(fs::exists(folder / "posteriors/plants_10.bin"));
  write_target_posteriors(folder, two_targets(), small_options());
  const std::string csv = read_file(folder / "posteriors.csv");
  EXPECT_THAT(csv, testing::ContainsRegex("\"a fir\",crown_volume,m3,[^\n]*,,\n"));
  EXPECT_THAT(csv, testing::ContainsRegex("\"as if an aspen\",ratio,1,[^\n]*,0.01[0-9]*,[01]\n"));
  EXPECT_THAT(csv, testing::ContainsRegex("\"as if an aspen\",stems,1,[^\n]*,[0-9.e+]+,[01]\n"));
  for (const char* target : {"a-fir", "aspen"})
    EXPECT_TRUE(fs::exists(folder / "posteriors" / target / "pairs.svg")) << target;
}

}  // namespace
}  // namespace espalier
