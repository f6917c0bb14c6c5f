// Our trees against the published implementation's: reference_counts.csv holds what was counted and measured
// on five of each species that it grew. The mean over 20 of our seeds lies within 10 % of theirs, or within 3
// standard errors of the difference; what does not is listed in counts_differences.csv with the reason, and
// nothing is listed in vain.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

constexpr int kColumns = 12, kSeeds = 20;
using Counts = std::array<double, kColumns>;
const std::array<std::string, kColumns> kNames = {"stems_level0",    "stems_level1",    "stems_level2",
                                                  "stems_level3",    "curve_points",    "leaves",
                                                  "height_m",        "crown_radius_m",  "length_level0_m",
                                                  "length_level1_m", "length_level2_m", "length_level3_m"};

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
  return out;
}

float segment_length_m(const Knots& knots, std::size_t end) {
  const Vec3 a = knots.point_m[end - 1], b = knots.handle_out_m[end - 1], c = knots.handle_in_m[end],
             d = knots.point_m[end];
  float sum_m = 0;
  Vec3 last = a;
  for (int piece = 1; piece <= 8; ++piece) {
    const float t = piece / 8.f, u = 1 - t;
    const Vec3 next = a * (u * u * u) + b * (3 * u * u * t) + c * (3 * u * t * t) + d * (t * t * t);
    sum_m += length(next - last);
    last = next;
  }
  return sum_m;
}

Counts count(const Plant& plant) {
  Counts counts{};
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    const int level = std::min<int>(3, plant.stems.level[stem]);
    ++counts[level];
    for (auto knot = plant.stems.first_knot[stem] + 1; knot < plant.stems.first_knot[stem + 1]; ++knot)
      counts[8 + level] += segment_length_m(plant.knots, knot);
  }
  counts[4] = plant.knots.size();
  counts[5] = plant.leaves.size();
  for (const Vec3 point : plant.knots.point_m) {
    counts[6] = std::max<double>(counts[6], point.z);
    counts[7] = std::max<double>(counts[7], std::hypot(point.x, point.y));
  }
  return counts;
}

std::ifstream table_of(const char* name) {
  return std::ifstream(std::filesystem::path(ESPALIER_SOURCE_DIR) / "tests/weber_penn" / name);
}

std::map<std::string, std::vector<Counts>> read_reference() {
  std::map<std::string, std::vector<Counts>> trees;
  std::ifstream file = table_of("reference_counts.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const auto row = cells(line);
    Counts counts{};
    for (std::size_t column = 0; column + 2 < row.size(); ++column)
      if (!row[column + 2].empty()) counts[column] = std::stod(row[column + 2]);
    trees[row[0]].push_back(counts);
  }
  return trees;
}

using Changes = std::map<std::string, double>;  ///< values to set in a preset

std::vector<Counts> our_trees(const std::string& species, const Changes& changes) {
  Preset preset = load_preset(species);
  for (const auto& [name, value] : changes)
    preset.values[*model_by_name(preset.model).table().find(name)] = value;
  std::vector<Counts> trees;
  Plant plant;
  for (Seed seed = 1; seed <= kSeeds; ++seed) {
    EXPECT_TRUE(model_by_name(preset.model).generate(preset.values, seed, {}, plant).grown);
    trees.push_back(count(plant));
  }
  return trees;
}

struct Moments {
  double mean = 0, squared_error = 0;  ///< of the mean
};

Moments moments(const std::vector<Counts>& trees, int column) {
  Moments m;
  for (const Counts& tree : trees) m.mean += tree[column] / trees.size();
  for (const Counts& tree : trees)
    m.squared_error += std::pow(tree[column] - m.mean, 2) / (trees.size() - 1) / trees.size();
  return m;
}

/// "species,column" with its difference in percent, where it is beyond both tolerances.
std::map<std::string, double> differences(const std::map<std::string, std::vector<Counts>>& reference,
                                          const Changes& changes = {}) {
  std::map<std::string, double> beyond;
  for (const auto& [species, theirs] : reference) {
    const std::vector<Counts> ours = our_trees(species, changes);
    for (int column = 0; column < kColumns; ++column) {
      const Moments a = moments(ours, column), b = moments(theirs, column);
      const double error = std::sqrt(a.squared_error + b.squared_error);
      const bool near = std::fabs(a.mean - b.mean) <= 0.1 * b.mean || std::fabs(a.mean - b.mean) <= 3 * error;
      if (!near) beyond[species + "," + kNames[column]] = 100 * (a.mean / b.mean - 1);
    }
  }
  return beyond;
}

TEST(Counts, AgreeWithThePublishedTreesOrAreListedWithTheReason) {
  std::map<std::string, double> listed;
  std::ifstream table = table_of("counts_differences.csv");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    const auto row = cells(line);
    ASSERT_GE(row.size(), 4u) << line;
    listed[row[0] + "," + row[1]] = std::stod(row[2]);
  }
  const auto reference = read_reference();
  ASSERT_GE(reference.size(), 15u);
  const auto found = differences(reference);
  for (const auto& [name, percent] : found) {
    EXPECT_TRUE(listed.contains(name)) << name << "," << percent << ": not listed";
    if (listed.contains(name)) {
      EXPECT_NEAR(listed[name], percent, 3) << name << "," << percent << ": listed with another difference";
    }
  }
  for (const auto& [name, percent] : listed) EXPECT_TRUE(found.contains(name)) << name << ": listed in vain";
}

/// The reason that counts_differences.csv gives for acer and hill_cherry, whose base_splits are negative.
TEST(Counts, OfPublishedTreesAreThoseWithoutNegativeBaseSplits) {
  auto trees = read_reference();
  std::erase_if(trees,
                [](const auto& entry) { return entry.first != "acer" && entry.first != "hill_cherry"; });
  ASSERT_EQ(trees.size(), 2u);
  for (const auto& [name, percent] : differences(trees, {{"base_splits", 0}}))
    EXPECT_LT(std::fabs(percent), 15) << name;
}

}  // namespace
}  // namespace espalier
