// The rows of the Weber–Penn table: each names a member of WeberPennParameters and says all there is to say
// of it, but its default, which is the member's. Help and meaning after [CH, Appendix C]. Plain values are
// those of a tree to trace: where overrides bend a branch, curve_v is what other seeds bend it by. The last
// rows are the numbers of curves along stems (docs/curves.md); plain ones are neutral.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include <espalier/core/error.h>
#include <espalier/plant/leaf_outlines.h>
#include <espalier/weber_penn/table/parameters.h>
#include <espalier/weber_penn/table/taper_codec.h>

namespace espalier {

namespace {

using PlantMember = float WeberPennParameters::*;
using LevelMember = LevelValues WeberPennParameters::*;

struct Range {
  double lower, upper;
};

using Names = std::span<const char* const>;

/// What holds of the trunk's row and what of those of the branches; of a whole plant's row the first.
template <typename T>
struct ForTrunkAndBranches {
  T trunk{}, branches{};
  const T& at(int level) const { return level > 0 ? branches : trunk; }
};

/// Names of two rows at most, the second or both nullptr; "[n]" is the row's own level.
using Needs = std::array<const char*, 2>;

/// Which branch can have a row for itself: the one it describes, or whose parts it does; the one that bears
/// those it describes; a trunk; or none, as the whole plant has one.
enum class Owner { stem, bearer, trunk, plant };

/// What is not the same in most rows.
struct Facts {
  std::optional<Range> trunk_valid;  ///< of the trunk's row, where it is another
  Names choices;
  int first_choice = 0;
  const char *mixed_with = "", *mixed_by = "";
  FlagSides sides = FlagSides::meet_at_zero;
  bool relaxable = false;  ///< but for a count of trunks
  bool places = false;     ///< says how stems stand on their parents, or leaves on stems of the level above
  ForTrunkAndBranches<Needs> needs;  ///< rows of which one is not 0 where the values mean anything
  const char* part_of = "";
  bool says_nothing_at_default = false;
  const ParameterCodec& (*codec)() = nullptr;
  ForTrunkAndBranches<Owner> owner;
  ForTrunkAndBranches<Role> role;
  ForTrunkAndBranches<std::optional<double>> plain;
};

/// One parameter of the paper; a level member becomes four rows of the table. Its default is the member's.
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
  Facts facts = {};
};

using P = WeberPennParameters;
constexpr Scale kReal = Scale::linear, kLog = Scale::logarithmic, kWhole = Scale::integer,
                kChoice = Scale::choice;
constexpr SignMeaning kNumber = SignMeaning::number, kFlag = SignMeaning::flag;

constexpr const char* kCrownShapes[] = {"conical",         "spherical",           "hemispherical",
                                        "cylindrical",     "tapered_cylindrical", "flame",
                                        "inverse_conical", "tend_flame",          "envelope"};
constexpr std::array kLeafChoices = [] {
  std::array<const char*, kLeafShapes.size() + 1> names{"default"};
  std::copy(kLeafShapes.begin(), kLeafShapes.end(), names.begin() + 1);
  return names;
}();
constexpr const char* kSwitch[] = {"off", "on"};
constexpr const char* kCrownUses[] = {"off", "cut", "length", "train"};
constexpr ForTrunkAndBranches<Owner> kOfPlant{Owner::plant}, kOfTrunk{Owner::trunk},
    kOfBearer{Owner::plant, Owner::bearer};
const Facts kOfCrown{.needs = {{"crown_use"}}, .part_of = "crown_use", .owner = kOfPlant};

// clang-format off
const Definition kDefinitions[] = {
  {&P::shape, "shape", "1", {0, 8}, {0, 8}, kChoice, kNumber, "", "Shape", "crown shape: how the length of first-level branches changes with height",
   {.choices = kCrownShapes, .mixed_with = "shape_2", .mixed_by = "shape_mix", .owner = kOfTrunk, .plain = {3}}},
  {&P::shape_2, "shape_2", "1", {0, 8}, {0, 8}, kChoice, kNumber, "", "", "a second crown shape, mixed in by shape_mix",
   {.choices = kCrownShapes, .needs = {{"shape_mix"}}, .owner = kOfTrunk}},
  {&P::shape_mix, "shape_mix", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "", "share of shape_2 in the crown's shape: 0 is shape alone",
   {.owner = kOfTrunk, .plain = {0}}},
  {&P::g_scale, "g_scale", "m", {0.01, 500}, {2, 40}, kLog, kNumber, "*", "Scale", "scale of the whole tree; with length[0] = 1 its height",
   {.owner = kOfPlant, .role = {Role::tree_scale}}},
  {&P::g_scale_v, "g_scale_v", "m", {0, 500}, {0, 10}, kReal, kNumber, "", "ScaleV", "largest variation of g_scale",
   {.owner = kOfPlant, .role = {Role::tree_scale_variation}, .plain = {0}}},
  {&P::levels, "levels", "1", {1, 4}, {1, 4}, kWhole, kNumber, "", "Levels", "levels of branching, the trunk included; leaves grow on the last",
   {.owner = kOfPlant, .role = {Role::levels}}},
  {&P::ratio, "ratio", "1", {0.0001, 1}, {0.005, 0.08}, kLog, kNumber, "*", "Ratio", "radius of the trunk over its length",
   {.owner = kOfTrunk, .role = {Role::trunk_ratio}}},
  {&P::ratio_power, "ratio_power", "1", {0, 10}, {0.8, 2.5}, kReal, kNumber, "*", "RatioPower", "how strongly radii shrink from level to level",
   {.role = {Role::radius_power}, .plain = {1.2}}},
  {&P::flare, "flare", "1", {0, 20}, {0, 2}, kReal, kNumber, "*", "Flare", "widening of the trunk at its foot, as a fraction of its radius",
   {.owner = kOfTrunk, .role = {Role::trunk_flare}, .plain = {0}}},
  {&P::base_splits, "base_splits", "1", {-10, 10}, {-3, 3}, kWhole, kFlag, "", "0BaseSplits", "clones of the trunk at the height of its base; negative: a random number up to that many",
   {.sides = FlagSides::one_measure, .owner = kOfTrunk, .role = {Role::trunk_form}, .plain = {0}}},
  {&P::base_size, "base_size", "1", {0, 0.99}, {0, 0.6}, kReal, kNumber, "01", "BaseSize", "fraction of the stem below its first child",
   {.role = {Role::crown_base}, .plain = {0, 0}}},
  {&P::down_angle, "down_angle", "deg", {-360, 360}, {-10, 140}, kReal, kNumber, "123", "nDownAngle", "angle of a stem away from its parent",
   {.places = true, .owner = kOfBearer, .plain = {0, 50}}},
  {&P::down_angle_v, "down_angle_v", "deg", {-360, 360}, {-90, 60}, kReal, kFlag, "12", "nDownAngleV", "variation of down_angle; negative: changes along the parent, lower stems pointing further down",
   {.places = true, .owner = kOfBearer, .plain = {0, 0}}},
  {&P::rotate, "rotate", "deg", {-360, 360}, {-180, 180}, kReal, kFlag, "1", "nRotate", "angle about the parent from one stem to the next; negative: on alternate sides; the spread of a fan",
   {.sides = FlagSides::unrelated, .places = true, .owner = kOfBearer, .plain = {180, 180}}},
  {&P::rotate_v, "rotate_v", "deg", {-360, 360}, {0, 90}, kReal, kNumber, "", "nRotateV", "largest variation of rotate",
   {.places = true, .owner = kOfBearer, .plain = {0, 0}}},
  {&P::branches, "branches", "1", {-1000, 1000}, {1, 120}, kWhole, kFlag, "123", "nBranches", "most stems of this level on each parent; negative: that many in a fan at its tip; level 0: trunks from the ground",
   {.trunk_valid = Range{1, 1000}, .sides = FlagSides::one_measure, .relaxable = true, .owner = kOfBearer, .role = {Role::trunk_count, Role::branch_count}, .plain = {{}, 2}}},
  {&P::length, "length", "1", {0, 10}, {0.02, 1.2}, kReal, kNumber, "123", "nLength", "length of a stem relative to its parent's",
   {.owner = {Owner::stem, Owner::bearer}, .role = {Role::trunk_form, Role::branch_length}, .plain = {1, 0.5}}},
  {&P::length_v, "length_v", "1", {0, 10}, {0, 0.3}, kReal, kNumber, "1", "nLengthV", "largest variation of length",
   {.owner = {Owner::stem, Owner::bearer}, .role = {Role::trunk_form}, .plain = {0, 0}}},
  {&P::taper, "taper", "1", {0, 3}, {0.5, 2}, kReal, kNumber, "0", "nTaper", "0 a cylinder, 1 a cone, 2 a rounded end, up to 3 periodic swelling",
   {.codec = taper_codec, .role = {Role::trunk_taper}, .plain = {0.75, 0.75}}},
  {&P::seg_splits, "seg_splits", "1", {0, 4}, {0, 1.5}, kReal, kNumber, "01", "nSegSplits", "clones at each segment end, fractions spread along the stem",
   {.role = {Role::trunk_form}, .plain = {0, 0}}},
  {&P::split_angle, "split_angle", "deg", {-180, 180}, {-60, 80}, kReal, kFlag, "01", "nSplitAngle", "angle between the clones of a split; negative: in the plane of the stem, not paid back",
   {.needs = {{"seg_splits[n]", "base_splits"}, {"seg_splits[n]"}}}},
  {&P::split_angle_v, "split_angle_v", "deg", {-180, 180}, {0, 30}, kReal, kNumber, "", "nSplitAngleV", "largest variation of split_angle",
   {.needs = {{"seg_splits[n]", "base_splits"}, {"seg_splits[n]"}}}},
  {&P::curve_res, "curve_res", "1", {0, 100}, {1, 12}, kWhole, kNumber, "", "nCurveRes", "segments of a stem (0, for levels that do not grow, counts as 1)",
   {.role = {Role::trunk_segments}, .plain = {6, 6}}},
  {&P::curve, "curve", "deg", {-720, 720}, {-120, 120}, kReal, kNumber, "012", "nCurve", "bend from start to end, away from the parent's direction",
   {.role = {Role::trunk_bend}, .plain = {0, 0}}},
  {&P::curve_back, "curve_back", "deg", {-720, 720}, {-120, 120}, kReal, kNumber, "1", "nCurveBack", "bend of the second half, for S-shaped stems; 0: one bend",
   {.role = {Role::trunk_form}, .plain = {0, 0}}},
  {&P::curve_v, "curve_v", "deg", {-360, 1000}, {0, 200}, kReal, kFlag, "012", "nCurveV", "largest variation of curve; negative: a helix of that declination",
   {.role = {Role::trunk_bend_variation}, .plain = {50, 50}}},
  {&P::bend_v, "bend_v", "deg", {0, 1000}, {0, 200}, kReal, kNumber, "1", "nBendV", "largest sideways bend from start to end",
   {.role = {Role::trunk_form}, .plain = {0, 0}}},
  {&P::branch_dist, "branch_dist", "1", {0, 50}, {0, 4}, kReal, kNumber, "", "", "0 alternate, 1 opposite, above 1 whorls of branch_dist + 1 stems",
   {.places = true, .owner = kOfBearer, .plain = {0, 0}}},
  {&P::radius_mod, "radius_mod", "1", {0, 20}, {0.1, 3}, kLog, kNumber, "12", "", "factor on the radius of stems",
   {.role = {Role::trunk_form, Role::branch_radius}, .plain = {1, 1}}},
  {&P::leaf_blos_num, "leaf_blos_num", "1", {-2000, 10000}, {0, 120}, kWhole, kFlag, "*", "Leaves", "leaves or blossom on each stem of the last level; negative: in a fan at its tip",
   {.sides = FlagSides::one_measure, .relaxable = true, .role = {Role::leaf_count}}},
  {&P::leaf_shape, "leaf_shape", "1", {0, kLeafShapes.size()}, {0, kLeafShapes.size()}, kChoice, kNumber, "", "LeafShape", "outline of a leaf",
   {.choices = kLeafChoices, .needs = {{"leaf_blos_num"}}, .owner = kOfPlant}},
  {&P::leaf_scale, "leaf_scale", "m", {0, 50}, {0.03, 0.5}, kLog, kNumber, "*", "LeafScale", "length of a leaf",
   {.needs = {{"leaf_blos_num"}}, .role = {Role::leaf_length}}},
  {&P::leaf_scale_x, "leaf_scale_x", "1", {0, 50}, {0.05, 1.5}, kLog, kNumber, "*", "LeafScaleX", "width of a leaf relative to its outline's",
   {.needs = {{"leaf_blos_num"}}, .role = {Role::leaf_width}}},
  {&P::leaf_bend, "leaf_bend", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "LeafBend", "how far leaves turn to face outwards",
   {.needs = {{"leaf_blos_num"}}}},
  {&P::blossom_shape, "blossom_shape", "1", {1, kBlossomShapes.size()}, {1, kBlossomShapes.size()}, kChoice, kNumber, "", "", "form of a blossom",
   {.choices = kBlossomShapes, .first_choice = 1, .needs = {{"blossom_rate"}}, .owner = kOfPlant}},
  {&P::blossom_scale, "blossom_scale", "m", {0, 50}, {0, 0.3}, kReal, kNumber, "", "", "size of a blossom",
   {.needs = {{"blossom_rate"}}}},
  {&P::blossom_rate, "blossom_rate", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "", "fraction of the leaves that are blossom",
   {.role = {Role::blossom_share}}},
  {&P::tropism_x, "tropism_x", "1", {-100, 100}, {-3, 3}, kReal, kNumber, "*", "", "pull of all stems along x",
   {.role = {Role::trunk_form}, .plain = {0}}},
  {&P::tropism_y, "tropism_y", "1", {-100, 100}, {-3, 3}, kReal, kNumber, "", "", "pull of all stems along y",
   {.role = {Role::trunk_form}, .plain = {0}}},
  {&P::tropism_z, "tropism_z", "1", {-100, 100}, {-4, 4}, kReal, kNumber, "*", "AttractionUp", "pull upwards of stems of level 2 and above",
   {.plain = {0}}},
  {&P::prune_ratio, "prune_ratio", "1", {0, 1}, {0, 1}, kReal, kNumber, "", "PruneRatio", "how far pruning to the envelope is applied",
   {.owner = kOfPlant, .plain = {0}}},
  {&P::prune_width, "prune_width", "1", {0, 10}, {0.05, 1}, kReal, kNumber, "", "PruneWidth", "radius of the envelope as a fraction of its height",
   {.needs = {{"prune_ratio"}}, .owner = kOfPlant}},
  {&P::prune_width_peak, "prune_width_peak", "1", {0, 1}, {0.05, 0.95}, kReal, kNumber, "", "PruneWidthPeak", "where, from its bottom up, the envelope is widest",
   {.owner = kOfPlant}},
  {&P::prune_power_low, "prune_power_low", "1", {0, 20}, {0.05, 2}, kReal, kNumber, "", "PrunePowerLow", "curvature of the envelope below its peak: under 1 convex, over 1 concave",
   {.owner = kOfPlant}},
  {&P::prune_power_high, "prune_power_high", "1", {0, 20}, {0.05, 2}, kReal, kNumber, "", "PrunePowerHigh", "curvature of the envelope above its peak",
   {.owner = kOfPlant}},
  {&P::relaxed_counts, "relaxed_counts", "1", {0, 1}, {0, 1}, kChoice, kNumber, "", "", "on: counts may be fractions, and the last child grows in proportion, so that searches see no jumps",
   {.choices = kSwitch, .owner = kOfPlant, .role = {Role::relaxed_counts}}},
  {&P::crown_use, "crown_use", "1", {0, 3}, {0, 3}, kChoice, kNumber, "", "", "what the crown envelope of the crown_… rows does: nothing; cut stems; give stems on the trunk their lengths; bend stems along it",
   {.choices = kCrownUses, .part_of = "crown_use", .owner = kOfPlant, .plain = {0}}},
  {&P::crown_top, "crown_top", "1", {0.05, 3}, {0.5, 1.2}, kReal, kNumber, "", "", "height of the top of the crown envelope, relative to the scale of the tree",
   kOfCrown},
  {&P::crown_top_x, "crown_top_x", "1", {-0.7, 0.7}, {-0.5, 0.5}, kReal, kNumber, "", "", "how far the top lies along x, as a fraction of the radius on that side",
   kOfCrown},
  {&P::crown_top_y, "crown_top_y", "1", {-0.7, 0.7}, {-0.5, 0.5}, kReal, kNumber, "", "", "how far the top lies along y, as a fraction of the radius on that side",
   kOfCrown},
  {&P::crown_bottom, "crown_bottom", "1", {0, 0.95}, {0, 0.7}, kReal, kNumber, "", "", "height of the bottom of the crown envelope, as a fraction of the top's",
   kOfCrown},
  {&P::crown_bottom_x, "crown_bottom_x", "1", {-0.7, 0.7}, {-0.5, 0.5}, kReal, kNumber, "", "", "how far the bottom lies along x, as a fraction of the radius on that side",
   kOfCrown},
  {&P::crown_bottom_y, "crown_bottom_y", "1", {-0.7, 0.7}, {-0.5, 0.5}, kReal, kNumber, "", "", "how far the bottom lies along y, as a fraction of the radius on that side",
   kOfCrown},
  {&P::crown_radius_right, "crown_radius_right", "1", {0.005, 3}, {0.05, 0.8}, kLog, kNumber, "", "", "radius of the rim of the crown to the right (x > 0), relative to the scale of the tree",
   kOfCrown},
  {&P::crown_radius_back, "crown_radius_back", "1", {0.005, 3}, {0.05, 0.8}, kLog, kNumber, "", "", "radius of the rim of the crown to the back (y > 0), relative to the scale of the tree",
   kOfCrown},
  {&P::crown_radius_left, "crown_radius_left", "1", {0.005, 3}, {0.05, 0.8}, kLog, kNumber, "", "", "radius of the rim of the crown to the left, relative to the scale of the tree",
   kOfCrown},
  {&P::crown_radius_front, "crown_radius_front", "1", {0.005, 3}, {0.05, 0.8}, kLog, kNumber, "", "", "radius of the rim of the crown to the front, relative to the scale of the tree",
   kOfCrown},
  {&P::crown_rim_right, "crown_rim_right", "1", {0, 1}, {0.05, 0.95}, kReal, kNumber, "", "", "height of the rim to the right (x > 0), from 0 at the bottom of the crown to 1 at its top",
   kOfCrown},
  {&P::crown_rim_back, "crown_rim_back", "1", {0, 1}, {0.05, 0.95}, kReal, kNumber, "", "", "height of the rim to the back (y > 0), from 0 at the bottom of the crown to 1 at its top",
   kOfCrown},
  {&P::crown_rim_left, "crown_rim_left", "1", {0, 1}, {0.05, 0.95}, kReal, kNumber, "", "", "height of the rim to the left, from 0 at the bottom of the crown to 1 at its top",
   kOfCrown},
  {&P::crown_rim_front, "crown_rim_front", "1", {0, 1}, {0.05, 0.95}, kReal, kNumber, "", "", "height of the rim to the front, from 0 at the bottom of the crown to 1 at its top",
   kOfCrown},
  {&P::crown_shape_above, "crown_shape_above", "1", {0.1, 20}, {0.5, 6}, kLog, kNumber, "", "", "how the crown bulges above its rim: 1 a cone, 2 an ellipsoid, under 1 hollow",
   kOfCrown},
  {&P::crown_shape_below, "crown_shape_below", "1", {0.1, 20}, {0.5, 6}, kLog, kNumber, "", "", "how the crown bulges below its rim: 1 a cone, 2 an ellipsoid, under 1 hollow",
   kOfCrown},
  {&P::least_radius_mm, "least_radius", "mm", {0, 1000}, {0.5, 20}, kLog, kNumber, "", "", "least radius of a branch at its base, where its parent is no thinner; a stem bears nothing where it is thinner than a fiftieth of that",
   {.says_nothing_at_default = true}},
};
// clang-format on

using CurveMember = std::variant<DensityLevels StemCurves::*, AlongLevels StemCurves::*,
                                 DensityCurve StemCurves::*, AlongCurve StemCurves::*>;

/// A curve of each level from first_level on, or of the whole plant (-1).
struct CurveDefinition {
  CurveMember member;
  const char* name;
  int first_level;
  const char* unit;
  Range valid, search;
  CurveArgument argument;
  CurveRole role;
  double neutral;
  std::array<const char*, 3> needs;  ///< as in Needs
  const char* help;
  Owner owner = Owner::stem;
  bool places = false;  ///< as in Facts
};

using C = StemCurves;
constexpr CurveArgument kOnParent = CurveArgument::place_on_parent, kAlong = CurveArgument::along_itself;
constexpr CurveRole kFactor = CurveRole::factor, kOffset = CurveRole::offset, kDensity = CurveRole::density;

// clang-format off
const CurveDefinition kCurveDefinitions[] = {
  {&C::density_along, "density_along", 1, "1", {0, 20}, {0.05, 2}, kOnParent, kDensity, 1, {},
   "curve along the parent above its bare base: how densely stems stand, relative to the mean; their count stays", Owner::bearer},
  {&C::length_along, "length_along", 1, "1", {0, 10}, {0.1, 2}, kOnParent, kFactor, 1, {},
   "curve along the parent above its bare base: factor on the length of stems", Owner::bearer},
  {&C::down_angle_along, "down_angle_along", 1, "deg", {-360, 360}, {-60, 60}, kOnParent, kOffset, 0, {},
   "curve along the parent above its bare base: added to down_angle", Owner::bearer, true},
  {&C::curve_along, "curve_along", 0, "1", {-20, 20}, {-1, 3}, kAlong, kFactor, 1, {"curve[n]", "curve_back[n]", "curve_v[n]"},
   "curve along the stem: factor on its bend, by curve, curve_back and curve_v"},
  {&C::bend_along, "bend_along", 0, "deg", {-720, 720}, {-120, 120}, kAlong, kOffset, 0, {},
   "curve along the stem: sideways bend, in degrees over the whole stem where it is the same everywhere"},
  {&C::radius_along, "radius_along", 0, "1", {0, 10}, {0.3, 2}, kAlong, kFactor, 1, {},
   "curve along the stem: factor on its radius"},
  {&C::leaf_scale_along, "leaf_scale_along", -1, "1", {0, 10}, {0.2, 2}, kOnParent, kFactor, 1, {"leaf_blos_num"},
   "curve along the stem that bears them, above its bare base: factor on the size of leaves and blossom"},
  {&C::leaf_density_along, "leaf_density_along", -1, "1", {0, 20}, {0.05, 2}, kOnParent, kDensity, 1, {"leaf_blos_num"},
   "curve along the stem that bears them, above its bare base: how densely leaves stand, relative to the mean; their count stays"},
};
// clang-format on

std::string need_of(const char* need, int level) {
  std::string name = need;
  if (name.ends_with("[n]")) name.replace(name.size() - 2, 1, std::to_string(level));
  return name;
}

std::vector<std::string> needs_of(const Definition& definition, int level) {
  std::vector<std::string> names;
  for (const char* need : definition.facts.needs.at(level)) {
    if (!need) break;
    names.push_back(need_of(need, level));
  }
  return names;
}

/// Children are placed by the values of their own level, and leaves by those of the level below the last.
int least_levels_of(const Definition& definition, int level) {
  if (level < 0) return 0;
  return definition.facts.places ? level : level + 1;
}

RoleOfLevel role_of(const Definition& definition, int level) {
  const Role role = definition.facts.role.at(level);
  return {role, goes_by_level(role) ? level : -1};
}

bool is_free(const Definition& definition, int level) {
  const std::string_view levels = definition.free_levels;
  return level < 0 ? levels == "*" : levels.find(static_cast<char>('0' + level)) != levels.npos;
}

/// The levels above 3 have the rows of level 3.
int deepest_branch(Owner owner, int level) {
  if (owner == Owner::plant) return kNoBranch;
  if (owner == Owner::trunk) return 0;
  if (level < 0 || level == 3) return kAnyBranch;
  return owner == Owner::stem ? level : level - 1;
}

/// float defaults as the decimal a person would write: 0.015f becomes 0.015.
double decimal_of(float value) { return std::stod(fmt::format("{}", value)); }

ParameterInfo make_row(const Definition& definition, int level, float default_value) {
  const Facts& facts = definition.facts;
  const Range valid = level == 0 ? facts.trunk_valid.value_or(definition.valid) : definition.valid;
  return {.name = definition.name,
          .level = level,
          .unit = definition.unit,
          .lower = valid.lower,
          .upper = valid.upper,
          .search_lower = definition.search.lower,
          .search_upper = definition.search.upper,
          .scale = definition.scale,
          .sign = valid.lower < 0 ? definition.sign : SignMeaning::number,
          .default_value = decimal_of(default_value),
          .free_by_default = is_free(definition, level),
          .relaxable = facts.relaxable && level != 0,
          .choices = {facts.choices.begin(), facts.choices.end()},
          .first_choice = facts.first_choice,
          .sides = facts.sides,
          .codec = facts.codec ? &facts.codec() : nullptr,
          .least_levels = least_levels_of(definition, level),
          .needs = needs_of(definition, level),
          .part_of = facts.part_of,
          .says_nothing_at_default = facts.says_nothing_at_default,
          .mixed_with = facts.mixed_with,
          .mixed_by = facts.mixed_by,
          .role = role_of(definition, level),
          .deepest_branch = deepest_branch(facts.owner.at(level), level),
          .plain = facts.plain.at(level),
          .symbol = definition.symbol,
          .help = definition.help};
}

/// The row of a number of a curve. Of trunks it is part of their form.
ParameterInfo make_curve_row(const CurveDefinition& definition, int level, int point) {
  ParameterInfo row{.name = definition.name,
                    .level = level,
                    .point = point,
                    .unit = definition.unit,
                    .lower = definition.valid.lower,
                    .upper = definition.valid.upper,
                    .search_lower = definition.search.lower,
                    .search_upper = definition.search.upper,
                    .default_value = definition.neutral,
                    .least_levels = definition.places ? level : level + 1,
                    .role = {level == 0 ? Role::trunk_form : Role::none},
                    .deepest_branch = deepest_branch(definition.owner, level),
                    .plain = definition.neutral,
                    .help = definition.help};
  for (const char* need : definition.needs)
    if (need) row.needs.push_back(need_of(need, level));
  return row;
}

void append_curve(const CurveDefinition& definition, int level, ParameterTable& table) {
  table.curves.push_back({.name = definition.name,
                          .level = level,
                          .first_row = table.rows.size(),
                          .argument = definition.argument,
                          .role = definition.role,
                          .neutral = definition.neutral});
  table.rows.reserve(table.rows.size() + kCurveRows);
  for (int point = 0; point < static_cast<int>(kCurveRows); ++point)
    table.rows.push_back(make_curve_row(definition, level, point));
}

void append_curves(ParameterTable& table) {
  for (const CurveDefinition& definition : kCurveDefinitions)
    if (definition.first_level < 0)
      append_curve(definition, -1, table);
    else
      for (int level = definition.first_level; level < 4; ++level) append_curve(definition, level, table);
}

ParameterTable make_table() {
  const WeberPennParameters defaults;
  ParameterTable table{"weber_penn", {}};
  for (const Definition& definition : kDefinitions) {
    if (const auto* whole = std::get_if<PlantMember>(&definition.member))
      table.rows.push_back(make_row(definition, -1, defaults.*(*whole)));
    else
      for (int level = 0; level < 4; ++level)
        table.rows.push_back(
            make_row(definition, level, (defaults.*std::get<LevelMember>(definition.member))[level]));
  }
  append_curves(table);  // last: what draws by the number of a row keeps its draws
  return table;
}

/// Takes the numbers of the curves from `values`, in the order of the table.
class CurveReader {
 public:
  CurveReader(std::span<const double> values, StemCurves& curves) : values_(values), curves_(curves) {}

  void read(const CurveDefinition& definition) {
    std::visit([&](auto member) { take(definition, curves_.*member); }, definition.member);
  }

 private:
  std::span<const double> next() {
    const auto numbers = values_.first(kCurveRows);
    values_ = values_.subspan(kCurveRows);
    return numbers;
  }
  void take(const CurveDefinition& definition, AlongCurve& curve) {
    curve = make_along_curve(next(), definition.neutral);
  }
  void take(const CurveDefinition&, DensityCurve& curve) { curve = make_density_curve(next()); }
  template <typename Levels>
  void take(const CurveDefinition& definition, Levels& levels) {
    for (auto level = static_cast<std::size_t>(definition.first_level); level < levels.size(); ++level)
      take(definition, levels[level]);
  }

  std::span<const double> values_;
  StemCurves& curves_;
};

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
  CurveReader reader(values.subspan(row), parameters.curves);
  for (const CurveDefinition& definition : kCurveDefinitions) reader.read(definition);
  return parameters;
}

}  // namespace espalier
