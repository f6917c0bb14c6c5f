// Stems walked in batches take the same way as stems walked alone, bit for bit, whatever the parameters.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <espalier/weber_penn/simd/stem_batch.h>

namespace espalier {
namespace {

class Segments : public StemVisitor {
 public:
  bool segment(const GrowingStem&, const Segment& segment) override {
    all.push_back(segment);
    return true;
  }
  void split(const GrowingStem&) override { FAIL() << "these stems do not split"; }
  std::vector<Segment> all;
};

float in_range(float low, float high) {
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, 10'001)) * 1e-4f;
}

WeberPennParameters any_parameters(int level) {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.curve_res[level] = static_cast<float>(*rc::gen::inRange(1, 13));
  p.curve[level] = in_range(-200, 200);
  p.curve_back[level] = *rc::gen::element(0.f, 80.f);
  p.curve_v[level] = *rc::gen::element(0.f, 150.f);
  p.bend_v[level] = *rc::gen::element(0.f, 90.f);
  p.tropism_x = *rc::gen::element(0.f, 1.5f);
  p.tropism_z = in_range(-3, 3);
  return p;
}

std::vector<GrowingStem> any_stems(int level) {
  std::vector<GrowingStem> stems(static_cast<std::size_t>(*rc::gen::inRange(1, StemBatch::kMostStems + 1)));
  for (GrowingStem& stem : stems) {
    stem.key = root_key(static_cast<Seed>(*rc::gen::inRange(0, 1'000'000)));
    stem.level = level;
    stem.turtle.position_m = {in_range(-3, 3), in_range(-3, 3), in_range(0, 10)};
    stem.turtle.pitch_down(in_range(0, 180));
    stem.turtle.roll_right(in_range(0, 360));
    stem.length_m = in_range(0.01f, 8);
  }
  return stems;
}

bool same(const Segment& a, const Segment& b) {
  return a.start_m == b.start_m && a.handle_out_m == b.handle_out_m && a.handle_in_m == b.handle_in_m &&
         a.end_m == b.end_m && a.z_start == b.z_start && a.z_end == b.z_end &&
         a.end.position_m == b.end.position_m && a.end.forward == b.end.forward && a.end.right == b.end.right;
}

TEST(StemBatch, WalksAsStemsAloneDo) {
  EXPECT_TRUE(rc::check([] {
    const int level = *rc::gen::inRange(0, 4);
    const WeberPennParameters p = any_parameters(level);
    const std::vector<GrowingStem> stems = any_stems(level);
    RC_ASSERT(StemBatch::supports(level, p));
    StemBatch batch;
    batch.walk(stems, p);
    for (std::size_t i = 0; i < stems.size(); ++i) {
      Segments alone;
      walk_stem(stems[i], p, alone);
      RC_ASSERT(batch.segment_count() == static_cast<int>(alone.all.size()));
      for (std::size_t k = 0; k < alone.all.size(); ++k)
        RC_ASSERT(same(batch.segment(i, static_cast<int>(k)), alone.all[k]));
    }
  }));
}

}  // namespace
}  // namespace espalier
