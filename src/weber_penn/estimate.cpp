// Expected counts level by level: splits as a branching process, children by the mean of their formulas.
#include <algorithm>
#include <array>
#include <cmath>

#include <espalier/weber_penn/estimate.h>
#include <espalier/weber_penn/scalar/stem.h>
#include <espalier/weber_penn/table/shape_ratio.h>
#include <espalier/weber_penn/tree_crown.h>

namespace espalier {

namespace {

/// What one stem has become after its last segment: stems, and what they bear relative to an unsplit one.
struct Clones {
  double at_tip = 1, leaf_share = 1, child_share = 1;
};

bool at_base_split(const WeberPennParameters& p, int level) { return level == 0 && p.base_splits != 0; }

/// Generation g of clones splits with probability 1/(s+1)^g [CH §3.2.1].
Clones expected_clones(const WeberPennParameters& p, int level) {
  constexpr int kGenerations = 12;
  std::array<double, kGenerations + 1> stems{1};
  const double rate = p.seg_splits[level_index(level)];
  const int segments = segment_count(p, level);
  const double per_split = std::max(1.0, rate);
  double total = 1, leaf_sum = 1, child_sum = 1;
  const int base_segment = static_cast<int>(std::ceil(p.base_size[0] * static_cast<float>(segments)));
  for (int at = 1; at < segments; ++at) {
    const int first = level == 0 ? base_segment : 0;
    if (level == 0 && at == std::max(1, first)) {
      const double extra = p.base_splits < 0 ? -p.base_splits / 2.0 : p.base_splits;
      for (double& count : stems) count *= 1 + extra;
    }
    double probability = at > first ? std::min(1.0, rate) : 0;
    std::array<double, kGenerations + 1> after = stems;
    for (int generation = 0; generation < kGenerations; ++generation, probability /= per_split + 1) {
      const double splitting = stems[generation] * probability;
      after[generation] -= splitting;
      after[generation + 1] += splitting * (1 + per_split);
    }
    stems = after;
    total = 0;
    for (const double count : stems) total += count;
    // The last split of a stem lies, on average, half way up to here [stem_walk.cpp: thin_out].
    const double grown_part = 1 - 0.5 * at / segments;
    const double split = at_base_split(p, level) ? total : total - stems[0];
    leaf_sum += total - split + split * grown_part;
    child_sum += total - split + split * 0.8 * grown_part;
  }
  return {total, leaf_sum / segments, child_sum / segments};
}

constexpr int kSamples = 8;

/// Mean length of first-level branches relative to the longest of their kind.
double mean_length_share(const WeberPennParameters& p) {
  double sum = 0;
  const AlongCurve& along = p.curves.length_along[1];
  for (int sample = 0; sample < kSamples; ++sample) {
    const float ratio = (static_cast<float>(sample) + 0.5f) / kSamples;  // from the top down
    const float shape = crown_shape_ratio(ratio, p);
    sum += along.is_neutral ? shape : shape * along.at(1 - ratio);
  }
  return sum / kSamples;
}

double mean_of(const AlongCurve& along) {
  if (along.is_neutral) return 1;
  double sum = 0;
  for (int sample = 0; sample < kSamples; ++sample)
    sum += along.at((static_cast<float>(sample) + 0.5f) / kSamples);
  return sum / kSamples;
}

bool gives_lengths(const WeberPennParameters& p) {
  return static_cast<CrownUse>(p.crown_use) == CrownUse::length && p.length[0] * p.length[1] > 0;
}

/// How far the crown envelope reaches from its axis, on average over heights and sides; relative to the
/// tree's scale.
double mean_crown_reach(const WeberPennParameters& p) {
  const CrownEnvelope crown(crown_shape(p, 1));
  constexpr int kHeights = 4;
  constexpr std::array kSides{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}};
  double sum = 0;
  for (int i = 0; i < kHeights; ++i) {
    const Vec3 start = lerp(crown.shape().bottom_m, crown.shape().top_m, (i + 0.5f) / kHeights);
    for (const Vec3 side : kSides) sum += crown.reach_m(start, side);
  }
  return sum / (kHeights * kSides.size());
}

/// Mean number of children of a stem relative to branches[level + 1].
double mean_child_share(const WeberPennParameters& p, int level) {
  if (level == 0) return 1;
  if (level > 1) return 0.75;
  if (gives_lengths(p)) return 0.2 + 0.8 * mean_crown_reach(p) / (p.length[0] * p.length[1]);
  return 0.2 + 0.8 * mean_length_share(p);
}

double mean_leaf_share(const WeberPennParameters& p, int level) {
  if (level < 2) return level == 0 ? 1 : mean_child_share(p, 1) * 1.25 - 0.25;
  return 0.65 * mean_of(p.curves.length_along[level_index(level)]);
}

}  // namespace

GrowthEstimate estimate_growth(const WeberPennParameters& p) {
  double roots = std::max(1.f, p.branches[0]), stems = 0, leaves = 0;
  for (int level = 0; level < p.level_count(); ++level) {
    const Clones clones = expected_clones(p, level);
    stems += roots * clones.at_tip;
    if (level + 1 == p.level_count()) {
      const double per_stem = std::fabs(p.leaf_blos_num);
      leaves = roots * (p.leaf_blos_num < 0 ? per_stem * clones.at_tip
                                            : per_stem * clones.leaf_share * mean_leaf_share(p, level));
      break;
    }
    const double children = p.branches[level_index(level + 1)];
    const bool fan = children < 0;
    roots *= fan ? -children * clones.at_tip : children * clones.child_share * mean_child_share(p, level);
  }
  return {stems, leaves};
}

}  // namespace espalier
