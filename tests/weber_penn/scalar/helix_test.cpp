// The helix of a stem whose curve_v is negative, against its formulas [CH §3.2.1 Helical Branches]:
// θ = 90 − |curve_v|, pitch p = 2L/m over m segments, radius r = 3p/(16 tan θ); pitch and radius of a stem
// vary by a fifth, each by its own draw. A segment is half a turn, so its ends lie 2r apart across the axis.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/weber_penn/scalar/helix.h>

namespace espalier {
namespace {

constexpr int kHelixSegments = 8, kHelixStems = 400;
constexpr float kHelixLengthM = 10;

class HelixWalk : public StemVisitor {
 public:
  bool segment(const GrowingStem&, const Segment& segment) override {
    all.push_back(segment);
    return true;
  }
  void split(const GrowingStem&) override { FAIL() << "helices do not split"; }
  std::vector<Segment> all;
};

/// An upright stem's segments.
std::vector<Segment> helix_of(float curve_v, Seed seed) {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.curve_v[1] = curve_v;
  p.curve_res[1] = kHelixSegments;
  GrowingStem stem;
  stem.key = root_key(seed);
  stem.level = 1;
  stem.length_m = kHelixLengthM;
  HelixWalk segments;
  walk_helix(stem, p, segments);
  return segments.all;
}

float across_m(Vec3 from, Vec3 to) { return std::hypot(to.x - from.x, to.y - from.y); }

/// Over the formula's value, of many stems: the mean is 1, and each lies within a fifth.
void expect_a_fifth_around_one(const std::vector<double>& ratios, const char* what) {
  double mean = 0;
  for (const double ratio : ratios) {
    EXPECT_GT(ratio, 0.8 - 1e-3) << what;
    EXPECT_LT(ratio, 1.2 + 1e-3) << what;
    mean += ratio / double(ratios.size());
  }
  EXPECT_NEAR(mean, 1, 5 * 0.2 / std::sqrt(3.0 * double(ratios.size()))) << what;
}

TEST(Helix, HasThePitchAndTheRadiusOfItsFormulas) {
  for (const float curve_v : {-20.f, -45.f, -70.f}) {
    const double theta = (90 - std::fabs(curve_v)) * M_PI / 180;
    std::vector<double> pitches, radii;
    for (Seed seed = 0; seed < kHelixStems; ++seed) {
      const std::vector<Segment> segments = helix_of(curve_v, seed);
      ASSERT_EQ(segments.size(), std::size_t(kHelixSegments));
      const double pitch_m = 2.0 * segments[0].end_m.z;
      pitches.push_back(pitch_m / (2.0 * kHelixLengthM / kHelixSegments));
      radii.push_back(across_m(segments[0].start_m, segments[0].end_m) / 2 /
                      (3 * pitch_m / (16 * std::tan(theta))));
    }
    SCOPED_TRACE(curve_v);
    expect_a_fifth_around_one(pitches, "pitch");
    expect_a_fifth_around_one(radii, "radius");
  }
}

/// Each segment's curve bulges by r at its middle, on alternating sides, so that the whole goes round.
TEST(Helix, HalfTurnsBulgeByTheRadiusAndComeBackAfterTwo) {
  const std::vector<Segment> segments = helix_of(-45, 5);
  const float diameter_m = across_m(segments[0].start_m, segments[0].end_m);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    const Vec3 middle = segment_point(s, 0.5f), centre = lerp(s.start_m, s.end_m, 0.5f);
    EXPECT_NEAR(across_m(centre, middle), diameter_m / 2, 1e-4f) << i;
    EXPECT_NEAR(across_m(segments[0].start_m, s.end_m), i % 2 == 0 ? diameter_m : 0, 1e-4f) << i;
    EXPECT_NEAR(s.end_m.z, segments[0].end_m.z * float(i + 1), 1e-3f) << i;
  }
}

}  // namespace
}  // namespace espalier
