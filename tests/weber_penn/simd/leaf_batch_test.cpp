// Leaves placed by vector instructions are those that the plain formulas place, whatever the parameters.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <espalier/weber_penn/scalar/leaf_placement.h>
#include <espalier/weber_penn/simd/leaf_batch.h>

namespace espalier {
namespace {

/// Places the leaves of a stem in both ways while it is walked.
class BothWays : public StemVisitor {
 public:
  BothWays(const GrowingStem& stem, const WeberPennParameters& p)
      : p_(p),
        for_plain_(stem, ChildPlacer::Bears::leaves, p),
        for_batch_(stem, ChildPlacer::Bears::leaves, p),
        batch_(p, memory_, batched) {}

  bool segment(const GrowingStem& stem, const Segment& segment) override {
    for_plain_.begin(stem, segment);
    for (ChildSite site; for_plain_.next(site);) place_leaf(stem, site, p_, plain);
    for_batch_.begin(stem, segment);
    batch_.add(stem, segment, for_batch_);
    return true;
  }
  void split(const GrowingStem&) override {}
  void finish() { batch_.flush(); }

  Leaves plain, batched;

 private:
  const WeberPennParameters& p_;
  ChildPlacer for_plain_, for_batch_;
  ChildBatchMemory memory_;
  LeafBatch batch_;
};

float in_range(float low, float high) {
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, 10'001)) * 1e-4f;
}

WeberPennParameters any_leaf_parameters() {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.levels = 2;
  p.curve_res[1] = static_cast<float>(*rc::gen::inRange(1, 9));
  p.curve[1] = in_range(-180, 180);
  p.curve_v[1] = in_range(0, 200);
  p.bend_v[1] = in_range(0, 200);
  p.base_size[1] = in_range(0, 0.5f);
  p.taper[1] = in_range(0, 1.99f);
  p.leaf_blos_num = in_range(1, 900);
  p.leaf_bend = *rc::gen::element(0.f, 0.3f, 1.f);
  p.rotate[2] = in_range(-180, 180);
  p.rotate_v[2] = *rc::gen::element(0.f, 20.f);
  p.down_angle[2] = in_range(-90, 150);
  p.down_angle_v[2] = in_range(-90, 60);
  p.branch_dist[2] = *rc::gen::element(0.f, 1.f, 3.f);
  p.blossom_rate = *rc::gen::element(0.f, 0.3f);
  p.relaxed_counts = *rc::gen::element(0.f, 1.f);
  return p;
}

GrowingStem any_stem() {
  GrowingStem stem;
  stem.key = root_key(*rc::gen::inRange(0, 1'000'000));
  stem.level = 1;
  stem.tree = {10, 2};
  stem.turtle.position_m = {in_range(-3, 3), in_range(-3, 3), in_range(0, 10)};
  stem.turtle.pitch_down(in_range(0, 180));
  stem.turtle.roll_right(in_range(0, 360));
  stem.length_m = in_range(0.1f, 4);
  stem.radius_m = 0.05f * stem.length_m;
  stem.parent_length_m = 8;
  stem.parent_child_max = 0.5f;
  return stem;
}

float largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, length(a[i] - b[i]));
  return largest;
}

/// The leaves of the same stem, which does not split, all at once.
Leaves of_whole_stem(const GrowingStem& stem, const WeberPennParameters& p) {
  StemBatch stems;
  stems.walk({&stem, 1}, p);
  ChildBatchMemory memory;
  Leaves leaves;
  LeafBatch batch(p, memory, leaves);
  batch.add(stem, stems, 0);
  batch.flush();
  return leaves;
}

void expect_same(const Leaves& batched, const Leaves& plain) {
  RC_ASSERT(batched.position_m.size() == plain.position_m.size());
  RC_ASSERT(batched.length_m == plain.length_m);
  RC_ASSERT(batched.kind == plain.kind);
  RC_ASSERT(largest_difference(batched.position_m, plain.position_m) < 2e-4f);
  RC_ASSERT(largest_difference(batched.axis, plain.axis) < 2e-3f);
  RC_ASSERT(largest_difference(batched.side, plain.side) < 2e-3f);
}

TEST(LeafBatch, PlacesWhatThePlainFormulasPlace) {
  EXPECT_TRUE(rc::check([] {
    const WeberPennParameters p = any_leaf_parameters();
    const GrowingStem stem = any_stem();
    RC_ASSERT(LeafBatch::supports(stem, p));
    BothWays both(stem, p);
    walk_stem(stem, p, both);
    both.finish();
    expect_same(both.batched, both.plain);
    expect_same(of_whole_stem(stem, p), both.plain);
  }));
}

}  // namespace
}  // namespace espalier
