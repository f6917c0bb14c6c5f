// Refinement branch by branch: laws of a step, a round, and a whole fit that ends with it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/fitting/branches/branch_offsets.h>
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/branch_rounds.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {
namespace {

/// A quaking aspen of few leaves, drawn with another seed than the task's trees are grown with.
struct SmallTask {
  Preset preset = load_preset("quaking_aspen");
  FitTask task;

  SmallTask() {
    const Model& model = model_by_name("weber_penn");
    set("branches[1]", 15), set("branches[2]", 8), set("leaf_blos_num", 4), set("g_scale_v", 0);
    task.model = &model;
    task.plant_seeds = {1};
    task.objective = parse_objective("0.5*truncated_distance+0.25*iou+0.25*gap_iou");
    Plant plant;
    model.generate(preset.values, 77, {}, plant);
    const Camera camera = frame_base({0, 0, 0}, {}, 16.f / 64, 64, 64, 62);
    Mask mask;
    make_scanline_renderer()->draw(plant, camera, mask);
    task.views = {{camera, PreparedTarget(mask), camera.metres_per_px}};
  }

  void set(const char* name, double value) { preset.values[table().index_of(name)] = value; }
  static const ParameterTable& table() { return model_by_name("weber_penn").table(); }
  Solution start() const {
    Solution solution{.values = preset.values, .plant_seed = 1};
    solution.score = score_of(task, solution);
    return solution;
  }
};

RefinementSettings settings_of(int order, long steps, Seed seed = 1) {
  return {.order = order, .steps = steps, .key = root_key(seed)};
}

TEST(BranchRefinement, FindsABetterTreeAndSaysItsScore) {
  const SmallTask small;
  Solution solution = small.start();
  const double before = solution.score;
  EXPECT_GE(refine_branches(small.task, settings_of(1, 2000), solution), 2000);
  EXPECT_LT(solution.score, before - 0.02);
  EXPECT_EQ(solution.score, score_of(small.task, solution));
  EXPECT_EQ(solution.values, small.preset.values);
}

TEST(BranchRefinement, IsNeverWorseThanBefore) {
  const SmallTask small;
  Solution solution = small.start();
  for (int round = 0; round < 12; ++round) {
    const double before = solution.score;
    refine_branches(small.task, settings_of(round % 3, 100, static_cast<Seed>(round)), solution);
    EXPECT_LE(solution.score, before);
  }
}

TEST(BranchRefinement, OverridesBranchesOfItsOrderOnly) {
  const SmallTask small;
  for (const int order : {0, 1, 2}) {
    Solution solution = small.start();
    refine_branches(small.task, settings_of(order, 400), solution);
    ASSERT_FALSE(solution.overrides.empty()) << order;
    for (const OverrideNode& node : solution.overrides.nodes)
      EXPECT_EQ(node.path.size(), static_cast<std::size_t>(order) + 1);
  }
}

/// The largest share of its range that an offset of the tree's branches has.
double widest_offset(const Overrides& overrides) {
  double widest = 0;
  for (const OverrideNode& node : overrides.nodes) {
    const BranchOffsets branch = read_offsets(node.path, overrides);
    for (std::size_t i = 0; i < branch.at.size(); ++i)
      widest = std::max(widest, branch.at[i] < 0 ? branch.at[i] / kBranchDimensions[i].lowest : branch.at[i]);
  }
  return widest;
}

Solution refined_with(double freedom, long steps = 4000) {
  SmallTask small;
  small.task.freedom = freedom_of(freedom);
  Solution solution = small.start();
  refine_branches(small.task, settings_of(1, steps), solution);
  EXPECT_EQ(solution.score, priced_score_of(small.task, solution));
  return solution;
}

/// What a step is charged for is what the file will hold.
TEST(BranchRefinement, ABranchIsChargedForTheNumbersThatAreWritten) {
  for (const bool moved : {false, true})
    for (const std::uint64_t seed : {0, 9})
      for (const bool removed : {false, true}) {
        BranchOffsets branch{.path = {0, 3}, .seed = seed, .removed = removed};
        if (moved) branch.at[0] = 0.5, branch.at[6] = -2;
        Overrides overrides;
        write_offsets(branch, overrides);
        EXPECT_EQ(count_numbers(branch), count_numbers(overrides)) << moved << seed << removed;
      }
}

TEST(BranchRefinement, ABranchThatIsGoneHasNoOtherNumbersWhereTheyHaveAPrice) {
  std::size_t removals = 0;
  for (Seed seed = 1; seed <= 20; ++seed) {
    SmallTask small;
    small.task.freedom = freedom_of(1);
    Solution solution = small.start();
    refine_branches(small.task, settings_of(1, 600, seed), solution);
    for (const OverrideNode& node : solution.overrides.nodes)
      if (removes(node)) {
        ++removals;
        EXPECT_EQ(node.set.overrides.size(), 1u);
      }
  }
  EXPECT_GT(removals, 10u);
}

TEST(BranchRefinement, OffsetsKeepToTheShareThatTheirFreedomGivesThem) {
  for (const double freedom : {0.5, 1.0, 2.0}) {
    const double widest = widest_offset(refined_with(freedom, 20000).overrides);
    EXPECT_LE(widest, freedom / kWholeFreedom + 1e-9) << freedom;
    EXPECT_GT(widest, 0.5 * freedom / kWholeFreedom) << freedom;
  }
}

TEST(BranchRefinement, WithoutFreedomBranchesGetOtherNumbersOrGo) {
  const Solution refined = refined_with(0);
  EXPECT_FALSE(refined.overrides.empty());
  for (const OverrideNode& node : refined.overrides.nodes)
    for (const Override& entry : node.set.overrides)
      EXPECT_TRUE(entry.quantity == Quantity::seed || entry.quantity == Quantity::removed);
}

/// The refinement counts, branch by branch, what the search sees of the silhouettes; what that takes for the
/// whole plant (its depth, its share of wood) is settled by then.
TEST(BranchRefinement, LeavesAreSeenApartWhereTheTaskExpectsThem) {
  SmallTask small;
  small.task.bare_wood_price = 0.5;
  small.task.views[0].crown = small.task.views[0].target.mask();
  Solution solution = small.start();
  Plant plant;
  small.task.model->generate(solution.values, solution.plant_seed, small.task.growth, plant);
  Mask mask, leaves;
  small.task.make_renderer()->draw_apart(plant, small.task.views[0].camera, mask, leaves);
  const double seen = score_of_masks(small.task, {&mask, 1}, {&leaves, 1});
  EXPECT_EQ(solution.score, seen);
  refine_branches(small.task, settings_of(1, 1000), solution);
  EXPECT_EQ(solution.score, score_of(small.task, solution));
  EXPECT_LT(solution.score, seen);
}

TEST(BranchRefinement, TheDearerANumberTheFewerAreKept) {
  SmallTask small;
  std::vector<std::size_t> numbers;
  for (const double price : {0.0, 8e-4, 0.1}) {
    small.task.freedom = {1, price};
    Solution solution = small.start();
    refine_branches(small.task, settings_of(1, 4000), solution);
    numbers.push_back(count_numbers(solution.overrides));
    EXPECT_LE(solution.score, small.start().score);
  }
  EXPECT_LT(numbers[1], numbers[0]);
  EXPECT_GT(numbers[1], 0u);
  EXPECT_EQ(numbers[2], 0u);  // no number gains a tenth
}

TEST(BranchRefinement, WholeFreedomIsThatOfRunsWithoutAny) {
  EXPECT_EQ(freedom_of(kWholeFreedom).share, 1);
  EXPECT_EQ(freedom_of(kWholeFreedom).price, 0);
  EXPECT_EQ(freedom_of(100).share, 1);
  EXPECT_EQ(freedom_of(0).share, 0);
  SmallTask small;
  Solution given = small.start(), whole = small.start();
  refine_branches(small.task, settings_of(1, 1000), given);
  small.task.freedom = freedom_of(kWholeFreedom);
  refine_branches(small.task, settings_of(1, 1000), whole);
  EXPECT_EQ(overrides_to_toml(whole.overrides), overrides_to_toml(given.overrides));
}

TEST(BranchRefinement, LeavesOutWhatAModelCannotChange) {
  SmallTask small;
  small.task.model = &model_by_name("acer.lsys");
  Solution solution{.values = small.task.model->table().defaults(), .plant_seed = 1};
  solution.score = score_of(small.task, solution);
  for (const int order : {0, 1, 2}) {
    const double before = solution.score;
    refine_branches(small.task, settings_of(order, 300), solution);
    EXPECT_LE(solution.score, before);
  }
  EXPECT_EQ(solution.score, score_of(small.task, solution));
  ASSERT_FALSE(solution.overrides.empty());
  for (const OverrideNode& node : solution.overrides.nodes)
    for (const Override& entry : node.set.overrides) EXPECT_NE(entry.quantity, Quantity::seed);
}

TEST(BranchRefinement, ATreeWithoutSuchBranchesIsLeftAsItIs) {
  SmallTask small;
  small.set("levels", 1);
  Solution solution = small.start();
  EXPECT_EQ(refine_branches(small.task, settings_of(1, 100), solution), 0);
  EXPECT_TRUE(solution.overrides.empty());
}

bool same(const BranchRounds& a, const BranchRounds& b) {
  return branch_rounds_to_json(a, "weber_penn") == branch_rounds_to_json(b, "weber_penn");
}

TEST(BranchRounds, AreTheSameForAnyNumberOfThreads) {
  const SmallTask small;
  BranchRounds one = begin_branch_rounds(small.task, {small.start()}, 10), three = one;
  for (int round = 0; round < 2; ++round) {
    refine_round(small.task, 5, 1, one);
    refine_round(small.task, 5, 3, three);
  }
  EXPECT_TRUE(same(one, three));
}

TEST(BranchRounds, GoOnFromWhatIsWrittenWithTheSameBits) {
  const SmallTask small;
  BranchRounds unbroken = begin_branch_rounds(small.task, {small.start()}, 10);
  refine_round(small.task, 5, 1, unbroken);
  refine_round(small.task, 5, 1, unbroken);
  BranchRounds resumed = branch_rounds_from_json(branch_rounds_to_json(unbroken, "weber_penn"),
                                                 SmallTask::table(), "branches.json");
  refine_round(small.task, 5, 1, unbroken);
  refine_round(small.task, 5, 1, resumed);
  EXPECT_TRUE(same(unbroken, resumed));
}

TEST(BranchRounds, FilesHoldNoRowsThatTheirTreesDoNotUse) {
  const ParameterTable& table = model_by_name("weber_penn").table();
  BranchRounds state;
  state.copies.push_back({.values = load_preset("silver_birch").values});
  state.copies.push_back({.values = state.copies[0].values});
  state.copies[1].values[table.index_of("crown_top")] = 0.7;  // of a crown that is off, but not the default
  BranchRounds back = stored(state, table);
  EXPECT_LT(back.copies[0].values.size(), table.rows.size());
  EXPECT_EQ(back.copies[1].values, state.copies[1].values);
  restore(table, back);
  for (const std::size_t copy : {0, 1}) EXPECT_EQ(back.copies[copy].values, state.copies[copy].values);
}

std::string with_metrics(const std::string& metrics) {
  const nlohmann::json values = SmallTask::table().defaults();
  return R"({"rounds":1,"steps":1,"search_evaluations":1,"search_limit":1,"lanes":[{"values":)" +
         values.dump() +
         R"(,"plant_seed":1,"score":0.5,"overrides":""}],"history":[{"steps":1,"seconds":1,"score":0.5,"metrics":)" +
         metrics + "}]}";
}

TEST(BranchRounds, MeasuresOfEarlierVersionsAreReadByTheirPlaces) {
  const BranchRounds old = branch_rounds_from_json(with_metrics("[0.1,0.2,0.3,0.4,0.5,0.6,0.7]"),
                                                   SmallTask::table(), "branches.json");
  const MaskMetrics& metrics = old.history.front().metrics;
  EXPECT_EQ(metrics["pixel_accuracy"], 0.1);
  EXPECT_EQ(metrics["outline_iou"], 0.5);
  EXPECT_EQ(metrics["truncated_distance"], 0.6);
  EXPECT_EQ(metrics["gap_iou"], 0.7);
  EXPECT_THROW(branch_rounds_from_json(with_metrics("[0.1]"), SmallTask::table(), "branches.json"),
               InputError);
  EXPECT_THROW(branch_rounds_from_json(with_metrics("0.1"), SmallTask::table(), "branches.json"), InputError);
}

std::string error_of_state(const nlohmann::json& state) {
  try {
    branch_rounds_from_json(state.dump(), SmallTask::table(), "branches.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(BranchRounds, AStrangersStateIsCheckedAgainstTheModel) {
  const nlohmann::json sound = nlohmann::json::parse(with_metrics("[0.1,0.2,0.3,0.4,0.5,0.6,0.7]"));
  ASSERT_EQ(error_of_state(sound), "none");
  const auto spoiled = [&](auto spoil) {
    nlohmann::json state = sound;
    spoil(state);
    return error_of_state(state);
  };
  using testing::HasSubstr;
  using Json = nlohmann::json;
  EXPECT_THAT(spoiled([](Json& state) { state["lanes"][0]["values"].erase(0); }),
              HasSubstr("values of a copy"));
  EXPECT_THAT(spoiled([](Json& state) { state["lanes"][0]["values"][0] = 1e5; }),
              HasSubstr("got 100000, expected"));
  EXPECT_THAT(spoiled([](Json& state) { state["lanes"][0]["score"] = nullptr; }), HasSubstr("got '"));
  EXPECT_THAT(spoiled([](Json& state) { state["lanes"] = Json::array(); }), HasSubstr("no copies"));
  EXPECT_THAT(spoiled([](Json& state) { state["rounds"] = 9e18; }), HasSubstr("rounds, expected 0.."));
  EXPECT_THAT(spoiled([](Json& state) { state["finish_from"] = -2; }), HasSubstr("got -2"));
  EXPECT_THAT(spoiled([](Json& state) { state["steps"] = -1; }), HasSubstr("steps"));
  EXPECT_THAT(spoiled([](Json& state) { state["search_evaluations"] = 0; }), HasSubstr("evaluations"));
  EXPECT_THAT(spoiled([](Json& state) { state["search_limit"] = -1; }), HasSubstr("limit"));
}

/// Two trees of trunks alone, so that rounds of other orders find nothing to refine; the second is worse.
BranchRounds two_lanes(SmallTask& small) {
  small.set("levels", 1);
  Solution good = small.start(), bad = good;
  refine_branches(small.task, settings_of(0, 100), good);
  EXPECT_LT(good.score, bad.score);
  BranchRounds state = begin_branch_rounds(small.task, {good, bad}, 10);
  EXPECT_EQ(state.copies[0].overrides.nodes.size(), 1u);
  EXPECT_TRUE(state.copies[1].overrides.empty());
  return state;
}

TEST(BranchRounds, AfterEachRoundOfAllOrdersAllCopiesGoOnFromTheBest) {
  SmallTask small;
  for (const bool best_first : {true, false}) {
    BranchRounds state = two_lanes(small);
    const Solution best = state.copies[0];
    if (!best_first) std::swap(state.copies[0], state.copies[1]);
    state.rounds = 7;  // the eighth completes the orders
    refine_round(small.task, 5, 1, state);
    ASSERT_EQ(state.copies.size(), 2u);
    for (const Solution& copy : state.copies) {
      EXPECT_EQ(copy.score, best.score);
      EXPECT_EQ(overrides_to_toml(copy.overrides), overrides_to_toml(best.overrides));
    }
  }
}

TEST(BranchRounds, BetweenThemEachCopyGoesItsOwnWay) {
  SmallTask small;
  BranchRounds state = two_lanes(small);
  state.rounds = 3;
  refine_round(small.task, 5, 1, state);
  EXPECT_LT(state.copies[0].score, state.copies[1].score);
  BranchRounds alike = begin_branch_rounds(small.task, {state.copies[1]}, 10);
  refine_round(small.task, 5, 1, alike);  // of trunks, each copy with its own draws
  EXPECT_NE(overrides_to_toml(alike.copies[0].overrides), overrides_to_toml(alike.copies[1].overrides));
}

TEST(BranchRounds, TheBestIsTheCopyOfTheLowestScore) {
  BranchRounds state;
  for (const double score : {0.4, 0.2, 0.3}) state.copies.push_back({.score = score});
  EXPECT_EQ(state.best().score, 0.2);
}

TEST(BranchRounds, TextThatIsNoStateIsRefused) {
  for (const char* text : {"", "{}", "[1]", "{\"rounds\": \"x\"}",
                           R"({"rounds":1,"steps":1,"search_evaluations":1,"search_limit":1,"lanes":[]})"})
    EXPECT_THROW(branch_rounds_from_json(text, SmallTask::table(), "branches.json"), InputError) << text;
}

/// The tree's overrides as a file says them.
void say(const std::string& text, Solution& solution) {
  const toml::table document = parse_toml(text, "tree.toml");
  read_overrides({document, "tree.toml"}, SmallTask::table(), solution.overrides);
}

using KnotsByPath = std::map<BranchPath, std::vector<std::pair<Vec3, float>>>;

/// Of each stem its knots, places from its base, and radii.
KnotsByPath knots_of(const SmallTask& small, const Solution& solution) {
  const ChangeGraph graph(solution.overrides);
  GrowthSettings growth;
  growth.changes = &graph;
  Plant plant;
  small.task.model->generate(solution.values, solution.plant_seed, growth, plant);
  KnotsByPath knots;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (std::size_t k = plant.stems.first_knot[stem]; k < plant.stems.first_knot[stem + 1]; ++k)
      knots[path_of(plant, stem)].emplace_back(plant.knots.point_m[k], plant.knots.radius_m[k]);
  return knots;
}

bool is_on(const BranchPath& path, const BranchPath& branch) {
  return path.size() >= branch.size() && std::equal(branch.begin(), branch.end(), path.begin());
}

TEST(BranchRefinement, LeavesLockedBranchesAndAllOnThemAsTheyAre) {
  const SmallTask small;
  for (const char* path : {"0/9", "0/9..9", "0/@0.5..0.6"}) {
    Solution solution = small.start();
    say(fmt::format("[[branch]]\npath = \"{}\"\nlocked = true\n", path), solution);
    solution.score = score_of(small.task, solution);
    const KnotsByPath before = knots_of(small, solution);
    for (const int order : {1, 2}) refine_branches(small.task, settings_of(order, 1500), solution);
    const KnotsByPath after = knots_of(small, solution);
    std::size_t as_before = 0, of_others = 0;
    const bool is_of_index = std::string(path).find('@') == std::string::npos;
    for (const auto& [stem, knots] : before) {
      const bool is_same = after.contains(stem) && after.at(stem) == knots;
      EXPECT_TRUE(is_same || !is_of_index || !is_on(stem, {0, 9})) << path << " " << to_string(stem);
      if (stem.size() == 2) ++(is_same ? as_before : of_others);
    }
    EXPECT_GE(as_before, 1u) << path;
    EXPECT_GE(of_others, 8u) << path;
  }
}

/// They are carried along: of the length and the thickness that they had.
TEST(BranchRefinement, WhatBearsALockedBranchTurnsAndBendsAlone) {
  const SmallTask small;
  Solution solution = small.start();
  say("[[branch]]\npath = \"0/9/3\"\nlocked = true\n", solution);
  solution.score = score_of(small.task, solution);
  const KnotsByPath before = knots_of(small, solution);
  ASSERT_TRUE(before.contains({0, 9, 3}));
  for (int round = 0; round < 4; ++round)
    for (const int order : {0, 1})
      refine_branches(small.task, settings_of(order, 600, 10 + static_cast<Seed>(round)), solution);
  const KnotsByPath after = knots_of(small, solution);
  ASSERT_TRUE(after.contains({0, 9, 3}));
  const auto& was = before.at({0, 9, 3});
  const auto& is = after.at({0, 9, 3});
  ASSERT_EQ(was.size(), is.size());
  const auto long_m = [](const auto& knots) { return length(knots.back().first - knots.front().first); };
  EXPECT_NEAR(long_m(is), long_m(was), 0.1 * long_m(was));  // tropism bends it as it stands now
  EXPECT_NEAR(is.front().second, was.front().second, 0.02 * was.front().second);
  EXPECT_NE(solution.overrides.find({0, 9}), nullptr);
}

TEST(BranchRefinement, AddsToWhatRangesAndSharedSetsSay) {
  const SmallTask small;
  Solution solution = small.start();
  say("[shared.low]\nlength = { factor = 0.35 }\ntaper = 0.8\n[[branch]]\npath = \"0/6..13\"\nshares = "
      "\"low\"\n"
      "[[branch]]\npath = \"0/@0.6..0.9\"\ndown_angle = { offset = 50 }\n",
      solution);
  solution.score = score_of(small.task, solution);
  const std::string ranges = overrides_to_toml({{}, solution.overrides.ranges, solution.overrides.shared});
  const double before = solution.score;
  refine_branches(small.task, settings_of(1, 2000), solution);
  EXPECT_LT(solution.score, before - 0.02);
  EXPECT_EQ(solution.score, score_of(small.task, solution));
  EXPECT_EQ(overrides_to_toml({{}, solution.overrides.ranges, solution.overrides.shared}), ranges);
  const ChangeGraph with(solution.overrides), without({solution.overrides.nodes, {}, {}});
  int checked = 0;
  for (const OverrideNode& node : solution.overrides.nodes) {
    if (node.path.size() != 2 || node.path[1] < 6 || node.path[1] > 13) continue;
    const auto length_of = [&](const ChangeGraph& graph) {
      return changed(ChangeCursor(&graph).child(0).child(node.path[1], 0.1f).change(), Quantity::length, 1);
    };
    EXPECT_FLOAT_EQ(length_of(with), 0.35f * length_of(without)) << to_string(node.path);
    ++checked;
  }
  EXPECT_GE(checked, 4);
}

}  // namespace
}  // namespace espalier
