// What every model whose branches have paths keeps to, however it follows overrides.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {
namespace {

struct Curve {
  std::vector<Vec3> points;
  std::vector<float> radii;
  bool operator==(const Curve&) const = default;
};
using Branches = std::map<BranchPath, Curve>;

bool starts_with(const BranchPath& path, const BranchPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

float length_of(const Curve& curve) {
  float sum = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) sum += length(curve.points[i] - curve.points[i - 1]);
  return sum;
}

/// A preset of a parametric tree, or an L-system.
class BranchPaths : public testing::TestWithParam<const char*> {
 protected:
  Plant grow(const Overrides& overrides, const PlantPart* part = nullptr) const {
    const ChangeGraph changes(overrides);
    GrowthSettings settings;
    settings.changes = &changes;
    settings.only_part = part;
    Plant plant;
    EXPECT_TRUE(model_.generate(preset_.values, 3, settings, plant).grown);
    return plant;
  }

  Branches branches(const Overrides& overrides, const PlantPart* part = nullptr) const {
    const Plant plant = grow(overrides, part);
    Branches found;
    for (std::size_t s = 0; s < plant.stems.size(); ++s) {
      Curve& curve = found[path_of(plant, s)];
      for (std::size_t k = plant.stems.first_knot[s]; k < plant.stems.first_knot[s + 1]; ++k) {
        curve.points.push_back(plant.knots.point_m[k]);
        curve.radii.push_back(plant.knots.radius_m[k]);
      }
    }
    return found;
  }

  Branches with(const BranchPath& path, const Override& entry) const {
    Overrides overrides;
    set_override(overrides.at(path).set, entry);
    return branches(overrides);
  }

  /// One in the middle of those of the second level, or of the first where there are no others.
  BranchPath some_path() const {
    std::vector<BranchPath> paths, trunks;
    for (const auto& [path, curve] : branches({})) (path.size() == 2 ? paths : trunks).push_back(path);
    return paths.empty() ? trunks.front() : paths[paths.size() / 2];
  }

  const Preset preset_ = load_preset(GetParam());
  const Model& model_ = model_by_name(preset_.model);
};

constexpr Override kNothing{Quantity::curvature, Relation::offset, 0, true};

/// Each child stands somewhere, and on one side of the middle.
TEST_P(BranchPaths, RangesMeanTheChildrenThatGrewThere) {
  Overrides overrides;
  for (const char* path : {"0/1..2", "0/@0..0.5", "0/@0.5..1", "0/*"})
    set_override(overrides.set_of(parse_branch_pattern(path, "test")), kNothing);
  const ChangeGraph changes(overrides);
  std::vector<ChangeCursor> cursors;
  GrowthSettings settings;
  settings.changes = &changes;
  settings.stem_cursors = &cursors;
  Plant plant;
  ASSERT_TRUE(model_.generate(preset_.values, 3, settings, plant).grown);
  ASSERT_EQ(cursors.size(), plant.stems.size());
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    const BranchPath path = path_of(plant, stem);
    const auto nodes = cursors[stem].nodes();
    const auto is_of = [&](std::uint32_t node) { return std::count(nodes.begin(), nodes.end(), node) == 1; };
    const bool is_child = path.size() == 2 && path[0] == 0 && path[1] < kFirstSplit;
    EXPECT_EQ(is_of(0), is_child && path[1] >= 1 && path[1] <= 2) << to_string(path);
    EXPECT_EQ(is_of(1) + is_of(2), is_child) << to_string(path);
    EXPECT_EQ(is_of(3), is_child) << to_string(path);
  }
}

TEST_P(BranchPaths, NameEachStemOnce) {
  ASSERT_TRUE(model_.has_branch_paths());
  const Plant plant = grow({});
  std::set<BranchPath> paths;
  for (std::size_t s = 0; s < plant.stems.size(); ++s) paths.insert(path_of(plant, s));
  EXPECT_EQ(paths.size(), plant.stems.size());
}

TEST_P(BranchPaths, RemovalTakesTheBranchWithAllOnItAndNothingElse) {
  const BranchPath path = some_path();
  Branches expected = with(path, kNothing);
  std::erase_if(expected, [&](const auto& branch) { return starts_with(branch.first, path); });
  EXPECT_EQ(with(path, {Quantity::removed, Relation::value, 1, true}), expected);
}

TEST_P(BranchPaths, OthersKeepTheirBits) {
  const BranchPath path = some_path();
  const Branches before = with(path, kNothing);
  for (const Override& entry : {Override{Quantity::length, Relation::factor, 1.5, false},
                                {Quantity::down_angle, Relation::offset, 20, false},
                                {Quantity::rotation, Relation::offset, 50, false},
                                {Quantity::curvature_back, Relation::offset, 30, false},
                                {Quantity::radius, Relation::factor, 2, false}}) {
    const Branches after = with(path, entry);
    const bool may_look_the_same = entry.quantity == Quantity::rotation;  // an upright trunk, on the spot
    EXPECT_TRUE(may_look_the_same || after.at(path) != before.at(path)) << quantity_name(entry.quantity);
    for (const auto& [other, curve] : before) {
      if (starts_with(other, path)) continue;
      EXPECT_EQ(after.at(other), curve) << to_string(other);
    }
  }
}

TEST_P(BranchPaths, ALengthFactorIsThatOfTheCurve) {
  const BranchPath path = some_path();
  const Branches before = with(path, kNothing),
                 after = with(path, {Quantity::length, Relation::factor, 0.6, true});
  EXPECT_NEAR(length_of(after.at(path)) / length_of(before.at(path)), 0.6, 0.01);
}

TEST_P(BranchPaths, ADownAngleOffsetTurnsTheBranchByIt) {
  const BranchPath path = some_path();
  const auto heading = [&](const Branches& all) {
    const Curve& curve = all.at(path);
    return normalized(curve.points[1] - curve.points[0]);
  };
  const Vec3 before = heading(with(path, kNothing)),
             after = heading(with(path, {Quantity::down_angle, Relation::offset, 25, true}));
  EXPECT_NEAR(std::acos(dot(before, after)) * 180 / M_PI, 25, 1);
}

TEST_P(BranchPaths, APartGrowsAsItDoesInTheWhole) {
  const BranchPath path = some_path();
  Overrides overrides;
  set_override(overrides.at(path).set, {Quantity::down_angle, Relation::offset, 20, false});
  set_override(overrides.at({path.front()}).set, {Quantity::curvature, Relation::offset, 20, true});
  Branches whole = branches(overrides);
  for (const bool alone : {true, false}) {
    const PlantPart part{path, alone};
    for (const auto& [below, curve] : branches(overrides, &part)) {
      BranchPath full(path.begin(), path.end() - 1);
      full.insert(full.end(), below.begin(), below.end());
      ASSERT_TRUE(whole.contains(full)) << to_string(full);
      const Curve& expected = whole.at(full);
      ASSERT_EQ(curve.points.size(), expected.points.size());
      for (std::size_t i = 0; i < curve.points.size(); ++i)
        EXPECT_LT(length(curve.points[i] - expected.points[i]), 1e-4f) << to_string(full);
      EXPECT_TRUE(starts_with(full, path));
    }
  }
  const PlantPart trunk{{path.front()}, false};
  EXPECT_EQ(branches(overrides, &trunk).size(),
            static_cast<std::size_t>(std::ranges::count_if(
                whole, [&](const auto& branch) { return branch.first.front() == path.front(); })));
}

TEST_P(BranchPaths, APathThatDoesNotGrowChangesNothing) {
  const Branches plain = branches({});
  const Branches after = with({0, 900'000}, {Quantity::removed, Relation::value, 1, true});
  ASSERT_EQ(after.size(), plain.size());
  for (const auto& [path, curve] : plain) EXPECT_TRUE(after.contains(path)) << to_string(path);
}

INSTANTIATE_TEST_SUITE_P(Of, BranchPaths,
                         testing::Values("quaking_aspen", "palm", "acer", "acer.lsys", "small_pine.lsys",
                                         "palm.lsys", "raceme.lsys", "fern.lsys", "flower_field.lsys",
                                         "knot_plant.lsys", "wall_lettuce.lsys", "topiary_6.lsys",
                                         "monopodial.lsys"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace espalier
