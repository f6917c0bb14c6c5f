// The rows of the Weber–Penn table: each names a member of WeberPennParameters, its unit, its valid
// values and where a search looks. Help and meaning after [CH, Appendix C].
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>

#include <espalier/core/error.h>
#include <espalier/plant/leaf_outlines.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

namespace {

using PlantMember = float WeberPennParameters::*;
using LevelMember = LevelValues WeberPennParameters::*;

struct Range {
  double lower, upper;
};

/// One parameter of the paper; a level member becomes four rows of the table.
struct Definition {
  std::variant<PlantMember, LevelMember> member;
  const char* name;
  const char* unit;
  Range valid, search;
  Scale scale;
  SignMeaning sign;
  const char* free_levels;  ///< digits of the levels that are free by default; "*" for the whole plant
  const char* symbol;       ///< Weber and Penn's name
  const char* help;
};

using P = WeberPennParameters;
constexpr Scale kReal = Scale::linear, kLog = Scale::logarithmic, kWhole = Scale::integer,
                kChoice = Scale::choice;
constexpr SignMeaning kNumber = SignMeaning::number, kFlag = SignMeaning::flag;

// clang-format off
const Definition kDefinitions[] = {
  {&P::shape, "shape", "1", {0, 8}, {0, 8}, kChoice, kNumber, "", "Shape", "crown shape: how the length of first-level branches changes with height"},
  {&P::shape_2, "shape_2", "1", {0, 8}, {0, 8}, kChoice, kNumber, "", "", "a second crown shape, mixed in by shape_mix"},
  {&P::shape_mix, "shape_mix", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "", "share of shape_2 in the crown's shape: 0 is shape alone"},
  {&P::g_scale, "g_scale", "m", {0.01, 500}, {2, 40}, kLog, kNumber, "*", "Scale", "scale of the whole tree; with length[0] = 1 its height"},
  {&P::g_scale_v, "g_scale_v", "m", {0, 500}, {0, 10}, kReal, kNumber, "", "ScaleV", "largest variation of g_scale"},
  {&P::levels, "levels", "1", {1, 4}, {1, 4}, kWhole, kNumber, "", "Levels", "levels of branching, the trunk included; leaves grow on the last"},
  {&P::ratio, "ratio", "1", {0.0001, 1}, {0.005, 0.08}, kLog, kNumber, "*", "Ratio", "radius of the trunk over its length"},
  {&P::ratio_power, "ratio_power", "1", {0, 10}, {0.8, 2.5}, kReal, kNumber, "*", "RatioPower", "how strongly radii shrink from level to level"},
  {&P::flare, "flare", "1", {0, 20}, {0, 2}, kReal, kNumber, "*", "Flare", "widening of the trunk at its foot, as a fraction of its radius"},
  {&P::base_splits, "base_splits", "1", {-10, 10}, {-3, 3}, kWhole, kFlag, "", "0BaseSplits", "clones of the trunk at the height of its base; negative: a random number up to that many"},
  {&P::base_size, "base_size", "1", {0, 0.99}, {0, 0.6}, kReal, kNumber, "01", "BaseSize", "fraction of the stem below its first child"},
  {&P::down_angle, "down_angle", "deg", {-360, 360}, {-10, 140}, kReal, kNumber, "123", "nDownAngle", "angle of a stem away from its parent"},
  {&P::down_angle_v, "down_angle_v", "deg", {-360, 360}, {-90, 60}, kReal, kFlag, "12", "nDownAngleV", "variation of down_angle; negative: changes along the parent, lower stems pointing further down"},
  {&P::rotate, "rotate", "deg", {-360, 360}, {-180, 180}, kReal, kFlag, "1", "nRotate", "angle about the parent from one stem to the next; negative: on alternate sides; the spread of a fan"},
  {&P::rotate_v, "rotate_v", "deg", {-360, 360}, {0, 90}, kReal, kNumber, "", "nRotateV", "largest variation of rotate"},
  {&P::branches, "branches", "1", {-1000, 1000}, {1, 120}, kWhole, kFlag, "123", "nBranches", "most stems of this level on each parent; negative: that many in a fan at its tip; level 0: trunks from the ground"},
  {&P::length, "length", "1", {0, 10}, {0.02, 1.2}, kReal, kNumber, "123", "nLength", "length of a stem relative to its parent's"},
  {&P::length_v, "length_v", "1", {0, 10}, {0, 0.3}, kReal, kNumber, "1", "nLengthV", "largest variation of length"},
  {&P::taper, "taper", "1", {0, 3}, {0.5, 2}, kReal, kNumber, "0", "nTaper", "0 a cylinder, 1 a cone, 2 a rounded end, up to 3 periodic swelling"},
  {&P::seg_splits, "seg_splits", "1", {0, 4}, {0, 1.5}, kReal, kNumber, "01", "nSegSplits", "clones at each segment end, fractions spread along the stem"},
  {&P::split_angle, "split_angle", "deg", {-180, 180}, {-60, 80}, kReal, kFlag, "01", "nSplitAngle", "angle between the clones of a split; negative: in the plane of the stem, not paid back"},
  {&P::split_angle_v, "split_angle_v", "deg", {-180, 180}, {0, 30}, kReal, kNumber, "", "nSplitAngleV", "largest variation of split_angle"},
  {&P::curve_res, "curve_res", "1", {0, 100}, {1, 12}, kWhole, kNumber, "", "nCurveRes", "segments of a stem (0, for levels that do not grow, counts as 1)"},
  {&P::curve, "curve", "deg", {-720, 720}, {-120, 120}, kReal, kNumber, "012", "nCurve", "bend from start to end, away from the parent's direction"},
  {&P::curve_back, "curve_back", "deg", {-720, 720}, {-120, 120}, kReal, kNumber, "1", "nCurveBack", "bend of the second half, for S-shaped stems; 0: one bend"},
  {&P::curve_v, "curve_v", "deg", {-360, 1000}, {0, 200}, kReal, kFlag, "012", "nCurveV", "largest variation of curve; negative: a helix of that declination"},
  {&P::bend_v, "bend_v", "deg", {0, 1000}, {0, 200}, kReal, kNumber, "1", "nBendV", "largest sideways bend from start to end"},
  {&P::branch_dist, "branch_dist", "1", {0, 50}, {0, 4}, kReal, kNumber, "", "", "0 alternate, 1 opposite, above 1 whorls of branch_dist + 1 stems"},
  {&P::radius_mod, "radius_mod", "1", {0, 20}, {0.1, 3}, kLog, kNumber, "12", "", "factor on the radius of stems"},
  {&P::leaf_blos_num, "leaf_blos_num", "1", {-2000, 10000}, {0, 120}, kWhole, kFlag, "*", "Leaves", "leaves or blossom on each stem of the last level; negative: in a fan at its tip"},
  {&P::leaf_shape, "leaf_shape", "1", {0, kLeafShapes.size()}, {0, kLeafShapes.size()}, kChoice, kNumber, "", "LeafShape", "outline of a leaf"},
  {&P::leaf_scale, "leaf_scale", "m", {0, 50}, {0.03, 0.5}, kLog, kNumber, "*", "LeafScale", "length of a leaf"},
  {&P::leaf_scale_x, "leaf_scale_x", "1", {0, 50}, {0.05, 1.5}, kLog, kNumber, "*", "LeafScaleX", "width of a leaf relative to its outline's"},
  {&P::leaf_bend, "leaf_bend", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "LeafBend", "how far leaves turn to face outwards"},
  {&P::blossom_shape, "blossom_shape", "1", {1, kBlossomShapes.size()}, {1, kBlossomShapes.size()}, kChoice, kNumber, "", "", "form of a blossom"},
  {&P::blossom_scale, "blossom_scale", "m", {0, 50}, {0, 0.3}, kReal, kNumber, "", "", "size of a blossom"},
  {&P::blossom_rate, "blossom_rate", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "", "fraction of the leaves that are blossom"},
  {&P::tropism_x, "tropism_x", "1", {-100, 100}, {-3, 3}, kReal, kNumber, "*", "", "pull of all stems along x"},
  {&P::tropism_y, "tropism_y", "1", {-100, 100}, {-3, 3}, kReal, kNumber, "", "", "pull of all stems along y"},
  {&P::tropism_z, "tropism_z", "1", {-100, 100}, {-4, 4}, kReal, kNumber, "*", "AttractionUp", "pull upwards of stems of level 2 and above"},
  {&P::prune_ratio, "prune_ratio", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "PruneRatio", "how far pruning to the envelope is applied"},
  {&P::prune_width, "prune_width", "1", {0, 10}, {0.05, 1}, kReal, kNumber, "", "PruneWidth", "radius of the envelope as a fraction of its height"},
  {&P::prune_width_peak, "prune_width_peak", "1", {0, 1}, {0.05, 0.95}, kReal, kNumber, "", "PruneWidthPeak", "where, from its bottom up, the envelope is widest"},
  {&P::prune_power_low, "prune_power_low", "1", {0, 20}, {0.05, 2}, kReal, kNumber, "", "PrunePowerLow", "curvature of the envelope below its peak: under 1 convex, over 1 concave"},
  {&P::prune_power_high, "prune_power_high", "1", {0, 20}, {0.05, 2}, kReal, kNumber, "", "PrunePowerHigh", "curvature of the envelope above its peak"},
  {&P::relaxed_counts, "relaxed_counts", "1", {0, 1}, {0, 1}, kChoice, kNumber, "", "", "on: counts may be fractions, and the last child grows in proportion, so that searches see no jumps"},
};
// clang-format on

struct ChoiceNames {
  const char* name;
  int first;
  std::vector<std::string> names;
};

std::vector<std::string> leaf_shape_names() {
  std::vector<std::string> names{"default"};
  names.insert(names.end(), kLeafShapes.begin(), kLeafShapes.end());
  return names;
}

const std::vector<ChoiceNames>& choice_names() {
  static const std::vector<std::string> kCrownShapes = {
      "conical", "spherical",       "hemispherical", "cylindrical", "tapered_cylindrical",
      "flame",   "inverse_conical", "tend_flame",    "envelope"};
  static const std::vector<ChoiceNames> kNames = {
      {"shape", 0, kCrownShapes},
      {"shape_2", 0, kCrownShapes},
      {"leaf_shape", 0, leaf_shape_names()},
      {"blossom_shape", 1, {kBlossomShapes.begin(), kBlossomShapes.end()}},
      {"relaxed_counts", 0, {"off", "on"}},
  };
  return kNames;
}

/// What a row's values need in order to mean anything: rows, of which one is not 0. "[n]" is the row's level.
struct Need {
  const char* name;
  std::vector<const char*> rows;
};

const std::vector<Need>& needs() {
  static const std::vector<Need> kNeeds = {{"shape_2", {"shape_mix"}},
                                           {"split_angle", {"seg_splits[n]", "base_splits"}},
                                           {"split_angle_v", {"seg_splits[n]", "base_splits"}},
                                           {"leaf_shape", {"leaf_blos_num"}},
                                           {"leaf_scale", {"leaf_blos_num"}},
                                           {"leaf_scale_x", {"leaf_blos_num"}},
                                           {"leaf_bend", {"leaf_blos_num"}},
                                           {"blossom_shape", {"blossom_rate"}},
                                           {"blossom_scale", {"blossom_rate"}},
                                           {"prune_width", {"prune_ratio"}}};
  return kNeeds;
}

/// Splits at the base are the trunk's alone.
std::vector<std::string> needs_of(const ParameterInfo& row) {
  std::vector<std::string> names;
  for (const Need& need : needs())
    if (row.name == need.name)
      for (std::string name : need.rows)
        if (name != "base_splits" || row.level == 0) {
          if (name.ends_with("[n]")) name.replace(name.size() - 2, 1, std::to_string(row.level));
          names.push_back(std::move(name));
        }
  return names;
}

/// Children are placed by the values of their own level, and leaves by those of the level below the last.
int least_levels_of(const ParameterInfo& row) {
  static const std::vector<std::string> kPlacing = {"down_angle", "down_angle_v", "rotate", "rotate_v",
                                                    "branch_dist"};
  if (row.level < 0) return 0;
  return std::find(kPlacing.begin(), kPlacing.end(), row.name) == kPlacing.end() ? row.level + 1 : row.level;
}

FlagSides sides_of(const std::string& name) {
  if (name == "branches" || name == "leaf_blos_num" || name == "base_splits") return FlagSides::one_measure;
  return name == "rotate" ? FlagSides::unrelated : FlagSides::meet_at_zero;
}

bool is_free(const Definition& definition, int level) {
  const std::string_view levels = definition.free_levels;
  return level < 0 ? levels == "*" : levels.find(static_cast<char>('0' + level)) != levels.npos;
}

/// float defaults as the decimal a person would write: 0.015f becomes 0.015.
double decimal_of(float value) { return std::stod(fmt::format("{}", value)); }

ParameterInfo make_row(const Definition& definition, int level, float default_value) {
  ParameterInfo row{.name = definition.name,
                    .level = level,
                    .unit = definition.unit,
                    .lower = definition.valid.lower,
                    .upper = definition.valid.upper,
                    .search_lower = definition.search.lower,
                    .search_upper = definition.search.upper,
                    .scale = definition.scale,
                    .sign = definition.sign,
                    .default_value = decimal_of(default_value),
                    .free_by_default = is_free(definition, level),
                    .choices = {},
                    .symbol = definition.symbol,
                    .help = definition.help};
  for (const ChoiceNames& choice : choice_names())
    if (row.name == choice.name) row.choices = choice.names, row.first_choice = choice.first;
  if (row.name == "branches" && level == 0) row.lower = 1, row.sign = SignMeaning::number;
  row.sides = sides_of(row.name);
  if (row.name == "taper") row.regimes = Regimes::taper;
  if (row.name == "shape") row.mixed_with = "shape_2", row.mixed_by = "shape_mix";
  row.least_levels = least_levels_of(row);
  row.needs = needs_of(row);
  row.relaxable = (row.name == "branches" && level > 0) || row.name == "leaf_blos_num";
  return row;
}

ParameterTable make_table() {
  const WeberPennParameters defaults;
  ParameterTable table{"weber_penn", {}, "levels", "relaxed_counts"};
  for (const Definition& definition : kDefinitions) {
    if (const auto* whole = std::get_if<PlantMember>(&definition.member))
      table.rows.push_back(make_row(definition, -1, defaults.*(*whole)));
    else
      for (int level = 0; level < 4; ++level)
        table.rows.push_back(
            make_row(definition, level, (defaults.*std::get<LevelMember>(definition.member))[level]));
  }
  return table;
}

}  // namespace

const ParameterTable& weber_penn_table() {
  static const ParameterTable kTable = make_table();
  return kTable;
}

WeberPennParameters weber_penn_parameters(std::span<const double> values) {
  ESPALIER_CHECK_EQ(values.size(), weber_penn_table().rows.size());
  WeberPennParameters parameters;
  std::size_t row = 0;
  for (const Definition& definition : kDefinitions) {
    if (const auto* whole = std::get_if<PlantMember>(&definition.member))
      parameters.*(*whole) = static_cast<float>(values[row++]);
    else
      for (float& value : parameters.*std::get<LevelMember>(definition.member))
        value = static_cast<float>(values[row++]);
  }
  return parameters;
}

}  // namespace espalier
