#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/core/parallel_for.h>
#include <espalier/core/text/text_hash.h>
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/branch_rounds.h>
#include <espalier/image/measures/metrics_json.h>
#include <espalier/overrides/overrides_toml.h>

namespace espalier {

namespace {

constexpr std::size_t kCopies = 2;

/// What is refined in one round, and by how many steps: a step on the trunk grows the whole tree.
struct RoundKind {
  int order;
  long steps;
};
constexpr std::array<RoundKind, 8> kCycle{
    {{0, 100}, {1, 2000}, {1, 2000}, {2, 2000}, {1, 2000}, {2, 2000}, {2, 2000}, {3, 2000}}};

nlohmann::ordered_json row_to_json(const RoundRow& row) {
  return {{"stage", name_of(row.stage)}, {"steps", row.steps},         {"seconds", row.seconds},
          {"score", row.score},          {"own_score", row.own_score}, {"metrics", row.metrics}};
}

/// Earlier versions wrote an array without names, in this order.
MaskMetrics metrics_from_array(const nlohmann::json& json) {
  constexpr std::array kOrder{"pixel_accuracy",     "iou",    "dice", "tolerant_iou", "outline_iou",
                              "truncated_distance", "gap_iou"};
  nlohmann::json named;
  for (std::size_t i = 0; i < kOrder.size(); ++i) named[kOrder[i]] = json.at(i);
  return named.get<MaskMetrics>();
}

RoundRow row_from_json(const nlohmann::json& json, const std::string& source) {
  const nlohmann::json& metrics = json.at("metrics");
  RoundRow row;
  // Earlier versions had no other.
  const std::string stage = json.value("stage", name_of(FitStage::branches));
  const auto named = value_named<FitStage>(stage);
  if (!named)
    throw_input_error("{}: got stage '{}', expected one of {}", source, stage,
                      fmt::join(names_of<FitStage>(), ", "));
  row.stage = *named;
  row.steps = json.at("steps");
  row.seconds = json.at("seconds");
  row.score = json.at("score");
  row.own_score = json.value("own_score", row.score);  // earlier versions had one measure
  row.metrics = metrics.is_array() ? metrics_from_array(metrics) : metrics.get<MaskMetrics>();
  return row;
}

}  // namespace

const Solution& BranchRounds::best() const {
  return *std::min_element(copies.begin(), copies.end(),
                           [](const Solution& a, const Solution& b) { return a.score < b.score; });
}

BranchRounds begin_branch_rounds(const FitTask& task, const std::vector<Solution>& starts,
                                 long search_evaluations) {
  BranchRounds state{.search_evaluations = search_evaluations};
  for (std::size_t copy = 0; copy < kCopies; ++copy) state.copies.push_back(starts[copy % starts.size()]);
  rescore(task, state);
  return state;
}

void rescore(const FitTask& task, BranchRounds& state) {
  for (Solution& copy : state.copies) copy.score = priced_score_of(task, copy);
}

void refine_round(const FitTask& task, Seed seed, int threads, BranchRounds& state) {
  const RoundKind kind = kCycle[static_cast<std::size_t>(state.rounds) % kCycle.size()];
  std::vector<long> steps(state.copies.size(), 0);
  const RandomKey key = child_key(root_key(seed), static_cast<std::uint64_t>(state.rounds));
  const auto refine_copy = [&](std::size_t copy) {
    RefinementSettings settings{.order = kind.order, .steps = kind.steps, .key = child_key(key, copy)};
    steps[copy] = refine_branches(task, settings, state.copies[copy]);
  };
  parallel_for(state.copies.size(), refine_copy, threads);
  for (const long made : steps) state.steps += made;
  ++state.rounds;
  if (state.rounds % static_cast<long>(kCycle.size()) != 0) return;
  const Solution best = state.best();
  for (Solution& copy : state.copies) copy = best;
}

namespace {

/// The rows that any file names.
std::vector<std::size_t> rows_of_all(const ParameterTable& table) {
  const std::vector<bool> in_use = rows_in_use(table, table.defaults());
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < in_use.size(); ++row)
    if (in_use[row]) rows.push_back(row);
  return rows;
}

/// The model's defaults, but for these rows.
ParameterValues defaults_but_for(const ParameterTable& table, const std::vector<std::size_t>& rows,
                                 const ParameterValues& values_of_rows) {
  ParameterValues values = table.defaults();
  for (std::size_t i = 0; i < rows.size(); ++i) values[rows[i]] = values_of_rows[i];
  return values;
}

void check_count(long count, long least, const char* what, const std::string& source) {
  constexpr long kMost = 1'000'000'000;
  if (count < least || count > kMost)
    throw_input_error("{}: got {} {}, expected {}..{}", source, count, what, least, kMost);
}

void check_copy(const Solution& copy, const ParameterTable& table, const std::string& source) {
  const std::vector<std::size_t> rows = rows_of_all(table);
  const std::size_t count = copy.values.size(), all = table.rows.size();
  if (count != rows.size() && count != all)
    throw_input_error("{}: got {} values of a copy, expected {} or {}", source, count, rows.size(), all);
  if (!std::isfinite(copy.score))
    throw_input_error("{}: got score {}, expected a number", source, copy.score);
  const ParameterValues values = count == all ? copy.values : defaults_but_for(table, rows, copy.values);
  for (std::size_t row = 0; row < all; ++row) check_value(table.rows[row], values[row], source);
}

/// A stranger's file, or a damaged one, may hold anything.
void check_state(const BranchRounds& state, const ParameterTable& table, const std::string& source) {
  check_count(state.rounds, 0, "rounds", source);
  check_count(state.finish_from, -1, "as the round of the finish", source);
  check_count(state.steps, 0, "steps", source);
  check_count(state.search_evaluations, 1, "evaluations", source);
  check_count(state.search_limit, 0, "as the limit of evaluations", source);
  if (state.copies.empty()) throw_input_error("{}: got no copies, expected one or more", source);
  for (const Solution& copy : state.copies) check_copy(copy, table, source);
}

}  // namespace

namespace {

/// The last line but one of the file, behind all that it is made of.
constexpr std::string_view kCheckBegin = ",\n \"check\": \"", kEnd = "\n}";
constexpr std::size_t kHashSize = 16;

std::string with_check(std::string json) {
  json.resize(json.size() - kEnd.size());
  return fmt::format("{}{}{}\"{}\n", json, kCheckBegin, text_hash(json), kEnd);
}

/// Files of earlier versions have none.
void verify_check(const std::string& text, const std::string& source) {
  const std::size_t at = text.rfind(kCheckBegin);
  if (at == std::string::npos) return;
  const std::string hash = text.substr(at + kCheckBegin.size(), kHashSize),
                    now = text_hash(text.substr(0, at));
  if (hash != now)
    throw_input_error("{}: got a state that was changed since it was written (hash {}), expected {}", source,
                      now, hash);
}

}  // namespace

BranchRounds stored(BranchRounds state, const ParameterTable& table) {
  const std::vector<std::size_t> rows = rows_of_all(table);
  for (Solution& copy : state.copies) {
    ParameterValues values;
    values.reserve(rows.size());
    for (const std::size_t row : rows) values.push_back(copy.values[row]);
    if (defaults_but_for(table, rows, values) == copy.values) copy.values = std::move(values);
  }
  return state;
}

void restore(const ParameterTable& table, BranchRounds& state) {
  const std::vector<std::size_t> rows = rows_of_all(table);
  for (Solution& copy : state.copies)
    if (copy.values.size() == rows.size()) copy.values = defaults_but_for(table, rows, copy.values);
}

std::string branch_rounds_to_json(const BranchRounds& state, const std::string& model) {
  nlohmann::ordered_json json = {{"model", model},
                                 {"rounds", state.rounds},
                                 {"finish_from", state.finish_from},
                                 {"steps", state.steps},
                                 {"search_evaluations", state.search_evaluations},
                                 {"search_limit", state.search_limit}};
  for (const Solution& copy : state.copies)
    json["lanes"].push_back({{"values", copy.values},
                             {"plant_seed", copy.plant_seed},
                             {"score", copy.score},
                             {"overrides", overrides_to_toml(copy.overrides)}});
  for (const RoundRow& row : state.history) json["history"].push_back(row_to_json(row));
  return with_check(json.dump(1));
}

BranchRounds branch_rounds_from_json(const std::string& text, const ParameterTable& table,
                                     const std::string& source) {
  try {
    verify_check(text, source);
    const nlohmann::json json = nlohmann::json::parse(text);
    BranchRounds state{.rounds = json.at("rounds"),
                       .finish_from = json.value("finish_from", -1L),
                       .steps = json.at("steps"),
                       .search_evaluations = json.at("search_evaluations"),
                       .search_limit = json.at("search_limit")};
    for (const nlohmann::json& from : json.at("lanes")) {
      Solution copy;
      copy.values = from.at("values").get<ParameterValues>();
      copy.plant_seed = from.at("plant_seed");
      copy.score = from.at("score");
      const toml::table overrides = parse_toml(from.at("overrides").get<std::string>(), source);
      read_overrides({overrides, source}, table, copy.overrides);
      state.copies.push_back(std::move(copy));
    }
    if (json.contains("history"))
      for (const nlohmann::json& row : json.at("history"))
        state.history.push_back(row_from_json(row, source));
    check_state(state, table, source);
    return state;
  } catch (const nlohmann::json::exception& error) {
    throw_input_error("{}: got '{}', expected the state of a refinement", source, error.what());
  }
}

}  // namespace espalier
