// Tables of the prior's plants: the same in parts, with any number of threads, from a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>
#include <espalier/models/models.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

const PlantPrior& table_prior() {
  static const PlantPrior made(model_by_name("weber_penn"));
  return made;
}

bool always(std::size_t, std::size_t) { return true; }

ReferenceTable table_of(std::size_t size, int threads, Seed seed = 1) {
  ReferenceTable table{.seed = seed};
  extend_table(table_prior(), size, threads, always, table);
  return table;
}

bool same(const ReferenceTable& a, const ReferenceTable& b) {
  return a.unknowns == b.unknowns && a.summaries == b.summaries && a.species == b.species &&
         a.attempt == b.attempt;
}

TEST(ReferenceTable, IsTheSameInPartsAndWithAnyNumberOfThreads) {
  const ReferenceTable whole = table_of(40, 2);
  ReferenceTable parts = table_of(13, 1);
  extend_table(table_prior(), 40, 3, always, parts);
  EXPECT_TRUE(same(whole, parts));
  EXPECT_FALSE(same(whole, table_of(40, 2, 2)));
}

TEST(ReferenceTable, RowsAreOfTheirDraws) {
  const ReferenceTable table = table_of(5, 1);
  PlantSimulator simulator(table_prior(), table.height_m);
  for (std::size_t row = 0; row < 5; ++row) {
    Simulation simulation;
    const PlantDraw draw = draw_of_row(table_prior(), table.seed, row, table.attempt[row]);
    ASSERT_TRUE(simulator.simulate(draw, simulation));
    EXPECT_EQ(table.species[row], draw.species);
    for (std::size_t i = 0; i < simulation.unknowns.size(); ++i)
      EXPECT_EQ(table.unknowns(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)),
                simulation.unknowns[i]);
    for (std::size_t i = 0; i < simulation.summaries.size(); ++i)
      EXPECT_EQ(table.summaries(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)),
                simulation.summaries[i]);
  }
}

TEST(ReferenceTable, StopsWhereItIsToldAndKeepsWhatItHas) {
  ReferenceTable table;
  extend_table(
      table_prior(), 600, 0, [](std::size_t done, std::size_t) { return done < 256; }, table);
  EXPECT_EQ(table.size(), 256u);
}

class TableFile : public testing::Test {
 protected:
  std::filesystem::path path = fresh_folder("reference_table") / "table.bin";
  ReferenceTable table = table_of(7, 1);
};

TEST_F(TableFile, GivesBackWhatItWasWrittenFrom) {
  EXPECT_EQ(read_table(path, table_prior(), 1, 10).size(), 0u);
  write_table(path, table_prior(), table);
  EXPECT_TRUE(same(read_table(path, table_prior(), 1, 10), table));
}

TEST_F(TableFile, IsRefusedWhereItIsOfAnotherSeedOrHeightOrDamaged) {
  const auto complaint = [&](Seed seed, double height_m) -> std::string {
    try {
      read_table(path, table_prior(), seed, height_m);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  write_table(path, table_prior(), table);
  EXPECT_THAT(complaint(2, 10), testing::HasSubstr("got 'seed 1', expected 'seed 2'"));
  EXPECT_THAT(complaint(1, 12), testing::HasSubstr("got 'height_m 10', expected 'height_m 12'"));
  const std::string bytes = read_file(path);
  write_file_atomically(path, bytes.substr(0, bytes.size() - 9));
  EXPECT_THAT(complaint(1, 10), testing::HasSubstr("damaged"));
  write_file_atomically(path, bytes.substr(0, bytes.size() - 4) + "\xff\xff\xff\xff");
  EXPECT_THAT(complaint(1, 10), testing::HasSubstr("damaged"));
  std::string wrong_species = bytes;
  for (std::size_t i = bytes.size() - 7 * 8; i < bytes.size() - 7 * 4; ++i) wrong_species[i] = '\x7f';
  write_file_atomically(path, wrong_species);
  EXPECT_THAT(complaint(1, 10), testing::HasSubstr("damaged"));
  write_file_atomically(path, "a picture");
  EXPECT_THAT(complaint(1, 10), testing::HasSubstr("got 'a picture'"));
  write_file_atomically(path, "");
  EXPECT_THAT(complaint(1, 10), testing::HasSubstr("got ''"));
}

TEST(PlantSimulator, QuantitiesFollowTheHeightAndNothingElseDoes) {
  const PlantDraw draw = draw_of_row(table_prior(), 1, 3, 0);
  Simulation small, large;
  ASSERT_TRUE(PlantSimulator(table_prior(), 5).simulate(draw, small));
  ASSERT_TRUE(PlantSimulator(table_prior(), 20).simulate(draw, large));
  EXPECT_EQ(small.summaries, large.summaries);
  const std::vector<Unknown> unknowns = unknowns_of(table_prior());
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (!unknowns[i].is_quantity) {
      EXPECT_EQ(small.unknowns[i], large.unknowns[i]);
    }
    if (unknowns[i].name == "leaf_area") {
      EXPECT_NEAR(large.unknowns[i], 16 * small.unknowns[i], 1e-6 * large.unknowns[i]);
    }
  }
}

}  // namespace
}  // namespace espalier
